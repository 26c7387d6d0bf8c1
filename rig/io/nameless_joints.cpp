#include <set>
#include <string>
#include <vector>

#include "base/free_name.hpp"
#include "rig/io/rig_formats.hpp"

namespace curveskel {

void name_nameless(std::vector<std::string>& names) {
  std::set<std::string> taken(names.begin(), names.end());
  for (std::size_t joint = 0; joint < names.size(); ++joint) {
    if (!names[joint].empty()) continue;
    names[joint] = free_name(taken, "joint_" + std::to_string(joint + 1), "_");
  }
}

}  // namespace curveskel
