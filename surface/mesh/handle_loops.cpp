#include "surface/mesh/handle_loops.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/indices.hpp"
#include "surface/mesh/half_edges.hpp"

namespace curveskel {
namespace {

class TreeAndCotree {
 public:
  explicit TreeAndCotree(const Surface& surface)
      : triangles_(surface.triangles),
        half_(pair_half_edges(surface.triangles,
                              static_cast<std::int32_t>(surface.positions.rows()))),
        way_in_(idx(surface.positions.rows()), -1),
        depth_(way_in_.size(), -1),
        taken_(half_.twin.size(), 0) {
    span_vertices();
    span_faces();
  }

  /// One half-edge of each edge on the loop that every edge left over closes.
  [[nodiscard]] std::vector<std::vector<std::int32_t>> loops() const {
    std::vector<std::vector<std::int32_t>> result;
    for (std::int32_t h = 0; h < static_cast<std::int32_t>(taken_.size()); ++h) {
      if (taken_[idx(h)] != 0 || h > half_.twin[idx(h)]) continue;
      result.push_back({h});
      int a = origin(h);
      int b = origin(next_half_edge(h));
      while (a != b) {
        int& deeper = depth_[idx(a)] >= depth_[idx(b)] ? a : b;
        const std::int32_t in = way_in_[idx(deeper)];
        result.back().push_back(std::min(in, half_.twin[idx(in)]));
        deeper = origin(in);
      }
    }
    return result;
  }

  [[nodiscard]] int origin(std::int32_t h) const { return triangles_(h / 3, h % 3); }
  [[nodiscard]] int components() const { return components_; }

 private:
  void take(std::int32_t h) { taken_[idx(h)] = taken_[idx(half_.twin[idx(h)])] = 1; }

  void span_vertices() {
    std::vector<std::int32_t> out(way_in_.size(), -1);  // one half-edge that leaves each vertex
    for (auto h = static_cast<std::int32_t>(taken_.size()) - 1; h >= 0; --h)
      out[idx(origin(h))] = h;
    std::vector<int> queue;
    for (int root = 0; root < static_cast<int>(out.size()); ++root) {
      if (depth_[idx(root)] >= 0 || out[idx(root)] < 0) continue;
      ++components_;
      depth_[idx(root)] = 0;
      queue.assign(1, root);
      for (std::size_t i = 0; i < queue.size(); ++i) {
        const int v = queue[i];
        std::int32_t h = out[idx(v)];
        do {
          const int next = origin(next_half_edge(h));
          if (depth_[idx(next)] < 0) {
            depth_[idx(next)] = depth_[idx(v)] + 1;
            way_in_[idx(next)] = h;
            take(h);
            queue.push_back(next);
          }
          h = half_.twin[idx(previous_half_edge(h))];
        } while (h != out[idx(v)]);
      }
    }
  }

  void span_faces() {
    std::vector<char> reached(idx(triangles_.rows()), 0);
    std::vector<std::int32_t> queue;
    for (std::int32_t root = 0; root < static_cast<std::int32_t>(reached.size()); ++root) {
      if (std::exchange(reached[idx(root)], 1) != 0) continue;
      queue.assign(1, root);
      for (std::size_t i = 0; i < queue.size(); ++i) {
        for (std::int32_t h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h) {
          const std::int32_t beyond = half_.twin[idx(h)] / 3;
          if (taken_[idx(h)] != 0 || reached[idx(beyond)] != 0) continue;
          reached[idx(beyond)] = 1;
          take(h);
          queue.push_back(beyond);
        }
      }
    }
  }

  const Triangles& triangles_;
  HalfEdges half_;
  std::vector<std::int32_t> way_in_;  // per vertex, the half-edge from its parent
  std::vector<int> depth_;            // per vertex
  std::vector<char> taken_;           // per half-edge, by either tree
  int components_ = 0;
};

}  // namespace

HandleLoops handle_loops(const Surface& surface) {
  const TreeAndCotree trees(surface);
  HandleLoops result;
  result.components = trees.components();
  std::vector<int> row(idx(3 * surface.triangles.rows()), -1);
  for (const auto& loop : trees.loops()) {
    auto& edges = result.loops.emplace_back();
    for (const std::int32_t h : loop) {
      if (row[idx(h)] < 0) {
        row[idx(h)] = static_cast<int>(result.edges.size());
        result.edges.push_back({trees.origin(h), trees.origin(next_half_edge(h))});
      }
      edges.push_back(row[idx(h)]);
    }
  }
  return result;
}

}  // namespace curveskel
