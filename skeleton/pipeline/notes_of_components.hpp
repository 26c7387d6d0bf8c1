// Notes that many components give, said once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/monitor.hpp>

namespace curveskel {

/// The notes of a surface's components: each line once, with the number of those it is about, in
/// the components' order whatever the threads'.
class NotesOfComponents {
 public:
  NotesOfComponents(const Monitor& monitor, std::size_t components)
      : monitor_(monitor), lines_(components) {}

  /// The monitor of a component; its other callbacks are for the calling thread. Refers to this.
  [[nodiscard]] Monitor monitor_of(std::size_t component, bool on_calling_thread) {
    Monitor listening;
    if (on_calling_thread) listening = monitor_;
    listening.stop = monitor_.stop;
    listening.note = [&lines = lines_[component]](std::string_view line) {
      lines.emplace_back(line);
    };
    return listening;
  }

  void say_all() const {
    std::vector<std::pair<std::string, int>> counted;
    for (const auto& lines : lines_) {
      for (const std::string& line : lines) {
        const auto known = std::find_if(counted.begin(), counted.end(),
                                        [&](const auto& one) { return one.first == line; });
        if (known != counted.end()) {
          ++known->second;
        } else {
          counted.emplace_back(line, 1);
        }
      }
    }
    for (const auto& [line, times] : counted) {
      monitor_.say(times == 1 ? line : line + " (" + std::to_string(times) + " components)");
    }
  }

 private:
  const Monitor& monitor_;
  std::vector<std::vector<std::string>> lines_;  // by component
};

}  // namespace curveskel
