#include <curveskel/advanced/tree.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>

namespace curveskel::tree_laws {
namespace {

using Eigen::Vector3d;

constexpr double pi = 3.14159265358979323846;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Shape {
  std::string name;
  Surface surface;
};

Surface surface_of(const std::vector<Vector3d>& points,
                   const std::vector<std::array<int, 3>>& faces) {
  Surface surface;
  surface.positions.resize(static_cast<Eigen::Index>(points.size()), 3);
  surface.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    surface.positions.row(static_cast<Eigen::Index>(i)) = points[i];
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    surface.triangles.row(static_cast<Eigen::Index>(i)) << faces[i][0], faces[i][1], faces[i][2];
  }
  return surface;
}

Surface cube() {
  return surface_of(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      {{0, 2, 1},
       {0, 3, 2},
       {4, 5, 6},
       {4, 6, 7},
       {0, 1, 5},
       {0, 5, 4},
       {1, 2, 6},
       {1, 6, 5},
       {2, 3, 7},
       {2, 7, 6},
       {3, 0, 4},
       {3, 4, 7}});
}

// Unit sphere of rings and sectors; `bump` moves the radius by that share.
Surface sphere(int rings, double bump = 0) {
  const int sectors = 2 * rings;
  std::vector<Vector3d> points;
  const auto point = [&](double latitude, double longitude) {
    const double r = 1 + bump * std::sin(5 * latitude) * std::cos(3 * longitude + latitude);
    return Vector3d(r * std::sin(latitude) * std::cos(longitude),
                    r * std::sin(latitude) * std::sin(longitude), r * std::cos(latitude));
  };
  for (int i = 1; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) points.push_back(point(pi * i / rings, 2 * pi * j / sectors));
  }
  const auto north = static_cast<int>(points.size());
  const int south = north + 1;
  points.emplace_back(0, 0, 1);
  points.emplace_back(0, 0, -1);
  std::vector<std::array<int, 3>> faces;
  for (int j = 0; j < sectors; ++j) {
    const int k = (j + 1) % sectors;
    faces.push_back({north, j, k});
    faces.push_back({south, (rings - 2) * sectors + k, (rings - 2) * sectors + j});
    for (int i = 0; i + 2 < rings; ++i) {
      const int a = i * sectors + j;
      const int b = i * sectors + k;
      faces.push_back({a, a + sectors, b});
      faces.push_back({b, a + sectors, b + sectors});
    }
  }
  return surface_of(points, faces);
}

// Around the z axis, main radius 1.
Surface torus(double tube, int around, int across) {
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * pi * i / around;
      const double v = 2 * pi * j / across;
      const double r = 1 + tube * std::cos(v);
      points.emplace_back(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
      const int a = i * across + j;
      const int b = (i + 1) % around * across + j;
      const int c = i * across + (j + 1) % across;
      const int d = (i + 1) % around * across + (j + 1) % across;
      faces.push_back({a, b, c});
      faces.push_back({c, b, d});
    }
  }
  return surface_of(points, faces);
}

Surface placed(Surface surface, double scale, const Vector3d& offset) {
  surface.positions *= scale;
  surface.positions.rowwise() += offset.transpose();
  return surface;
}

std::vector<Shape> shapes() {
  return {{"cube", cube()},
          {"sphere", sphere(12)},
          {"bumpy sphere", sphere(24, 0.3)},
          {"torus", torus(0.3, 24, 12)},
          {"long triangles", torus(0.01, 5, 40)},
          {"tiny", placed(sphere(8, 0.2), 1e-12, {0, 0, 0})},
          {"huge", placed(torus(0.4, 16, 8), 1e12, {0, 0, 0})},
          {"far off", placed(sphere(8, 0.2), 1, {200, -300, 100})}};
}

class Points {
 public:
  explicit Points(const Surface& surface)
      : lower_(surface.positions.colwise().minCoeff()),
        extent_(surface.positions.colwise().maxCoeff().transpose() - lower_) {}
  // Within the bounding box, grown by half on every side.
  Vector3d next() {
    return lower_ + extent_.cwiseProduct(Vector3d(uniform(), uniform(), uniform()));
  }
  Vector3d direction() {
    Vector3d d(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5);
    return d.normalized();
  }

