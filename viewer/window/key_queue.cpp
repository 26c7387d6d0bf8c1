#include "viewer/window/key_queue.hpp"

#include <algorithm>

namespace curveskel::viewer {

std::vector<KeyEvent> KeyQueue::take() {
  std::vector<KeyEvent> taken;
  const auto fits = [&](const KeyEvent& next) {
    if (!taken.empty() && taken.back().ends && taken.back().down) return false;
    if (next.letter != 0) return true;
    return std::none_of(taken.begin(), taken.end(), [&](const KeyEvent& before) {
      if (before.letter != 0) return false;
      return before.key == next.key || (next.modifier && !before.modifier && before.down);
    });
  };
  while (!waiting_.empty() && fits(waiting_.front())) {
    taken.push_back(waiting_.front());
    waiting_.pop_front();
  }
  return taken;
}

}  // namespace curveskel::viewer
