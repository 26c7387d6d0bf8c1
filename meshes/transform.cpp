#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "meshes/random.hpp"
#include "meshes/shapes.hpp"

namespace curveskel::shapes {

Shape scaled(Shape shape, double factor) {
  shape.surface.positions *= factor;
  shape.axis.nodes *= factor;
  shape.axis.radii *= factor;
  return shape;
}

Shape translated(Shape shape, const Eigen::Vector3d& offset) {
  shape.surface.positions.rowwise() += offset.transpose();
  shape.axis.nodes.rowwise() += offset.transpose();
  return shape;
}

Shape rotated(Shape shape, const Eigen::Vector3d& direction, double angle) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(angle, direction.normalized()).toRotationMatrix().transpose();
  shape.surface.positions = (shape.surface.positions * turn).eval();
  shape.axis.nodes = (shape.axis.nodes * turn).eval();
  return shape;
}

Shape renumbered(Shape shape, std::uint64_t seed) {
  Random random(seed);
  const Surface old = shape.surface;
  const std::vector<int> place = random.permutation(static_cast<int>(old.positions.rows()));
  const std::vector<int> face = random.permutation(static_cast<int>(old.triangles.rows()));
  for (Eigen::Index i = 0; i < old.positions.rows(); ++i)
    shape.surface.positions.row(place[static_cast<std::size_t>(i)]) = old.positions.row(i);
  for (Eigen::Index f = 0; f < old.triangles.rows(); ++f) {
    const auto first = static_cast<int>(random.index(3));
    for (int k = 0; k < 3; ++k) {
      const int vertex = old.triangles(f, (first + k) % 3);
      shape.surface.triangles(face[static_cast<std::size_t>(f)], k) =
          place[static_cast<std::size_t>(vertex)];
    }
  }
  return shape;
}

Shape noisy(Shape shape, double sigma, std::uint64_t seed) {
  Random random(seed);
  Positions& x = shape.surface.positions;
  Positions normals = Positions::Zero(x.rows(), 3);
  for (Eigen::Index f = 0; f < shape.surface.triangles.rows(); ++f) {
    const auto t = shape.surface.triangles.row(f);
    const Eigen::Vector3d a = x.row(t[0]);
    const Eigen::Vector3d b = x.row(t[1]);
    const Eigen::Vector3d c = x.row(t[2]);
    const Eigen::RowVector3d normal = (b - a).cross(c - a).transpose();
    for (int k = 0; k < 3; ++k) normals.row(t[k]) += normal;
  }
  normals.rowwise().normalize();
  for (Eigen::Index i = 0; i < x.rows(); ++i) x.row(i) += sigma * random.normal() * normals.row(i);
  return shape;
}

Shape subdivided(Shape shape) {
  const Surface old = std::move(shape.surface);
  const Eigen::Index vertices = old.positions.rows();
  const Eigen::Index faces = old.triangles.rows();
  Surface fine;
  fine.positions.resize(vertices + faces * 3 / 2, 3);
  fine.positions.topRows(vertices) = old.positions;
  fine.triangles.resize(faces * 4, 3);
  std::unordered_map<std::uint64_t, int> middle;
  auto next = static_cast<int>(vertices);
  for (Eigen::Index f = 0; f < faces; ++f) {
    int corner[3];
    int half[3];
    for (int k = 0; k < 3; ++k) {
      corner[k] = old.triangles(f, k);
      const int other = old.triangles(f, (k + 1) % 3);
      const auto low = static_cast<std::uint64_t>(std::min(corner[k], other));
      const auto high = static_cast<std::uint64_t>(std::max(corner[k], other));
      const auto [found, is_new] = middle.try_emplace(low << 32U | high, next);
      if (is_new)
        fine.positions.row(next++) = (old.positions.row(corner[k]) + old.positions.row(other)) / 2;
      half[k] = found->second;
    }
    for (int k = 0; k < 3; ++k)
      fine.triangles.row(4 * f + k) << corner[k], half[k], half[(k + 2) % 3];
    fine.triangles.row(4 * f + 3) << half[0], half[1], half[2];
  }
  shape.surface = std::move(fine);
  return shape;
}

Shape rolled(Shape shape, double radius) {
  for (auto p : shape.surface.positions.rowwise()) {
    const double angle = p.x() / radius;
    const double out = radius + p.z();
    p << out * std::sin(angle), p.y(), out * std::cos(angle) - radius;
  }
  shape.axis = {};
  shape.tips = shape.junctions = -1;
  return shape;
}

Shape together(std::string name, const std::vector<Shape>& parts) {
  Shape all;
  all.name = std::move(name);
  all.components = all.tips = all.junctions = 0;
  Eigen::Index vertices = 0;
  Eigen::Index faces = 0;
  Eigen::Index nodes = 0;
  Eigen::Index edges = 0;
  for (const Shape& part : parts) {
    vertices += part.surface.positions.rows();
    faces += part.surface.triangles.rows();
    nodes += part.axis.nodes.rows();
    edges += part.axis.edges.rows();
    all.genus += part.genus;
    all.components += part.components;
    all.cycles += part.cycles;
    all.tips = all.tips < 0 || part.tips < 0 ? -1 : all.tips + part.tips;
    all.junctions = all.junctions < 0 || part.junctions < 0 ? -1 : all.junctions + part.junctions;
  }
  all.surface.positions.resize(vertices, 3);
  all.surface.triangles.resize(faces, 3);
  all.axis.nodes.resize(nodes, 3);
  all.axis.radii.resize(nodes);
  all.axis.edges.resize(edges, 2);
  vertices = faces = nodes = edges = 0;
  for (const Shape& part : parts) {
    const Surface& surface = part.surface;
    const CurveSkeleton& axis = part.axis;
    all.surface.positions.middleRows(vertices, surface.positions.rows()) = surface.positions;
    all.surface.triangles.middleRows(faces, surface.triangles.rows()) =
        surface.triangles.array() + static_cast<std::int32_t>(vertices);
    all.axis.nodes.middleRows(nodes, axis.nodes.rows()) = axis.nodes;
    all.axis.radii.segment(nodes, axis.radii.size()) = axis.radii;
    all.axis.edges.middleRows(edges, axis.edges.rows()) =
        axis.edges.array() + static_cast<std::int32_t>(nodes);
    vertices += surface.positions.rows();
    faces += surface.triangles.rows();
    nodes += axis.nodes.rows();
    edges += axis.edges.rows();
  }
  return all;
}

}  // namespace curveskel::shapes
