// Corrections by hand that can all be taken back.
#pragma once

#include <memory>
#include <vector>

#include <curveskel/curve_skeleton.hpp>

namespace curveskel::viewer {

/// One state of the skeleton and its companions.
struct Edited {
  std::shared_ptr<const CurveSkeleton> skeleton;
  int root = -1;  ///< node; -1 = none was chosen
};

/// States in order; the past is kept whole, the future until something else is done.
class History {
 public:
  /// Starts anew.
  void begin(Edited first);
  void add(Edited next);
  [[nodiscard]] bool can_undo() const { return at_ > 0; }
  [[nodiscard]] bool can_redo() const { return at_ + 1 < states_.size(); }
  void undo();
  void redo();
  [[nodiscard]] bool empty() const { return states_.empty(); }
  /// True if anything was changed since the history began.
  [[nodiscard]] bool changed() const { return at_ > 0; }
  [[nodiscard]] const Edited& now() const { return states_[at_]; }

 private:
  std::vector<Edited> states_;
  std::size_t at_ = 0;
};

}  // namespace curveskel::viewer
