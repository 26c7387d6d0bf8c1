#include <curveskel/branch_territories.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include "skeleton/measure/branch_curve.hpp"

namespace curveskel {
namespace {

/// A branch at one of its ends.
struct Departure {
  int branch;
  Eigen::Vector3d direction;
};

/// Per node the branches that end there.
using Departures = std::vector<std::vector<Departure>>;

Departures departures_of(const CurveSkeleton& skeleton, const std::vector<Branch>& all) {
  Departures departures(idx(skeleton.nodes.rows()));
  for (std::size_t b = 0; b < all.size(); ++b) {
    const BranchCurve curve = branch_curve(skeleton, all[b]);
    const int number = static_cast<int>(b);
    departures[idx(all[b].nodes.front())].push_back({number, departure(curve, true)});
    departures[idx(all[b].nodes.back())].push_back({number, departure(curve, false)});
  }
  return departures;
}

int nearest_in_direction(const std::vector<Departure>& departures, const Eigen::Vector3d& to) {
  int best = -1;
  double best_cosine = 0;
  for (const Departure& one : departures) {
    const double cosine = one.direction.dot(to);
    if (best >= 0 && cosine <= best_cosine) continue;
    best = one.branch;
    best_cosine = cosine;
  }
  return best;
}

Eigen::VectorXi label_vertices(const Surface& surface, const CurveSkeleton& skeleton,
                               const std::vector<Branch>& all) {
  const Departures departures = departures_of(skeleton, all);
  std::vector<int> within(idx(skeleton.nodes.rows()), -1);
  for (std::size_t b = 0; b < all.size(); ++b) {
    const std::vector<int>& nodes = all[b].nodes;
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k) within[idx(nodes[k])] = int(b);
  }
  Eigen::VectorXi labels = Eigen::VectorXi::Constant(surface.positions.rows(), -1);
  for (Eigen::Index vertex = 0; vertex < labels.size(); ++vertex) {
    const int node = skeleton.node_of_vertex[vertex];
    if (node < 0) continue;
    const Eigen::Vector3d out = surface.positions.row(vertex) - skeleton.nodes.row(node);
    labels[vertex] = within[idx(node)] >= 0 ? within[idx(node)]
                                            : nearest_in_direction(departures[idx(node)], out);
  }
  return labels;
}

Eigen::VectorXi label_faces(const Triangles& triangles, const Eigen::VectorXi& of_vertex) {
  Eigen::VectorXi labels(triangles.rows());
  for (Eigen::Index face = 0; face < labels.size(); ++face) {
    const int a = of_vertex[triangles(face, 0)];
    const int b = of_vertex[triangles(face, 1)];
    const int c = of_vertex[triangles(face, 2)];
    labels[face] = b == c ? b : a;
  }
  return labels;
}

/// Six times the volume of the tetrahedron with the origin.
double six_volumes(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return a.dot(b.cross(c));
}

/// Closes the territories against each other.
class Borders {
 public:
  Borders(const Surface& surface, const CurveSkeleton& skeleton, const std::vector<Branch>& all)
      : surface_(surface), skeleton_(skeleton), all_(all) {}

  /// The triangle that closes `branch` along the half-edge from a to b of one of its faces, whose
  /// twin belongs to `other`; as six volumes relative to `origin`.
  [[nodiscard]] double closing(int branch, int other, int a, int b,
                               const Eigen::Vector3d& origin) const {
    const Eigen::Vector3d from = surface_.positions.row(a);
    const Eigen::Vector3d to = surface_.positions.row(b);
    const int apex = shared_junction(branch, other, (from + to) / 2);
    if (apex < 0) return 0;
    const Eigen::Vector3d top = skeleton_.nodes.row(apex);
    return six_volumes(to - origin, from - origin, top - origin);
  }

 private:
  /// The nearest of those that both branches end at, -1 = none.
  [[nodiscard]] int shared_junction(int branch, int other, const Eigen::Vector3d& place) const {
    int best = -1;
    double best_distance = 0;
    const std::vector<int>& mine = all_[idx(branch)].nodes;
    const std::vector<int>& theirs = all_[idx(other)].nodes;
    for (const int node : {mine.front(), mine.back()}) {
      if (node != theirs.front() && node != theirs.back()) continue;
      const double distance = (skeleton_.nodes.row(node).transpose() - place).squaredNorm();
      if (best >= 0 && distance >= best_distance) continue;
      best = node;
      best_distance = distance;
    }
    return best;
  }

