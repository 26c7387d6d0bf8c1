// Chains of inscribed balls, and those that must do without a step.
#include "skeleton/embed/contain/ball_chains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/tree.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::ball_chains_laws {
namespace {

class BallChainsOfATube : public testing::Test {
 protected:
  BallChainsOfATube() {
    graph_.groups = 1;
    graph_.group_of_vertex = Eigen::VectorXi::Zero(surface_.positions.rows());
    const auto x = surface_.positions.col(0);
    x.minCoeff(&first_);
    x.maxCoeff(&last_);
  }

  std::vector<int> way() { return chains_.way(first_, last_, {0}); }
  static bool takes(const std::vector<int>& way, int one, int other) {
    for (std::size_t i = 1; i < way.size(); ++i) {
      if (std::minmax(way[i - 1], way[i]) == std::minmax(one, other)) return true;
    }
    return false;
  }

  const Surface surface_ =
      shapes::tube("tube", shapes::straight(8), shapes::wavy(1, 0.3, 3), 24).surface;
  const SurfaceTree tree_{surface_};
  const InscribedBalls balls_ = inscribed_balls(surface_, tree_, 1);
  PartitionGraph graph_;
  WorkingSurface working_{surface_, balls_};
  BallChains chains_{working_, graph_};
  int first_ = 0;
  int last_ = 0;
};

TEST_F(BallChainsOfATube, GoRoundEachStepThatTheyAvoid) {
  const auto straight = way();
  ASSERT_GT(straight.size(), 4U);
  for (std::size_t i = 1; i < straight.size(); ++i) {
    chains_.avoid(straight[i], straight[i - 1]);
    const auto round = way();
    ASSERT_FALSE(round.empty());
    for (std::size_t k = 1; k <= i; ++k) {
      EXPECT_FALSE(takes(round, straight[k - 1], straight[k])) << k << " of " << i;
    }
  }
  chains_.allow_all();
  EXPECT_EQ(way(), straight);
}

TEST_F(BallChainsOfATube, AreNoneWhereAllStepsAreAvoided) {
  for (const auto& t : surface_.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      if (t(k) == first_) {
        chains_.avoid(first_, t((k + 1) % 3));
        chains_.avoid(t((k + 2) % 3), first_);
      }
    }
  }
  EXPECT_TRUE(way().empty());
}

}  // namespace
}  // namespace curveskel::ball_chains_laws
