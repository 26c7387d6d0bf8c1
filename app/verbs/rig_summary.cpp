#include "app/verbs/rig_summary.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace curveskel {

std::string joints_in_words(const Rig& rig) {
  std::vector<bool> moves(rig.names.size(), false);
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      if (it.value() > 0) moves[static_cast<std::size_t>(it.col())] = true;
    }
  }
  int tips = 0;
  int others = 0;
  for (std::size_t joint = 0; joint < moves.size(); ++joint) {
    if (moves[joint]) continue;
    const bool is_tip = std::find(rig.parents.begin(), rig.parents.end(),
                                  static_cast<int>(joint)) == rig.parents.end();
    ++(is_tip ? tips : others);
  }
  if (others == 0) {
    return fmt::format("{} joints, {} of them {} nothing", moves.size(), tips,
                       tips == 1 ? "a tip that moves" : "tips that move");
  }
  return fmt::format("{} joints; {} tip{} and {} other{} move nothing", moves.size(), tips,
                     tips == 1 ? "" : "s", others, others == 1 ? "" : "s");
}

std::string parts_in_words(const RigParts& parts) {
  const auto followers = std::count_if(parts.parts.begin(), parts.parts.end(),
                                       [](const RigPart& part) { return part.follows; });
  if (followers == 0) return "";
  return fmt::format("parts: {} of the body, {} that follow it (--follow 0: joints for all)\n",
                     parts.parts.size() - static_cast<std::size_t>(followers), followers);
}

std::string plan_in_words(const BodyPlan& plan) {
  if (plan.plan == BodyKind::none) return "";
  std::string text = fmt::format("plan: {} ({})\n", name_of(body_kinds, plan.plan), plan.reason);
  if (!plan.missing.empty()) text += fmt::format("missing: {}\n", fmt::join(plan.missing, ", "));
  return text;
}

}  // namespace curveskel
