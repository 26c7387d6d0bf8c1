// Keys and letters in the order in which they were typed, portioned into frames.
#pragma once

#include <deque>
#include <vector>

namespace curveskel::viewer {

/// As GLFW reports it.
struct KeyEvent {
  int key = 0;
  int scancode = 0;
  bool down = false;
  bool modifier = false;  ///< the key is Ctrl, Shift, Alt or Super
  bool ends = false;      ///< the key is Enter or Escape, which end a dialogue
  int modifiers = 0;
  unsigned letter = 0;  ///< instead of a key, a letter was typed; 0 = none
  bool operator==(const KeyEvent&) const = default;
};

/// A key by the letter that it writes on the person's layout, as GLFW numbers keys by what a US
/// layout has in their places. `name` as of glfwGetKeyName, or null; digits stay in their row.
[[nodiscard]] int key_on_layout(int key, const char* name);

/// ImGui sees the keys once a frame: what goes down and up again between two frames would be lost,
/// and a shortcut whose Ctrl is let go at once would be another one.
class KeyQueue {
 public:
  void add(const KeyEvent& event) { waiting_.push_back(event); }
  [[nodiscard]] bool empty() const { return waiting_.empty(); }
  /// Keys for the next frame, in order: up to the second change of a key, the change of a
  /// modifier after a key went down, or text typed after a key that ends a dialogue.
  [[nodiscard]] std::vector<KeyEvent> take();

 private:
  std::deque<KeyEvent> waiting_;
};

}  // namespace curveskel::viewer
