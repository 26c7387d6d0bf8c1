#include "skeleton/match/core_alignment.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"
#include "skeleton/match/some_of.hpp"

namespace curveskel {
namespace {

using Points = Eigen::Matrix3Xd;

constexpr int rounds_of_refinement = 20;

/// Evenly through the vertices.
Points spread(const Positions& positions, const std::vector<int>& vertices, std::size_t most) {
  return positions(evenly(vertices, most), Eigen::all).transpose();
}

std::vector<int> all_vertices(const Surface& surface) {
  std::vector<int> vertices(idx(surface.positions.rows()));
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

Eigen::Vector3d whole_centroid(const TipFeatures& features) {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < features.centroid.size(); ++k) {
    centroid += features.area_share[k] * features.centroid[k];
  }
  return centroid;
}

/// Columns: axes of the core's points, the longest first, right-handed.
Eigen::Matrix3d principal_axes(const Points& points) {
  const Points centred = points.colwise() - points.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spectrum(centred * centred.transpose());
  Eigen::Matrix3d axes = spectrum.eigenvectors().rowwise().reverse();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  return axes;
}

/// All rotations that take axes to axes, up to sign.
void add_axis_rotations(const Points& of_a, const Points& of_b,
                        std::vector<Eigen::Matrix3d>& starts) {
  const Eigen::Matrix3d a = principal_axes(of_a);
  const Eigen::Matrix3d b = principal_axes(of_b);
  // A body of revolution has two of its axes anywhere: those normal to the first or to the last.
  constexpr int turns = 12;
  for (const int axis : {0, 2}) {
    Eigen::Vector3d signs = Eigen::Vector3d::Constant(-1);
    signs[1] = 1;
    for (int turn = 0; turn < 2 * turns; ++turn) {
      const Eigen::Matrix3d about =
          Eigen::AngleAxisd(2 * std::numbers::pi * turn / turns, Eigen::Vector3d::Unit(axis))
              .toRotationMatrix();
      const Eigen::Matrix3d flip =
          turn < turns ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : signs.asDiagonal();
      starts.emplace_back(b * about * flip * a.transpose());
    }
  }
}

/// The tips whose limbs reach farthest, `most` of them.
std::vector<int> farthest_tips(const TipFeatures& features, std::size_t most) {
  std::vector<int> order(features.tips.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int i, int k) { return features.reach[i] > features.reach[k]; });
  if (order.size() > most) order.resize(most);
  return order;
}

/// Three tips of a as far apart in their roots as any of the farthest.
std::array<int, 3> spread_tips(const TipFeatures& features) {
  const std::vector<int> order = farthest_tips(features, 12);
  std::array<int, 3> best{order[0], order[1], order[2]};
  double best_area = -1;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      for (std::size_t l = k + 1; l < order.size(); ++l) {
        const Eigen::Vector3d u = features.roots.col(order[k]) - features.roots.col(order[i]);
        const Eigen::Vector3d v = features.roots.col(order[l]) - features.roots.col(order[i]);
        const double area = u.cross(v).norm();
        if (area <= best_area * (1 + 1e-9)) continue;
        best_area = area;
        best = {order[i], order[k], order[l]};
      }
    }
  }
  return best;
}

void add_limb_rotations(const TipFeatures& of_a, const TipFeatures& of_b,
                        const Eigen::MatrixXd& like, std::vector<Eigen::Matrix3d>& starts) {
  if (of_a.tips.size() < 3 || of_b.tips.size() < 3) return;
  const std::array<int, 3> anchors = spread_tips(of_a);
  Points from(3, 3);
  for (int k = 0; k < 3; ++k) from.col(k) = of_a.roots.col(anchors[idx(k)]) - of_a.centre;
  const std::vector<int> of_b_tips = farthest_tips(of_b, 24);
  const auto apart = [&](std::size_t k, std::size_t l, int i, int j) {
    return std::abs(of_a.apart(anchors[k], anchors[l]) - of_b.apart(i, j)) /
           (0.05 + of_a.apart(anchors[k], anchors[l]));
  };
  std::vector<std::pair<double, std::array<int, 3>>> triples;
  for (const int i : of_b_tips) {
    for (const int j : of_b_tips) {
      for (const int k : of_b_tips) {
        if (i == j || j == k || i == k) continue;
        const double cost = apart(0, 1, i, j) + apart(0, 2, i, k) + apart(1, 2, j, k) -
                            std::log(1e-6 + like(anchors[0], i)) -
                            std::log(1e-6 + like(anchors[1], j)) -
                            std::log(1e-6 + like(anchors[2], k));
        triples.push_back({cost, {i, j, k}});
      }
    }
  }
  constexpr std::size_t most = 60;
  std::sort(triples.begin(), triples.end());
  if (triples.size() > most) triples.resize(most);
  for (const auto& [cost, triple] : triples) {
    Points to(3, 3);
    for (int k = 0; k < 3; ++k) to.col(k) = of_b.roots.col(triple[idx(k)]) - of_b.centre;
    starts.push_back(rotation_between(from, to));
  }
}

