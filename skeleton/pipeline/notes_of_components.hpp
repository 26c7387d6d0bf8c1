// Notes that many components give, said once.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/monitor.hpp>

namespace curveskel {

/// The notes of a surface's components: each line once, with the number of those it is about.
class NotesOfComponents {
 public:
  explicit NotesOfComponents(const Monitor& monitor) : monitor_(monitor), listening_(monitor) {
    listening_.note = [this](std::string_view line) { ++times_of(line); };
  }
  NotesOfComponents(const NotesOfComponents&) = delete;
  NotesOfComponents& operator=(const NotesOfComponents&) = delete;
  ~NotesOfComponents() = default;

  /// That of the components.
  [[nodiscard]] const Monitor& monitor() const { return listening_; }

  void say_all() const {
    for (const auto& [line, times] : lines_) {
      monitor_.say(times == 1 ? line : line + " (" + std::to_string(times) + " components)");
    }
  }

 private:
  int& times_of(std::string_view line) {
    const auto found = std::find_if(lines_.begin(), lines_.end(),
                                    [&](const auto& known) { return known.first == line; });
    return found != lines_.end() ? found->second : lines_.emplace_back(line, 0).second;
  }

  const Monitor& monitor_;
  Monitor listening_;
  std::vector<std::pair<std::string, int>> lines_;
};

}  // namespace curveskel
