#include "rig/sides.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "surface/element_index.hpp"
#include "surface/measures.hpp"

namespace curveskel {
namespace {

/// A chain of joints, each but the first the only child of the one before.
struct Chain {
  std::vector<int> joints;
  int above = -1;         ///< the chain whose last joint it hangs from; -1 = none
  Eigen::MatrixX3d path;  ///< places at even shares of its length
};

std::vector<Chain> chains_of(const Rig& rig) {
  constexpr int places = 5;
  std::vector<int> children(at(rig.parents.size()), 0);
  for (const int parent : rig.parents) {
    if (parent >= 0) ++children[at(parent)];
  }
  std::vector<int> chain_of(children.size());
  std::vector<Chain> chains;
  for (int joint = 0; joint < rig.parents.size(); ++joint) {
    const int parent = rig.parents[joint];
    const bool goes_on = parent >= 0 && children[at(parent)] == 1 && rig.parents[parent] >= 0;
    chain_of[at(joint)] = goes_on ? chain_of[at(parent)] : static_cast<int>(chains.size());
    if (!goes_on) chains.push_back({{}, parent < 0 ? -1 : chain_of[at(parent)], {}});
    chains[at(chain_of[at(joint)])].joints.push_back(joint);
  }
  for (Chain& chain : chains) {
    chain.path.resize(places, 3);
    const double last = static_cast<double>(chain.joints.size()) - 1;
    for (int place = 0; place < places; ++place) {
      const double at_joint = last * place / (places - 1);
      const auto before = static_cast<std::size_t>(at_joint);
      const std::size_t after = std::min(before + 1, chain.joints.size() - 1);
      const double share = at_joint - static_cast<double>(before);
      chain.path.row(place) = (1 - share) * rig.joints.row(chain.joints[before]) +
                              share * rig.joints.row(chain.joints[after]);
    }
  }
  return chains;
}

/// By chain: its mirror image, itself for one in the plane, -1 for neither.
struct MirrorImages {
  std::vector<int> of;
  int pairs = 0;
};

class Mirror {
 public:
  Mirror(const std::vector<Chain>& chains, int axis, double plane)
      : chains_(chains), axis_(axis), plane_(plane) {}

  [[nodiscard]] MirrorImages images(double tolerance) const {
    MirrorImages images;
    images.of.assign(chains_.size(), -1);
    for (int chain = 0; chain < static_cast<int>(chains_.size()); ++chain) {
      if (images.of[at(chain)] >= 0) continue;
      const int other = nearest(chain, images);
      if (other < 0 || distance(chain, other) > tolerance) continue;
      if (nearest(other, images) != chain) continue;
      images.of[at(chain)] = other;
      images.of[at(other)] = chain;
      if (other != chain) ++images.pairs;
    }
    return images;
  }

 private:
  /// Between one and the other's mirror image, the mean over their paths.
  [[nodiscard]] double distance(int chain, int other) const {
    Eigen::MatrixX3d mirrored = chains_[at(other)].path;
    mirrored.col(axis_) = 2 * plane_ - mirrored.col(axis_).array();
    return (mirrored - chains_[at(chain)].path).rowwise().norm().mean();
  }

  /// Of those that hang from the mirror image of what this hangs from, and are no one's yet.
  [[nodiscard]] int nearest(int chain, const MirrorImages& images) const {
    const int above = chains_[at(chain)].above;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int other = 0; other < static_cast<int>(chains_.size()); ++other) {
      const int above_other = chains_[at(other)].above;
      const bool fits =
          above < 0 ? above_other < 0 : above_other >= 0 && images.of[at(above)] == above_other;
      if (!fits || images.of[at(other)] >= 0) continue;
      const double away = distance(chain, other);
      if (away < least) {
        least = away;
        best = other;
      }
    }
    return best;
  }

  const std::vector<Chain>& chains_;
  int axis_;
  double plane_;
};

/// Both get the first one's names and a side each; what one has more than the other, too.
void name_pair(Rig& rig, const Chain& first, const Chain& second, bool first_is_left) {
  const std::vector<std::string> names = [&] {
    std::vector<std::string> found;
    for (const int joint : first.joints) found.push_back(rig.names[at(joint)]);
    return found;
  }();
  for (const int joint : first.joints) rig.names[at(joint)] += first_is_left ? ".L" : ".R";
  for (std::size_t k = 0; k < second.joints.size(); ++k) {
    std::string& name = rig.names[at(second.joints[k])];
    const bool both_last = k + 1 == second.joints.size();
    const bool has_partner = both_last || k + 1 < names.size();
    if (has_partner) name = both_last ? names.back() : names[k];
    name += first_is_left ? ".R" : ".L";
  }
}

}  // namespace

void name_sides(Rig& rig) {
  constexpr std::size_t most = 1000;  // chains
  constexpr double near = 0.06;       // of the diagonal
  const std::vector<Chain> chains = chains_of(rig);
  if (chains.size() > most) return;
  const double tolerance = near * bounding_box_diagonal(rig.joints);
  MirrorImages best;
  int axis = 0;
  for (int candidate = 0; candidate < 3; ++candidate) {
    MirrorImages images = Mirror(chains, candidate, rig.joints(0, candidate)).images(tolerance);
    if (images.pairs <= best.pairs) continue;
    best = std::move(images);
    axis = candidate;
  }
  for (std::size_t chain = 0; chain < best.of.size(); ++chain) {
    const int other = best.of[chain];
    if (other <= static_cast<int>(chain)) continue;
    const auto aside = [&](const Chain& of) { return of.path.col(axis).mean(); };
    name_pair(rig, chains[chain], chains[at(other)],
              aside(chains[chain]) > aside(chains[at(other)]));
  }
}

}  // namespace curveskel
