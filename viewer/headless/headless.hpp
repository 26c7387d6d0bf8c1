// An OpenGL context without a window or a display.
#pragma once

#include <memory>

namespace curveskel::viewer {

/// Current on this thread until destroyed, by EGL on any device: a graphics card, or Mesa's
/// software renderer. Throws Error(Fault::device) where there is neither.
class HeadlessContext {
 public:
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(HeadlessContext&&) noexcept;
  HeadlessContext& operator=(HeadlessContext&&) noexcept;
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace curveskel::viewer
