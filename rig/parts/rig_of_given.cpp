#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/error.hpp>
#include <curveskel/make_rig.hpp>
#include "rig/joints/sound_rig.hpp"
#include "rig/parts/nearest_first.hpp"
#include "rig/skin/weight_pieces.hpp"
#include "skeleton/graph/sound_skeleton.hpp"
#include "surface/mesh/triangle_area.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// All that moves with the body without being of it, and hangs together.
struct Follower {
  std::vector<int> vertices;
  bool sewn = false;  ///< to the body
};

std::vector<Follower> find_followers(const Surface& given, const Eigen::VectorXi& vertex_of_input) {
  const Eigen::Index count = given.positions.rows();
  UnionFind joined(count);
  for (const auto& t : given.triangles.rowwise()) {
    for (int k = 1; k < 3; ++k) joined.unite(t(0), t(k));
  }
  const std::vector<int> place = welded_places(given);
  std::vector<char> sewn(idx(count), 0);
  for (int v = 0; v < static_cast<int>(count); ++v) {
    const int other = place[idx(v)];
    const bool follows = vertex_of_input[v] < 0;
    if (follows && vertex_of_input[other] < 0) joined.unite(v, other);
    if (follows != (vertex_of_input[other] < 0)) sewn[idx(follows ? v : other)] = 1;
  }
  std::map<int, Follower> by_root;
  for (int v = 0; v < static_cast<int>(count); ++v) {
    if (vertex_of_input[v] >= 0) continue;
    Follower& follower = by_root[joined.root(v)];
    follower.vertices.push_back(v);
    follower.sewn = follower.sewn || sewn[idx(v)] != 0;
  }
  std::vector<Follower> followers;
  followers.reserve(by_root.size());
  for (auto& [root, follower] : by_root) followers.push_back(std::move(follower));
  return followers;
}

/// By joint the only one with a role that hangs from it, if no vertex moves mostly with that one or
/// with one below: the head of a body that ends at the neck. Else -1.
std::vector<int> idle_ends(const Rig& rig) {
  const Eigen::Index count = rig.joints.rows();
  std::vector<char> leads(idx(count), 0);  // or one below does
  for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
    for (SkinWeights::InnerIterator it(rig.weights, v); it; ++it) {
      if (it.value() <= 0.5F) continue;
      for (int j = static_cast<int>(it.col()); j >= 0 && leads[idx(j)] == 0; j = rig.parents[j]) {
        leads[idx(j)] = 1;
      }
    }
  }
  constexpr int several = -2;
  std::vector<int> next(idx(count), -1);
  for (int joint = 0; joint < static_cast<int>(rig.roles.size()); ++joint) {
    const int parent = rig.parents[joint];
    if (parent < 0 || rig.roles[idx(joint)].empty()) continue;
    next[idx(parent)] = next[idx(parent)] == -1 ? joint : several;
  }
  for (int& joint : next) {
    if (joint < 0 || leads[idx(joint)] != 0) joint = -1;
  }
  return next;
}

class Following {
 public:
  Following(const Rig& rig, const Surface& surface, const CurveSkeleton& skeleton,
            const Surface& given, const SkinOptions& options)
      : rig_(rig),
        surface_(surface),
        skeleton_(skeleton),
        given_(given),
        most_joints_(idx(options.most_joints)),
        tree_(surface),
        idle_end_(idle_ends(rig)) {}

