// Options from keyword arguments.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <map>
#include <string>

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

/// A setter of a number or a flag.
template <typename Value>
auto sets(Value& value) {
  return [&value](const pybind11::handle& given) { value = given.cast<Value>(); };
}

/// A setter of a choice by its name.
template <typename Choice, std::size_t Count>
auto sets(Choice& value, const char* option, const NameTable<Choice, Count>& table) {
  return [&value, option, &table](const pybind11::handle& given) {
    const auto name = given.cast<std::string>();
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

/// `require_valid`, and Error(Fault::usage) for a wrap gap where nothing is wrapped.
void require_together(const RepairOptions& options);

}  // namespace curveskel
