// The plots of the timeline, without drawing.
#pragma once

#include <cstddef>
#include <vector>

#include "viewer/model/recording.hpp"

namespace curveskel::viewer {

/// Of a logarithmic plot; both above 0.
struct PlotRange {
  double low = 0;
  double high = 0;
};

/// Components of a run come one after the other, or side by side: the timeline plots the one that
/// the moment shows, or the last one before it that is shown; -1 = there is none.
[[nodiscard]] int component_at(const std::vector<Moment>& moments, std::size_t moment);

/// Its moments that have a surface, in order.
[[nodiscard]] std::vector<std::size_t> moments_of(const std::vector<Moment>& moments,
                                                  int component);

/// From the least to the greatest residual that was left by a solve.
[[nodiscard]] PlotRange range_of_residuals(const std::vector<Moment>& moments,
                                           const std::vector<std::size_t>& plotted);

/// 1 at the top, 0 at the bottom and below.
[[nodiscard]] float height_of(double value, const PlotRange& range);

}  // namespace curveskel::viewer
