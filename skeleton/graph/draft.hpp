// A skeleton while it is edited.
#pragma once

#include <Eigen/Core>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

/// Throws Error(Fault::input) unless 0 <= node < #N; `edit` begins the message.
void require_node(const CurveSkeleton& skeleton, int node, const std::string& edit);
/// The same for a row of the edges.
void require_edge(const CurveSkeleton& skeleton, int edge, const std::string& edit);

/// Edges as a set, so that they stay sorted and single; nodes keep their numbers until the end.
class Draft {
 public:
  explicit Draft(const CurveSkeleton& skeleton);

  void connect(int a, int b);  ///< nothing to do for a == b
  void disconnect(int a, int b);
  [[nodiscard]] bool connected(int a, int b) const;
  /// Ascending.
  [[nodiscard]] std::vector<int> neighbours(int node) const;
  [[nodiscard]] Eigen::Vector3d position(int node) const;
  [[nodiscard]] double radius(int node) const;  ///< 0 where there are none
  [[nodiscard]] int nodes() const { return static_cast<int>(heir_.size()); }  ///< with those gone
  /// The lower node first.
  [[nodiscard]] const std::set<std::pair<int, int>>& edges() const { return edges_; }

  /// `without_tree` is the radius where there is no tree; a skeleton without radii stays so.
  void place(int node, const Eigen::Vector3d& point, double without_tree, const SurfaceTree* tree);
  int add(const Eigen::Vector3d& point, double without_tree, const SurfaceTree* tree);
  /// Precondition: the skeleton has lives.
  void set_life(int node, double life) { skeleton_.lives[node] = life; }
  /// Precondition: the skeleton has node_of_vertex.
  void hand_vertex(int vertex, int node) { skeleton_.node_of_vertex[vertex] = node; }
  [[nodiscard]] int node_of_vertex(int vertex) const { return skeleton_.node_of_vertex[vertex]; }
  /// Edges and vertices of `node` go to `heir`, which has the larger life of the two; then it is
  /// gone.
  void dissolve(int node, int heir);

  /// A tip that was none, and took over from none, has the largest life, so that no detail hides
  /// it.
  [[nodiscard]] CurveSkeleton finish() const;

 private:
  void give_lives(CurveSkeleton& result, const std::vector<int>& kept) const;

  CurveSkeleton skeleton_;  // its edges are those at the start
  std::set<std::pair<int, int>> edges_;
  std::vector<int> heir_;  // per node: itself, or the one that took over
};

}  // namespace curveskel
