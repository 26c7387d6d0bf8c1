#include <algorithm>
#include <string>
#include <type_traits>
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

void append(std::vector<std::string>& names, const std::vector<std::string>& more) {
  names.insert(names.end(), more.begin(), more.end());
}

/// `shift` is added to what is not negative.
template <typename Numbers>
void shift_all(Numbers& numbers, Eigen::Index shift) {
  for (auto& number : numbers.reshaped()) number += number < 0 ? 0 : static_cast<int>(shift);
}

/// Each figure's numbers as they are behind those of the figures before it.
void number_through(std::vector<RiggedBody>& figures) {
  Eigen::Index vertices = 0;
  Eigen::Index nodes = 0;
  Eigen::Index joints = 0;
  for (RiggedBody& figure : figures) {
    shift_all(figure.body.vertex_of_input, vertices);
    shift_all(figure.body.surface.triangles, vertices);
    shift_all(figure.skeleton.edges, nodes);
    shift_all(figure.skeleton.node_of_vertex, nodes);
    shift_all(figure.rig.parents, joints);
    vertices += figure.body.surface.positions.rows();
    nodes += figure.skeleton.nodes.rows();
    joints += figure.rig.joints.rows();
  }
}

/// The same rows of each figure, one below the other.
template <typename Of>
auto stacked(const std::vector<RiggedBody>& figures, const Of& of) {
  std::decay_t<decltype(of(figures.front()))> all;
  Eigen::Index count = 0;
  for (const RiggedBody& figure : figures) count += of(figure).rows();
  all.resize(count, of(figures.front()).cols());
  Eigen::Index filled = 0;
  for (const RiggedBody& figure : figures) {
    all.middleRows(filled, of(figure).rows()) = of(figure);
    filled += of(figure).rows();
  }
  return all;
}

SkinWeights stacked_weights(const std::vector<RiggedBody>& figures) {
  Eigen::Index rows = 0;
  Eigen::Index columns = 0;
  Eigen::Index entries = 0;
  for (const RiggedBody& figure : figures) {
    rows += figure.rig.weights.rows();
    columns += figure.rig.weights.cols();
    entries += figure.rig.weights.nonZeros();
  }
  SkinWeights all(rows, columns);
  all.reserve(entries);
  Eigen::Index row = 0;
  Eigen::Index joints = 0;
  for (const RiggedBody& figure : figures) {
    const SkinWeights& weights = figure.rig.weights;
    for (Eigen::Index v = 0; v < weights.rows(); ++v, ++row) {
      all.startVec(row);
      for (SkinWeights::InnerIterator it(weights, v); it; ++it) {
        all.insertBack(row, joints + it.col()) = it.value();
      }
    }
    joints += weights.cols();
  }
  all.finalize();
  return all;
}

/// Of each of the file's vertices the one that some figure has of it.
Eigen::VectorXi merged_inputs(const std::vector<RiggedBody>& figures, Eigen::Index count) {
  Eigen::VectorXi merged = Eigen::VectorXi::Constant(count, -1);
  for (const RiggedBody& figure : figures) {
    for (Eigen::Index k = 0; k < figure.body.vertex_of_input.size(); ++k) {
      const int own = figure.body.vertex_of_input[k];
      if (own >= 0) merged[figure.inputs ? (*figure.inputs)[idx(k)] : k] = own;
    }
  }
  return merged;
}

}  // namespace

RiggedBody side_by_side(std::vector<RiggedBody> figures, Eigen::Index inputs) {
  const bool is_readable = std::any_of(figures.begin(), figures.end(), [](const RiggedBody& one) {
    return !one.rig.readable.empty();
  });
  for (std::size_t k = 0; k < figures.size(); ++k) {
    Rig& rig = figures[k].rig;
    rig.roles.resize(rig.names.size());
    if (k == 0) continue;
    for (auto* const names : {&rig.names, &rig.readable, &rig.roles}) {
      for (std::string& name : *names) {
        if (!name.empty()) name.insert(0, figure_prefix(k));
      }
    }
  }
  number_through(figures);
  using One = const RiggedBody&;
  RiggedBody all = figures.front();
  all.body.vertex_of_input = merged_inputs(figures, inputs);
  all.inputs.reset();
  all.body.surface.positions = stacked(
      figures, [](One one) -> auto& { return one.body.surface.positions; });
  all.body.surface.triangles = stacked(
      figures, [](One one) -> auto& { return one.body.surface.triangles; });
  all.skeleton.nodes = stacked(
      figures, [](One one) -> auto& { return one.skeleton.nodes; });
  all.skeleton.edges = stacked(
      figures, [](One one) -> auto& { return one.skeleton.edges; });
  all.skeleton.radii = stacked(
      figures, [](One one) -> auto& { return one.skeleton.radii; });
  all.skeleton.node_of_vertex = stacked(
      figures, [](One one) -> auto& { return one.skeleton.node_of_vertex; });
  all.rig.joints = stacked(
      figures, [](One one) -> auto& { return one.rig.joints; });
  all.rig.parents = stacked(
      figures, [](One one) -> auto& { return one.rig.parents; });
  all.rig.weights = stacked_weights(figures);
  if (is_readable) all.rig.readable = readable_names(all.rig);
  for (std::size_t k = 1; k < figures.size(); ++k) {
    const RiggedBody& more = figures[k];
    if (is_readable) append(all.rig.readable, readable_names(more.rig));
    append(all.rig.names, more.rig.names);
    append(all.rig.roles, more.rig.roles);
  }
  return all;
}

}  // namespace curveskel