 private:
  double uniform() { return std::uniform_real_distribution<>(-0.5, 1.5)(generator_); }
  std::mt19937 generator_{7};
  Vector3d lower_;
  Vector3d extent_;
};

// Ericson's region test, a different way than the tree's.
Vector3d closest_in_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                             const Vector3d& c) {
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  return a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
}

Vector3d corner(const Surface& surface, int face, int k) {
  return surface.positions.row(surface.triangles(face, k));
}

double brute_distance(const Surface& surface, const Vector3d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (int f = 0; f < surface.triangles.rows(); ++f) {
    const Vector3d q =
        closest_in_triangle(p, corner(surface, f, 0), corner(surface, f, 1), corner(surface, f, 2));
    best = std::min(best, (q - p).norm());
  }
  return best;
}

// Sum of the triangles' solid angles / 4 pi (Van Oosterom and Strackee 1983).
double winding_number(const Surface& surface, const Vector3d& p) {
  double sum = 0;
  for (int f = 0; f < surface.triangles.rows(); ++f) {
    const Vector3d a = corner(surface, f, 0) - p;
    const Vector3d b = corner(surface, f, 1) - p;
    const Vector3d c = corner(surface, f, 2) - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * pi);
}

TEST(SurfaceTree, NearestIsWhatTryingEveryTriangleFinds) {
  for (const auto& [name, surface] : shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    const double diagonal = bounding_box_diagonal(surface.positions);
    const double tolerance = 1e-12 * (diagonal + surface.positions.cwiseAbs().maxCoeff());
    Points points(surface);
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = points.next();
      const auto nearest = tree.nearest(p);
      const double expected = brute_distance(surface, p);
      ASSERT_NEAR(nearest.distance, expected, tolerance);
      ASSERT_NEAR((nearest.point - p).norm(), expected, tolerance);
      const int f = nearest.triangle;
      const Vector3d on_triangle = closest_in_triangle(
          nearest.point, corner(surface, f, 0), corner(surface, f, 1), corner(surface, f, 2));
      ASSERT_NEAR((on_triangle - nearest.point).norm(), 0, 100 * tolerance);
    }
  }
}

TEST(SurfaceTree, NearestHonoursTheLimitAndServesFarPoints) {
  const Surface surface = sphere(12, 0.3);
  const SurfaceTree tree(surface);
  Points points(surface);
  for (int i = 0; i < 200; ++i) {
    const Vector3d p = points.next();
    const double distance = tree.nearest(p).distance;
    EXPECT_EQ(tree.nearest(p, distance * 0.999).triangle, -1);
    EXPECT_EQ(tree.nearest(p, distance * 1.001).distance, distance);
    const Vector3d far = p * 1e6;
    EXPECT_NEAR(tree.nearest(far).distance / brute_distance(surface, far), 1, 1e-12);
  }
}

TEST(SurfaceTree, RaysHitWhereTheWindingNumberChanges) {
  for (const auto& [name, surface] : shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    const double diagonal = bounding_box_diagonal(surface.positions);
    Points points(surface);
    int hits = 0;
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = points.next();
      const auto face = i * 7 % static_cast<int>(surface.triangles.rows());
      const Vector3d d =
          ((corner(surface, face, 0) + corner(surface, face, 1) + corner(surface, face, 2)) / 3 - p)
              .normalized();
      const double start = std::round(winding_number(surface, p));
      const auto hit = tree.ray(p, d);
      const double step = 1e-6 * diagonal;
      if (hit.triangle < 0) {
        ASSERT_EQ(start, 0);
        continue;
      }
      ++hits;
      ASSERT_LT(tree.nearest(p + hit.distance * d).distance,
                1e-12 * (diagonal + surface.positions.cwiseAbs().maxCoeff()));
      EXPECT_EQ(std::round(winding_number(surface, p + (hit.distance - step) * d)), start);
      EXPECT_NE(std::round(winding_number(surface, p + (hit.distance + step) * d)), start);
      EXPECT_EQ(tree.ray(p, d, hit.distance * (1 - 1e-9)).triangle, -1);
      EXPECT_EQ(tree.ray(p, d, hit.distance * (1 + 1e-9)).triangle, hit.triangle);
    }
    EXPECT_GT(hits, 5);
  }
}

