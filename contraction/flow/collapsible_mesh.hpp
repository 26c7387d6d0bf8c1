// The connectivity of a triangle surface as flat arrays, with edge collapse.
#pragma once

#include <string>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Half-edge h = 3 f + k runs from corner k of face f to the next corner, so `next` and `prev` are
/// arithmetic. Origin and twin of each half-edge and one outgoing half-edge per vertex are all
/// there is. Removed faces stay as holes until `compact`.
class CollapsibleMesh {
 public:
  CollapsibleMesh() = default;
  /// O(#F). An edge with one face gets twin -1. Throws Error(Fault::input) where an edge has more
  /// than two faces or two that disagree in orientation.
  CollapsibleMesh(const Triangles& triangles, int vertices);

  [[nodiscard]] static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] static int prev(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  [[nodiscard]] int count() const { return static_cast<int>(from_.size()); }  ///< holes included
  [[nodiscard]] int vertices() const { return static_cast<int>(outgoing_.size()); }  ///< ditto
  [[nodiscard]] bool alive(int h) const { return from_[h] >= 0; }
  [[nodiscard]] int from(int h) const { return from_[h]; }
  [[nodiscard]] int to(int h) const { return from_[next(h)]; }
  [[nodiscard]] int twin(int h) const { return twin_[h]; }
  /// Some half-edge that leaves v; -1 if v has been merged into another vertex.
  [[nodiscard]] int outgoing(int v) const { return outgoing_[v]; }
  /// The next half-edge that leaves the same vertex, clockwise. Closed surfaces only.
  [[nodiscard]] int around(int h) const { return next(twin_[h]); }

  [[nodiscard]] const std::vector<int>& origins() const { return from_; }
  [[nodiscard]] const std::vector<int>& twins() const { return twin_; }

  /// The link condition: whether merging the two ends keeps a closed 2-manifold of the same
  /// topology. A tetrahedron is never collapsed. O(valence). Closed surfaces only.
  [[nodiscard]] bool can_collapse(int h) const;
  /// Merges to(h) into from(h), which removes two faces. Precondition: can_collapse(h).
  void collapse(int h);

  /// Closes the holes, in order; returns for each vertex its new index, -1 for the merged ones.
  std::vector<int> compact();

  /// The faces that are left. Precondition: compact.
  [[nodiscard]] Triangles triangles() const;

 private:
  void glue(int a, int b);
  [[noreturn]] void fail(int h, const std::string& found) const;

  std::vector<int> from_;      // per half-edge, -1 = removed
  std::vector<int> twin_;      // per half-edge
  std::vector<int> outgoing_;  // per vertex
  mutable std::vector<int> mark_;
  mutable int stamp_ = 0;
};

}  // namespace curveskel
