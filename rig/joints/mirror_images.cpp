#include "rig/joints/mirror_images.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// `places` of them, at even shares of the length along the chain's joints.
Eigen::MatrixX3d path_of(const Rig& rig, const std::vector<int>& joints, double length) {
  constexpr int places = 5;
  Eigen::MatrixX3d path(places, 3);
  std::size_t before = 0;
  double passed = 0;  // up to `before`
  for (int place = 0; place < places; ++place) {
    const double wanted = length * place / (places - 1);
    const auto bone = [&] {
      return (rig.joints.row(joints[before + 1]) - rig.joints.row(joints[before])).eval();
    };
    while (before + 2 < joints.size() && passed + bone().norm() < wanted) {
      passed += bone().norm();
      ++before;
    }
    path.row(place) = rig.joints.row(joints[before]);
    if (before + 1 == joints.size() || !(bone().norm() > 0)) continue;
    path.row(place) += std::min(1.0, (wanted - passed) / bone().norm()) * bone();
  }
  return path;
}

struct MirrorPlane {
  int axis = 0;  ///< that it is normal to
  double place = 0;

  /// Between one and the other's mirror image, the mean over their paths.
  [[nodiscard]] double distance(const Chain& chain, const Chain& other) const {
    Eigen::MatrixX3d mirrored = other.path;
    mirrored.col(axis) = 2 * place - mirrored.col(axis).array();
    return (mirrored - chain.path).rowwise().norm().mean();
  }
};

class Mirror {
  static constexpr int none = -1;
  static constexpr int unknown = -2;

 public:
  Mirror(const std::vector<Chain>& chains, const MirrorPlane& plane, double tolerance)
      : chains_(chains), tolerance_(tolerance) {
    const auto count = static_cast<int>(chains.size());
    images_.of.assign(chains.size(), none);
    passed_over_.assign(chains.size(), false);
    holders_.assign(chains.size(), 0);
    find_holders();
    distances_.resize(count, count);
    for (int chain = 0; chain < count; ++chain) {
      for (int other = 0; other <= chain; ++other) {
        const bool is_above = other < chain && this->is_above(other, chain);
        distances_(chain, other) = distances_(other, chain) =
            is_above ? std::numeric_limits<double>::infinity()
                     : plane.distance(chains[idx(chain)], chains[idx(other)]);
      }
    }
  }

  /// A limb on a chain without an image counts as hanging from that chain's parent, but only
  /// once nothing else is left to match, so that few are passed over; and in the end exact images
  /// may hang from whatever they do (the one leg from the hip, the other from a washer there).
  MirrorImages images() {
    while (match() || pass_over() || match_exact()) {
    }
    return std::move(images_);
  }

 private:
  /// True if any was found.
  bool match() { return match(tolerance_); }

  bool match_exact() {
    constexpr double much_less = 0.25;
    anywhere_ = true;
    const bool found = match(much_less * tolerance_);
    anywhere_ = false;
    return found;
  }

  bool match(double tolerance) {
    bool found = false;
    for (int chain = 0; chain < static_cast<int>(chains_.size()); ++chain) {
      if (images_.of[idx(chain)] >= 0) continue;
      const int other = nearest(chain);
      if (other < 0 || nearest(other) != chain) continue;
      if (distances_(chain, other) > tolerance) continue;
      const double exact = 1 - distances_(chain, other) / tolerance_;
      images_.of[idx(chain)] = other;
      images_.of[idx(other)] = chain;
      find_holders();
      found = true;
      const double length = chains_[idx(chain)].length;
      if (other == chain) images_.in_plane += exact * length;
      if (other != chain) images_.paired += exact * (length + chains_[idx(other)].length);
    }
    return found;
  }

  /// Those without an image that hang from one with an image; whether there was any.
  bool pass_over() {
    std::vector<int> found;
    for (int chain = 0; chain < static_cast<int>(chains_.size()); ++chain) {
      if (images_.of[idx(chain)] >= 0 || passed_over_[idx(chain)]) continue;
      if (image_of_holder(chain) != unknown) found.push_back(chain);
    }
    for (const int chain : found) passed_over_[idx(chain)] = true;
    find_holders();
    return !found.empty();
  }

  void find_holders() {  // chains come after their parents
    for (std::size_t chain = 0; chain < chains_.size(); ++chain) {
      const int above = chains_[chain].above;
      const bool passed = above >= 0 && images_.of[idx(above)] < 0 && passed_over_[idx(above)];
      holders_[chain] = passed ? holders_[idx(above)] : above;
    }
  }

