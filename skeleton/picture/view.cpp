#include <curveskel/view.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <string>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include "skeleton/graph/sound_skeleton.hpp"
#include "surface/resample/principal_frame.hpp"

namespace curveskel {
namespace {

constexpr double margin_share = 0.035;  // of the picture's shorter side

/// Rows: the principal axes of the surface, the longest first.
Eigen::Matrix3d principal_axes(const Surface& surface) {
  if (!(area(surface) > 0)) return Eigen::Matrix3d::Identity();
  return principal_frame(surface, 1).axes.front().transpose();
}

/// Rows: the same of the skeleton's edges, the shortest first.
Eigen::Matrix3d principal_axes(const CurveSkeleton& skeleton) {
  double total = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const auto for_edges = [&](const auto& add) {
    for (const auto& edge : skeleton.edges.rowwise()) {
      const Eigen::Vector3d a = skeleton.nodes.row(edge[0]);
      const Eigen::Vector3d b = skeleton.nodes.row(edge[1]);
      add((a + b) / 2, b - a, (b - a).norm());
    }
  };
  for_edges([&](const Eigen::Vector3d& middle, const Eigen::Vector3d&, double length) {
    total += length;
    mean += length * middle;
  });
  if (!(total > 0)) return Eigen::Matrix3d::Identity();
  mean /= total;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for_edges([&](const Eigen::Vector3d& middle, const Eigen::Vector3d& along, double length) {
    const Eigen::Vector3d from_mean = middle - mean;
    moments += length * (from_mean * from_mean.transpose() + along * along.transpose() / 12);
  });
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().transpose();
}

struct ViewExtent {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  [[nodiscard]] Eigen::Vector3d size() const { return high - low; }
  [[nodiscard]] Eigen::Vector3d middle() const { return (low + high) / 2; }
};

/// Along the rows of `axes`.
ViewExtent extent_along(const Positions& positions, const Eigen::Matrix3d& axes) {
  ViewExtent extent{Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()),
                    Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity())};
  for (const auto& position : positions.rowwise()) {
    const Eigen::Vector3d along = axes * position.transpose();
    extent.low = extent.low.cwiseMin(along);
    extent.high = extent.high.cwiseMax(along);
  }
  return extent;
}

/// The share of its box on which the shape would stand if `axis` pointed up: the box of the
/// vertices next to the lower end, seen along the axis, over that of all.
double footing(const Positions& positions, const ViewExtent& extent, int axis) {
  constexpr double sole = 0.02;  // of the height
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const double limit = extent.low(axis) + sole * extent.size()(axis);
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high = -low;
  for (const auto& position : positions.rowwise()) {
    if (position(axis) > limit) continue;
    const Eigen::Array2d at(position(u), position(v));
    low = low.min(at);
    high = high.max(at);
  }
  return (high - low).prod() / (extent.size()(u) * extent.size()(v));
}

struct Upright {
  Eigen::Matrix3d axes;  ///< rows: right, up, towards the viewer
  bool seen_from_above;
};

/// Rows right, up, towards the viewer for a shape that is aligned with its coordinate frame, where
/// either y or z is up.
Upright upright_axes(const ViewExtent& extent, bool z_is_up) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  Eigen::Index look = 0;
  extent.size().minCoeff(&look);
  Eigen::Matrix3d axes;  // filled column by column
  if (look == 2) {
    axes << x, y, z;
  } else if (look == 0 && z_is_up) {
    axes << y, z, x;
  } else if (look == 0) {
    axes << -z, y, x;
  } else if (z_is_up) {
    axes << x, z, -y;
  } else {  // it lies on its broad side: seen from above
    axes << x, -z, y;
  }
  return {axes.transpose(), (look == 1 && !z_is_up) || (look == 2 && z_is_up)};
}

/// Rows right, up, towards the viewer from principal axes, with x or y as much as can be on the
/// side where the reader expects them.
Eigen::Matrix3d principal_view(const Positions& positions, Eigen::Matrix3d axes,
                               bool long_axis_upright) {
  const Eigen::Vector3d size = extent_along(positions, axes).size();
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size(a) > size(b); });
  Eigen::Vector3d right = axes.row(order[long_axis_upright ? 1 : 0]);
  Eigen::Vector3d up = axes.row(order[long_axis_upright ? 0 : 1]);
  const auto positive = [](Eigen::Vector3d axis) {
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    return Eigen::Vector3d(axis(largest) < 0 ? -axis : axis);
  };
  right = positive(right);
  up = positive(up);
  axes << right.transpose(), up.transpose(), right.cross(up).transpose();
  return axes;
}

/// The first view, and where the second one is.
struct Layout {
  Eigen::Matrix3d axes;
  bool seen_from_above = false;  ///< the shape's up points towards the viewer
  bool beside = true;            ///< the second view is to the right of the first, else below
  double scale = 0;
};

