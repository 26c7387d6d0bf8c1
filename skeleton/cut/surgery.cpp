// Connectivity surgery after Au, Tai, Chu, Cohen-Or and Lee, "Skeleton extraction by mesh
// contraction", SIGGRAPH 2008, section 5, with a guard that keeps every group of genus 0.

#include <curveskel/advanced/surgery.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/error.hpp>
#include "base/option_ranges.hpp"
#include "skeleton/cut/cgal_surgery.hpp"
#include "skeleton/cut/level_set_graph.hpp"

namespace curveskel {
namespace {

/// Sum of squared distances to lines through a vertex (Au et al., eq. 6): p -> (p^T A p - 2 b.p +
/// c).
struct LineQuadric {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0;

  void add_line(const Eigen::Vector3d& origin, const Eigen::Vector3d& unit_direction) {
    const Eigen::Matrix3d projector =
        Eigen::Matrix3d::Identity() - unit_direction * unit_direction.transpose();
    const Eigen::Vector3d offset = projector * origin;
    a += projector;
    b += offset;
    c += origin.dot(offset);
  }
  void add(const LineQuadric& other) {
    a += other.a;
    b += other.b;
    c += other.c;
  }
  [[nodiscard]] double at(const Eigen::Vector3d& p) const {
    return std::max(0.0, p.dot(a * p) - 2 * b.dot(p) + c);
  }
};

/// A half-edge collapse "from -> into", valid as long as neither group has changed since.
struct Candidate {
  double cost;
  int from, into;
  int from_version, into_version;
  // Equal costs are taken in the order of the groups, so the result does not depend on the heap.
  [[nodiscard]] auto key() const { return std::tuple(cost, from, into); }
  bool operator<(const Candidate& other) const { return key() > other.key(); }
};

/// With more of them, a group's candidates are not made anew at each of its merges, which would
/// take the square of their number.
constexpr std::size_t many_neighbours = 1000;

/// The sum of the lengths of a group's edges, kept while the group's neighbours are the same, and
/// for a while longer if these are many.
struct EdgeSum {
  double length = 0;
  bool exact = false;  ///< the neighbours are the same as when the sum was made
  std::size_t neighbours = 0;
  std::size_t changes = 0;  ///< how often neighbours merged since the sum was made
  /// An eighth of the neighbours: the sum is out by about as much, and all candidates in all are
  /// made from no more than nine times the neighbours that there ever were.
  [[nodiscard]] bool current() const {
    return neighbours > many_neighbours && 8 * changes < neighbours;
  }
};

class Surgeon {
 public:
  Surgeon(const Surface& surface, const SurgeryOptions& options)
      : options_(options), groups_(surface), positions_(surface.positions) {
    const int vertices = static_cast<int>(positions_.rows());
    version_.assign(vertices, 0);
    alive_.assign(vertices, true);
    quadrics_.resize(vertices);
    edge_sums_.resize(vertices);
    for (int v = 0; v < vertices; ++v) {
      for (const int neighbour : neighbours(v)) {
        const Eigen::Vector3d edge = positions_.row(neighbour) - positions_.row(v);
        const double length = edge.norm();
        if (length > 0) quadrics_[v].add_line(positions_.row(v), edge / length);
      }
    }
    for (int v = 0; v < vertices; ++v) push_candidates_of(v, false);
  }

  void run(const Monitor& monitor) {
    int steps = 0;
    while (!heap_.empty()) {
      const Candidate best = heap_.top();
      heap_.pop();
      if (!current(best) || !groups_.share_triple(best.from, best.into)) continue;
      if (groups_.genus_of_union(best.from, best.into) > 0) continue;  // final: it never shrinks
      merge(best.from, best.into);
      if (++steps % 256 == 0) monitor.report("surgery", steps / double(positions_.rows()));
    }
  }

  [[nodiscard]] const SurfacePartition& groups() const { return groups_; }

 private:
  [[nodiscard]] bool current(const Candidate& c) const {
    return alive_[c.from] && alive_[c.into] && version_[c.from] == c.from_version &&
           version_[c.into] == c.into_version;
  }

  [[nodiscard]] std::vector<int> neighbours(int group) const {
    return groups_.triple_neighbours(group);
  }

  /// Sum of the lengths of a group's edges, for many neighbours made anew now and then only.
  double edge_sum(int group) {
    EdgeSum& kept = edge_sums_[group];
    ++kept.changes;
    if (kept.current()) return kept.length;
    if (!kept.exact) return edge_sum(group, neighbours(group));
    kept.changes = 0;
    return kept.length;
  }

  double edge_sum(int group, const std::vector<int>& around) {
    double sum = 0;
    for (const int other : around) sum += (positions_.row(other) - positions_.row(group)).norm();
    edge_sums_[group] = {sum, true, around.size(), 0};
    return sum;
  }

