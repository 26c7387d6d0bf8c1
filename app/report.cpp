#include "app/report.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include <curveskel/advanced/measures.hpp>

namespace curveskel {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Certificate& c) {
  return {{"holds", c.holds()},
          {"topology_correct", c.topology_correct()},
          {"inside_enough", c.inside_enough},
          {"reaches_ends", c.reaches_ends()},
          {"curve_like", c.curve_like},
          {"tube_share", c.tube_share},
          {"wrap_follows", c.wrap_follows()},
          {"wrap_followed", c.wrap_followed},
          {"components", c.components},
          {"components_of_surface", c.components_of_surface},
          {"components_without_curve", c.components_without_curve},
          {"cycle_rank", c.cycle_rank},
          {"genus", c.genus},
          {"homology_rank", c.homology_rank},
          {"inside_fraction", c.inside_fraction},
          {"deepest_exit", c.deepest_exit},
          {"centredness_median", c.centredness_median},
          {"centredness_p90", c.centredness_p90},
          {"coverage", c.coverage},
          {"reach", c.reach},
          {"reach_at_tips", c.reach_at_tips},
          {"spurs", c.spurs},
          {"tips", c.tips},
          {"junctions", c.junctions},
          {"length", c.length},
          {"total_curvature", c.total_curvature}};
}

Json to_json(const CertificateOptions& o) {
  return {
      {"sample_spacing", o.sample_spacing}, {"inside_needed", o.inside_needed}, {"rays", o.rays}};
}

Json to_json(const Changes& c) {
  return {{"unplaced_vertices_dropped", c.unplaced_vertices_dropped},
          {"unplaced_polygons_dropped", c.unplaced_polygons_dropped},
          {"polygons_triangulated", c.polygons_triangulated},
          {"vertices_merged", c.vertices_merged},
          {"duplicate_faces_dropped", c.duplicate_faces_dropped},
          {"degenerate_faces_dropped", c.degenerate_faces_dropped},
          {"isolated_vertices_dropped", c.isolated_vertices_dropped},
          {"vertices_split_off", c.vertices_split_off},
          {"faces_flipped", c.faces_flipped},
          {"components_turned", c.components_turned},
          {"lines", c.lines}};
}

/// null where it was not asked for.
Json to_json(const Merging& m) {
  if (m.components == 0) return nullptr;
  Json covered = Json::array();
  for (const auto& one : m.covered) {
    covered.push_back({{"component", one.component}, {"inside", one.inside}});
  }
  Json apart = Json::array();
  for (const auto& one : m.apart) {
    apart.push_back({{"component", one.component}, {"other", one.other}, {"why", one.why}});
  }
  return {{"components", m.components},           {"bodies", m.bodies},
          {"covered", std::move(covered)},        {"apart", std::move(apart)},
          {"cavities_filled", m.cavities_filled}, {"handles_made", m.handles_made}};
}

Json to_json(const Repairs& r) {
  return {{"vertices_joined", r.vertices_joined},
          {"edges_split", r.edges_split},
          {"vertices_copied", r.vertices_copied},
          {"holes_closed", r.holes_closed},
          {"longest_hole", r.longest_hole},
          {"holes_narrowed", r.holes_narrowed},
          {"faces_added", r.faces_added},
          {"vertices_added", r.vertices_added},
          {"copies_dropped", r.copies_dropped},
          {"crumbs_dropped", r.crumbs_dropped},
          {"specks_dropped", r.specks_dropped},
          {"sheets_dropped", r.sheets_dropped},
          {"sheets_thickened", r.sheets_thickened},
          {"handles_cut", r.handles_cut},
          {"longest_handle_loop", r.longest_handle_loop},
          {"not_chosen", r.not_chosen},
          {"faces_wrapped", r.faces_wrapped},
          {"wrapped_as_asked", r.wrapped_as_asked},
          {"components_wrapped", r.components_wrapped},
          {"wrap_gap", r.wrap_gap},
          {"wrap_distance", r.wrap_distance},
          {"wrap_mean_distance", r.wrap_mean_distance},
          {"wrap_followed", r.wrap_followed},
          {"merging", to_json(r.merging)},
          {"lines", r.lines}};
}

