#include <curveskel/advanced/joints.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "base/median.hpp"
#include "base/option_ranges.hpp"
#include "rig/joints/limb_bones.hpp"
#include "rig/joints/rooted_tree.hpp"
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {
namespace {

/// A chain of nodes between two that a joint is sure of.
struct Limb {
  std::vector<int> nodes;  ///< upper end first
  std::vector<LimbSample> samples;
  double length = 0;
};

double longest_side(const Positions& nodes) {
  return (nodes.colwise().maxCoeff() - nodes.colwise().minCoeff()).maxCoeff();
}

/// Of the bones between planned joints, the one in the middle; 0 where there are none.
double usual_planned_bone(const std::vector<PlannedJoint>& planned) {
  std::vector<double> lengths;
  for (const PlannedJoint& joint : planned) {
    if (joint.parent < 0) continue;
    lengths.push_back((joint.position - planned[idx(joint.parent)].position).norm());
  }
  return lengths.empty() ? 0 : median_of(std::move(lengths));
}

class JointPlacer {
 public:
  JointPlacer(const CurveSkeleton& skeleton, const std::vector<PlannedJoint>& planned,
              const JointOptions& options, const std::vector<int>& ground,
              const Eigen::Vector3d& up)
      : skeleton_(skeleton),
        planned_(planned),
        options_(options),
        tree_(rooted_tree(skeleton, planned.empty() ? options.root : planned.front().node, ground,
                          up)),
        radii_(usable_radii(skeleton)),
        least_length_(options.least_bone * longest_side(skeleton.nodes)),
        least_radius_(std::max(options.straight_bone * longest_side(skeleton.nodes),
                               usual_planned_bone(planned)) /
                      JointOptions{}.bone_length) {
    joints_.joint_of_node.setConstant(skeleton.nodes.rows(), -1);
    planned_at_.assign(idx(skeleton.nodes.rows()), -1);
    find_reach();
    above_ = tree_.parent;
    for (std::size_t k = 0; k < tree_.roots.size(); ++k)
      above_[idx(tree_.roots[k])] = tree_.above[k];
    begin_limbs_below_forks();
  }

  Joints place() {
    place_planned();
    for (std::size_t component = 0; component < tree_.roots.size(); ++component) {
      part_ = component == 0 ? "" : "part" + std::to_string(component + 1) + "_";
      limbs_ = 0;
      place_component(tree_.roots[component], tree_.above[component]);
    }
    const auto count = static_cast<Eigen::Index>(points_.size());
    joints_.positions.resize(count, 3);
    joints_.parents.resize(count);
    for (Eigen::Index joint = 0; joint < count; ++joint) {
      joints_.positions.row(joint) = points_[idx(joint)];
      joints_.parents[joint] = parents_[idx(joint)];
    }
    return std::move(joints_);
  }

 private:
  int add(const Eigen::RowVector3d& point, int parent, std::string name) {
    points_.push_back(point);
    parents_.push_back(parent);
    joints_.names.push_back(std::move(name));
    return static_cast<int>(points_.size()) - 1;
  }

  /// The node of a fork is the fork's: joints that hang from it with others and are as near to no
  /// other node begin with the next one on their limb.
  void begin_limbs_below_forks() {
    std::vector<int> hanging(planned_.size(), 0);
    for (const PlannedJoint& joint : planned_) {
      if (joint.parent >= 0) ++hanging[idx(joint.parent)];
    }
    for (std::size_t k = 0; k < planned_.size(); ++k) {
      PlannedJoint& joint = planned_[k];
      const bool shares_fork = joint.parent >= 0 && hanging[idx(joint.parent)] > 1 &&
                               joint.node >= 0 && planned_[idx(joint.parent)].node == joint.node;
      if (!shares_fork) continue;
      const auto below = std::find_if(planned_.begin(), planned_.end(), [&](const auto& other) {
        return other.parent == static_cast<int>(k) && other.node >= 0;
      });
      if (below == planned_.end()) continue;
      int node = below->node;
      while (node >= 0 && above_[idx(node)] != joint.node) node = above_[idx(node)];
      if (node >= 0) joint.node = node;
    }
  }

  /// Each node up to the next planned joint belongs to the last one before it on the way from the
  /// root.
  void place_planned() {
    for (const PlannedJoint& joint : planned_) add(joint.position, joint.parent, joint.role);
    for (std::size_t k = 0; k < planned_.size(); ++k) {
      const PlannedJoint& joint = planned_[k];
      if (joint.node < 0) continue;
      int node = above_[idx(joint.node)];
      for (; node >= 0 && joints_.joint_of_node[node] < 0; node = above_[idx(node)]) {
        joints_.joint_of_node[node] = joint.parent;
      }
      joints_.joint_of_node[joint.node] = planned_at_[idx(joint.node)] = static_cast<int>(k);
    }
    for (std::size_t k = 0; k < planned_.size(); ++k) {
      const bool has_neck = planned_[k].parent >= 0 && planned_[k].node >= 0;
      if (planned_[k].role == "head" && has_neck) begin_head(static_cast<int>(k));
    }
  }

  /// Ears, horns and jaws that leave the last bone of the neck are the head's, with the curve from
  /// the first of them on.
  void begin_head(int head) {
    const int neck = planned_[idx(head)].parent;
    const int last = above_[idx(planned_[idx(head)].node)];
    int first = -1;
    for (int node = last; node >= 0 && joints_.joint_of_node[node] == neck;
         node = above_[idx(node)]) {
      for (const int child : tree_.children[idx(node)]) {
        if (joints_.joint_of_node[child] < 0 && !is_stub(node, child)) first = node;
      }
    }
    if (first < 0) return;
    for (int node = last; node != first; node = above_[idx(node)]) {
      joints_.joint_of_node[node] = head;
    }
    joints_.joint_of_node[first] = head;
  }

  /// The node and all below it, parents before their children.
  [[nodiscard]] std::vector<int> subtree(int node) const {
    std::vector<int> nodes{node};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::vector<int>& children = tree_.children[idx(nodes[k])];
      nodes.insert(nodes.end(), children.begin(), children.end());
    }
    return nodes;
  }

  void find_reach() {
    reach_.assign(tree_.children.size(), 0);
    for (const int root : tree_.roots) {
      const std::vector<int> nodes = subtree(root);
      for (std::size_t k = nodes.size(); k-- > 0;) {
        for (const int child : tree_.children[idx(nodes[k])]) {
          reach_[idx(nodes[k])] = std::max(reach_[idx(nodes[k])], way_by(nodes[k], child));
        }
      }
    }
  }

  /// The longest way down from a node by this child.
  [[nodiscard]] double way_by(int node, int child) const {
    return (point(child) - point(node)).norm() + reach_[idx(child)];
  }

  /// Too short for a bone, with all that hangs from it, and without a planned joint.
  [[nodiscard]] bool is_stub(int node, int child) const {
    if (way_by(node, child) >= least_length_) return false;
    const std::vector<int> nodes = subtree(child);
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](int at) { return joints_.joint_of_node[at] < 0; });
  }

  /// The child in which the limb goes on: the only one that is no stub, or else the longest; -1
  /// where the limb ends or divides.
  [[nodiscard]] int child_beyond(int node) const {
    int beyond = -1;
    int longest = -1;
    for (const int child : tree_.children[idx(node)]) {
      if (longest < 0 || way_by(node, child) > way_by(node, longest)) longest = child;
      if (is_stub(node, child)) continue;
      if (beyond >= 0) return -1;
      beyond = child;
    }
    return beyond >= 0 ? beyond : longest;
  }

  /// A stub beside a limb moves with what it hangs from.
  void give_stubs(const Limb& limb) {
    for (std::size_t k = 1; k + 1 < limb.nodes.size(); ++k) {
      const int joint = joints_.joint_of_node[limb.nodes[k]];
      for (const int child : tree_.children[idx(limb.nodes[k])]) {
        if (child == limb.nodes[k + 1]) continue;
        for (const int node : subtree(child)) joints_.joint_of_node[node] = joint;
      }
    }
  }

  void place_component(int root, int above) {
    if (joints_.joint_of_node[root] < 0) joints_.joint_of_node[root] = joint_of_root(root, above);
    std::vector<int> open{root};  // upper ends of limbs yet to be placed
    while (!open.empty()) {
      const int upper = open.back();
      open.pop_back();
      for (const int child : tree_.children[idx(upper)]) {
        if (joints_.joint_of_node[child] >= 0) {  // planned
          open.push_back(child);
          continue;
        }
        const Limb limb = limb_from(upper, child);
        const int lower = place_limb(limb);
        give_stubs(limb);
        if (!tree_.children[idx(lower)].empty()) open.push_back(lower);
      }
    }
  }

  /// A component that begins at the last planned joint of a limb, as a doll's fingertip at its ball
  /// hinge, is what that joint moves.
  int joint_of_root(int root, int above) {
    const Eigen::RowVector3d place = skeleton_.nodes.row(root);
    const int parent = above < 0 ? -1 : joints_.joint_of_node[above];
    const bool is_planned = parent >= 0 && parent < static_cast<int>(planned_.size());
    if (is_planned && std::find(parents_.begin(), parents_.end(), parent) == parents_.end() &&
        (place - points_[idx(parent)]).norm() < least_length_) {
      planned_at_[idx(root)] = parent;
      return parent;
    }
    return add(place, parent, part_ + "root");
  }

  [[nodiscard]] Limb limb_from(int upper, int child) const {
    Limb limb;
    limb.nodes = {upper, child};
    for (int next = child_beyond(child); next >= 0; next = child_beyond(next)) {
      limb.nodes.push_back(next);
    }
    for (std::size_t k = 1; k < limb.nodes.size(); ++k) {
      limb.length += (point(limb.nodes[k]) - point(limb.nodes[k - 1])).norm();
    }
    sample(limb, limb.length);
    return limb;
  }

  [[nodiscard]] Eigen::Vector3d point(int node) const {
    return skeleton_.nodes.row(node).transpose();
  }

  /// Places for joints: no nearer to each other than pays, for any density of nodes.
  void sample(Limb& limb, double length) const {
    constexpr double step_radii = 0.25;
    constexpr double most_samples = 400;
    limb.samples.push_back({point(limb.nodes[0]), radii_[limb.nodes[0]], 0, 0, true});
    double way = 0;
    double since = 0;  // the last sample
    for (std::size_t k = 1; k < limb.nodes.size(); ++k) {
      const Eigen::Vector3d from = point(limb.nodes[k - 1]);
      const Eigen::Vector3d step = point(limb.nodes[k]) - from;
      const double from_radius = radii_[limb.nodes[k - 1]];
      const double to_radius = radii_[limb.nodes[k]];
      const double mean = 0.5 * (from_radius + to_radius);
      const double finest = std::max(step_radii * mean, length / most_samples);
      const int pieces = std::max(1, static_cast<int>(std::ceil(step.norm() / finest)));
      for (int piece = 1; piece <= pieces; ++piece) {
        const double share = static_cast<double>(piece) / pieces;
        const double radius = from_radius + share * (to_radius - from_radius);
        way += step.norm() / pieces / std::max(radius, least_radius_);
        since += step.norm() / pieces;
        const bool is_last = piece == pieces && k + 1 == limb.nodes.size();
        if (since < 0.5 * finest && !is_last) continue;
        since = 0;
        const bool is_at_node = piece == pieces;
        limb.samples.push_back(
            {from + share * step, radius, way, is_at_node ? k : k - 1, is_at_node});
      }
    }
  }

  /// The sample where the limb leaves the ball of a junction above, if enough lies beyond; else 0.
  [[nodiscard]] std::size_t beginning(const Limb& limb) const {
    constexpr double least_way = 0.5;  // radii
    const int upper = limb.nodes.front();
    const int lower = limb.nodes.back();
    if (tree_.children[idx(upper)].size() < 2) return 0;
    const auto within = [this](const LimbSample& sample, int node) {
      return (sample.point - point(node)).norm() < radii_[node];
    };
    std::size_t first = 0;
    while (first + 1 < limb.samples.size() && within(limb.samples[first], upper)) ++first;
    const bool reaches_junction = !tree_.children[idx(lower)].empty();
    const bool too_short = limb.samples.back().way - limb.samples[first].way < least_way ||
                           (reaches_junction && within(limb.samples[first], lower));
    return too_short ? 0 : first;
  }

  /// The sample where the limb enters a ball at its tip much larger than the limb before, as a head
  /// is than its neck; else the last sample.
  [[nodiscard]] std::size_t ending(const Limb& limb, std::size_t first) const {
    constexpr double much_larger = 1.5;
    const std::size_t last = limb.samples.size() - 1;
    const int lower = limb.nodes.back();
    if (!tree_.children[idx(lower)].empty()) return last;
    std::size_t entry = last;
    while (entry > first && (limb.samples[entry].point - point(lower)).norm() < radii_[lower]) {
      --entry;
    }
    double thinnest = radii_[lower];
    for (std::size_t k = first; k <= entry; ++k) {
      thinnest = std::min(thinnest, limb.samples[k].radius);
    }
    return entry > first && radii_[lower] > much_larger * thinnest ? entry : last;
  }

  /// Samples where joints are, below the upper one.
  [[nodiscard]] std::vector<std::size_t> places_on(const Limb& limb) const {
    const std::size_t first = beginning(limb);
    const std::size_t last = ending(limb, first);
    std::vector<std::size_t> places =
        best_joints(limb.samples, first, last,
                    {options_.bone_length, options_.bend, least_radius_, least_length_});
    if (last + 1 < limb.samples.size()) places.push_back(limb.samples.size() - 1);
    if (first == 0) places.erase(places.begin());  // the upper joint is there
    return places;
  }

  /// The planned joint from whose node the limb begins, or null.
  [[nodiscard]] const PlannedJoint* planned_above(const Limb& limb) const {
    const int joint = planned_at_[idx(limb.nodes.front())];
    return joint < 0 ? nullptr : &planned_[idx(joint)];
  }

  /// The end of the last planned bone of its limb, which shows how long the bone is.
  [[nodiscard]] bool ends_planned(const Limb& limb) const {
    const auto joint = idx(joints_.joint_of_node[limb.nodes.front()]);
    return planned_above(limb) != nullptr && tree_.children[idx(limb.nodes.front())].size() == 1 &&
           tree_.children[idx(limb.nodes.back())].empty() &&
           std::none_of(planned_.begin(), planned_.end(), [&](const PlannedJoint& other) {
             return other.parent == static_cast<int>(joint);
           });
  }

  /// Returns the limb's lower end.
  int place_limb(const Limb& limb) {
    if (limb.length < least_length_ && !ends_planned(limb)) {
      const int joint = joints_.joint_of_node[limb.nodes.front()];
      for (const int node : limb.nodes) joints_.joint_of_node[node] = joint;
      return limb.nodes.back();
    }
    const std::string name = part_ + "limb" + std::to_string(++limbs_);
    const int upper = joints_.joint_of_node[limb.nodes.front()];
    const int lower = limb.nodes.back();
    const PlannedJoint* const above = planned_above(limb);
    const bool is_one_bone =
        above != nullptr && above->is_last && tree_.children[idx(lower)].empty();
    const std::vector<std::size_t> places =
        is_one_bone ? std::vector{limb.samples.size() - 1} : places_on(limb);
    int joint = upper;
    std::size_t node = 1;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const LimbSample& place = limb.samples[places[k]];
      for (; node < limb.nodes.size() - 1 && node <= place.at; ++node) {
        joints_.joint_of_node[limb.nodes[node]] = joint;
      }
      const bool is_tip = k + 1 == places.size() && tree_.children[idx(lower)].empty();
      const int next =
          add(place.point, joint, name + (is_tip ? "_end" : "_" + std::to_string(k + 1)));
      if (k + 1 == places.size()) joints_.joint_of_node[lower] = is_tip ? joint : next;
      joint = next;
    }
    return lower;
  }

  const CurveSkeleton& skeleton_;
  std::vector<PlannedJoint> planned_;
  const JointOptions& options_;
  const RootedTree tree_;
  std::vector<int> above_;       // by node: towards the root, across components
  std::vector<double> reach_;    // by node: of the longest way down from it
  std::vector<int> planned_at_;  // by node: the planned joint that lies there, -1 = none
  const Eigen::VectorXd radii_;
  const double least_length_;  // of a bone
  const double least_radius_;  // in which a way is measured
  std::string part_;
  int limbs_ = 0;
  std::vector<Eigen::RowVector3d> points_;
  std::vector<int> parents_;
  Joints joints_;
};

