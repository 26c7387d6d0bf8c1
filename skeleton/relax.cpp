#include "skeleton/relax.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "skeleton/axes.hpp"
#include "skeleton/cross_section.hpp"
#include "skeleton/tips.hpp"
#include "surface/element_index.hpp"
#include "surface/parallel.hpp"

namespace curveskel {
namespace {

/// Points along a polyline, half of the radius there apart, ends left out; `radii` per vertex.
std::vector<Point> spaced(const std::vector<Point>& line, const std::vector<double>& radii,
                          double most_spacing, int fewest) {
  std::vector<double> steps{0};  // from the beginning
  steps.reserve(line.size());
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double spacing =
        std::clamp(0.25 * (radii[i - 1] + radii[i]), least_spacing, most_spacing);
    steps.push_back(steps.back() + (line[i] - line[i - 1]).norm() / spacing);
  }
  const int inner = std::max(fewest, static_cast<int>(std::lround(steps.back())) - 1);
  std::vector<Point> points;
  points.reserve(at(inner));
  std::size_t i = 1;
  for (int k = 1; k <= inner; ++k) {
    const double place = steps.back() * k / (inner + 1);
    while (i + 1 < line.size() && steps[i] < place) ++i;
    const double length = steps[i] - steps[i - 1];
    const double t = length > 0 ? (place - steps[i - 1]) / length : 0;
    points.push_back(line[i - 1] + t * (line[i] - line[i - 1]));
  }
  return points;
}

int fewest_points(const Strand& strand) { return strand.from == strand.to ? 3 : 1; }

}  // namespace

std::vector<double> radii_at(const SurfaceTree& tree, const std::vector<Point>& points) {
  std::vector<double> radii(points.size());
  std::transform(points.begin(), points.end(), radii.begin(),
                 [&](const Point& p) { return tree.inscribed_radius(p); });
  return radii;
}

void space_evenly(Network& network, const SurfaceTree& tree, double most_spacing) {
  for (Strand& strand : network.strands) {
    if (!strand.alive) continue;
    const auto line = network.polyline(strand);
    auto radii = radii_at(tree, line);
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    radii.assign(line.size(), *middle);
    strand.points = spaced(line, radii, most_spacing, fewest_points(strand));
  }
}

void space_by_radius(Network& network, const SurfaceTree& tree, double most_spacing) {
  for (Strand& strand : network.strands) {
    if (!strand.alive) continue;
    const auto line = network.polyline(strand);
    strand.points = spaced(line, radii_at(tree, line), most_spacing, fewest_points(strand));
  }
}

namespace {

/// Where the thick strands at a junction lead on straight: the mean of its neighbouring points,
/// weighted by the square of their inscribed radii.
Point straight_through(const Network& network, int hub, const SurfaceTree& tree) {
  Point sum = Point::Zero();
  double weight = 0;
  const auto add = [&](const Point& p) {
    const double radius = std::max(1e-6, tree.inscribed_radius(p));
    sum += radius * radius * p;
    weight += radius * radius;
  };
  const auto place = [&](int other) -> const Point& {
    return network.hubs[static_cast<std::size_t>(other)].position;
  };
  for (const int s : network.hubs[static_cast<std::size_t>(hub)].strands) {
    const Strand& strand = network.strands[static_cast<std::size_t>(s)];
    const auto& points = strand.points;
    if (strand.from == hub) add(points.empty() ? place(strand.to) : points.front());
    if (strand.to == hub) add(points.empty() ? place(strand.from) : points.back());
  }
  return sum / weight;
}

/// Junctions move to where their strands, or the axes of these, meet with the least turn, as long
/// as they stay central.
void relax_hubs(Network& network, const SurfaceTree& tree, const std::vector<double>& first_radius,
                const RelaxOptions& options) {
  for (int h = 0; h < static_cast<int>(network.hubs.size()); ++h) {
    Hub& hub = network.hubs[static_cast<std::size_t>(h)];
    if (!hub.alive || network.degree(h) < 3) continue;
    const SurfaceTree::Ball here{hub.position, tree.inscribed_radius(hub.position)};
    const Point goal = options.meet ? meeting_of_axes(network, h, here.radius)
                                    : straight_through(network, h, tree);
    const Point candidate = 0.5 * (hub.position + goal);
    const SurfaceTree::Ball there{candidate, tree.inscribed_radius(candidate)};
    const double least = options.keep_junction * first_radius[static_cast<std::size_t>(h)];
    if (there.radius < least) continue;
    if (options.meet && makes_spur(network, h, here, there)) continue;
    hub.position = candidate;
  }
}

}  // namespace

