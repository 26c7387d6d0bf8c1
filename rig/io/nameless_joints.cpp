#include <set>
#include <string>
#include <vector>

#include "rig/io/rig_formats.hpp"

namespace curveskel {

void name_nameless(std::vector<std::string>& names) {
  std::set<std::string> taken(names.begin(), names.end());
  for (std::size_t joint = 0; joint < names.size(); ++joint) {
    if (!names[joint].empty()) continue;
    const std::string name = "joint_" + std::to_string(joint + 1);
    names[joint] = name;
    for (int copy = 2; !taken.insert(names[joint]).second; ++copy) {
      names[joint] = name + "_" + std::to_string(copy);
    }
  }
}

}  // namespace curveskel
