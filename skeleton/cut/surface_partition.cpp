#include <curveskel/advanced/surface_partition.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>

namespace curveskel {

namespace {

bool is_inner(const std::array<int, 3>& groups) {
  return groups[0] == groups[1] && groups[1] == groups[2];
}

[[noreturn]] void refuse_partition(std::string_view purpose, const std::string& found,
                                   const std::string& needed) {
  throw Error(Fault::input, std::string(purpose) + ": found " + found + ", needed " + needed);
}

/// Throws unless each number is one of 0 .. count - 1.
template <typename Numbers>
void require_among(const Numbers& numbers, Eigen::Index count, std::string_view purpose,
                   std::string_view things) {
  for (const int number : numbers) {
    if (number >= 0 && number < count) continue;
    refuse_partition(purpose, "the number " + std::to_string(number),
                     "one of " + std::to_string(count) + " " + std::string(things));
  }
}

const Surface& with_corners(const Surface& surface) {
  require_corners(surface, "SurfacePartition");
  return surface;
}

}  // namespace

EdgeIndex index_edges(const Triangles& triangles) {
  struct Side {
    int high;
    int slot;  // 3 * triangle + corner
  };
  const auto ends_of = [&](Eigen::Index t, int k) {
    return std::minmax(triangles(t, (k + 1) % 3), triangles(t, (k + 2) % 3));
  };
  const int lowest = triangles.rows() > 0 ? triangles.minCoeff() : 0;
  const int highest = triangles.rows() > 0 ? triangles.maxCoeff() : -1;
  if (lowest < 0 || highest == std::numeric_limits<int>::max()) {
    refuse_partition("index_edges", "a corner " + std::to_string(lowest < 0 ? lowest : highest),
                     "corners that are vertices");
  }
  // In the order of their smaller ends; little is left to sort.
  const int vertices = std::max(highest + 1, 0);
  std::vector<std::size_t> begin(static_cast<std::size_t>(vertices) + 2, 0);  // one ahead at first
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) ++begin[static_cast<std::size_t>(ends_of(t, k).first) + 2];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Side> sides(begin.back());
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = ends_of(t, k);
      sides[begin[static_cast<std::size_t>(low) + 1]++] = {high, static_cast<int>(3 * t) + k};
    }
  }

  EdgeIndex index;
  index.edge_of_corner.resize(triangles.rows(), 3);
  index.edges.reserve(sides.size() / 2);
  for (int low = 0; low < vertices; ++low) {
    const auto from = static_cast<std::ptrdiff_t>(begin[static_cast<std::size_t>(low)]);
    const auto to = static_cast<std::ptrdiff_t>(begin[static_cast<std::size_t>(low) + 1]);
    std::sort(sides.begin() + from, sides.begin() + to, [](const Side& a, const Side& b) {
      return std::tie(a.high, a.slot) < std::tie(b.high, b.slot);
    });
    int last = -1;
    for (auto side = sides.begin() + from; side != sides.begin() + to; ++side) {
      if (side->high != last) index.edges.push_back({low, side->high});
      last = side->high;
      index.edge_of_corner(side->slot / 3, side->slot % 3) =
          static_cast<int>(index.edges.size()) - 1;
    }
  }
  return index;
}

SurfacePartition::SurfacePartition(const Surface& surface)
    : triangles_(with_corners(surface).triangles), index_(index_edges(surface.triangles)) {
  const auto vertices = static_cast<std::size_t>(surface.positions.rows());
  group_of_vertex_.resize(vertices);
  std::iota(group_of_vertex_.begin(), group_of_vertex_.end(), 0);
  members_.resize(vertices);
  for (std::size_t v = 0; v < vertices; ++v) members_[v] = {static_cast<int>(v)};
  boundary_.resize(vertices);
  for (int t = 0; t < triangles_.rows(); ++t) {
    for (int k = 0; k < 3; ++k) boundary_[triangles_(t, k)].push_back(t);
  }
  inner_.assign(vertices, 0);
  euler_.assign(vertices, 1);
  genus_.assign(vertices, 0);
  linked_ = UnionFind(static_cast<std::int64_t>(index_.edges.size()));
}