TEST(SurfaceTree, NoRaySlipsThroughSharedEdgesAndVertices) {
  for (const Vector3d& offset : {Vector3d(0, 0, 0), Vector3d(1e3, -7e3, 3e3)}) {
    for (const Surface& shape : {sphere(16), sphere(12, 0.1), cube()}) {
      const Surface surface = placed(shape, 1, offset);
      const SurfaceTree tree(surface);
      const Vector3d centre = surface.positions.colwise().mean();
      for (int f = 0; f < surface.triangles.rows(); ++f) {
        for (int k = 0; k < 3; ++k) {
          const Vector3d a = corner(surface, f, k);
          const Vector3d b = corner(surface, f, (k + 1) % 3);
          for (const double t : {0.0, 0.5, 0.25, 0.1}) {
            const Vector3d target = a + t * (b - a);
            const auto hit = tree.ray(centre, (target - centre).normalized());
            ASSERT_GE(hit.triangle, 0);
            ASSERT_NEAR(hit.distance, (target - centre).norm(), 1e-9 * (1 + offset.norm()));
            const Vector3d outside = centre + 5 * (target - centre);
            ASSERT_GE(tree.ray(outside, (centre - outside).normalized()).triangle, 0);
          }
        }
      }
    }
  }
}

TEST(SurfaceTree, RaysInAPlaneAreRays) {
  for (const auto& [name, surface] : shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    const double diagonal = bounding_box_diagonal(surface.positions);
    Points points(surface);
    for (int i = 0; i < 100; ++i) {
      const Vector3d p = points.next();
      const Vector3d n = (points.next() - p).normalized();
      const Vector3d u = n.unitOrthogonal();
      std::vector<Vector3d> directions(12);
      for (int k = 0; k < 12; ++k) {
        directions[k] = std::cos(pi * k / 6) * u + std::sin(pi * k / 6) * n.cross(u);
      }
      std::vector<double> distances(directions.size());
      for (const double limit : {0.1 * diagonal, infinity}) {
        tree.rays_in_plane(p, n, directions, limit, distances);
        for (std::size_t k = 0; k < directions.size(); ++k) {
          ASSERT_EQ(distances[k], tree.ray(p, directions[k], limit).distance);
        }
      }
    }
  }
}

TEST(SurfaceTree, NearAPlaneAreAllTrianglesThatItCrosses) {
  for (const auto& [name, surface] : shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    Points points(surface);
    std::size_t found = 0;
    std::size_t crossed = 0;
    for (int i = 0; i < 40; ++i) {
      const Vector3d p = points.next();
      const Vector3d n = (points.next() - p).normalized();
      const std::vector<int> near = tree.near_plane(p, n);
      ASSERT_TRUE(std::is_sorted(near.begin(), near.end()));
      ASSERT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
      found += near.size();
      for (int f = 0; f < surface.triangles.rows(); ++f) {
        int above = 0;
        for (int k = 0; k < 3; ++k) above += (corner(surface, f, k) - p).dot(n) >= 0 ? 1 : 0;
        if (above == 0 || above == 3) continue;
        ++crossed;
        ASSERT_TRUE(std::binary_search(near.begin(), near.end(), f));
      }
    }
    const auto all = static_cast<std::size_t>(surface.triangles.rows());
    // Leaves hold four: of a fine surface a plane comes near few that it misses.
    if (all > 1000) {
      ASSERT_LT(found, 8 * crossed + 4000);
    }
  }
}

TEST(SurfaceTree, InsideIsANonZeroWindingNumber) {
  for (const auto& [name, surface] : shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    Points points(surface);
    int inside = 0;
    for (int i = 0; i < 400; ++i) {
      const Vector3d p = points.next();
      const bool expected = std::abs(winding_number(surface, p)) > 0.5;
      inside += static_cast<int>(expected);
      ASSERT_EQ(tree.inside(p), expected);
      const double radius = tree.inscribed_radius(p);
      ASSERT_EQ(radius > 0, expected);
      ASSERT_EQ(std::abs(radius), tree.nearest(p).distance);
    }
    if (name != "long triangles") {
      EXPECT_GT(inside, 10);
    }
  }
}

