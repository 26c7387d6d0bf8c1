#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "base/median.hpp"
#include "rig/plan/roles.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

class Arm {
 public:
  Arm(const CurveTree& tree, const LimbPair& arm)
      : tree_(tree), arm_(arm), course_(mean_course(tree, arm.ways.front())) {}

  ArmJoints joints() {
    begins_ = beginning();
    shoulder_ = course_.points[begins_];
    reach_ = (course_.points.back() - shoulder_).norm();
    for (const int v : arm_.vertices) {
      reach_ = std::max(reach_, (tree_.vertices[idx(v)] - shoulder_).norm());
    }
    const std::size_t wrist = wrist_of();
    const double half = 0.5 * from_shoulder(wrist);
    std::size_t elbow = begins_;
    while (elbow < wrist && from_shoulder(elbow) < half) ++elbow;
    return {shoulder_, course_.points[elbow], course_.points[wrist]};
  }

 private:
  [[nodiscard]] double from_shoulder(std::size_t k) const {
    return (course_.points[k] - shoulder_).norm();
  }

  /// An arm's radius beyond the ball of the trunk.
  [[nodiscard]] std::size_t beginning() const {
    const auto& points = course_.points;
    const std::size_t count = points.size();
    const Vector3d& root = tree_.nodes[idx(arm_.root)];
    const double radius = median_of({course_.radii.begin() + std::ptrdiff_t(0.35 * double(count)),
                                     course_.radii.begin() + std::ptrdiff_t(0.6 * double(count))});
    std::size_t leaves = 0;
    while (leaves + 1 < count && (points[leaves] - root).norm() <= tree_.radii[idx(arm_.root)]) {
      ++leaves;
    }
    if (leaves + 1 == count) leaves = 0;
    std::size_t begins = leaves;
    while (begins + 1 < count && (points[begins] - points[leaves]).norm() < radius) ++begins;
    return begins;
  }

  /// The first sample beyond which long fingers have left the arm's course; its end without any.
  [[nodiscard]] std::size_t hand() const {
    std::size_t hand = course_.points.size() - 1;
    for (std::size_t way = 1; way < arm_.ways.size(); ++way) {
      const Course other = mean_course(tree_, arm_.ways[way]);
      const double own = (other.points.back() - shoulder_).norm();
      const std::size_t k = last_shared(course_, other);
      const bool is_finger = k > begins_ && own > 0.6 * reach_ && from_shoulder(k) > 0.35 * reach_;
      if (is_finger) hand = std::min(hand, k);
    }
    return hand;
  }

  /// Narrow, and not far from where wrists are: before the fingers part.
  [[nodiscard]] std::size_t wrist_of() const {
    const std::size_t hand = this->hand();
    const double parts = from_shoulder(hand) / reach_;
    const double usual_share = std::min(0.68, 0.9 * parts);
    std::vector<std::size_t> candidates;
    std::vector<double> radii;
    for (std::size_t k = begins_; k < hand; ++k) {
      const double share = from_shoulder(k) / reach_;
      if (share <= std::min(0.55, 0.75 * parts) || share >= 0.8) continue;
      candidates.push_back(k);
      radii.push_back(course_.radii[k]);
    }
    if (candidates.empty()) return begins_ + (hand - begins_) * 68 / 100;
    const double usual = std::max(median_of(radii), 1e-9 * tree_.size);
    std::size_t best = candidates.front();
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t k : candidates) {
      const double off = std::abs(from_shoulder(k) / reach_ - usual_share);
      const double cost = course_.radii[k] / usual + 1.25 * off;
      if (cost >= least) continue;
      least = cost;
      best = k;
    }
    return best;
  }

  const CurveTree& tree_;
  const LimbPair& arm_;
  const Course course_;
  std::size_t begins_ = 0;
  Vector3d shoulder_ = Vector3d::Zero();
  double reach_ = 0;
};

}  // namespace

ArmJoints arm_joints(const CurveTree& tree, const LimbPair& arm) { return Arm(tree, arm).joints(); }

}  // namespace curveskel
