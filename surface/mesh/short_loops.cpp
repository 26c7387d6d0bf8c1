// Eppstein, Dynamic generators of topologically embedded graphs, SODA 2003.
// Busaryev, Cabello, Chen, Dey and Wang, Annotating simplices with a homology basis, SWAT 2012.
#include "surface/mesh/short_loops.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <random>
#include <unordered_map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/monitor.hpp>

namespace curveskel {
namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();

/// Shortest ways along the edges from one vertex of each component to all others of it.
class ShortestWays {
 public:
  explicit ShortestWays(const Stars& stars)
      : stars_(stars),
        distance_(idx(stars.surface().positions.rows()), unreached),
        before_(distance_.size(), -1),
        rank_(distance_.size(), 0) {
    for (std::int32_t root = 0; root < std::ssize(distance_); ++root) {
      if (distance_[idx(root)] == unreached && stars.first(root) >= 0) spread(root);
    }
  }

  /// True if the edge is part of the tree.
  [[nodiscard]] bool has(std::int32_t a, std::int32_t b) const {
    return before_[idx(a)] == b || before_[idx(b)] == a;
  }

  /// The length of the loop that the edge between both closes, infinite beyond `longest`.
  [[nodiscard]] double loop_length(std::int32_t a, std::int32_t b, double edge,
                                   double longest) const {
    const double both = distance_[idx(a)] + distance_[idx(b)] + edge;
    const auto length_from = [&](std::int32_t v) { return both - 2 * distance_[idx(v)]; };
    while (a != b && length_from(farther(a, b)) <= longest) step_back(farther(a, b));
    return a == b && length_from(a) <= longest ? length_from(a) : unreached;
  }

  [[nodiscard]] EdgeLoop loop(std::int32_t a, std::int32_t b) const {
    EdgeLoop there{a};
    EdgeLoop back{b};
    while (a != b) {
      std::int32_t& stepping = farther(a, b);
      step_back(stepping);
      (&stepping == &a ? there : back).push_back(stepping);
    }
    back.pop_back();  // both end where they part
    there.insert(there.end(), back.rbegin(), back.rend());
    return there;
  }

 private:
  void spread(std::int32_t root) {
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance_[idx(root)] = 0;
    queue.emplace(0, root);
    while (!queue.empty()) {
      const auto [distance, v] = queue.top();
      queue.pop();
      if (distance > distance_[idx(v)]) continue;
      rank_[idx(v)] = next_rank_++;
      std::int32_t h = stars_.first(v);
      do {
        const std::int32_t next = stars_.to(h);
        const double reached = distance + stars_.length(h);
        if (reached < distance_[idx(next)]) {
          distance_[idx(next)] = reached;
          before_[idx(next)] = v;
          queue.emplace(reached, next);
        }
        h = stars_.turned(h);
      } while (h != stars_.first(v));
    }
  }

  [[nodiscard]] std::int32_t& farther(std::int32_t& a, std::int32_t& b) const {
    return rank_[idx(a)] > rank_[idx(b)] ? a : b;
  }

  /// To the vertex before it on the way from the root.
  void step_back(std::int32_t& v) const { v = before_[idx(v)]; }

