// Arguments of verbs, declared so that all verbs behave the same way.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <string>

#include <curveskel/advanced/names.hpp>
#include <curveskel/preset.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig_files.hpp>

namespace curveskel {

/// Name, meaning; one line per entry of the table.
template <typename Choice, std::size_t Count>
[[nodiscard]] std::string meanings(const std::string& title,
                                   const NameTable<Choice, Count>& table) {
  std::string text = title + ":\n";
  for (const auto& entry : table) {
    std::string name(entry.name);
    name.resize(std::max<std::size_t>(name.size() + 1, 12), ' ');
    text += "  " + name + std::string(entry.meaning) + "\n";
  }
  return text;
}

/// An option that takes one of the table's names; the default is the value's own.
template <typename Choice, std::size_t Count>
CLI::Option* add_choice(CLI::App& parser, const std::string& flag, Choice& value,
                        const NameTable<Choice, Count>& table, const std::string& meaning) {
  const auto set = [flag, &value, &table](const std::string& name) {
    const auto found = choice_of(table, name);
    if (!found) throw CLI::ValidationError(flag, name + " is none of: " + names_in(table));
    value = *found;
  };
  return parser.add_option_function<std::string>(flag, set, meaning)
      ->type_name("NAME")
      ->default_str(std::string(name_of(table, value)));
}

/// A number with the value's own default.
template <typename Number>
CLI::Option* add_number(CLI::App& parser, const std::string& flag, Number& value, Number least,
                        Number most, const std::string& meaning) {
  const auto within = [flag, least, most](const std::string& text) -> std::string {
    Number number;
    if (CLI::detail::lexical_cast(text, number) && number >= least && number <= most) return {};
    std::string range = "needs a number from " + CLI::detail::to_string(least);
    if (most < std::numeric_limits<Number>::max()) range += " to " + CLI::detail::to_string(most);
    return range + (most < std::numeric_limits<Number>::max() ? "" : " up") + ", not " + text;
  };
  return parser.add_option(flag, value, meaning)
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Validator(within, ""));
}

/// --components, --min-size, --wrap, --wrap-gap, --least-sheet, --least-handle
/// and --merge-overlapping.
void add_repair(CLI::App& parser, RepairOptions& options);

/// --preset, which sets `repair` and `options` before any other option does, wherever it stands on
/// the command line. To be added before the others: options take effect in the order of their
/// adding.
void add_preset(CLI::App& parser, Preset& preset, RepairOptions& repair, ExtractOptions& options);

/// --surgery and --embed.
void add_surgery(CLI::App& parser, ExtractOptions& options);

/// MESH, the surface file.
void add_mesh(CLI::App& parser, std::filesystem::path& mesh);

/// --threads.
void add_threads(CLI::App& parser, int& threads);

/// --time-limit, in seconds; 0 = none.
void add_time_limit(CLI::App& parser, double& seconds);

/// --vrm-name, --vrm-author and --vrm-licence.
void add_vrm_meta(CLI::App& parser, VrmMeta& meta);

}  // namespace curveskel
