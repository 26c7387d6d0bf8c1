// Squared distance to a set of planes, as a function of position.
#pragma once

#include <Eigen/Core>

namespace curveskel {

/// f(x) = x^T A x + 2 b^T x + c with x relative to the quadric's own origin (Garland and Heckbert
/// 1997). Origins stay near the planes, so single precision is enough.
struct Quadric {
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< A, symmetric
  Eigen::Vector3f b = Eigen::Vector3f::Zero();
  float c = 0;

  /// weight times the squared distance to the plane through the origin with this unit normal.
  void add_plane(const Eigen::Vector3f& normal, float weight) {
    const Eigen::Vector3f weighted = weight * normal;
    xx += weighted.x() * normal.x();
    xy += weighted.x() * normal.y();
    xz += weighted.x() * normal.z();
    yy += weighted.y() * normal.y();
    yz += weighted.y() * normal.z();
    zz += weighted.z() * normal.z();
  }

  /// Sum of the planes' weights.
  [[nodiscard]] float trace() const { return xx + yy + zz; }

  [[nodiscard]] Eigen::Vector3f times(const Eigen::Vector3f& x) const {
    return {xx * x.x() + xy * x.y() + xz * x.z(), xy * x.x() + yy * x.y() + yz * x.z(),
            xz * x.x() + yz * x.y() + zz * x.z()};
  }

  /// The same function, its origin moved by `step`.
  [[nodiscard]] Quadric moved(const Eigen::Vector3f& step) const {
    Quadric result = *this;
    result.b += times(step);
    result.c += step.dot(b + result.b);
    return result;
  }

  void operator+=(const Quadric& other) {  ///< both about the same origin
    xx += other.xx;
    xy += other.xy;
    xz += other.xz;
    yy += other.yy;
    yz += other.yz;
    zz += other.zz;
    b += other.b;
    c += other.c;
  }

  struct Minimum {
    Eigen::Vector3f point;
    float value;  ///< f there
  };
  /// Of f(x) + stiffness * trace * |x|^2: where the planes leave the point free, it stays at the
  /// origin.
  [[nodiscard]] Minimum minimum(float stiffness) const {
    const float hold = stiffness * trace();
    const float a = xx + hold;
    const float d = yy + hold;
    const float f = zz + hold;
    // Inverse by cofactors: A + hold is positive definite.
    const float p = d * f - yz * yz;
    const float q = xz * yz - xy * f;
    const float r = xy * yz - xz * d;
    const float determinant = a * p + xy * q + xz * r;
    if (!(determinant > 0)) return {Eigen::Vector3f::Zero(), c};
    const float inverse = -1 / determinant;
    const float s = xy * xz - a * yz;
    const Eigen::Vector3f x(inverse * (p * b.x() + q * b.y() + r * b.z()),
                            inverse * (q * b.x() + (a * f - xz * xz) * b.y() + s * b.z()),
                            inverse * (r * b.x() + s * b.y() + (a * d - xy * xy) * b.z()));
    return {x, c + b.dot(x) - hold * x.squaredNorm()};
  }
};

}  // namespace curveskel
