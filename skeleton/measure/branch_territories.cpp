#include <curveskel/branch_territories.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include "skeleton/graph/sound_skeleton.hpp"
#include "skeleton/measure/branch_curve.hpp"
#include "surface/mesh/triangle_area.hpp"
#include "surface/repair/sound_soup.hpp"

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

/// An edge of a face of `branch`, from a to b, whose twin belongs to `other`.
struct BorderEdge {
  int branch;
  int other;
  int a;
  int b;
};

std::vector<BorderEdge> border_edges(const Triangles& triangles, const Eigen::VectorXi& of_face) {
  const auto half_edges = sorted_half_edges(triangles);
  std::vector<BorderEdge> border;
  for (const auto& [edge, face] : half_edges) {
    const int branch = of_face[face];
    const std::array<int, 2> twin{edge[1], edge[0]};
    const auto found = std::lower_bound(
        half_edges.begin(), half_edges.end(), twin,
        [](const auto& entry, const auto& wanted) { return entry.first < wanted; });
    if (branch < 0 || found == half_edges.end() || found->first != twin) continue;
    const int other = of_face[found->second];
    if (other >= 0 && other != branch) border.push_back({branch, other, edge[0], edge[1]});
  }
  return border;
}

/// Nodes of the skeleton to which the territories are closed against each other.
class Apexes {
 public:
  Apexes(const Surface& surface, const CurveSkeleton& skeleton, const std::vector<Branch>& all)
      : surface_(surface),
        skeleton_(skeleton),
        all_(all),
        of_vertex_(idx(surface.positions.rows()), -1) {}

  /// Of the nodes at which both branches end the nearest to the edge's middle; where they share
  /// none, of those of either. The same for the edge's twin.
  [[nodiscard]] int of_edge(const BorderEdge& edge) const {
    const Eigen::Vector3d middle = (place(edge.a) + place(edge.b)) / 2;
    const std::vector<int>& mine = all_[idx(edge.branch)].nodes;
    const std::vector<int>& theirs = all_[idx(edge.other)].nodes;
    int best = -1;
    for (const int node : {mine.front(), mine.back()}) {
      if (node == theirs.front() || node == theirs.back()) best = nearer(middle, best, node);
    }
    if (best >= 0) return best;
    for (const int node : {mine.front(), mine.back(), theirs.front(), theirs.back()}) {
      best = nearer(middle, best, node);
    }
    return best;
  }

  void add(const BorderEdge& edge) {
    for (const int v : {edge.a, edge.b}) {
      of_vertex_[idx(v)] = nearer(place(v), of_vertex_[idx(v)], of_edge(edge));
    }
  }
  /// Of the apexes of the vertex's border edges, once all are added, the nearest.
  [[nodiscard]] int of_vertex(int v) const { return of_vertex_[idx(v)]; }

 private:
  [[nodiscard]] Eigen::Vector3d place(int vertex) const { return surface_.positions.row(vertex); }

  /// The lower one if both are as near; -1 = none.
  [[nodiscard]] int nearer(const Eigen::Vector3d& to, int one, int other) const {
    if (one < 0) return other;
    const auto rank = [&](int node) {
      return std::pair((skeleton_.nodes.row(node).transpose() - to).squaredNorm(), node);
    };
    return rank(other) < rank(one) ? other : one;
  }

  const Surface& surface_;
  const CurveSkeleton& skeleton_;
  const std::vector<Branch>& all_;
  std::vector<int> of_vertex_;
};

/// Per branch the mean of the nodes of its component.
std::vector<Eigen::Vector3d> centres_of_components(const CurveSkeleton& skeleton,
                                                   const std::vector<Branch>& all) {
  const std::vector<int> component = component_of_node(skeleton);
  std::vector<Eigen::Vector3d> sums(component.size(), Eigen::Vector3d::Zero());
  std::vector<int> counts(component.size(), 0);
  for (std::size_t node = 0; node < component.size(); ++node) {
    sums[idx(component[node])] += skeleton.nodes.row(static_cast<Eigen::Index>(node)).transpose();
    ++counts[idx(component[node])];
  }
  std::vector<Eigen::Vector3d> centres;
  centres.reserve(all.size());
  for (const Branch& branch : all) {
    const auto of = idx(component[idx(branch.nodes.front())]);
    centres.emplace_back(sums[of] / counts[of]);
  }
  return centres;
}

/// Along each border edge a triangle to its apex p; and as the next edge of the border may have
/// another apex, at both of its ends one from p to the apex of the vertex, which all border edges
/// there share. So the closing has no gap but rings from apex to apex, which are closed to
/// `centres`. The twin gets the same triangles, turned over.
void close_territories(const Surface& surface, const CurveSkeleton& skeleton,
                       const std::vector<Branch>& all, const std::vector<Eigen::Vector3d>& centres,
                       BranchTerritories& territories) {
  const std::vector<BorderEdge> border =
      border_edges(surface.triangles, territories.branch_of_face);
  Apexes apexes(surface, skeleton, all);
  for (const BorderEdge& edge : border) apexes.add(edge);
  for (const BorderEdge& edge : border) {
    const Eigen::Vector3d& origin = centres[idx(edge.branch)];
    const auto node = [&](int n) -> Eigen::Vector3d {
      return skeleton.nodes.row(n).transpose() - origin;
    };
    const Eigen::Vector3d from = surface.positions.row(edge.a).transpose() - origin;
    const Eigen::Vector3d to = surface.positions.row(edge.b).transpose() - origin;
    const Eigen::Vector3d top = node(apexes.of_edge(edge));
    territories.volumes[idx(edge.branch)] += six_volumes(to, from, top) +
                                             six_volumes(to, top, node(apexes.of_vertex(edge.b))) +
                                             six_volumes(top, from, node(apexes.of_vertex(edge.a)));
  }
}

}  // namespace

BranchTerritories branch_territories(const Surface& surface, const CurveSkeleton& skeleton) {
  require_sound(surface, "branch_territories");
  require_sound(skeleton, "branch_territories");
  require_map_of(skeleton, surface, "branch_territories");
  const std::vector<Branch> all = branches(skeleton);
  BranchTerritories territories;
  territories.branch_of_vertex = label_vertices(surface, skeleton, all);
  territories.branch_of_face = label_faces(surface.triangles, territories.branch_of_vertex);
  territories.areas.assign(all.size(), 0);
  territories.volumes.assign(all.size(), 0);
  const std::vector<Eigen::Vector3d> centres = centres_of_components(skeleton, all);
  for (Eigen::Index face = 0; face < surface.triangles.rows(); ++face) {
    const int branch = territories.branch_of_face[face];
    if (branch < 0) continue;
    const auto corner = [&](int k) -> Eigen::Vector3d {
      return surface.positions.row(surface.triangles(face, k)).transpose() - centres[idx(branch)];
    };
    const Eigen::Vector3d a = corner(0);
    const Eigen::Vector3d b = corner(1);
    const Eigen::Vector3d c = corner(2);
    territories.areas[idx(branch)] += twice_area(a, b, c) / 2;
    territories.volumes[idx(branch)] += six_volumes(a, b, c);
  }
  close_territories(surface, skeleton, all, centres, territories);
  for (double& volume : territories.volumes) volume /= 6;
  return territories;
}

Eigen::VectorXi majority_labels(const Eigen::VectorXi& label_of_vertex,
                                const std::vector<std::int32_t>& corners,
                                const std::vector<std::int64_t>& offsets) {
  require_sound_polygons(label_of_vertex.size(), corners, offsets, "majority_labels");
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
