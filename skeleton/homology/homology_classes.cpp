#include "skeleton/homology/homology_classes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/topology.hpp>
#include "surface/mesh/handle_loops.hpp"

namespace curveskel {
namespace linking {

/// A point of the projection, on a grid so fine that points hardly move and so coarse
/// that the side of a line on which a point lies is computed exactly; and its height above.
struct Seen {
  std::int64_t x = 0;
  std::int64_t y = 0;
  double height = 0;
};

/// Along a direction in which no model has an axis.
class Projection {
 public:
  explicit Projection(const Positions& about) {
    constexpr double cells = 1LL << 44;
    const Eigen::RowVector3d low = about.colwise().minCoeff();
    const Eigen::RowVector3d high = about.colwise().maxCoeff();
    middle_ = 0.5 * (low + high).transpose();
    const double extent = (high - low).norm();
    frame_ = (extent > 0 ? cells / extent : 1.0) *
             Eigen::Quaterniond(0.6180, 0.3713, -0.2917, 0.6285).normalized().toRotationMatrix();
  }

  [[nodiscard]] Seen operator()(const Eigen::Vector3d& position) const {
    // A point far away may as well lie at the end of the grid.
    const auto rounded = [](double value) {
      constexpr double far = 1LL << 48;
      return std::llround(std::clamp(value, -far, far));
    };
    const Eigen::Vector3d p = frame_ * (position - middle_);
    return {rounded(p.x()), rounded(p.y()), p.z()};
  }
  [[nodiscard]] std::vector<Seen> operator()(const Positions& positions) const {
    std::vector<Seen> seen;
    seen.reserve(idx(positions.rows()));
    for (Eigen::Index i = 0; i < positions.rows(); ++i) {
      seen.push_back((*this)(Eigen::Vector3d(positions.row(i))));
    }
    return seen;
  }

 private:
  Eigen::Vector3d middle_;
  Eigen::Matrix3d frame_;
};

using Segment = std::array<Seen, 2>;

__extension__ using Wide = __int128;

/// Twice the area of the triangle: positive if c lies to the left of the line from a to b.
Wide side(const Segment& line, const Seen& c) {
  const auto& [a, b] = line;
  return Wide{b.x - a.x} * (c.y - a.y) - Wide{b.y - a.y} * (c.x - a.x);
}

double height_at(const Segment& segment, Wide from, Wide to) {
  const double share = static_cast<double>(from) / static_cast<double>(from - to);
  return segment[0].height + share * (segment[1].height - segment[0].height);
}

/// True if the first is seen to cross over the second. A point on a line counts as to its left.
bool crosses_over(const Segment& a, const Segment& b) {
  const Wide a_from = side(b, a[0]);
  const Wide a_to = side(b, a[1]);
  if ((a_from < 0) == (a_to < 0)) return false;
  const Wide b_from = side(a, b[0]);
  const Wide b_to = side(a, b[1]);
  if ((b_from < 0) == (b_to < 0)) return false;
  return height_at(a, a_from, a_to) > height_at(b, b_from, b_to);
}

/// Square cells, each with the segments whose boxes meet it. Keeps the segments.
class Grid {
 public:
  explicit Grid(std::vector<Segment> given) : segments_(std::move(given)) {
    const std::vector<Segment>& segments = segments_;
    if (segments.empty()) return;
    low_ = {segments[0][0].x, segments[0][0].y};
    std::array<std::int64_t, 2> high = low_;
    for (const Segment& segment : segments) {
      for (const Seen& end : segment) {
        low_ = {std::min(low_[0], end.x), std::min(low_[1], end.y)};
        high = {std::max(high[0], end.x), std::max(high[1], end.y)};
      }
    }
    constexpr double most = 1024;
    side_ = static_cast<std::int64_t>(
        std::clamp(std::sqrt(static_cast<double>(segments.size())), 1.0, most));
    cell_ = 1 + std::max(high[0] - low_[0], high[1] - low_[1]) / side_;
    cells_.resize(idx(side_ * side_));
    for (std::size_t s = 0; s < segments.size(); ++s) {
      for_cells(segments[s], [&](std::vector<int>& cell) { cell.push_back(static_cast<int>(s)); });
    }
    last_asked_by_.assign(segments.size(), -1);
  }

