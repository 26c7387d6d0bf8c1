#include "rig/fbx/fbx_curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include <curveskel/advanced/indices.hpp>
#include "rig/animations/bezier.hpp"
#include "rig/animations/moments.hpp"
#include "rig/fbx/fbx_time.hpp"

namespace curveskel {
namespace {

// The bits of "KeyAttrFlags".
constexpr std::uint64_t is_step = 0x2;
constexpr std::uint64_t is_cubic = 0x8;
constexpr std::uint64_t steps_to_next = 0x100;  // of a step
constexpr std::uint64_t has_own_slopes = 0x400 | 0x800;
constexpr std::uint64_t leaves_with_weight = 0x1000000;
constexpr std::uint64_t arrives_with_weight = 0x2000000;
constexpr std::size_t numbers_a_key = 4;  // slopes behind it and before the next; weights; speeds

[[noreturn]] void refuse_curve(const FileBytes& file, const FbxRecord& curve,
                               const std::string& found, const char* needed) {
  file.fail(found + " in the animation curve at byte " + std::to_string(curve.position), needed,
            "export the file again, or without animations");
}

std::vector<double> curve_numbers(const FileBytes& file, const FbxRecord& curve,
                                  std::string_view name) {
  const FbxRecord* record = curve.child(name);
  return record == nullptr ? std::vector<double>() : fbx_numbers(file, *record);
}

/// The two shares of ten thousand that lie in the bits of a float.
double share_in(double number, int half) {
  constexpr double whole = 9999;
  const auto packed = static_cast<float>(number);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &packed, sizeof bits);
  return std::clamp(static_cast<double>((bits >> (16 * half)) & 0xFFFFU) / whole, 0.0, 1.0);
}

}  // namespace

FbxCurve::FbxCurve(const FileBytes& file, const FbxRecord& curve) {
  const std::vector<double> times = curve_numbers(file, curve, "KeyTime");
  const std::vector<double> values = curve_numbers(file, curve, "KeyValueFloat");
  if (times.size() != values.size()) {
    refuse_curve(
        file, curve,
        std::to_string(times.size()) + " times and " + std::to_string(values.size()) + " values",
        "as many of both");
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double seconds = times[k] / fbx_ticks_a_second;
    const bool is_later = k == 0 || seconds >= keys_.back().seconds;
    if (!std::isfinite(seconds) || !std::isfinite(values[k]) || !is_later) {
      refuse_curve(file, curve, "a key that is no number or goes back in time",
                   "numbers, times in their order");
    }
    keys_.push_back({seconds, values[k]});
  }
  read_between(file, curve);
}

void FbxCurve::read_between(const FileBytes& file, const FbxRecord& curve) {
  const std::vector<double> flags = curve_numbers(file, curve, "KeyAttrFlags");
  const std::vector<double> numbers = curve_numbers(file, curve, "KeyAttrDataFloat");
  const std::vector<double> counts = curve_numbers(file, curve, "KeyAttrRefCount");
  std::size_t key = 0;
  for (std::size_t k = 0; k < std::min(flags.size(), counts.size()); ++k) {
    static constexpr double none[numbers_a_key] = {};
    const bool has_numbers = (k + 1) * numbers_a_key <= numbers.size();
    const double* first = has_numbers ? numbers.data() + k * numbers_a_key : none;
    const bool is_count = counts[k] > 0 && counts[k] <= static_cast<double>(keys_.size());
    const auto count = is_count ? static_cast<std::size_t>(counts[k]) : 0;
    constexpr double most_bits = 4294967296.0;
    const bool are_flags = flags[k] >= 0 && flags[k] < most_bits;
    const Attributes given{are_flags ? static_cast<std::uint64_t>(flags[k]) : 0, first};
    for (std::size_t i = 0; i < count && key < keys_.size(); ++i, ++key) set(key, given);
  }
}

void FbxCurve::set(std::size_t number, const Attributes& given) {
  Key& key = keys_[number];
  if ((given.flags & is_step) != 0) {
    key.between = (given.flags & steps_to_next) != 0 ? Between::next : Between::step;
  }
  if ((given.flags & is_cubic) == 0) return;
  key.between = Between::cubic;
  const bool own = (given.flags & has_own_slopes) != 0 && std::isfinite(given.numbers[0]) &&
                   std::isfinite(given.numbers[1]);
  key.leaving = own ? given.numbers[0] : own_slope(number);
  key.arriving = own ? given.numbers[1] : own_slope(std::min(number + 1, keys_.size() - 1));
  if ((given.flags & leaves_with_weight) != 0) key.leaving_share = share_in(given.numbers[2], 0);
  if ((given.flags & arrives_with_weight) != 0) key.arriving_share = share_in(given.numbers[2], 1);
}

/// That of a key whose slope is left to the program: towards the key behind the next, as long as
/// the curve stays between its keys.
double FbxCurve::own_slope(std::size_t key) const {
  if (key == 0 || key + 1 >= keys_.size()) return 0;
  const auto slope = [this](std::size_t from, std::size_t to) {
    const double length = keys_[to].seconds - keys_[from].seconds;
    return length > 0 ? (keys_[to].value - keys_[from].value) / length : 0;
  };
  const double before = slope(key - 1, key);
  const double behind = slope(key, key + 1);
  if (before * behind <= 0) return 0;
  constexpr double steepest = 3;  // of a cubic that rises all the way
  const double limit = steepest * std::min(std::abs(before), std::abs(behind));
  return std::clamp(slope(key - 1, key + 1), -limit, limit);
}

std::vector<double> FbxCurve::seconds() const {
  std::vector<double> all;
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    all.push_back(keys_[k].seconds);
    if (k + 1 == keys_.size()) break;
    const double length = keys_[k + 1].seconds - keys_[k].seconds;
    const double step = std::min(step_seconds, 0.5 * length);
    if (keys_[k].between == Between::step) all.push_back(keys_[k + 1].seconds - step);
    if (keys_[k].between == Between::next) all.push_back(keys_[k].seconds + step);
  }
  return all;
}

bool FbxCurve::bends() const {
  return std::ranges::any_of(keys_, [](const Key& key) { return key.between == Between::cubic; });
}

double FbxCurve::at(double seconds) const {
  const auto is_before = [](double moment, const Key& key) { return moment < key.seconds; };
  const auto above = std::upper_bound(keys_.begin(), keys_.end(), seconds, is_before);
  if (above == keys_.begin()) return keys_.front().value;
  const Key& key = *(above - 1);
  if (above == keys_.end() || key.between == Between::step || seconds == key.seconds) {
    return key.value;
  }
  const Key& next = *above;
  if (key.between == Between::next) return next.value;
  const double length = next.seconds - key.seconds;
  if (key.between == Between::line) {
    return key.value + (seconds - key.seconds) / length * (next.value - key.value);
  }
  const double leaving = key.leaving_share * length;
  const double arriving = key.arriving_share * length;
  return bezier_value({key.seconds, key.value},
                      {key.seconds + leaving, key.value + leaving * key.leaving},
                      {next.seconds - arriving, next.value - arriving * key.arriving},
                      {next.seconds, next.value}, seconds);
}

}  // namespace curveskel
