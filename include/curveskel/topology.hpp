// Counting: components, Euler characteristic, genus.
#pragma once

#include <Eigen/Core>
#include <numeric>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

struct Topology {
  Eigen::VectorXi component_of_vertex;  ///< #V, numbered by the smallest vertex index in each
  std::vector<int> vertices;            ///< per component
  std::vector<int> faces;               ///< per component
  std::vector<int> genus;               ///< per component, (2 - V + E - F) / 2
  [[nodiscard]] int components() const { return static_cast<int>(genus.size()); }
  [[nodiscard]] int total_genus() const { return std::accumulate(genus.begin(), genus.end(), 0); }
};

/// Precondition: closed oriented 2-manifold, no isolated vertices. O(#F log #F).
[[nodiscard]] Topology topology(const Surface& surface);

/// One component as a surface of its own.
struct Component {
  Surface surface;
  std::vector<int> vertex_in_whole;  ///< local vertex -> vertex of the whole surface
};

/// The components in the order of `topology`. Throws Error(Fault::input) for that of another
/// surface. O(#V + #F).
[[nodiscard]] std::vector<Component> split_components(const Surface& surface,
                                                      const Topology& topology);

}  // namespace curveskel
