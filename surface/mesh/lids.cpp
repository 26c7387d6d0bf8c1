#include "surface/mesh/lids.hpp"

#include <Eigen/Core>
#include <map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "surface/mesh/half_edges.hpp"

namespace curveskel {
namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;

/// Each edge of the rims, in their direction, with its half-edge in the surface, -1 = not there.
std::map<Edge, std::int32_t> half_edges_of(const Triangles& triangles,
                                           const std::vector<std::vector<std::int32_t>>& rims) {
  std::map<Edge, std::int32_t> found;
  for (const auto& rim : rims) {
    for (std::size_t k = 0; k < rim.size(); ++k) {
      found[{rim[k], rim[(k + 1) % rim.size()]}] = -1;
    }
  }
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto edge = found.find({triangles(f, k), triangles(f, (k + 1) % 3)});
      if (edge != found.end()) edge->second = static_cast<std::int32_t>(3 * f + k);
    }
  }
  return found;
}

/// The half-edges of a rim, none if one of its edges is gone.
std::vector<std::int32_t> half_edges_of(const std::map<Edge, std::int32_t>& found,
                                        const std::vector<std::int32_t>& rim) {
  std::vector<std::int32_t> half_edges;
  half_edges.reserve(rim.size());
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const std::int32_t half_edge = found.at({rim[k], rim[(k + 1) % rim.size()]});
    if (half_edge < 0) return {};
    half_edges.push_back(half_edge);
  }
  return half_edges;
}

}  // namespace

std::vector<char> faces_in_rims(const Surface& surface,
                                const std::vector<std::vector<std::int32_t>>& rims) {
  std::vector<char> in_rim(idx(surface.triangles.rows()), 0);
  if (rims.empty()) return in_rim;
  const auto found = half_edges_of(surface.triangles, rims);
  std::vector<char> on_rim(3 * in_rim.size(), 0);
  std::vector<std::int32_t> reached;
  const auto reach = [&](std::int32_t face) {
    if (std::exchange(in_rim[idx(face)], 1) == 0) reached.push_back(face);
  };
  for (const auto& rim : rims) {
    for (const std::int32_t half_edge : half_edges_of(found, rim)) {
      on_rim[idx(half_edge)] = 1;
      reach(half_edge / 3);
    }
  }
  const HalfEdges pairs =
      pair_half_edges(surface.triangles, static_cast<std::int32_t>(surface.positions.rows()));
  while (!reached.empty()) {
    const std::int32_t face = reached.back();
    reached.pop_back();
    for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) {
      const std::int32_t twin = pairs.twin[idx(h)];
      if (on_rim[idx(h)] == 0 && twin >= 0) reach(twin / 3);
    }
  }
  return in_rim;
}

Surface without_lids(const Surface& surface, const std::vector<std::vector<std::int32_t>>& rims) {
  const std::vector<char> in_rim = faces_in_rims(surface, rims);
  std::vector<Eigen::Index> kept;
  kept.reserve(in_rim.size());
  for (std::size_t f = 0; f < in_rim.size(); ++f) {
    if (in_rim[f] == 0) kept.push_back(static_cast<Eigen::Index>(f));
  }
  if (kept.empty() || kept.size() == in_rim.size()) return {};
  return {surface.positions, surface.triangles(kept, Eigen::all)};
}

}  // namespace curveskel
