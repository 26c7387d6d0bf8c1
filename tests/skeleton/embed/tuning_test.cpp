// Laws of the embedding's constants: a tenth more or less of any leaves the graph as it is.
#include "skeleton/embed/tuning.hpp"

#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/embed.hpp>
#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/step_clock.hpp>
#include <curveskel/advanced/surgery.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/contract.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/read.hpp>
#include <curveskel/topology.hpp>
#include "skeleton/embed/embed_tuned.hpp"
#include "surface/resample/canonical.hpp"
#include "tests/real_surfaces.hpp"

namespace curveskel::tuning_laws {
namespace {

struct Constants {
  EmbedTuning tuning;
  EmbedOptions options;
};

struct Constant {
  const char* name;
  void (*multiply)(Constants& all, double factor);
};

#define CURVESKEL_CONSTANT(member)                                        \
  Constant {                                                              \
#member, [](Constants & all, double factor) { all.member *= factor; } \
  }

/// All numbers of the embedding that are no counts of rounds, nor what the user asks for (detail).
constexpr std::array constants{
    CURVESKEL_CONSTANT(tuning.spacing.least),
    CURVESKEL_CONSTANT(tuning.spacing.most),
    CURVESKEL_CONSTANT(tuning.spacing.of_edge),
    CURVESKEL_CONSTANT(tuning.spacing.straight),
    CURVESKEL_CONSTANT(tuning.spacing.bend),
    CURVESKEL_CONSTANT(tuning.spacing.least_bend),
    CURVESKEL_CONSTANT(tuning.section.ray_limit),
    CURVESKEL_CONSTANT(tuning.section.longest_step),
    CURVESKEL_CONSTANT(tuning.relax.rest),
    CURVESKEL_CONSTANT(tuning.relax.section_rest),
    CURVESKEL_CONSTANT(tuning.relax.section_turn),
    CURVESKEL_CONSTANT(tuning.relax.axes_hold),
    CURVESKEL_CONSTANT(tuning.relax.spur_margin),
    CURVESKEL_CONSTANT(tuning.relax.detour_reach),
    CURVESKEL_CONSTANT(tuning.relax.detour_length),
    CURVESKEL_CONSTANT(tuning.relax.tip_keep),
    CURVESKEL_CONSTANT(tuning.relax.heading_way),
    CURVESKEL_CONSTANT(tuning.tips.corner_reach),
    CURVESKEL_CONSTANT(tuning.tips.narrow),
    CURVESKEL_CONSTANT(tuning.tips.tolerance),
    CURVESKEL_CONSTANT(tuning.tips.least_radius),
    CURVESKEL_CONSTANT(tuning.tips.leaf_margin),
    CURVESKEL_CONSTANT(tuning.tips.leaf_narrowest),
    CURVESKEL_CONSTANT(tuning.growth.least_branch),
    CURVESKEL_CONSTANT(tuning.growth.least_extension),
    CURVESKEL_CONSTANT(tuning.growth.least_branch_ball),
    CURVESKEL_CONSTANT(tuning.growth.least_extension_ball),
    CURVESKEL_CONSTANT(tuning.growth.most_ball),
    CURVESKEL_CONSTANT(tuning.growth.least_extension_prominence),
    CURVESKEL_CONSTANT(tuning.growth.entered),
    CURVESKEL_CONSTANT(tuning.growth.beyond),
    CURVESKEL_CONSTANT(tuning.growth.least_tip_ball),
    CURVESKEL_CONSTANT(tuning.bottleneck.wider),
    CURVESKEL_CONSTANT(tuning.bottleneck.cheaper),
    CURVESKEL_CONSTANT(tuning.bottleneck.shortest),
    CURVESKEL_CONSTANT(tuning.prominence),
    CURVESKEL_CONSTANT(tuning.convex_dent),
    CURVESKEL_CONSTANT(tuning.spur),
    CURVESKEL_CONSTANT(options.merge),
    CURVESKEL_CONSTANT(options.straight),
    CURVESKEL_CONSTANT(options.straight_at_last),
    CURVESKEL_CONSTANT(options.keep_radius),
    CURVESKEL_CONSTANT(options.tip_reach),
    CURVESKEL_CONSTANT(options.tip_gap),
};

#undef CURVESKEL_CONSTANT

/// Tips, junctions, cycles.
using Shape = std::array<std::int64_t, 3>;

/// A surface up to the embedding, which alone is repeated.
class CutSurface {
 public:
  explicit CutSurface(const Surface& given)
      : canonical_(canonical_form(given)),
        working_(coarsen(canonical_.surface).surface),
        tree_(working_),
        full_tree_(canonical_.surface),
        balls_(inscribed_balls(working_, full_tree_, 0)) {
    const Positions targets = smoothed_centres(working_, balls_, 2);
    partition_ = surgery(working_, contract(working_, targets, {}, {}), {}, {});
  }

  [[nodiscard]] bool is_cut() const { return partition_.has_value(); }

  [[nodiscard]] Shape embedded(const Constants& with) const {
    StepClock unread;
    const std::optional<CurveSkeleton> skeleton =
        embed_tuned({working_, tree_, [this]() -> const SurfaceTree& { return full_tree_; }, balls_,
                     *partition_},
                    with.options, with.tuning, {}, unread, {});
    const GraphTopology counted = graph_topology(*skeleton);
    return {counted.tips, counted.junctions, counted.cycle_rank};
  }

 private:
  Canonical canonical_;
  Surface working_;
  SurfaceTree tree_;
  SurfaceTree full_tree_;
  InscribedBalls balls_;
  std::optional<PartitionGraph> partition_;
};

/// Surface, constant, factor.
using Moved = std::tuple<std::string_view, std::string_view, double>;

/// Cases in which a tenth makes another graph; one that is overcome fails until it is struck off.
const std::set<Moved> known{
    // Two of their legs meet within a ball, or do not.
    {"scorpion-6k.obj", "options.merge", 1.1},
    {"spot-3k.obj", "options.merge", 1.1},
    // A short leaf reaches out of its junction's ball, or does not.
    {"spot-3k.obj", "tuning.tips.leaf_narrowest", 1.1},
    // Its muzzle is hardly more prominent than that.
    {"spot-3k.obj", "tuning.prominence", 1.1},
};

TEST(Tuning, ATenthOfAConstantLeavesTheGraphAsItIs) {
  for (const auto& file :
       present_among({"spot-3k.obj", "humanoid-10k.ply", "casting-5k-inward.off", "cactus-5k.ply",
                      "octopus-17k.ply", "scorpion-6k.obj", "dancer-25k.ply", "hand-10k.ply",
                      "twirl-5k.off", "armadillo-43k.ply", "femur-4k.off"})) {
    const CutSurface cut(clean(read_polygons(*real_surface(file), {}), {}).surface);
    ASSERT_TRUE(cut.is_cut()) << file;
    const Shape usual = cut.embedded({});
    for (const Constant& constant : constants) {
      for (const double factor : {0.9, 1.1}) {
        Constants moved;
        constant.multiply(moved, factor);
        const Shape found = cut.embedded(moved);
        const bool is_known = known.contains({file, constant.name, factor});
        if (is_known && found != usual) {
          std::cout << "[  KNOWN   ] " << file << ": " << constant.name << " x " << factor << '\n';
          continue;
        }
        EXPECT_EQ(found, usual) << file << ": " << constant.name << " x " << factor;
        EXPECT_FALSE(is_known) << file << ": " << constant.name << " x " << factor
                               << " is overcome, strike it off the list";
      }
    }
  }
}

}  // namespace
}  // namespace curveskel::tuning_laws
