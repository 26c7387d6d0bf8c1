// Lattice: Labelle and Shewchuk 2007, "Isosurface stuffing", figure 1 (without the stuffing).
#include "meshes/level_set.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <unordered_set>

namespace curveskel::shapes {
namespace {

using Cell = std::array<int, 3>;

// Lattice points have doubled integer coordinates: cube corners even, cube centres odd.
std::uint64_t point_key(const Cell& p) {
  constexpr std::int64_t origin = 1 << 20;
  const auto part = [](int i) { return static_cast<std::uint64_t>(origin + i); };
  return part(p[0]) << 42U | part(p[1]) << 21U | part(p[2]);
}

class Lattice {
 public:
  Lattice(const Field& field, double spacing) : field_(field), half_(spacing / 2) {}

  struct Point {
    Eigen::Vector3d position;
    double value;
  };

  int point(const Cell& doubled) {
    const auto [found, is_new] =
        index_.try_emplace(point_key(doubled), static_cast<int>(points_.size()));
    if (is_new) {
      // Off the round coordinates, where a symmetric field may be exactly 0.
      const Eigen::Vector3d position =
          half_ * (Eigen::Vector3d(doubled[0], doubled[1], doubled[2]).array() + 0.0123456789);
      points_.push_back({position, field_(position)});
    }
    return found->second;
  }

  const Point& operator[](int i) const { return points_[static_cast<std::size_t>(i)]; }

  static Cell centre(const Cell& cube) {
    return {2 * cube[0] + 1, 2 * cube[1] + 1, 2 * cube[2] + 1};
  }

  Cell cube_of(const Eigen::Vector3d& position) const {
    Cell cube{};
    for (int k = 0; k < 3; ++k)
      cube[static_cast<std::size_t>(k)] =
          static_cast<int>(std::floor((position[k] / half_ - 0.0123456789) / 2));
    return cube;
  }

  bool inside(int i) const { return (*this)[i].value < 0; }

  /// True if the surface passes through any tetrahedron that touches the cube's centre.
  bool crossed(const Cell& cube) {
    const Cell middle = centre(cube);
    const bool side = inside(point(middle));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int step : {-2, 2}) {
        Cell other = middle;
        other[axis] += step;
        if (inside(point(other)) != side) return true;
      }
    }
    for (int corner = 0; corner < 8; ++corner) {
      const Cell p = {middle[0] + ((corner & 1) != 0 ? 1 : -1),
                      middle[1] + ((corner & 2) != 0 ? 1 : -1),
                      middle[2] + ((corner & 4) != 0 ? 1 : -1)};
      if (inside(point(p)) != side) return true;
    }
    return false;
  }

 private:
  const Field& field_;
  double half_;
  std::unordered_map<std::uint64_t, int> index_;
  std::vector<Point> points_;
};

class Marcher {
 public:
  explicit Marcher(Lattice& lattice) : lattice_(lattice) {}

  /// The four tetrahedra round the lattice edge from the cube's centre to the next along `axis`.
  void visit(const Cell& cube, std::size_t axis) {
    const Cell first = Lattice::centre(cube);
    Cell second = first;
    second[axis] += 2;
    constexpr std::array<std::array<int, 2>, 4> square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    std::array<int, 4> corner{};
    for (std::size_t k = 0; k < 4; ++k) {
      Cell p = first;
      p[axis] += 1;
      p[(axis + 1) % 3] += square[k][0];
      p[(axis + 2) % 3] += square[k][1];
      corner[k] = lattice_.point(p);
    }
    const int a = lattice_.point(first);
    const int b = lattice_.point(second);
    for (std::size_t k = 0; k < 4; ++k) tetrahedron({a, b, corner[k], corner[(k + 1) % 4]});
  }

