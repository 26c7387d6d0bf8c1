#include "rig/joints/sound_rig.hpp"

#include <cmath>
#include <string>

#include <curveskel/error.hpp>

namespace curveskel {
namespace {

[[noreturn]] void refuse_rig(std::string_view purpose, const std::string& found,
                             const std::string& needed) {
  throw Error(Fault::input, std::string(purpose) + ": the rig has " + found + ", needed " + needed);
}

}  // namespace

void require_hierarchy(const Rig& rig, std::string_view purpose) {
  const Eigen::Index joints = rig.joints.rows();
  if (rig.parents.size() != joints) {
    refuse_rig(purpose, std::to_string(rig.parents.size()) + " parents",
               "one for each of its " + std::to_string(joints) + " joints");
  }
  for (Eigen::Index joint = 0; joint < joints; ++joint) {
    const int parent = rig.parents[joint];
    if (parent >= -1 && parent < joint) continue;
    refuse_rig(purpose,
               "the parent " + std::to_string(parent) + " for joint " + std::to_string(joint),
               "a joint before it, or -1 for a root");
  }
}

void require_sound(const Rig& rig, std::string_view purpose) {
  require_hierarchy(rig, purpose);
  const auto joints = static_cast<std::size_t>(rig.joints.rows());
  const auto of_its_joints = "its " + std::to_string(joints) + " joints";
  if (rig.names.size() != joints) {
    refuse_rig(purpose, std::to_string(rig.names.size()) + " names",
               "one for each of " + of_its_joints);
  }
  const auto require_all_or_none = [&](std::size_t found, const char* things) {
    if (found == 0 || found == joints) return;
    refuse_rig(purpose, std::to_string(found) + " " + things,
               "one for each of " + of_its_joints + ", or none");
  };
  require_all_or_none(rig.roles.size(), "roles");
  require_all_or_none(rig.turns.size(), "turns");
  require_all_or_none(rig.readable.size(), "readable names");
  if (rig.weights.rows() == 0 || rig.weights.cols() == rig.joints.rows()) return;
  refuse_rig(purpose, "weights of " + std::to_string(rig.weights.cols()) + " joints",
             "weights of " + of_its_joints);
}

void require_writable(const Rig& rig, std::string_view purpose) {
  require_sound(rig, purpose);
  if (rig.joints.rows() == 0) refuse_rig(purpose, "no joint", "one at least");
  bool is_finite = rig.joints.allFinite();
  bool is_negative = false;
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      is_finite = is_finite && std::isfinite(it.value());
      is_negative = is_negative || it.value() < 0;
    }
  }
  if (!is_finite) {
    refuse_rig(purpose, "a place or a weight that is no finite number", "finite ones");
  }
  if (is_negative) refuse_rig(purpose, "a weight below 0", "weights of 0 or more");
}

void require_weights_of(const Rig& rig, Eigen::Index vertices, std::string_view purpose) {
  if (rig.weights.rows() == vertices) return;
  refuse_rig(purpose, "weights of " + std::to_string(rig.weights.rows()) + " vertices",
             "a row for each of the surface's " + std::to_string(vertices));
}

}  // namespace curveskel
