#include "skeleton/embed/branches/prominence.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "surface/mesh/triangle_area.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

constexpr int spheres = 24;
constexpr int first_sphere = 5;

Vector3d place(const Surface& surface, int vertex) { return surface.positions.row(vertex); }

}  // namespace

ProminenceSweep::ProminenceSweep(const WorkingSurface& working)
    : surface_(working.surface()),
      triangles_around_(working.triangles_around()),
      depth_(idx(surface_.positions.rows()), -1),
      taken_(idx(surface_.positions.rows()), 0),
      taken_corners_(idx(surface_.triangles.rows()), 0) {}

std::span<const std::int32_t> ProminenceSweep::around(int vertex) const {
  const auto first = idx(triangles_around_.offsets[idx(vertex)]);
  const auto end = idx(triangles_around_.offsets[idx(vertex) + 1]);
  return std::span(triangles_around_.values).subspan(first, end - first);
}

Protrusion ProminenceSweep::operator()(const Vector3d& base, int apex,
                                       const std::function<bool(int)>& is_own, double enough,
                                       std::size_t least_vertices) {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> shore;  // highest first
  const double reach = (place(surface_, apex) - base).norm();
  const auto see = [&](int v) {
    if (depth_[idx(v)] >= 0) return;
    depth_[idx(v)] = std::max(0.0, reach - (place(surface_, v) - base).norm());
    seen_.push_back(v);
    shore.emplace(depth_[idx(v)], v);
  };
  Protrusion best;
  bool own = true;
  see(apex);
  for (int sphere = 1; sphere <= spheres && own && best.prominence < enough; ++sphere) {
    const double depth = reach * sphere / spheres;
    while (own && !shore.empty() && shore.top().first <= depth) {
      const int v = shore.top().second;
      shore.pop();
      own = is_own(v);
      take(v);
      for (const std::int32_t t : around(v)) {
        for (const int other : surface_.triangles.row(t)) see(other);
      }
    }
    if (own && sphere >= first_sphere && part_.size() >= least_vertices) {
      const Protrusion here = protrusion_at(depth);
      if (here.prominence > best.prominence) {
        best = here;
        best.cap_centre = cap_centre(here);
      }
    }
  }
  forget();
  return best;
}

void ProminenceSweep::take(int vertex) {
  taken_[idx(vertex)] = 1;
  part_.push_back(vertex);
  for (const std::int32_t t : around(vertex)) {
    if (taken_corners_[idx(t)]++ == 0) touched_.push_back(t);
  }
}

ProminenceSweep::Boundary ProminenceSweep::boundary_at(double depth) const {
  struct Piece {
    Vector3d middle;
    double length;
  };
  std::vector<Piece> pieces;
  Boundary boundary;
  double length = 0;
  for (const int t : touched_) {
    if (taken_corners_[idx(t)] == 3) continue;
    std::array<Vector3d, 2> ends;
    std::size_t count = 0;
    for (int k = 0; k < 3; ++k) {
      int in = surface_.triangles(t, k);
      int out = surface_.triangles(t, (k + 1) % 3);
      if (taken_[idx(in)] == taken_[idx(out)]) continue;
      if (taken_[idx(in)] == 0) std::swap(in, out);
      const double share = (depth - depth_[idx(in)]) / (depth_[idx(out)] - depth_[idx(in)]);
      ends[count++] = place(surface_, in) + share * (place(surface_, out) - place(surface_, in));
    }
    pieces.push_back({0.5 * (ends[0] + ends[1]), (ends[1] - ends[0]).norm()});
    boundary.centre += pieces.back().length * pieces.back().middle;
    length += pieces.back().length;
  }
  if (!(length > 0)) return {};
  boundary.centre /= length;
  for (const Piece& piece : pieces) {
    boundary.radius += piece.length / length * (piece.middle - boundary.centre).norm();
  }
  return boundary;
}

Protrusion ProminenceSweep::protrusion_at(double depth) const {
  const Boundary boundary = boundary_at(depth);
  if (!(boundary.radius > 0)) return {};
  double height = 0;
  for (const int v : part_) {
    height = std::max(height, (place(surface_, v) - boundary.centre).norm());
  }
  return {height / boundary.radius, boundary.centre};
}

Vector3d ProminenceSweep::cap_centre(const Protrusion& part) const {
  constexpr double cap = 0.8;  // of the height
  const auto from_boundary = [&](int t) -> Vector3d {
    return (place(surface_, surface_.triangles(t, 0)) + place(surface_, surface_.triangles(t, 1)) +
            place(surface_, surface_.triangles(t, 2))) /
               3 -
           part.boundary_centre;
  };
  double height = 0;
  for (const int t : touched_) {
    if (taken_corners_[idx(t)] == 3) height = std::max(height, from_boundary(t).norm());
  }
  Vector3d sum = Vector3d::Zero();
  double area = 0;
  for (const int t : touched_) {
    if (taken_corners_[idx(t)] != 3) continue;
    const Vector3d middle = from_boundary(t);
    if (middle.norm() < cap * height) continue;
    const double weight = twice_area(surface_, t);
    sum += weight * middle;
    area += weight;
  }
  return area > 0 ? Vector3d(part.boundary_centre + sum / area) : part.boundary_centre;
}

void ProminenceSweep::forget() {
  for (const int v : seen_) {
    depth_[idx(v)] = -1;
    taken_[idx(v)] = 0;
  }
  for (const int t : touched_) taken_corners_[idx(t)] = 0;
  seen_.clear();
  part_.clear();
  touched_.clear();
}

}  // namespace curveskel