  Surface surface() const {
    Surface result;
    result.positions.resize(static_cast<Eigen::Index>(vertices_.size()), 3);
    result.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      result.positions.row(static_cast<Eigen::Index>(i)) = vertices_[i].transpose();
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const auto& t = triangles_[i];
      result.triangles.row(static_cast<Eigen::Index>(i)) << t[0], t[1], t[2];
    }
    return result;
  }

 private:
  using Edge = std::array<int, 2>;

  int vertex(const Edge& edge) {
    const auto low = static_cast<std::uint64_t>(std::min(edge[0], edge[1]));
    const auto high = static_cast<std::uint64_t>(std::max(edge[0], edge[1]));
    const auto [found, is_new] =
        index_.try_emplace(low << 32U | high, static_cast<int>(vertices_.size()));
    if (is_new) {
      const auto& a = lattice_[edge[0]];
      const auto& b = lattice_[edge[1]];
      const double t = std::clamp(a.value / (a.value - b.value), 0.05, 0.95);
      vertices_.emplace_back(a.position + t * (b.position - a.position));
    }
    return found->second;
  }

  // Orientation from the edges' midpoints: it does not change as the crossing slides along.
  void triangle(const Edge& a, const Edge& b, const Edge& c, const Eigen::Vector3d& outward) {
    const auto middle = [this](const Edge& e) {
      return Eigen::Vector3d((lattice_[e[0]].position + lattice_[e[1]].position) / 2);
    };
    const Eigen::Vector3d normal = (middle(b) - middle(a)).cross(middle(c) - middle(a));
    const std::array<int, 3> corners = {vertex(a), vertex(b), vertex(c)};
    if (normal.dot(outward) > 0)
      triangles_.push_back(corners);
    else
      triangles_.push_back({corners[0], corners[2], corners[1]});
  }

  void tetrahedron(const std::array<int, 4>& corners) {
    std::vector<int> in;
    std::vector<int> out;
    for (const int corner : corners) (lattice_.inside(corner) ? in : out).push_back(corner);
    if (in.empty() || out.empty()) return;
    Eigen::Vector3d outward = Eigen::Vector3d::Zero();
    for (const int i : out) outward += lattice_[i].position / static_cast<double>(out.size());
    for (const int i : in) outward -= lattice_[i].position / static_cast<double>(in.size());
    if (in.size() == 1) {
      triangle({in[0], out[0]}, {in[0], out[1]}, {in[0], out[2]}, outward);
    } else if (out.size() == 1) {
      triangle({in[0], out[0]}, {in[1], out[0]}, {in[2], out[0]}, outward);
    } else {
      triangle({in[0], out[0]}, {in[0], out[1]}, {in[1], out[1]}, outward);
      triangle({in[0], out[0]}, {in[1], out[1]}, {in[1], out[0]}, outward);
    }
  }

  Lattice& lattice_;
  std::unordered_map<std::uint64_t, int> index_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::array<int, 3>> triangles_;
};

struct Slope {
  double value;
  Eigen::Vector3d gradient;
};

Slope slope_at(const Field& field, const Eigen::Vector3d& p, double step) {
  Slope result{field(p), {}};
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d moved = p;
    moved[k] += step;
    result.gradient[k] = (field(moved) - result.value) / step;
  }
  return result;
}

// One Newton step along the gradient, at most half a lattice cell long.
void step_onto(const Slope& slope, double spacing, Eigen::Vector3d& p) {
  const double steepness = slope.gradient.squaredNorm();
  if (steepness == 0) return;
  const Eigen::Vector3d move = -slope.value / steepness * slope.gradient;
  p += std::min(1.0, 0.5 * spacing / std::max(move.norm(), 1e-300)) * move;
}

void smooth_onto(const Field& field, double spacing, Surface& surface) {
  Positions& x = surface.positions;
  const Eigen::Index count = x.rows();
  const double step = 1e-6 * spacing;
  constexpr int rounds = 5;
  for (int round = 0; round < rounds; ++round) {
    Positions sum = Positions::Zero(count, 3);
    Eigen::VectorXd valence = Eigen::VectorXd::Zero(count);
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const int i = surface.triangles(f, k);
        sum.row(i) += x.row(surface.triangles(f, (k + 1) % 3));
        valence[i] += 1;
      }
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      Eigen::Vector3d p = x.row(i);
      const Slope slope = slope_at(field, p, step);
      const Eigen::Vector3d normal = slope.gradient.normalized();
      const Eigen::Vector3d move = sum.row(i).transpose() / valence[i] - p;
      step_onto(slope, spacing, p);
      p += 0.8 * (move - move.dot(normal) * normal);
      x.row(i) = p.transpose();
    }
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::Vector3d p = x.row(i);
    for (int newton = 0; newton < 4; ++newton) step_onto(slope_at(field, p, step), spacing, p);
    x.row(i) = p.transpose();
  }
}

}  // namespace

Surface mesh_level_set(const Field& field, const std::vector<Eigen::Vector3d>& seeds,
                       double spacing) {
  Lattice lattice(field, spacing);
  Marcher marcher(lattice);
  std::unordered_set<std::uint64_t> seen;
  std::deque<Cell> queue;
  for (const auto& seed : seeds) {
    Cell cube = lattice.cube_of(seed);
    constexpr int limit = 100'000;
    for (int i = 0; i < limit && !lattice.crossed(cube); ++i) ++cube[0];
    if (lattice.crossed(cube) && seen.insert(point_key(cube)).second) queue.push_back(cube);
  }
  while (!queue.empty()) {
    const Cell cube = queue.front();
    queue.pop_front();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      marcher.visit(cube, axis);
      for (const int step : {-1, 1}) {
        Cell next = cube;
        next[axis] += step;
        if (!seen.contains(point_key(next)) && lattice.crossed(next)) {
          seen.insert(point_key(next));
          queue.push_back(next);
        }
      }
    }
  }
  Surface surface = marcher.surface();
  smooth_onto(field, spacing, surface);
  return surface;
}

}  // namespace curveskel::shapes
