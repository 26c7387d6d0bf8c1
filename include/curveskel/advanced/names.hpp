// A runtime choice is an enum and one table of names, shared by the command line, the reports and
// the messages.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace curveskel {

template <typename Choice>
struct Name {
  Choice value;
  std::string_view name;
  std::string_view meaning;  ///< one line of help
};

template <typename Choice, std::size_t Count>
using NameTable = std::array<Name<Choice>, Count>;

template <typename Choice, std::size_t Count>
[[nodiscard]] constexpr std::string_view name_of(const NameTable<Choice, Count>& table,
                                                 Choice value) {
  for (const auto& entry : table) {
    if (entry.value == value) return entry.name;
  }
  return "?";
}

template <typename Choice, std::size_t Count>
[[nodiscard]] constexpr std::optional<Choice> choice_of(const NameTable<Choice, Count>& table,
                                                        std::string_view name) {
  for (const auto& entry : table) {
    if (entry.name == name) return entry.value;
  }
  return std::nullopt;
}

/// "a, b, c": the list for a message about a wrong name.
template <typename Choice, std::size_t Count>
[[nodiscard]] std::string names_in(const NameTable<Choice, Count>& table) {
  std::string names;
  for (const auto& entry : table) {
    if (!names.empty()) names += ", ";
    names += entry.name;
  }
  return names;
}

}  // namespace curveskel