  [[nodiscard]] std::size_t size() const { return segments_.size(); }

  /// Calls found(s) for each segment s that the given one crosses over.
  template <typename Found>
  void crossed_by(const Segment& segment, const Found& found) {
    ++asked_;
    for_cells(segment, [&](const std::vector<int>& cell) {
      for (const int s : cell) {
        if (std::exchange(last_asked_by_[idx(s)], asked_) == asked_) continue;
        if (crosses_over(segment, segments_[idx(s)])) found(s);
      }
    });
  }

 private:
  /// Segments beyond the grid meet none of its cells.
  template <typename Visit>
  void for_cells(const Segment& segment, const Visit& visit) {
    const auto [x_low, x_high] = std::minmax(segment[0].x, segment[1].x);
    const auto [y_low, y_high] = std::minmax(segment[0].y, segment[1].y);
    const auto first = [this](std::int64_t low, std::int64_t origin) {
      return std::max<std::int64_t>(0, low - origin) / cell_;
    };
    const auto last = [this](std::int64_t high, std::int64_t origin) {
      return high < origin ? -1 : std::min(side_ - 1, (high - origin) / cell_);
    };
    for (std::int64_t y = first(y_low, low_[1]); y <= last(y_high, low_[1]); ++y) {
      for (std::int64_t x = first(x_low, low_[0]); x <= last(x_high, low_[0]); ++x) {
        visit(cells_[idx(y * side_ + x)]);
      }
    }
  }

  std::vector<Segment> segments_;
  std::array<std::int64_t, 2> low_{};
  std::int64_t side_ = 0;
  std::int64_t cell_ = 1;
  std::vector<std::vector<int>> cells_;
  std::vector<int> last_asked_by_;  // per segment
  int asked_ = 0;
};

/// The edges of all loops, seen from above.
struct SeenLoops {
  HandleLoops handles;
  Projection projection;
  Grid edges;

  explicit SeenLoops(const Surface& surface)
      : handles(handle_loops(surface)),
        projection(surface.positions),
        edges(segments(surface.positions)) {}

