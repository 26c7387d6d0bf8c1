#include "skeleton/match/branch_overlaps.hpp"

#include <algorithm>
#include <numeric>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"

namespace curveskel {

Landings landings_of(const MatchSide& a, const BranchTerritories& territories_b,
                     const SurfaceTree& tree_b, const NodeMotions& motions, int threads) {
  constexpr Eigen::Index most = 4000;
  const Eigen::Index all = a.surface.positions.rows();
  const Eigen::Index step = std::max<Eigen::Index>(1, all / most);
  Landings landings{{}, std::vector<int>(idx((all + step - 1) / step), -1)};
  for (Eigen::Index vertex = 0; vertex < all; vertex += step) {
    landings.vertices.push_back(static_cast<int>(vertex));
  }
  parallel_for(landings.vertices.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const int vertex = landings.vertices[k];
      const int node = a.skeleton.node_of_vertex[vertex];
      if (node < 0) continue;
      const Eigen::Vector3d at = a.surface.positions.row(vertex);
      const int triangle = tree_b.nearest(motions.of_node[idx(node)](at)).triangle;
      landings.branches[k] = territories_b.branch_of_face[triangle];
    }
  });
  return landings;
}

Eigen::MatrixXd branch_overlaps(const BranchTerritories& territories_a,
                                const BranchTerritories& territories_b, const Landings& landings) {
  const std::vector<double>& areas_a = territories_a.areas;
  const std::vector<double>& areas_b = territories_b.areas;
  Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(areas_a.size()),
                                                 static_cast<Eigen::Index>(areas_b.size()));
  Eigen::VectorXd samples = Eigen::VectorXd::Zero(shared.rows());
  for (std::size_t k = 0; k < landings.vertices.size(); ++k) {
    const int branch = territories_a.branch_of_vertex[landings.vertices[k]];
    if (branch < 0) continue;
    ++samples[branch];
    if (landings.branches[k] >= 0) ++shared(branch, landings.branches[k]);
  }
  const double whole_a = std::accumulate(areas_a.begin(), areas_a.end(), 0.0);
  const double whole_b = std::accumulate(areas_b.begin(), areas_b.end(), 0.0);
  for (Eigen::Index i = 0; i < shared.rows(); ++i) {
    for (Eigen::Index j = 0; j < shared.cols(); ++j) {
      const double area_a = areas_a[idx(i)] / whole_a;
      const double area_b = areas_b[idx(j)] / whole_b;
      const double both = samples[i] > 0 ? std::min(area_a * shared(i, j) / samples[i], area_b) : 0;
      shared(i, j) = area_a + area_b > both ? both / (area_a + area_b - both) : 0;
    }
  }
  return shared;
}

}  // namespace curveskel