Json to_json(const RepairOptions& o) {
  return {{"join_distance", o.join_distance}, {"least_area", o.least_area},
          {"components", o.components},       {"most_added_area", o.most_added_area},
          {"least_crumb", o.least_crumb},     {"wrap", name_of(wrappings, o.wrap)},
          {"wrap_gap", o.wrap_gap},           {"merge_overlapping", o.merge_overlapping},
          {"least_sheet", o.least_sheet},     {"least_handle", o.least_handle}};
}

Json to_json(const ContractionOptions& o) {
  return {{"flow", name_of(flows, o.flow)},
          {"solver", name_of(solvers, o.solver)},
          {"max_iterations", o.max_iterations},
          {"contraction_weight", o.contraction_weight},
          {"contraction_growth", o.contraction_growth},
          {"medial_weight", o.medial_weight},
          {"paper_weight", o.paper_weight},
          {"attraction_weight", o.attraction_weight},
          {"collapse_length", o.collapse_length},
          {"stop_volume_ratio", o.stop_volume_ratio},
          {"stop_area_ratio", o.stop_area_ratio},
          {"small_area_ratio", o.small_area_ratio}};
}

Json to_json(const FairOptions& o) {
  return {{"method", name_of(fair_methods, o.method)},
          {"iterations", o.iterations},
          {"rings", o.rings},
          {"local_solver", name_of(local_solvers, o.local_solver)},
          {"smoothing", o.smoothing},
          {"volume", name_of(volume_rules, o.volume)},
          {"double_precision", o.double_precision}};
}

Json to_json(const ExtractOptions& o) {
  return {{"resolution", o.resolution},
          {"least_resolution", o.least_resolution},
          {"fair_if_outside", o.fair_if_outside},
          {"all_vertices_if_failed", o.all_vertices_if_failed},
          {"fair", o.fairing ? to_json(o.fair) : Json(nullptr)},
          {"contraction", to_json(o.contraction)},
          {"surgery",
           {{"method", name_of(surgery_methods, o.surgery.method)},
            {"shape_weight", o.surgery.shape_weight},
            {"sampling_weight", o.surgery.sampling_weight}}},
          {"embed",
           {{"method", name_of(embed_methods, o.embed.method)},
            {"detail", o.embed.detail},
            {"merge", o.embed.merge},
            {"straight", o.embed.straight},
            {"straight_at_last", o.embed.straight_at_last},
            {"first_rounds", o.embed.first_rounds},
            {"relax_rounds", o.embed.relax_rounds},
            {"smooth_rounds", o.embed.smooth_rounds},
            {"keep_radius", o.embed.keep_radius},
            {"tip_reach", o.embed.tip_reach},
            {"tip_gap", o.embed.tip_gap},
            {"go_below", o.embed.go_below}}},
          {"certificate", to_json(o.certificate)}};
}

Json to_json(const ComponentRecord& c, bool with_times) {
  Json steps = Json::array();
  for (const Step& step : c.steps) {
    steps.push_back({{"area_ratio", step.area_ratio},
                     {"volume_ratio", step.volume_ratio},
                     {"residual", step.residual},
                     {"vertices", step.vertices},
                     {"solver", name_of(solvers, step.solver)},
                     {"solver_iterations", step.solver_iterations}});
    if (with_times) steps.back()["seconds"] = step.seconds;
  }
  return {{"vertices", c.vertices},
          {"working_vertices", c.working_vertices},
          {"genus", c.genus},
          {"inside_component", c.inside_component < 0 ? Json(nullptr) : Json(c.inside_component)},
          {"overlaps", c.overlaps},
          {"stop", name_of(stops, c.stop)},
          {"contraction", std::move(steps)}};
}

