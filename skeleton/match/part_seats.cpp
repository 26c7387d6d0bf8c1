#include "skeleton/match/part_seats.hpp"

#include <algorithm>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"
#include "skeleton/match/some_of.hpp"

namespace curveskel {
namespace {

constexpr std::size_t most_seats = 40;

/// Of each vertex, -1 = of none.
std::vector<int> component_of_vertex(const MatchSide& side, const TipFeatures& features) {
  std::vector<int> component(idx(side.surface.positions.rows()), -1);
  for (Eigen::Index v = 0; v < side.surface.positions.rows(); ++v) {
    const int node = side.skeleton.node_of_vertex[v];
    if (node >= 0) component[idx(v)] = features.component[idx(node)];
  }
  return component;
}

/// The surfaces of all components that may be a part's partner: the same part has another share in
/// another body.
std::vector<std::unique_ptr<const SurfaceTree>> part_surfaces(const MatchSide& side,
                                                              const TipFeatures& features,
                                                              int threads) {
  const std::vector<int> component = component_of_vertex(side, features);
  std::vector<std::vector<int>> faces(features.middle.size());
  for (int face = 0; face < side.surface.triangles.rows(); ++face) {
    const int one = component[idx(side.surface.triangles(face, 0))];
    constexpr double at_most = 2 * least_body_share;
    if (one >= 0 && features.area_share[idx(one)] < at_most) faces[idx(one)].push_back(face);
  }
  std::vector<std::unique_ptr<const SurfaceTree>> trees(faces.size());
  parallel_for(faces.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      if (faces[k].empty()) continue;
      trees[k] = std::make_unique<const SurfaceTree>(part_of(side.surface, faces[k]).surface, 1);
    }
  });
  return trees;
}

}  // namespace

PartSeats::~PartSeats() = default;

PartSeats::PartSeats(const MatchedBodies& bodies, int threads)
    : a_(bodies.a), b_(bodies.b), threads_(threads) {
  const auto& [a, of_a, b, of_b, like, stop] = bodies;
  const std::vector<int> component = component_of_vertex(a, of_a);
  std::vector<std::vector<int>> vertices(of_a.middle.size());
  for (int v = 0; v < static_cast<int>(component.size()); ++v) {
    if (component[idx(v)] >= 0) vertices[idx(component[idx(v)])].push_back(v);
  }
  std::vector<int> of_bodies;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (of_a.area_share[k] >= least_body_share) {
      of_bodies.insert(of_bodies.end(), vertices[k].begin(), vertices[k].end());
    } else if (!vertices[k].empty()) {
      constexpr std::size_t most = 64;
      parts_.push_back({static_cast<int>(k),
                        {},
                        a.surface.positions(evenly(vertices[k], most), Eigen::all).transpose(),
                        {}});
    }
  }
  if (parts_.empty()) return;
  for (Part& part : parts_) {
    for (int node = 0; node < of_a.graph.nodes(); ++node) {
      if (of_a.component[idx(node)] == part.component) part.nodes.push_back(node);
    }
  }
  constexpr std::size_t most_of_bodies = 6000;
  find_seats(evenly(of_bodies, most_of_bodies));
  surface_of_b_ = part_surfaces(b, of_b, threads);
}

void PartSeats::find_seats(const std::vector<int>& vertices) {
  parallel_for(parts_.size(), 1, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::vector<std::pair<double, int>> near;
      near.reserve(vertices.size());
      for (const int vertex : vertices) {
        const Eigen::Vector3d at = a_.surface.positions.row(vertex);
        near.emplace_back((parts_[k].points.colwise() - at).colwise().squaredNorm().minCoeff(),
                          vertex);
      }
      // Twice as many as are needed, as some have no partner.
      const std::size_t count = std::min(2 * most_seats, near.size());
      std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count),
                        near.end());
      for (std::size_t s = 0; s < count; ++s) parts_[k].seats.push_back(near[s].second);
    }
  });
  for (const Part& part : parts_) {
    vertices_.insert(vertices_.end(), part.seats.begin(), part.seats.end());
  }
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
}

void PartSeats::seat(NodeMotions& motions, const Eigen::VectorXi& vertex_of_a) const {
  for (const Part& part : parts_) {
    std::vector<int> seats;
    for (const int vertex : part.seats) {
      if (vertex_of_a[vertex] >= 0 && seats.size() < most_seats) seats.push_back(vertex);
    }
    move_part(part, seats, vertex_of_a, motions);
  }
}

void PartSeats::move_part(const Part& part, const std::vector<int>& seats,
                          const Eigen::VectorXi& vertex_of_a, NodeMotions& motions) const {
  constexpr std::size_t least_seats = 4;
  if (seats.size() < least_seats) return;
  Eigen::Matrix3Xd from = a_.surface.positions(seats, Eigen::all).transpose();
  Eigen::Matrix3Xd to(3, from.cols());
  for (std::size_t s = 0; s < seats.size(); ++s) {
    to.col(static_cast<Eigen::Index>(s)) = b_.surface.positions.row(vertex_of_a[seats[s]]);
  }
  Similarity motion = motions.of_node[idx(part.nodes.front())];
  std::vector<Eigen::Index> kept(seats.size());
  for (std::size_t s = 0; s < kept.size(); ++s) kept[s] = static_cast<Eigen::Index>(s);
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    const Eigen::Matrix3Xd mine = from(Eigen::all, kept);
    const Eigen::Matrix3Xd theirs = to(Eigen::all, kept);
    motion.from = mine.rowwise().mean();
    motion.to = theirs.rowwise().mean();
    motion.rotation = rotation_between(mine.colwise() - motion.from, theirs.colwise() - motion.to);
    // Lips touch: the third that goes another way belongs to another seat.
    std::vector<std::pair<double, Eigen::Index>> off;
    for (Eigen::Index s = 0; s < from.cols(); ++s) {
      off.emplace_back((motion(from.col(s)) - to.col(s)).squaredNorm(), s);
    }
    std::sort(off.begin(), off.end());
    kept.clear();
    for (std::size_t s = 0; s < (2 * off.size() + 2) / 3; ++s) kept.push_back(off[s].second);
  }
  for (const int node : part.nodes) motions.of_node[idx(node)] = motion;
}

void PartSeats::lay_onto_partners(NodeMotions& motions,
                                  const std::vector<int>& component_pairs) const {
  parallel_for(parts_.size(), 1, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Part& part = parts_[k];
      const int partner = component_pairs[idx(part.component)];
      if (partner < 0 || !surface_of_b_[idx(partner)]) continue;
      Similarity motion = motions.of_node[idx(part.nodes.front())];
      constexpr int rounds = 10;
      refine(motion, part.points, *surface_of_b_[idx(partner)], rounds);
      for (const int node : part.nodes) motions.of_node[idx(node)] = motion;
    }
  });
}

}  // namespace curveskel
