// The extension module curveskel._core: values and functions without convenience, which the
// package's Python code adds.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <optional>
#include <regex>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/write_file.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/evaluate_repaired.hpp>
#include <curveskel/labelled_surface.hpp>
#include <curveskel/levels.hpp>
#include <curveskel/match.hpp>
#include <curveskel/skeleton_files.hpp>
#include <curveskel/threads.hpp>
#include "app/compare_skeletons.hpp"
#include "app/kernel_cache.hpp"
#include "app/report.hpp"
#include "app/skeleton_levels.hpp"
#include "python/background_work.hpp"
#include "python/extraction.hpp"
#include "python/options.hpp"
#include "python/rigging.hpp"
#include "python/surfaces.hpp"
#include "python/tables.hpp"
#include "python/views.hpp"

namespace curveskel {
namespace {

namespace py = pybind11;

/// The names of the classes in curveskel.errors, each with the program's exit status.
const char* class_of(Fault fault) {
  switch (fault) {
    case Fault::usage:
      return "UsageError";
    case Fault::input:
      return "InputError";
    case Fault::device:
      return "DeviceError";
    case Fault::solver:
      return "SolverError";
    case Fault::output:
      return "OutputError";
  }
  return "Error";
}

/// "min_size" of "--min-size", anywhere; "curveskel.rig(joints=...)" of "curveskel rig --joints".
std::string with_keywords(const std::string& text) {
  static const std::regex call("curveskel ([a-z]+) (--[a-z-]+)");
  const std::string message = std::regex_replace(text, call, "curveskel.$1($2=...)");
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  std::string found;
  bool in_option = false;
  for (std::size_t k = 0; k < message.size(); ++k) {
    const bool starts = message.compare(k, 2, "--") == 0 && k + 2 < message.size() &&
                        is_letter(message[k + 2]) && (k == 0 || message[k - 1] != '-');
    if (starts) {
      in_option = true;
      ++k;
      continue;
    }
    const bool joins = message[k] == '-' && k + 1 < message.size() && is_letter(message[k + 1]);
    in_option = in_option && (joins || is_letter(message[k]));
    found += in_option && joins ? '_' : message[k];
  }
  return found;
}

/// "detail is 2, ..." of "EmbedOptions::detail is 2, ..."; keywords that are called as members are
/// but for these.
std::string in_python(const std::string& message) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 2> keywords{
      {{"RepairOptions::least_area", "min_size"},
       {"ContractionOptions::max_iterations", "iterations"}}};
  for (const auto& [member, keyword] : keywords) {
    if (message.starts_with(member)) return std::string(keyword) + message.substr(member.size());
  }
  const std::size_t colons = message.find("Options::");
  const bool is_first = colons != std::string::npos && message.find(' ') > colons;
  return is_first ? message.substr(colons + std::string_view("Options::").size()) : message;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11's signature
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error& error) {
    const py::object type = py::module_::import("curveskel.errors").attr(class_of(error.fault()));
    PyErr_SetString(type.ptr(), with_keywords(in_python(error.what())).c_str());
  }
}

using Integers = Eigen::Matrix<std::int64_t, Eigen::Dynamic, 1>;

/// The corners of all polygons and where each begins, as arrays: lists would box each number.
std::pair<Eigen::VectorXi, Integers> polygons_of(const PolygonSoup& soup) {
  const auto corners = static_cast<Eigen::Index>(soup.corners.size());
  const auto offsets = static_cast<Eigen::Index>(soup.offsets.size());
  return {Eigen::Map<const Eigen::VectorXi>(soup.corners.data(), corners),
          Eigen::Map<const Integers>(soup.offsets.data(), offsets)};
}

