#include "viewer/software/pace.hpp"

#include <algorithm>

namespace curveskel::viewer {
namespace {

/// In triangles drawn once. The figures were measured with Mesa's software renderer: for a graphics
/// card, which is always fast enough, they do not matter.
double work_of(const Fineness& fineness, const Pace::Load& load) {
  const double triangles_per_pixel = fineness.lit_at_vertices() ? 0.08 : 0.2;
  constexpr double more_samples = 2;  // four of them against one
  const double pixels = load.pixels / (fineness.shrink * fineness.shrink);
  const double drawn =
      static_cast<double>(load.triangles[static_cast<std::size_t>(fineness.level)]) +
      triangles_per_pixel * pixels;
  return 1 + (fineness.samples > 1 ? drawn * more_samples : drawn);
}

/// From the finest to the coarsest.
constexpr std::array<Fineness, 8> choices{
    {{0, 4, 1}, {0, 1, 1}, {1, 4, 1}, {1, 1, 1}, {2, 1, 1}, {2, 1, 2}, {3, 1, 2}, {3, 1, 3}}};

}  // namespace

bool finer(const Fineness& one, const Fineness& other) {
  return one.level < other.level || one.samples > other.samples || one.shrink < other.shrink;
}

void Pace::measured(const Fineness& fineness, const Load& load, double milliseconds) {
  recent_[count_ % recent_.size()] = milliseconds / work_of(fineness, load);
  ++count_;
}

void Pace::measured_rest(double milliseconds) {
  ++rests_;
  constexpr std::size_t memory = 10;  // frames
  rest_ += (milliseconds - rest_) / static_cast<double>(std::min(rests_, memory));
}

double Pace::predicted(const Fineness& fineness, const Load& load) const {
  if (count_ == 0) return 0;
  // A frame now and then that takes longer for reasons of its own does not count.
  auto times = recent_;
  const std::size_t known = std::min(count_, times.size());
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>((known - 1) / 2);
  std::nth_element(times.begin(), middle, times.begin() + static_cast<std::ptrdiff_t>(known));
  return *middle * work_of(fineness, load);
}

Fineness Pace::finest_within(const Load& load, double milliseconds) const {
  // A level that hardly saves any time is not worth its looks.
  constexpr double worth = 1.25;
  const double most = std::max(milliseconds, worth * predicted(choices.back(), load));
  return *std::find_if(choices.begin(), choices.end(),
                       [&](const Fineness& fineness) { return predicted(fineness, load) <= most; });
}

Fineness Pace::while_moving(const Load& load) {
  constexpr double frame_milliseconds = 1000.0 / 60;
  constexpr double least_milliseconds = 6;  // where the rest takes all of a frame
  constexpr double to_spare = 0.7;
  const double allowed = std::max(frame_milliseconds - rest_, least_milliseconds);
  if (predicted(moving_, load) > allowed) {
    moving_ = finest_within(load, allowed);
  } else {
    const Fineness other = finest_within(load, to_spare * allowed);
    if (!finer(moving_, other)) moving_ = other;
  }
  return moving_;
}

Fineness Pace::at_rest(const Load& load) const {
  constexpr double patience_milliseconds = 400;
  return finest_within(load, patience_milliseconds);
}

}  // namespace curveskel::viewer
