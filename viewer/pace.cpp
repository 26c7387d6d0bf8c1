#include "viewer/pace.hpp"

#include <algorithm>

namespace curveskel::viewer {
namespace {

/// In triangles drawn once. The figures were measured with Mesa's software renderer: for a graphics
/// card, which is always fast enough, they do not matter.
double work_of(const Fineness& fineness, const Pace::Load& load) {
  constexpr double triangles_per_pixel = 0.06;
  constexpr double more_samples = 2;  // four of them against one
  const double pixels = load.pixels / (fineness.shrink * fineness.shrink);
  const double drawn =
      static_cast<double>(load.triangles[static_cast<std::size_t>(fineness.level)]) +
      triangles_per_pixel * pixels;
  return 1 + (fineness.samples > 1 ? drawn * more_samples : drawn);
}

/// From the finest to the coarsest.
constexpr std::array<Fineness, 6> choices{
    {{0, 4, 1}, {0, 1, 1}, {1, 4, 1}, {1, 1, 1}, {2, 1, 1}, {2, 1, 2}}};

}  // namespace

void Pace::measured(const Fineness& fineness, const Load& load, double milliseconds) {
  const double now = milliseconds / work_of(fineness, load);
  ++count_;
  // The first pictures compile shaders: the fastest of them is nearest to the truth.
  constexpr int warm_up = 3;
  constexpr double share = 0.3;  // of a new time in the running mean
  if (count_ <= warm_up) {
    milliseconds_per_work_ = count_ == 1 ? now : std::min(milliseconds_per_work_, now);
  } else {
    milliseconds_per_work_ += share * (now - milliseconds_per_work_);
  }
}

double Pace::predicted(const Fineness& fineness, const Load& load) const {
  return milliseconds_per_work_ * work_of(fineness, load);
}

Fineness Pace::choose(const Load& load, double milliseconds) const {
  for (const Fineness& fineness : choices) {
    if (predicted(fineness, load) <= milliseconds) return fineness;
  }
  return choices.back();
}

}  // namespace curveskel::viewer