/// Face f has the corners corners[offsets[f]] .. corners[offsets[f + 1] - 1]. As of a file,
/// vertices with NaN or infinity lose their faces.
PolygonSoup soup_of_arrays(const Positions& positions, const Eigen::Ref<const Integers>& corners,
                           const Eigen::Ref<const Integers>& offsets) {
  PolygonSoup soup;
  soup.positions = positions;
  soup.offsets.assign(offsets.begin(), offsets.end());
  soup.corners.reserve(static_cast<std::size_t>(corners.size()));
  for (std::size_t f = 0; f + 1 < soup.offsets.size(); ++f) {
    for (std::int64_t k = soup.offsets[f]; k < soup.offsets[f + 1]; ++k) {
      const std::int64_t vertex = corners[k];
      if (vertex < 0 || vertex >= positions.rows()) {
        throw Error(Fault::input, "face " + std::to_string(f) + ": found vertex " +
                                      std::to_string(vertex) + ", needed 0 to " +
                                      std::to_string(positions.rows() - 1));
      }
      soup.corners.push_back(static_cast<std::int32_t>(vertex));
    }
  }
  drop_unplaced_vertices(soup);
  return soup;
}

PolygonSoup read_file(const std::filesystem::path& path, bool as_bound,
                      const py::object& listener) {
  PolygonSoup soup;
  run_beside_interpreter(
      listener, [&](const Monitor& monitor) { soup = read_polygons(path, monitor, {as_bound}); });
  return soup;
}

CurveSkeleton read_skeleton_file(const std::filesystem::path& path) {
  const py::gil_scoped_release others_may_run;
  return read_skeleton(path);
}

CurveSkeleton skeleton_of_arrays(const Positions& nodes,
                                 const py::array_t<std::int64_t>& node_pairs) {
  if (node_pairs.ndim() != 2 || node_pairs.shape(1) != 2) {
    throw Error(Fault::usage, "edges: needs an array of shape (m, 2)");
  }
  const auto pairs = node_pairs.unchecked<2>();
  std::set<std::pair<std::int32_t, std::int32_t>> edges;  // as described at Edges
  for (py::ssize_t e = 0; e < pairs.shape(0); ++e) {
    const auto [a, b] = std::minmax({pairs(e, 0), pairs(e, 1)});
    if (a < 0 || b >= nodes.rows() || a == b) {
      throw Error(Fault::input, "edge " + std::to_string(e) + ": found nodes " + std::to_string(a) +
                                    " and " + std::to_string(b) +
                                    ", needed two different ones of " +
                                    std::to_string(nodes.rows()));
    }
    edges.emplace(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
  }
  CurveSkeleton skeleton;
  skeleton.nodes = nodes;
  skeleton.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [a, b] : edges) skeleton.edges.row(row++) << a, b;
  return skeleton;
}

ExtractSettings settings_of(const py::dict& options) {
  ExtractSettings settings;
  ExtractOptions& extract = settings.extract;
  extract.fair.iterations = 0;
  if (options.contains("preset")) {
    set_options(py::dict(py::arg("preset") = options["preset"]),
                {{"preset", sets(settings.preset, "preset", presets)}});
    use_preset(settings.preset, settings.repair, extract);
  }
  extract.contraction.program_cache = kernel_cache();
  extract.fair.program_cache = kernel_cache();
  OptionSetters setters = repair_setters(settings.repair);
  setters.merge(extract_setters(extract));
  setters["threads"] = sets(extract.threads);
  setters["preset"] = [](const py::handle&) {};  // is set already, as others change what it sets
  set_options(options, setters);
  extract.fairing = extract.fair.iterations > 0;
  require_valid_keywords(extract);
  require_together(settings.repair);
  return settings;
}

PythonExtraction extract_in_background(PolygonSoup soup, const py::dict& options,
                                       const py::object& listener) {
  const ExtractSettings settings = settings_of(options);
  PythonExtraction result;
  run_beside_interpreter(listener, [&](const Monitor& monitor) {
    result = extract_soup(std::move(soup), settings, monitor);
  });
  return result;
}

SkeletonFormat format_named(const std::string& name, const std::filesystem::path& output) {
  const auto format = choice_of(skeleton_formats, name);
  if (format) return *format;
  throw Error(Fault::usage,
              output.string() + ": the extension is none of: " + names_in(skeleton_formats));
}

void save_extraction(const PythonExtraction& extraction, const std::filesystem::path& output,
                     const std::string& format) {
  const py::gil_scoped_release others_may_run;
  write_file(output, format_extraction(extraction, format_named(format, output)));
}

void save_skeleton(const CurveSkeleton& skeleton, const std::filesystem::path& output,
                   const std::string& format) {
  const py::gil_scoped_release others_may_run;
  SkeletonContext context;
  context.provenance = program_and_version();
  write_file(output, format_skeleton(skeleton, format_named(format, output), context));
}