Json to_json(const Try& one, bool with_times) {
  Json json = {{"name", one.name},
               {"of", one.component < 0 ? Json("whole surface") : Json(one.component)},
               {"part_of", one.part_of < 0 ? Json(nullptr) : Json(one.part_of)},
               {"why", one.why},
               {"outcome", name_of(outcomes, one.outcome)},
               {"message", one.message},
               {"certificate", nullptr}};
  if (one.certificate) {
    json["certificate"] = {{"topology_correct", one.certificate->topology_correct},
                           {"inside_enough", one.certificate->inside_enough},
                           {"inside_fraction", one.certificate->inside_fraction},
                           {"tips", one.certificate->tips},
                           {"junctions", one.certificate->junctions}};
  }
  if (with_times) json["seconds"] = one.seconds;
  return json;
}

Json to_json(const StageTime& time) {
  Json json = {{"stage", time.stage}, {"seconds", time.seconds}};
  for (const StepTime& step : time.steps) {
    json["steps"].push_back(
        {{"step", step.step}, {"seconds", step.seconds}, {"outside", step.outside}});
  }
  return json;
}

/// Of the surface after repair.
Json to_json(const SurfaceSize& size) {
  return {{"vertices", size.vertices},     {"triangles", size.triangles},
          {"components", size.components}, {"genus", size.genus},
          {"diagonal", size.diagonal},     {"area", size.area},
          {"volume", size.volume}};
}

/// Without the entries of its components and its history, see `text_of`.
Json to_json(const ExtractionRecord& record) {
  Json parameters = {{"preset", name_of(presets, record.preset)},
                     {"repair", to_json(record.repair_options)}};
  parameters.update(to_json(record.options));
  const SkeletonLevel& level = record.level;
  return {{"program", program_and_version()},
          {"input",
           {{"file", record.soup.file.filename().string()},
            {"format", name_of(surface_formats, record.soup.format)},
            {"vertices", record.soup.positions.rows()},
            {"polygons", record.soup.offsets.size() - 1}}},
          {"changes", to_json(record.repaired.changes)},
          {"repairs", to_json(record.repaired.repairs)},
          {"surface", to_json(size_of(record.repaired.surface, record.extraction.certificate))},
          {"parameters", std::move(parameters)},
          {"components", Json::array()},
          {"history", Json::array()},
          {"notes", record.notes},
          {"skeleton",
           {{"nodes", record.extraction.skeleton.nodes.rows()},
            {"edges", record.extraction.skeleton.edges.rows()}}},
          {"level", {{"number", level.number}, {"of", level.of}, {"least_life", level.least_life}}},
          {"certificate", to_json(record.extraction.certificate)}};
}

Json to_json(const JointHits& hits) {
  return {{"hits", hits.hits},
          {"overlap", hits.overlap},
          {"precision", hits.precision},
          {"recall", hits.recall}};
}

Json to_json(const std::optional<PoseDistance>& poses, const std::string& missing) {
  if (!poses) return {{"missing", missing}};
  return {
      {"number", poses->poses}, {"mean_distance", poses->mean_distance}, {"shared", poses->shared}};
}

Json to_json(const std::optional<WeightDifference>& weights, const std::string& missing) {
  if (!weights) return {{"missing", missing}};
  return {{"precision", weights->precision}, {"recall", weights->recall}, {"l1", weights->l1}};
}

/// The number of threads that were allowed.
unsigned threads_of(const ExtractOptions& options) {
  return options.threads > 0 ? static_cast<unsigned>(options.threads)
                             : std::max(1U, std::thread::hardware_concurrency());
}

/// File names need not be UTF-8; other bytes are replaced rather than refused.
std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// Each on a line of its own, and made for it: there may be tens of thousands.
template <typename Entries>
void append_entries(std::string& text, const Entries& entries, bool with_times) {
  text += '[';
  for (std::size_t k = 0; k < entries.size(); ++k) {
    text += k == 0 ? "\n" : ",\n";
    text += text_of(to_json(entries[k], with_times), -1);
  }
  text += ']';
}

