// Seconds per step of a stage.
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
};

/// Adds `more` to what `times` has of the same step, or at the end.
inline void add_step(std::vector<StepTime>& times, const StepTime& more) {
  const auto found = std::find_if(times.begin(), times.end(),
                                  [&](const StepTime& one) { return one.step == more.step; });
  if (found == times.end()) {
    times.push_back(more);
  } else {
    found->seconds += more.seconds;
  }
}

/// Adds up the time of each step, in the order of first use. For one thread at a time.
class StepClock {
 public:
  /// Returns what work() returns. What it throws passes through, and is not counted.
  template <typename Work>
  auto operator()(std::string_view step, const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    const auto stop = [&] {
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
      add_step(times_, {std::string(step), taken.count()});
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

  [[nodiscard]] const std::vector<StepTime>& times() const { return times_; }

 private:
  std::vector<StepTime> times_;
};

}  // namespace curveskel