namespace {

/// What a strand's rounds hand on to each other.
struct Rest {
  std::vector<double> last_move;  // per inner point
  std::vector<double> radius;     // inscribed, per point, ends included
  Point from = Point::Zero();     // where the ends were
  Point to = Point::Zero();
};

/// The inscribed radii along the strand, of which only those at ends that moved are asked for anew.
void update_radii(Rest& rest, const SurfaceTree& tree, const std::vector<Point>& line) {
  if (rest.radius.size() != line.size()) {
    rest.radius = radii_at(tree, line);
  } else {
    if (rest.from != line.front()) rest.radius.front() = tree.inscribed_radius(line.front());
    if (rest.to != line.back()) rest.radius.back() = tree.inscribed_radius(line.back());
  }
  rest.from = line.front();
  rest.to = line.back();
}

/// Moves the inner points of one strand in turn, each half-way to the centre of its cross-section
/// and half-way to the middle of its neighbours.
/// Those whose neighbourhood moved by less than 0.3 % of the radius last time are at rest.
void relax_strand(Network& network, int s, const SurfaceTree& tree, const RelaxOptions& options,
                  Rest& rest) {
  Strand& strand = network.strands[at(s)];
  const auto line = network.polyline(strand);
  update_radii(rest, tree, line);
  auto& [last_move, radius, from, to] = rest;
  const auto overlap = [&](const Point& p, double p_radius, const Point& q, double q_radius) {
    return (p - q).norm() <= p_radius + q_radius;
  };
  const auto is_own = [&](int triangle) { return options.is_own(triangle, s); };
  auto& points = strand.points;
  last_move.resize(points.size(), 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double stir = last_move[i];
    if (i > 0) stir = std::max(stir, last_move[i - 1]);
    if (i + 1 < points.size()) stir = std::max(stir, last_move[i + 1]);
    if (stir < 3e-3 * radius[i + 1]) continue;
    last_move[i] = 0;
    const Point& before = i > 0 ? points[i - 1] : line.front();
    const Point& after = i + 1 < points.size() ? points[i + 1] : line.back();
    const Point along = after - before;
    const Point centre = options.is_own
                             ? cross_section_centre(tree, points[i], along, radius[i + 1], is_own)
                             : cross_section_centre(tree, points[i], along, radius[i + 1]);
    const Point target = 0.5 * (points[i] + centre);
    // Along a cubic through two points either way, which does not cut corners (bilaplacian).
    Point middle = 0.5 * (before + after);
    if (options.covered && i > 0 && i + 1 < points.size()) {
      const Point& far_before = i > 1 ? points[i - 2] : line.front();
      const Point& far_after = i + 2 < points.size() ? points[i + 2] : line.back();
      middle = (4 * (before + after) - (far_before + far_after)) / 6;
    }
    const Point smooth = (1 - options.smoothing) * target + options.smoothing * middle;
    for (const Point& candidate : {smooth, target}) {
      const double moved = tree.inscribed_radius(candidate, {points[i], radius[i + 1]});
      if (moved < options.keep * radius[i + 1]) continue;
      if (options.covered && !(overlap(before, radius[i], candidate, moved) &&
                               overlap(after, radius[i + 2], candidate, moved))) {
        continue;
      }
      last_move[i] = (candidate - points[i]).norm();
      points[i] = candidate;
      radius[i + 1] = moved;
      break;
    }
  }
}

}  // namespace

namespace {

/// The hub of a closed curve is no special place: half-way round becomes the hub, so that the point
/// there takes part like any other.
void turn_half_way_round(Network& network, Strand& strand) {
  Point& hub = network.hubs[static_cast<std::size_t>(strand.from)].position;
  const auto middle = strand.points.begin() + static_cast<std::ptrdiff_t>(strand.points.size() / 2);
  std::vector<Point> points(middle + 1, strand.points.end());
  points.push_back(hub);
  points.insert(points.end(), strand.points.begin(), middle);
  hub = *middle;
  strand.points = std::move(points);
}

}  // namespace