 private:
  [[nodiscard]] std::vector<Segment> segments(const Positions& positions) const {
    const auto vertices = projection(positions);
    std::vector<Segment> result;
    result.reserve(handles.edges.size());
    for (const auto& [a, b] : handles.edges) result.push_back({vertices[idx(a)], vertices[idx(b)]});
    return result;
  }
};

}  // namespace linking

namespace {

using linking::Seen;
using linking::SeenLoops;
using linking::Segment;

/// The crossings of a curve's segments over the loops' edges.
struct Crossing {
  int segment = 0;
  int loop_edge = 0;
};

/// For each 64 loops in turn calls with_words(words): one word a segment, whose bits say whether it
/// crosses over the loop oddly often.
template <typename WithWords>
void for_words(const HandleLoops& handles, const std::vector<Crossing>& crossings,
               std::size_t segments, const WithWords& with_words) {
  std::vector<std::uint64_t> of_loop_edge(handles.edges.size());
  for (std::size_t begin = 0; begin < handles.loops.size(); begin += 64) {
    std::fill(of_loop_edge.begin(), of_loop_edge.end(), 0);
    const std::size_t end = std::min(begin + 64, handles.loops.size());
    for (std::size_t loop = begin; loop < end; ++loop) {
      for (const int edge : handles.loops[loop]) of_loop_edge[idx(edge)] ^= 1ULL << (loop - begin);
    }
    std::vector<std::uint64_t> words(segments, 0);
    for (const Crossing& c : crossings) words[idx(c.segment)] ^= of_loop_edge[idx(c.loop_edge)];
    with_words(words);
  }
}

/// A forest that spans the graph, and the edges it leaves, each of which closes a cycle.
struct Forest {
  std::vector<std::array<int, 3>> steps;  // from a node to the next by an edge, in order
  std::vector<int> left;
};

Forest spanning_forest(const CurveSkeleton& skeleton) {
  const Graph graph = graph_of(skeleton.nodes.rows(), skeleton.edges);
  Forest forest;
  std::vector<char> reached(idx(graph.nodes()), 0);
  std::vector<char> in_forest(idx(skeleton.edges.rows()), 0);
  std::vector<int> stack;
  for (int root = 0; root < graph.nodes(); ++root) {
    if (std::exchange(reached[idx(root)], 1) != 0) continue;
    stack.assign(1, root);
    while (!stack.empty()) {
      const int node = stack.back();
      stack.pop_back();
      for (int i = graph.first[idx(node)]; i < graph.first[idx(node + 1)]; ++i) {
        const int next = graph.neighbour[idx(i)];
        const int edge = graph.edge[idx(i)];
        if (std::exchange(reached[idx(next)], 1) != 0) continue;
        in_forest[idx(edge)] = 1;
        forest.steps.push_back({node, next, edge});
        stack.push_back(next);
      }
    }
  }
  for (int e = 0; e < static_cast<int>(in_forest.size()); ++e) {
    if (in_forest[idx(e)] == 0) forest.left.push_back(e);
  }
  return forest;
}

}  // namespace

bool IndependentRows::add(BitRow row) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if ((row[pivots_[i] / 64] >> (pivots_[i] % 64) & 1U) == 0) continue;
    for (std::size_t w = 0; w < row.size(); ++w) row[w] ^= rows_[i][w];
  }
  const auto word = std::find_if(row.begin(), row.end(), [](std::uint64_t w) { return w != 0; });
  if (word == row.end()) return false;
  pivots_.push_back(64 * static_cast<std::size_t>(word - row.begin()) +
                    static_cast<std::size_t>(std::countr_zero(*word)));
  rows_.push_back(std::move(row));
  return true;
}

std::vector<BitRow> linking_numbers(const Surface& surface,
                                    const std::vector<std::vector<Eigen::Vector3d>>& polygons) {
  SeenLoops loops(surface);
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    Seen last = loops.projection(polygons[i].back());
    for (const Eigen::Vector3d& point : polygons[i]) {
      const Seen next = loops.projection(point);
      loops.edges.crossed_by({last, next}, [&](int under) {
        crossings.push_back({static_cast<int>(i), under});
      });
      last = next;
    }
  }
  std::vector<BitRow> rows(polygons.size());
  for_words(loops.handles, crossings, polygons.size(), [&](const BitRow& words) {
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(words[i]);
  });
  return rows;
}

