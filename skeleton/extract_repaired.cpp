#include "skeleton/extract_repaired.hpp"

#include <chrono>
#include <utility>
#include <vector>

#include "skeleton/certificate.hpp"
#include "surface/element_index.hpp"
#include "surface/measures.hpp"
#include "surface/topology.hpp"
#include "surface/tree.hpp"
#include "surface/wrap_components.hpp"
#include "surface/wrap_solid.hpp"

namespace curveskel {
namespace {

bool holds(const Certificate& certificate) {
  return certificate.topology_correct() && certificate.inside_enough;
}

/// What of a skeleton belongs to each component of its surface, without radii and map.
std::vector<CurveSkeleton> divided(const CurveSkeleton& skeleton, const std::vector<int>& owner,
                                   int components) {
  std::vector<std::vector<int>> nodes(at(components));
  std::vector<std::vector<int>> edges(at(components));
  std::vector<std::int32_t> number(owner.size(), -1);
  for (std::size_t node = 0; node < owner.size(); ++node) {
    if (owner[node] < 0) continue;
    auto& own = nodes[at(owner[node])];
    number[node] = static_cast<std::int32_t>(own.size());
    own.push_back(static_cast<int>(node));
  }
  for (int e = 0; e < skeleton.edges.rows(); ++e) {
    const int component = owner[at(skeleton.edges(e, 0))];
    if (component >= 0) edges[at(component)].push_back(e);
  }
  std::vector<CurveSkeleton> parts(at(components));
  for (std::size_t c = 0; c < parts.size(); ++c) {
    parts[c].nodes = skeleton.nodes(nodes[c], Eigen::all);
    parts[c].edges = skeleton.edges(edges[c], Eigen::all);
    for (std::int32_t& node : parts[c].edges.reshaped()) node = number[at(node)];
    parts[c].radii.setZero(parts[c].nodes.rows());
  }
  return parts;
}

/// Which component of the surface each node belongs to.
std::vector<int> owner_of_node(const CurveSkeleton& skeleton, const Topology& counted) {
  const std::vector<int> piece = component_of_node(skeleton);
  std::vector<int> of_piece(piece.size(), -1);
  for (Eigen::Index v = 0; v < skeleton.node_of_vertex.size(); ++v) {
    const int node = skeleton.node_of_vertex[v];
    if (node >= 0) of_piece[at(piece[at(node)])] = counted.component_of_vertex[v];
  }
  std::vector<int> owner(piece.size());
  for (std::size_t node = 0; node < owner.size(); ++node) owner[node] = of_piece[at(piece[node])];
  return owner;
}

/// The components whose own certificate fails.
std::vector<int> failing_components(const Surface& surface, const CurveSkeleton& skeleton,
                                    const CertificateOptions& options, const Monitor& monitor) {
  const Topology counted = topology(surface);
  if (counted.components() == 1) return {0};
  const double diagonal = bounding_box_diagonal(surface.positions);
  const auto parts = split_components(surface, counted);
  const auto curves = divided(skeleton, owner_of_node(skeleton, counted), counted.components());
  std::vector<int> failing;
  for (int c = 0; c < counted.components(); ++c) {
    const Surface& part = parts[at(c)].surface;
    const Certificate own = evaluate({part, SurfaceTree(part), diagonal, 1, counted.genus[at(c)]},
                                     curves[at(c)], options, monitor);
    if (!holds(own)) failing.push_back(c);
  }
  return failing;
}

/// From wraps of these components, if the certificate holds.
std::optional<RepairedExtraction> extracted_from_wraps(const RepairedSurface& repaired,
                                                       const std::vector<int>& components,
                                                       double opening, ExtractOptions options,
                                                       const Monitor& monitor) {
  try {
    auto wrapped = wrap_components(repaired, components, opening, monitor);
    if (!wrapped) return std::nullopt;
    options.openings = wrapped->openings;
    options.fair_if_outside = options.all_vertices_if_failed = false;
    RepairedExtraction found{extract(wrapped->surface, options, monitor), std::move(wrapped)};
    if (holds(found.extraction.certificate)) return found;
  } catch (const Error&) {  // too large to be wrapped, or too thin to be contracted
  }
  return std::nullopt;
}

/// Whether one has the genus and the other has not, or else one explains more of its surface: a
/// wrap that goes round every spike of noise is mostly spikes.
bool better(const Certificate& wider, const Certificate& narrower, int genus) {
  if ((wider.genus == genus) != (narrower.genus == genus)) return wider.genus == genus;
  constexpr double clearly = 0.05;  // of the vertices
  return wider.coverage > narrower.coverage + clearly;
}

/// The best that wraps of what fails give, from narrow to wide, if any has a certificate that
/// holds.
std::optional<RepairedExtraction> best_from_wraps(const RepairedSurface& repaired,
                                                  const RepairOptions& as_repaired,
                                                  const Extraction& failed,
                                                  const ExtractOptions& options,
                                                  const Monitor& monitor) {
  Monitor silent = monitor;  // what comes to nothing is not said
  silent.note = nullptr;
  const auto failing =
      failing_components(repaired.surface, failed.skeleton, options.certificate, silent);
  if (failing.empty()) return std::nullopt;  // what fails is between them
  if (as_repaired.wrap_opening > 0) {
    return extracted_from_wraps(repaired, failing, as_repaired.wrap_opening, options, silent);
  }
  std::optional<RepairedExtraction> best;
  for (const double opening : wrap_openings) {
    auto found = extracted_from_wraps(repaired, failing, opening, options, silent);
    if (found && (!best || better(found->extraction.certificate, best->extraction.certificate,
                                  failed.certificate.genus))) {
      best = std::move(found);
    }
  }
  return best;
}

RepairedExtraction wrapped_if_failed(const RepairedSurface& repaired,
                                     const RepairOptions& as_repaired, Extraction extraction,
                                     const ExtractOptions& options, const Monitor& monitor) {
  if (holds(extraction.certificate) || as_repaired.wrap != Wrapping::needed) {
    return {std::move(extraction), std::nullopt};
  }
  const auto start = std::chrono::steady_clock::now();
  auto found = best_from_wraps(repaired, as_repaired, extraction, options, monitor);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  extraction.times.push_back({"wrap", taken.count()});
  if (!found) return {std::move(extraction), std::nullopt};
  monitor.say(
      "the certificate failed, so what it fails for was wrapped, and the skeleton extracted "
      "again from the wrap");
  found->extraction.times = std::move(extraction.times);
  return std::move(*found);
}

ExtractOptions with_openings(ExtractOptions options, const RepairedSurface& repaired) {
  options.openings = repaired.openings;
  return options;
}

}  // namespace

RepairedExtraction extract_repaired(const RepairedSurface& repaired,
                                    const RepairOptions& as_repaired, const ExtractOptions& options,
                                    const Monitor& monitor) {
  return wrapped_if_failed(repaired, as_repaired,
                           extract(repaired.surface, with_openings(options, repaired), monitor),
                           options, monitor);
}

RepairedExtraction extract_repaired(const RepairedSurface& repaired,
                                    const RepairOptions& as_repaired, const ExtractOptions& options,
                                    const Monitor& monitor, ExtractionCache& cache) {
  return wrapped_if_failed(
      repaired, as_repaired,
      extract(repaired.surface, with_openings(options, repaired), monitor, cache), options,
      monitor);
}

}  // namespace curveskel