  [[nodiscard]] int image_of_holder(int chain) const {
    const int holder = holders_[idx(chain)];
    if (holder < 0) return none;
    return images_.of[idx(holder)] < 0 ? unknown : images_.of[idx(holder)];
  }

  [[nodiscard]] bool is_above(int other, int chain) const {
    while (chain > other) chain = chains_[idx(chain)].above;
    return chain == other;
  }

  /// Of those that hang from the mirror image of what this hangs from, and are no one's yet.
  [[nodiscard]] int nearest(int chain) const {
    const int wanted = image_of_holder(chain);
    if (wanted == unknown && !anywhere_) return none;
    int best = none;
    double least = std::numeric_limits<double>::infinity();
    for (int other = 0; other < static_cast<int>(chains_.size()); ++other) {
      if (images_.of[idx(other)] >= 0) continue;
      if (holders_[idx(other)] != wanted && !anywhere_) continue;
      if (distances_(chain, other) < least) {
        least = distances_(chain, other);
        best = other;
      }
    }
    return best;
  }

  const std::vector<Chain>& chains_;
  double tolerance_;
  MirrorImages images_;
  Eigen::MatrixXd distances_;  // by two chains; endless where one hangs from the other
  std::vector<bool> passed_over_;
  std::vector<int> holders_;  // by chain, its parent
  bool anywhere_ = false;     // images may hang from whatever they do
};

struct Vote {
  double place, weight;
};

/// The middle one of those that weigh most within `width`. Precondition: there is one.
double place_of_most(std::vector<Vote> votes, double width) {
  std::sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) {
    return a.place != b.place ? a.place < b.place : a.weight < b.weight;
  });
  std::size_t best = 0;
  double most = -1;
  double weight = 0;
  std::size_t first = 0;
  for (const Vote& last : votes) {
    weight += last.weight;
    while (last.place - votes[first].place > width) weight -= votes[first++].weight;
    if (weight > most) {
      most = weight;
      best = first;
    }
  }
  double passed = votes[best].weight;
  while (passed < 0.5 * most && best + 1 < votes.size()) passed += votes[++best].weight;
  return votes[best].place;
}

/// Each two chains that a plane makes images of each other vote for it, whatever they hang from:
/// no single joint has to lie in it.
MirrorPlane fitted_plane(const std::vector<Chain>& chains, int axis, double tolerance) {
  std::vector<Vote> votes;
  for (std::size_t chain = 0; chain < chains.size(); ++chain) {
    for (std::size_t other = chain + 1; other < chains.size(); ++other) {
      const Chain& a = chains[chain];
      const Chain& b = chains[other];
      const MirrorPlane plane{axis, 0.5 * (a.path.col(axis).mean() + b.path.col(axis).mean())};
      if (plane.distance(a, b) > tolerance) continue;
      votes.push_back({plane.place, std::min(a.length, b.length)});
    }
  }
  if (votes.empty()) return {axis, chains.front().path(0, axis)};
  return {axis, place_of_most(std::move(votes), 0.5 * tolerance)};
}

}  // namespace

std::vector<Chain> chains_of(const Rig& rig) {
  std::vector<int> children(idx(rig.parents.size()), 0);
  for (const int parent : rig.parents) {
    if (parent >= 0) ++children[idx(parent)];
  }
  std::vector<int> chain_of(children.size());
  std::vector<Chain> chains;
  for (int joint = 0; joint < rig.parents.size(); ++joint) {
    const int parent = rig.parents[joint];
    const bool goes_on = parent >= 0 && children[idx(parent)] == 1 && rig.parents[parent] >= 0;
    chain_of[idx(joint)] = goes_on ? chain_of[idx(parent)] : static_cast<int>(chains.size());
    if (!goes_on) chains.push_back({{}, parent < 0 ? -1 : chain_of[idx(parent)], {}, 0});
    Chain& chain = chains[idx(chain_of[idx(joint)])];
    if (goes_on) chain.length += (rig.joints.row(joint) - rig.joints.row(parent)).norm();
    chain.joints.push_back(joint);
  }
  for (Chain& chain : chains) {
    chain.path = path_of(rig, chain.joints, chain.length);
    const int parent = rig.parents[chain.joints.front()];
    if (parent < 0) continue;
    chain.length += (rig.joints.row(chain.joints.front()) - rig.joints.row(parent)).norm();
  }
  return chains;
}

MirrorImages mirror_images(const std::vector<Chain>& chains, int axis, double tolerance) {
  return Mirror(chains, fitted_plane(chains, axis, tolerance), tolerance).images();
}

}  // namespace curveskel