  void push_candidates_of(int group, bool both_ways) {
    const auto around = neighbours(group);
    const double sum = edge_sum(group, around);
    for (const int other : around) push(group, other, sum);
    if (!both_ways) return;
    for (const int other : around) push(other, group, edge_sum(other));
  }

  void push(int from, int into, double edge_sum_of_from) {
    const Eigen::Vector3d target = positions_.row(into);
    const double shape = quadrics_[from].at(target) + quadrics_[into].at(target);
    const double sampling = (positions_.row(from) - positions_.row(into)).norm() * edge_sum_of_from;
    heap_.push({options_.shape_weight * shape + options_.sampling_weight * sampling, from, into,
                version_[from], version_[into]});
  }

  void merge(int from, int into) {
    ++edge_sums_[into].changes;
    const bool as_before = edge_sums_[into].current();
    const std::vector<int> gained = neighbours(from);
    for (const int other : gained) edge_sums_[other].exact = false;
    groups_.merge(from, into);
    quadrics_[into].add(quadrics_[from]);
    alive_[from] = false;
    if (!as_before) {
      ++version_[into];
      push_candidates_of(into, true);
      return;
    }
    for (const int other : gained) {
      if (other == into) continue;
      push(into, other, edge_sums_[into].length);
      push(other, into, edge_sum(other));
    }
  }

  const SurgeryOptions& options_;
  SurfacePartition groups_;
  Positions positions_;
  std::vector<int> version_;
  std::vector<char> alive_;
  std::vector<LineQuadric> quadrics_;
  std::vector<EdgeSum> edge_sums_;  // per group
  std::priority_queue<Candidate> heap_;
};

bool any_triangle_in_three(const Surface& surface, const Eigen::VectorXi& group) {
  const auto in_three = [&](const auto& t) {
    return group[t(0)] != group[t(1)] && group[t(1)] != group[t(2)] && group[t(2)] != group[t(0)];
  };
  const auto triangles = surface.triangles.rowwise();
  return std::any_of(triangles.begin(), triangles.end(), in_three);
}

/// Nothing where pieces do not meet along cut curves only, or one has a handle of its own.
std::optional<PartitionGraph> graph_by_cgal(const Surface& surface,
                                            const Contraction& contraction) {
  const Eigen::VectorXi group = cgal_surgery(contraction).node_of_vertex;
  if (any_triangle_in_three(surface, group)) return std::nullopt;
  const EdgeIndex index = index_edges(surface.triangles);
  PartitionGraph graph = partition_graph(surface, index, group);
  const std::vector<int> genus = genus_of_groups(surface, index, graph);
  if (std::any_of(genus.begin(), genus.end(), [](int g) { return g != 0; })) return std::nullopt;
  return graph;
}

void require_its_own(const Contraction& contraction, const Surface& surface) {
  require_sound(contraction.surface, "surgery");
  const Eigen::VectorXi& map = contraction.vertex_of_input;
  const Eigen::Index vertices = surface.positions.rows();
  if (map.size() == vertices && (map.array() >= 0).all() &&
      (map.array() < contraction.surface.positions.rows()).all()) {
    return;
  }
  throw Error(Fault::input, "surgery: the contraction is of another surface than that of " +
                                std::to_string(vertices) +
                                " vertices, needed its own; contract it again");
}

}  // namespace

void require_valid(const SurgeryOptions& options) {
  constexpr OptionRange weight{0, 1e6};
  const OptionCheck check("SurgeryOptions");
  check.choice("method", options.method, surgery_methods);
  check.number("shape_weight", options.shape_weight, weight);
  check.number("sampling_weight", options.sampling_weight, weight);
}

std::optional<PartitionGraph> surgery(const Surface& surface, const Contraction& contraction,
                                      const SurgeryOptions& options, const Monitor& monitor) {
  require_valid(options);
  require_closed_manifold(surface, "surgery", 1);
  require_its_own(contraction, surface);
  if (options.method == SurgeryMethod::cgal) return graph_by_cgal(surface, contraction);
  Surgeon surgeon(contraction.surface, options);
  surgeon.run(monitor);
  if (surgeon.groups().triples() > 0) return std::nullopt;

  // Collapses under the link condition keep cut curves closed, so the groups may be read off the
  // surface before its contraction.
  Eigen::VectorXi group_of_vertex(surface.positions.rows());
  for (Eigen::Index v = 0; v < group_of_vertex.size(); ++v) {
    group_of_vertex[v] = surgeon.groups().group_of(contraction.vertex_of_input[v]);
  }
  return partition_graph(surface, group_of_vertex);
}

}  // namespace curveskel