  const Stars& stars_;
  std::vector<double> distance_;
  std::vector<std::int32_t> before_;  // each vertex's last on the way from the root, -1 = a root
  std::vector<std::int32_t> rank_;    // in which they were reached: edges may have no length
  std::int32_t next_rank_ = 0;
};

/// A tree of the faces across edges that the shortest ways do not take; the edges that neither
/// takes close a basis of the homology.
class Basis {
 public:
  Basis(const Stars& stars, const ShortestWays& ways, double longest)
      : class_of_edge_(idx(stars.half_edges()), 0) {
    UnionFind joined(stars.surface().triangles.rows());
    std::vector<char> is_crossed(class_of_edge_.size(), 0);  // by the tree of the faces
    const auto join = [&](std::int32_t h) {
      if (!joined.unite(h / 3, stars.twin(h) / 3)) return false;
      is_crossed[idx(h)] = is_crossed[idx(stars.twin(h))] = 1;
      return true;
    };
    std::vector<std::int32_t> over;  // edges whose loops are long, and those of neither tree
    std::vector<std::pair<double, std::int32_t>> short_ones;
    for (std::int32_t h = 0; h < stars.half_edges(); ++h) {
      const std::int32_t a = stars.from(h);
      const std::int32_t b = stars.to(h);
      if (stars.twin(h) < h || ways.has(a, b)) continue;
      const double length = ways.loop_length(a, b, stars.length(h), longest);
      if (length < unreached) {
        short_ones.emplace_back(length, h);
      } else if (!join(h)) {
        over.push_back(h);
      }
    }
    std::sort(short_ones.begin(), short_ones.end(), std::greater<>());
    for (const auto& [length, h] : short_ones) {
      if (!join(h)) over.push_back(h);
    }
    give_classes(stars, is_crossed, over);
    for (const std::int32_t h : over) {
      const EdgeLoop loop = ways.loop(stars.from(h), stars.to(h));
      vertices_.insert(vertices_.end(), loop.begin(), loop.end());
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  }

  /// All that lie on a loop of the basis.
  [[nodiscard]] const std::vector<std::int32_t>& vertices() const { return vertices_; }
  /// The sum over a loop is 0 if it parts the surface, and next to never otherwise.
  [[nodiscard]] std::uint64_t class_of(std::int32_t h) const { return class_of_edge_[idx(h)]; }

 private:
  /// Random ones for the edges left over, none for those of the shortest ways, and for those that
  /// the tree of the faces crosses such that the sum round each face is 0, from its leaves on.
  void give_classes(const Stars& stars, const std::vector<char>& is_crossed,
                    const std::vector<std::int32_t>& over) {
    std::mt19937_64 random(20051);
    for (const std::int32_t h : over) {
      class_of_edge_[idx(h)] = class_of_edge_[idx(stars.twin(h))] = random();
    }
    const std::size_t faces = is_crossed.size() / 3;
    std::vector<std::int32_t> ways_in;  // into faces from those before them, in their order
    std::vector<char> seen(faces, 0);
    ways_in.reserve(faces);
    const auto spread = [&](std::int32_t face) {
      for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) {
        const std::int32_t next = stars.twin(h) / 3;
        if (is_crossed[idx(h)] == 0 || std::exchange(seen[idx(next)], 1) != 0) continue;
        ways_in.push_back(stars.twin(h));
      }
    };
    for (std::int32_t root = 0; root < static_cast<std::int32_t>(faces); ++root) {
      if (std::exchange(seen[idx(root)], 1) != 0) continue;
      std::size_t i = ways_in.size();
      for (spread(root); i < ways_in.size(); ++i) spread(ways_in[i] / 3);
    }
    for (std::size_t i = ways_in.size(); i-- > 0;) {
      const std::int32_t h = ways_in[i];
      class_of_edge_[idx(h)] = class_of_edge_[idx(stars.twin(h))] =
          class_of_edge_[idx(next_half_edge(h))] ^ class_of_edge_[idx(previous_half_edge(h))];
    }
  }

  std::vector<std::uint64_t> class_of_edge_;  // of each half-edge
  std::vector<std::int32_t> vertices_;
};

/// Searches round one vertex after another.
class LoopSearch {
 public:
  LoopSearch(const Stars& stars, const Basis& basis)
      : stars_(stars),
        basis_(basis),
        distance_(idx(stars.surface().positions.rows()), unreached),
        class_(distance_.size(), 0),
        before_(distance_.size(), -1),
        is_done_(distance_.size(), 0) {}

  /// The shortest loop through the vertex that parts nothing, without a way that leads there and
  /// back; empty if it is longer than `longest`.
  EdgeLoop shortest_through(std::int32_t root, double longest) {
    double best = longest;
    std::pair<std::int32_t, std::int32_t> closed_by{-1, -1};
    reach(root, -1, 0, 0);
    while (!queue_.empty() && 2 * queue_.top().first <= best) {
      const auto [distance, v] = queue_.top();
      queue_.pop();
      if (is_done_[idx(v)] != 0) continue;
      is_done_[idx(v)] = 1;
      std::int32_t h = stars_.first(v);
      do {
        const std::int32_t next = stars_.to(h);
        const double length = stars_.length(h);
        const std::uint64_t its_class = class_[idx(v)] ^ basis_.class_of(h);
        if (is_done_[idx(next)] == 0) {
          reach(next, v, distance + length, its_class);
        } else if (its_class != class_[idx(next)] &&
                   distance + length + distance_[idx(next)] <= best) {
          best = distance + length + distance_[idx(next)];
          closed_by = {v, next};
        }
        h = stars_.turned(h);
      } while (h != stars_.first(v));
    }
    EdgeLoop loop = closed_by.first < 0 ? EdgeLoop() : loop_of(closed_by.first, closed_by.second);
    forget();
    return loop;
  }

 private:
  using Entry = std::pair<double, std::int32_t>;

  void reach(std::int32_t v, std::int32_t from, double distance, std::uint64_t its_class) {
    if (distance >= distance_[idx(v)]) return;
    if (distance_[idx(v)] == unreached) touched_.push_back(v);
    distance_[idx(v)] = distance;
    class_[idx(v)] = its_class;
    before_[idx(v)] = from;
    queue_.emplace(distance, v);
  }

  [[nodiscard]] EdgeLoop way_to(std::int32_t v) const {
    EdgeLoop way;
    for (; v >= 0; v = before_[idx(v)]) way.push_back(v);
    return way;
  }

