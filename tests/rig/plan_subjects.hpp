// Bodies that have a plan, and things that have none, as tubes about the curves that they are made
// from.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/make_rig.hpp>
#include "meshes/shapes.hpp"
#include "tests/rig/rig_subjects.hpp"

namespace curveskel {

/// Places joined by edges; the left half also stands for the right one.
struct BodyCurve {
  std::vector<Eigen::RowVector3d> places;
  std::vector<double> radii;
  std::vector<std::pair<int, int>> edges;

  int add(const Eigen::RowVector3d& place, double radius, int from = -1) {
    places.push_back(place);
    radii.push_back(radius);
    const int number = static_cast<int>(places.size()) - 1;
    if (from >= 0) edges.emplace_back(from, number);
    return number;
  }
  /// A limb of both sides through these places, from a place in the middle.
  void add_pair(int from, const std::vector<Eigen::RowVector3d>& limb, double radius) {
    for (const double side : {1.0, -1.0}) {
      int above = from;
      for (const Eigen::RowVector3d& place : limb) {
        above = add({side * place.x(), place.y(), place.z()}, radius, above);
      }
    }
  }
};

inline RigSubject subject_of(const std::string& name, const BodyCurve& figure,
                             double resolution = 2.5) {
  CurveSkeleton graph;
  const auto count = static_cast<Eigen::Index>(figure.places.size());
  graph.nodes.resize(count, 3);
  graph.radii.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    graph.nodes.row(k) = figure.places[idx(k)];
    graph.radii[k] = figure.radii[idx(k)];
  }
  graph.edges.resize(static_cast<Eigen::Index>(figure.edges.size()), 2);
  for (std::size_t e = 0; e < figure.edges.size(); ++e) {
    graph.edges.row(static_cast<Eigen::Index>(e)) << figure.edges[e].first, figure.edges[e].second;
  }
  shapes::Shape shape = shapes::tube_union(name, graph, {0.25, resolution});
  graph.node_of_vertex.setConstant(shape.surface.positions.rows(), -1);
  RigSubject subject{name, std::move(shape.surface), std::move(graph)};
  subject.skeleton = dense_skeleton(subject.surface, subject.skeleton);
  for (Eigen::Index v = 0; v < subject.surface.positions.rows(); ++v) {
    Eigen::Index node = 0;
    (subject.skeleton.nodes.rowwise() - subject.surface.positions.row(v))
        .rowwise()
        .squaredNorm()
        .minCoeff(&node);
    subject.skeleton.node_of_vertex[v] = static_cast<int>(node);
  }
  return subject;
}

/// Legs, trunk and head, 20 high, looking along z. Returns the chest.
inline int add_body_without_arms(BodyCurve& figure) {
  const int hips = figure.add({0, 10, 0}, 1.4);
  const int chest = figure.add({0, 15, 0}, 1.5, hips);
  const int neck = figure.add({0, 16.8, 0}, 0.6, chest);
  figure.add({0, 18.6, 0}, 1.3, neck);
  figure.add_pair(hips, {{1.6, 9, 0}, {1.6, 5, 0}, {1.6, 0.6, 0}, {1.6, 0.5, 2}}, 0.6);
  return chest;
}

/// 20 high, looks along z, arms held out.
inline RigSubject human() {
  BodyCurve figure;
  const int chest = add_body_without_arms(figure);
  figure.add_pair(chest, {{2.2, 15, 0}, {5.5, 15, 0}, {8.5, 15, 0}}, 0.5);
  return subject_of("human", figure);
}

