#include "skeleton/match/component_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/least_pairs.hpp"
#include "base/median.hpp"

namespace curveskel {
namespace {

using Points = Eigen::Matrix3Xd;

/// Over b's unit: where the centroids of a are thought to go, and where those of b are.
struct Centroids {
  Points of_a;
  Points moved;
  Points of_b;
};

Centroids centroids_of(const TipFeatures& a, const TipFeatures& b, const NodeMotions& motions) {
  Centroids centroids{Points(3, static_cast<Eigen::Index>(a.middle.size())),
                      Points(3, static_cast<Eigen::Index>(a.middle.size())),
                      Points(3, static_cast<Eigen::Index>(b.middle.size()))};
  for (std::size_t i = 0; i < a.middle.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    centroids.of_a.col(column) = a.centroid[i] / a.unit;
    centroids.moved.col(column) = motions.of_node[idx(a.middle[i])](a.centroid[i]) / b.unit;
  }
  for (std::size_t j = 0; j < b.middle.size(); ++j) {
    centroids.of_b.col(static_cast<Eigen::Index>(j)) = b.centroid[j] / b.unit;
  }
  return centroids;
}

Eigen::MatrixXd costs_of(const TipFeatures& a, const TipFeatures& b, const Centroids& centroids,
                         const Points& shifts) {
  // A pose moves parts, but keeps their areas: a tenth of the size apart is as likely another part
  // as an area of a fifth more.
  constexpr double place_scale = 0.1;
  constexpr double area_scale = 0.2;
  constexpr double least_share = 1e-6;
  Eigen::MatrixXd costs(centroids.of_a.cols(), centroids.of_b.cols());
  for (Eigen::Index i = 0; i < costs.rows(); ++i) {
    for (Eigen::Index j = 0; j < costs.cols(); ++j) {
      const Eigen::Vector3d place = centroids.moved.col(i) + shifts.col(i);
      const double off = (centroids.of_b.col(j) - place).norm() / place_scale;
      const double ratio =
          (a.area_share[idx(i)] + least_share) / (b.area_share[idx(j)] + least_share);
      costs(i, j) = off + std::abs(std::log(ratio)) / area_scale;
    }
  }
  return costs;
}

/// Of each component how far its neighbours, as they are paired, are from where they were thought
/// to be: the median of each coordinate.
Points shifts_of(const Centroids& centroids, const std::vector<int>& pairs) {
  constexpr std::size_t neighbours = 7;
  const Eigen::Index count = centroids.of_a.cols();
  Points shifts = Points::Zero(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    std::vector<std::pair<double, Eigen::Index>> near;
    for (Eigen::Index k = 0; k < count; ++k) {
      if (pairs[idx(k)] < 0) continue;
      near.emplace_back((centroids.of_a.col(k) - centroids.of_a.col(i)).norm(), k);
    }
    std::sort(near.begin(), near.end());
    if (near.size() > neighbours) near.resize(neighbours);
    for (Eigen::Index axis = 0; axis < 3 && !near.empty(); ++axis) {
      std::vector<double> values;
      values.reserve(near.size());
      for (const auto& [distance, k] : near) {
        values.push_back(centroids.of_b(axis, pairs[idx(k)]) - centroids.moved(axis, k));
      }
      shifts(axis, i) = median_of(std::move(values));
    }
  }
  return shifts;
}

}  // namespace

std::vector<int> pair_components(const TipFeatures& a, const TipFeatures& b,
                                 const NodeMotions& motions, const std::stop_token& stop) {
  const Centroids centroids = centroids_of(a, b, motions);
  Eigen::MatrixXd costs = costs_of(a, b, centroids, Points::Zero(3, centroids.of_a.cols()));
  std::vector<int> pairs = least_pairs(costs, stop);
  constexpr int rounds = 6;
  for (int round = 0; round < rounds && pairs.size() > 2; ++round) {
    costs = costs_of(a, b, centroids, shifts_of(centroids, pairs));
    std::vector<int> better = least_pairs(costs, stop);
    const bool settled = better == pairs;
    pairs = std::move(better);
    if (settled) break;
  }
  constexpr double no_pair = 4;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    int& pair = pairs[i];
    // The largest are what was laid onto each other.
    const bool largest = static_cast<int>(i) == a.centre_component && pair == b.centre_component;
    if (pair >= 0 && !largest && costs(static_cast<Eigen::Index>(i), pair) > no_pair) pair = -1;
  }
  return pairs;
}

}  // namespace curveskel
