#include "python/options.hpp"

#include <fmt/core.h>

#include <string>
#include <string_view>

namespace curveskel {

namespace py = pybind11;

void set_options(const py::dict& options, const OptionSetters& setters) {
  for (const auto& [key, value] : options) {
    const auto name = key.cast<std::string>();
    const auto setter = setters.find(name);
    if (setter == setters.end()) {
      std::string known;
      for (const auto& [other, set] : setters) {
        known += known.empty() ? "" : ", ";
        known += other;
      }
      if (name.starts_with("no_") && setters.contains(name.substr(3))) {
        throw Error(Fault::usage, fmt::format("{} is none of the options, needed {}=False instead",
                                              name, name.substr(3)));
      }
      throw Error(Fault::usage, fmt::format("{} is none of the options: {}", name, known));
    }
    try {
      setter->second(value);
    } catch (const NeededInstead& other) {
      throw Error(Fault::usage, fmt::format("{}: needs {}, not {}", name, other.needed,
                                            py::repr(value).cast<std::string>()));
    }
  }
}

OptionSetters repair_setters(RepairOptions& options) {
  const auto set_components = [&options](const py::handle& value) {
    const bool is_word = py::isinstance<py::str>(value);
    const auto word = is_word ? value.cast<std::string>() : std::string();
    const char* const needed = "a whole number from 1 up, \"largest\" or \"all\"";
    options.components = word == "all" ? 0 : word == "largest" ? 1 : option_of<int>(value, needed);
    if (options.components < 1 && word != "all") throw NeededInstead{needed};
  };
  return {{"components", set_components},
          {"least_handle", sets(options.least_handle)},
          {"least_sheet", sets(options.least_sheet)},
          {"merge_overlapping", sets(options.merge_overlapping)},
          {"min_size", sets(options.least_area)},
          {"wrap", sets(options.wrap, "wrap", wrappings)},
          {"wrap_gap", sets(options.wrap_gap)}};
}

OptionSetters extract_setters(ExtractOptions& options) {
  const auto set_resolution = [&options](const py::handle& value) {
    const bool is_full = py::isinstance<py::str>(value) && value.cast<std::string>() == "full";
    options.resolution = is_full ? 0 : option_of<int>(value, "a whole number or \"full\"");
    if (!is_full && options.resolution < options.least_resolution) {
      throw Error(
          Fault::usage,
          fmt::format("resolution: needs \"full\" or a number of vertices from {} up, not {}",
                      options.least_resolution, options.resolution));
    }
  };
  return {{"detail", sets(options.embed.detail)},
          {"fair", sets(options.fair.iterations)},
          {"flow", sets(options.contraction.flow, "flow", flows)},
          {"embed", sets(options.embed.method, "embed", embed_methods)},
          {"resolution", set_resolution},
          {"solver", sets(options.contraction.solver, "solver", solvers)},
          {"surgery", sets(options.surgery.method, "surgery", surgery_methods)}};
}

void require_valid_keywords(const ExtractOptions& options) {
  try {
    require_valid(options);
  } catch (const Error& error) {
    const std::string_view member = "FairOptions::iterations";
    const std::string message = error.what();
    if (!message.starts_with(member)) throw;
    throw Error(error.fault(), "fair" + message.substr(member.size()));
  }
}

void require_program_range(const char* keyword, double value, double least, double most) {
  if (value >= least && value <= most) return;
  throw Error(Fault::usage,
              fmt::format("{} is {:.7g}, needed {:.7g}..{:.7g}", keyword, value, least, most));
}

void require_together(const RepairOptions& options) {
  require_valid(options);
  if (options.wrap == Wrapping::never && options.wrap_gap > 0) {
    throw Error(Fault::usage, "wrap_gap needs a wrap, so not wrap=\"never\"");
  }
}

}  // namespace curveskel
