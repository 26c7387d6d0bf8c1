// A limb with a hollow in its end, as an animal's muzzle with its mouth, has its curve up to the
// end, however deep the hollow is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <curveskel/extract.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::pocket_laws {
namespace {

constexpr double half_length = 5;

/// A tube along x of radius 1 with round ends; its last end has a slit at height `z` that leads
/// back along the tube and narrows all the way.
Surface tube_with_mouth(double depth, double z, double half_width, double half_height) {
  Surface tube =
      shapes::tube("tube", shapes::straight(2 * half_length), shapes::constant(1), 64).surface;
  for (auto p : tube.positions.rowwise()) {
    if (p.x() <= half_length) continue;
    const double off = std::hypot(p.y() / half_width, (p.z() - z) / half_height);
    p.x() -= depth * std::pow(std::clamp(1 - off, 0.0, 1.0), 0.7);
  }
  return tube;
}

double distance_to(const CurveSkeleton& skeleton, const Eigen::Vector3d& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& node : skeleton.nodes.rowwise()) {
    least = std::min(least, (node.transpose() - place).norm());
  }
  return least;
}

TEST(Pockets, DoNotShortenTheLimbThatTheyAreIn) {
  struct Mouth {
    double depth, z, half_width, half_height;
  };
  for (const Mouth& mouth : {Mouth{4, -0.4, 0.6, 0.25}, Mouth{6, -0.4, 0.6, 0.2},
                             Mouth{5, -0.3, 0.4, 0.3}, Mouth{7, -0.5, 0.5, 0.3}}) {
    const Extraction found =
        extract(tube_with_mouth(mouth.depth, mouth.z, mouth.half_width, mouth.half_height));
    EXPECT_TRUE(found.certificate.topology_correct() && found.certificate.inside_enough);
    EXPECT_EQ(found.certificate.tips, 2) << "depth " << mouth.depth;
    for (const double end : {-half_length, half_length}) {
      EXPECT_LT(distance_to(found.skeleton, {end, 0, 0}), 0.75)
          << "depth " << mouth.depth << ", end " << end;
    }
  }
}

}  // namespace
}  // namespace curveskel::pocket_laws
