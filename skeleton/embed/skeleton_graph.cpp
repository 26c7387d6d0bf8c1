#include "skeleton/embed/skeleton_graph.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include "skeleton/graph/node_balls.hpp"

namespace curveskel {
namespace {

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void attach(Node& node, int arc) {
  const auto place = std::lower_bound(node.arcs.begin(), node.arcs.end(), arc);
  if (place == node.arcs.end() || *place != arc) node.arcs.insert(place, arc);
}

void detach(Node& node, int arc) { std::erase(node.arcs, arc); }

/// One value for each point of an arc, nodes included, in order.
template <typename Of>
auto along(const SkeletonGraph& graph, const Arc& arc, const Of& of) {
  std::vector<decltype(of(CurvePoint()))> values;
  values.reserve(arc.points.size() + 2);
  values.push_back(of(graph.nodes[idx(arc.from)].point));
  for (const CurvePoint& point : arc.points) values.push_back(of(point));
  values.push_back(of(graph.nodes[idx(arc.to)].point));
  return values;
}

/// Points become nodes; their radii are measured if there is a tree.
CurveSkeleton curve_through(const std::vector<const CurvePoint*>& points,
                            const std::vector<std::array<std::int32_t, 2>>& edges,
                            const SurfaceTree* tree) {
  CurveSkeleton skeleton;
  skeleton.nodes.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    skeleton.nodes.row(static_cast<Eigen::Index>(i)) = points[i]->place();
  }
  if (tree != nullptr) {
    skeleton.radii.resize(skeleton.nodes.rows());
    for (std::size_t i = 0; i < points.size(); ++i) {
      skeleton.radii[static_cast<Eigen::Index>(i)] = std::max(0.0, points[i]->radius(*tree));
    }
  }
  skeleton.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    skeleton.edges.row(static_cast<Eigen::Index>(e)) << edges[e][0], edges[e][1];
  }
  return skeleton;
}

}  // namespace

int SkeletonGraph::degree(int node) const {
  int count = 0;
  for (const int s : nodes[idx(node)].arcs) {
    const Arc& arc = arcs[idx(s)];
    count += static_cast<int>(arc.from == node) + static_cast<int>(arc.to == node);
  }
  return count;
}

bool SkeletonGraph::is_leaf(const Arc& arc) const {
  return arc.alive && (degree(arc.from) == 1) != (degree(arc.to) == 1);
}

int SkeletonGraph::living_arcs() const {
  return static_cast<int>(
      std::count_if(arcs.begin(), arcs.end(), [](const Arc& s) { return s.alive; }));
}

const Point& SkeletonGraph::place(int node) const { return nodes[idx(node)].point.place(); }

std::vector<Point> SkeletonGraph::polyline(const Arc& arc) const {
  return along(*this, arc, [](const CurvePoint& point) { return point.place(); });
}

std::vector<double> SkeletonGraph::radii_along(const Arc& arc, const SurfaceTree& tree) const {
  return along(*this, arc, [&](const CurvePoint& point) { return point.radius(tree); });
}

std::vector<CurvePoint> SkeletonGraph::points_along(const Arc& arc, const SurfaceTree& tree) const {
  return along(*this, arc, [&](const CurvePoint& point) {
    point.radius(tree);
    return point;
  });
}

void SkeletonGraph::forget_radii() {
  for (Node& node : nodes) node.point.forget_radius();
  for (Arc& arc : arcs) {
    for (CurvePoint& point : arc.points) point.forget_radius();
  }
}

