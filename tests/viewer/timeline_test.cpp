// Laws of the timeline's plots: one component at a time, each value on a scale that shows it.
#include "viewer/window/timeline.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

namespace curveskel::viewer::timeline_laws {
namespace {

Moment moment(const char* stage, int component, double residual = 0) {
  Moment made;
  made.stage = stage;
  made.component = component;
  made.residual = residual;
  const bool has_surface = made.stage == "fair" || made.stage == "contract";
  ShownSurface surface;
  surface.positions.resize(component == 1 ? 200 : 100);
  if (has_surface) made.surface = std::make_shared<const ShownSurface>(std::move(surface));
  return made;
}

/// Two components at once.
std::vector<Moment> recorded() {
  return {moment("input", 0),           moment("contract", 0, 3e-11), moment("contract", 1, 1e-13),
          moment("contract", 0, 1e-12), moment("surgery", 0),         moment("contract", 1, 1e-15),
          moment("surgery", 1),         moment("skeleton", 0)};
}

TEST(Timeline, IsOfTheComponentThatIsShown) {
  const std::vector<Moment> moments = recorded();
  const std::vector<int> shown{1, 0, 1, 0, 0, 1, 1, 1};
  for (std::size_t i = 0; i < moments.size(); ++i) EXPECT_EQ(component_at(moments, i), shown[i]);
  EXPECT_EQ(component_at({moment("input", 0)}, 0), -1);
  EXPECT_EQ(moments_with(moments, 0), (std::vector<std::size_t>{0, 1, 3, 4, 7}));
  EXPECT_EQ(moments_with(moments, 1), (std::vector<std::size_t>{0, 2, 5, 6, 7}));
}

TEST(Timeline, ResidualsFillTheirPlotHoweverSmallTheyAre) {
  const std::vector<Moment> moments = recorded();
  for (const int component : {0, 1}) {
    const auto plotted = moments_with(moments, component);
    const PlotRange range = range_of_residuals(moments, plotted);
    EXPECT_FLOAT_EQ(height_of(moments[plotted[1]].residual, range), 1);
    EXPECT_FLOAT_EQ(height_of(moments[plotted[2]].residual, range), 0);
  }
}

TEST(Timeline, ResidualsThatAreAlikeStandInTheMiddle) {
  const std::vector<Moment> moments{moment("contract", 0, 2e-12), moment("contract", 0, 2e-12)};
  const PlotRange range = range_of_residuals(moments, {0, 1});
  EXPECT_NEAR(height_of(2e-12, range), 0.5, 1e-6);
  EXPECT_EQ(height_of(0, range), 0) << "nothing was solved";
  EXPECT_EQ(height_of(1, range_of_residuals({moment("fair", 0)}, {0})), 1);
}

}  // namespace
}  // namespace curveskel::viewer::timeline_laws
