#include <curveskel/advanced/graph.hpp>
#include <curveskel/edit.hpp>
#include "skeleton/graph/draft.hpp"
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {
Path shortest_path(const CurveSkeleton& skeleton, int a, int b) {
  require_sound(skeleton, "shortest_path");
  require_node(skeleton, a, "shortest_path");
  require_node(skeleton, b, "shortest_path");
  ShortestPaths paths(skeleton.nodes.rows());
  paths.search(graph_of(skeleton.nodes.rows(), skeleton.edges), a, b,
               [&](int from, int to, int /*edge*/) {
                 return (skeleton.nodes.row(from) - skeleton.nodes.row(to)).norm();
               });
  Path path;
  path.nodes = paths.path_to(b);
  if (!path.nodes.empty()) path.length = paths.distance(b);
  return path;
}

}  // namespace curveskel
