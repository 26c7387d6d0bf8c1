// The directions of bodies whose second moments do not tell them, as those of a cube.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

inline constexpr std::size_t fourth_moments = 15;

/// The means of x^4, x^3 y, x^3 z, x^2 y^2, x^2 y z, ... z^4: all products of four coordinates.
using FourthMoments = std::array<double, fourth_moments>;

/// Over the area of a triangle, exact up to rounding.
[[nodiscard]] FourthMoments fourth_moments_of_triangle(const Eigen::Vector3d& p,
                                                       const Eigen::Vector3d& q,
                                                       const Eigen::Vector3d& r);

/// The unit vectors d in which the mean of (p . d)^4 differs most from its mean over all d: the
/// axes of a cube and of an octahedron, each with its opposite. None where it differs nowhere by
/// more than the share `least` of that mean, as in a sphere.
[[nodiscard]] std::vector<Eigen::Vector3d> extreme_directions(const FourthMoments& moments,
                                                              double least);

/// The means over a surface of the products of its points' coordinates. O(#F).
[[nodiscard]] FourthMoments fourth_moments_of(const Surface& surface);

/// The unit vector along the line through the origin from which the points are nearest in the mean
/// of the fourth power of the distance, from one side of a body to the other: of a box normal to
/// two faces, of a disc a diameter. x, y or z where no other line is nearer by more than a
/// hundredth: those of the canonical form are then as good.
[[nodiscard]] Eigen::Vector3d nearest_line(const FourthMoments& moments);

}  // namespace curveskel