TEST(SurfaceTree, InsideHoldsOnGridPointsThatAreAlignedWithEdges) {
  const SurfaceTree tree(cube());
  for (int i = -4; i <= 12; ++i) {
    for (int j = -4; j <= 12; ++j) {
      for (int k = -4; k <= 12; ++k) {
        const Vector3d p = Vector3d(i, j, k) / 8;
        const double margin = std::min({p.x(), p.y(), p.z(), 1 - p.x(), 1 - p.y(), 1 - p.z()});
        if (margin == 0) continue;
        ASSERT_EQ(tree.inside(p), margin > 0) << p.transpose();
        if (margin > 0) {
          ASSERT_NEAR(tree.inscribed_radius(p), margin, 1e-15);
        }
      }
    }
  }
}

TEST(SurfaceTree, AnInwardSurfaceWindsToo) {
  Surface surface = sphere(8);
  surface.triangles.col(0).swap(surface.triangles.col(1));
  const SurfaceTree tree(surface);
  EXPECT_TRUE(tree.inside({0.1, 0.2, 0.3}));
  EXPECT_FALSE(tree.inside({1.1, 0.2, 0.3}));
}

TEST(SurfaceTree, BallsOfRoundShapesHaveTheirRadius) {
  struct Case {
    Surface surface;
    double radius;
  };
  for (const auto& [surface, radius] : {Case{sphere(48), 1.0}, Case{torus(0.25, 96, 24), 0.25}}) {
    for (const double scale : {1.0, 1e-9, 1e9}) {
      const Surface scaled = placed(surface, scale, {scale, 0, 0});
      const SurfaceTree tree(scaled);
      const Positions normals = vertex_normals(scaled);
      for (int v = 0; v < scaled.positions.rows(); v += 17) {
        const Vector3d p = scaled.positions.row(v);
        const Vector3d n = -normals.row(v).transpose();
        const auto ball = tree.inscribed_ball(p, n);
        ASSERT_NEAR(ball.radius, radius * scale, 0.02 * radius * scale);
        ASSERT_NEAR((ball.centre - p - ball.radius * n).norm(), 0, 1e-12 * scale);
      }
    }
  }
}

TEST(SurfaceTree, BallsFromTheFacesOfACubeTouchWhatTheyShould) {
  const SurfaceTree tree(cube());
  std::mt19937 generator(3);
  std::uniform_real_distribution<> uniform(0.01, 0.99);
  for (int i = 0; i < 200; ++i) {
    const double x = uniform(generator);
    const double y = uniform(generator);
    // From z = 0 upward: the opposite face at 1, or a wall at the nearest side.
    const double expected = std::min({0.5, x, y, 1 - x, 1 - y});
    const auto ball = tree.inscribed_ball({x, y, 0}, {0, 0, 1});
    ASSERT_GE(ball.radius, expected * (1 - 1e-12));
    ASSERT_LE(ball.radius, expected / 0.995);
  }
}

TEST(SurfaceTree, BallsAreWhatDenseSamplingFinds) {
  constexpr double min_sine = 0.17364817766693033;
  constexpr int steps = 24;
  for (const Surface& surface : {sphere(12, 0.3), torus(0.3, 14, 9), torus(0.05, 6, 20)}) {
    const SurfaceTree tree(surface);
    int bounded = 0;
    const Positions normals = vertex_normals(surface);
    for (int v = 0; v < surface.positions.rows(); v += 3) {
      const Vector3d p = surface.positions.row(v);
      const Vector3d n = -normals.row(v).transpose();
      double sampled = std::numeric_limits<double>::infinity();
      for (int f = 0; f < surface.triangles.rows(); ++f) {
        const bool at_p = (surface.triangles.row(f).array() == v).any();
        for (int i = 0; i <= steps; ++i) {
          for (int j = 0; i + j <= steps; ++j) {
            const bool at_vertex = i == steps || j == steps || i + j == 0;
            if (at_p && !at_vertex) continue;
            const Vector3d e = (corner(surface, f, 0) * i + corner(surface, f, 1) * j +
                                corner(surface, f, 2) * (steps - i - j)) /
                                   steps -
                               p;
            const double height = n.dot(e);
            if (height < (at_vertex ? min_sine : 0.5) * e.norm() || e.norm() < 1e-9) continue;
            sampled = std::min(sampled, e.squaredNorm() / (2 * height));
          }
        }
      }
      const auto ball = tree.inscribed_ball(p, n);
      if (std::isinf(sampled)) {
        EXPECT_TRUE(std::isinf(ball.radius));
        continue;
      }
      ++bounded;
      EXPECT_LE(ball.radius, sampled * 1.05);
      EXPECT_GE(ball.radius, sampled * 0.95);
    }
    EXPECT_GT(bounded, 30);
  }
}

