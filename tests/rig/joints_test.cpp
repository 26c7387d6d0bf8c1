// Laws of joints over the curves of many shapes: a tree of them lies on the curve, moves all of it.
// Where exactly they are is known for chains, corners, stars and rings: see joint_places_test.
#include <curveskel/advanced/joints.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include "rig/joints/rooted_tree.hpp"
#include "tests/rig/rig_subjects.hpp"

namespace curveskel::joints_laws {
namespace {

/// The subjects' curves, a few of them with other options.
struct PlacedCase {
  std::string name;
  CurveSkeleton skeleton;
  JointOptions options;
};

std::vector<PlacedCase> make_placed_cases() {
  std::vector<PlacedCase> all;
  for (const RigSubject& subject : rig_subjects()) {
    const auto last = static_cast<int>(subject.skeleton.nodes.rows()) - 1;
    all.push_back({subject.name, subject.skeleton, {}});
    all.push_back({subject.name + ", short bones", subject.skeleton, {.bone_length = 0.7}});
    all.push_back(
        {subject.name + ", long stiff bones", subject.skeleton, {.bone_length = 50, .bend = 5}});
    all.push_back({subject.name + ", from its last node", subject.skeleton, {.root = last}});
    all.push_back({subject.name + ", without radii", subject.skeleton, {}});
    all.back().skeleton.radii.resize(0);
    all.push_back({subject.name + ", outside", subject.skeleton, {}});
    all.back().skeleton.radii.setZero();
    all.push_back({subject.name + ", partly outside", subject.skeleton, {}});
    for (int node = 0; node <= last; node += 3) all.back().skeleton.radii[node] = 0;
  }
  const CurveSkeleton point = chain_through({{1, 2, 3}}, 1, 1);
  all.push_back({"a point", point, {}});
  all.push_back({"a point outside", scaled_curve(point, 0), {}});
  all.push_back({"a chain without length", chain_through({{1, 2, 3}, {1, 2, 3}}, 1, 1), {}});
  for (const int arms : {2, 4, 9}) {
    all.push_back({std::to_string(arms) + " arms", shapes::star(arms, 5, 1), {}});
  }
  return all;
}

const std::vector<PlacedCase>& placed_cases() {
  static const std::vector<PlacedCase> all = make_placed_cases();
  return all;
}

bool ends_with_end(const std::string& name) { return name.ends_with("_end"); }

double least_distance(const Eigen::RowVector3d& point, const CurveSkeleton& skeleton) {
  double least = (skeleton.nodes.rowwise() - point).rowwise().norm().minCoeff();
  for (const auto& edge : skeleton.edges.rowwise()) {
    least = std::min(least, distance_to_segment(point, skeleton.nodes.row(edge[0]),
                                                skeleton.nodes.row(edge[1])));
  }
  return least;
}

/// A tree for each body that stands apart.
TEST(Joints, AreTreesParentsBeforeChildren) {
  for (const PlacedCase& one : placed_cases()) {
    SCOPED_TRACE(one.name);
    const Joints joints = place_joints(one.skeleton, one.options);
    ASSERT_GT(joints.positions.rows(), 0);
    ASSERT_EQ(joints.parents.size(), joints.positions.rows());
    EXPECT_TRUE(joints.positions.allFinite());
    EXPECT_EQ(joints.parents[0], -1);
    for (Eigen::Index joint = 1; joint < joints.parents.size(); ++joint) {
      EXPECT_GE(joints.parents[joint], -1);
      EXPECT_LT(joints.parents[joint], joint);
    }
    const std::vector<int> part = component_of_node(one.skeleton);
    EXPECT_LE((joints.parents.array() < 0).count(),
              1 + *std::max_element(part.begin(), part.end()));
  }
}

TEST(Joints, HaveNamesOfTheirOwn) {
  for (const PlacedCase& one : placed_cases()) {
    SCOPED_TRACE(one.name);
    const Joints joints = place_joints(one.skeleton, one.options);
    ASSERT_EQ(joints.names.size(), idx(joints.positions.rows()));
    const std::set<std::string> different(joints.names.begin(), joints.names.end());
    EXPECT_EQ(different.size(), joints.names.size());
    EXPECT_FALSE(different.contains(""));
    EXPECT_EQ(joints.names.front(), "root");
  }
}

TEST(Joints, LieOnTheCurve) {
  for (const PlacedCase& one : placed_cases()) {
    SCOPED_TRACE(one.name);
    const Joints joints = place_joints(one.skeleton, one.options);
    const double tolerance = 1e-9 * bounding_box_diagonal(one.skeleton.nodes);
    for (const auto& joint : joints.positions.rowwise()) {
      EXPECT_LE(least_distance(joint, one.skeleton), tolerance);
    }
  }
}

/// From the node to its root.
std::vector<Eigen::RowVector3d> way_to_root(const CurveSkeleton& skeleton, const RootedTree& tree,
                                            int node) {
  std::vector<Eigen::RowVector3d> way;
  for (; node >= 0; node = tree.parent[idx(node)]) way.emplace_back(skeleton.nodes.row(node));
  return way;
}

bool lies_on(const std::vector<Eigen::RowVector3d>& way, const Eigen::RowVector3d& point,
             double tolerance) {
  double least = (point - way.front()).norm();
  for (std::size_t k = 1; k < way.size(); ++k) {
    least = std::min(least, distance_to_segment(point, way[k - 1], way[k]));
  }
  return least <= tolerance;
}

/// One further out would tear a node off what lies between them, one further back would leave what
/// lies between them stiff.
TEST(Joints, MoveEachNodeByTheNearestOnItsWayToTheRoot) {
  for (const PlacedCase& one : placed_cases()) {
    SCOPED_TRACE(one.name);
    const Joints joints = place_joints(one.skeleton, one.options);
    const RootedTree tree = rooted_tree(one.skeleton, one.options.root);
    const double tolerance = 1e-9 * bounding_box_diagonal(one.skeleton.nodes);
    ASSERT_EQ(joints.joint_of_node.size(), one.skeleton.nodes.rows());
    for (int node = 0; node < joints.joint_of_node.size(); ++node) {
      const int joint = joints.joint_of_node[node];
      ASSERT_GE(joint, 0);
      ASSERT_LT(joint, joints.positions.rows());
      const std::vector<Eigen::RowVector3d> way = way_to_root(one.skeleton, tree, node);
      EXPECT_TRUE(lies_on(way, joints.positions.row(joint), tolerance)) << "node " << node;
      for (int other = joint + 1; other < joints.parents.size(); ++other) {
        if (joints.parents[other] != joint) continue;
        const Eigen::RowVector3d place = joints.positions.row(other);
        const bool is_here = (place - way.front()).norm() <= tolerance;
        EXPECT_TRUE(is_here || !lies_on(way, place, tolerance)) << node << ' ' << other;
      }
    }
  }
}

TEST(Joints, EndAtTipsThatMoveNothing) {
  for (const PlacedCase& one : placed_cases()) {
    SCOPED_TRACE(one.name);
    JointOptions options = one.options;
    options.least_bone = 0;  // the shortest limbs, too
    const Joints joints = place_joints(one.skeleton, options);
    const RootedTree tree = rooted_tree(one.skeleton, options.root);
    const double tolerance = 1e-9 * bounding_box_diagonal(one.skeleton.nodes);
    std::vector<Eigen::RowVector3d> leaves;
    for (std::size_t node = 0; node < tree.parent.size(); ++node) {
      if (tree.parent[node] < 0 || !tree.children[node].empty()) continue;
      leaves.emplace_back(one.skeleton.nodes.row(static_cast<Eigen::Index>(node)));
    }
    std::size_t ends = 0;
    for (int joint = 0; joint < joints.positions.rows(); ++joint) {
      if (!ends_with_end(joints.names[idx(joint)])) continue;
      ++ends;
      EXPECT_EQ((joints.parents.array() == joint).count(), 0);
      EXPECT_EQ((joints.joint_of_node.array() == joint).count(), 0);
      const auto is_here = [&](const Eigen::RowVector3d& leaf) {
        return (leaf - joints.positions.row(joint)).norm() <= tolerance;
      };
      EXPECT_TRUE(std::any_of(leaves.begin(), leaves.end(), is_here)) << joints.names[idx(joint)];
    }
    EXPECT_EQ(ends, leaves.size());
  }
}

void expect_moved_alike(const Joints& joints, const CurveSkeleton& moved,
                        const Eigen::Affine3d& motion) {
  const Joints found = place_joints(moved, {});
  EXPECT_EQ(found.names, joints.names);
  EXPECT_EQ(found.parents, joints.parents);
  EXPECT_EQ(found.joint_of_node, joints.joint_of_node);
  if (found.names != joints.names) return;
  const double tolerance = 1e-9 * bounding_box_diagonal(moved.nodes);
  for (Eigen::Index joint = 0; joint < joints.positions.rows(); ++joint) {
    const Eigen::Vector3d place = joints.positions.row(joint).transpose();
    EXPECT_LE((motion * place - found.positions.row(joint).transpose()).norm(), tolerance);
  }
}

TEST(Joints, MoveWithTheCurve) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -0.5).normalized();
  for (const RigSubject& subject : rig_subjects()) {
    SCOPED_TRACE(subject.name);
    const Joints joints = place_joints(subject.skeleton, {});
    for (const double factor : {1e-4, 1.0, 4096.0}) {
      for (const double angle : {0.0, 1.1}) {
        SCOPED_TRACE(std::to_string(factor) + " times, turned by " + std::to_string(angle));
        Eigen::Affine3d motion = Eigen::Affine3d::Identity();
        motion.translate(Eigen::Vector3d(factor, -3 * factor, 0.5 * factor));
        motion.rotate(Eigen::AngleAxisd(angle, axis));
        motion.scale(factor);
        CurveSkeleton moved = scaled_curve(subject.skeleton, factor);
        for (Eigen::Index node = 0; node < moved.nodes.rows(); ++node) {
          const Eigen::Vector3d place = subject.skeleton.nodes.row(node).transpose();
          moved.nodes.row(node) = (motion * place).transpose();
        }
        expect_moved_alike(joints, moved, motion);
      }
    }
  }
}

