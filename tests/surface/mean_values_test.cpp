// Laws of a place as a mean of a surface's vertices.
#include "surface/mesh/mean_values.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "meshes/shapes.hpp"

namespace curveskel::mean_values_laws {
namespace {

std::vector<Surface> solids() {
  return {shapes::ellipsoid({1, 0.5, 0.25}, 1).surface, shapes::box({1, 2, 0.3}, 1).surface,
          shapes::cone(0.5, 2, 7).surface, shapes::ellipsoid({1, 0.5, 0.001}, 2).surface};
}

/// Between the middle of the vertices and each of some of them, and beyond.
std::vector<Eigen::Vector3d> places_about(const Surface& surface) {
  const Eigen::RowVector3d middle = surface.positions.colwise().mean();
  std::vector<Eigen::Vector3d> places;
  for (Eigen::Index v = 0; v < surface.positions.rows(); v += 3) {
    for (const double share : {0.0, 0.31, 0.83, 1.7}) {
      places.emplace_back((middle + share * (surface.positions.row(v) - middle)).transpose());
    }
  }
  return places;
}

/// The flatter, the more of the numbers cancels out.
double rounding_in(const Surface& surface) {
  return 1e-9 / (surface.positions.colwise().maxCoeff() - surface.positions.colwise().minCoeff())
                    .minCoeff();
}

TEST(MeanValues, MakeUpThePlace) {
  for (const Surface& surface : solids()) {
    for (const Eigen::Vector3d& place : places_about(surface)) {
      const Eigen::VectorXd weights = mean_value_coordinates(surface, place);
      EXPECT_NEAR(weights.sum(), 1, 1e-9);
      EXPECT_LT((surface.positions.transpose() * weights - place).norm(), rounding_in(surface));
    }
  }
}

TEST(MeanValues, LeadToThePlacesImageInAnAffineImage) {
  Eigen::Matrix3d skew;
  skew << 1, 0.4, 0, -0.2, 1.3, 0.7, 0, 0.1, 0.6;
  for (const Surface& surface : solids()) {
    const Positions image = surface.positions * skew.transpose();
    for (const Eigen::Vector3d& place : places_about(surface)) {
      const Eigen::Vector3d there = image.transpose() * mean_value_coordinates(surface, place);
      EXPECT_LT((there - skew * place).norm(), rounding_in(surface));
    }
  }
}

TEST(MeanValues, ArePositiveInConvexSolids) {
  for (const Surface& surface : solids()) {
    const Eigen::Vector3d middle = surface.positions.colwise().mean();
    EXPECT_GT(mean_value_coordinates(surface, middle).minCoeff(), 0);
  }
}

}  // namespace
}  // namespace curveskel::mean_values_laws
