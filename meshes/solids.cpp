#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "meshes/level_set.hpp"
#include "meshes/shapes.hpp"

namespace curveskel::shapes {
namespace {

using Eigen::Vector3d;

Surface surface_of(const std::vector<Vector3d>& points,
                   const std::vector<std::array<int, 3>>& faces) {
  Surface surface;
  surface.positions.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    surface.positions.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  surface.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t i = 0; i < faces.size(); ++i)
    surface.triangles.row(static_cast<Eigen::Index>(i)) << faces[i][0], faces[i][1], faces[i][2];
  return surface;
}

Surface icosahedron() {
  const double g = std::numbers::phi;
  const std::vector<Vector3d> points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                        {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                        {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  const std::vector<std::array<int, 3>> faces = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return surface_of(points, faces);
}

}  // namespace

Shape box(const Vector3d& size, int cells) {
  std::array<int, 3> count{};
  for (int k = 0; k < 3; ++k)
    count[static_cast<std::size_t>(k)] =
        std::max(1, static_cast<int>(std::lround(cells * size[k] / size.maxCoeff())));
  std::map<std::array<int, 3>, int> index;
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> faces;
  const auto vertex = [&](const std::array<int, 3>& lattice) {
    const auto [found, is_new] = index.try_emplace(lattice, static_cast<int>(points.size()));
    if (is_new) {
      Vector3d point;
      for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        point[k] = size[k] * (static_cast<double>(lattice[axis]) / count[axis] - 0.5);
      }
      points.push_back(point);
    }
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t across = (axis + 1) % 3;
    const std::size_t up = (axis + 2) % 3;
    for (const int side : {0, count[axis]}) {
      const auto at = [&](int u, int v) {
        std::array<int, 3> p{};
        p[axis] = side;
        p[across] = u;
        p[up] = v;
        return vertex(p);
      };
      const auto face = [&](int a, int b, int c) {
        faces.push_back(side == 0 ? std::array{a, c, b} : std::array{a, b, c});
      };
      for (int u = 0; u < count[across]; ++u) {
        for (int v = 0; v < count[up]; ++v) {
          face(at(u, v), at(u + 1, v), at(u + 1, v + 1));
          face(at(u, v), at(u + 1, v + 1), at(u, v + 1));
        }
      }
    }
  }
  Shape shape;
  shape.name = "box";
  shape.surface = surface_of(points, faces);
  return shape;
}

Shape ellipsoid(const Vector3d& half_axes, int levels) {
  Shape shape;
  shape.surface = icosahedron();
  for (int i = 0; i < levels; ++i) {
    shape = subdivided(std::move(shape));
    shape.surface.positions.rowwise().normalize();
  }
  shape.surface.positions.rowwise().normalize();
  shape.surface.positions *= half_axes.asDiagonal();
  shape.name = "ellipsoid";
  return shape;
}

Shape cone(double radius, double height, int neighbours) {
  const int rings = std::max(2, static_cast<int>(std::lround(height / radius * 4)));
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < rings; ++i) {
    const double share = static_cast<double>(rings - i) / rings;
    for (int j = 0; j < neighbours; ++j) {
      const double angle = 2 * std::numbers::pi * j / neighbours;
      points.emplace_back(share * radius * std::cos(angle), share * radius * std::sin(angle),
                          (1 - share) * height);
    }
  }
  const auto apex = static_cast<int>(points.size());
  points.emplace_back(0, 0, height);
  points.emplace_back(0, 0, 0);
  for (int j = 0; j < neighbours; ++j) {
    const int next = (j + 1) % neighbours;
    faces.push_back({apex + 1, next, j});
    for (int i = 0; i + 1 < rings; ++i) {
      const int low = i * neighbours;
      const int high = low + neighbours;
      faces.push_back({low + j, low + next, high + next});
      faces.push_back({low + j, high + next, high + j});
    }
    faces.push_back({(rings - 1) * neighbours + j, (rings - 1) * neighbours + next, apex});
  }
  Shape shape;
  shape.name = "cone-" + std::to_string(neighbours);
  shape.surface = surface_of(points, faces);
  return shape;
}

Shape algebraic_double_torus(double spacing) {
  const Field field = [](const Vector3d& p) {
    const double loop = p.x() * (p.x() - 1) * (p.x() - 1) * (p.x() - 2) + p.y() * p.y();
    return loop * loop + p.z() * p.z() - 0.01;
  };
  Shape shape;
  shape.name = "algebraic-double-torus";
  shape.surface = mesh_level_set(field, {Vector3d(0, 0, 0)}, spacing);
  shape.genus = shape.cycles = 2;
  shape.tips = 0;
  return shape;
}

Shape sieve(int holes_along) {
  const int side = 2 * holes_along + 1;
  const auto solid = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < side && j < side && (i % 2 == 0 || j % 2 == 0);
  };
  Shape shape;
  shape.name = "sieve";
  shape.genus = shape.cycles = holes_along * holes_along;
  shape.surface.positions.resize(Eigen::Index{2} * (side + 1) * (side + 1), 3);
  const auto corner = [&](int i, int j, int top) { return (i * (side + 1) + j) * 2 + top; };
  std::vector<std::array<int, 3>> faces;
  const auto quad = [&](int a, int b, int c, int d) {
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  };
  for (int i = 0; i <= side; ++i) {
    for (int j = 0; j <= side; ++j) {
      for (const int top : {0, 1}) shape.surface.positions.row(corner(i, j, top)) << i, j, top;
      if (!solid(i, j)) continue;
      quad(corner(i, j, 1), corner(i + 1, j, 1), corner(i + 1, j + 1, 1), corner(i, j + 1, 1));
      quad(corner(i, j, 0), corner(i, j + 1, 0), corner(i + 1, j + 1, 0), corner(i + 1, j, 0));
      const auto wall = [&](int i0, int j0, int i1, int j1) {
        quad(corner(i0, j0, 0), corner(i1, j1, 0), corner(i1, j1, 1), corner(i0, j0, 1));
      };
      if (!solid(i, j - 1)) wall(i, j, i + 1, j);
      if (!solid(i + 1, j)) wall(i + 1, j, i + 1, j + 1);
      if (!solid(i, j + 1)) wall(i + 1, j + 1, i, j + 1);
      if (!solid(i - 1, j)) wall(i, j + 1, i, j);
    }
  }
  shape.surface.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    shape.surface.triangles.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1],
        faces[f][2];
  }
  return shape;
}

}  // namespace curveskel::shapes