double SkeletonGraph::length(const Arc& arc) const {
  const auto line = polyline(arc);
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

void SkeletonGraph::orient_from(int arc, int node) {
  Arc& s = arcs[idx(arc)];
  if (s.from == node) return;
  std::swap(s.from, s.to);
  std::reverse(s.points.begin(), s.points.end());
  std::reverse(s.pieces.begin(), s.pieces.end());
}

void SkeletonGraph::prune(int arc) {
  const int base = take_off(arc);
  if (degree(base) == 2) dissolve(base);
}

int SkeletonGraph::take_off(int arc) {
  Arc& s = arcs[idx(arc)];
  const int tip = degree(s.from) == 1 ? s.from : s.to;
  const int base = tip == s.from ? s.to : s.from;
  append(nodes[idx(base)].pieces, s.pieces);
  append(nodes[idx(base)].pieces, nodes[idx(tip)].pieces);
  s.alive = false;
  nodes[idx(tip)].alive = false;
  nodes[idx(tip)].arcs.clear();
  detach(nodes[idx(base)], arc);
  return base;
}

void SkeletonGraph::collapse(int arc, int into, const CurvePoint& point) {
  Arc& s = arcs[idx(arc)];
  const int gone = s.from == into ? s.to : s.from;
  append(nodes[idx(into)].pieces, s.pieces);
  append(nodes[idx(into)].pieces, nodes[idx(gone)].pieces);
  s.alive = false;
  nodes[idx(gone)].alive = false;
  nodes[idx(into)].point = point;
  detach(nodes[idx(into)], arc);
  detach(nodes[idx(gone)], arc);
  for (const int other : nodes[idx(gone)].arcs) {
    if (arcs[idx(other)].from == gone) arcs[idx(other)].from = into;
    if (arcs[idx(other)].to == gone) arcs[idx(other)].to = into;
    attach(nodes[idx(into)], other);
  }
  nodes[idx(gone)].arcs.clear();
}

void SkeletonGraph::dissolve(int node) {
  const std::vector<int> around = nodes[idx(node)].arcs;
  if (around.size() != 2) return;  // a closed curve keeps its node
  orient_from(around[1], node);
  Arc& first = arcs[idx(around[0])];
  Arc& second = arcs[idx(around[1])];
  if (first.to != node) orient_from(around[0], first.to);
  first.points.push_back(nodes[idx(node)].point);
  append(first.points, second.points);
  append(first.pieces, nodes[idx(node)].pieces);
  append(first.pieces, second.pieces);
  first.to = second.to;
  second.alive = false;
  nodes[idx(node)].alive = false;
  nodes[idx(node)].arcs.clear();
  detach(nodes[idx(first.to)], around[1]);
  attach(nodes[idx(first.to)], around[0]);
}

void SkeletonGraph::end_in_ring(int arc, std::size_t cut, std::vector<Point> way,
                                const std::vector<Point>& ring) {
  const auto node = static_cast<int>(nodes.size());
  const auto closed = static_cast<int>(arcs.size());
  nodes.push_back({way.back(), {}});
  way.pop_back();
  Arc& s = arcs[idx(arc)];
  const int end = std::exchange(s.to, node);
  s.points.assign(way.begin(), way.end());
  const auto first = s.pieces.begin() + static_cast<std::ptrdiff_t>(cut);
  std::vector<int> pieces(first, s.pieces.end());
  s.pieces.erase(first, s.pieces.end());
  if (s.from != end) detach(nodes[idx(end)], arc);
  attach(nodes[idx(node)], arc);
  attach(nodes[idx(node)], closed);
  arcs.push_back({node, node, {ring.begin() + 1, ring.end()}, std::move(pieces)});
}

bool SkeletonGraph::turn_half_way_round(int arc) {
  Arc& closed = arcs[idx(arc)];
  if (!closed.alive || closed.from != closed.to || degree(closed.from) != 2) return false;
  if (closed.points.empty()) return false;
  CurvePoint& node = nodes[idx(closed.from)].point;
  const auto middle = closed.points.begin() + static_cast<std::ptrdiff_t>(closed.points.size() / 2);
  std::vector<CurvePoint> turned(middle + 1, closed.points.end());
  turned.push_back(node);
  turned.insert(turned.end(), closed.points.begin(), middle);
  node = *middle;
  closed.points = std::move(turned);
  return true;
}

int SkeletonGraph::split(int arc, std::size_t segment, const Point& place) {
  const auto node = static_cast<int>(nodes.size());
  const auto rest = static_cast<int>(arcs.size());
  nodes.push_back({place, {}});
  Arc& first = arcs[idx(arc)];
  Arc second = first;
  const auto cut = static_cast<std::ptrdiff_t>(segment);
  second.from = node;
  second.points.erase(second.points.begin(), second.points.begin() + cut);
  first.points.resize(segment);
  const int end = std::exchange(first.to, node);
  if (first.from != end) detach(nodes[idx(end)], arc);
  attach(nodes[idx(end)], rest);
  attach(nodes[idx(node)], arc);
  attach(nodes[idx(node)], rest);
  arcs.push_back(std::move(second));
  return node;
}

int SkeletonGraph::add_leaf(int base, const Point& tip, std::vector<int> groups) {
  const bool goes_on = degree(base) == 1;
  const auto end = static_cast<int>(nodes.size());
  const auto arc = static_cast<int>(arcs.size());
  nodes.push_back({tip, {}});
  arcs.push_back({base, end, {}, goes_on ? std::vector<int>{} : std::move(groups)});
  attach(nodes[idx(end)], arc);
  attach(nodes[idx(base)], arc);
  if (goes_on) dissolve(base);
  return end;
}

SkeletonGraph skeleton_graph_of(const PartitionGraph& partition,
                                const std::vector<Point>& positions) {
  const int pieces = partition.nodes();
  const Graph adjacency = graph_of(pieces, partition.edges);

  SkeletonGraph graph;
  std::vector<int> node_of_piece(idx(pieces), -1);
  std::vector<char> used(idx(pieces), 0);
  const auto make_node = [&](int piece) {
    node_of_piece[idx(piece)] = static_cast<int>(graph.nodes.size());
    graph.nodes.push_back({positions[idx(piece)], {piece}});
  };
  const auto trace = [&](int start, int next) {
    Arc arc;
    arc.from = node_of_piece[idx(start)];
    int previous = start;
    int piece = next;
    while (node_of_piece[idx(piece)] < 0) {
      used[idx(piece)] = 1;
      arc.points.push_back(positions[idx(piece)]);
      arc.pieces.push_back(piece);
      // A chain piece has two neighbours; both are `previous` only in a two-piece cycle.
      const auto around = adjacency.neighbours(piece);
      const int following = around[0] == previous ? around[1] : around[0];
      previous = std::exchange(piece, following);
    }
    arc.to = node_of_piece[idx(piece)];
    const auto index = static_cast<int>(graph.arcs.size());
    attach(graph.nodes[idx(arc.from)], index);
    attach(graph.nodes[idx(arc.to)], index);
    graph.arcs.push_back(std::move(arc));
  };

  for (int piece = 0; piece < pieces; ++piece) {
    if (adjacency.degree(piece) != 2) make_node(piece);
  }
  for (int piece = 0; piece < pieces; ++piece) {
    if (node_of_piece[idx(piece)] < 0) continue;
    // Cut curves have degree 2, so a neighbour is never a node itself.
    for (const int next : adjacency.neighbours(piece)) {
      if (used[idx(next)] == 0) trace(piece, next);
    }
  }
  for (int piece = 0; piece < partition.groups; ++piece) {
    if (used[idx(piece)] != 0 || node_of_piece[idx(piece)] >= 0) continue;
    make_node(piece);
    trace(piece, adjacency.neighbours(piece)[0]);
  }
  return graph;
}

EmbeddedNodes skeleton_of(const SkeletonGraph& graph, int groups, const SurfaceTree* tree) {
  EmbeddedNodes result;
  std::vector<const CurvePoint*> points;
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<int> row_of_node(graph.nodes.size(), -1);
  for (std::size_t h = 0; h < graph.nodes.size(); ++h) {
    if (!graph.nodes[h].alive) continue;
    row_of_node[h] = static_cast<int>(points.size());
    points.push_back(&graph.nodes[h].point);
  }
  result.nodes_of_group.resize(idx(groups));
  const auto claim = [&](const std::vector<int>& pieces, const std::vector<int>& line) {
    for (const int piece : pieces) {
      if (piece < groups) append(result.nodes_of_group[idx(piece)], line);
    }
  };
  for (const Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    std::vector<int> line{row_of_node[idx(arc.from)]};
    for (const CurvePoint& point : arc.points) {
      line.push_back(static_cast<int>(points.size()));
      points.push_back(&point);
    }
    line.push_back(row_of_node[idx(arc.to)]);
    for (std::size_t i = 1; i < line.size(); ++i) {
      edges.push_back({std::min(line[i - 1], line[i]), std::max(line[i - 1], line[i])});
    }
    claim(arc.pieces, line);
    claim(graph.nodes[idx(arc.from)].pieces, line);
    claim(graph.nodes[idx(arc.to)].pieces, line);
  }
  for (std::size_t h = 0; h < graph.nodes.size(); ++h) {
    if (graph.nodes[h].alive) claim(graph.nodes[h].pieces, {row_of_node[h]});
  }
  for (auto& nodes : result.nodes_of_group) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  std::sort(edges.begin(), edges.end());

  result.skeleton = curve_through(points, edges, tree);
  return result;
}

Eigen::VectorXi nearest_nodes(const EmbeddedNodes& nodes, const Eigen::VectorXi& group_of_vertex,
                              const Positions& places) {
  std::optional<NodeBalls> all;
  Eigen::VectorXi node_of_vertex = Eigen::VectorXi::Constant(group_of_vertex.size(), -1);
  for (Eigen::Index v = 0; v < node_of_vertex.size(); ++v) {
    const std::vector<int>& own = nodes.nodes_of_group[idx(group_of_vertex[v])];
    if (own.empty()) {
      if (!all) all.emplace(nodes.skeleton);
      node_of_vertex[v] = all->nearest(places.row(v).transpose());
      continue;
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const int node : own) {
      const double distance = (nodes.skeleton.nodes.row(node) - places.row(v)).squaredNorm();
      if (distance < nearest) {
        nearest = distance;
        node_of_vertex[v] = node;
      }
    }
  }
  return node_of_vertex;
}

}  // namespace curveskel