void SurfacePartition::require_groups(std::initializer_list<int> groups) const {
  for (const int group : groups) {
    if (group >= 0 && group < static_cast<int>(members_.size())) continue;
    throw std::out_of_range("SurfacePartition: found group " + std::to_string(group) +
                            ", needed one of " + std::to_string(members_.size()));
  }
}

std::array<int, 3> SurfacePartition::groups_at(int triangle) const {
  return {group_of_vertex_[triangles_(triangle, 0)], group_of_vertex_[triangles_(triangle, 1)],
          group_of_vertex_[triangles_(triangle, 2)]};
}

std::vector<int> SurfacePartition::triple_neighbours(int group) const {
  require_groups({group});
  std::vector<int> around;
  around.reserve(16);  // of two triangles each, most groups have eight or fewer
  for (const int t : boundary_[group]) {
    const auto g = groups_at(t);
    if (g[0] == g[1] || g[1] == g[2] || g[2] == g[0]) continue;
    for (const int other : g) {
      if (other != group) around.push_back(other);
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

bool SurfacePartition::share_triple(int a, int b) const {
  require_groups({a, b});
  const auto& shorter = shorter_boundary(a, b);
  return std::any_of(shorter.begin(), shorter.end(), [&](int t) {
    const auto g = groups_at(t);
    const bool three = g[0] != g[1] && g[1] != g[2] && g[2] != g[0];
    return three && std::find(g.begin(), g.end(), a) != g.end() &&
           std::find(g.begin(), g.end(), b) != g.end();
  });
}

int SurfacePartition::triples() const {
  int count = 0;
  for (int t = 0; t < triangles_.rows(); ++t) {
    const auto g = groups_at(t);
    if (g[0] != g[1] && g[1] != g[2] && g[2] != g[0]) ++count;
  }
  return count;
}

const std::vector<int>& SurfacePartition::shorter_boundary(int a, int b) const {
  return boundary_[boundary_[a].size() < boundary_[b].size() ? a : b];
}

std::vector<int> SurfacePartition::touching(int a, int b) const {
  std::vector<int> either;
  either.reserve(boundary_[a].size() + boundary_[b].size());
  for (const int t : boundary_[a]) {
    if (!is_inner(groups_at(t))) either.push_back(t);
  }
  for (const int t : boundary_[b]) {
    const auto g = groups_at(t);
    if (!is_inner(g) && std::find(g.begin(), g.end(), a) == g.end()) either.push_back(t);
  }
  return either;
}

int SurfacePartition::euler_of_union(int a, int b) const {
  // Triangles and edges that become interior; each such edge is seen from its two triangles. All
  // have corners in both groups.
  int faces = 0;
  int half_edges = 0;
  for (const int t : shorter_boundary(a, b)) {
    const auto g = groups_at(t);
    if (is_inner(g)) continue;
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      inside = inside && (g[k] == a || g[k] == b);
      const int p = g[(k + 1) % 3];
      const int q = g[(k + 2) % 3];
      if ((p == a && q == b) || (p == b && q == a)) ++half_edges;
    }
    if (inside) ++faces;
  }
  return euler_[a] + euler_[b] - half_edges / 2 + faces;
}

template <typename Crosses>
int SurfacePartition::curves_through(const std::vector<int>& triangles, const Crosses& crosses) {
  std::vector<int> crossing;
  int links = 0;
  for (const int t : triangles) {
    const auto g = groups_at(t);
    std::array<int, 3> edges{};
    std::size_t count = 0;
    for (int k = 0; k < 3; ++k) {
      if (crosses(g[(k + 1) % 3], g[(k + 2) % 3])) edges.at(count++) = index_.edge_of_corner(t, k);
    }
    crossing.insert(crossing.end(), edges.begin(), edges.begin() + count);
    if (count != 2) continue;
    links += linked_.unite(edges[0], edges[1]) ? 1 : 0;
  }
  std::sort(crossing.begin(), crossing.end());
  crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
  for (const int edge : crossing) linked_.isolate(edge);
  return static_cast<int>(crossing.size()) - links;
}

int SurfacePartition::genus_of_union(int a, int b) {
  require_groups({a, b});
  if (a == b) return genus_[a];
  // Pieces that meet along one curve, open or closed: genera add up.
  const int contacts = curves_through(shorter_boundary(a, b), [&](int p, int q) {
    return (p == a && q == b) || (p == b && q == a);
  });
  if (contacts == 1) return genus_[a] + genus_[b];
  // A triangle on the boundary has exactly two edges that cross it; linking them closes cut curves.
  const int curves = curves_through(
      touching(a, b), [&](int p, int q) { return (p == a || p == b) != (q == a || q == b); });
  return (2 - euler_of_union(a, b) - curves) / 2;
}

void SurfacePartition::merge(int from, int into) {
  require_groups({from, into});
  if (from == into) return;
  genus_[into] = genus_of_union(from, into);
  euler_[into] = euler_of_union(from, into);
  const bool from_is_longer = boundary_[from].size() > boundary_[into].size();
  const int longer = from_is_longer ? from : into;
  const int shorter = from_is_longer ? into : from;
  std::vector<int> joined = std::move(boundary_[longer]);
  int inner = inner_[longer];
  for (const int t : boundary_[shorter]) {
    const auto g = groups_at(t);
    if (is_inner(g)) continue;
    if (std::find(g.begin(), g.end(), longer) == g.end()) {
      joined.push_back(t);
    } else if (std::all_of(g.begin(), g.end(), [&](int n) { return n == from || n == into; })) {
      ++inner;
    }
  }
  for (const int v : members_[from]) group_of_vertex_[v] = into;
  members_[into].insert(members_[into].end(), members_[from].begin(), members_[from].end());
  members_[from] = {};
  boundary_[from] = {};
  if (2 * idx(inner) > joined.size()) {
    std::erase_if(joined, [&](int t) { return is_inner(groups_at(t)); });
    inner = 0;
  }
  boundary_[into] = std::move(joined);
  inner_[into] = inner;
}

namespace {

void require_indexed(const Surface& surface, const EdgeIndex& index) {
  require_corners(surface, "partition_graph");
  if (index.edge_of_corner.rows() != surface.triangles.rows()) {
    refuse_partition("partition_graph",
                     "edges of " + std::to_string(index.edge_of_corner.rows()) + " triangles",
                     "those of the surface's " + std::to_string(surface.triangles.rows()));
  }
  require_among(std::span(index.edge_of_corner.data(), idx(index.edge_of_corner.size())),
                std::ssize(index.edges), "partition_graph", "edges");
  for (const auto& ends : index.edges) {
    require_among(ends, surface.positions.rows(), "partition_graph", "vertices");
  }
}

/// Groups are named by numbers of vertices, or lower ones.
void require_groups_of(const Surface& surface, const Eigen::VectorXi& group_of_vertex) {
  const Eigen::Index vertices = surface.positions.rows();
  if (group_of_vertex.size() != vertices) {
    refuse_partition("partition_graph",
                     "groups of " + std::to_string(group_of_vertex.size()) + " vertices",
                     "those of the surface's " + std::to_string(vertices));
  }
  require_among(group_of_vertex, vertices, "partition_graph", "groups, as many as vertices");
}

/// The triangles' crossing edges linked into cut curves: for each crossing edge its neighbours
/// across its two triangles.
struct LinkedCrossings {
  std::vector<std::array<int, 2>> next;  // per edge, -1 = not crossing
};

LinkedCrossings link_crossings(const Triangles& triangles, const EdgeIndex& index,
                               const Eigen::VectorXi& group) {
  LinkedCrossings crossings;
  crossings.next.assign(index.edges.size(), {-1, -1});
  const auto attach = [&](int edge, int other) {
    auto& next = crossings.next[static_cast<std::size_t>(edge)];
    (next[0] < 0 ? next[0] : next[1]) = other;
  };
  for (int t = 0; t < triangles.rows(); ++t) {
    std::array<int, 3> crossing{};
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      const int p = group[triangles(t, (k + 1) % 3)];
      const int q = group[triangles(t, (k + 2) % 3)];
      if (p != q) crossing[static_cast<std::size_t>(count++)] = index.edge_of_corner(t, k);
    }
    if (count == 3) {
      refuse_partition("partition_graph", "triangle " + std::to_string(t) + " in three groups",
                       "groups that meet along cut curves");
    }
    if (count != 2) continue;
    attach(crossing[0], crossing[1]);
    attach(crossing[1], crossing[0]);
  }
  for (std::size_t e = 0; e < crossings.next.size(); ++e) {
    if (crossings.next[e][0] < 0 || crossings.next[e][1] >= 0) continue;
    refuse_partition("partition_graph", "a cut curve that ends at edge " + std::to_string(e),
                     "a closed surface, on which each goes round");
  }
  return crossings;
}

}  // namespace

PartitionGraph partition_graph(const Surface& surface, const Eigen::VectorXi& group_of_vertex) {
  return partition_graph(surface, index_edges(surface.triangles), group_of_vertex);
}

PartitionGraph partition_graph(const Surface& surface, const EdgeIndex& index,
                               const Eigen::VectorXi& group_of_vertex) {
  require_indexed(surface, index);
  require_groups_of(surface, group_of_vertex);
  PartitionGraph graph;
  graph.group_of_vertex.resize(group_of_vertex.size());
  std::vector<int> number(idx(group_of_vertex.size()), -1);
  for (Eigen::Index v = 0; v < group_of_vertex.size(); ++v) {
    int& n = number[static_cast<std::size_t>(group_of_vertex[v])];
    if (n < 0) n = graph.groups++;
    graph.group_of_vertex[v] = n;
  }

  const LinkedCrossings crossings = link_crossings(surface.triangles, index, graph.group_of_vertex);
  std::vector<char> seen(index.edges.size(), 0);
  std::vector<std::array<int, 2>> edges;
  for (std::size_t first = 0; first < index.edges.size(); ++first) {
    if (crossings.next[first][0] < 0 || seen[first] != 0) continue;
    const int node = graph.groups + static_cast<int>(graph.cut_curves.size());
    auto& cut_curve = graph.cut_curves.emplace_back();
    for (int edge = static_cast<int>(first); seen[static_cast<std::size_t>(edge)] == 0;) {
      const auto e = static_cast<std::size_t>(edge);
      seen[e] = 1;
      cut_curve.push_back(index.edges[e]);
      const auto& next = crossings.next[e];
      edge = seen[static_cast<std::size_t>(next[0])] == 0 ? next[0] : next[1];
    }
    for (const int end : index.edges[first]) edges.push_back({graph.group_of_vertex[end], node});
  }
  std::sort(edges.begin(), edges.end());
  graph.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    graph.edges.row(static_cast<Eigen::Index>(e)) << edges[e][0], edges[e][1];
  }
  return graph;
}

