#include "skeleton/pipeline/failing_components.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include "skeleton/certify/verdict.hpp"
#include "skeleton/graph/sequence_tree.hpp"
#include "surface/spatial/morton.hpp"

namespace curveskel {
namespace {

Eigen::AlignedBox3d box_of(const Eigen::Ref<const Positions>& points) {
  Eigen::AlignedBox3d box;
  for (const auto& p : points.rowwise()) box.extend(Eigen::Vector3d(p.transpose()));
  return box;
}

/// A piece of a skeleton, looking for its component.
struct PieceAsked {
  explicit PieceAsked(Positions given) : nodes(std::move(given)), box(box_of(nodes)) {}

  void ask(const SurfaceTree& tree, int candidate, double candidate_extent) {
    constexpr Eigen::Index most_asked = 64;
    const Eigen::Index step = 1 + nodes.rows() / most_asked;
    int within = 0;
    for (Eigen::Index n = 0; n < nodes.rows(); n += step) {
      if (tree.inside(nodes.row(n).transpose())) ++within;
    }
    if (within > held || (within == held && within > 0 && candidate_extent < extent)) {
      held = within;
      component = candidate;
      extent = candidate_extent;
    }
  }

  Positions nodes;
  Eigen::AlignedBox3d box;
  int held = 0;
  int component = -1;
  double extent = 0;
};

std::vector<std::int32_t> neighbours_together(const std::vector<PieceAsked>& pieces) {
  Positions centres(static_cast<Eigen::Index>(pieces.size()), 3);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    centres.row(static_cast<Eigen::Index>(p)) = pieces[p].box.center().transpose();
  }
  return along_morton_curve(centres, 1);
}

SequenceTree boxes_in(const std::vector<std::int32_t>& order,
                      const std::vector<PieceAsked>& pieces) {
  std::vector<SequenceTree::Item> items;
  items.reserve(order.size());
  for (const std::int32_t p : order)
    items.push_back({pieces[idx(p)].box.min(), pieces[idx(p)].box.max()});
  return SequenceTree(std::move(items));
}

/// Of each node the component of its piece.
std::vector<int> spread(const std::vector<int>& piece_of_node,
                        const std::vector<int>& component_of_piece) {
  std::vector<int> result(piece_of_node.size());
  for (std::size_t node = 0; node < result.size(); ++node) {
    result[node] = component_of_piece[idx(piece_of_node[node])];
  }
  return result;
}

}  // namespace

std::vector<int> component_by_map(const CurveSkeleton& skeleton, const Topology& counted) {
  const std::vector<int> piece = component_of_node(skeleton);
  std::vector<int> of_piece(piece.size(), -1);
  for (Eigen::Index v = 0; v < skeleton.node_of_vertex.size(); ++v) {
    const int node = skeleton.node_of_vertex[v];
    if (node >= 0) of_piece[idx(piece[idx(node)])] = counted.component_of_vertex[v];
  }
  return spread(piece, of_piece);
}

std::vector<int> component_by_place(const CurveSkeleton& skeleton,
                                    const std::vector<Component>& parts) {
  const std::vector<int> piece = component_of_node(skeleton);
  const int pieces = piece.empty() ? 0 : 1 + *std::max_element(piece.begin(), piece.end());
  std::vector<std::vector<int>> nodes(idx(pieces));
  for (std::size_t n = 0; n < piece.size(); ++n)
    nodes[idx(piece[n])].push_back(static_cast<int>(n));
  std::vector<PieceAsked> asked;
  asked.reserve(nodes.size());
  for (const auto& own : nodes) asked.emplace_back(skeleton.nodes(own, Eigen::all));
  const std::vector<std::int32_t> order = neighbours_together(asked);
  const SequenceTree boxes = boxes_in(order, asked);
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const Eigen::AlignedBox3d box = box_of(parts[c].surface.positions);
    std::optional<SurfaceTree> tree;
    boxes.overlapping(box.min(), box.max(), [&](std::size_t i) {
      if (!tree) tree.emplace(parts[c].surface);
      asked[idx(order[i])].ask(*tree, static_cast<int>(c), box.diagonal().norm());
    });
  }
  std::vector<int> of_piece;
  of_piece.reserve(asked.size());
  for (const PieceAsked& one : asked) of_piece.push_back(one.component);
  return spread(piece, of_piece);
}

