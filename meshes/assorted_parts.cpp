#include <Eigen/Geometry>
#include <cmath>

#include "meshes/random.hpp"
#include "meshes/shapes.hpp"

namespace curveskel::shapes {
namespace {

/// As far from the smaller as from the larger, in ratios.
double between(Random& random, double smallest, double largest) {
  return smallest * std::pow(largest / smallest, random.uniform(0, 1));
}

Shape shape_of(const AssortedPart& part, double width) {
  const double size = part.size;
  const double thick = part.thickness;
  switch (part.kind) {
    case PartKind::ball:
      return ellipsoid({size / 2, width / 2, thick / 2}, 2);
    case PartKind::rod:
      return tube("rod", straight(size - thick), constant(thick / 2), 8);
    case PartKind::ribbon:
      return rolled(box({1.5 * size, width, thick}, 24), size / 2);
    case PartKind::sheet:
      return box({size, width, thick}, 8);
    default:
      return box({size, width, thick}, 1);
  }
}

AssortedPart part(Random& random) {
  AssortedPart result;
  result.kind = static_cast<PartKind>(random.index(5));
  result.size = between(random, 0.01, 1);
  const bool is_thin = result.kind == PartKind::sheet || result.kind == PartKind::ribbon;
  result.thickness = result.size * (is_thin ? between(random, 1.0 / 300, 1.0 / 20)
                                            : between(random, 1.0 / 10, 0.9));
  const double width = std::max(result.thickness, result.size * between(random, 0.1, 1));
  result.shape = shape_of(result, width);
  const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
  result.shape = rotated(std::move(result.shape), axis, random.uniform(0, 3));
  return result;
}

}  // namespace

std::vector<AssortedPart> assorted_parts(int count, std::uint64_t seed) {
  constexpr double cell = 2.2;  // the longest diagonal of a part, and room
  Random random(seed);
  const int side = static_cast<int>(std::ceil(std::cbrt(count)));
  std::vector<AssortedPart> parts;
  for (int i = 0; i < count; ++i) {
    AssortedPart one = part(random);
    const Eigen::RowVector3d low = one.shape.surface.positions.colwise().minCoeff();
    const Eigen::RowVector3d high = one.shape.surface.positions.colwise().maxCoeff();
    const Eigen::RowVector3d room = (cell - (high - low).array()).cwiseMax(0);
    const int row = i / side;
    const int layer = row / side;
    Eigen::RowVector3d corner(i % side, row % side, layer);
    corner *= cell;
    for (int k = 0; k < 3; ++k) corner[k] += random.uniform(0, 0.9) * room[k];
    one.shape = translated(std::move(one.shape), (corner - low).transpose());
    parts.push_back(std::move(one));
  }
  return parts;
}

}  // namespace curveskel::shapes
