#include "surface/repair/hole_triangulation.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>

namespace curveskel {
namespace {

using HoleKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using HolePoint = HoleKernel::Point_3;
using NumberedVertex = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, HoleKernel>;
using NumberedStructure =
    CGAL::Triangulation_data_structure_3<NumberedVertex,
                                         CGAL::Delaunay_triangulation_cell_base_3<HoleKernel>>;
using NumberedDelaunay = CGAL::Delaunay_triangulation_3<HoleKernel, NumberedStructure>;

struct FoldAndArea {
  double fold = 0;  // degrees, the greatest
  double area = 0;

  friend FoldAndArea operator+(const FoldAndArea& a, const FoldAndArea& b) {
    return {std::max(a.fold, b.fold), a.area + b.area};
  }
  friend bool operator<(const FoldAndArea& a, const FoldAndArea& b) {
    return a.fold != b.fold ? a.fold < b.fold : a.area < b.area;
  }
};

/// The triangles between a pair of corners, on the side of the corners between them.
struct Span {
  std::vector<std::int32_t> thirds;  // corners of the candidates upon the edge, ascending
  bool searched = false;
  std::int32_t third = -1;  // -1 = a border's edge, or cannot be filled
  FoldAndArea cost;
};
using Spans = std::map<std::pair<std::int32_t, std::int32_t>, Span>;

std::vector<HolePoint> points(const Positions& rows) {
  std::vector<HolePoint> result;
  result.reserve(idx(rows.rows()));
  for (const auto row : rows.rowwise()) result.emplace_back(row.x(), row.y(), row.z());
  return result;
}

void add_candidate(Spans& spans, HoleTriangle corners) {
  std::sort(corners.begin(), corners.end());
  const auto [i, j, k] = corners;
  spans[{i, j}].thirds.push_back(k);
  spans[{j, k}].thirds.push_back(i);
  spans[{i, k}].thirds.push_back(j);
}

Spans candidates(const std::vector<HolePoint>& corners) {
  std::vector<std::pair<HolePoint, std::int32_t>> numbered;
  numbered.reserve(corners.size());
  for (const HolePoint& p : corners) numbered.emplace_back(p, std::int32_t(numbered.size()));
  const NumberedDelaunay delaunay(numbered.begin(), numbered.end());
  Spans spans;
  if (delaunay.dimension() < 2) return spans;
  for (const auto& facet : delaunay.finite_facets()) {
    HoleTriangle triangle{};
    std::size_t found = 0;
    for (int c = 0; c <= delaunay.dimension(); ++c) {
      if (c != facet.second) triangle.at(found++) = facet.first->vertex(c)->info();
    }
    add_candidate(spans, triangle);
  }
  const auto count = static_cast<std::int32_t>(corners.size());
  std::vector<std::pair<std::int32_t, std::int32_t>> missing;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::pair edge = std::minmax({i, (i + 1) % count});
    if (spans.count(edge) == 0) missing.push_back(edge);
  }
  for (const auto& [i, j] : missing) {
    for (std::int32_t k = 0; k < count; ++k) {
      if (k != i && k != j) add_candidate(spans, {i, j, k});
    }
  }
  // The tetrahedralization lists its facets by where they lie in memory.
  for (auto& [edge, span] : spans) {
    std::sort(span.thirds.begin(), span.thirds.end());
    span.thirds.erase(std::unique(span.thirds.begin(), span.thirds.end()), span.thirds.end());
  }
  return spans;
}

class HoleSearch {
 public:
  HoleSearch(const Positions& corners, const Positions& beyond,
             const std::function<bool(std::int32_t, std::int32_t)>& joined,
             const std::stop_token& stop)
      : corners_(points(corners)),
        beyond_(points(beyond)),
        joined_(joined),
        stop_(stop),
        spans_(candidates(corners_)) {}

  std::vector<HoleTriangle> best() {
    std::vector<HoleTriangle> triangles;
    if (fill(0, last())) collect(0, last(), triangles);
    return triangles;
  }

 private:
  std::int32_t last() const { return static_cast<std::int32_t>(corners_.size()) - 1; }
  const HolePoint& corner(std::int32_t i) const { return corners_[idx(i)]; }

  /// The angle in degrees by which the triangles i, j, k and i, j, other differ from flat.
  double fold(std::int32_t i, std::int32_t j, std::int32_t k, const HolePoint& other) const {
    return 180 - std::abs(CGAL::approximate_dihedral_angle(corner(i), corner(j), corner(k), other));
  }

  bool allowed(std::int32_t i, std::int32_t j, std::int32_t k) const {
    if (CGAL::collinear(corner(i), corner(j), corner(k))) return false;
    if (j > i + 1 && joined_(i, j)) return false;
    return !(k > j + 1 && joined_(j, k));
  }

  /// The fold over the edge i, j of the triangle with k, the span between i and j being filled.
  double fold_at(std::int32_t i, std::int32_t j, std::int32_t k) const {
    if (j == i + 1) return fold(i, j, k, beyond_[idx(i)]);
    return fold(i, j, k, corner(spans_.at({i, j}).third));
  }

  FoldAndArea cost(std::int32_t i, std::int32_t j, std::int32_t k) const {
    FoldAndArea result;
    result.fold = std::max(fold_at(i, j, k), fold_at(j, k, i));
    if (i == 0 && k == last()) result.fold = std::max(result.fold, fold(i, k, j, beyond_[idx(k)]));
    result.area = std::sqrt(CGAL::squared_area(corner(i), corner(j), corner(k)));
    return result;
  }

  /// True if the polygon i, i + 1 ... k can be filled; its span then has the triangle and the cost.
  bool fill(std::int32_t i, std::int32_t k) {
    if (k == i + 1) return true;
    const auto found = spans_.find({i, k});
    if (found == spans_.end()) return false;
    Span& span = found->second;
    if (span.searched) return span.third >= 0;
    throw_if_stopped(stop_);
    for (const std::int32_t j : span.thirds) {
      if (j < i || j > k || !allowed(i, j, k) || !fill(i, j) || !fill(j, k)) continue;
      const FoldAndArea whole = part(i, j) + part(j, k) + cost(i, j, k);
      if (span.third >= 0 && !(whole < span.cost)) continue;
      span.third = j;
      span.cost = whole;
    }
    span.searched = true;
    return span.third >= 0;
  }

  FoldAndArea part(std::int32_t i, std::int32_t k) const {
    return k == i + 1 ? FoldAndArea() : spans_.at({i, k}).cost;
  }

  void collect(std::int32_t i, std::int32_t k, std::vector<HoleTriangle>& triangles) const {
    if (k == i + 1) return;
    const std::int32_t j = spans_.at({i, k}).third;
    collect(i, j, triangles);
    collect(j, k, triangles);
    triangles.push_back({i, j, k});
  }

  std::vector<HolePoint> corners_;
  std::vector<HolePoint> beyond_;
  const std::function<bool(std::int32_t, std::int32_t)>& joined_;
  const std::stop_token& stop_;
  Spans spans_;
};

}  // namespace

std::vector<HoleTriangle> triangulate_hole(
    const Positions& corners, const Positions& beyond,
    const std::function<bool(std::int32_t, std::int32_t)>& joined, const std::stop_token& stop) {
  if (corners.rows() < 3) return {};
  return HoleSearch(corners, beyond, joined, stop).best();
}

}  // namespace curveskel
