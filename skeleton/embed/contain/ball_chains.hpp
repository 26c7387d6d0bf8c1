// Ways through a surface from inscribed ball to inscribed ball.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/working_surface.hpp"

namespace curveskel {

/// Smaller balls are as good as outside. D = 1.
inline constexpr double least_radius = 1e-5;

/// The groups among nodes of the partition, whose others are cut curves.
[[nodiscard]] std::vector<int> groups_among(std::vector<int> nodes,
                                            const PartitionGraph& partition);
/// Those of an arc and of its nodes.
[[nodiscard]] std::vector<int> groups_along(const SkeletonGraph& graph, const Arc& arc,
                                            const PartitionGraph& partition);

/// Cheapest chains of the vertices' inscribed balls from neighbour to neighbour: each step costs
/// its length over the smaller radius. A question takes as long as the groups asked about have
/// vertices, however many others there are; only the first one prepares all, as there are often
/// none.
class BallChains {
 public:
  /// Kept by reference.
  BallChains(const WorkingSurface& working, const PartitionGraph& partition);

  /// From the vertex whose ball holds p best to that of q, through vertices of the given groups;
  /// empty if there is no way.
  [[nodiscard]] std::vector<int> way_between(const Point& p, const Point& q,
                                             const std::vector<int>& groups);
  /// The ball centres on it.
  [[nodiscard]] std::vector<Point> chain(const Point& p, const Point& q,
                                         const std::vector<int>& groups);

  /// For each place the vertex of the given groups whose ball holds it best; -1 if they have no
  /// balls. O(places x vertices of the groups).
  [[nodiscard]] std::vector<int> holders(const std::vector<Point>& places,
                                         const std::vector<int>& groups);
  /// The cost of the cheapest chain from one of the places to each of them, infinity if there is no
  /// way. Its first and last steps, from a place to its holder, count with that ball.
  [[nodiscard]] std::vector<double> costs(std::size_t from, const std::vector<Point>& places,
                                          const std::vector<int>& holders,
                                          const std::vector<int>& groups);

  /// The vertices of a cheapest chain from one to another, both included; empty if there is no way.
  [[nodiscard]] std::vector<int> way(int from, int to, const std::vector<int>& groups);
  /// The same, through balls that are as good as outside, too.
  [[nodiscard]] std::vector<int> way_through_all(int from, int to, const std::vector<int>& groups);

  /// No chain takes the step between these two neighbours any more, until all are allowed again.
  void avoid(int one, int other);
  void allow_all() { avoided_.clear(); }

  /// The vertex of the given groups whose ball's centre is nearest to p; -1 if they have no balls.
  [[nodiscard]] int nearest_vertex(const Point& p, const std::vector<int>& groups);
  /// The ball centre nearest to p of the vertices of the given groups; p if they have none.
  [[nodiscard]] Point nearest_centre(const Point& p, const std::vector<int>& groups);

 private:
  void prepare();
  void search(int source, int target, const std::vector<int>& groups);
  [[nodiscard]] bool may_pass(int v) const;
  [[nodiscard]] bool is_avoided(int one, int other) const;
  [[nodiscard]] double distance(const Point& p, int v) const;
  [[nodiscard]] int holder_of(const Point& p, const std::vector<int>& groups) const;
  template <typename Value>
  [[nodiscard]] int least_of(const std::vector<int>& groups, const Value& value) const;

  const WorkingSurface& working_;
  const InscribedBalls& balls_;
  const PartitionGraph& partition_;
  std::vector<std::vector<int>> vertices_;  // of each group, those with a ball
  std::set<std::pair<int, int>> avoided_;   // lesser vertex first
  std::vector<char> allowed_;               // per group, while a search runs
  bool passes_all_ = false;                 // balls of any size, while a search runs
  ShortestPaths paths_;
};

}  // namespace curveskel