void relax(Network& network, const SurfaceTree& tree, const RelaxOptions& options,
           HandleKeeper& keeper, int threads) {
  std::vector<double> hub_radius;
  for (const Hub& hub : network.hubs) {
    hub_radius.push_back(hub.alive ? tree.inscribed_radius(hub.position) : 0);
  }
  const auto headings = options.tips ? tip_headings(network, tree) : std::vector<TipHeading>{};
  std::vector<Rest> rest(network.strands.size());
  std::vector<std::size_t> longest_first;  // so that no core ends up with a long one alone
  for (std::size_t s = 0; s < network.strands.size(); ++s) {
    if (network.strands[s].alive) longest_first.push_back(s);
  }
  std::stable_sort(longest_first.begin(), longest_first.end(), [&](std::size_t a, std::size_t b) {
    return network.strands[a].points.size() > network.strands[b].points.size();
  });
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t s = 0; s < network.strands.size(); ++s) {
      Strand& strand = network.strands[s];
      if (!strand.alive || strand.from != strand.to || network.degree(strand.from) != 2) continue;
      turn_half_way_round(network, strand);
      rest[s] = {};
    }
    const Network before = keeper.has_handles() ? network : Network{};
    parallel_for(longest_first.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t s = longest_first[i];
        relax_strand(network, static_cast<int>(s), tree, options, rest[s]);
      }
    });
    if (!options.covered) relax_hubs(network, tree, hub_radius, options);
    centre_tips(network, tree, headings);
    for (const int s : keeper.restore_points(before, network, tree)) rest[at(s)] = {};
  }
}

void centre_junctions(Network& network, const SurfaceTree& tree) {
  constexpr int steps = 30;
  for (int h = 0; h < static_cast<int>(network.hubs.size()); ++h) {
    Hub& hub = network.hubs[static_cast<std::size_t>(h)];
    if (!hub.alive || network.degree(h) < 3) continue;
    const Point start = hub.position;
    const double first_radius = tree.inscribed_radius(start);
    double radius = first_radius;
    for (int step = 0; step < steps && radius > 0; ++step) {
      const Point away = (hub.position - tree.nearest(hub.position).point).normalized();
      const Point candidate = hub.position + 0.1 * radius * away;
      const double larger = tree.inscribed_radius(candidate);
      if (larger <= radius || (candidate - start).norm() > first_radius) break;
      hub.position = candidate;
      radius = larger;
    }
  }
}

void thin_out(Network& network, const SurfaceTree& tree, double most_spacing) {
  for (Strand& strand : network.strands) {
    if (!strand.alive) continue;
    const auto line = network.polyline(strand);
    auto radius = radii_at(tree, line);
    std::vector<Point> kept;
    std::size_t last = 0;
    const std::size_t least = strand.from == strand.to ? 2 : 1;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const double gap = (line[i + 1] - line[last]).norm();
      const bool enough = kept.size() + (line.size() - 2 - i) >= least;
      if (enough && gap <= std::clamp(0.5 * radius[i], least_spacing, most_spacing) &&
          (gap <= radius[last] + radius[i + 1] || !crosses(tree, line[last], line[i + 1]))) {
        continue;
      }
      kept.push_back(line[i]);
      last = i;
    }
    strand.points = std::move(kept);
  }
}

void cut_detours(Network& network, const SurfaceTree& tree) {
  constexpr double reach = 0.9;   // of the smaller ball
  constexpr double detour = 1.4;  // of the chord
  for (Strand& strand : network.strands) {
    if (!strand.alive || strand.from == strand.to || strand.points.size() < 2) continue;
    const auto line = network.polyline(strand);
    const auto radii = radii_at(tree, line);
    std::vector<Point> kept;
    std::size_t here = 0;
    while (here + 1 < line.size()) {
      std::size_t next = here + 1;
      double length = (line[next] - line[here]).norm();
      for (std::size_t there = here + 2; there < line.size(); ++there) {
        length += (line[there] - line[there - 1]).norm();
        if (length > 4 * std::max(radii[here], 0.0)) break;
        const double chord = (line[there] - line[here]).norm();
        const bool in_both = chord < reach * std::min(radii[here], radii[there]);
        if (in_both && length > detour * chord) next = there;
      }
      here = next;
      if (here + 1 < line.size()) kept.push_back(line[here]);
    }
    strand.points = std::move(kept);
  }
}

}  // namespace curveskel