  [[nodiscard]] EdgeLoop loop_of(std::int32_t a, std::int32_t b) const {
    EdgeLoop there = way_to(a);
    EdgeLoop back = way_to(b);
    while (there.size() > 1 && back.size() > 1 &&
           there[there.size() - 2] == back[back.size() - 2]) {
      there.pop_back();
      back.pop_back();
    }
    back.pop_back();  // both end where they part
    there.insert(there.end(), back.rbegin(), back.rend());
    return there;
  }

  void forget() {
    for (const std::int32_t v : touched_) {
      distance_[idx(v)] = unreached;
      is_done_[idx(v)] = 0;
    }
    touched_.clear();
    queue_ = {};
  }

  const Stars& stars_;
  const Basis& basis_;
  std::vector<double> distance_;
  std::vector<std::uint64_t> class_;  // of the way from the root
  std::vector<std::int32_t> before_;
  std::vector<char> is_done_;
  std::vector<std::int32_t> touched_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

/// The area beside a loop, as it is reached from there.
class AreaBeside {
 public:
  AreaBeside(const Stars& stars, double reach) : stars_(stars), reach_(reach) {}

  /// On the left of the loop.
  [[nodiscard]] bool opens_out(const EdgeLoop& loop, double length) {
    constexpr double clearly = 2;  // times the area of a tube as thick
    for (const std::int32_t v : loop) distance_[v] = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t behind = loop[(i + loop.size() - 1) % loop.size()];
      std::int32_t h = stars_.between(loop[i], loop[(i + 1) % loop.size()]);
      for (; stars_.to(h) != behind; h = stars_.turned(h)) {
        take(h / 3);
        reach_along(h, 0);
      }
    }
    while (!queue_.empty()) {
      const auto [distance, v] = queue_.top();
      queue_.pop();
      if (distance > distance_.at(v)) continue;
      if (distance >= length && area_ > clearly * length * distance) return true;
      std::int32_t h = stars_.first(v);
      do {
        take(h / 3);
        reach_along(h, distance);
        h = stars_.turned(h);
      } while (h != stars_.first(v));
    }
    return false;
  }

 private:
  using Entry = std::pair<double, std::int32_t>;

  void reach_along(std::int32_t h, double distance) {
    const double reached = distance + stars_.length(h);
    if (reached > reach_) return;
    const auto [known, is_new] = distance_.try_emplace(stars_.to(h), reached);
    if (!is_new && known->second <= reached) return;
    known->second = reached;
    queue_.emplace(reached, stars_.to(h));
  }

  /// A third of the face for each corner that is reached.
  void take(std::int32_t face) {
    const Surface& surface = stars_.surface();
    int& corners = corners_of_[face];
    if (++corners > 3) return;
    const Eigen::RowVector3d a = surface.positions.row(surface.triangles(face, 0));
    const Eigen::RowVector3d b = surface.positions.row(surface.triangles(face, 1));
    const Eigen::RowVector3d c = surface.positions.row(surface.triangles(face, 2));
    area_ += (b - a).cross(c - a).norm() / 6;
  }

  const Stars& stars_;
  double reach_;
  double area_ = 0;
  std::unordered_map<std::int32_t, double> distance_;
  std::unordered_map<std::int32_t, int> corners_of_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

Stars::Stars(const Surface& surface, const HalfEdges& pairs)
    : surface_(surface), pairs_(pairs), out_(idx(surface.positions.rows()), -1) {
  for (std::int32_t h = half_edges() - 1; h >= 0; --h) out_[idx(from(h))] = h;
}

std::int32_t Stars::between(std::int32_t from, std::int32_t to) const {
  std::int32_t h = first(from);
  while (this->to(h) != to) h = turned(h);
  return h;
}

double Stars::length(std::int32_t h) const {
  return (surface_.positions.row(to(h)) - surface_.positions.row(from(h))).norm();
}

std::vector<EdgeLoop> short_loops(const Stars& stars, double longest, const std::stop_token& stop) {
  const Basis basis(stars, ShortestWays(stars), longest);
  LoopSearch search(stars, basis);
  std::vector<std::pair<double, EdgeLoop>> found;
  for (const std::int32_t v : basis.vertices()) {
    throw_if_stopped(stop);
    EdgeLoop loop = search.shortest_through(v, longest);
    if (loop.empty()) continue;
    const double length = length_of(stars, loop);
    found.emplace_back(length, std::move(loop));
  }
  std::sort(found.begin(), found.end());
  std::vector<EdgeLoop> loops;
  loops.reserve(found.size());
  for (auto& [length, loop] : found) loops.push_back(std::move(loop));
  return loops;
}

double length_of(const Stars& stars, const EdgeLoop& loop) {
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    length += stars.length(stars.between(loop[i], loop[(i + 1) % loop.size()]));
  }
  return length;
}

bool opens_out(const Stars& stars, const EdgeLoop& loop, double reach) {
  const double length = length_of(stars, loop);
  const EdgeLoop other_way(loop.rbegin(), loop.rend());
  return AreaBeside(stars, reach).opens_out(loop, length) &&
         AreaBeside(stars, reach).opens_out(other_way, length);
}

}  // namespace curveskel
