// Laws of what components hang from, and where: as a person would hang the parts of a figure.
#include "rig/joints/hanging.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/joints.hpp>
#include "tests/rig/rig_subjects.hpp"

namespace curveskel::hanging_laws {
namespace {

using Point = Eigen::RowVector3d;

struct Part {
  std::string name;
  CurveSkeleton curve;
  std::string above;  // what it is to hang from
  Point root;         // and where
};

struct Assembled {
  CurveSkeleton skeleton;
  std::vector<std::vector<int>> components;
  std::vector<int> component_of;  // by node
};

Assembled assemble(const std::vector<Part>& parts) {
  Assembled all;
  std::vector<CurveSkeleton> curves;
  for (const Part& part : parts) {
    all.components.emplace_back();
    for (Eigen::Index k = 0; k < part.curve.nodes.rows(); ++k) {
      all.components.back().push_back(static_cast<int>(all.component_of.size()));
      all.component_of.push_back(static_cast<int>(all.components.size()) - 1);
    }
    curves.push_back(part.curve);
  }
  all.skeleton = curves_together(curves);
  return all;
}

void expect_hung(const std::vector<Part>& parts) {
  const Assembled all = assemble(parts);
  const std::vector<Hinge> hinges =
      hang_components(all.skeleton, all.skeleton.radii, all.components);
  ASSERT_EQ(hinges.size(), parts.size());
  EXPECT_EQ(hinges.front().above, -1);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    SCOPED_TRACE(parts[k].name);
    ASSERT_GE(hinges[k].above, 0);
    EXPECT_EQ(parts[idx(all.component_of[idx(hinges[k].above)])].name, parts[k].above);
    ASSERT_EQ(all.component_of[idx(hinges[k].node)], static_cast<int>(k));
    EXPECT_LT((all.skeleton.nodes.row(hinges[k].node) - parts[k].root).norm(), 1e-9);
  }
}

/// The first stays, the others come in any order, drawn in either direction.
void expect_hung_in_any_order(std::vector<Part> parts) {
  std::mt19937 random(7);
  for (int round = 0; round < 6; ++round) {
    SCOPED_TRACE(round);
    expect_hung(parts);
    std::shuffle(parts.begin() + 1, parts.end(), random);
    for (Part& part : parts) {
      if (random() % 2 == 0) continue;
      part.curve.nodes = part.curve.nodes.colwise().reverse().eval();
      part.curve.radii = part.curve.radii.reverse().eval();
    }
  }
}

Part part(std::string name, const Point& from, const Point& to, double radius, std::string above) {
  return {std::move(name), chain_through({from, to}, radius, 0.4 * radius), std::move(above), from};
}

void add_hand(std::vector<Part>& parts, const std::string& side, double sign, double finger_start,
              double finger_radius) {
  const auto at_side = [&](double x, double y, double z) { return Point(sign * x, y, z); };
  parts.push_back(
      part("hand" + side, at_side(0.74, 1.42, 0), at_side(0.8, 1.42, 0), 0.04, "lower arm" + side));
  for (const double z : {-0.03, -0.01, 0.01, 0.03}) {
    parts.push_back(part("finger " + std::to_string(z) + side, at_side(finger_start, 1.42, z),
                         at_side(0.92, 1.42, 1.3 * z), finger_radius, "hand" + side));
  }
  parts.push_back(part("thumb" + side, at_side(0.76, 1.42, 0.03), at_side(0.8, 1.42, 0.09), 0.009,
                       "hand" + side));
}

void add_leg(std::vector<Part>& parts, const std::string& side, double sign) {
  const auto at_side = [&](double x, double y, double z) { return Point(sign * x, y, z); };
  parts.push_back(part("thigh" + side, at_side(0.09, 0.9, 0), at_side(0.1, 0.5, 0), 0.08, "torso"));
  parts.push_back(
      part("shin" + side, at_side(0.1, 0.5, 0), at_side(0.1, 0.1, 0), 0.06, "thigh" + side));
  parts.push_back(
      part("foot" + side, at_side(0.1, 0.05, 0), at_side(0.1, 0.04, 0.15), 0.04, "shin" + side));
}

std::vector<Part> trunk() {
  return {part("torso", {0, 0.95, 0}, {0, 1.35, 0}, 0.16, ""),
          part("neck", {0, 1.4, 0}, {0, 1.55, 0}, 0.06, "torso"),
          part("head", {0, 1.68, 0}, {0, 1.69, 0}, 0.12, "neck")};
}

/// In a T, of capsules that touch or overlap.
std::vector<Part> figure(double finger_start, double finger_radius) {
  std::vector<Part> parts = trunk();
  for (const double sign : {1.0, -1.0}) {
    const std::string side = sign > 0 ? ".L" : ".R";
    const auto along = [&](double x) { return Point(sign * x, 1.42, 0); };
    parts.push_back(part("upper arm" + side, along(0.17), along(0.45), 0.05, "torso"));
    parts.push_back(part("lower arm" + side, along(0.45), along(0.72), 0.04, "upper arm" + side));
    add_hand(parts, side, sign, finger_start, finger_radius);
    add_leg(parts, side, sign);
  }
  return parts;
}

TEST(Hanging, GoesFromTheTorsoOutToTheFingersAndToes) {
  for (const double finger_start : {0.8, 0.82, 0.835, 0.845}) {  // from deep inside to 0.005 off
    for (const double finger_radius : {0.0085, 0.012}) {         // apart, overlapping each other
      SCOPED_TRACE(testing::Message() << finger_start << ' ' << finger_radius);
      expect_hung_in_any_order(figure(finger_start, finger_radius));
    }
  }
}

/// The hand touches the thigh.
TEST(Hanging, LeavesAnArmOnItsShoulderWhereItHangsDownBesideTheBody) {
  std::vector<Part> parts = trunk();
  for (const double sign : {1.0, -1.0}) {
    const std::string side = sign > 0 ? ".L" : ".R";
    const auto at_side = [&](double x, double y) { return Point(sign * x, y, 0); };
    parts.push_back(
        part("upper arm" + side, at_side(0.2, 1.38), at_side(0.24, 1.1), 0.05, "torso"));
    parts.push_back(part("lower arm" + side, at_side(0.24, 1.1), at_side(0.225, 0.85), 0.04,
                         "upper arm" + side));
    parts.push_back(
        part("hand" + side, at_side(0.22, 0.83), at_side(0.22, 0.76), 0.04, "lower arm" + side));
    add_leg(parts, side, sign);
  }
  expect_hung_in_any_order(parts);
}

/// However deep inside of both it lies.
TEST(Hanging, HangsNothingFromTheRivetThatHoldsIt) {
  const Part body = part("body", {0, 0, 0}, {0, 10, 0}, 2, "");
  const Part arm = part("arm", {2.5, 8, 0}, {12, 8, 0}, 0.8, "body");
  const Point place(1.99, 8, 0.1);
  const Part rivet{"rivet", chain_through({place}, 0.05, 1), "arm", place};
  expect_hung_in_any_order({body, arm, rivet});
}

TEST(Hanging, RootsWhatLiesAcrossWhereItTouches) {
  const Part post = part("post", {0, 0, 0}, {0, 20, 0}, 1, "");
  Part beam = part("beam", {-8, 21.5, 0}, {8, 21.5, 0}, 0.5, "post");
  beam.root = {0, 21.5, 0};
  expect_hung_in_any_order({post, beam});
  Part pushed = beam;
  pushed.curve.nodes.col(0).array() += 7.4;  // its end is 0.6 from where it touches
  pushed.root = {-0.6, 21.5, 0};
  expect_hung_in_any_order({post, pushed});
}

/// A joint beside the joint of the junction would be of no use.
TEST(Hanging, RootsAtAJunctionThatIsNear) {
  CurveSkeleton star = shapes::star(3, 9, 1);
  star.nodes.rowwise() += Point(0.3, 0, 0.8) - Point::Zero();
  const Part post = part("post", {0, 0, -30}, {0, 0, -2}, 1.5, "");
  Part fan{"fan", star, "post", {0.3, 0, 0.8}};
  expect_hung({post, fan});
}

TEST(Hanging, TurnsRoundWithAWantedRoot) {
  std::vector<Part> parts = figure(0.82, 0.0085);
  std::map<std::string, std::string> above;
  for (const Part& each : parts) above[each.name] = each.above;
  const auto finger = std::find_if(parts.begin(), parts.end(), [](const Part& each) {
    return each.name.starts_with("finger") && each.name.ends_with(".L");
  });
  std::iter_swap(parts.begin(), finger);
  const Assembled all = assemble(parts);
  const std::vector<Hinge> hinges =
      hang_components(all.skeleton, all.skeleton.radii, all.components);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const std::string& name = parts[k].name;
    const std::string& found = parts[idx(all.component_of[idx(hinges[k].above)])].name;
    EXPECT_TRUE(above[name] == found || above[found] == name) << name << ' ' << found;
  }
}

