// The first face that a ray hits is the tree's, over all families and from everywhere.
#include "viewer/render/face_blocks.hpp"

#include <gtest/gtest.h>

#include <random>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include "tests/surfaces.hpp"

namespace curveskel::viewer::face_blocks_laws {
namespace {

class Rays {
 public:
  explicit Rays(const Surface& surface)
      : middle_(surface.positions.colwise().mean()),
        reach_(bounding_box_diagonal(surface.positions)) {}
  Eigen::Vector3d somewhere() { return middle_ + reach_ * deviates(); }
  /// Across the middle of things, more or less.
  Eigen::Vector3d direction(const Eigen::Vector3d& from) {
    return (somewhere() - from).normalized();
  }

 private:
  Eigen::Vector3d deviates() { return {deviate_(random_), deviate_(random_), deviate_(random_)}; }
  Eigen::Vector3d middle_;
  double reach_;
  std::mt19937 random_{11};
  std::normal_distribution<double> deviate_{0, 0.4};
};

TEST(FaceBlocks, FirstFaceIsTheTrees) {
  int hits = 0;
  for (const NamedSurface& family : make_families()) {
    SCOPED_TRACE(family.name);
    const FaceBlocks blocks(family.surface);
    const SurfaceTree tree(family.surface);
    Rays rays(family.surface);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d from = rays.somewhere();
      const Eigen::Vector3d along = rays.direction(from);
      const FaceBlocks::Hit found = blocks.first(family.surface, from, along);
      const auto wanted = tree.ray(from, along);
      ASSERT_EQ(found.face < 0, wanted.triangle < 0);
      if (found.face < 0) continue;
      ++hits;
      EXPECT_NEAR(found.distance, wanted.distance, 1e-9 * (1 + wanted.distance));
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(FaceBlocks, LengthOfTheDirectionIsTheUnit) {
  const Surface box = shapes::box({1, 2, 3}, 8).surface;
  const FaceBlocks blocks(box);
  const Eigen::Vector3d middle = box.positions.colwise().mean();
  const auto once = blocks.first(box, middle, {0, 0, 1});
  const auto twice = blocks.first(box, middle, {0, 0, 2});
  EXPECT_EQ(once.face, twice.face);
  EXPECT_NEAR(once.distance, 2 * twice.distance, 1e-12);
}

TEST(FaceBlocks, NothingToHit) {
  EXPECT_EQ(FaceBlocks().first({}, {0, 0, 0}, {1, 0, 0}).face, -1);
  const Surface box = shapes::box({1, 2, 3}, 8).surface;
  EXPECT_EQ(FaceBlocks(box).first(box, {100, 0, 0}, {1, 0, 0}).face, -1);
}

}  // namespace
}  // namespace curveskel::viewer::face_blocks_laws
