// Keys for the panels: Tab goes from control to control, arrows, Space and Enter use them.
#pragma once

namespace curveskel::viewer {

/// A combo box or another popup.
[[nodiscard]] bool is_list_open();

/// The last item, while keys are for the panels, was chosen by Space or Enter.
[[nodiscard]] bool is_pressed_by_key();

/// Keys are for the picture until Tab is pressed, and again after Esc or a click. While they are
/// for the panels, a frame stands round a control, and ImGui's own navigation does the rest. A
/// question and an open list have them from the start.
class PanelKeys {
 public:
  enum class Over { nothing, list, dialogue, question };

  /// Within an ImGui frame, before the panels: heeds Tab, and clicks. `over`: the thing over the
  /// panels, which has the keys. True if Tab was pressed.
  bool begin(Over over);
  /// After the panels, within the same frame.
  void end();
  /// Space, Enter, arrows, Home, End and Esc are for the panels.
  [[nodiscard]] bool on() const { return on_; }
  /// Esc was for a control or list within the panels.
  [[nodiscard]] bool escape_is_theirs() const { return escape_is_theirs_; }
  /// Keys are for the picture again.
  void leave();

 private:
  void heed(Over over, bool clicked);
  void go(int direction);
  void ask(int direction);

  bool on_ = false;
  bool of_dialogue_ = false;  // begun in it, and ended with it
  bool by_itself_ = false;    // for a question or a list, and ended with it
  bool was_in_use_ = false;   // a control or a list, in the last frame
  bool escape_is_theirs_ = false;
  int asked_ = 0;         // for the next control or the one before, in this frame
  int asked_before_ = 0;  // the same in the last
  int goes_on_ = 0;       // in the next panel
};

}  // namespace curveskel::viewer
