#include "viewer/model/hierarchy.hpp"

#include <algorithm>

namespace curveskel::viewer {

std::vector<HierarchyLine> hierarchy_of(const Rig& rig) {
  const auto count = static_cast<std::size_t>(rig.parents.size());
  const auto parent_of = [&](std::size_t joint) {
    return rig.parents[static_cast<Eigen::Index>(joint)];
  };
  std::vector<std::size_t> size(count, 1);  // lines of a joint and of all below it
  for (std::size_t joint = count; joint-- > 0;) {
    if (parent_of(joint) >= 0) size[static_cast<std::size_t>(parent_of(joint))] += size[joint];
  }
  std::vector<HierarchyLine> lines(count);
  std::vector<int> depth(count, 0);
  std::vector<std::size_t> next(count);  // line for the next child of each joint
  std::size_t next_root = 0;
  for (std::size_t joint = 0; joint < count; ++joint) {
    const auto parent = static_cast<std::size_t>(std::max(parent_of(joint), 0));
    const bool root = parent_of(joint) < 0;
    if (!root) depth[joint] = depth[parent] + 1;
    std::size_t& place = root ? next_root : next[parent];
    lines[place] = {static_cast<int>(joint), depth[joint], size[joint] - 1};
    next[joint] = place + 1;
    place += size[joint];
  }
  return lines;
}

bool Outline::show(const std::shared_ptr<const Rig>& rig) {
  if (rig == rig_) return false;
  rig_ = rig;
  lines_ = rig ? hierarchy_of(*rig) : std::vector<HierarchyLine>();
  folded_.assign(lines_.size(), false);
  list();
  return true;
}

void Outline::fold(int joint) {
  folded_[static_cast<std::size_t>(joint)].flip();
  list();
}

void Outline::list() {
  seen_.clear();
  for (std::size_t line = 0; line < lines_.size();) {
    seen_.push_back(lines_[line]);
    line += folded(lines_[line].joint) ? lines_[line].below + 1 : 1;
  }
}

}  // namespace curveskel::viewer