std::vector<CurveSkeleton> divided(const CurveSkeleton& skeleton,
                                   const std::vector<int>& component_of_node, int components) {
  std::vector<std::vector<int>> nodes(idx(components));
  std::vector<std::vector<int>> edges(idx(components));
  std::vector<std::int32_t> number(component_of_node.size(), -1);
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (component_of_node[node] < 0) continue;
    auto& own = nodes[idx(component_of_node[node])];
    number[node] = static_cast<std::int32_t>(own.size());
    own.push_back(static_cast<int>(node));
  }
  for (int e = 0; e < skeleton.edges.rows(); ++e) {
    const int component = component_of_node[idx(skeleton.edges(e, 0))];
    if (component >= 0) edges[idx(component)].push_back(e);
  }
  std::vector<CurveSkeleton> parts(idx(components));
  for (std::size_t c = 0; c < parts.size(); ++c) {
    parts[c].nodes = skeleton.nodes(nodes[c], Eigen::all);
    parts[c].edges = skeleton.edges(edges[c], Eigen::all);
    for (std::int32_t& node : parts[c].edges.reshaped()) node = number[idx(node)];
    parts[c].radii.setZero(parts[c].nodes.rows());
  }
  return parts;
}

Certificate verdict_alone(const Surface& component, int genus, double diagonal,
                          const CurveSkeleton& skeleton, const CertificateOptions& options,
                          const Monitor& monitor) {
  const SurfaceTree tree(component);
  return verdict({component, tree, diagonal, 1, genus}, skeleton, options, monitor);
}

double turned_share(const Surface& surface, const SurfaceTree& tree) {
  constexpr int samples = 256;
  constexpr double off = 1e-4;  // of the size
  const double step = off * bounding_box_diagonal(surface.positions);
  const double spacing = area(surface) / samples;
  double until_next = 0.5 * spacing;
  int taken = 0;
  int turned = 0;
  for (const auto& triangle : surface.triangles.rowwise()) {
    const Eigen::Vector3d a = surface.positions.row(triangle[0]);
    const Eigen::Vector3d b = surface.positions.row(triangle[1]);
    const Eigen::Vector3d c = surface.positions.row(triangle[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    until_next -= 0.5 * normal.norm();
    if (until_next > 0) continue;
    while (until_next <= 0) until_next += spacing;
    const Eigen::Vector3d outwards = step * normal.normalized();
    const Eigen::Vector3d middle = (a + b + c) / 3;
    ++taken;
    if (tree.inside(middle + outwards) && !tree.inside(middle - outwards)) ++turned;
  }
  return taken == 0 ? 0 : static_cast<double>(turned) / taken;
}

bool has_turned_limbs(const Surface& component) {
  constexpr double limb = 0.05;
  return turned_share(component, SurfaceTree(component)) > limb;
}

std::vector<FailingComponent> failing_components(const Surface& surface, const Topology& counted,
                                                 const CurveSkeleton& skeleton,
                                                 const std::vector<int>& component_of_node,
                                                 const CertificateOptions& options,
                                                 bool may_be_turned, const Monitor& monitor) {
  const double diagonal = bounding_box_diagonal(surface.positions);
  auto parts = split_components(surface, counted);
  auto curves = divided(skeleton, component_of_node, counted.components());
  std::vector<FailingComponent> failing;
  for (int c = 0; c < counted.components(); ++c) {
    Surface& part = parts[idx(c)].surface;
    const int genus = counted.genus[idx(c)];
    const CurveSkeleton& curve = curves[idx(c)];
    const bool holds = verdict_alone(part, genus, diagonal, curve, options, monitor).correct();
    if (holds && !(may_be_turned && has_turned_limbs(part))) continue;
    failing.push_back({c, std::move(part), genus, std::move(curves[idx(c)])});
  }
  return failing;
}

std::vector<FailingComponent> failing_of(const Surface& surface, const Extraction& extraction,
                                         const CertificateOptions& options, bool may_be_turned,
                                         const Monitor& monitor) {
  const Topology counted = topology(surface);
  return failing_components(surface, counted, extraction.skeleton,
                            component_by_map(extraction.skeleton, counted), options, may_be_turned,
                            monitor);
}

}  // namespace curveskel