void save_labelled(const PythonExtraction& extraction, const std::filesystem::path& output,
                   const std::string& format) {
  const py::gil_scoped_release others_may_run;
  const auto chosen = choice_of(labelled_formats, format);
  if (!chosen) {
    throw Error(Fault::usage,
                output.string() + ": the extension is none of: " + names_in(labelled_formats));
  }
  const BranchLabels labels =
      labels_of_input(extraction.soup, extraction.repaired, extraction.extraction.skeleton);
  write_file(output,
             format_labelled_surface(extraction.soup, labels, *chosen, provenance_of(extraction)));
}

std::string picture(const PythonExtraction& extraction) {
  const py::gil_scoped_release others_may_run;
  return format_extraction(extraction, SkeletonFormat::svg);
}

py::dict dictionary_of(const Certificate& certificate) {
  py::dict values;
  values["components"] = certificate.components;
  values["components_of_surface"] = certificate.components_of_surface;
  values["components_without_curve"] = certificate.components_without_curve;
  values["cycle_rank"] = certificate.cycle_rank;
  values["genus"] = certificate.genus;
  values["homology_rank"] = certificate.homology_rank;
  values["topology_correct"] = certificate.topology_correct();
  values["inside_fraction"] = certificate.inside_fraction;
  values["inside_enough"] = certificate.inside_enough;
  values["deepest_exit"] = certificate.deepest_exit;
  values["centredness_median"] = certificate.centredness_median;
  values["centredness_p90"] = certificate.centredness_p90;
  values["coverage"] = certificate.coverage;
  values["tube_share"] = certificate.tube_share;
  values["curve_like"] = certificate.curve_like;
  values["reach"] = certificate.reach;
  values["reach_at_tips"] = certificate.reach_at_tips;
  values["reaches_ends"] = certificate.reaches_ends();
  values["length"] = certificate.length;
  values["tips"] = certificate.tips;
  values["junctions"] = certificate.junctions;
  values["spurs"] = certificate.spurs;
  values["total_curvature"] = certificate.total_curvature;
  values["wrap_followed"] = certificate.wrap_followed;
  values["wrap_follows"] = certificate.wrap_follows();
  values["holds"] = certificate.holds();
  return values;
}

std::vector<std::vector<int>> nodes_of_branches(const CurveSkeleton& skeleton) {
  std::vector<std::vector<int>> nodes;
  for (Branch& branch : branches(skeleton)) nodes.push_back(std::move(branch.nodes));
  return nodes;
}

py::dict dictionary_of(const CommonGround::Side& side) {
  return py::dict(py::arg("share_of_length") = side.share,
                  py::arg("centredness_median") = side.centredness_median);
}

py::dict dictionary_of(const SkeletonComparison& comparison) {
  py::dict both;
  both["this"] = dictionary_of(comparison.common_ground.a);
  both["other"] = dictionary_of(comparison.common_ground.b);
  return py::dict(py::arg("hausdorff_distance") = comparison.hausdorff_distance,
                  py::arg("mean_distance") = comparison.mean_distance,
                  py::arg("where_both_run") = both);
}

/// As `curveskel evaluate` does.
py::dict evaluate_in_background(const PolygonSoup& soup, const CurveSkeleton& skeleton,
                                const std::optional<CurveSkeleton>& against,
                                const py::dict& options, const py::object& listener) {
  RepairOptions as_repaired;
  CertificateOptions certificate;
  OptionSetters setters = repair_setters(as_repaired);
  setters["threads"] = sets(certificate.threads);
  set_options(options, setters);
  require_together(as_repaired);
  RepairedEvaluation found;
  SkeletonComparison comparison;
  run_beside_interpreter(listener, [&](const Monitor& monitor) {
    RepairedSurface repaired = repair(soup, as_repaired, monitor, certificate.threads);
    found = evaluate_repaired(repaired, as_repaired, skeleton, certificate, monitor);
    if (found.repaired_again) repaired = std::move(*found.repaired_again);
    if (!against) return;
    comparison = compare_skeletons(skeleton, *against, repaired.surface, certificate, monitor);
  });
  py::dict values = dictionary_of(found.certificate);
  if (against) values["against"] = dictionary_of(comparison);
  return values;
}

