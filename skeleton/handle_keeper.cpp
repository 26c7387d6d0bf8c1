#include "skeleton/handle_keeper.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "skeleton/shorten.hpp"
#include "surface/element_index.hpp"

namespace curveskel {

std::vector<int> core(const Network& network) {
  std::vector<int> degree(network.hubs.size(), 0);
  std::vector<char> left(network.strands.size(), 0);
  for (std::size_t s = 0; s < network.strands.size(); ++s) {
    const Strand& strand = network.strands[s];
    if (!strand.alive) continue;
    left[s] = 1;
    ++degree[at(strand.from)];
    ++degree[at(strand.to)];
  }
  std::vector<int> tips;
  for (std::size_t h = 0; h < degree.size(); ++h) {
    if (degree[h] == 1) tips.push_back(static_cast<int>(h));
  }
  while (!tips.empty()) {
    const int tip = tips.back();
    tips.pop_back();
    for (const int s : network.hubs[at(tip)].strands) {
      if (left[at(s)] == 0) continue;
      left[at(s)] = 0;
      const Strand& strand = network.strands[at(s)];
      const int other = strand.from == tip ? strand.to : strand.from;
      if (--degree[at(other)] == 1) tips.push_back(other);
    }
  }
  std::vector<int> result;
  for (std::size_t s = 0; s < left.size(); ++s) {
    if (left[s] != 0) result.push_back(static_cast<int>(s));
  }
  return result;
}

namespace {

bool same_ends(const Strand& a, const Strand& b) {
  return a.alive && b.alive && a.from == b.from && a.to == b.to;
}

/// The place of a strand's point k, counted along its polyline.
Point& point_of(Network& network, int strand, std::size_t k) {
  Strand& s = network.strands[at(strand)];
  if (k == 0) return network.hubs[at(s.from)].position;
  if (k == s.points.size() + 1) return network.hubs[at(s.to)].position;
  return s.points[k - 1];
}

bool any_crosses(const SurfaceTree& tree, const std::vector<Point>& line) {
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    if (crosses(tree, line[k], line[k + 1])) return true;
  }
  return false;
}

bool put_back(Point& now, const Point& before) {
  if (now == before) return false;
  now = before;
  return true;
}

}  // namespace

bool crosses(const SurfaceTree& tree, const Point& from, const Point& to) {
  const double length = (to - from).norm();
  return length > 0 && tree.ray(from, (to - from) / length, length).triangle >= 0;
}

HandleKeeper::HandleKeeper(const Surface& surface) {
  const Eigen::Index euler = surface.positions.rows() - surface.triangles.rows() / 2;
  if (euler != 2) classes_.emplace(surface);
}

void HandleKeeper::restore_strands(const Network& before, Network& network,
                                   const SurfaceTree& tree) {
  if (!has_handles()) return;
  const auto strands = core(before);
  for (bool changed = true; changed;) {
    changed = false;
    for (const int s : strands) {
      const Strand& old = before.strands[at(s)];
      Strand& strand = network.strands[at(s)];
      if (!same_ends(old, strand)) continue;
      const auto was = before.polyline(old);
      const auto is = network.polyline(strand);
      if (was == is) continue;
      const bool stays =
          classes_->alike(was, is) && (!any_crosses(tree, is) || any_crosses(tree, was));
      if (stays) continue;
      strand.points = old.points;
      network.hubs[at(strand.from)].position = was.front();
      network.hubs[at(strand.to)].position = was.back();
      changed = true;
    }
  }
}

