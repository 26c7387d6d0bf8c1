#include "skeleton/slenderness.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <utility>

#include "surface/element_index.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

constexpr int spheres = 24;
constexpr int first_sphere = 5;

Vector3d place(const Surface& surface, int vertex) { return surface.positions.row(vertex); }

}  // namespace

SlendernessSweep::SlendernessSweep(const Surface& surface)
    : surface_(surface),
      first_triangle_(at(surface.positions.rows() + 1), 0),
      triangles_(at(3 * surface.triangles.rows())),
      depth_(at(surface.positions.rows()), -1),
      taken_(at(surface.positions.rows()), 0),
      taken_corners_(at(surface.triangles.rows()), 0) {
  for (const auto& triangle : surface.triangles.rowwise()) {
    for (const int v : triangle) ++first_triangle_[at(v + 1)];
  }
  for (std::size_t v = 1; v < first_triangle_.size(); ++v) {
    first_triangle_[v] += first_triangle_[v - 1];
  }
  std::vector<int> next(first_triangle_.begin(), first_triangle_.end() - 1);
  for (int t = 0; t < surface.triangles.rows(); ++t) {
    for (const int v : surface.triangles.row(t)) triangles_[at(next[at(v)]++)] = t;
  }
}

Standout SlendernessSweep::operator()(const Vector3d& base, int summit,
                                      const std::function<bool(int)>& is_own, double enough,
                                      std::size_t least_vertices) {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> shore;  // highest first
  const double reach = (place(surface_, summit) - base).norm();
  const auto see = [&](int v) {
    if (depth_[at(v)] >= 0) return;
    depth_[at(v)] = std::max(0.0, reach - (place(surface_, v) - base).norm());
    seen_.push_back(v);
    shore.emplace(depth_[at(v)], v);
  };
  Standout best;
  bool own = true;
  see(summit);
  for (int sphere = 1; sphere <= spheres && own && best.slenderness < enough; ++sphere) {
    const double depth = reach * sphere / spheres;
    while (own && !shore.empty() && shore.top().first <= depth) {
      const int v = shore.top().second;
      shore.pop();
      own = is_own(v);
      take(v);
      for (int i = first_triangle_[at(v)]; i < first_triangle_[at(v + 1)]; ++i) {
        for (const int other : surface_.triangles.row(triangles_[at(i)])) see(other);
      }
    }
    if (own && sphere >= first_sphere && part_.size() >= least_vertices) {
      const Standout here = standout_at(depth);
      if (here.slenderness > best.slenderness) {
        best = here;
        best.crown_centre = crown_centre(here);
      }
    }
  }
  forget();
  return best;
}

void SlendernessSweep::take(int vertex) {
  taken_[at(vertex)] = 1;
  part_.push_back(vertex);
  for (int i = first_triangle_[at(vertex)]; i < first_triangle_[at(vertex + 1)]; ++i) {
    const int t = triangles_[at(i)];
    if (taken_corners_[at(t)]++ == 0) touched_.push_back(t);
  }
}

SlendernessSweep::Rim SlendernessSweep::rim_at(double depth) const {
  struct Piece {
    Vector3d middle;
    double length;
  };
  std::vector<Piece> pieces;
  Rim rim;
  double length = 0;
  for (const int t : touched_) {
    if (taken_corners_[at(t)] == 3) continue;
    std::array<Vector3d, 2> ends;
    std::size_t count = 0;
    for (int k = 0; k < 3; ++k) {
      int in = surface_.triangles(t, k);
      int out = surface_.triangles(t, (k + 1) % 3);
      if (taken_[at(in)] == taken_[at(out)]) continue;
      if (taken_[at(in)] == 0) std::swap(in, out);
      const double share = (depth - depth_[at(in)]) / (depth_[at(out)] - depth_[at(in)]);
      ends[count++] = place(surface_, in) + share * (place(surface_, out) - place(surface_, in));
    }
    pieces.push_back({0.5 * (ends[0] + ends[1]), (ends[1] - ends[0]).norm()});
    rim.centre += pieces.back().length * pieces.back().middle;
    length += pieces.back().length;
  }
  if (!(length > 0)) return {};
  rim.centre /= length;
  for (const Piece& piece : pieces) {
    rim.radius += piece.length / length * (piece.middle - rim.centre).norm();
  }
  return rim;
}

Standout SlendernessSweep::standout_at(double depth) const {
  const Rim rim = rim_at(depth);
  if (!(rim.radius > 0)) return {};
  double height = 0;
  for (const int v : part_) {
    height = std::max(height, (place(surface_, v) - rim.centre).norm());
  }
  return {height / rim.radius, rim.centre};
}

Vector3d SlendernessSweep::crown_centre(const Standout& part) const {
  constexpr double crown = 0.8;  // of the height
  const auto from_rim = [&](int t) -> Vector3d {
    return (place(surface_, surface_.triangles(t, 0)) + place(surface_, surface_.triangles(t, 1)) +
            place(surface_, surface_.triangles(t, 2))) /
               3 -
           part.rim_centre;
  };
  double height = 0;
  for (const int t : touched_) {
    if (taken_corners_[at(t)] == 3) height = std::max(height, from_rim(t).norm());
  }
  Vector3d sum = Vector3d::Zero();
  double area = 0;
  for (const int t : touched_) {
    if (taken_corners_[at(t)] != 3) continue;
    const Vector3d middle = from_rim(t);
    if (middle.norm() < crown * height) continue;
    const Vector3d a = place(surface_, surface_.triangles(t, 0));
    const Vector3d b = place(surface_, surface_.triangles(t, 1));
    const Vector3d c = place(surface_, surface_.triangles(t, 2));
    const double weight = (b - a).cross(c - a).norm();
    sum += weight * middle;
    area += weight;
  }
  return area > 0 ? Vector3d(part.rim_centre + sum / area) : part.rim_centre;
}

void SlendernessSweep::forget() {
  for (const int v : seen_) {
    depth_[at(v)] = -1;
    taken_[at(v)] = 0;
  }
  for (const int t : touched_) taken_corners_[at(t)] = 0;
  seen_.clear();
  part_.clear();
  touched_.clear();
}

}  // namespace curveskel
