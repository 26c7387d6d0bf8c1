#include "surface/resample/principal_frame.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/exact_sum.hpp"
#include "base/parallel.hpp"
#include "surface/mesh/triangle_area.hpp"
#include "surface/resample/fourth_moments.hpp"

namespace curveskel {
namespace {

constexpr double equal_eigenvalues = 1e-6;  // relative to their sum
constexpr double no_skewness = 1e-6;        // third moment over its largest possible value
constexpr double equal_sizes = 1e-7;        // relative
constexpr double no_symmetry = 1e-6;        // angular moment over its largest possible value
constexpr std::size_t least_fold = 3;       // moments of lower order vanish in an open plane
constexpr std::size_t most_fold = 8;
constexpr std::size_t folds = most_fold - least_fold + 1;

using Moment = std::complex<double>;

using CornerPoints = std::array<Eigen::Vector3d, 3>;

class Pose {
 public:
  Pose(const Surface& surface, int threads) : surface_(surface), threads_(threads) {
    const Eigen::RowVector3d low = surface.positions.colwise().minCoeff();
    const Eigen::RowVector3d high = surface.positions.colwise().maxCoeff();
    middle_ = (low + (high - low) / 2).transpose();
    const double extent = (high - low).maxCoeff();
    // A power of two, so that scaling rounds nothing.
    unit_ = extent > 0 ? std::exp2(-std::ceil(std::log2(extent))) : 1;
    points_ = (surface.positions.rowwise() - middle_.transpose()) * unit_;
    measure();
  }

  PrincipalFrame frame(std::size_t most_candidates) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance_);
    const Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse();
    const Eigen::Vector3d values = solver.eigenvalues().reverse();
    const double bound = equal_eigenvalues * values.sum();
    const bool first_open = values(0) - values(1) < bound;
    const bool last_open = values(1) - values(2) < bound;
    std::vector<Eigen::Matrix3d> candidates;
    // From two neighbouring columns, the one at `column` and the next, with either third one.
    const auto add = [&](Eigen::Index column, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      Eigen::Matrix3d frame;
      frame.col(column) = a;
      frame.col((column + 1) % 3) = b;
      const Eigen::Index last = (column + 2) % 3;
      frame.col(last) = a.cross(b);
      for (int hand = 0; hand < 2; ++hand) {
        if (candidates.size() < most_candidates) candidates.push_back(frame);
        frame.col(last) = -frame.col(last);
      }
    };
    if (first_open && last_open) {
      for (const auto& a : directions_in_space()) {
        if (candidates.size() >= most_candidates) break;
        for (const auto& b : directions_across(a)) add(0, a, b);
      }
    } else if (first_open || last_open) {
      const Eigen::Index settled = first_open ? 2 : 0;
      for (const double sign : signs(skewness(axes)(settled))) {
        const Eigen::Vector3d a = sign * axes.col(settled);
        for (const auto& b : directions_across(a)) add(settled, a, b);
      }
    } else {
      // The least skew axis points away from its own third moment, the others towards theirs: as
      // good as any other rule, and it leaves most surfaces of the studies in the frame they had.
      Eigen::Vector3d skew = skewness(axes);
      Eigen::Index weakest = 0;
      skew.cwiseAbs().minCoeff(&weakest);
      skew(weakest) = -skew(weakest);
      for (const double x : signs(skew.x())) {
        for (const double y : signs(skew.y())) {
          for (const double z : signs(skew.z())) {
            const Eigen::Matrix3d frame = axes * Eigen::Vector3d(x, y, z).asDiagonal();
            if (candidates.size() < most_candidates) candidates.push_back(frame);
          }
        }
      }
    }
    return {middle_ + mean_ / unit_, candidates};
  }

 private:
  static std::vector<double> signs(double skew) {
    if (std::abs(skew) <= no_skewness) return {1, -1};
    return {skew < 0 ? -1.0 : 1.0};
  }

  Eigen::Vector3d point(Eigen::Index vertex) const { return points_.row(vertex).transpose(); }

  Eigen::Vector3d across(const Eigen::Vector3d& axis, int vertex) const {
    const Eigen::Vector3d p = point(vertex);
    return p - axis.dot(p) * axis;
  }

  template <typename Value>
  static void keep_largest(std::vector<int>& vertices, double size, const Value& value) {
    double largest = -std::numeric_limits<double>::infinity();
    for (const int v : vertices) largest = std::max(largest, value(v));
    std::erase_if(vertices, [&](int v) { return value(v) < largest - equal_sizes * size; });
  }

