// Laws of thin closed sheets: however thin one is, its curve stays inside, with no more nodes than
// the sheet has working vertices.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <curveskel/extract.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"

namespace curveskel::sheet_laws {
namespace {

/// A place of a sheet's middle, u and v in [0, 1].
using Middle = std::function<Eigen::Vector3d(double u, double v)>;
/// Whether a cell of the grid belongs to the sheet.
using Cells = std::function<bool(int i, int j)>;

/// Both sides of a sheet over the cells of a grid, joined along its edges; `thickness` across.
Surface sheet(const Middle& middle, const Cells& has, int across, int along, double thickness,
              bool is_closed = false) {
  const auto row = [&](int i) { return is_closed ? i % along : i; };
  const int rows = is_closed ? along : along + 1;
  const auto vertex = [&](int i, int j, int side) {
    return (row(i) * (across + 1) + j) * 2 + side;
  };
  Surface surface;
  surface.positions.resize(Eigen::Index{2} * rows * (across + 1), 3);
  const double step = 1e-4;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j <= across; ++j) {
      const double u = double(i) / along;
      const double v = double(j) / across;
      const Eigen::Vector3d by_u = middle(u + step, v) - middle(u - step, v);
      const Eigen::Vector3d by_v = middle(u, v + step) - middle(u, v - step);
      const Eigen::Vector3d normal = by_u.cross(by_v).normalized();
      for (const int side : {0, 1}) {
        surface.positions.row(vertex(i, j, side)) =
            middle(u, v) + (side == 0 ? -0.5 : 0.5) * thickness * normal;
      }
    }
  }
  std::vector<std::array<int, 3>> faces;
  const auto quad = [&](int a, int b, int c, int d) {
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  };
  const auto inside = [&](int i, int j) {
    if (j < 0 || j >= across) return false;
    if (!is_closed && (i < 0 || i >= along)) return false;
    return has((i + along) % along, j);
  };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < across; ++j) {
      if (!inside(i, j)) continue;
      const auto at = [&](int di, int dj, int side) { return vertex(i + di, j + dj, side); };
      quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
      quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
      if (!inside(i, j - 1)) quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
      if (!inside(i, j + 1)) quad(at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1));
      if (!inside(i - 1, j)) quad(at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1));
      if (!inside(i + 1, j)) quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
    }
  }
  std::vector<int> number(static_cast<std::size_t>(surface.positions.rows()), -1);
  std::vector<int> used;
  for (auto& face : faces) {
    for (int& v : face) {
      int& own = number[static_cast<std::size_t>(v)];
      if (own < 0) {
        own = static_cast<int>(used.size());
        used.push_back(v);
      }
      v = own;
    }
  }
  surface.positions = surface.positions(used, Eigen::all).eval();
  surface.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    surface.triangles.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  }
  return surface;
}

bool all(int /*i*/, int /*j*/) { return true; }

/// Loose triangles of any place and posture, each a prism so thick.
Surface triangles(double thickness) {
  shapes::Random random(11);
  const auto point = [&](double size) -> Eigen::Vector3d {
    return size * Eigen::Vector3d(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
  };
  constexpr Eigen::Index count = 60;
  Surface surface;
  surface.positions.resize(6 * count, 3);
  surface.triangles.resize(8 * count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d a = point(0.5);
    const Eigen::Vector3d b = a + point(0.3);
    const Eigen::Vector3d c = a + point(0.3);
    const Eigen::Vector3d up = thickness * (b - a).cross(c - a).normalized();
    surface.positions.middleRows(6 * i, 6) << a.transpose(), b.transpose(), c.transpose(),
        (a + up).transpose(), (b + up).transpose(), (c + up).transpose();
    Eigen::Matrix<int, 8, 3> faces;
    faces << 0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5;
    surface.triangles.middleRows(8 * i, 8) = faces.array() + static_cast<int>(6 * i);
  }
  return surface;
}

/// Small balls, far from one another.
Surface balls(double diameter) {
  shapes::Random random(12);
  const double half = diameter / 2;
  constexpr int count = 60;
  std::vector<shapes::Shape> parts;
  parts.reserve(count);
  for (int i = 0; i < count; ++i) {
    parts.push_back(shapes::translated(
        shapes::ellipsoid({half, half, half}, i % 3),
        {random.uniform(0, 0.6), random.uniform(0, 0.6), random.uniform(0, 0.6)}));
  }
  return shapes::together("balls", parts).surface;
}

struct Family {
  std::string name;
  std::function<Surface(double thickness)> make;
};

/// Each about 1 long.
std::vector<Family> families() {
  using Eigen::Vector3d;
  constexpr double pi = std::numbers::pi;
  const Middle flat = [](double u, double v) { return Vector3d(0.9 * u, 0.4 * v, 0); };
  const Middle bent = [](double u, double v) {
    return Vector3d(0.5 * std::cos(pi * u), 0.5 * v, 0.5 * std::sin(pi * u));
  };
  const Middle rolled = [](double u, double v) {
    const double angle = 4 * pi * u;
    const double radius = 0.15 + 0.2 * u;
    return Vector3d(radius * std::cos(angle), 0.6 * v, radius * std::sin(angle));
  };
  const Middle ribbon = [](double u, double v) {
    const double angle = 2 * pi * u;
    const double radius = 0.4 + 0.08 * std::cos(6 * angle);
    return Vector3d(radius * std::cos(angle), 0.1 * v, radius * std::sin(angle));
  };
  const Cells comb = [](int i, int j) { return j < 4 || i % 4 < 2; };
  return {{"flat", [=](double t) { return sheet(flat, all, 16, 36, t); }},
          {"bent", [=](double t) { return sheet(bent, all, 12, 36, t); }},
          {"rolled", [=](double t) { return sheet(rolled, all, 10, 80, t); }},
          {"ribbon", [=](double t) { return sheet(ribbon, all, 3, 120, t, true); }},
          {"comb", [=](double t) { return sheet(flat, comb, 12, 38, t); }},
          {"triangles", triangles},
          {"balls", balls}};
}

TEST(Sheets, HaveACurveInsideWithFewNodesHoweverThin) {
  for (const Family& family : families()) {
    for (const double thickness : {1e-2, 1e-3, 1e-4}) {
      const Extraction found = extract(family.make(thickness), {}, {});
      const std::string name = family.name + " " + std::to_string(thickness);
      EXPECT_TRUE(found.certificate.topology_correct()) << name;
      EXPECT_GE(found.certificate.inside_fraction, 0.9999) << name;
      int working = 0;
      for (const ComponentRecord& one : found.components) working += one.working_vertices;
      EXPECT_LE(found.skeleton.nodes.rows(), working) << name;
    }
  }
}

}  // namespace
}  // namespace curveskel::sheet_laws
