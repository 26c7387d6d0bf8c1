#include "viewer/window/key_queue.hpp"

#include <algorithm>

namespace curveskel::viewer {

int key_on_layout(int key, const char* name) {
  if (name == nullptr || name[0] == '\0' || name[1] != '\0') return key;
  const char written = name[0];
  const bool is_letter = (written >= 'a' && written <= 'z') || (written >= 'A' && written <= 'Z');
  const bool was_letter = key >= 'A' && key <= 'Z';
  // GLFW's numbers of keys that write ASCII are those of their capital letters and signs.
  if (is_letter) return written >= 'a' ? written - 'a' + 'A' : written;
  return was_letter && written > ' ' ? written : key;
}

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
