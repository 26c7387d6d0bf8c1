#include "skeleton/match/similarity.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <numeric>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// The four nearest fifths: the rest may be limbs that have moved.
std::vector<Eigen::Index> nearest_fifths(const Eigen::VectorXd& distances) {
  std::vector<Eigen::Index> order(idx(distances.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto i, auto k) { return distances[i] < distances[k]; });
  order.resize(std::max<std::size_t>(1, order.size() * 4 / 5));
  return order;
}

}  // namespace

Eigen::Matrix3d rotation_between(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  const Eigen::Matrix3d product = to * from.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, 1);
  signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

void refine(Similarity& motion, const Eigen::Matrix3Xd& points, const SurfaceTree& surface,
            int rounds) {
  Eigen::Matrix3Xd nearest(3, points.cols());
  Eigen::VectorXd distances(points.cols());
  for (int round = 0; round < rounds; ++round) {
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      const Eigen::Vector3d at = motion(points.col(k));
      nearest.col(k) = surface.nearest(at).point;
      distances[k] = (nearest.col(k) - at).norm();
    }
    const auto kept = nearest_fifths(distances);
    const Eigen::Matrix3Xd from = points(Eigen::all, kept);
    const Eigen::Matrix3Xd to = nearest(Eigen::all, kept);
    motion.from = from.rowwise().mean();
    motion.to = to.rowwise().mean();
    motion.rotation = rotation_between(from.colwise() - motion.from, to.colwise() - motion.to);
  }
}

double misfit(const Similarity& motion, const Eigen::Matrix3Xd& points,
              const SurfaceTree& surface) {
  Eigen::VectorXd distances(points.cols());
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    distances[k] = surface.nearest(motion(points.col(k))).distance;
  }
  return distances(nearest_fifths(distances)).mean();
}

}  // namespace curveskel
