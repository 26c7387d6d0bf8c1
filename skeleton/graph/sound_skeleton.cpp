#include "skeleton/graph/sound_skeleton.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <curveskel/error.hpp>

namespace curveskel {

void require_sound(const CurveSkeleton& skeleton, std::string_view purpose) {
  const Eigen::Index nodes = skeleton.nodes.rows();
  const auto refuse = [&](const std::string& found) {
    throw Error(Fault::input, std::string(purpose) + ": the skeleton has " + found +
                                  ", needed numbers of its " + std::to_string(nodes) + " nodes");
  };
  for (Eigen::Index e = 0; e < skeleton.edges.rows(); ++e) {
    const auto edge = skeleton.edges.row(e);
    if (edge.minCoeff() >= 0 && edge.maxCoeff() < nodes) continue;
    refuse("an edge from node " + std::to_string(edge[0]) + " to " + std::to_string(edge[1]));
  }
  const Eigen::Index radii = skeleton.radii.size();
  if (radii != 0 && radii != nodes) refuse(std::to_string(radii) + " radii");
  for (Eigen::Index v = 0; v < skeleton.node_of_vertex.size(); ++v) {
    const int node = skeleton.node_of_vertex[v];
    if (node < nodes) continue;
    refuse("node " + std::to_string(node) + " for vertex " + std::to_string(v));
  }
  const auto is_node = [nodes](int node) { return node >= 0 && node < nodes; };
  for (const Contact& contact : skeleton.contacts) {
    for (const ContactSide* const side : {&contact.one, &contact.other}) {
      const std::vector<int>& tips = side->tips;
      if (is_node(side->node) && std::all_of(tips.begin(), tips.end(), is_node)) continue;
      refuse("a contact of node " + std::to_string(side->node));
    }
  }
}

void require_sound_places(const CurveSkeleton& skeleton, std::string_view purpose) {
  require_sound(skeleton, purpose);
  if (skeleton.nodes.allFinite()) return;
  throw Error(Fault::input, std::string(purpose) +
                                ": the skeleton has a coordinate that is no finite number, needed "
                                "finite ones");
}

int require_edge(const CurveSkeleton& skeleton, int a, int b, std::string_view purpose) {
  const int edge = edge_between(skeleton, a, b);
  if (edge >= 0) return edge;
  throw Error(Fault::input, std::string(purpose) + ": the edge between nodes " + std::to_string(a) +
                                " and " + std::to_string(b) +
                                " is not in its place, needed rows of edges sorted, the lower "
                                "node first in each");
}

void require_vertices_of(const CurveSkeleton& skeleton, const Surface& surface,
                         std::string_view purpose) {
  const Eigen::Index mapped = skeleton.node_of_vertex.size();
  if (mapped == 0) return;
  require_map_of(skeleton, surface, purpose);
}

void require_map_of(const CurveSkeleton& skeleton, const Surface& surface,
                    std::string_view purpose) {
  const Eigen::Index mapped = skeleton.node_of_vertex.size();
  if (mapped == surface.positions.rows()) return;
  throw Error(Fault::input, std::string(purpose) + ": the skeleton has nodes for " +
                                std::to_string(mapped) + " vertices, needed one for each of the " +
                                "surface's " + std::to_string(surface.positions.rows()));
}

void require_below(const Eigen::VectorXi& numbers, Eigen::Index count, std::string_view purpose) {
  for (Eigen::Index k = 0; k < numbers.size(); ++k) {
    if (numbers[k] < count) continue;
    throw Error(Fault::input, std::string(purpose) + ": found vertex " +
                                  std::to_string(numbers[k]) + " for vertex " + std::to_string(k) +
                                  ", needed one of the surface's " + std::to_string(count) +
                                  ", or -1 for none");
  }
}

}  // namespace curveskel
