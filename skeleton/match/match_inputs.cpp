#include <curveskel/match.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/branch_territories.hpp>
#include <curveskel/error.hpp>
#include "skeleton/graph/sound_skeleton.hpp"
#include "skeleton/match/branch_overlaps.hpp"
#include "skeleton/match/branch_pairs.hpp"
#include "skeleton/match/component_pairs.hpp"
#include "skeleton/match/motions.hpp"
#include "skeleton/match/tip_pairs.hpp"
#include "skeleton/match/tips.hpp"
#include "surface/repair/sound_soup.hpp"

namespace curveskel {
namespace {

void require_known(const Eigen::VectorXi& vertex_of_a, const MatchSide& a, const MatchSide& b) {
  if (vertex_of_a.size() != a.surface.positions.rows()) {
    throw Error(Fault::input, "matching: " + std::to_string(vertex_of_a.size()) +
                                  " vertices are known, needed " +
                                  std::to_string(a.surface.positions.rows()) + ", all of A");
  }
  if (vertex_of_a.size() == 0) return;
  if (vertex_of_a.minCoeff() < -1 || vertex_of_a.maxCoeff() >= b.surface.positions.rows()) {
    throw Error(Fault::input, "matching: vertices of B must be -1 (none) or 0.." +
                                  std::to_string(b.surface.positions.rows() - 1));
  }
}

Landings known_landings(const Eigen::VectorXi& vertex_of_a,
                        const BranchTerritories& territories_b) {
  Landings landings;
  for (int vertex = 0; vertex < vertex_of_a.size(); ++vertex) {
    if (vertex_of_a[vertex] < 0) continue;
    landings.vertices.push_back(vertex);
    landings.branches.push_back(territories_b.branch_of_vertex[vertex_of_a[vertex]]);
  }
  return landings;
}

bool same_polygons(const PolygonSoup& a, const PolygonSoup& b) {
  return a.positions.rows() == b.positions.rows() && a.corners == b.corners &&
         a.offsets == b.offsets;
}

/// Each corner a vertex of its own, as in STL: the numbers do not tell which polygons meet.
bool corners_are_apart(const PolygonSoup& soup) {
  std::vector<char> used(idx(soup.positions.rows()), 0);
  return std::none_of(soup.corners.begin(), soup.corners.end(), [&](std::int32_t corner) {
    return std::exchange(used[idx(corner)], 1) != 0;
  });
}

/// One direction: what is one vertex of a's surface is one of b's, where both have it.
bool keeps_together(const Eigen::VectorXi& a, const Eigen::VectorXi& b) {
  std::vector<int> partner(idx(a.size() > 0 ? a.maxCoeff() + 1 : 0), -1);
  for (Eigen::Index v = 0; v < a.size(); ++v) {
    if (a[v] < 0 || b[v] < 0) continue;
    int& known = partner[idx(a[v])];
    if (known >= 0 && known != b[v]) return false;
    known = b[v];
  }
  return true;
}

bool same_vertices_joined(const RepairedSurface& a, const RepairedSurface& b) {
  return keeps_together(a.vertex_of_input, b.vertex_of_input) &&
         keeps_together(b.vertex_of_input, a.vertex_of_input);
}

/// Of the repaired surface's vertices.
Eigen::VectorXi shared_vertices(const RepairedSurface& a, const RepairedSurface& b) {
  Eigen::VectorXi partner = Eigen::VectorXi::Constant(a.surface.positions.rows(), -1);
  for (Eigen::Index v = a.vertex_of_input.size(); v-- > 0;) {
    if (a.vertex_of_input[v] >= 0) partner[a.vertex_of_input[v]] = b.vertex_of_input[v];
  }
  return partner;
}

/// -1 where either has dropped the vertex.
Eigen::VectorXi kept_by_both(const RepairedSurface& a, const RepairedSurface& b) {
  Eigen::VectorXi partner = Eigen::VectorXi::Constant(a.vertex_of_input.size(), -1);
  for (int v = 0; v < partner.size(); ++v) {
    if (a.vertex_of_input[v] >= 0 && b.vertex_of_input[v] >= 0) partner[v] = v;
  }
  return partner;
}

/// From the soup of a to its surface, to that of b, and back to the first such vertex of its soup.
Eigen::VectorXi by_surfaces(const SkeletonMatch& match, const RepairedSurface& a,
                            const RepairedSurface& b) {
  Eigen::VectorXi input_of_b = Eigen::VectorXi::Constant(b.surface.positions.rows(), -1);
  for (Eigen::Index v = b.vertex_of_input.size(); v-- > 0;) {
    if (b.vertex_of_input[v] >= 0) input_of_b[b.vertex_of_input[v]] = static_cast<int>(v);
  }
  Eigen::VectorXi partner = a.vertex_of_input;
  for (int& vertex : partner) {
    const int matched = vertex < 0 ? -1 : match.vertex_of_a[vertex];
    vertex = matched < 0 ? -1 : input_of_b[matched];
  }
  return partner;
}

}  // namespace

SkeletonMatch match_by_vertices(const MatchSide& a, const MatchSide& b,
                                const Eigen::VectorXi& vertex_of_a, const Monitor& monitor) {
  monitor.report("match", 0);
  const TipFeatures of_a = tip_features(a, "A");
  const TipFeatures of_b = tip_features(b, "B");
  require_known(vertex_of_a, a, b);
  monitor.report("match", 0.3);
  const NodeMotions motions = known_motions(a, of_a, b, of_b, vertex_of_a);
  const Eigen::MatrixXd like = likeness(of_a, of_b);
  const MatchedBodies bodies{a, of_a, b, of_b, like, monitor.stop};
  const std::vector<int> tips =
      pair_tips(bodies, motions, pair_components(of_a, of_b, motions, monitor.stop));
  monitor.report("match", 0.7);
  const BranchTerritories territories_b = branch_territories(b.surface, b.skeleton);
  const Eigen::MatrixXd overlaps =
      branch_overlaps(branch_territories(a.surface, a.skeleton), territories_b,
                      known_landings(vertex_of_a, territories_b));
  SkeletonMatch match;
  match.branches = pair_branches(bodies, tips, overlaps, motions);
  match.junctions = pair_junctions(a, b, match.branches);
  match.vertex_of_a = vertex_of_a;
  return match;
}

InputMatch match_inputs(const MatchInput& a, const MatchInput& b, const MatchOptions& options,
                        const Monitor& monitor) {
  for (const MatchInput& side : {a, b}) {
    require_sound(side.soup);
    require_below(side.repaired.vertex_of_input, side.repaired.surface.positions.rows(), "match");
    if (side.repaired.vertex_of_input.size() == side.soup.positions.rows()) continue;
    throw Error(Fault::input, "match: found a map of " +
                                  std::to_string(side.repaired.vertex_of_input.size()) +
                                  " vertices, needed one of the polygons' " +
                                  std::to_string(side.soup.positions.rows()));
  }
  const MatchSide side_a{a.repaired.surface, a.skeleton};
  const MatchSide side_b{b.repaired.surface, b.skeleton};
  InputMatch found;
  found.by_vertices = !options.by_shape && same_polygons(a.soup, b.soup) &&
                      (!corners_are_apart(a.soup) || same_vertices_joined(a.repaired, b.repaired));
  if (found.by_vertices) {
    const Eigen::VectorXi shared = shared_vertices(a.repaired, b.repaired);
    found.match = match_by_vertices(side_a, side_b, shared, monitor);
    found.vertex_of_a = kept_by_both(a.repaired, b.repaired);
  } else {
    found.match = match_skeletons(side_a, side_b, options, monitor);
    found.vertex_of_a = by_surfaces(found.match, a.repaired, b.repaired);
  }
  return found;
}

}  // namespace curveskel