  /// Calls set(vertex, row).
  template <typename Set>
  void follow(const Follower& follower, const Set& set) const {
    std::vector<SurfaceTree::Nearest> contacts;
    contacts.reserve(follower.vertices.size());
    for (const int v : follower.vertices) {
      contacts.push_back(tree_.nearest(given_.positions.row(v).transpose()));
    }
    const Vector3d middle = given_.positions(follower.vertices, Eigen::all).colwise().mean();
    if (moves_as_one(follower, contacts)) {
      const WeightRow row = handed_on(mean_row(nearest_of(contacts)), middle);
      for (const int v : follower.vertices) set(v, row);
      return;
    }
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      set(follower.vertices[k], handed_on(mean_row({contacts[k]}), middle));
    }
  }

 private:
  /// A follower beyond a joint that moves nothing of the body, where it would mostly move with the
  /// joint before, moves with that joint alone, as a head does that is a part of its own.
  [[nodiscard]] WeightRow handed_on(const WeightRow& row, const Vector3d& middle) const {
    if (row.empty()) return row;
    const auto is_less = [](const auto& a, const auto& b) { return a.second < b.second; };
    const int first = std::max_element(row.begin(), row.end(), is_less)->first;
    int last = first;
    for (int next = idle_end_[idx(last)]; next >= 0; next = idle_end_[idx(next)]) {
      const Vector3d at = rig_.joints.row(next).transpose();
      if ((middle - at).dot(at - rig_.joints.row(last).transpose()) <= 0) break;
      last = next;
    }
    return last == first ? row : WeightRow{{last, 1}};
  }

  [[nodiscard]] bool moves_as_one(const Follower& follower,
                                  const std::vector<SurfaceTree::Nearest>& contacts) const {
    constexpr double longest = 5;  // radii
    if (follower.sewn) return false;
    double radius = 0;
    for (const SurfaceTree::Nearest& contact : contacts) {
      radius = std::max(radius, radius_at(contact.triangle));
    }
    const auto places = given_.positions(follower.vertices, Eigen::all);
    const double diagonal = (places.colwise().maxCoeff() - places.colwise().minCoeff()).norm();
    return diagonal < longest * radius;
  }

  /// Of the skeleton's nodes for the corners the largest.
  [[nodiscard]] double radius_at(int triangle) const {
    if (skeleton_.radii.size() == 0 || skeleton_.node_of_vertex.size() == 0) return 0;
    double radius = 0;
    for (const int vertex : surface_.triangles.row(triangle)) {
      const int node = skeleton_.node_of_vertex[vertex];
      if (node >= 0) radius = std::max(radius, skeleton_.radii[node]);
    }
    return radius;
  }

  static std::vector<SurfaceTree::Nearest> nearest_of(std::vector<SurfaceTree::Nearest> contacts) {
    contacts = nearest_first(std::move(contacts));
    contacts.resize(places_that_count(contacts.size()));
    return contacts;
  }

  [[nodiscard]] WeightRow mean_row(const std::vector<SurfaceTree::Nearest>& contacts) const {
    std::map<int, double> shares;
    for (const SurfaceTree::Nearest& contact : contacts) {
      const std::array<double, 3> at = barycentric(contact);
      for (int k = 0; k < 3; ++k) {
        const int vertex = surface_.triangles(contact.triangle, k);
        for (SkinWeights::InnerIterator it(rig_.weights, vertex); it; ++it) {
          const double share = at[idx(k)] * static_cast<double>(it.value());
          if (share > 0) shares[static_cast<int>(it.col())] += share;
        }
      }
    }
    return largest_shares({shares.begin(), shares.end()}, most_joints_);
  }

  [[nodiscard]] std::array<double, 3> barycentric(const SurfaceTree::Nearest& contact) const {
    const auto corner = [&](int k) -> Vector3d {
      return surface_.positions.row(surface_.triangles(contact.triangle, k));
    };
    const std::array<double, 3> parts{twice_area(contact.point, corner(1), corner(2)),
                                      twice_area(corner(0), contact.point, corner(2)),
                                      twice_area(corner(0), corner(1), contact.point)};
    const double sum = parts[0] + parts[1] + parts[2];
    if (!(sum > 0)) return {1, 0, 0};
    return {parts[0] / sum, parts[1] / sum, parts[2] / sum};
  }

  const Rig& rig_;
  const Surface& surface_;
  const CurveSkeleton& skeleton_;
  const Surface& given_;
  const std::size_t most_joints_;
  SurfaceTree tree_;
  std::vector<int> idle_end_;  // by joint
};

}  // namespace

Rig rig_of_given(const Rig& rig, const Surface& surface, const CurveSkeleton& skeleton,
                 const Eigen::VectorXi& vertex_of_input, const Surface& given,
                 const SkinOptions& options) {
  require_valid(options);
  require_sound(rig, "rig_of_given");
  require_weights_of(rig, surface.positions.rows(), "rig_of_given");
  require_corners(surface, "rig_of_given");
  require_sound(skeleton, "rig_of_given");
  require_vertices_of(skeleton, surface, "rig_of_given");
  require_corners(given, "rig_of_given");
  require_below(vertex_of_input, surface.positions.rows(), "rig_of_given");
  const Eigen::Index count = given.positions.rows();
  if (vertex_of_input.size() != count) {
    throw Error(Fault::input, "rig_of_given: found a map of " +
                                  std::to_string(vertex_of_input.size()) +
                                  " vertices, needed one of the file's " + std::to_string(count));
  }
  std::vector<WeightRow> rows(idx(count));
  for (Eigen::Index v = 0; v < count; ++v) {
    if (vertex_of_input[v] < 0) continue;
    for (SkinWeights::InnerIterator it(rig.weights, vertex_of_input[v]); it; ++it) {
      rows[idx(v)].emplace_back(static_cast<int>(it.col()), static_cast<double>(it.value()));
    }
  }
  const std::vector<Follower> followers = find_followers(given, vertex_of_input);
  if (!followers.empty()) {
    const Following following(rig, surface, skeleton, given, options);
    for (const Follower& follower : followers) {
      following.follow(follower, [&](int v, const WeightRow& row) { rows[idx(v)] = row; });
    }
  }
  Rig result{rig.joints, rig.parents, rig.names,    SkinWeights(count, rig.weights.cols()),
             rig.roles,  rig.turns,   rig.readable, rig.to_y_up};
  result.weights.reserve(Eigen::VectorXi::Constant(count, options.most_joints));
  for (Eigen::Index v = 0; v < count; ++v) {
    for (const auto& [joint, share] : rows[idx(v)]) {
      result.weights.insert(v, joint) = static_cast<float>(share);
    }
  }
  result.weights.makeCompressed();
  return result;
}

std::vector<bool> followers_of(const Eigen::VectorXi& vertex_of_input) {
  std::vector<bool> follows;
  follows.reserve(idx(vertex_of_input.size()));
  for (const int vertex : vertex_of_input) follows.push_back(vertex < 0);
  return follows;
}

}  // namespace curveskel
