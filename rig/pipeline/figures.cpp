#include "rig/pipeline/figures.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/rig_character.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/rig_polygons.hpp>
#include <curveskel/topology.hpp>
#include "rig/pipeline/divided_body.hpp"
#include "rig/plan/looks.hpp"
#include "skeleton/certify/tube_share.hpp"
#include "surface/mesh/component_areas.hpp"
#include "surface/mesh/meeting_boxes.hpp"

namespace curveskel {
namespace {

using Boxes = std::vector<Eigen::AlignedBox3d>;

Boxes boxes_of(const Surface& surface, const Eigen::VectorXi& group, int count) {
  Boxes boxes(idx(count));
  for (Eigen::Index v = 0; v < group.size(); ++v) {
    boxes[idx(group[v])].extend(surface.positions.row(v).transpose());
  }
  return boxes;
}

/// Of each component the number of those whose boxes meet, directly or by way of others; `alone`
/// (-1: none) meets no other.
std::vector<int> groups_that_meet(const Boxes& boxes, int alone) {
  UnionFind joined(static_cast<std::int64_t>(boxes.size()));
  for_meeting_boxes(boxes, [&](int a, int b) {
    if (a != alone && b != alone) joined.unite(a, b);
  });
  return joined.numbers();
}

/// How many tips the curves of each group have.
std::vector<int> tips_of(const CurveSkeleton& skeleton, const Eigen::VectorXi& group_of_vertex,
                         int groups) {
  UnionFind joined(skeleton.nodes.rows());
  std::vector<int> degree(idx(skeleton.nodes.rows()), 0);
  for (const auto& edge : skeleton.edges.rowwise()) {
    joined.unite(edge[0], edge[1]);
    ++degree[idx(edge[0])];
    ++degree[idx(edge[1])];
  }
  std::vector<int> group_of_curve(degree.size(), -1);  // by root
  for (Eigen::Index v = 0; v < group_of_vertex.size(); ++v) {
    const int node = skeleton.node_of_vertex[v];
    if (node >= 0) group_of_curve[idx(joined.root(node))] = group_of_vertex[v];
  }
  std::vector<int> tips(idx(groups), 0);
  for (int node = 0; node < static_cast<int>(degree.size()); ++node) {
    const int group = group_of_curve[idx(joined.root(node))];
    if (degree[idx(node)] == 1 && group >= 0) ++tips[idx(group)];
  }
  return tips;
}

bool is_planned(const BodyPlan& plan) { return !plan.joints.empty(); }

/// The groups of a scene's components, one of which may be a figure.
class Groups {
 public:
  Groups(const RepairedSurface& body, const CurveSkeleton& skeleton, const Topology& counted,
         const FigureOptions& options, const std::stop_token& stop)
      : body_(body),
        skeleton_(skeleton),
        counted_(counted),
        options_(options),
        stop_(stop),
        divided_(body, skeleton, counted) {}

  /// Of components whose boxes meet. `ground` (-1: none) is one that groups with no other.
  [[nodiscard]] std::vector<Figure> figures(int ground) {
    return figures_among(
        groups_that_meet(
            boxes_of(body_.surface, counted_.component_of_vertex, counted_.components()), ground),
        ground);
  }

  /// All that stands on the ground as one, as a doll of parts with gaps between them.
  [[nodiscard]] std::vector<Figure> figure_on(int ground) {
    std::vector<int> group(idx(counted_.components()), 0);
    group[idx(ground)] = 1;
    return figures_among(group, ground);
  }

