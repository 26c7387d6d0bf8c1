// N. Sharp, K. Crane: A Laplacian for Nonmanifold Triangle Meshes, SGP 2020 (mollification);
// A. Bobenko, B. Springborn: A Discrete Laplace-Beltrami Operator for Simplicial Surfaces, 2007.
#include "contraction/laplacian/intrinsic_delaunay.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace curveskel {
namespace {

double square(double x) { return x * x; }

/// Twice a triangle's area from its sides (W. Kahan's order of operations); 0 where rounding has
/// broken the triangle inequality.
double double_area(double x, double y, double z) {
  const double a = std::max({x, y, z});
  const double c = std::min({x, y, z});
  const double b = std::max(std::min(x, y), std::min(std::max(x, y), z));
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return 0.5 * std::sqrt(std::max(product, 0.0));
}

}  // namespace

const std::vector<WeightedEdge>& IntrinsicDelaunay::weights(const CollapsibleMesh& mesh,
                                                            const Positions& positions,
                                                            double mollify, double max_weight) {
  set_lengths(mesh, positions, mollify);
  flip_to_delaunay();

  const auto half_cotangent = [&](int h) {
    const double l = square(halves_[h].length);
    const double others = square(halves_[CollapsibleMesh::next(h)].length) +
                          square(halves_[CollapsibleMesh::prev(h)].length);
    const double floor = 1e-15 * (l + others);
    return 0.25 * (others - l) / std::max(double_area_[h / 3], floor);
  };
  edges_.clear();
  for (int h = 0; h < static_cast<int>(halves_.size()); ++h) {
    const int twin = halves_[h].twin;
    if (twin >= 0 && twin < h) continue;
    const int i = halves_[h].from;
    const int j = halves_[CollapsibleMesh::next(h)].from;
    if (i == j) continue;
    const double weight = half_cotangent(h) + (twin >= 0 ? half_cotangent(twin) : 0.0);
    edges_.push_back({i, j, std::clamp(weight, 0.0, max_weight)});
  }
  return edges_;
}

void IntrinsicDelaunay::set_lengths(const CollapsibleMesh& mesh, const Positions& positions,
                                    double mollify) {
  const int count = mesh.count();
  halves_.resize(count);
  double total = 0;
  for (int h = 0; h < count; ++h) {
    const int twin = mesh.twin(h);
    halves_[h].from = mesh.from(h);
    halves_[h].twin = twin;
    if (twin >= 0 && twin < h) {
      halves_[h].length = halves_[twin].length;
    } else {
      halves_[h].length = (positions.row(mesh.to(h)) - positions.row(mesh.from(h))).norm();
    }
    total += halves_[h].length;
  }
  const double needed = mollify * total / std::max(count, 1);
  double grow = 0;
  for (int h = 0; h < count; h += 3) {
    const double a = halves_[h].length;
    const double b = halves_[h + 1].length;
    const double c = halves_[h + 2].length;
    grow = std::max(grow, needed - (a + b + c - 2 * std::max({a, b, c})));
  }
  if (total == 0) grow = 1;  // all vertices in one point: any equilateral triangles will do
  double_area_.resize(count / 3);
  for (int h = 0; h < count; h += 3) {
    for (int k = h; k < h + 3; ++k) halves_[k].length += grow;
    double_area_[h / 3] =
        double_area(halves_[h].length, halves_[h + 1].length, halves_[h + 2].length);
  }
}

void IntrinsicDelaunay::flip_to_delaunay() {
  // Flips end by theory (the Dirichlet energy falls); the budget guards against rounding.
  auto budget = static_cast<std::ptrdiff_t>(20 * halves_.size());
  for (int start = 0; start < static_cast<int>(halves_.size()); ++start) {
    if (halves_[start].twin < start) continue;
    stack_.assign(1, start);
    while (!stack_.empty()) {
      const int h = stack_.back();
      stack_.pop_back();
      if (is_delaunay(h)) continue;
      if (--budget < 0) return;
      const int twin = halves_[h].twin;
      flip(h);
      for (const int e : {h, twin}) {
        stack_.push_back(CollapsibleMesh::next(e));
        stack_.push_back(CollapsibleMesh::prev(e));
      }
    }
  }
}

/// The opposite angles sum up to at most pi: sin(alpha + beta) >= 0, without any division.
bool IntrinsicDelaunay::is_delaunay(int h) const {
  const int t = halves_[h].twin;
  if (t < 0 || t / 3 == h / 3) return true;
  const double l = square(halves_[h].length);
  const double sides_h = square(halves_[CollapsibleMesh::next(h)].length) +
                         square(halves_[CollapsibleMesh::prev(h)].length);
  const double sides_t = square(halves_[CollapsibleMesh::next(t)].length) +
                         square(halves_[CollapsibleMesh::prev(t)].length);
  const double area_h = double_area_[h / 3];
  const double area_t = double_area_[t / 3];
  const double sine = (sides_h - l) * area_t + (sides_t - l) * area_h;
  return sine >= -1e-10 * ((sides_h + l) * area_t + (sides_t + l) * area_h);
}

/// h: a -> b with c on its left and d on its right becomes d -> c.
void IntrinsicDelaunay::flip(int h) {
  const int t = halves_[h].twin;
  const int bc = CollapsibleMesh::next(h);
  const int ca = CollapsibleMesh::prev(h);
  const int ad = CollapsibleMesh::next(t);
  const int db = CollapsibleMesh::prev(t);

  // The two triangles laid out in the plane, a in the origin and b on the x axis.
  const double l = halves_[h].length;
  const double xc = (square(l) + square(halves_[ca].length) - square(halves_[bc].length)) / (2 * l);
  const double xd = (square(l) + square(halves_[ad].length) - square(halves_[db].length)) / (2 * l);
  const double yc = double_area_[h / 3] / l;
  const double yd = double_area_[t / 3] / l;
  const double length = std::hypot(xc - xd, yc + yd);
  double_area_[h / 3] = std::max(xc * yd + xd * yc, 0.0);
  double_area_[t / 3] = std::max((l - xc) * yd + (l - xd) * yc, 0.0);

  // Slots: h, c -> a, a -> d form the first face; t, d -> b, b -> c the second.
  const std::array<int, 4> old_slot{ca, ad, db, bc};
  const std::array<int, 4> new_slot{bc, ca, ad, db};
  std::array<Half, 4> moved{};
  for (int k = 0; k < 4; ++k) {
    moved[k] = halves_[old_slot[k]];
    for (int m = 0; m < 4; ++m) {
      if (halves_[old_slot[k]].twin == old_slot[m]) moved[k].twin = new_slot[m];
    }
  }
  const int c = halves_[ca].from;
  const int d = halves_[db].from;
  for (int k = 0; k < 4; ++k) {
    halves_[new_slot[k]] = moved[k];
    if (moved[k].twin >= 0) halves_[moved[k].twin].twin = new_slot[k];
  }
  halves_[h] = {length, d, t};
  halves_[t] = {length, c, h};
}

}  // namespace curveskel
