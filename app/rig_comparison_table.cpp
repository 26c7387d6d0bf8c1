#include "app/rig_comparison_table.hpp"

#include <fmt/core.h>

#include "app/counted.hpp"

namespace curveskel {
namespace {

std::string hits_line(const char* name, const JointHits& hits) {
  return fmt::format("  {:<17}{:>7.3f} precision, {:.3f} recall, {:.3f} overlap ({})\n", name,
                     hits.precision, hits.recall, hits.overlap, count_of(hits.hits, "pair"));
}

}  // namespace

std::string rig_comparison_table(const RigComparison& c) {
  // L is the longest side of the truth's bounding box.
  std::string text = "rig                     rig     truth\n";
  text += fmt::format("  joints           {:>10} {:>9}\n", c.joints, c.truth_joints);
  text += fmt::format("  joints to joints {:>8.2f} %  of L, the mean of both ways\n",
                      100 * c.joints_to_joints);
  text += fmt::format("  joints to bones  {:>8.2f} %\n", 100 * c.joints_to_bones);
  text += fmt::format("  bones to bones   {:>8.2f} %\n", 100 * c.bones_to_bones);
  text += fmt::format("  root to root     {:>8.2f} %\n", 100 * c.root_distance);
  text += hits_line("within thickness", c.by_thickness);
  text += hits_line("within 5 %", c.by_size);
  if (c.poses) {
    text += fmt::format("  poses            {:>8.2f} %  of L from the truth's, {:.2f} shared; {}\n",
                        100 * c.poses->mean_distance, c.poses->shared,
                        count_of(c.poses->poses, "pose"));
  } else {
    text += fmt::format("  poses            not compared: {}\n", c.not_posed);
  }
  if (c.weights) {
    text += fmt::format("  weights          {:>7.3f} precision, {:.3f} recall, {:.3f} L1\n",
                        c.weights->precision, c.weights->recall, c.weights->l1);
  } else {
    text += fmt::format("  weights          not compared: {}\n", c.not_weighed);
  }
  return text;
}

}  // namespace curveskel
