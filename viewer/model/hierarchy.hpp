// The joints of a rig as the lines of an outline, however many stand below each other.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel::viewer {

struct HierarchyLine {
  int joint = 0;
  int depth = 0;          ///< 0 = a root
  std::size_t below = 0;  ///< how many of the next lines are below it
};

/// Each joint before those below it, siblings by number. O(joints), without recursion.
[[nodiscard]] std::vector<HierarchyLine> hierarchy_of(const Rig& rig);

/// The lines that are seen.
class Outline {
 public:
  /// Begins anew, all unfolded, where the rig is another one; null for none. True if it is.
  bool show(const std::shared_ptr<const Rig>& rig);
  /// Hides the joints below this one, or shows them again. O(joints).
  void fold(int joint);
  [[nodiscard]] bool folded(int joint) const { return folded_[static_cast<std::size_t>(joint)]; }
  [[nodiscard]] const std::vector<HierarchyLine>& seen() const { return seen_; }

 private:
  void list();

  std::shared_ptr<const Rig> rig_;
  std::vector<HierarchyLine> lines_;
  std::vector<HierarchyLine> seen_;
  std::vector<bool> folded_;  // by joint
};

}  // namespace curveskel::viewer
