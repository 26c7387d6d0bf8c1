// The way progress leaves the core and a cancellation enters it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string_view>

#include <curveskel/error.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// The try of an extraction that something is shown of.
struct ShownTry {
  int number = -1;        ///< in Extraction::history; -1 where a stage runs on its own
  int of_surface = -1;    ///< the same of the try of the whole surface that it is part of
  std::string_view name;  ///< "as asked", "faired", "faired, gentler contraction", ...
};

/// A surface on its way through a stage.
struct Frame {
  std::string_view stage;   ///< "fair" or "contract"
  int component = 0;        ///< of `topology`, of the surface that the try is of; else 0
  int iteration = 0;        ///< 0 = before the first
  double area_ratio = 1;    ///< area / that of iteration 0; never grows in "contract"
  double volume_ratio = 1;  ///< |volume| / that of iteration 0
  double residual = 0;      ///< contract: see Solution::residual; fair: 0
  const Surface& surface;   ///< in the frame of what the stage was called with, `extract`'s is the
                            ///< model's; lives as long as the call
  ShownTry made_in{};
};

/// A curve on its way: the surgery's graph of a component, before embedding.
struct CurveFrame {
  std::string_view stage;  ///< "surgery"
  int component = 0;       ///< of `topology`, of the surface that the try is of
  const Positions& nodes;  ///< #N by 3, in the model's frame
  const Eigen::Matrix<std::int32_t, Eigen::Dynamic, 2, Eigen::RowMajor>& edges;  ///< #E by 2
  ShownTry made_in{};
};

/// Throws Cancelled if a stop was requested: for loops that have no progress to tell.
inline void throw_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Cancelled();
}

/// Callbacks, all optional, called from the thread that runs the stage. A stage calls `report` at
/// least once per 100 ms of work, or asks `stop`, so that a requested stop takes effect within that
/// time, but for single steps that are longer on surfaces of hundreds of handles.
struct Monitor {
  /// Stage name ("read", "coarsen", "contract", ...) and the fraction of it that is done, 0..1.
  std::function<void(std::string_view stage, double fraction)> progress;
  /// One line for the user about something that was changed or decided.
  std::function<void(std::string_view line)> note;
  /// The surface before the first and after each iteration of `fair` and `contract`. Another try of
  /// `extract` counts from 0 again, see Frame::made_in.
  std::function<void(const Frame& frame)> frame;
  /// A component's curve when its surgery has succeeded.
  std::function<void(const CurveFrame& curve)> curve;
  std::stop_token stop;

  /// Throws Cancelled if a stop was requested, then passes the progress on.
  void report(std::string_view stage, double fraction) const {
    throw_if_stopped(stop);
    if (progress) progress(stage, fraction);
  }
  void say(std::string_view line) const {
    if (note) note(line);
  }
};

}  // namespace curveskel