bool differs(const CoreAlignment& one, const CoreAlignment& other) {
  const Eigen::AngleAxisd between(
      Eigen::Matrix3d(one.motion.rotation.transpose() * other.motion.rotation));
  return std::abs(between.angle()) > std::numbers::pi / 6;
}

/// Points of a's, and the motion in which they are laid onto b first, but for its rotation.
struct Start {
  Points few;  ///< for the first rounds
  Points many;
  Similarity motion;
  std::vector<Eigen::Matrix3d> rotations;
};

/// Lays a onto b's surface.
class Alignments {
 public:
  Alignments(const MatchedBodies& bodies, const SurfaceTree& tree_b, double scale, int threads,
             const std::stop_token& stop)
      : bodies_(bodies), tree_b_(tree_b), scale_(scale), threads_(threads), stop_(stop) {}

  [[nodiscard]] Start of_cores() const {
    return start_from(bodies_.of_a.core_vertices, bodies_.of_b.core_vertices, bodies_.of_a.centre,
                      bodies_.of_b.centre);
  }

  [[nodiscard]] Start of_wholes() const {
    return start_from(all_vertices(bodies_.a.surface), all_vertices(bodies_.b.surface),
                      whole_centroid(bodies_.of_a), whole_centroid(bodies_.of_b));
  }

  /// The best that differ, at most `most`, from all rotations.
  [[nodiscard]] std::vector<CoreAlignment> best_from(const Start& start, std::size_t most) const {
    std::vector<CoreAlignment> found(start.rotations.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      found[k].motion = start.motion;
      found[k].motion.rotation = start.rotations[k];
    }
    constexpr int first_rounds = 3;
    improve(found, start.few, first_rounds);
    constexpr std::size_t refined = 16;
    if (found.size() > refined) found.resize(refined);
    improve(found, start.many, rounds_of_refinement);
    std::vector<CoreAlignment> apart;
    for (const CoreAlignment& one : found) {
      if (apart.size() < most && std::all_of(apart.begin(), apart.end(), [&](const auto& other) {
            return differs(one, other);
          })) {
        apart.push_back(one);
      }
    }
    return apart;
  }

  [[nodiscard]] CoreAlignment as_they_stand(const Points& core_a) const {
    CoreAlignment standing;
    standing.motion = {Eigen::Matrix3d::Identity(), bodies_.of_a.centre, bodies_.of_b.centre,
                       scale_};
    refine(standing.motion, core_a, tree_b_, rounds_of_refinement);
    standing.residual = misfit(standing.motion, core_a, tree_b_) / bodies_.of_b.unit;
    return standing;
  }

 private:
  [[nodiscard]] Start start_from(const std::vector<int>& of_a, const std::vector<int>& of_b,
                                 const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    constexpr std::size_t few = 80;
    constexpr std::size_t many = 400;
    const Positions& positions = bodies_.a.surface.positions;
    Start start{spread(positions, of_a, few),
                spread(positions, of_a, many),
                {Eigen::Matrix3d::Identity(), from, to, scale_},
                {Eigen::Matrix3d::Identity()}};
    add_limb_rotations(bodies_.of_a, bodies_.of_b, bodies_.like, start.rotations);
    add_axis_rotations(start.many, spread(bodies_.b.surface.positions, of_b, many),
                       start.rotations);
    return start;
  }

  /// And puts the best first.
  void improve(std::vector<CoreAlignment>& found, const Points& points, int rounds) const {
    parallel_for(found.size(), 1, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        throw_if_stopped(stop_);
        refine(found[k].motion, points, tree_b_, rounds);
        found[k].residual = misfit(found[k].motion, points, tree_b_) / bodies_.of_b.unit;
      }
    });
    std::stable_sort(found.begin(), found.end(),
                     [](const CoreAlignment& one, const CoreAlignment& other) {
                       return one.residual < other.residual;
                     });
  }

  const MatchedBodies& bodies_;
  const SurfaceTree& tree_b_;
  double scale_;
  int threads_;
  const std::stop_token& stop_;
};

}  // namespace

std::vector<CoreAlignment> align_cores(const MatchedBodies& bodies, const SurfaceTree& tree_b,
                                       double scale, std::size_t most, const MatchOptions& options,
                                       const std::stop_token& stop) {
  const Alignments alignments(bodies, tree_b, scale, options.threads, stop);
  const Start cores = alignments.of_cores();
  std::vector<CoreAlignment> found = alignments.best_from(cores, most);
  const std::vector<CoreAlignment> of_wholes = alignments.best_from(alignments.of_wholes(), most);
  found.insert(found.end(), of_wholes.begin(), of_wholes.end());
  found.push_back(alignments.as_they_stand(cores.many));
  return found;
}

}  // namespace curveskel