/// Boxes round bunches of nodes leave nothing out.
TEST(Hanging, FindsTheNearestOfVeryManyNodes) {
  for (const double x : {-31.0, -2.5, 17.25}) {
    const Part rail{"rail", chain_through({{-40, 0, 0}, {40, 0, 0}}, 0.5, 0.01), "", {}};
    const Part across{
        "across", chain_through({{x, 3, -20}, {x, 3, 50}}, 0.5, 0.01), "rail", {x, 3, 0}};
    expect_hung({rail, across});
  }
}

TEST(Hanging, TakesNotLongForThousands) {
  std::vector<Part> parts{part("bar", {0, 0, 0}, {3000, 0, 0}, 1, "")};
  for (int k = 0; k < 3000; ++k) {
    const Point root(k, 1.2, 0);
    parts.push_back({"speck", chain_through({root}, 0.3, 1), "bar", root});
  }
  expect_hung(parts);
}

/// The hand turns about the wrist, the fingers about the knuckles.
TEST(Hanging, PlacesJointsOfAFigureWhereItsPartsMeet) {
  const std::vector<Part> parts = figure(0.82, 0.0085);
  const Assembled all = assemble(parts);
  const Joints joints = place_joints(all.skeleton, {});
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const int root = joints.joint_of_node[all.components[k].front()];
    EXPECT_TRUE(joints.names[idx(root)].ends_with("_root")) << joints.names[idx(root)];
    EXPECT_LT((joints.positions.row(root) - parts[k].root).norm(), 1e-9) << parts[k].name;
    const int above = joints.parents[root];
    bool is_of_above = false;
    for (std::size_t node = 0; node < all.component_of.size(); ++node) {
      const std::string& name = parts[idx(all.component_of[node])].name;
      is_of_above |=
          name == parts[k].above && joints.joint_of_node[static_cast<int>(node)] == above;
    }
    EXPECT_TRUE(is_of_above) << parts[k].name;
  }
}

