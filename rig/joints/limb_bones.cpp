#include "rig/joints/limb_bones.hpp"

#include <algorithm>
#include <limits>

namespace curveskel {
namespace {

class LimbCutter {
 public:
  LimbCutter(const std::vector<LimbSample>& samples, const BoneCost& cost)
      : samples_(samples), cost_(cost), next_corner_(samples.size()) {
    std::size_t next = samples.size() - 1;
    for (std::size_t k = samples.size(); k-- > 0;) {
      if (is_corner(k)) next = k;
      next_corner_[k] = next;
    }
  }

  [[nodiscard]] std::vector<std::size_t> joints(std::size_t first, std::size_t last) const {
    constexpr double least_of_two = 2;  // each bone costs one at least
    if (first == last) return {last};
    if (cost(first, last, least_of_two) < least_of_two) return {first, last};
    const double longest = 3 * cost_.bone_length;  // longer ones never pay
    const std::size_t count = last + 1;
    std::vector<double> sum(count, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> before(count, first);
    sum[first] = 0;
    for (std::size_t j = first + 1; j < count; ++j) {
      for (std::size_t i = j; i-- > first;) {
        if (i + 1 < j && samples_[j].way - samples_[i].way > longest) break;
        const bool is_whole = i == first && j == last;
        const double chord = (samples_[j].point - samples_[i].point).norm();
        if (!is_whole && chord < cost_.least_length) continue;
        const double with = sum[i] + cost(i, j, sum[j] - sum[i]);
        if (with < sum[j]) {
          sum[j] = with;
          before[j] = i;
        }
      }
    }
    std::vector<std::size_t> places{last};
    while (places.back() > first) places.push_back(before[places.back()]);
    std::reverse(places.begin(), places.end());
    return places;
  }

 private:
  [[nodiscard]] double radius(std::size_t k) const {
    return std::max(samples_[k].radius, cost_.least_radius);
  }
  [[nodiscard]] bool is_thin(std::size_t k) const {
    return samples_[k].radius < cost_.least_radius;
  }

  /// False within a straight piece of linear radius, in which the distance from a bone over the
  /// radius is largest at an end: a convex function over a linear one.
  [[nodiscard]] bool is_corner(std::size_t k) const {
    if (k == 0 || k + 1 == samples_.size() || samples_[k].is_at_node) return true;
    const LimbSample& next = samples_[k + 1];
    const bool is_within = samples_[k - 1].at == samples_[k].at &&
                           next.at == samples_[k].at + (next.is_at_node ? 1 : 0);
    return !is_within || is_thin(k - 1) != is_thin(k) || is_thin(k) != is_thin(k + 1);
  }

  /// Of one bone from sample i to sample j, or any cost over `most` if it is more.
  [[nodiscard]] double cost(std::size_t i, std::size_t j, double most) const {
    const double length = (samples_[j].way - samples_[i].way) / cost_.bone_length;
    const double straight = 1 + length * length;
    const Eigen::Vector3d from = samples_[i].point;
    const Eigen::Vector3d bone = samples_[j].point - from;
    const double squared = std::max(bone.squaredNorm(), std::numeric_limits<double>::min());
    const auto with_bend_at = [&](std::size_t k) {
      const Eigen::Vector3d arm = samples_[k].point - from;
      const double share = std::clamp(arm.dot(bone) / squared, 0.0, 1.0);
      const double off = (arm - share * bone).squaredNorm();
      const double deviation = off / (radius(k) * radius(k));
      return straight + deviation / (cost_.bend * cost_.bend);
    };
    double bent = straight;
    if (j - i < 2 || bent > most) return bent;
    bent = std::max({bent, with_bend_at(i + 1), with_bend_at(j - 1)});
    for (std::size_t k = next_corner_[i + 1]; k + 1 < j && bent <= most; k = next_corner_[k + 1]) {
      bent = std::max(bent, with_bend_at(k));
    }
    return bent;
  }

  const std::vector<LimbSample>& samples_;
  const BoneCost& cost_;
  std::vector<std::size_t> next_corner_;  // by sample, itself among them
};

}  // namespace

std::vector<std::size_t> best_joints(const std::vector<LimbSample>& samples, std::size_t first,
                                     std::size_t last, const BoneCost& cost) {
  return LimbCutter(samples, cost).joints(first, last);
}

}  // namespace curveskel