Layout best_layout(const Positions& positions, const Upright& first, double width, double height,
                   double margin) {
  // The side view of a lying shape belongs below it, with the ground at the bottom.
  constexpr double worth_of_ground = 0.65;
  constexpr double least_extent = 1e-300;  // keeps the scale of a single point finite
  const Eigen::Vector3d size = extent_along(positions, first.axes).size().cwiseMax(least_extent);
  const auto fit = [&](double columns, double rows, double across, double down) {
    return std::min((width - (columns + 1) * margin) / across,
                    (height - (rows + 1) * margin) / down);
  };
  const double beside = fit(2, 1, size.x() + size.z(), size.y());
  const double below = fit(1, 2, size.x(), size.y() + size.z());
  const bool is_beside = below < beside * (first.seen_from_above ? worth_of_ground : 1);
  return {first.axes, first.seen_from_above, is_beside, is_beside ? beside : below};
}

/// The axis that a file says is up, 1 or 2; -1 for any other direction and where it says nothing.
int stated_axis(const Eigen::Vector3d& up) {
  constexpr double nearly = 1 - 1e-6;
  for (const int axis : {1, 2}) {
    if (up(axis) > nearly) return axis;
  }
  return -1;
}

std::array<View, 2> best_views_of(const Positions& positions, const Eigen::Matrix3d& principal,
                                  int width, int height, const Eigen::Vector3d& up) {
  // A box that is this much smaller along the principal axes shows that the frame is arbitrary.
  constexpr double worth_turning = 0.75;
  const double margin = margin_share * std::min(width, height);
  const auto layout_of = [&](const Upright& first) {
    return best_layout(positions, first, width, height, margin);
  };

  const ViewExtent box = extent_along(positions, Eigen::Matrix3d::Identity());
  const double smaller = extent_along(positions, principal).size().prod();
  Layout layout;
  const int stated = stated_axis(up);
  if (stated > 0) {
    layout = layout_of(upright_axes(box, stated == 2));
  } else if (smaller < worth_turning * box.size().prod()) {
    const Layout lying = layout_of({principal_view(positions, principal, false), false});
    const Layout standing = layout_of({principal_view(positions, principal, true), false});
    layout = lying.scale >= standing.scale ? lying : standing;
  } else {
    layout = layout_of(upright_axes(box, footing(positions, box, 2) > footing(positions, box, 1)));
  }

  const ViewExtent extent = extent_along(positions, layout.axes);
  const Eigen::Vector3d pixels = extent.size() * layout.scale;
  const Eigen::Vector3d target = layout.axes.transpose() * extent.middle();
  const Eigen::Vector3d right = layout.axes.row(0);
  const Eigen::Vector3d upwards = layout.axes.row(1);
  const Eigen::Vector3d towards = layout.axes.row(2);
  View first{layout.axes, target, {width / 2.0, height / 2.0}, layout.scale};
  View second = first;
  if (layout.beside) {
    second.axes << -towards.transpose(), upwards.transpose(), right.transpose();
    const double gap = (width - pixels.x() - pixels.z()) / 3;
    first.centre.x() = gap + pixels.x() / 2;
    second.centre.x() = width - gap - pixels.z() / 2;
  } else {
    if (layout.seen_from_above) {
      second.axes << right.transpose(), towards.transpose(), -upwards.transpose();
    } else {
      second.axes << right.transpose(), -towards.transpose(), upwards.transpose();
    }
    const double gap = (height - pixels.y() - pixels.z()) / 3;
    first.centre.y() = gap + pixels.y() / 2;
    second.centre.y() = height - gap - pixels.z() / 2;
  }
  return {first, second};
}

void require_viewable(const Positions& positions, int width, int height) {
  if (width < 1 || height < 1) {
    throw Error(Fault::usage, "best_views: found a picture of " + std::to_string(width) + " x " +
                                  std::to_string(height) + " pixels, needed one at least");
  }
  constexpr double most = 1e150;
  if (positions.allFinite() && bounding_box_diagonal(positions) <= most) return;
  throw Error(Fault::input,
              "best_views: found a coordinate that is no finite number, or a bounding box with a "
              "diagonal above 1e150, needed finite ones and a smaller box");
}

}  // namespace

std::array<View, 2> best_views(const Surface& surface, int width, int height,
                               const Eigen::Vector3d& up) {
  require_corners(surface, "best_views");
  require_viewable(surface.positions, width, height);
  return best_views_of(surface.positions, principal_axes(surface), width, height, up);
}

std::array<View, 2> best_views(const CurveSkeleton& skeleton, int width, int height) {
  require_sound(skeleton, "best_views");
  require_viewable(skeleton.nodes, width, height);
  return best_views_of(skeleton.nodes, principal_axes(skeleton), width, height,
                       Eigen::Vector3d::Zero());
}

}  // namespace curveskel