  // Sorted by coordinates, so that no result depends on the numbering.
  CornerPoints corners(Eigen::Index face) const {
    CornerPoints p = {point(surface_.triangles(face, 0)), point(surface_.triangles(face, 1)),
                      point(surface_.triangles(face, 2))};
    const auto before = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return a.x() != b.x() ? a.x() < b.x() : a.y() != b.y() ? a.y() < b.y() : a.z() < b.z();
    };
    if (before(p[1], p[0])) p[0].swap(p[1]);
    if (before(p[2], p[1])) p[1].swap(p[2]);
    if (before(p[1], p[0])) p[0].swap(p[1]);
    return p;
  }

  // The corners of a triangle lie anywhere in memory, and the sums leave time to bring them.
  void fetch_ahead(std::size_t index, std::size_t end) const {
    constexpr std::size_t ahead = 12;
    if (index + ahead >= end) return;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index v = surface_.triangles(static_cast<Eigen::Index>(index + ahead), k);
      __builtin_prefetch(points_.data() + 3 * v);
    }
  }

  // Sums over the triangles of what add(index, sums) adds; exact, so how they are split is no
  // matter.
  template <std::size_t count, typename Add>
  std::array<ExactSum, count> summed(const Add& add) const {
    const auto triangles = static_cast<std::size_t>(surface_.triangles.rows());
    const auto zero = [&]<std::size_t... each>(std::index_sequence<each...>) {
      return std::array<ExactSum, count>{(static_cast<void>(each), ExactSum(1, 3 * triangles))...};
    }
    (std::make_index_sequence<count>());
    constexpr std::size_t grain = 1 << 14;
    std::vector<std::array<ExactSum, count>> parts((triangles + grain - 1) / grain, zero);
    parallel_for(triangles, grain, threads_, [&](std::size_t begin, std::size_t end) {
      auto part = zero;
      for (std::size_t index = begin; index < end; ++index) {
        fetch_ahead(index, end);
        add(index, part);
      }
      parts[begin / grain] = part;
    });
    auto all = zero;
    for (const auto& part : parts) {
      for (std::size_t i = 0; i < count; ++i) all[i].add(part[i]);
    }
    return all;
  }

  // Area, centroid and covariance of the surface as a sheet of even thickness.
  void measure() {
    sheets_.resize(static_cast<std::size_t>(surface_.triangles.rows()));
    const auto sums = summed<10>([&](std::size_t index, std::array<ExactSum, 10>& part_sums) {
      const auto [p, q, r] = corners(static_cast<Eigen::Index>(index));
      const double part = twice_area(p, q, r) / 2;
      const Eigen::Vector3d s = p + q + r;
      sheets_[index] = {s / 3, part};
      part_sums[0].add(part);
      for (std::size_t i = 0; i < 3; ++i) {
        part_sums[1 + i].add(part / 3 * s(static_cast<Eigen::Index>(i)));
      }
      const double twelfth = part / 12;
      std::size_t next = 4;
      for (Eigen::Index i = 0; i < 3; ++i) {
        for (Eigen::Index j = i; j < 3; ++j) {
          part_sums[next++].add(twelfth * (p(i) * p(j) + q(i) * q(j) + r(i) * r(j) + s(i) * s(j)));
        }
      }
    });
    const double area = sums[0].value();
    if (!(area > 0)) return;
    mean_ = Eigen::Vector3d(sums[1].value(), sums[2].value(), sums[3].value()) / area;
    std::size_t next = 4;
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = i; j < 3; ++j) {
        covariance_(i, j) = covariance_(j, i) = sums[next++].value() / area - mean_(i) * mean_(j);
      }
    }
    points_.rowwise() -= mean_.transpose();
  }

  // Third moment along each axis over the largest that the same areas allow.
  Eigen::Vector3d skewness(const Eigen::Matrix3d& axes) const {
    const auto sums = summed<6>([&](std::size_t index, std::array<ExactSum, 6>& part_sums) {
      const Sheet& sheet = sheets_[index];
      const Eigen::Vector3d along = axes.transpose() * (sheet.centre - mean_);
      for (std::size_t k = 0; k < 3; ++k) {
        const double a = along(static_cast<Eigen::Index>(k));
        const double cube = sheet.area * a * a * a / 8;  // |a| < 2
        part_sums[k].add(cube);
        part_sums[3 + k].add(std::abs(cube));
      }
    });
    Eigen::Vector3d ratios = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const double size = sums[3 + k].value();
      if (size > 0) ratios(static_cast<Eigen::Index>(k)) = sums[k].value() / size;
    }
    return ratios;
  }

  // Both senses of the lines along which the fourth moment is least like the others: normal to a
  // cube's faces, to an octahedron's corners.
  std::vector<Eigen::Vector3d> directions_in_space() const {
    constexpr std::size_t count = fourth_moments;
    const auto sums =
        summed<1 + count>([&](std::size_t index, std::array<ExactSum, 1 + count>& part) {
          const auto [p, q, r] = corners(static_cast<Eigen::Index>(index));
          const double area = sheets_[index].area;
          part[0].add(area);
          const FourthMoments moments = fourth_moments_of_triangle(p, q, r);
          for (std::size_t i = 0; i < count; ++i)
            part[1 + i].add(area / 8 * moments[i]);  // |p| < 1.7
        });
    FourthMoments moments{};
    for (std::size_t i = 0; i < count; ++i) moments[i] = sums[1 + i].value() * 8 / sums[0].value();
    const std::vector<Eigen::Vector3d> directions = extreme_directions(moments, no_symmetry);
    return directions.empty() ? directions_farthest_out(Eigen::Vector3d::Zero()) : directions;
  }

  // Unit vectors across `axis` (unit): where the surface has an angular moment about the axis, its
  // least order m settles them up to m-th parts of a turn. Those of a square plate are normal to
  // its sides. Any mirror plane through the axis holds one of them, or the bisector of two.
  std::vector<Eigen::Vector3d> directions_across(const Eigen::Vector3d& axis) const {
    const Eigen::Vector3d right = axis.unitOrthogonal();
    const Eigen::Vector3d up = axis.cross(right);
    const std::array<Moment, folds> moments = angular_moments(right, up);
    for (std::size_t i = 0; i < folds; ++i) {
      if (std::abs(moments[i]) <= no_symmetry) continue;
      const std::size_t fold = least_fold + i;
      const double away = fold % 2 == 0 ? std::numbers::pi : 0;  // from where the surface is far
      std::vector<Eigen::Vector3d> directions;
      for (std::size_t k = 0; k < fold; ++k) {
        const double angle =
            (std::arg(moments[i]) + away + 2 * std::numbers::pi * double(k)) / double(fold);
        directions.emplace_back(std::cos(angle) * right + std::sin(angle) * up);
      }
      return directions;
    }
    return directions_farthest_out(axis);
  }

  // The mean of (x + i y)^m over the surface for each fold m, the farthest vertex at |x + i y| = 1.
  // Over a triangle it is the mean of all products of m corners.
  std::array<Moment, folds> angular_moments(const Eigen::Vector3d& right,
                                            const Eigen::Vector3d& up) const {
    const double farthest = std::sqrt(
        ((points_ * right).array().square() + (points_ * up).array().square()).maxCoeff());
    std::array<Moment, folds> moments{};
    if (!(farthest > 0)) return moments;
    const auto place = [&](const Eigen::Vector3d& p) {
      return Moment(p.dot(right), p.dot(up)) / farthest;
    };
    const auto sums =
        summed<1 + 2 * folds>([&](std::size_t index, std::array<ExactSum, 1 + 2 * folds>& part) {
          const auto [p, q, r] = corners(static_cast<Eigen::Index>(index));
          const double area = sheets_[index].area;
          part[0].add(area);
          std::array<Moment, most_fold + 1> products{1};  // sums of all products of m corners
          for (const Moment& corner : {place(p), place(q), place(r)}) {
            for (std::size_t m = 1; m <= most_fold; ++m) products[m] += corner * products[m - 1];
          }
          for (std::size_t i = 0; i < folds; ++i) {
            const auto m = double(least_fold + i);
            const Moment moment = area * products[least_fold + i] * (2 / ((m + 1) * (m + 2)));
            part[1 + 2 * i].add(moment.real());
            part[2 + 2 * i].add(moment.imag());
          }
        });
    if (!(sums[0].value() > 0)) return moments;
    for (std::size_t i = 0; i < folds; ++i) {
      moments[i] = Moment(sums[1 + 2 * i].value(), sums[2 + 2 * i].value()) / sums[0].value();
    }
    return moments;
  }

  // Unit vectors across `axis` (unit or zero) to the vertices farthest from it; of these, to those
  // farthest along it, then to those with the longest edges.
  std::vector<Eigen::Vector3d> directions_farthest_out(const Eigen::Vector3d& axis) const {
    std::vector<int> candidates(static_cast<std::size_t>(surface_.positions.rows()));
    std::iota(candidates.begin(), candidates.end(), 0);
    keep_largest(candidates, 1, [&](int v) { return across(axis, v).norm(); });
    keep_largest(candidates, 1, [&](int v) { return axis.dot(point(v)); });
    if (candidates.size() > 1) {
      std::vector<double> edges(static_cast<std::size_t>(surface_.positions.rows()), 0);
      for (Eigen::Index face = 0; face < surface_.triangles.rows(); ++face) {
        for (Eigen::Index k = 0; k < 3; ++k) {
          const int a = surface_.triangles(face, k);
          const int b = surface_.triangles(face, (k + 1) % 3);
          edges[static_cast<std::size_t>(a)] += (point(b) - point(a)).norm();
        }
      }
      const auto length = [&](int v) { return edges[static_cast<std::size_t>(v)]; };
      keep_largest(candidates, length(candidates.front()), length);
    }
    std::vector<Eigen::Vector3d> directions;
    for (const int v : candidates) {
      const Eigen::Vector3d out = across(axis, v);
      directions.push_back(out.norm() > 0 ? Eigen::Vector3d(out.normalized())
                                          : Eigen::Vector3d(axis.unitOrthogonal()));
    }
    return directions;
  }

  struct Sheet {
    Eigen::Vector3d centre;  // about the middle
    double area;
  };

  const Surface& surface_;
  int threads_;
  Eigen::Vector3d middle_;
  double unit_ = 1;
  Positions points_;  // about the middle of the bounding box at first, then about the centroid
  std::vector<Sheet> sheets_;
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Identity();
};

}  // namespace

PrincipalFrame principal_frame(const Surface& surface, std::size_t most_candidates, int threads) {
  return Pose(surface, threads).frame(most_candidates);
}

}  // namespace curveskel
