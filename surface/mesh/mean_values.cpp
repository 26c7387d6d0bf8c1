#include "surface/mesh/mean_values.hpp"

#include <array>
#include <cmath>

namespace curveskel {
namespace {

/// A triangle's share of its corners' weights, times their distances: of its image on the unit
/// sphere, whose corners are the columns. Nothing where the place lies in the triangle's plane.
Eigen::Array3d weights_within(const Eigen::Matrix3d& corners) {
  constexpr double nothing = 1e-12;
  Eigen::Matrix3d normals;  // of the sides opposite to the corners
  std::array<double, 3> sine{};
  std::array<double, 3> angle{};
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d from = corners.col((i + 1) % 3);
    const Eigen::Vector3d to = corners.col((i + 2) % 3);
    normals.col(i) = from.cross(to);
    sine[i] = normals.col(i).norm();
    angle[i] = std::atan2(sine[i], from.dot(to));
  }
  const double volume = corners.determinant();
  std::array<double, 3> cosine{};  // of the angles between the sides
  std::array<double, 3> turn{};    // their sines
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    const int last = (i + 2) % 3;
    cosine[i] = -normals.col(next).dot(normals.col(last)) / (sine[next] * sine[last]);
    turn[i] = volume / (sine[next] * sine[last]);
    if (!(std::abs(turn[i]) > nothing)) return Eigen::Array3d::Zero();
  }
  Eigen::Array3d weights;
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    const int last = (i + 2) % 3;
    const double along = cosine[next] * angle[last] + cosine[last] * angle[next];
    weights[i] = (angle[i] - along) / (sine[next] * turn[last]);
  }
  return weights;
}

}  // namespace

Eigen::VectorXd mean_value_coordinates(const Surface& surface, const Eigen::Vector3d& place) {
  const Eigen::Matrix3Xd ways = surface.positions.transpose().colwise() - place;
  const Eigen::RowVectorXd distances = ways.colwise().norm();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(surface.positions.rows());
  double all = 0;
  for (const auto& triangle : surface.triangles.rowwise()) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) corners.col(i) = ways.col(triangle[i]) / distances[triangle[i]];
    const Eigen::Array3d within = weights_within(corners);
    for (int i = 0; i < 3; ++i) {
      const double weight = within[i] / distances[triangle[i]];
      weights[triangle[i]] += weight;
      all += weight;
    }
  }
  return weights / all;
}

}  // namespace curveskel
