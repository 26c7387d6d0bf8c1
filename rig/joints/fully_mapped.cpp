#include "rig/joints/fully_mapped.hpp"

#include <algorithm>
#include <cstddef>

#include "base/parallel.hpp"
#include "skeleton/graph/node_balls.hpp"

namespace curveskel {

CurveSkeleton fully_mapped(const Surface& surface, const CurveSkeleton& skeleton, int threads,
                           const Monitor& monitor) {
  CurveSkeleton mapped = skeleton;
  if (mapped.node_of_vertex.size() == 0) {
    mapped.node_of_vertex.setConstant(surface.positions.rows(), -1);
  }
  const NodeBalls balls(skeleton);
  constexpr std::size_t block = 16384;
  const auto count = static_cast<std::size_t>(mapped.node_of_vertex.size());
  for (std::size_t first = 0; first < count; first += block) {
    monitor.report("joints", static_cast<double>(first) / static_cast<double>(count));
    parallel_for(std::min(block, count - first), 512, threads,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t k = first + begin; k < first + end; ++k) {
                     const auto v = static_cast<Eigen::Index>(k);
                     int& node = mapped.node_of_vertex[v];
                     if (node < 0) node = balls.nearest(surface.positions.row(v).transpose());
                   }
                 });
  }
  return mapped;
}

}  // namespace curveskel
