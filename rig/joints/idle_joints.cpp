#include "rig/joints/idle_joints.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/joints/keep_joints.hpp"
#include "rig/joints/limb_name.hpp"
#include "rig/joints/sides.hpp"

namespace curveskel {
namespace {

/// By joint: it moves some of the vertices.
std::vector<char> moving_joints(const Rig& rig, const Eigen::VectorXi& vertices) {
  std::vector<char> moves(rig.names.size(), 0);
  for (const int vertex : vertices) {
    if (vertex < 0) continue;
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      if (it.value() > 0) moves[idx(it.col())] = 1;
    }
  }
  return moves;
}

/// By joint: it moves some of the vertices, is a tip, or a root.
std::vector<char> needed_joints(const Rig& rig, const std::vector<char>& moves) {
  std::vector<char> needed(rig.names.size(), 1);
  for (const int parent : rig.parents) {
    if (parent >= 0) needed[idx(parent)] = rig.parents[parent] < 0 ? 1 : 0;
  }
  for (std::size_t joint = 0; joint < needed.size(); ++joint) needed[joint] |= moves[joint];
  return needed;
}

/// A tip that moves nothing shows how long the bone above it is, and where it leads; a planned
/// joint from which another one goes on as far shows that without.
void drop_ends_beside_planned(const Rig& rig, std::size_t planned, const std::vector<char>& moves,
                              std::vector<char>& stays) {
  const auto length = [&](std::size_t joint) {
    const auto row = static_cast<Eigen::Index>(joint);
    const int parent = rig.parents[row];
    return parent < 0 ? 0.0 : (rig.joints.row(row) - rig.joints.row(parent)).norm();
  };
  std::vector<double> longest(planned, 0);  // of the planned bones below
  std::vector<char> is_above(stays.size(), 0);
  for (std::size_t joint = 0; joint < stays.size(); ++joint) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    if (parent < 0) continue;
    is_above[idx(parent)] = 1;
    if (joint < planned) longest[idx(parent)] = std::max(longest[idx(parent)], length(joint));
  }
  for (std::size_t joint = planned; joint < stays.size(); ++joint) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    const bool hangs_from_planned = parent >= 0 && idx(parent) < planned;
    if (!hangs_from_planned || moves[joint] != 0 || is_above[joint] != 0) continue;
    if (length(joint) <= longest[idx(parent)]) stays[joint] = 0;
  }
}

/// "limb2_4.L" becomes "limb2_3.L", if it is the third that is left.
void count_anew(std::vector<std::string>& names) {
  std::map<std::pair<std::string, std::string>, int> counts;  // by limb and side
  for (std::string& name : names) {
    const LimbName parts = taken_apart(name);
    const bool is_counted = parts.rest.size() > 1 && parts.rest != "_end";
    if (!is_counted) continue;
    const int number = ++counts[{parts.limb, parts.side}];
    name = parts.limb + "_" + std::to_string(number) + parts.side;
  }
}

}  // namespace

Rig without_idle_joints(const Rig& rig, std::size_t planned, const Eigen::VectorXi& vertices) {
  const std::vector<char> moves = moving_joints(rig, vertices);
  std::vector<char> stays = needed_joints(rig, moves);
  drop_ends_beside_planned(rig, planned, moves, stays);
  std::fill_n(stays.begin(), std::min(planned, stays.size()), 1);
  const std::vector<int> twins = twins_of(rig);
  for (std::size_t joint = 0; joint < stays.size(); ++joint) {
    const int twin = twins[joint];
    if (twin >= 0 && stays[joint] != 0) stays[idx(twin)] = 1;
  }
  if (std::find(stays.begin(), stays.end(), 0) == stays.end()) return rig;
  Rig result = keep_joints(rig, numbers_of(stays));
  count_anew(result.names);
  return result;
}

}  // namespace curveskel
