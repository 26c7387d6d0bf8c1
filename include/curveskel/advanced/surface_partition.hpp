// Groups of vertices and the cut curves along which they meet.
//
// Cut a closed oriented surface of genus g into connected pieces that meet along disjoint cut
// curves only. With one node per piece and one edge per cut curve, the graph's cycle rank is g
// minus the sum of the pieces' genera: pieces of genus 0 give exactly g.
#pragma once

#include <Eigen/Core>
#include <array>
#include <initializer_list>
#include <vector>

#include <curveskel/advanced/union_find.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Each triangle's edges: edge_of_corner(t, k) is the edge opposite to corner k of triangle t.
struct EdgeIndex {
  Triangles edge_of_corner;               ///< #F by 3
  std::vector<std::array<int, 2>> edges;  ///< ends, the smaller vertex first; sorted
};

/// O(#F log #F), and the highest corner. Throws Error(Fault::input) for a corner below 0.
[[nodiscard]] EdgeIndex index_edges(const Triangles& triangles);

/// A partition of the vertices into connected groups, at first one group per vertex. A group's
/// piece of surface is the union of its vertices' dual cells; a piece's boundary runs through the
/// triangles that have corners inside and outside of it. Precondition: closed oriented 2-manifold.
/// Throws Error(Fault::input) for corners that are no vertices; its functions throw
/// std::out_of_range for what is no vertex, or no group: these have the numbers of vertices.
class SurfacePartition {
 public:
  explicit SurfacePartition(const Surface& surface);

  [[nodiscard]] int group_of(int vertex) const {
    return group_of_vertex_.at(static_cast<std::size_t>(vertex));
  }

  /// True if some triangle has corners in both groups and in a third one.
  [[nodiscard]] bool share_triple(int a, int b) const;

  /// The groups that share a three-group triangle with `group`, ascending.
  [[nodiscard]] std::vector<int> triple_neighbours(int group) const;

  /// Number of triangles whose corners lie in three groups; 0 = pieces meet along cut curves only.
  [[nodiscard]] int triples() const;

  /// Genus (2 - chi - cut curves) / 2 of the piece that merging would make; 0 = a sphere with
  /// holes. Once positive it stays so for every larger piece. O(size of the shorter boundary) where
  /// the two meet along one curve, else of both. Of one group and itself that of the group.
  [[nodiscard]] int genus_of_union(int a, int b);

  /// Moves the vertices of `from` to `into`; nothing where these are one. As `genus_of_union`, and
  /// the size of `from`.
  void merge(int from, int into);

 private:
  void require_groups(std::initializer_list<int> groups) const;
  [[nodiscard]] std::array<int, 3> groups_at(int triangle) const;
  [[nodiscard]] const std::vector<int>& shorter_boundary(int a, int b) const;
  [[nodiscard]] std::vector<int> touching(int a, int b) const;
  [[nodiscard]] int euler_of_union(int a, int b) const;
  /// The number of curves, open or closed, that the triangles' crossing edges are linked to.
  template <typename Crosses>
  [[nodiscard]] int curves_through(const std::vector<int>& triangles, const Crosses& crosses);

  Triangles triangles_;
  EdgeIndex index_;
  std::vector<int> group_of_vertex_;
  std::vector<std::vector<int>> members_;
  std::vector<std::vector<int>>
      boundary_;            // per group: triangles it shares, or shared, with others
  std::vector<int> inner_;  // per group: how many of these are its own by now
  std::vector<int> euler_;  // per group
  std::vector<int> genus_;  // per group
  UnionFind linked_;        // edges, each on its own again after each use
};

/// A graph whose first nodes are groups of the vertices of a surface, followed by one node for each
/// cut curve along which two groups meet: groups that meet along several cut curves keep one path
/// each.
struct PartitionGraph {
  int groups = 0;
  Eigen::VectorXi group_of_vertex;  ///< #V, node index in 0 .. groups - 1
  /// Per cut curve, its node being groups + c: the surface's edges that cross it, in order around
  /// it, as (vertex, vertex).
  std::vector<std::vector<std::array<int, 2>>> cut_curves;
  Edges edges;  ///< #E by 2, each from a group to a cut curve
  [[nodiscard]] int nodes() const { return groups + static_cast<int>(cut_curves.size()); }
};

/// Places of the graph's nodes (#N by 3): each in the middle of the positions (#V by 3) of its
/// group, or of the vertices of the edges that cross its cut curve. Throws Error(Fault::input) for
/// positions of other vertices, numbers that are none, and groups without vertices.
[[nodiscard]] Positions middles_of_groups(const PartitionGraph& graph, const Positions& positions);

/// Groups are renumbered by their smallest vertex, cut curves by their smallest crossing edge.
/// Throws Error(Fault::input) where a triangle has corners in three groups, a cut curve does not
/// close, or groups are not of the surface's vertices, in 0 .. #V - 1. O(#F log #F).
[[nodiscard]] PartitionGraph partition_graph(const Surface& surface,
                                             const Eigen::VectorXi& group_of_vertex);

/// The same where the edges are known: `index` must be that of the surface's triangles, and is
/// refused as well where its numbers are none of them. O(#F).
[[nodiscard]] PartitionGraph partition_graph(const Surface& surface, const EdgeIndex& index,
                                             const Eigen::VectorXi& group_of_vertex);

}  // namespace curveskel