namespace {

int rank_within(SeenLoops& loops, const CurveSkeleton& skeleton) {
  const Forest forest = spanning_forest(skeleton);
  if (forest.left.empty() || loops.edges.size() == 0) return 0;
  const auto nodes = loops.projection(skeleton.nodes);
  std::vector<Crossing> crossings;
  for (int e = 0; e < static_cast<int>(skeleton.edges.rows()); ++e) {
    const Segment edge{nodes[idx(skeleton.edges(e, 0))], nodes[idx(skeleton.edges(e, 1))]};
    loops.edges.crossed_by(edge, [&](int under) { crossings.push_back({e, under}); });
  }
  std::vector<BitRow> linking(forest.left.size());
  for_words(loops.handles, crossings, idx(skeleton.edges.rows()), [&](const BitRow& of_edge) {
    BitRow of_way(idx(skeleton.nodes.rows()), 0);  // from the root of the tree to each node
    for (const auto& [node, next, edge] : forest.steps) {
      of_way[idx(next)] = of_way[idx(node)] ^ of_edge[idx(edge)];
    }
    for (std::size_t cycle = 0; cycle < linking.size(); ++cycle) {
      const int e = forest.left[cycle];
      linking[cycle].push_back(of_edge[idx(e)] ^ of_way[idx(skeleton.edges(e, 0))] ^
                               of_way[idx(skeleton.edges(e, 1))]);
    }
  });
  IndependentRows independent;
  for (BitRow& row : linking) independent.add(std::move(row));
  return independent.size();
}

/// The components of a skeleton that have cycles.
std::vector<CurveSkeleton> with_cycles(const CurveSkeleton& skeleton) {
  const Forest forest = spanning_forest(skeleton);
  std::vector<int> component(idx(skeleton.nodes.rows()), -1);  // by the lowest node
  std::iota(component.begin(), component.end(), 0);
  for (const auto& [node, next, edge] : forest.steps) component[idx(next)] = component[idx(node)];
  std::vector<int> number(component.size(), -1);
  int count = 0;
  for (const int e : forest.left) {
    int& n = number[idx(component[idx(skeleton.edges(e, 0))])];
    if (n < 0) n = count++;
  }
  std::vector<CurveSkeleton> parts(idx(count));
  std::vector<int> row(component.size(), -1);
  std::vector<int> rows(idx(count), 0);
  for (std::size_t node = 0; node < component.size(); ++node) {
    const int n = number[idx(component[node])];
    if (n >= 0) row[node] = rows[idx(n)]++;
  }
  for (std::size_t n = 0; n < parts.size(); ++n) parts[n].nodes.resize(rows[n], 3);
  std::vector<std::vector<std::array<int, 2>>> edges(idx(count));
  for (const auto& edge : skeleton.edges.rowwise()) {
    const int n = number[idx(component[idx(edge(0))])];
    if (n >= 0) edges[idx(n)].push_back({row[idx(edge(0))], row[idx(edge(1))]});
  }
  for (std::size_t node = 0; node < component.size(); ++node) {
    if (row[node] < 0) continue;
    parts[idx(number[idx(component[node])])].nodes.row(row[node]) =
        skeleton.nodes.row(static_cast<Eigen::Index>(node));
  }
  for (std::size_t n = 0; n < parts.size(); ++n) {
    parts[n].edges.resize(static_cast<Eigen::Index>(edges[n].size()), 2);
    for (std::size_t e = 0; e < edges[n].size(); ++e) {
      parts[n].edges.row(static_cast<Eigen::Index>(e)) << edges[n][e][0], edges[n][e][1];
    }
  }
  return parts;
}

/// Gives each surface the skeleton that goes round its handles, none to two of them.
class Matching {
 public:
  /// ranks[s]: (skeleton, rank) of those that go round any of surface s.
  explicit Matching(const std::vector<std::vector<std::array<int, 2>>>& ranks,
                    std::size_t skeletons)
      : ranks_(ranks), surface_of_(skeletons, -1), skeleton_of_(ranks.size(), -1) {}

  [[nodiscard]] int total(const std::vector<int>& genus) {
    for (std::size_t s = 0; s < ranks_.size(); ++s) {
      asked_.assign(surface_of_.size(), 0);
      give(static_cast<int>(s), genus);
    }
    int sum = 0;
    for (std::size_t s = 0; s < ranks_.size(); ++s) {
      int most = skeleton_of_[s] >= 0 ? genus[s] : 0;
      for (const auto& [skeleton, rank] : ranks_[s]) {
        if (skeleton_of_[s] < 0 && surface_of_[idx(skeleton)] < 0) most = std::max(most, rank);
      }
      sum += most;
    }
    return sum;
  }

