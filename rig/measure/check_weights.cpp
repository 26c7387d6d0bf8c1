#include <curveskel/check_weights.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include "rig/joints/sound_rig.hpp"
#include "rig/measure/turned_joints.hpp"
#include "rig/skin/weight_pieces.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

class WeightChecker {
 public:
  WeightChecker(const Surface& surface, const Rig& rig, const std::vector<bool>& follows)
      : surface_(surface), rig_(rig), follows_(follows), welded_(surface, welded_places(surface)) {
    triangles_at_.resize(welded_.place.size());
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
      for (const int v : surface.triangles.row(f)) triangles_at_[idx(v)].push_back(f);
    }
    volume_ = volume(surface);
  }

  WeightChecks check() {
    checks_.vertices = rig_.weights.rows();
    count_influences();
    find_islands();
    count_bleeding();
    pose_all();
    return std::move(checks_);
  }

 private:
  void count_influences() {
    std::vector<char> moves(idx(rig_.parents.size()), 0);
    for (Eigen::Index vertex = 0; vertex < rig_.weights.rows(); ++vertex) {
      std::size_t joints = 0;
      for (SkinWeights::InnerIterator it(rig_.weights, vertex); it; ++it) {
        if (!(it.value() > 0)) continue;
        ++joints;
        moves[idx(it.col())] = 1;
      }
      if (joints == 0) {
        ++checks_.unweighted;
      } else {
        ++checks_.with_influences[std::min<std::size_t>(joints, 4) - 1];
      }
    }
    for (std::size_t joint = 0; joint < moves.size(); ++joint) {
      if (moves[joint] == 0) checks_.idle.push_back(static_cast<int>(joint));
    }
  }

  void find_islands() {
    std::vector<std::vector<WeightPieces::Member>> members(idx(rig_.parents.size()));
    for (int vertex = 0; vertex < static_cast<int>(rig_.weights.rows()); ++vertex) {
      if (welded_.place[idx(vertex)] != vertex) continue;
      for (SkinWeights::InnerIterator it(rig_.weights, vertex); it; ++it) {
        if (it.value() > 0)
          members[idx(it.col())].push_back({vertex, static_cast<double>(it.value())});
      }
    }
    WeightPieces pieces(welded_);
    for (std::size_t joint = 0; joint < members.size(); ++joint) {
      for (const WeightPieces::Piece& piece : pieces.find(members[joint])) {
        if (!piece.is_island) continue;
        const auto size = static_cast<Eigen::Index>(piece.places.size());
        checks_.islands.push_back({static_cast<int>(joint), size, all_follow(piece.places)});
      }
    }
  }

  [[nodiscard]] bool all_follow(const std::vector<int>& vertices) const {
    return !follows_.empty() &&
           std::all_of(vertices.begin(), vertices.end(), [&](int v) { return follows_[idx(v)]; });
  }

  [[nodiscard]] int steps_between(int a, int b) const {
    std::map<int, int> up;
    for (int steps = 0; a >= 0; a = rig_.parents[a]) up[a] = steps++;
    for (int steps = 0; b >= 0; b = rig_.parents[b], ++steps) {
      const auto met = up.find(b);
      if (met != up.end()) return steps + met->second;
    }
    return static_cast<int>(rig_.parents.size());
  }

  void count_bleeding() {
    constexpr float least = 0.05F;
    constexpr int far = 3;
    for (Eigen::Index vertex = 0; vertex < rig_.weights.rows(); ++vertex) {
      int most = -1;
      float share = 0;
      for (SkinWeights::InnerIterator it(rig_.weights, vertex); it; ++it) {
        if (it.value() <= share) continue;
        share = it.value();
        most = static_cast<int>(it.col());
      }
      bool bleeds = false;
      for (SkinWeights::InnerIterator it(rig_.weights, vertex); it; ++it) {
        if (it.value() <= least || it.col() == most) continue;
        bleeds = bleeds || steps_between(most, static_cast<int>(it.col())) >= far;
      }
      checks_.bleeding += bleeds ? 1 : 0;
    }
  }

  void pose_all() {
    TurningShares shares(rig_);
    share_.assign(welded_.place.size(), 0);
    moved_ = surface_.positions;
    for (int joint = 0; joint < static_cast<int>(rig_.weights.cols()); ++joint) {
      if (rig_.parents[joint] < 0) continue;
      std::vector<int> turning;
      for (const auto& [vertex, share] : shares.of(joint)) {
        turning.push_back(vertex);
        share_[idx(vertex)] = share;
      }
      if (!turning.empty()) checks_.poses.push_back(pose(joint, turning));
      for (const int v : turning) {
        share_[idx(v)] = 0;
        moved_.row(v) = surface_.positions.row(v);
      }
    }
  }

  [[nodiscard]] WeightChecks::Pose pose(int joint, const std::vector<int>& turning) {
    WeightChecks::Pose worst{joint};
    const Vector3d place = rig_.joints.row(joint).transpose();
    const Vector3d bone = place - rig_.joints.row(rig_.parents[joint]).transpose();
    for (const Eigen::Matrix3d& turn : turns_across(bone)) {
      for (const int v : turning) {
        const Vector3d p = surface_.positions.row(v).transpose();
        moved_.row(v) = (p + share_[idx(v)] * (turn * (p - place) + place - p)).transpose();
      }
      worst.stretch = std::max(worst.stretch, stretch(turning));
      const double changed = volume_change(turning);
      if (std::abs(changed) > std::abs(worst.volume - 1)) worst.volume = 1 + changed;
    }
    return worst;
  }

  [[nodiscard]] double stretch(const std::vector<int>& turning) const {
    constexpr double bends = 0.01;  // by so much more on one end than on the other
    std::vector<double> ratios;
    for (const int v : turning) {
      for (const int other : welded_.neighbours(v)) {
        const bool is_first = v < other || share_[idx(other)] == 0;
        if (!is_first || std::abs(share_[idx(v)] - share_[idx(other)]) < bends) continue;
        const double before = (surface_.positions.row(v) - surface_.positions.row(other)).norm();
        const double after = (moved_.row(v) - moved_.row(other)).norm();
        if (before > 0 && after > 0) ratios.push_back(std::max(after / before, before / after));
      }
    }
    if (ratios.empty()) return 1;
    const auto high = ratios.begin() + std::ptrdiff_t(double(ratios.size() - 1) * 0.99);
    std::nth_element(ratios.begin(), high, ratios.end());
    return *high;
  }

  [[nodiscard]] double volume_change(const std::vector<int>& turning) const {
    if (!(volume_ > 0)) return 0;
    double sum = 0;
    for (const int v : turning) {
      for (const Eigen::Index f : triangles_at_[idx(v)]) {
        const auto t = surface_.triangles.row(f);
        // Of its turning corners the first counts the triangle.
        const int first = share_[idx(t(0))] > 0 ? t(0) : (share_[idx(t(1))] > 0 ? t(1) : t(2));
        if (v == first) sum += six_volumes(moved_, t) - six_volumes(surface_.positions, t);
      }
    }
    return sum / 6 / volume_;
  }

  template <typename Row>
  static double six_volumes(const Positions& positions, const Row& t) {
    const Vector3d a = positions.row(t(0));
    const Vector3d b = positions.row(t(1));
    const Vector3d c = positions.row(t(2));
    return a.dot(b.cross(c));
  }

  const Surface& surface_;
  const Rig& rig_;
  const std::vector<bool>& follows_;
  WeldedSurface welded_;
  std::vector<std::vector<Eigen::Index>> triangles_at_;
  double volume_ = 0;
  std::vector<double> share_;  // of each vertex that turns with the joint that is posed
  Positions moved_;
  WeightChecks checks_;
};

}  // namespace

WeightChecks check_weights(const Surface& surface, const Rig& rig,
                           const std::vector<bool>& follows) {
  require_sound(surface, "check_weights");
  require_sound(rig, "check_weights");
  require_weights_of(rig, surface.positions.rows(), "check_weights");
  if (!follows.empty() && follows.size() != idx(surface.positions.rows())) {
    throw Error(Fault::input, "check_weights: found " + std::to_string(follows.size()) +
                                  " vertices that follow or do not, needed all " +
                                  std::to_string(surface.positions.rows()) + ", or none");
  }
  return WeightChecker(surface, rig, follows).check();
}

}  // namespace curveskel
