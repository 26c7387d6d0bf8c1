#include "rig/joints/sides.hpp"

#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include "rig/joints/limb_name.hpp"
#include "rig/joints/mirror_images.hpp"

namespace curveskel {
namespace {

/// Both get the first one's names and a side each; joints of one alone, too.
void name_pair(Rig& rig, const Chain& first, const Chain& second, bool first_is_left) {
  const std::vector<std::string> names = [&] {
    std::vector<std::string> found;
    for (const int joint : first.joints) found.push_back(rig.names[idx(joint)]);
    return found;
  }();
  for (const int joint : first.joints) rig.names[idx(joint)] += first_is_left ? ".L" : ".R";
  for (std::size_t k = 0; k < second.joints.size(); ++k) {
    std::string& name = rig.names[idx(second.joints[k])];
    const bool both_last = k + 1 == second.joints.size();
    const bool has_partner = both_last || k + 1 < names.size();
    if (has_partner) name = both_last ? names.back() : names[k];
    name += first_is_left ? ".R" : ".L";
  }
}

}  // namespace

void name_sides(Rig& rig, const Eigen::Vector3d& to_left) {
  constexpr std::size_t most = 1000;  // chains
  constexpr double near = 0.06;       // of the diagonal
  constexpr double least = 0.125;     // of all length: by chance two fingers of a hand have 0.08
  const std::vector<Chain> chains = chains_of(rig);
  if (chains.size() > most) return;
  const double tolerance = near * bounding_box_diagonal(rig.joints);
  if (!(tolerance > 0)) return;
  const double all =
      std::accumulate(chains.begin(), chains.end(), 0.0,
                      [](double sum, const Chain& chain) { return sum + chain.length; });
  MirrorImages best;
  int axis = 0;
  for (int candidate = 0; candidate < 3; ++candidate) {
    MirrorImages images = mirror_images(chains, candidate, tolerance);
    if (images.paired < least * all || images.worth() <= best.worth() * (1 + 1e-6)) continue;
    best = std::move(images);
    axis = candidate;
  }
  const double left = to_left(axis) < -std::numbers::sqrt2 / 2 ? -1 : 1;
  for (std::size_t chain = 0; chain < best.of.size(); ++chain) {
    const int other = best.of[chain];
    if (other <= static_cast<int>(chain)) continue;
    const auto aside = [&](const Chain& of) { return left * of.path.col(axis).mean(); };
    name_pair(rig, chains[chain], chains[idx(other)],
              aside(chains[chain]) > aside(chains[idx(other)]));
  }
}

std::vector<int> twins_of(const Rig& rig) {
  std::map<std::string_view, int> number;
  const std::vector<std::string>& names = readable_names(rig);
  for (std::size_t joint = 0; joint < names.size(); ++joint) {
    number[names[joint]] = static_cast<int>(joint);
  }
  std::vector<int> twins(names.size(), -1);
  for (const auto& [name, joint] : number) {
    if (side_in(name) != 'L') continue;
    const auto found = number.find(std::string(without_side(name)) + ".R");
    if (found == number.end()) continue;
    twins[idx(joint)] = found->second;
    twins[idx(found->second)] = joint;
  }
  return twins;
}

}  // namespace curveskel
