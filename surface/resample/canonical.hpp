// One pose, size and numbering for all copies of a surface.
#pragma once

#include <Eigen/Core>

#include <curveskel/surface.hpp>

namespace curveskel {

/// A surface in its canonical pose. Model position = origin + scale * rotation * position.
struct Canonical {
  Surface surface;                  ///< D = 1 up to rounding, centroid near the origin
  Eigen::VectorXi input_of_vertex;  ///< #V: canonical vertex -> vertex of the input
  Eigen::VectorXi vertex_of_input;  ///< #V: the other way round
  /// Columns: the principal axes. Of two mirror images one has a left-handed frame, in which it is
  /// the other one.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< the area's centroid, model units
  double scale = 1;                                  ///< D in that pose, model units

  /// Canonical positions (#P by 3) in the model's frame and units.
  [[nodiscard]] Positions to_model(const Positions& positions) const;
  /// Faces whose normals point out there as here.
  [[nodiscard]] Triangles to_model(Triangles triangles) const;
};

/// Coordinates of a canonical surface are multiples of this: coarse enough to swallow the noise
/// that scaling, translating and rotating leave behind, fine enough to keep the shape.
inline constexpr double canonical_step = 0x1p-22;

/// Moves the area's centroid to the origin, the principal axes of the area's covariance to x, y, z
/// (largest extent first), divides by D and rounds to `canonical_step`; vertices follow a Morton
/// curve, triangles start with their smallest vertex and are sorted. So a copy of the surface that
/// was scaled, translated, rotated, mirrored or renumbered has the same canonical surface, but for
/// a coordinate here and there that lies within the noise of a rounding border.
///
/// Signs of the axes come from third moments. Where a shape's symmetry leaves its axes open
/// (eigenvalues within 1e-6 of their sum, third moments near zero, see principal_frame), each of
/// its poses is tried and the rounded surface itself decides; poses that it cannot tell apart are
/// congruent. Only some of the poses are tried when there are more than 64, or more than 2e6 / #V:
/// then the numbering may decide.
///
/// Vertices closer than the step may coincide afterwards, and triangles thinner than it may lose
/// their area or turn over; connectivity never changes. Coincident vertices stand in the order of
/// the input.
/// Precondition: at least one triangle of positive area. Sums are exact, hence free of the
/// numbering and of the number of threads (0 = one per core). O(#V + #F).
[[nodiscard]] Canonical canonical_form(const Surface& surface, int threads = 0);

}  // namespace curveskel
