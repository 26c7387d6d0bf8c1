#include "base/option_ranges.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include <curveskel/error.hpp>

namespace curveskel {
namespace {

/// As few digits as say the number; whole ones without an exponent.
std::string plain_number(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e9) {
    return std::to_string(static_cast<long long>(value));
  }
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), written.ptr};
}

bool lies_within(double value, const OptionRange& range) {
  const bool enough = range.above_least ? value > range.least : value >= range.least;
  return enough && value <= range.most;  // not so for what is no number
}

}  // namespace

std::string range_words(const OptionRange& range) {
  const bool endless = range.most == std::numeric_limits<double>::max();
  if (range.above_least) {
    return "above " + plain_number(range.least) +
           (endless ? "" : " and up to " + plain_number(range.most));
  }
  return plain_number(range.least) + (endless ? " or more" : ".." + plain_number(range.most));
}

void OptionCheck::number(std::string_view option, double value, const OptionRange& range) const {
  if (!lies_within(value, range)) refuse(option, plain_number(value), range_words(range));
}

void OptionCheck::number(std::string_view option, int value, const OptionRange& range) const {
  if (!lies_within(value, range)) refuse(option, std::to_string(value), range_words(range));
}

void OptionCheck::refuse(std::string_view option, const std::string& found,
                         const std::string& needed) const {
  throw Error(Fault::usage, std::string(owner_) + "::" + std::string(option) + " is " + found +
                                ", needed " + needed);
}

}  // namespace curveskel