void require_sound_plan(const std::vector<PlannedJoint>& planned, Eigen::Index nodes) {
  for (std::size_t k = 0; k < planned.size(); ++k) {
    const PlannedJoint& joint = planned[k];
    const bool is_sound = joint.node >= -1 && joint.node < nodes && joint.parent >= -1 &&
                          joint.parent < static_cast<int>(k) && joint.position.allFinite();
    if (is_sound) continue;
    throw Error(Fault::input, "place_joints: the planned joint " + std::to_string(k) +
                                  " has the node " + std::to_string(joint.node) +
                                  " and the parent " + std::to_string(joint.parent) +
                                  ", needed one of " + std::to_string(nodes) +
                                  " nodes or -1, a joint before it or -1, and a finite place");
  }
}

}  // namespace

void require_valid(const JointOptions& options) {
  constexpr OptionRange node{-1};
  constexpr OptionRange radii{0.01, 1e6};
  constexpr OptionRange shares{0, 1};
  const OptionCheck check("JointOptions");
  check.number("root", options.root, node);
  check.number("bone_length", options.bone_length, radii);
  check.number("bend", options.bend, radii);
  check.number("straight_bone", options.straight_bone, shares);
  check.number("least_bone", options.least_bone, shares);
}

Joints place_joints(const CurveSkeleton& skeleton, const JointOptions& options) {
  return place_planned_joints(skeleton, {}, options);
}

Joints place_planned_joints(const CurveSkeleton& skeleton, const std::vector<PlannedJoint>& planned,
                            const JointOptions& options, const std::vector<int>& ground,
                            const Eigen::Vector3d& up) {
  require_valid(options);
  require_sound(skeleton, "place_joints");
  require_sound_plan(planned, skeleton.nodes.rows());
  const Eigen::Index nodes = skeleton.nodes.rows();
  if (nodes == 0) {
    throw Error(Fault::input, "a skeleton without nodes, needed one at least; extract it again");
  }
  if (options.root >= nodes) {
    throw Error(Fault::usage, "root " + std::to_string(options.root) + ", needed one of the " +
                                  std::to_string(nodes) + " nodes, counted from 0; or -1 to have " +
                                  "it chosen");
  }
  return JointPlacer(skeleton, planned, options, ground, up).place();
}

}  // namespace curveskel
