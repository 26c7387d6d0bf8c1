// The skeleton while it is being embedded: nodes joined by arcs.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

using Point = Eigen::Vector3d;

/// A place of the curve with its inscribed radius, which is the dearest question that a step asks:
/// it is asked when first needed, and the answer stays with the place. All questions are to one
/// tree, until the radius is forgotten. The first question writes: no two threads may ask at once.
class CurvePoint {
 public:
  CurvePoint() = default;
  CurvePoint(Point place) : place_(std::move(place)) {}  // NOLINT: a place is a CurvePoint
  CurvePoint(Point place, double radius) : place_(std::move(place)), radius_(radius) {}

  [[nodiscard]] const Point& place() const { return place_; }

  /// Negative outside.
  double radius(const SurfaceTree& tree) const {
    if (std::isnan(radius_)) radius_ = tree.inscribed_radius(place_);
    return radius_;
  }
  void forget_radius() { radius_ = not_asked; }

 private:
  static constexpr double not_asked = std::numeric_limits<double>::quiet_NaN();
  Point place_ = Point::Zero();
  mutable double radius_ = not_asked;
};

/// A tip, a junction, or the one chosen point of a closed curve.
struct Node {
  CurvePoint point;
  std::vector<int> pieces;  ///< groups and cut curves of the partition that belong to it
  bool alive = true;
  std::vector<int> arcs{};  ///< the living ones that end here, ascending, each once
};

/// A curve from one node to another, or back to the same.
struct Arc {
  int from = -1;
  int to = -1;
  std::vector<CurvePoint> points;  ///< between the two nodes, in order; may be empty
  std::vector<int> pieces;         ///< groups and cut curves of the partition that belong to it
  bool alive = true;
};

/// Every change keeps the number of components and the cycle rank. Which arcs end at which nodes
/// changes by the functions below only.
struct SkeletonGraph {
  std::vector<Node> nodes;
  std::vector<Arc> arcs;

  [[nodiscard]] int degree(int node) const;          ///< a closed arc counts twice
  [[nodiscard]] bool is_leaf(const Arc& arc) const;  ///< exactly one end is a tip
  [[nodiscard]] int living_arcs() const;
  [[nodiscard]] double length(const Arc& arc) const;
  [[nodiscard]] const Point& place(int node) const;
  /// Of all points of an arc, nodes included, in order: their places, their inscribed radii.
  [[nodiscard]] std::vector<Point> polyline(const Arc& arc) const;
  [[nodiscard]] std::vector<double> radii_along(const Arc& arc, const SurfaceTree& tree) const;
  /// The same points, each with its radius.
  [[nodiscard]] std::vector<CurvePoint> points_along(const Arc& arc, const SurfaceTree& tree) const;
  /// Before another tree is asked.
  void forget_radii();

  /// Turns the arc around so that `node` is its `from`.
  void orient_from(int arc, int node);
  /// Removes a leaf arc and its tip; their groups go to the other node.
  void prune(int arc);
  /// The same, but the other node, which is returned, stays though only two arcs are left at it.
  int take_off(int arc);
  /// Shrinks an arc between two different nodes to the node `into`.
  void collapse(int arc, int into, const CurvePoint& point);
  /// Joins the two arcs at a node of degree 2 into one; nothing to do at a closed curve's node.
  void dissolve(int node);
  /// Cuts an arc loose from its `to` and lets it end where a new, closed arc begins: `way`
  /// goes on from its `from` to there, `ring` from there once round. The pieces of the arc
  /// from `cut` on belong to the closed one. The old `to` may be left with two arcs or none.
  void end_in_ring(int arc, std::size_t cut, std::vector<Point> way,
                   const std::vector<Point>& ring);
  /// Makes the point half-way round a closed curve (a node with no other arc) the curve's node, and
  /// the old node a point of the arc: no place of such a curve is special. False, and nothing to
  /// do, for other arcs and for those without points.
  bool turn_half_way_round(int arc);
  /// A new node at a place on the arc's segment (counted along its polyline); both parts belong
  /// to what the arc belonged to.
  int split(int arc, std::size_t segment, const Point& place);
  /// A new tip, joined to `base` by an arc without points that belongs to the given groups;
  /// where the base was a tip, the arc there goes on to the new one and belongs to what it did.
  int add_leaf(int base, const Point& tip, std::vector<int> groups);
};

/// positions: one per node of the partition (groups, then cut curves).
[[nodiscard]] SkeletonGraph skeleton_graph_of(const PartitionGraph& partition,
                                              const std::vector<Point>& positions);

/// The nodes and edges of a graph, each arc with enough inner points that no edge is doubled.
/// nodes_of_group[g] lists the nodes that a vertex of group g may belong to. Radii come from the
/// tree, without one they are left empty.
struct EmbeddedNodes {
  CurveSkeleton skeleton;                        ///< vertex map left empty
  std::vector<std::vector<int>> nodes_of_group;  ///< per group, ascending
};
[[nodiscard]] EmbeddedNodes skeleton_of(const SkeletonGraph& graph, int groups,
                                        const SurfaceTree* tree = nullptr);

/// The node of each vertex: the nearest to its place (#V by 3) of those that its group may belong
/// to, of all where that is none; the first of equally near ones. O(#V x nodes of a group).
[[nodiscard]] Eigen::VectorXi nearest_nodes(const EmbeddedNodes& nodes,
                                            const Eigen::VectorXi& group_of_vertex,
                                            const Positions& places);

}  // namespace curveskel
