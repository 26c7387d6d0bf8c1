// Options from keyword arguments.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <map>
#include <string>
#include <type_traits>

#include <curveskel/advanced/names.hpp>
#include <curveskel/error.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/repair.hpp>

namespace curveskel {

/// By name, what sets an option.
using OptionSetters = std::map<std::string, std::function<void(const pybind11::handle&)>>;

/// Throws Error(Fault::usage) for a name that is none of the setters' and for a value of a type
/// that its setter does not take.
void set_options(const pybind11::dict& options, const OptionSetters& setters);

/// A value of another type than its option has; `set_options` says so, and what is needed.
struct NeededInstead {
  std::string needed;
};

template <typename Value>
[[nodiscard]] Value option_of(const pybind11::handle& given, const std::string& needed) {
  try {
    return given.cast<Value>();
  } catch (const pybind11::cast_error&) {
    throw NeededInstead{needed};
  }
}

/// A setter of a number or a flag.
template <typename Value>
auto sets(Value& value) {
  constexpr const char* needed = std::is_same_v<Value, bool> ? "True or False"
                                 : std::is_integral_v<Value> ? "a whole number"
                                                             : "a number";
  return [&value](const pybind11::handle& given) { value = option_of<Value>(given, needed); };
}

/// A setter of a choice by its name.
template <typename Choice, std::size_t Count>
auto sets(Choice& value, const char* option, const NameTable<Choice, Count>& table) {
  return [&value, option, &table](const pybind11::handle& given) {
    const auto name = option_of<std::string>(given, "one of: " + names_in(table));
    const auto found = choice_of(table, name);
    if (!found) {
      throw Error(Fault::usage,
                  std::string(option) + ": " + name + " is none of: " + names_in(table));
    }
    value = *found;
  };
}

/// Those of repair and of extraction (without threads) that Python has, by the program's names with
/// _ for -.
[[nodiscard]] OptionSetters repair_setters(RepairOptions& options);
[[nodiscard]] OptionSetters extract_setters(ExtractOptions& options);

/// `require_valid`, whose messages have the keyword for the member: "fair" for the iterations.
void require_valid_keywords(const ExtractOptions& options);

/// Throws Error(Fault::usage) for a number that the program refuses, though the library takes it.
void require_program_range(const char* keyword, double value, double least, double most);

/// `require_valid`, and Error(Fault::usage) for a wrap gap where nothing is wrapped.
void require_together(const RepairOptions& options);

}  // namespace curveskel
