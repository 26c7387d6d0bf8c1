// How progress leaves the core and how a cancellation enters it.
#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "surface/error.hpp"
#include "surface/surface.hpp"

namespace curveskel {

/// Callbacks, all optional, called from the thread that runs the stage. A stage calls `report` at
/// least once per 100 ms of work, so a requested stop takes effect within that time.
struct Monitor {
  /// Stage name ("read", "coarsen", "contract", ...) and the fraction of it that is done, 0..1.
  std::function<void(std::string_view stage, double fraction)> progress;
  /// One line for the user about something that was changed or decided.
  std::function<void(std::string_view line)> note;
  /// After each contraction iteration (0 = before the first): the surface as it is now.
  std::function<void(int iteration, const Surface& surface)> frame;
  std::stop_token stop;

  /// Throws Cancelled if a stop was requested, then passes the progress on.
  void report(std::string_view stage, double fraction) const {
    if (stop.stop_requested()) throw Cancelled();
    if (progress) progress(stage, fraction);
  }
  void say(std::string_view line) const {
    if (note) note(line);
  }
};

}  // namespace curveskel