void HandleKeeper::pull_taut(Network& network, const SurfaceTree& tree) {
  constexpr double clearance = 0.5;
  constexpr int places = 16;  // along a chord
  const auto line_of_sight = [&](const std::vector<Point>& way) {
    const Point& from = way.front();
    const Point& to = way.back();
    if (crosses(tree, from, to)) return false;
    const double least =
        clearance * std::min(tree.inscribed_radius(from), tree.inscribed_radius(to));
    for (int k = 1; k < places; ++k) {
      const double share = static_cast<double>(k) / places;
      if (tree.inscribed_radius(from + share * (to - from)) < least) return false;
    }
    return classes_->alike(way, {from, to});
  };
  for (const int s : core(network)) {
    Strand& strand = network.strands[at(s)];
    const auto line = network.polyline(strand);
    const auto taut = shortened(line, [&](std::size_t first, std::size_t last) {
      const auto begin = line.begin();
      return line_of_sight({begin + static_cast<std::ptrdiff_t>(first),
                            begin + static_cast<std::ptrdiff_t>(last + 1)});
    });
    const std::size_t fewest = strand.from == strand.to ? 4 : 2;  // a closed one stays a polygon
    if (taut.size() >= fewest) strand.points.assign(taut.begin() + 1, taut.end() - 1);
  }
}

void HandleKeeper::collapse(Network& network, int strand, int into, const Point& position) {
  if (!has_handles()) {
    network.collapse(strand, into, position);
    return;
  }
  network.orient_from(strand, into);
  const auto line = network.polyline(network.strands[at(strand)]);  // from `into` to what goes
  const int gone = network.strands[at(strand)].to;
  std::array<std::vector<Point>, 2> way;  // from either end of the strand to the new place
  way[0] = {line.front()};
  way[1].assign(line.rbegin(), line.rend());
  if (position == line.back()) {
    way[0] = line;
    way[1] = {line.back()};
  }
  // Before the hubs become one: what has to be put in where a strand ended.
  struct End {
    int strand;
    bool at_begin;
    std::vector<Point> points;
  };
  std::vector<End> ends;
  for (const int hub : {into, gone}) {
    const auto& to_new_place = way[hub == into ? 0 : 1];
    for (const int s : network.hubs[at(hub)].strands) {
      if (s == strand) continue;
      const auto course = network.polyline(network.strands[at(s)]);
      for (const bool at_begin : {true, false}) {
        const Strand& other = network.strands[at(s)];
        if ((at_begin ? other.from : other.to) != hub) continue;
        std::vector<Point> old{at_begin ? course[1] : course[course.size() - 2]};
        const Point next = old.front();
        old.insert(old.end(), to_new_place.begin(), to_new_place.end());
        if (classes_->alike(old, {next, position})) continue;
        ends.push_back({s, at_begin, {to_new_place.begin(), to_new_place.end() - 1}});
      }
    }
  }
  network.collapse(strand, into, position);
  for (auto& [s, at_begin, points] : ends) {
    auto& inner = network.strands[at(s)].points;
    if (at_begin) std::reverse(points.begin(), points.end());
    inner.insert(at_begin ? inner.begin() : inner.end(), points.begin(), points.end());
  }
}

std::vector<int> HandleKeeper::restore_points(const Network& before, Network& network,
                                              const SurfaceTree& tree) {
  std::vector<int> restored;
  if (!has_handles()) return restored;
  const auto strands = core(before);
  for (bool changed = true; changed;) {
    changed = false;
    for (const int s : strands) {
      const Strand& old = before.strands[at(s)];
      if (!same_ends(old, network.strands[at(s)])) continue;
      const auto was = before.polyline(old);
      const auto is = network.polyline(network.strands[at(s)]);
      bool here = false;
      for (std::size_t k = 0; k + 1 < was.size(); ++k) {
        if (was[k] == is[k] && was[k + 1] == is[k + 1]) continue;
        const bool stays = classes_->alike({was[k], was[k + 1]}, {is[k], is[k + 1]}) &&
                           (!crosses(tree, is[k], is[k + 1]) || crosses(tree, was[k], was[k + 1]));
        if (stays) continue;
        here = put_back(point_of(network, s, k), was[k]) || here;
        here = put_back(point_of(network, s, k + 1), was[k + 1]) || here;
      }
      if (here) restored.push_back(s);
      changed = changed || here;
    }
  }
  return restored;
}

bool goes_round_all_handles(const Network& network, const VertexGraph& graph,
                            const Surface& surface) {
  const CurveSkeleton skeleton = nodes_of_network(network, graph.groups).skeleton;
  return homology_rank(surface, skeleton) == graph_topology(skeleton).cycle_rank;
}

}  // namespace curveskel
