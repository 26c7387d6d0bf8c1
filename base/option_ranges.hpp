// Options are checked where they enter. Each range stands once, in `require_valid` of its struct,
// beside the name that the message says.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include <curveskel/advanced/names.hpp>
#include <curveskel/threads.hpp>

namespace curveskel {

/// The range of a number, ends included; always finite.
struct OptionRange {
  double least = 0;
  double most = std::numeric_limits<double>::max();
  bool above_least = false;  ///< `least` itself is too little
};

inline constexpr OptionRange thread_range{0, most_threads};
inline constexpr OptionRange share_range{0, 1};
inline constexpr OptionRange iteration_range{0, 1e6};

/// "0..1", "0 or more", "above 0", "above 0 and up to 1".
[[nodiscard]] std::string range_words(const OptionRange& range);

/// Checks the members of one options struct.
class OptionCheck {
 public:
  /// `owner` is the struct's name.
  explicit OptionCheck(std::string_view owner) : owner_(owner) {}

  /// Throws Error(Fault::usage, "OWNER::OPTION is VALUE, needed RANGE") for a value out of it.
  void number(std::string_view option, double value, const OptionRange& range) const;
  void number(std::string_view option, int value, const OptionRange& range) const;

  /// The same for what is no entry of its table.
  template <typename Choice, std::size_t Count>
  void choice(std::string_view option, Choice value, const NameTable<Choice, Count>& table) const {
    for (const auto& entry : table) {
      if (entry.value == value) return;
    }
    refuse(option, std::to_string(static_cast<long long>(value)), "one of " + names_in(table));
  }

 private:
  [[noreturn]] void refuse(std::string_view option, const std::string& found,
                           const std::string& needed) const;

  std::string_view owner_;
};

}  // namespace curveskel
