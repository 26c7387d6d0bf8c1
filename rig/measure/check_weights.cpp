#include <curveskel/check_weights.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/union_find.hpp>
#include "surface/repair/weld.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;
using Edge = std::pair<int, int>;

/// Each once, between vertices as they are welded.
std::vector<Edge> edges_of(const Surface& surface, const std::vector<int>& place) {
  std::vector<Edge> edges;
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const int a = place[idx(t(k))];
      const int b = place[idx(t((k + 1) % 3))];
      if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// n x j, by columns: the share of each vertex that turns when the joint does.
Eigen::SparseMatrix<double> turning_shares(const Rig& rig) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      if (!(it.value() > 0)) continue;
      for (auto joint = static_cast<int>(it.col()); joint >= 0; joint = rig.parents[joint]) {
        entries.emplace_back(static_cast<int>(vertex), joint, it.value());
      }
    }
  }
  Eigen::SparseMatrix<double> shares(rig.weights.rows(), rig.weights.cols());
  shares.setFromTriplets(entries.begin(), entries.end());  // adds up
  return shares;
}

class WeightChecker {
 public:
  WeightChecker(const Surface& surface, const Rig& rig) : surface_(surface), rig_(rig) {
    constexpr double one_place = 1e-6;  // of D
    place_ = nearby_vertices(surface.positions, std::vector<bool>(idx(rig.weights.rows()), true),
                             one_place * bounding_box_diagonal(surface.positions));
    edges_ = edges_of(surface, place_);
    triangles_at_.resize(place_.size());
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
      for (const int v : surface.triangles.row(f)) triangles_at_[idx(v)].push_back(f);
    }
    edges_at_.resize(place_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      edges_at_[idx(edges_[e].first)].push_back(e);
      edges_at_[idx(edges_[e].second)].push_back(e);
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
    constexpr float least = 0.1F;
    UnionFind whole(static_cast<std::int64_t>(place_.size()));
    for (const auto& [a, b] : edges_) whole.unite(a, b);
    std::vector<std::vector<int>> members(idx(rig_.parents.size()));
    for (Eigen::Index vertex = 0; vertex < rig_.weights.rows(); ++vertex) {
      if (place_[idx(vertex)] != vertex) continue;
      for (SkinWeights::InnerIterator it(rig_.weights, vertex); it; ++it) {
        if (it.value() > least) members[idx(it.col())].push_back(static_cast<int>(vertex));
      }
    }
    std::vector<char> is_member(place_.size(), 0);
    for (std::size_t joint = 0; joint < members.size(); ++joint) {
      for (const int v : members[joint]) is_member[idx(v)] = 1;
      add_islands(static_cast<int>(joint), members[joint], is_member, whole);
      for (const int v : members[joint]) is_member[idx(v)] = 0;
    }
  }

  void add_islands(int joint, const std::vector<int>& members, const std::vector<char>& is_member,
                   UnionFind& whole) {
    std::map<int, int> number;
    for (const int v : members) number.emplace(v, static_cast<int>(number.size()));
    UnionFind joined(static_cast<std::int64_t>(number.size()));
    for (const int v : members) {
      for (const std::size_t e : edges_at_[idx(v)]) {
        const auto& [a, b] = edges_[e];
        if (is_member[idx(a)] != 0 && is_member[idx(b)] != 0) joined.unite(number[a], number[b]);
      }
    }
    std::map<int, std::pair<Eigen::Index, int>> pieces;  // vertices, and one of them
    for (const auto& [v, k] : number) {
      auto& [count, one] = pieces[joined.root(k)];
      ++count;
      one = v;
    }
    std::map<int, std::vector<Eigen::Index>> sizes;  // by component
    for (const auto& [root, piece] : pieces) {
      sizes[whole.root(piece.second)].push_back(piece.first);
    }
    for (auto& [component, found] : sizes) {
      std::sort(found.begin(), found.end(), std::greater<>());
      for (std::size_t k = 1; k < found.size(); ++k) checks_.islands.push_back({joint, found[k]});
    }
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
    const Eigen::SparseMatrix<double> shares = turning_shares(rig_);
    share_.assign(place_.size(), 0);
    moved_ = surface_.positions;
    for (int joint = 0; joint < static_cast<int>(shares.cols()); ++joint) {
      std::vector<int> turning;
      for (Eigen::SparseMatrix<double>::InnerIterator it(shares, joint); it; ++it) {
        turning.push_back(static_cast<int>(it.row()));
        share_[idx(it.row())] = it.value();
      }
      if (rig_.parents[joint] >= 0 && !turning.empty())
        checks_.poses.push_back(pose(joint, turning));
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
    const Vector3d along = bone.norm() > 0 ? Vector3d(bone.normalized()) : Vector3d::UnitY();
    const Vector3d across = along.unitOrthogonal();
    for (const Vector3d& axis : {across, Vector3d(along.cross(across))}) {
      for (const double sign : {1.0, -1.0}) {
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(sign * std::numbers::pi / 4, axis).toRotationMatrix();
        for (const int v : turning) {
          const Vector3d p = surface_.positions.row(v).transpose();
          moved_.row(v) = (p + share_[idx(v)] * (turn * (p - place) + place - p)).transpose();
        }
        worst.stretch = std::max(worst.stretch, stretch(turning));
        const double changed = volume_change(turning);
        if (std::abs(changed) > std::abs(worst.volume - 1)) worst.volume = 1 + changed;
      }
    }
    return worst;
  }

  [[nodiscard]] double stretch(const std::vector<int>& turning) const {
    constexpr double bends = 0.01;  // by so much more on one end than on the other
    std::vector<double> ratios;
    for (const int v : turning) {
      for (const std::size_t e : edges_at_[idx(v)]) {
        const auto& [a, b] = edges_[e];
        const bool is_first = v == a || share_[idx(a)] == 0;
        if (!is_first || std::abs(share_[idx(a)] - share_[idx(b)]) < bends) continue;
        const double before = (surface_.positions.row(a) - surface_.positions.row(b)).norm();
        const double after = (moved_.row(a) - moved_.row(b)).norm();
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
  std::vector<int> place_;  // of each vertex the first in its place
  std::vector<Edge> edges_;
  std::vector<std::vector<std::size_t>> edges_at_;
  std::vector<std::vector<Eigen::Index>> triangles_at_;
  double volume_ = 0;
  std::vector<double> share_;  // of each vertex that turns with the joint that is posed
  Positions moved_;
  WeightChecks checks_;
};

}  // namespace

WeightChecks check_weights(const Surface& surface, const Rig& rig) {
  return WeightChecker(surface, rig).check();
}

}  // namespace curveskel