Positions middles_of_groups(const PartitionGraph& graph, const Positions& positions) {
  const std::string_view purpose = "middles_of_groups";
  if (graph.group_of_vertex.size() != positions.rows()) {
    refuse_partition(purpose,
                     "groups of " + std::to_string(graph.group_of_vertex.size()) + " vertices",
                     "those of " + std::to_string(positions.rows()) + " positions");
  }
  require_among(graph.group_of_vertex, graph.groups, purpose, "groups");
  for (const auto& cut_curve : graph.cut_curves) {
    for (const auto& ends : cut_curve) require_among(ends, positions.rows(), purpose, "vertices");
  }
  Positions middles = Positions::Zero(graph.nodes(), 3);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(graph.nodes());
  const auto count_in = [&](int node, int vertex) {
    middles.row(node) += positions.row(vertex);
    counts[node] += 1;
  };
  for (Eigen::Index v = 0; v < graph.group_of_vertex.size(); ++v) {
    count_in(graph.group_of_vertex[v], static_cast<int>(v));
  }
  for (std::size_t c = 0; c < graph.cut_curves.size(); ++c) {
    for (const auto& [a, b] : graph.cut_curves[c]) {
      count_in(graph.groups + static_cast<int>(c), a);
      count_in(graph.groups + static_cast<int>(c), b);
    }
  }
  if (!(counts.array() > 0).all()) {
    refuse_partition(purpose, "a group or a cut curve without vertices", "some in each");
  }
  return middles.array().colwise() / counts.array();
}

}  // namespace curveskel