TEST(Joints, HangFromTheNodeThatIsWanted) {
  for (const RigSubject& subject : rig_subjects()) {
    SCOPED_TRACE(subject.name);
    const auto nodes = static_cast<int>(subject.skeleton.nodes.rows());
    for (int root = 0; root < nodes; root += std::max(1, nodes / 7)) {
      const Joints joints = place_joints(subject.skeleton, {.root = root});
      EXPECT_EQ(joints.joint_of_node[root], 0) << root;
      EXPECT_EQ(joints.positions.row(0), subject.skeleton.nodes.row(root)) << root;
      EXPECT_EQ(joints.names.front(), "root") << root;
    }
  }
}

/// A trunk of planned bones, each of this length, and a thin, straight spike on its second joint.
Joints with_a_spike(double bone, double spike) {
  CurveSkeleton skeleton;
  skeleton.nodes.resize(5, 3);
  skeleton.nodes << 0, 0, 0, bone, 0, 0, 2 * bone, 0, 0, 3 * bone, 0, 0, bone, spike, 0;
  skeleton.edges.resize(4, 2);
  skeleton.edges << 0, 1, 1, 2, 2, 3, 1, 4;
  skeleton.radii.resize(5);
  skeleton.radii << bone / 4, bone / 4, bone / 4, bone / 4, bone / 100;
  std::vector<PlannedJoint> planned;
  planned.reserve(4);
  for (int k = 0; k < 4; ++k) {
    planned.push_back({"spine." + std::to_string(k), k - 1, k, skeleton.nodes.row(k), "", false});
  }
  return place_planned_joints(skeleton, planned);
}

