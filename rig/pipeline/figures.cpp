#include "rig/pipeline/figures.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/rig_character.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/topology.hpp>
#include "rig/joints/figure_name.hpp"
#include "rig/joints/limb_name.hpp"

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

/// Of each component the number of those whose boxes meet, directly or by way of others.
std::vector<int> groups_that_meet(const Boxes& boxes) {
  UnionFind joined(static_cast<std::int64_t>(boxes.size()));
  for (int a = 0; a < static_cast<int>(boxes.size()); ++a) {
    for (int b = 0; b < a; ++b) {
      if (boxes[idx(a)].intersects(boxes[idx(b)])) joined.unite(a, b);
    }
  }
  return joined.numbers();
}

/// The components of one group, with their curves.
Figure part_of_scene(const RepairedSurface& body, const CurveSkeleton& skeleton,
                     const Eigen::VectorXi& component_of_vertex, const std::vector<int>& group,
                     int wanted) {
  RigParts parts;
  parts.part_of_vertex = component_of_vertex;
  for (const int own : group) parts.parts.push_back({.follows = own != wanted});
  return {body_of(body, parts), skeleton_of_body(skeleton, parts), {}};
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

/// The groups that are no figures go with the nearest one.
void join_to_nearest(std::vector<int>& group, const Boxes& boxes, const std::vector<int>& figures) {
  std::vector<int> nearest(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    nearest[k] = *std::min_element(figures.begin(), figures.end(), [&](int a, int b) {
      return boxes[k].squaredExteriorDistance(boxes[idx(a)]) <
             boxes[k].squaredExteriorDistance(boxes[idx(b)]);
    });
  }
  for (const int figure : figures) nearest[idx(figure)] = figure;
  for (int& own : group) own = nearest[idx(own)];
}

template <typename Rows>
void append_rows(Rows& rows, const Rows& more) {
  const Eigen::Index before = rows.rows();
  rows.conservativeResize(before + more.rows(), more.cols());
  rows.bottomRows(more.rows()) = more;
}

/// `shift` is added to what is not negative.
template <typename Numbers>
Numbers shifted(Numbers numbers, Eigen::Index shift) {
  for (auto& number : numbers.reshaped()) number += number < 0 ? 0 : static_cast<int>(shift);
  return numbers;
}

void append(RiggedBody& all, const RiggedBody& more) {
  const Eigen::Index vertices = all.body.surface.positions.rows();
  const Eigen::Index nodes = all.skeleton.nodes.rows();
  const Eigen::VectorXi own = shifted(more.body.vertex_of_input, vertices);
  for (Eigen::Index v = 0; v < own.size(); ++v) {
    if (own[v] >= 0) all.body.vertex_of_input[v] = own[v];
  }
  append_rows(all.body.surface.positions, more.body.surface.positions);
  append_rows(all.body.surface.triangles, shifted(more.body.surface.triangles, vertices));
  append_rows(all.skeleton.nodes, more.skeleton.nodes);
  append_rows(all.skeleton.edges, shifted(more.skeleton.edges, nodes));
  append_rows(all.skeleton.radii, more.skeleton.radii);
  append_rows(all.skeleton.node_of_vertex, shifted(more.skeleton.node_of_vertex, nodes));
}

void append(Rig& all, const Rig& more) {
  const Eigen::Index joints = all.joints.rows();
  const Eigen::Index vertices = all.weights.rows();
  SkinWeights weights(vertices + more.weights.rows(), joints + more.weights.cols());
  weights.reserve(all.weights.nonZeros() + more.weights.nonZeros());
  const auto insert = [&](const SkinWeights& from, Eigen::Index row, Eigen::Index column) {
    for (Eigen::Index v = 0; v < from.rows(); ++v) {
      for (SkinWeights::InnerIterator it(from, v); it; ++it) {
        weights.insert(row + v, column + it.col()) = it.value();
      }
    }
  };
  insert(all.weights, 0, 0);
  insert(more.weights, vertices, joints);
  weights.makeCompressed();
  all.weights.swap(weights);
  append_rows(all.joints, more.joints);
  append_rows(all.parents, shifted(more.parents, joints));
  if (!all.readable.empty() || !more.readable.empty()) {
    const std::vector<std::string>& added = readable_names(more);
    all.readable = readable_names(all);
    all.readable.insert(all.readable.end(), added.begin(), added.end());
  }
  all.names.insert(all.names.end(), more.names.begin(), more.names.end());
  all.roles.insert(all.roles.end(), more.roles.begin(), more.roles.end());
}

}  // namespace

std::vector<Figure> find_figures(const RepairedSurface& body, const CurveSkeleton& skeleton,
                                 const PlanOptions& options) {
  if (skeleton.node_of_vertex.size() != body.surface.positions.rows()) return {};
  const Topology counted = topology(body.surface);
  if (counted.components() < 2 || options.plan != BodyKind::automatic) return {};
  std::vector<int> group =
      groups_that_meet(boxes_of(body.surface, counted.component_of_vertex, counted.components()));
  const int groups = 1 + *std::max_element(group.begin(), group.end());
  if (groups < 2) return {};
  Eigen::VectorXi group_of_vertex = counted.component_of_vertex;
  for (int& number : group_of_vertex) number = group[idx(number)];
  const Boxes boxes = boxes_of(body.surface, group_of_vertex, groups);

  const auto alone = [&](int wanted) {
    Figure figure = part_of_scene(body, skeleton, counted.component_of_vertex, group, wanted);
    figure.plan = plan_with_sheets(figure.body, figure.skeleton, options);
    return figure;
  };
  constexpr int least_tips = 4;  // two pairs of limbs: no plan has fewer
  const std::vector<int> tips = tips_of(skeleton, group_of_vertex, groups);
  std::vector<int> planned;
  for (int wanted = 0; wanted < groups; ++wanted) {
    if (tips[idx(wanted)] >= least_tips && is_planned(alone(wanted).plan))
      planned.push_back(wanted);
  }
  if (planned.size() < 2) return {};
  join_to_nearest(group, boxes, planned);
  std::stable_sort(planned.begin(), planned.end(), [&](int a, int b) {
    return boxes[idx(a)].diagonal().norm() > boxes[idx(b)].diagonal().norm();
  });
  std::vector<Figure> figures;
  figures.reserve(planned.size());
  for (const int wanted : planned) figures.push_back(alone(wanted));
  return figures;
}

RiggedBody side_by_side(std::vector<RiggedBody> figures) {
  RiggedBody all = std::move(figures.front());
  all.rig.roles.resize(all.rig.names.size());
  for (std::size_t k = 1; k < figures.size(); ++k) {
    Rig& rig = figures[k].rig;
    rig.roles.resize(rig.names.size());
    for (auto* const names : {&rig.names, &rig.readable, &rig.roles}) {
      for (std::string& name : *names) {
        if (!name.empty()) name.insert(0, figure_prefix(k));
      }
    }
    append(all, figures[k]);
    append(all.rig, figures[k].rig);
  }
  return all;
}

}  // namespace curveskel