TEST(SurfaceTree, TheOrderOfTheTrianglesDoesNotMatter) {
  const Surface surface = sphere(16, 0.3);
  Surface shuffled = surface;
  std::vector<int> order(static_cast<std::size_t>(surface.triangles.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.triangles.row(static_cast<Eigen::Index>(i)) = surface.triangles.row(order[i]);
  }
  const SurfaceTree tree(surface);
  const SurfaceTree other(shuffled);
  Points points(surface);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = points.next();
    const Vector3d d = points.direction();
    EXPECT_DOUBLE_EQ(tree.inscribed_radius(p), other.inscribed_radius(p));
    EXPECT_EQ(tree.ray(p, d).distance, other.ray(p, d).distance);
    const auto ball = tree.inscribed_ball(surface.positions.row(i).transpose(), d);
    const auto same = other.inscribed_ball(surface.positions.row(i).transpose(), d);
    EXPECT_TRUE(ball.radius == same.radius || std::abs(ball.radius / same.radius - 1) < 0.006);
  }
}

TEST(SurfaceTree, IsTheSameFromAnyNumberOfThreads) {
  const Surface surface = sphere(120, 0.3);  // more than one thread's part
  ASSERT_GT(surface.triangles.rows(), 20000);
  const SurfaceTree alone(surface, 1);
  for (const int threads : {2, 5}) {
    const SurfaceTree tree(surface, threads);
    Points points(surface);
    for (int i = 0; i < 300; ++i) {
      const Vector3d p = points.next();
      const Vector3d d = points.direction();
      const SurfaceTree::Nearest nearest = tree.nearest(p);
      EXPECT_EQ(nearest.triangle, alone.nearest(p).triangle);
      EXPECT_EQ(nearest.distance, alone.nearest(p).distance);
      EXPECT_EQ(tree.ray(p, d).triangle, alone.ray(p, d).triangle);
      EXPECT_EQ(tree.inscribed_radius(p), alone.inscribed_radius(p));
      const Vector3d vertex = surface.positions.row(i).transpose();
      EXPECT_EQ(tree.inscribed_ball(vertex, d).radius, alone.inscribed_ball(vertex, d).radius);
    }
  }
}

TEST(SurfaceTree, DegenerateTrianglesChangeNothing) {
  const Surface surface = sphere(8, 0.2);
  Surface with = surface;
  const auto faces = surface.triangles.rows();
  with.triangles.conservativeResize(faces + 40, 3);
  for (Eigen::Index i = 0; i < 40; ++i) {
    const auto corners = surface.triangles.row(i);
    with.triangles.row(faces + i) << corners[0], corners[1], i % 2 == 0 ? corners[0] : corners[1];
  }
  const SurfaceTree tree(surface);
  const SurfaceTree other(with);
  Points points(surface);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = points.next();
    EXPECT_DOUBLE_EQ(tree.inscribed_radius(p), other.inscribed_radius(p));
    const Vector3d d = points.direction();
    EXPECT_EQ(tree.ray(p, d).distance, other.ray(p, d).distance);
  }
}

TEST(SurfaceTree, OneTriangleAndManyCoincidentOnesWork) {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const std::size_t copies : {1UL, 5UL, 1000UL}) {
    const SurfaceTree tree(surface_of(points, std::vector<std::array<int, 3>>(copies, {0, 1, 2})));
    EXPECT_EQ(tree.nearest({0.25, 0.25, 2}).distance, 2);
    EXPECT_EQ(tree.ray({0.25, 0.25, 2}, {0, 0, -1}).distance, 2);
    EXPECT_EQ(tree.ray({0.25, 0.25, 2}, {0, 0, 1}).triangle, -1);
  }
}

}  // namespace
}  // namespace curveskel::tree_laws