/// The same with a thumb and `fingers` on each hand, the last of which may end in two tips.
inline RigSubject human_with_hands(int fingers, bool is_forked = false) {
  BodyCurve figure;
  const int chest = add_body_without_arms(figure);
  for (const double side : {1.0, -1.0}) {
    int arm = chest;
    for (const double x : {2.2, 5.0, 7.0}) arm = figure.add({side * x, 15, 0}, 0.5, arm);
    const int thumb = figure.add({side * 8.2, 14.8, 1.2}, 0.22, arm);
    figure.add({side * 8.9, 14.7, 1.8}, 0.2, thumb);
    const int palm = figure.add({side * 8.4, 15, 0}, 0.4, arm);
    for (int finger = 0; finger < fingers; ++finger) {
      const double z = 0.9 - 1.8 * finger / std::max(fingers - 1, 1);
      const int knuckle = figure.add({side * 9.0, 15, z}, 0.2, palm);
      const double reach = 10.6 - 0.5 * std::abs(finger - 1);
      const int tip = figure.add({side * reach, 15, 1.1 * z}, 0.18, knuckle);
      if (!is_forked || finger + 1 < fingers) continue;
      figure.add({side * (reach + 0.15), 15.25, 1.1 * z}, 0.12, tip);
      figure.add({side * (reach + 0.15), 14.75, 1.1 * z}, 0.12, tip);
    }
  }
  return subject_of("hands", figure, 1.7);  // thin fingers, so many vertices
}

/// 20 long, its head at +z or -z.
inline RigSubject beast(double front) {
  BodyCurve figure;
  const int rump = figure.add({0, 8, -6 * front}, 1.4);
  const int withers = figure.add({0, 8, 5 * front}, 1.4, rump);
  const int neck = figure.add({0, 10.5, 8 * front}, 0.8, withers);
  figure.add({0, 11, 10.5 * front}, 1, neck);
  figure.add({0, 7, -11 * front}, 0.5, rump);
  figure.add_pair(rump, {{1.5, 6, -6.5 * front}, {1.5, 3, -7.5 * front}, {1.5, 0.5, -7 * front}},
                  0.5);
  figure.add_pair(withers, {{1.5, 6, 5 * front}, {1.5, 3, 5 * front}, {1.5, 0.5, 5 * front}}, 0.5);
  return subject_of("beast", figure);
}

/// Its ears leave the neck at that share of the way to the nose.
inline RigSubject beast_with_ears(double share) {
  BodyCurve figure;
  const int rump = figure.add({0, 8, -6}, 1.4);
  const int withers = figure.add({0, 8, 5}, 1.4, rump);
  const int poll = figure.add({0, 8 + 5 * share, 5 + 8 * share}, 0.8, withers);
  figure.add({0, 13, 13}, 0.8, poll);
  figure.add({0, 7, -11}, 0.5, rump);
  figure.add_pair(rump, {{1.5, 6, -6.5}, {1.5, 3, -7.5}, {1.5, 0.5, -7}}, 0.5);
  figure.add_pair(withers, {{1.5, 6, 5}, {1.5, 3, 5}, {1.5, 0.5, 5}}, 0.5);
  figure.add_pair(poll, {{1.5, 11 + 5 * share, 5 + 8 * share}}, 0.3);
  return subject_of("beast with ears", figure);
}

/// 14.6 high, its thighs level, its knees at z = 5, its hands over them.
inline RigSubject sitting_human() {
  BodyCurve figure;
  const int hips = figure.add({0, 5, 0}, 1.2);
  const int chest = figure.add({0, 10, 0}, 1.4, hips);
  const int neck = figure.add({0, 11.8, 0}, 0.6, chest);
  figure.add({0, 13.4, 0}, 1.2, neck);
  figure.add_pair(hips, {{1.4, 5, 1}, {1.4, 5, 5}, {1.4, 0.6, 5}, {1.4, 0.5, 7}}, 0.5);
  figure.add_pair(chest, {{2.2, 10, 0}, {2.6, 7.5, 0.5}, {2.6, 6.8, 4.2}}, 0.4);
  return subject_of("sitting", figure);
}

