// Seconds of each step of a stage, and the points that the step left outside.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace curveskel {

struct StepTime {
  std::string step;
  double seconds = 0;
  int outside = 0;  ///< points of the curve outside the surface after the step; the most of its
                    ///< runs, summed over components
};

/// The place of a step's time, put at the end if there is none yet.
inline StepTime& time_of(std::vector<StepTime>& times, std::string_view step) {
  const auto found = std::find_if(times.begin(), times.end(),
                                  [step](const StepTime& one) { return one.step == step; });
  if (found != times.end()) return *found;
  return times.emplace_back(StepTime{std::string(step)});
}

/// Adds the time of another component.
inline void add_step(std::vector<StepTime>& times, const StepTime& more) {
  StepTime& sum = time_of(times, more.step);
  sum.seconds += more.seconds;
  sum.outside += more.outside;
}

/// Adds up the time of each step, in the order of first use. For one thread at a time.
class StepClock {
 public:
  /// Returns what work() returns. An exception from work() passes through, and is not counted.
  template <typename Work>
  auto operator()(std::string_view step, const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    const auto stop = [&] {
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
      time_of(times_, step).seconds += taken.count();
    };
    if constexpr (std::is_void_v<decltype(work())>) {
      work();
      stop();
    } else {
      auto result = work();
      stop();
      return result;
    }
  }

  /// The number of points outside after one run of a step.
  void found_outside(std::string_view step, int points) {
    StepTime& time = time_of(times_, step);
    time.outside = std::max(time.outside, points);
  }

  [[nodiscard]] const std::vector<StepTime>& times() const { return times_; }

 private:
  std::vector<StepTime> times_;
};

}  // namespace curveskel