  const Surface& surface_;
  const CurveSkeleton& skeleton_;
  const std::vector<Branch>& all_;
};

/// Half-edges, sorted, with their faces.
std::vector<std::pair<std::array<int, 2>, int>> sorted_half_edges(const Triangles& triangles) {
  std::vector<std::pair<std::array<int, 2>, int>> half_edges;
  half_edges.reserve(3 * idx(triangles.rows()));
  for (int face = 0; face < triangles.rows(); ++face) {
    for (int k = 0; k < 3; ++k) {
      half_edges.push_back({{triangles(face, k), triangles(face, (k + 1) % 3)}, face});
    }
  }
  std::sort(half_edges.begin(), half_edges.end());
  return half_edges;
}

void close_territories(const Surface& surface, const Borders& borders,
                       const Eigen::Vector3d& origin, BranchTerritories& territories) {
  const auto half_edges = sorted_half_edges(surface.triangles);
  for (const auto& [edge, face] : half_edges) {
    const int branch = territories.branch_of_face[face];
    const std::array<int, 2> twin{edge[1], edge[0]};
    const auto found = std::lower_bound(
        half_edges.begin(), half_edges.end(), twin,
        [](const auto& entry, const auto& wanted) { return entry.first < wanted; });
    if (branch < 0 || found == half_edges.end() || found->first != twin) continue;
    const int other = territories.branch_of_face[found->second];
    if (other < 0 || other == branch) continue;
    territories.volumes[idx(branch)] += borders.closing(branch, other, edge[0], edge[1], origin);
  }
}

}  // namespace

BranchTerritories branch_territories(const Surface& surface, const CurveSkeleton& skeleton) {
  const std::vector<Branch> all = branches(skeleton);
  BranchTerritories territories;
  territories.branch_of_vertex = label_vertices(surface, skeleton, all);
  territories.branch_of_face = label_faces(surface.triangles, territories.branch_of_vertex);
  territories.areas.assign(all.size(), 0);
  territories.volumes.assign(all.size(), 0);
  const Eigen::Vector3d origin = surface.positions.colwise().mean();
  for (Eigen::Index face = 0; face < surface.triangles.rows(); ++face) {
    const int branch = territories.branch_of_face[face];
    if (branch < 0) continue;
    const auto corner = [&](int k) -> Eigen::Vector3d {
      return surface.positions.row(surface.triangles(face, k)).transpose() - origin;
    };
    const Eigen::Vector3d a = corner(0);
    const Eigen::Vector3d b = corner(1);
    const Eigen::Vector3d c = corner(2);
    territories.areas[idx(branch)] += (b - a).cross(c - a).norm() / 2;
    territories.volumes[idx(branch)] += six_volumes(a, b, c);
  }
  close_territories(surface, Borders(surface, skeleton, all), origin, territories);
  for (double& volume : territories.volumes) volume /= 6;
  return territories;
}

Eigen::VectorXi majority_labels(const Eigen::VectorXi& label_of_vertex,
                                const std::vector<std::int32_t>& corners,
                                const std::vector<std::int64_t>& offsets) {
  const std::size_t faces = offsets.empty() ? 0 : offsets.size() - 1;
  Eigen::VectorXi labels(static_cast<Eigen::Index>(faces));
  for (std::size_t face = 0; face < faces; ++face) {
    int best = -1;
    int best_count = 0;
    for (auto i = idx(offsets[face]); i < idx(offsets[face + 1]); ++i) {
      const int label = label_of_vertex[corners[i]];
      int count = 0;
      for (auto k = idx(offsets[face]); k < idx(offsets[face + 1]); ++k) {
        count += label_of_vertex[corners[k]] == label ? 1 : 0;
      }
      if (count <= best_count) continue;
      best = label;
      best_count = count;
    }
    labels[static_cast<Eigen::Index>(face)] = best;
  }
  return labels;
}

}  // namespace curveskel
