#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/roles.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

struct Finger {
  std::size_t way = 0;
  Course course;
  std::size_t wrist = 0;  // sample next to it
  Vector3d tip = Vector3d::Zero();
  Vector3d direction = Vector3d::Zero();
  double reach = 0;  // of the tip from the wrist
};

/// Shares of the way from the wrist to the tip, in a straight line: means over artists' rigs.
struct FingerRule {
  std::array<const char*, 3> roles;
  std::array<double, 3> shares;
};
constexpr FingerRule thumb{{"ThumbMetacarpal", "ThumbProximal", "ThumbDistal"}, {0.40, 0.58, 0.81}};
constexpr std::array<double, 3> finger_shares{0.52, 0.70, 0.85};
constexpr std::array<FingerRule, 4> others{{
    {{"IndexProximal", "IndexIntermediate", "IndexDistal"}, finger_shares},
    {{"MiddleProximal", "MiddleIntermediate", "MiddleDistal"}, finger_shares},
    {{"RingProximal", "RingIntermediate", "RingDistal"}, finger_shares},
    {{"LittleProximal", "LittleIntermediate", "LittleDistal"}, finger_shares},
}};

class Hand {
 public:
  Hand(const CurveTree& tree, const LimbPair& arm, int pair, Vector3d wrist)
      : tree_(tree), pair_(pair), wrist_(std::move(wrist)) {
    for (std::size_t way = 0; way < arm.ways.size(); ++way) add(arm.ways[way], way);
    double farthest = 0;
    for (const Finger& finger : fingers_) farthest = std::max(farthest, finger.reach);
    std::erase_if(fingers_, [&](const Finger& finger) { return finger.reach < 0.35 * farthest; });
    leave_out_forks();
  }

  std::vector<Place> places() {
    if (fingers_.size() < 2) return {};
    bring_in_order();
    for (std::size_t k = 0; k < std::min<std::size_t>(fingers_.size(), 5); ++k) {
      place(k, k == 0 ? thumb : others[k - 1]);
    }
    return std::move(places_);
  }

 private:
  /// The way, if it passes the wrist.
  void add(const LimbWay& way, std::size_t number) {
    Finger finger;
    finger.way = number;
    finger.course = mean_course(tree_, way);
    const auto& points = finger.course.points;
    for (std::size_t k = 1; k < points.size(); ++k) {
      if ((points[k] - wrist_).norm() < (points[finger.wrist] - wrist_).norm()) finger.wrist = k;
    }
    const double off = (points[finger.wrist] - wrist_).norm();
    if (off > finger.course.radii[finger.wrist] || finger.wrist + 8 > points.size()) return;
    finger.tip = points.back();
    finger.reach = (finger.tip - wrist_).norm();
    finger.direction = (finger.tip - at_share(finger, 0.6)).normalized();
    fingers_.push_back(std::move(finger));
  }

  /// Two tips of one finger, such as that of its nail: what parts beyond the last joint is no
  /// finger of its own. The one that reaches farther stays.
  void leave_out_forks() {
    std::stable_sort(fingers_.begin(), fingers_.end(),
                     [](const Finger& a, const Finger& b) { return a.reach > b.reach; });
    std::vector<Finger> own;
    for (Finger& finger : fingers_) {
      const bool is_fork = std::any_of(own.begin(), own.end(), [&](const Finger& other) {
        const std::size_t parts = last_shared(finger.course, other.course);
        return (finger.course.points[parts] - wrist_).norm() > finger_shares.back() * finger.reach;
      });
      if (!is_fork) own.push_back(std::move(finger));
    }
    fingers_ = std::move(own);
  }

  /// The first sample beyond the wrist as far from it as this share of the reach.
  [[nodiscard]] std::size_t sample_at(const Finger& finger, double share) const {
    std::size_t k = finger.wrist;
    while (k + 1 < finger.course.points.size() &&
           (finger.course.points[k] - wrist_).norm() < share * finger.reach) {
      ++k;
    }
    return k;
  }
  [[nodiscard]] Vector3d at_share(const Finger& finger, double share) const {
    return finger.course.points[sample_at(finger, share)];
  }