/// The members of a record, with the entries of its components and its history.
std::string text_of(const Json& members, const Extraction& extraction, bool with_times) {
  std::string text = "{";
  for (const auto& [name, value] : members.items()) {
    text += text.size() == 1 ? "\n" : ",\n";
    text += text_of(name, -1) + ": ";
    if (name == "components") {
      append_entries(text, extraction.components, with_times);
    } else if (name == "history") {
      append_entries(text, extraction.history, with_times);
    } else {
      text += text_of(value, 1);
    }
  }
  return text + "\n}\n";
}

}  // namespace

SurfaceSize size_of(const Surface& surface, const Certificate& certificate) {
  return {surface.positions.rows(),
          surface.triangles.rows(),
          certificate.components_of_surface,
          certificate.genus,
          bounding_box_diagonal(surface.positions),
          area(surface),
          volume(surface)};
}

std::string program_and_version() { return "curveskel " CURVESKEL_VERSION; }

std::string history_in_lines(const ExtractionRecord& record, const std::string& provenance) {
  std::string text = provenance + "\n";
  if (record.preset != Preset::standard) {
    text += "preset: " + std::string(name_of(presets, record.preset)) + "\n";
  }
  for (const std::string& line : record.repaired.changes.lines) text += "changed: " + line + "\n";
  for (const std::string& line : record.repaired.repairs.lines) text += "repaired: " + line + "\n";
  for (const std::string& line : record.notes) text += line + "\n";
  return text;
}

std::string result_json(const ExtractionRecord& record) {
  return text_of(to_json(record), record.extraction, false);
}

std::string report_json(const ExtractionRecord& record, const RunRecord& run) {
  Json json = to_json(record);
  Json times = Json::array();
  for (const StageTime& time : run.times) times.push_back(to_json(time));
  json["outputs"] = run.outputs;
  json["threads"] = threads_of(record.options);
  json["times"] = std::move(times);
  json["seconds"] = run.seconds;
  json["peak_memory_bytes"] = peak_memory_bytes();
  return text_of(json, record.extraction, true);
}

std::string evaluation_json(const std::string& surface_file, const std::string& skeleton_file,
                            const Evaluation& evaluation) {
  Json json = {{"program", program_and_version()},
               {"surface", surface_file},
               {"skeleton", skeleton_file},
               {"repairs", to_json(evaluation.repairs)},
               {"parameters", to_json(evaluation.options)},
               {"certificate", to_json(evaluation.certificate)}};
  const SkeletonComparison& comparison = evaluation.comparison;
  if (!comparison.against.empty()) {
    const auto side = [](const CommonGround::Side& of) {
      return Json{{"share_of_length", of.share}, {"centredness_median", of.centredness_median}};
    };
    json["against"] = {{"skeleton", comparison.against},
                       {"hausdorff_distance", comparison.hausdorff_distance},
                       {"mean_distance", comparison.mean_distance},
                       {"where_both_run",
                        {{"this", side(comparison.common_ground.a)},
                         {"other", side(comparison.common_ground.b)}}}};
  }
  return text_of(json, 2) + "\n";
}

std::string rig_comparison_json(const std::string& rig_file, const std::string& truth_file,
                                const RigComparison& comparison) {
  const Json json = {{"program", program_and_version()},
                     {"rig", rig_file},
                     {"truth", truth_file},
                     {"joints", comparison.joints},
                     {"truth_joints", comparison.truth_joints},
                     {"joints_to_joints", comparison.joints_to_joints},
                     {"joints_to_bones", comparison.joints_to_bones},
                     {"bones_to_bones", comparison.bones_to_bones},
                     {"root_distance", comparison.root_distance},
                     {"by_thickness", to_json(comparison.by_thickness)},
                     {"by_size", to_json(comparison.by_size)},
                     {"poses", to_json(comparison.poses, comparison.not_posed)},
                     {"weights", to_json(comparison.weights, comparison.not_weighed)}};
  return text_of(json, 2) + "\n";
}

std::size_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace curveskel