py::dict dictionary_of(const SurfaceSize& size) {
  return py::dict(py::arg("vertices") = size.vertices, py::arg("triangles") = size.triangles,
                  py::arg("components") = size.components, py::arg("genus") = size.genus,
                  py::arg("diagonal") = size.diagonal, py::arg("area") = size.area,
                  py::arg("volume") = size.volume);
}

py::dict dictionary_of(const SkeletonLevel& level) {
  return py::dict(py::arg("number") = level.number, py::arg("of") = level.of,
                  py::arg("least_life") = level.least_life);
}

std::vector<PythonExtraction> levels_in_background(const PythonExtraction& extraction, int most,
                                                   const py::object& listener) {
  std::vector<PythonExtraction> levels;
  run_beside_interpreter(
      listener, [&](const Monitor& monitor) { levels = levels_of(extraction, most, monitor); });
  return levels;
}

std::vector<CurveSkeleton> levels_of_graph(const CurveSkeleton& skeleton, int most) {
  std::vector<CurveSkeleton> levels;
  for (const double limit : level_limits(skeleton, most)) {
    levels.push_back(level_of(skeleton, limit));
  }
  return levels;
}

/// Branch pairs as columns, junctions as pairs of nodes, vertices of b by those of a, and whether
/// these told the branches.
py::tuple match_in_background(const PythonExtraction& a, const PythonExtraction& b, bool by_shape,
                              int threads, const py::object& listener) {
  InputMatch found;
  run_beside_interpreter(listener, [&](const Monitor& monitor) {
    found = match_inputs({a.soup, a.repaired, a.extraction.skeleton},
                         {b.soup, b.repaired, b.extraction.skeleton}, {threads, by_shape}, monitor);
  });
  const SkeletonMatch& match = found.match;
  py::list of_a;
  py::list of_b;
  py::list reversed;
  py::list ambiguous;
  for (const BranchPair& pair : match.branches) {
    of_a.append(pair.a);
    of_b.append(pair.b);
    reversed.append(pair.reversed);
    ambiguous.append(pair.ambiguous);
  }
  py::dict table;
  table["a"] = of_a;
  table["b"] = of_b;
  table["reversed"] = reversed;
  table["ambiguous"] = ambiguous;
  return py::make_tuple(table, match.junctions, std::move(found.vertex_of_a), found.by_vertices);
}

/// The surface as given and as repaired, and the skeleton in it.
void bind_shapes(py::class_<PythonExtraction>& bound) {
  using Owner = PythonExtraction;
  bound
      .def_property_readonly("skeleton",
                             view_of([](const Owner& one) -> const auto& { return one.skeleton; }))
      .def_property_readonly("positions", view_of([](const Owner& one) -> const auto& {
                               return one.repaired.surface.positions;
                             }))
      .def_property_readonly("triangles", view_of([](const Owner& one) -> const auto& {
                               return one.repaired.surface.triangles;
                             }))
      .def_property_readonly("given_positions", view_of([](const Owner& one) -> const auto& {
                               return one.soup.positions;
                             }))
      .def_property_readonly("given_polygons",
                             [](const Owner& one) { return polygons_of(one.soup); })
      .def_property_readonly("vertex_of_input", view_of([](const Owner& one) -> const auto& {
                               return one.repaired.vertex_of_input;
                             }));
}

/// The verdict, with the changes and warnings that the program's summary has.
void bind_verdict(py::class_<PythonExtraction>& bound) {
  using Owner = PythonExtraction;
  bound
      .def_property_readonly("changes",
                             [](const Owner& one) {
                               std::vector<std::string> lines = one.repaired.changes.lines;
                               const auto& more = one.repaired.repairs.lines;
                               lines.insert(lines.end(), more.begin(), more.end());
                               return lines;
                             })
      .def_property_readonly("notes", [](const Owner& one) { return one.notes; })
      .def_property_readonly("shortcomings", &shortcomings)
      .def_property_readonly("findings",
                             [](const Owner& one) {
                               std::vector<std::string> findings;
                               if (auto idle = detail_finding(one.settings.extract.embed)) {
                                 findings.push_back(std::move(*idle));
                               }
                               return findings;
                             })
      .def_property_readonly(
          "certificate", [](const Owner& one) { return dictionary_of(one.extraction.certificate); })
      .def_property_readonly("correct",
                             [](const Owner& one) { return one.extraction.certificate.correct(); })
      .def_property_readonly("holds",
                             [](const Owner& one) { return one.extraction.certificate.holds(); })
      .def_property_readonly(
          "surface",
          [](const Owner& one) {
            return dictionary_of(size_of(one.repaired.surface, one.extraction.certificate));
          })
      .def_property_readonly("level", [](const Owner& one) { return dictionary_of(one.level); });
}