 private:
  /// Those that are each built to a plan, the largest first; all else goes with the one whose box
  /// is nearest.
  [[nodiscard]] std::vector<Figure> figures_among(const std::vector<int>& group, int ground) {
    const int groups = 1 + *std::max_element(group.begin(), group.end());
    if (groups < 2) return {};
    Eigen::VectorXi group_of_vertex = counted_.component_of_vertex;
    for (int& number : group_of_vertex) number = group[idx(number)];
    const Boxes boxes = boxes_of(body_.surface, group_of_vertex, groups);
    constexpr int least_tips = 4;  // two pairs of limbs: no plan has fewer
    const std::vector<int> tips = tips_of(skeleton_, group_of_vertex, groups);
    const std::vector<int> not_of_sheets =
        tips_of(skeleton_, without_sheets(group_of_vertex), groups);
    const bool is_bounded = options_.plan.plan == BodyKind::automatic;
    std::vector<std::pair<int, BodyPlan>> planned;
    for (int wanted = 0; wanted < groups; ++wanted) {
      if (tips[idx(wanted)] < least_tips) continue;
      if (is_bounded && not_of_sheets[idx(wanted)] > most_ends) continue;
      BodyPlan plan = plan_of(group, wanted);
      if (!is_planned(plan) || !stands_on(plan, group, wanted, ground)) continue;
      planned.emplace_back(wanted, std::move(plan));
    }
    if (planned.empty()) return {};
    std::stable_sort(planned.begin(), planned.end(), [&](const auto& a, const auto& b) {
      return boxes[idx(a.first)].diagonal().norm() > boxes[idx(b.first)].diagonal().norm();
    });
    std::vector<int> numbers;
    numbers.reserve(planned.size());
    for (const auto& [wanted, plan] : planned) numbers.push_back(wanted);
    const std::vector<int> joined = joined_to_nearest(group, boxes, numbers);
    std::vector<Figure> found;
    found.reserve(planned.size());
    for (auto& [wanted, plan] : planned) {
      std::vector<int> near = joined;  // fingers may stand clear of a hand; but no house is a part
      for (std::size_t k = 0; k < near.size(); ++k) {
        const double size = boxes[idx(group[k])].diagonal().norm();
        if (size > boxes[idx(wanted)].diagonal().norm()) near[k] = group[k];
      }
      BodyPlan with_near = near == group ? BodyPlan{} : plan_of(near, wanted);
      const bool is_piece = near != group && with_near.plan != plan.plan;  // of one, seen awry
      const bool is_found = options_.plan.plan == BodyKind::automatic;
      if (is_found && is_piece && planned.size() == 1) return {};
      const bool is_better =
          with_near.plan == plan.plan && with_near.joints.size() > plan.joints.size();
      found.push_back(is_better ? with_all_that_joins(near, joined, wanted, std::move(with_near))
                                : with_all_that_joins(group, joined, wanted, std::move(plan)));
    }
    return found;
  }

  /// No group (-1) for vertices of components that were made of sheets.
  [[nodiscard]] Eigen::VectorXi without_sheets(Eigen::VectorXi group_of_vertex) const {
    std::vector<char> is_sheet(idx(counted_.components()), 0);
    for (const std::int32_t v : body_.sheets) is_sheet[idx(counted_.component_of_vertex[v])] = 1;
    for (Eigen::Index v = 0; v < group_of_vertex.size(); ++v) {
      if (is_sheet[idx(counted_.component_of_vertex[v])] != 0) group_of_vertex[v] = -1;
    }
    return group_of_vertex;
  }

  [[nodiscard]] static std::vector<int> members_of(const std::vector<int>& group, int wanted) {
    std::vector<int> members;
    for (std::size_t k = 0; k < group.size(); ++k) {
      if (group[k] == wanted) members.push_back(static_cast<int>(k));
    }
    return members;
  }

  /// The ground ends below the group's middle; without one, any group does.
  [[nodiscard]] bool stands_on(const BodyPlan& plan, const std::vector<int>& group, int wanted,
                               int ground) const {
    if (ground < 0) return true;
    const auto heights = [&](const std::vector<int>& components) {
      Eigen::AlignedBox1d range;
      for (const int v : divided_.vertices(components)) {
        const double height = body_.surface.positions.row(v).dot(plan.axes.row(1));
        range.extend(Eigen::Matrix<double, 1, 1>(height));
      }
      return range;
    };
    return heights({ground}).max()[0] < heights(members_of(group, wanted)).center()[0];
  }

  [[nodiscard]] BodyPlan plan_of(const std::vector<int>& group, int wanted) {
    std::vector<int> members = members_of(group, wanted);
    const auto known = plans_.find(members);
    if (known != plans_.end()) return known->second;
    return plans_[members] = plan_alone(members);
  }

  /// As if there were nothing else. A scene that is not made of tubes may have a figure that is.
  [[nodiscard]] BodyPlan plan_alone(const std::vector<int>& components) {
    throw_if_stopped(stop_);
    const auto [body, skeleton, inputs] = divided_.part(components);
    PlanOptions options = options_.plan;
    if (!options.made_of_tubes) {
      const double share = tube_share(body.surface, skeleton, {.threads = options_.threads});
      options.made_of_tubes = made_of_tubes_but_for_sheets(share, body);
    }
    return plan_of_figure(body, skeleton, options);
  }

  /// Of each group the number of the figure whose box is nearest.
  [[nodiscard]] static std::vector<int> joined_to_nearest(const std::vector<int>& group,
                                                          const Boxes& boxes,
                                                          const std::vector<int>& figures) {
    std::vector<int> nearest(boxes.size());
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      nearest[k] = *std::min_element(figures.begin(), figures.end(), [&](int a, int b) {
        return boxes[k].squaredExteriorDistance(boxes[idx(a)]) <
               boxes[k].squaredExteriorDistance(boxes[idx(b)]);
      });
    }
    for (const int figure : figures) nearest[idx(figure)] = figure;
    std::vector<int> joined;
    joined.reserve(group.size());
    for (const int own : group) joined.push_back(nearest[idx(own)]);
    return joined;
  }

