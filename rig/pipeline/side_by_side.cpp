#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/rig_character.hpp>
#include "rig/joints/figure_name.hpp"
#include "rig/joints/limb_name.hpp"
#include "rig/pipeline/figures.hpp"

namespace curveskel {
namespace {

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
