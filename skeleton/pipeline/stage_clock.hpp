// Seconds per stage.
#pragma once

#include <algorithm>
#include <chrono>
#include <type_traits>
#include <vector>

#include <curveskel/advanced/step_clock.hpp>
#include <curveskel/extract.hpp>

namespace curveskel {

/// Adds the time of each stage to the list, in the order of first use.
class StageClock {
 public:
  explicit StageClock(std::vector<StageTime>& times) : times_(times) {}

  /// work() makes the stage's value; work(steps), if it takes a StepClock, times its steps there.
  template <typename Work>
  auto operator()(const char* stage, const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    StepClock steps;
    auto result = [&] {
      if constexpr (std::is_invocable_v<const Work&, StepClock&>) {
        return work(steps);
      } else {
        return work();
      }
    }();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    add({stage, seconds, steps.times()});
    return result;
  }

  void add(const StageTime& time) {
    const auto found = std::find_if(times_.begin(), times_.end(),
                                    [&](const StageTime& t) { return t.stage == time.stage; });
    if (found == times_.end()) {
      times_.push_back(time);
    } else {
      found->seconds += time.seconds;
      for (const StepTime& step : time.steps) add_step(found->steps, step);
    }
  }

 private:
  std::vector<StageTime>& times_;
};

}  // namespace curveskel
