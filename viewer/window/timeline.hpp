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

/// The component that the moment shows; of one that shows all, the one of the largest surface, the
/// first of equals; -1 = there is none.
[[nodiscard]] int component_at(const std::vector<Moment>& moments, std::size_t moment);

/// A run goes through its components one after the other, or several at once: the moments of this
/// one and those of all, in order.
[[nodiscard]] std::vector<std::size_t> moments_with(const std::vector<Moment>& moments,
                                                    int component);

/// From the least to the greatest residual that was left by a solve.
[[nodiscard]] PlotRange range_of_residuals(const std::vector<Moment>& moments,
                                           const std::vector<std::size_t>& plotted);

/// 1 at the top, 0 at the bottom and below.
[[nodiscard]] float height_of(double value, const PlotRange& range);

}  // namespace curveskel::viewer
