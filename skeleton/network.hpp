// The skeleton while it is being embedded: hubs joined by strands.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "skeleton/circles.hpp"
#include "skeleton/curve_skeleton.hpp"
#include "surface/surface.hpp"

namespace curveskel {

using Point = Eigen::Vector3d;

/// A tip, a junction, or the one chosen point of a closed curve.
struct Hub {
  Point position = Point::Zero();
  std::vector<int> nodes;  ///< groups and circles of the graph that belong to it
  bool alive = true;
  std::vector<int> strands{};  ///< the living ones that end here, ascending, each once
};

/// A curve from one hub to another, or back to the same.
struct Strand {
  int from = -1;
  int to = -1;
  std::vector<Point> points;  ///< between the two hubs, in order; may be empty
  std::vector<int> nodes;     ///< groups and circles of the graph that belong to it
  bool alive = true;
};

/// Every change keeps the number of components and the cycle rank. Which strands end at which hubs
/// changes by the functions below only.
struct Network {
  std::vector<Hub> hubs;
  std::vector<Strand> strands;

  [[nodiscard]] int degree(int hub) const;                 ///< a closed strand counts twice
  [[nodiscard]] bool is_leaf(const Strand& strand) const;  ///< exactly one end is a tip
  [[nodiscard]] int living_strands() const;
  [[nodiscard]] double length(const Strand& strand) const;
  [[nodiscard]] std::vector<Point> polyline(const Strand& strand) const;  ///< hubs included

  /// Turns the strand around so that `hub` is its `from`.
  void orient_from(int strand, int hub);
  /// Removes a leaf strand and its tip; what belonged to them belongs to the other hub.
  void prune(int strand);
  /// Shrinks a strand between two different hubs to the hub `into`.
  void collapse(int strand, int into, const Point& position);
  /// Joins the two strands at a hub of degree 2 into one; nothing to do at a closed curve's hub.
  void dissolve(int hub);
  /// Cuts a strand loose from its `to` and lets it end where a new, closed strand begins: `way`
  /// goes on from its `from` to there, `ring` from there once round. What belongs to the strand
  /// from node `cut` on belongs to the closed one. The old `to` may be left with two strands or
  /// none.
  void end_in_ring(int strand, std::size_t cut, std::vector<Point> way, std::vector<Point> ring);
  /// A new hub at a place on the strand's segment (counted along its polyline); both parts belong
  /// to what the strand belonged to.
  int split(int strand, std::size_t segment, const Point& place);
  /// A new tip, joined to `base` by a strand without points that belongs to the given groups;
  /// where the base was a tip, the strand there goes on to the new one and belongs to what it did.
  int add_leaf(int base, const Point& tip, std::vector<int> groups);
};

/// positions: one per node of the graph (groups, then circles).
[[nodiscard]] Network network_of_graph(const VertexGraph& graph,
                                       const std::vector<Point>& positions);

/// The nodes and edges of a network, each strand with enough inner points that no edge is doubled.
/// group_nodes[g] lists the nodes that a vertex of group g may belong to.
struct NetworkNodes {
  CurveSkeleton skeleton;                     ///< radii and vertex map left empty
  std::vector<std::vector<int>> group_nodes;  ///< per group, ascending
};
[[nodiscard]] NetworkNodes nodes_of_network(const Network& network, int groups);

}  // namespace curveskel
