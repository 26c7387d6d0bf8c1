#include "rig/joints/idle_joints.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/joints/keep_joints.hpp"
#include "rig/joints/sides.hpp"

namespace curveskel {
namespace {

/// By joint: it moves some of the vertices, is a tip, or a root.
std::vector<char> needed_joints(const Rig& rig, const Eigen::VectorXi& vertices) {
  std::vector<char> needed(rig.names.size(), 1);
  for (const int parent : rig.parents) {
    if (parent >= 0) needed[idx(parent)] = rig.parents[parent] < 0 ? 1 : 0;
  }
  for (const int vertex : vertices) {
    if (vertex < 0) continue;
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      if (it.value() > 0) needed[idx(it.col())] = 1;
    }
  }
  return needed;
}

/// "limb2_4.L" becomes "limb2_3.L", if it is the third that is left.
void count_anew(std::vector<std::string>& names) {
  std::map<std::string, int> counts;  // by the name without its number
  for (std::string& name : names) {
    const bool has_side = name.ends_with(".L") || name.ends_with(".R");
    const std::size_t end = has_side ? name.size() - 2 : name.size();
    const std::size_t at = name.rfind('_', end);
    const std::size_t limb = name.find("limb");
    if (limb == std::string::npos || at == std::string::npos || at < limb || at + 1 == end)
      continue;
    const auto digits = std::string_view(name).substr(at + 1, end - at - 1);
    if (!std::all_of(digits.begin(), digits.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; })) {
      continue;
    }
    const std::string side = name.substr(end);
    name.resize(at + 1);
    std::string unnumbered = name;
    unnumbered += side;
    name += std::to_string(++counts[unnumbered]);
    name += side;
  }
}

}  // namespace

Rig without_idle_joints(const Rig& rig, std::size_t planned, const Eigen::VectorXi& vertices) {
  std::vector<char> stays = needed_joints(rig, vertices);
  std::fill_n(stays.begin(), std::min(planned, stays.size()), 1);
  const std::vector<int> twins = twins_of(rig);
  for (std::size_t joint = 0; joint < stays.size(); ++joint) {
    const int twin = twins[joint];
    if (twin >= 0 && stays[joint] != 0) stays[idx(twin)] = 1;
  }
  if (std::find(stays.begin(), stays.end(), 0) == stays.end()) return rig;
  std::vector<int> number(stays.size(), -1);
  int count = 0;
  for (std::size_t joint = 0; joint < stays.size(); ++joint) {
    if (stays[joint] != 0) number[joint] = count++;
  }
  Rig result = keep_joints(rig, number);
  count_anew(result.names);
  return result;
}

}  // namespace curveskel
