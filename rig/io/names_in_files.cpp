#include <set>
#include <string>
#include <vector>

#include "base/free_name.hpp"
#include "base/utf8.hpp"
#include "rig/io/rig_formats.hpp"
#include "rig/io/rig_writers.hpp"

namespace curveskel {
namespace {

std::string as_word(std::string name) {
  for (char& c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code <= ' ' || code == 127) c = '_';
  }
  return name;
}

}  // namespace

std::vector<std::string> names_as_words(const Rig& rig) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (Eigen::Index joint = 0; joint < rig.joints.rows(); ++joint) {
    std::string name = as_word(as_utf8(rig.names[static_cast<std::size_t>(joint)]));
    if (name.empty()) name = "joint_" + std::to_string(joint + 1);
    names.push_back(free_name(taken, name, "_"));
  }
  return names;
}

}  // namespace curveskel