void bind_tables_and_files(py::class_<PythonExtraction>& bound) {
  using Owner = PythonExtraction;
  bound.def("levels", &levels_in_background)
      .def("picture", &picture)
      .def("branch_table",
           [](const Owner& one, int root) { return branch_table(one.skeleton, &one, root); })
      .def("profiles",
           [](const Owner& one, double spacing, int threads, const py::object& listener) {
             return profile_table(one, spacing, threads, listener);
           })
      .def("labels",
           [](const Owner& one) {
             BranchLabels labels = labels_of_input(one.soup, one.repaired, one.extraction.skeleton);
             return std::pair(std::move(labels.of_vertex), std::move(labels.of_polygon));
           })
      .def("save_labelled", &save_labelled)
      .def("save_page",
           [](const Owner& one, const std::filesystem::path& output) {
             const py::gil_scoped_release others_may_run;
             write_file(output, page_of(one));
           })
      .def("save", &save_extraction);
}

void bind_extraction(py::module_& module) {
  py::class_<PythonExtraction> bound(module, "Extraction");
  bind_shapes(bound);
  bind_verdict(bound);
  bind_tables_and_files(bound);
}

void bind_skeleton(py::module_& module) {
  using Owner = CurveSkeleton;
  py::class_<Owner>(module, "CurveSkeleton")
      .def_property_readonly("nodes",
                             view_of([](const Owner& one) -> const auto& { return one.nodes; }))
      .def_property_readonly("edges",
                             view_of([](const Owner& one) -> const auto& { return one.edges; }))
      .def_property_readonly("radii",
                             view_of([](const Owner& one) -> const auto& { return one.radii; }))
      .def_property_readonly("lives",
                             view_of([](const Owner& one) -> const auto& { return one.lives; }))
      .def_property_readonly("node_of_vertex", view_of([](const Owner& one) -> const auto& {
                               return one.node_of_vertex;
                             }))
      .def(py::pickle(
          [](const Owner& one) {
            return py::make_tuple(one.nodes, one.edges, one.radii, one.lives, one.node_of_vertex);
          },
          [](const py::tuple& state) {
            return Owner{.nodes = state[0].cast<Positions>(),
                         .edges = state[1].cast<Edges>(),
                         .radii = state[2].cast<Eigen::VectorXd>(),
                         .node_of_vertex = state[4].cast<Eigen::VectorXi>(),
                         .lives = state[3].cast<Eigen::VectorXd>()};
          }))
      .def("branches", &nodes_of_branches)
      .def("levels", &levels_of_graph)
      .def("branch_table",
           [](const Owner& one, int root) { return branch_table(one, nullptr, root); })
      .def("junction_table", &junction_table);
}

}  // namespace
}  // namespace curveskel

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  using namespace curveskel;
  py::register_exception_translator(&translate);
  py::class_<PolygonSoup>(module, "PolygonSoup")
      .def_property_readonly(
          "positions", view_of([](const PolygonSoup& one) -> const auto& { return one.positions; }))
      .def_property_readonly("polygons", &polygons_of);
  bind_skeleton(module);
  bind_extraction(module);
  module.attr("most_threads") = most_threads;
  module.def("program_and_version", &program_and_version);
  module.def("soup_of_arrays", &soup_of_arrays);
  module.def("read_surface", &read_file);
  module.def("read_skeleton", &read_skeleton_file);
  module.def("save_skeleton", &save_skeleton);
  module.def("evaluate", &evaluate_in_background);
  module.def("skeleton_of_arrays", &skeleton_of_arrays);
  module.def("extract", &extract_in_background);
  module.def("match", &match_in_background);
  module.def("fair", &fair_soup);
  module.def("contract", &contract_soup);
  bind_rig(module);
}