/// No shoe hangs from it either, though it is nearer.
TEST(Hanging, LetsTheGroundBelowAFigureLie) {
  std::vector<Part> parts = figure(0.82, 0.0085);
  parts.insert(parts.begin() + 1, part("ground", {-2, -0.03, 0.1}, {2, -0.03, 0.1}, 0.05, ""));
  const Assembled all = assemble(parts);
  const std::vector<Hinge> hinges =
      hang_components(all.skeleton, all.skeleton.radii, all.components, all.components[1]);
  EXPECT_LT(hinges[1].above, 0);
  for (std::size_t k = 2; k < parts.size(); ++k) {
    ASSERT_GE(hinges[k].above, 0);
    EXPECT_EQ(parts[idx(all.component_of[idx(hinges[k].above)])].name, parts[k].above);
  }
}

/// Figures that stand apart each keep all their parts, and hang from none.
TEST(Hanging, LetsTheBodiesOfASceneStandApart) {
  for (const int bodies : {2, 3, 5}) {
    std::vector<Part> parts;
    for (int body = 0; body < bodies; ++body) {
      for (Part part : figure(0.82, 0.0085)) {
        part.curve.nodes.rowwise() += Point(4.0 * body, 0, 0.5 * body);
        part.name += " of " + std::to_string(body);
        parts.push_back(std::move(part));
      }
    }
    const Assembled all = assemble(parts);
    const std::vector<Hinge> hinges =
        hang_components(all.skeleton, all.skeleton.radii, all.components);
    int apart = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (hinges[k].above < 0) {
        ++apart;
        continue;
      }
      const std::string& above = parts[idx(all.component_of[idx(hinges[k].above)])].name;
      EXPECT_EQ(above.substr(above.find(" of ")), parts[k].name.substr(parts[k].name.find(" of ")));
    }
    EXPECT_EQ(apart, bodies);
    const Joints joints = place_joints(all.skeleton, {});
    EXPECT_EQ((joints.parents.array() < 0).count(), bodies);
  }
}

