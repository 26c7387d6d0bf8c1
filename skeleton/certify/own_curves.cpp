#include "skeleton/certify/own_curves.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "skeleton/graph/sequence_tree.hpp"
#include "surface/spatial/morton.hpp"

namespace curveskel {
namespace {

/// A component of the skeleton.
struct CurvePart {
  Positions nodes;  ///< 64 at most, evenly through them
  Eigen::AlignedBox3d box;
};

Eigen::AlignedBox3d box_round(const Positions& points) {
  return {points.colwise().minCoeff().transpose(), points.colwise().maxCoeff().transpose()};
}

/// Along the Morton curve.
std::vector<CurvePart> parts_of(const CurveSkeleton& skeleton) {
  constexpr std::size_t most_nodes = 64;
  const std::vector<int> part_of_node = component_of_node(skeleton);
  std::vector<std::vector<int>> nodes;
  for (std::size_t node = 0; node < part_of_node.size(); ++node) {
    const std::size_t part = idx(part_of_node[node]);
    if (part >= nodes.size()) nodes.resize(part + 1);
    nodes[part].push_back(static_cast<int>(node));
  }
  Positions firsts(static_cast<Eigen::Index>(nodes.size()), 3);
  for (std::size_t part = 0; part < nodes.size(); ++part) {
    firsts.row(static_cast<Eigen::Index>(part)) = skeleton.nodes.row(nodes[part].front());
  }
  std::vector<CurvePart> parts;
  parts.reserve(nodes.size());
  for (const std::int32_t part : along_morton_curve(firsts, 1)) {
    const std::vector<int>& all = nodes[idx(part)];
    const std::size_t step = 1 + all.size() / most_nodes;
    std::vector<int> some;
    for (std::size_t k = 0; k < all.size(); k += step) some.push_back(all[k]);
    const Positions places = skeleton.nodes(some, Eigen::all);
    parts.push_back({places, box_round(places)});
  }
  return parts;
}

bool reaches_into(const CurvePart& part, const SurfaceTree& tree) {
  for (const auto& node : part.nodes.rowwise()) {
    if (tree.inside(node.transpose())) return true;
  }
  return false;
}

/// Per component of the surface: the parts that have a node in it. One that is nowhere inside, as a
/// curve that was never moved there may be, counts for each component whose box it meets.
std::vector<std::vector<int>> parts_within(const Surface& surface, const CurveSkeleton& skeleton) {
  const std::vector<CurvePart> parts = parts_of(skeleton);
  std::vector<SequenceTree::Item> items;
  items.reserve(parts.size());
  for (const CurvePart& part : parts) items.push_back({part.box.min(), part.box.max()});
  const SequenceTree boxes(std::move(items));
  std::vector<std::vector<int>> within;
  std::vector<std::vector<int>> beside(parts.size());  // components, by part
  std::vector<char> is_inside(parts.size(), 0);
  for (const Component& component : split_components(surface, topology(surface))) {
    const int number = static_cast<int>(within.size());
    std::vector<int>& own = within.emplace_back();
    const Eigen::AlignedBox3d box = box_round(component.surface.positions);
    std::optional<SurfaceTree> tree;
    boxes.overlapping(box.min(), box.max(), [&](std::size_t part) {
      beside[part].push_back(number);
      if (!tree) tree.emplace(component.surface);
      if (!reaches_into(parts[part], *tree)) return;
      own.push_back(static_cast<int>(part));
      is_inside[part] = 1;
    });
  }
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (is_inside[part] != 0) continue;
    for (const int component : beside[part])
      within[idx(component)].push_back(static_cast<int>(part));
  }
  return within;
}

/// Gives each component a part, by ways along which others change theirs.
class OwnParts {
 public:
  OwnParts(std::vector<std::vector<int>> within, std::size_t parts)
      : within_(std::move(within)), owner_(parts, -1), asked_(parts, 0) {}

  [[nodiscard]] int without_one() {
    int count = 0;
    for (std::size_t component = 0; component < within_.size(); ++component) {
      ++round_;
      count += give(static_cast<int>(component)) ? 0 : 1;
    }
    return count;
  }

 private:
  bool give(int component) {
    for (const int part : within_[idx(component)]) {
      if (std::exchange(asked_[idx(part)], round_) == round_) continue;
      if (owner_[idx(part)] >= 0 && !give(owner_[idx(part)])) continue;
      owner_[idx(part)] = component;
      return true;
    }
    return false;
  }

  std::vector<std::vector<int>> within_;
  std::vector<int> owner_;  // per part
  std::vector<int> asked_;  // per part: the last round that asked for it
  int round_ = 0;           // one for each component that wants a part
};

}  // namespace

int components_without_curve(const Surface& surface, const CurveSkeleton& skeleton) {
  return OwnParts(parts_within(surface, skeleton), idx(skeleton.nodes.rows())).without_one();
}

}  // namespace curveskel