// A Stegosaurus had four bones in each of its plates.
TEST(PlannedJoints, ASpikeHasBonesAboutAsLongAsThePlans) {
  for (const double bone : {0.1, 1.0, 10.0}) {
    for (const double bones : {0.5, 1.0, 2.0, 3.0}) {
      const Joints joints = with_a_spike(bone, bones * bone);
      EXPECT_LE(joints.positions.rows() - 4, 1 + std::ceil(bones)) << bone << ", " << bones;
    }
  }
}

// A robot's chest went with its right leg.
TEST(PlannedJoints, TheNodeOfAForkIsTheForks) {
  CurveSkeleton skeleton;  // a trunk up along y with two legs down from its lower end
  skeleton.nodes.resize(7, 3);
  skeleton.nodes << 0, 0, 0, 0, 1, 0, 0, 2, 0, -1, -1, 0, -1, -2, 0, 1, -1, 0, 1, -2, 0;
  skeleton.edges.resize(6, 2);
  skeleton.edges << 0, 1, 0, 3, 0, 5, 1, 2, 3, 4, 5, 6;
  skeleton.radii = Eigen::VectorXd::Constant(7, 0.2);
  const auto at = [&](const char* role, int parent, int node) {
    return PlannedJoint{role, parent, node, skeleton.nodes.row(node), "", false};
  };
  const std::vector<PlannedJoint> planned{at("hips", -1, 0),        at("spine", 0, 0),
                                          at("chest", 1, 2),        at("leftUpperLeg", 0, 0),
                                          at("leftLowerLeg", 3, 4), at("rightUpperLeg", 0, 0),
                                          at("rightLowerLeg", 5, 6)};
  const Joints joints = place_planned_joints(skeleton, planned);
  const Eigen::VectorXi expected = (Eigen::VectorXi(7) << 0, 1, 2, 3, 4, 5, 6).finished();
  EXPECT_EQ(joints.joint_of_node, expected);
}

std::string refusal_of(const CurveSkeleton& skeleton, int root, Fault fault = Fault::input) {
  try {
    (void)place_joints(skeleton, {.root = root});
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault);
    return error.what();
  }
  return "";
}

TEST(Joints, NeedANodeForTheirRoot) {
  const CurveSkeleton chain = chain_through({{0, 0, 0}, {9, 0, 0}}, 1, 1);
  EXPECT_EQ(refusal_of(chain, 9), "");
  EXPECT_NE(refusal_of(chain, 10, Fault::usage).find("root 10, needed one of the 10 nodes"),
            std::string::npos);
  EXPECT_NE(refusal_of(chain, -2, Fault::usage).find("root is -2"), std::string::npos);
  EXPECT_NE(refusal_of({}, -1).find("without nodes"), std::string::npos);
}

}  // namespace
}  // namespace curveskel::joints_laws
