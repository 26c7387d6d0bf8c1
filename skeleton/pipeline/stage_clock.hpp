// Seconds per stage.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include <curveskel/extract.hpp>

namespace curveskel {

/// Adds the time of each stage to the list, in the order of first use.
class StageClock {
 public:
  explicit StageClock(std::vector<StageTime>& times) : times_(times) {}

  template <typename Work>
  auto operator()(const char* stage, const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    add({stage, seconds});
    return result;
  }

  void add(const StageTime& time) {
    const auto found = std::find_if(times_.begin(), times_.end(),
                                    [&](const StageTime& t) { return t.stage == time.stage; });
    if (found == times_.end()) {
      times_.push_back(time);
    } else {
      found->seconds += time.seconds;
    }
  }

 private:
  std::vector<StageTime>& times_;
};

}  // namespace curveskel