/// A doll that sits on the ground, its legs ahead of it, its arms held out.
inline RigSubject sitting_doll() {
  BodyCurve figure;
  const int hips = figure.add({0, 1.4, 0}, 1.4);
  const int chest = figure.add({0, 5.5, 0}, 1.4, hips);
  const int neck = figure.add({0, 7.4, 0}, 0.8, chest);
  figure.add({0, 9.5, 0}, 1.8, neck);
  figure.add_pair(hips, {{1.6, 1.3, 0.8}, {2, 1, 3.5}, {2.4, 0.9, 6}}, 0.8);
  figure.add_pair(chest, {{2, 5.5, 0}, {3.6, 4.4, 0.5}, {5.2, 3.4, 1}}, 0.6);
  return subject_of("doll", figure);
}

/// A mouse: ears that reach farther aside than its front legs, which stand aslant.
inline RigSubject mouse() {
  BodyCurve figure;
  const int rump = figure.add({0, 4, -4}, 1.4);
  const int withers = figure.add({0, 4.2, 3}, 1.2, rump);
  const int poll = figure.add({0, 5, 4.5}, 1.2, withers);
  figure.add({0, 4.4, 7.5}, 0.5, poll);
  figure.add({0, 2.5, -13}, 0.3, figure.add({0, 3, -8}, 0.4, rump));
  figure.add_pair(rump, {{1.6, 3.4, -4}, {1.9, 0.6, -4}, {1.9, 0.4, -2.4}}, 0.5);
  figure.add_pair(withers, {{1.2, 3.6, 3}, {2.8, 0.6, 3}}, 0.4);
  figure.add_pair(poll, {{1.2, 6, 4.5}, {3.6, 9, 4.5}}, 0.5);
  return subject_of("mouse", figure);
}

/// On two legs, leaning far ahead of a tail, with short arms.
inline RigSubject t_rex() {
  BodyCurve figure;
  const int hips = figure.add({0, 8, 0}, 1.5);
  const int chest = figure.add({0, 9.6, 5}, 1.2, hips);
  const int neck = figure.add({0, 11.5, 7.5}, 0.8, chest);
  figure.add({0, 12, 11}, 1, neck);
  figure.add({0, 7, -11}, 0.4, figure.add({0, 7.5, -5}, 0.9, hips));
  figure.add_pair(hips, {{1.7, 6, 0.5}, {1.7, 3, -0.5}, {1.7, 0.6, 0}, {1.7, 0.5, 1.2}}, 0.5);
  figure.add_pair(chest, {{1.5, 8.4, 5.6}, {1.6, 7, 6.2}}, 0.3);
  return subject_of("t-rex", figure);
}

/// Six branches round a trunk, none of them down to the ground.
inline RigSubject tree() {
  BodyCurve figure;
  int below = figure.add({0, 0.8, 0}, 0.8);
  for (const double height : {6.0, 9.0, 12.0}) {
    const int fork = figure.add({0.2, height, 0.1}, 0.8, below);
    figure.add({4, height + 3, 1.5}, 0.5, fork);
    figure.add({-3.4, height + 2.1, -2.2}, 0.5, fork);
    below = fork;
  }
  return subject_of("tree", figure);
}

/// 20 long, thick before the middle, with two pairs of fins and one on the back, its nose at +z or
/// -z; clear of the ground.
inline RigSubject fish(double front) {
  BodyCurve figure;
  const int thick = figure.add({0, 6, 3 * front}, 2);
  figure.add({0, 6, 8 * front}, 1, figure.add({0, 6, 6 * front}, 1.5, thick));
  const int back = figure.add({0, 6, 0.5 * front}, 1.8, thick);
  const int slim = figure.add({0, 6, -5 * front}, 0.9, back);
  const int tail = figure.add({0, 6, -9 * front}, 0.5, slim);
  figure.add_pair(tail, {{2, 6, -11 * front}}, 0.3);
  figure.add_pair(thick, {{2.5, 5, 2 * front}, {5, 4, 0.5 * front}}, 0.35);
  figure.add({0, 10, -2 * front}, 0.35, figure.add({0, 8.2, -0.5 * front}, 0.4, back));
  return subject_of("fish", figure, 2);
}

