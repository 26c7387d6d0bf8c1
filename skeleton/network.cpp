#include "skeleton/network.hpp"

#include "surface/element_index.hpp"

#include <algorithm>
#include <utility>

namespace curveskel {
namespace {

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void attach(Hub& hub, int strand) {
  const auto place = std::lower_bound(hub.strands.begin(), hub.strands.end(), strand);
  if (place == hub.strands.end() || *place != strand) hub.strands.insert(place, strand);
}

void detach(Hub& hub, int strand) { std::erase(hub.strands, strand); }

}  // namespace

int Network::degree(int hub) const {
  int count = 0;
  for (const int s : hubs[at(hub)].strands) {
    const Strand& strand = strands[at(s)];
    count += static_cast<int>(strand.from == hub) + static_cast<int>(strand.to == hub);
  }
  return count;
}

bool Network::is_leaf(const Strand& strand) const {
  return strand.alive && (degree(strand.from) == 1) != (degree(strand.to) == 1);
}

int Network::living_strands() const {
  return static_cast<int>(
      std::count_if(strands.begin(), strands.end(), [](const Strand& s) { return s.alive; }));
}

std::vector<Point> Network::polyline(const Strand& strand) const {
  std::vector<Point> line;
  line.reserve(strand.points.size() + 2);
  line.push_back(hubs[at(strand.from)].position);
  append(line, strand.points);
  line.push_back(hubs[at(strand.to)].position);
  return line;
}

double Network::length(const Strand& strand) const {
  const auto line = polyline(strand);
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

void Network::orient_from(int strand, int hub) {
  Strand& s = strands[at(strand)];
  if (s.from == hub) return;
  std::swap(s.from, s.to);
  std::reverse(s.points.begin(), s.points.end());
  std::reverse(s.nodes.begin(), s.nodes.end());
}

void Network::prune(int strand) {
  Strand& s = strands[at(strand)];
  const int tip = degree(s.from) == 1 ? s.from : s.to;
  const int base = tip == s.from ? s.to : s.from;
  append(hubs[at(base)].nodes, s.nodes);
  append(hubs[at(base)].nodes, hubs[at(tip)].nodes);
  s.alive = false;
  hubs[at(tip)].alive = false;
  hubs[at(tip)].strands.clear();
  detach(hubs[at(base)], strand);
  if (degree(base) == 2) dissolve(base);
}

void Network::collapse(int strand, int into, const Point& position) {
  Strand& s = strands[at(strand)];
  const int gone = s.from == into ? s.to : s.from;
  append(hubs[at(into)].nodes, s.nodes);
  append(hubs[at(into)].nodes, hubs[at(gone)].nodes);
  s.alive = false;
  hubs[at(gone)].alive = false;
  hubs[at(into)].position = position;
  detach(hubs[at(into)], strand);
  detach(hubs[at(gone)], strand);
  for (const int other : hubs[at(gone)].strands) {
    if (strands[at(other)].from == gone) strands[at(other)].from = into;
    if (strands[at(other)].to == gone) strands[at(other)].to = into;
    attach(hubs[at(into)], other);
  }
  hubs[at(gone)].strands.clear();
}

void Network::dissolve(int hub) {
  const std::vector<int> around = hubs[at(hub)].strands;
  if (around.size() != 2) return;  // a closed curve keeps its hub
  orient_from(around[1], hub);
  Strand& first = strands[at(around[0])];
  Strand& second = strands[at(around[1])];
  if (first.to != hub) orient_from(around[0], first.to);
  first.points.push_back(hubs[at(hub)].position);
  append(first.points, second.points);
  append(first.nodes, hubs[at(hub)].nodes);
  append(first.nodes, second.nodes);
  first.to = second.to;
  second.alive = false;
  hubs[at(hub)].alive = false;
  hubs[at(hub)].strands.clear();
  detach(hubs[at(first.to)], around[1]);
  attach(hubs[at(first.to)], around[0]);
}

void Network::end_in_ring(int strand, std::size_t cut, std::vector<Point> way,
                          std::vector<Point> ring) {
  const auto hub = static_cast<int>(hubs.size());
  const auto closed = static_cast<int>(strands.size());
  hubs.push_back({way.back(), {}});
  way.pop_back();
  Strand& s = strands[at(strand)];
  const int end = std::exchange(s.to, hub);
  s.points = std::move(way);
  const auto first = s.nodes.begin() + static_cast<std::ptrdiff_t>(cut);
  std::vector<int> nodes(first, s.nodes.end());
  s.nodes.erase(first, s.nodes.end());
  if (s.from != end) detach(hubs[at(end)], strand);
  attach(hubs[at(hub)], strand);
  attach(hubs[at(hub)], closed);
  ring.erase(ring.begin());
  strands.push_back({hub, hub, std::move(ring), std::move(nodes)});
}

int Network::split(int strand, std::size_t segment, const Point& place) {
  const auto hub = static_cast<int>(hubs.size());
  const auto rest = static_cast<int>(strands.size());
  hubs.push_back({place, {}});
  Strand& first = strands[at(strand)];
  Strand second = first;
  const auto cut = static_cast<std::ptrdiff_t>(segment);
  second.from = hub;
  second.points.erase(second.points.begin(), second.points.begin() + cut);
  first.points.resize(segment);
  const int end = std::exchange(first.to, hub);
  if (first.from != end) detach(hubs[at(end)], strand);
  attach(hubs[at(end)], rest);
  attach(hubs[at(hub)], strand);
  attach(hubs[at(hub)], rest);
  strands.push_back(std::move(second));
  return hub;
}

int Network::add_leaf(int base, const Point& tip, std::vector<int> groups) {
  const bool goes_on = degree(base) == 1;
  const auto end = static_cast<int>(hubs.size());
  const auto strand = static_cast<int>(strands.size());
  hubs.push_back({tip, {}});
  strands.push_back({base, end, {}, goes_on ? std::vector<int>{} : std::move(groups)});
  attach(hubs[at(end)], strand);
  attach(hubs[at(base)], strand);
  if (goes_on) dissolve(base);
  return end;
}

Network network_of_graph(const VertexGraph& graph, const std::vector<Point>& positions) {
  const int nodes = graph.nodes();
  std::vector<std::vector<int>> neighbours(at(nodes));
  for (Eigen::Index e = 0; e < graph.edges.rows(); ++e) {
    const auto a = graph.edges(e, 0);
    const auto b = graph.edges(e, 1);
    neighbours[at(a)].push_back(b);
    neighbours[at(b)].push_back(a);
  }

  Network network;
  std::vector<int> hub_of_node(at(nodes), -1);
  std::vector<char> used(at(nodes), 0);
  const auto make_hub = [&](int node) {
    hub_of_node[at(node)] = static_cast<int>(network.hubs.size());
    network.hubs.push_back({positions[at(node)], {node}});
  };
  const auto trace = [&](int start, int next) {
    Strand strand;
    strand.from = hub_of_node[at(start)];
    int previous = start;
    int node = next;
    while (hub_of_node[at(node)] < 0) {
      used[at(node)] = 1;
      strand.points.push_back(positions[at(node)]);
      strand.nodes.push_back(node);
      // A chain node has two neighbours; both are `previous` only in a two-node cycle.
      const auto& around = neighbours[at(node)];
      const int following = around[0] == previous ? around[1] : around[0];
      previous = std::exchange(node, following);
    }
    strand.to = hub_of_node[at(node)];
    const auto index = static_cast<int>(network.strands.size());
    attach(network.hubs[at(strand.from)], index);
    attach(network.hubs[at(strand.to)], index);
    network.strands.push_back(std::move(strand));
  };

  for (int node = 0; node < nodes; ++node) {
    if (neighbours[at(node)].size() != 2) make_hub(node);
  }
  for (int node = 0; node < nodes; ++node) {
    if (hub_of_node[at(node)] < 0) continue;
    // Circles have degree 2, so a neighbour is never a hub itself.
    for (const int next : neighbours[at(node)]) {
      if (used[at(next)] == 0) trace(node, next);
    }
  }
  for (int node = 0; node < graph.groups; ++node) {
    if (used[at(node)] != 0 || hub_of_node[at(node)] >= 0) continue;
    make_hub(node);
    trace(node, neighbours[at(node)][0]);
  }
  return network;
}

NetworkNodes nodes_of_network(const Network& network, int groups) {
  NetworkNodes result;
  std::vector<Point> points;
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<int> node_of_hub(network.hubs.size(), -1);
  for (std::size_t h = 0; h < network.hubs.size(); ++h) {
    if (!network.hubs[h].alive) continue;
    node_of_hub[h] = static_cast<int>(points.size());
    points.push_back(network.hubs[h].position);
  }
  result.group_nodes.resize(at(groups));
  const auto claim = [&](const std::vector<int>& graph_nodes, const std::vector<int>& line) {
    for (const int node : graph_nodes) {
      if (node < groups) append(result.group_nodes[at(node)], line);
    }
  };
  for (const Strand& strand : network.strands) {
    if (!strand.alive) continue;
    std::vector<int> line{node_of_hub[at(strand.from)]};
    for (const Point& point : strand.points) {
      line.push_back(static_cast<int>(points.size()));
      points.push_back(point);
    }
    line.push_back(node_of_hub[at(strand.to)]);
    for (std::size_t i = 1; i < line.size(); ++i) {
      edges.push_back({std::min(line[i - 1], line[i]), std::max(line[i - 1], line[i])});
    }
    claim(strand.nodes, line);
    claim(network.hubs[at(strand.from)].nodes, line);
    claim(network.hubs[at(strand.to)].nodes, line);
  }
  for (std::size_t h = 0; h < network.hubs.size(); ++h) {
    if (network.hubs[h].alive) claim(network.hubs[h].nodes, {node_of_hub[h]});
  }
  for (auto& nodes : result.group_nodes) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  std::sort(edges.begin(), edges.end());

  CurveSkeleton& skeleton = result.skeleton;
  skeleton.nodes.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    skeleton.nodes.row(static_cast<Eigen::Index>(i)) = points[i];
  }
  skeleton.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    skeleton.edges.row(static_cast<Eigen::Index>(e)) << edges[e][0], edges[e][1];
  }
  return result;
}

}  // namespace curveskel