  /// The plan is by the nodes of the group alone.
  [[nodiscard]] Figure with_all_that_joins(const std::vector<int>& group,
                                           const std::vector<int>& joined, int wanted,
                                           BodyPlan plan) {
    const std::vector<int> components = members_of(joined, wanted);
    const std::vector<int> alone = divided_.nodes(members_of(group, wanted));
    const std::vector<int> all = divided_.nodes(components);
    for (PlannedJoint& joint : plan.joints) {
      if (joint.node < 0) continue;
      const auto found = std::lower_bound(all.begin(), all.end(), alone[idx(joint.node)]);
      joint.node = static_cast<int>(found - all.begin());
    }
    PartOfBody part = divided_.part_of_file(components);
    return {std::move(part.body), std::move(part.skeleton), std::move(plan),
            std::move(part.inputs)};
  }

  const RepairedSurface& body_;
  const CurveSkeleton& skeleton_;
  const Topology& counted_;
  const FigureOptions& options_;
  const std::stop_token& stop_;
  DividedBody divided_;
  std::map<std::vector<int>, BodyPlan> plans_;  // by components: a group may be asked for again
};

/// True if the plan has joints on each of them: pieces of one body, as a doll's upper and lower
/// half.
bool is_on_each(const BodyPlan& plan, const CurveSkeleton& skeleton,
                const std::vector<Figure>& figures) {
  return std::all_of(figures.begin(), figures.end(), [&](const Figure& figure) {
    return std::any_of(plan.joints.begin(), plan.joints.end(), [&](const PlannedJoint& joint) {
      if (joint.node < 0) return false;
      const Eigen::RowVector3d place = skeleton.nodes.row(joint.node);
      return (figure.skeleton.nodes.rowwise() - place).rowwise().squaredNorm().minCoeff() == 0;
    });
  });
}

/// True for a plan that nobody would see without asking, or one of a piece: its joints lie within
/// less than half of the body's diagonal.
bool is_doubtful(const BodyPlan& plan, const Surface& body) {
  Eigen::AlignedBox3d joints;
  Eigen::AlignedBox3d all;
  for (const PlannedJoint& joint : plan.joints) joints.extend(joint.position.transpose());
  for (const auto& place : body.positions.rowwise()) all.extend(place.transpose());
  const bool is_piece = is_planned(plan) && 2 * joints.diagonal().norm() < all.diagonal().norm();
  return !is_planned(plan) || plan.is_forced || is_piece;
}

std::vector<Figure> seen_figures(const RepairedSurface& body, const CurveSkeleton& skeleton,
                                 const FigureOptions& options, const std::stop_token& stop) {
  std::vector<Figure> whole;
  whole.push_back({body, skeleton, plan_of_figure(body, skeleton, options.plan)});
  const BodyKind wanted = options.plan.plan;
  const bool says_of = skeleton.node_of_vertex.size() == body.surface.positions.rows();
  if (!says_of || wanted == BodyKind::none || wanted == BodyKind::other) return whole;
  const Topology counted = topology(body.surface);
  if (counted.components() < 2) return whole;
  Groups groups(body, skeleton, counted, options, stop);
  constexpr int no_ground = -1;
  std::vector<Figure> figures = groups.figures(no_ground);
  const std::size_t planned = whole.front().plan.joints.size();
  if (figures.size() > 1) {
    const BodyPlan& plan = whole.front().plan;
    return planned > 0 && is_on_each(plan, skeleton, figures) ? whole : figures;
  }
  if (figures.size() == 1 && figures.front().plan.joints.size() >= planned) return figures;
  if (planned > 0) return whole;
  const std::vector<double> areas = component_areas(body.surface, counted);
  const auto largest = std::max_element(areas.begin(), areas.end());
  const int ground = static_cast<int>(largest - areas.begin());
  figures = groups.figures(ground);
  if (figures.empty()) figures = groups.figure_on(ground);
  return figures.empty() ? whole : figures;
}

}  // namespace

std::vector<Figure> find_figures(const RepairedSurface& body, const CurveSkeleton& skeleton,
                                 const FigureOptions& options, const std::stop_token& stop) {
  FigureOptions seen = options;
  seen.plan.by_proportion = false;
  std::vector<Figure> figures = seen_figures(body, skeleton, seen, stop);
  const bool may_be = options.plan.plan == BodyKind::humanoid && options.plan.by_proportion;
  if (!may_be || std::any_of(figures.begin(), figures.end(), [&](const Figure& figure) {
        return !is_doubtful(figure.plan, body.surface);
      })) {
    return figures;
  }
  // Of all that there is together, as no plate of an armour is a human.
  BodyPlan standing = find_plan(body.surface, skeleton, options.plan);
  if (!standing.by_proportion) {
    if (figures.size() == 1 && !is_planned(figures.front().plan)) {
      figures.front().plan.reason = standing.reason;
    }
    return figures;
  }
  figures.clear();
  figures.push_back({body, skeleton, std::move(standing)});
  return figures;
}

}  // namespace curveskel