/// A body like the fish's whose back is the image of its belly, as of a column.
inline RigSubject baluster() {
  BodyCurve figure;
  const int thick = figure.add({0, 6, 3}, 2);
  figure.add({0, 6, 8}, 1, thick);
  const int tail = figure.add({0, 6, -9}, 0.5, figure.add({0, 6, -5}, 0.9, thick));
  figure.add_pair(tail, {{2, 6, -11}}, 0.3);
  figure.add_pair(thick, {{5, 6, 2}}, 0.35);
  for (const double up : {1.0, -1.0}) {
    figure.add({0, 6 + 5 * up, 2}, 0.35, thick);
    figure.add({0, 6 + 2 * up, -11}, 0.3, tail);
  }
  return subject_of("baluster", figure, 2);
}

/// The same fish with its tail aside, as it swims, and the fins of its sides ahead of its nose.
inline RigSubject lionfish() {
  BodyCurve figure;
  const int thick = figure.add({0, 6, 3}, 2.2);
  figure.add({0, 6, 5}, 1.8, thick);
  const int back = figure.add({0, 6, 0.5}, 1.9, thick);
  const int slim = figure.add({0.25, 6, -5}, 0.9, back);
  figure.add({0.5, 6, -11}, 0.5, slim);
  figure.add_pair(thick, {{2.5, 6.5, 5}, {4, 8, 12}}, 0.35);
  return subject_of("lionfish", figure, 2);
}

/// A rod with a pair of pegs; or with a ring at its end.
inline RigSubject rod(bool is_ringed) {
  BodyCurve figure;
  const int front = figure.add({0, 6, 9}, is_ringed ? 2.0 : 1.0);
  const int middle = figure.add({0, 6, 3}, is_ringed ? 1.6 : 1.0, front);
  const int rear = figure.add({0, 6, -9}, is_ringed ? 0.4 : 1.0, middle);
  figure.add_pair(middle, {{3, 5, 3}, {5, 5, 2}}, 0.35);
  if (is_ringed) {
    const int above = figure.add({0, 9, -9}, 0.4, rear);
    const int ahead = figure.add({0, 9, -3}, 0.4, above);
    figure.edges.emplace_back(ahead, middle);
  }
  return subject_of("rod", figure, 2);
}

inline RigSubject snake() {
  BodyCurve figure;
  int before = figure.add({-10, 1, 0}, 0.8);
  for (int k = 1; k <= 10; ++k) before = figure.add({2.0 * k - 10, 1, std::sin(k)}, 0.8, before);
  return subject_of("snake", figure);
}

inline const PlannedJoint* joint_of(const BodyPlan& plan, const std::string& role) {
  const auto found = std::find_if(plan.joints.begin(), plan.joints.end(),
                                  [&](const PlannedJoint& joint) { return joint.role == role; });
  return found == plan.joints.end() ? nullptr : &*found;
}

inline void expect_near(const BodyPlan& plan, const std::string& role,
                        const Eigen::RowVector3d& place, double off) {
  const PlannedJoint* joint = joint_of(plan, role);
  ASSERT_NE(joint, nullptr) << role;
  EXPECT_LT((joint->position - place).norm(), off) << role << " at " << joint->position;
}

/// `axes`: rows to the left, up and ahead, in which the subject stands as it is made.
inline RigSubject standing_in(RigSubject subject, const Eigen::Matrix3d& axes) {
  subject.surface.positions *= axes;
  subject.skeleton.nodes *= axes;
  return subject;
}

/// The rows of `standing_in`.
inline Eigen::Matrix3d frame(const Eigen::Vector3d& up, const Eigen::Vector3d& front) {
  Eigen::Matrix3d axes;
  axes << up.cross(front).transpose(), up.transpose(), front.transpose();
  return axes;
}

}  // namespace curveskel