  /// The thumb first: of two fingers the shorter, of more the one at an end of the row that is
  /// free nearer to the wrist. Then the one next to it and so on.
  void bring_in_order() {
    Vector3d mean = Vector3d::Zero();
    for (const Finger& finger : fingers_) mean += finger.direction;
    const std::size_t count = fingers_.size();
    std::size_t first = fingers_[0].reach < fingers_[count - 1].reach ? 0 : count - 1;
    const auto ends = ends_of_row(mean.normalized());
    if (count > 2) {
      const auto free = [&](std::size_t k) {
        return (fingers_[k].course.points[beginning(k)] - wrist_).norm();
      };
      first = free(ends.first) < free(ends.second) ? ends.first : ends.second;
    }
    const Vector3d forward = mean.normalized();
    const Vector3d tip = fingers_[first].tip;
    const Vector3d row =
        across(forward, fingers_[first == ends.first ? ends.second : ends.first].tip - tip);
    std::stable_sort(fingers_.begin(), fingers_.end(), [&](const Finger& a, const Finger& b) {
      return (a.tip - tip).dot(row) < (b.tip - tip).dot(row);
    });
  }

  static Vector3d across(const Vector3d& forward, const Vector3d& apart) {
    return apart - apart.dot(forward) * forward;
  }

  /// The two tips that lie farthest from each other sideways.
  [[nodiscard]] std::pair<std::size_t, std::size_t> ends_of_row(const Vector3d& forward) const {
    std::pair<std::size_t, std::size_t> ends{0, 1};
    double most = -1;
    for (std::size_t a = 0; a < fingers_.size(); ++a) {
      for (std::size_t b = a + 1; b < fingers_.size(); ++b) {
        const Vector3d apart = fingers_[b].tip - fingers_[a].tip;
        const double aside = across(forward, apart).norm();
        if (aside <= most) continue;
        most = aside;
        ends = {a, b};
      }
    }
    return ends;
  }

  /// The finger's own part begins where its curve is clear of the others'.
  [[nodiscard]] std::size_t beginning(std::size_t number) const {
    const Finger& finger = fingers_[number];
    std::size_t free = finger.wrist;
    for (std::size_t other = 0; other < fingers_.size(); ++other) {
      if (other == number) continue;
      free = std::max(free, last_shared(finger.course, fingers_[other].course));
    }
    return free;
  }

  void place(std::size_t number, const FingerRule& rule) {
    const Finger& finger = fingers_[number];
    const std::size_t free = beginning(number);
    const double free_share = (finger.course.points[free] - wrist_).norm() / finger.reach;
    std::string parent = "leftHand";
    for (std::size_t joint = 0; joint < 3; ++joint) {
      double share = rule.shares[joint];
      // Of a finger that is free late, the outer joints lie at the same shares of what is left.
      if (joint > 0 && free_share > rule.shares[1]) {
        share = free_share + (share - rule.shares[0]) / (1 - rule.shares[0]) * (1 - free_share);
      }
      const std::size_t k = std::max(free, sample_at(finger, share));
      Place place{std::string("left") + rule.roles[joint],
                  parent,
                  finger.course.points[k],
                  true,
                  pair_,
                  "at its share of the way from the wrist to the fingertip",
                  finger.way};
      // A knuckle within the palm lies on the way to the place where the finger is free.
      if (share < free_share) {
        place.beside = place.at;
        place.at = wrist_ + share / free_share * (place.at - wrist_);
      }
      place.is_last = joint == 2;
      parent = place.role;
      places_.push_back(std::move(place));
    }
  }

  const CurveTree& tree_;
  int pair_;
  Vector3d wrist_;
  std::vector<Finger> fingers_;
  std::vector<Place> places_;
};

}  // namespace

std::vector<Place> finger_places(const CurveTree& tree, const LimbPair& arm, int pair,
                                 const Eigen::Vector3d& wrist) {
  return Hand(tree, arm, pair, wrist).places();
}

}  // namespace curveskel