/// No contacts, two nodes each: see `hang_components`.
double link_length(const CurveSkeleton& skeleton, int node, int above) {
  const auto along = [&](int of) -> Eigen::Vector3d {
    const int first = of - of % 2;
    return (skeleton.nodes.row(first + 1) - skeleton.nodes.row(first)).normalized().transpose();
  };
  const Eigen::Vector3d way = (skeleton.nodes.row(above) - skeleton.nodes.row(node)).transpose();
  const double smaller = std::min(skeleton.radii[node], skeleton.radii[above]);
  const double gap = way.norm() - skeleton.radii[node] - skeleton.radii[above];
  const double ahead = std::max(std::abs(along(node).dot(way)), std::abs(along(above).dot(way)));
  return std::max(gap, -2 * smaller) + smaller * (1 - ahead / way.norm());
}

/// More than others hang from, of all sizes, in a heap.
TEST(Hanging, OfThousandsEachHangsFromTheNearest) {
  constexpr int parts = 1300;
  constexpr int above = 1000;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  Assembled all;
  all.skeleton.nodes.resize(Eigen::Index{2} * parts, 3);
  all.skeleton.radii.resize(Eigen::Index{2} * parts);
  all.skeleton.edges.resize(parts, 2);
  for (int k = 0; k < parts; ++k) {
    const int first = 2 * k;
    const Point at = 10 * Point(unit(random), unit(random), unit(random));
    const double size = k % 100 == 0 ? 5 : 0.5;
    all.skeleton.nodes.row(first) = at;
    all.skeleton.nodes.row(first + 1) = at + size * Point(unit(random), unit(random), 0.1);
    all.skeleton.radii[first] = size * (0.01 + 0.2 * unit(random));
    all.skeleton.radii[first + 1] = size * (0.01 + 0.2 * unit(random));
    all.skeleton.edges.row(k) << first, first + 1;
    all.components.push_back({first, first + 1});
  }
  const std::vector<Hinge> hinges =
      hang_components(all.skeleton, all.skeleton.radii, all.components);
  for (int part = above; part < parts; ++part) {
    double least = std::numeric_limits<double>::infinity();
    for (const int node : all.components[idx(part)]) {
      for (int other = 0; other < 2 * above; ++other) {
        least = std::min(least, link_length(all.skeleton, node, other));
      }
    }
    const Hinge& hinge = hinges[idx(part)];
    ASSERT_GE(hinge.above, 0);
    ASSERT_LT(hinge.above, 2 * above);
    EXPECT_NEAR(link_length(all.skeleton, hinge.node, hinge.above), least, 1e-9) << part;
  }
}

}  // namespace
}  // namespace curveskel::hanging_laws