 private:
  /// One that goes round all, taken from another surface if that finds a different one.
  bool give(int surface, const std::vector<int>& genus) {
    for (const auto& [skeleton, rank] : ranks_[idx(surface)]) {
      if (rank < genus[idx(surface)] || std::exchange(asked_[idx(skeleton)], 1) != 0) continue;
      int& owner = surface_of_[idx(skeleton)];
      if (owner >= 0 && !give(owner, genus)) continue;
      owner = surface;
      skeleton_of_[idx(surface)] = skeleton;
      return true;
    }
    return false;
  }

  const std::vector<std::vector<std::array<int, 2>>>& ranks_;
  std::vector<int> surface_of_;   // per skeleton
  std::vector<int> skeleton_of_;  // per surface
  std::vector<char> asked_;       // per skeleton
};

}  // namespace

int homology_rank(const Surface& surface, const CurveSkeleton& skeleton) {
  if (SeenLoops loops(surface); loops.handles.components == 1) return rank_within(loops, skeleton);
  const Topology counted = topology(surface);
  const auto parts = with_cycles(skeleton);
  std::vector<Eigen::Matrix<double, 2, 3>> boxes(parts.size());
  for (std::size_t n = 0; n < parts.size(); ++n) {
    boxes[n] << parts[n].nodes.colwise().minCoeff(), parts[n].nodes.colwise().maxCoeff();
  }
  std::vector<std::vector<std::array<int, 2>>> ranks;
  std::vector<int> genus;
  const auto components = split_components(surface, counted);
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (counted.genus[c] == 0) continue;
    const Surface& component = components[c].surface;
    const Eigen::RowVector3d low = component.positions.colwise().minCoeff();
    const Eigen::RowVector3d high = component.positions.colwise().maxCoeff();
    SeenLoops loops(component);
    genus.push_back(counted.genus[c]);
    ranks.emplace_back();
    for (std::size_t n = 0; n < parts.size(); ++n) {
      if ((boxes[n].row(0).array() > high.array()).any()) continue;
      if ((boxes[n].row(1).array() < low.array()).any()) continue;
      const int rank = rank_within(loops, parts[n]);
      if (rank > 0) ranks.back().push_back({static_cast<int>(n), std::min(rank, genus.back())});
    }
  }
  return Matching(ranks, parts.size()).total(genus);
}

struct HomologyClasses::Implementation {
  explicit Implementation(const Surface& surface) : loops(surface) {
    std::mt19937_64 random(1);
    number_of_edge.assign(loops.edges.size(), 0);
    for (const auto& loop : loops.handles.loops) {
      const std::uint64_t number = random();
      for (const int edge : loop) number_of_edge[idx(edge)] ^= number;
    }
  }

  [[nodiscard]] std::uint64_t number_of(const Segment& segment) {
    std::uint64_t number = 0;
    loops.edges.crossed_by(segment, [&](int under) { number ^= number_of_edge[idx(under)]; });
    return number;
  }

  linking::SeenLoops loops;
  std::vector<std::uint64_t> number_of_edge;  // the sum of its loops' numbers
};

HomologyClasses::HomologyClasses(const Surface& surface)
    : implementation_(std::make_shared<Implementation>(surface)) {}

bool HomologyClasses::has_handles() const { return implementation_->loops.edges.size() > 0; }

bool HomologyClasses::homologous(const std::vector<Eigen::Vector3d>& there,
                                 const std::vector<Eigen::Vector3d>& back) {
  const linking::Projection& projection = implementation_->loops.projection;
  Seen last = projection(there.front());
  std::uint64_t number = 0;
  const auto go_on_to = [&](const Eigen::Vector3d& point) {
    const Seen next = projection(point);
    number ^= implementation_->number_of({last, next});
    last = next;
  };
  std::for_each(there.begin() + 1, there.end(), go_on_to);
  std::for_each(back.rbegin(), back.rend(), go_on_to);
  go_on_to(there.front());
  return number == 0;
}

}  // namespace curveskel
