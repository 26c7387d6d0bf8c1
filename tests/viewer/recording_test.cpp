// Laws of the recording of a run, against a plain account of what was added.
#include "viewer/model/recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "meshes/shapes.hpp"

namespace curveskel::viewer::recording_laws {
namespace {

using SharedSurface = std::shared_ptr<const ShownSurface>;

/// A fan of `size` triangles whose numbers tell it from all others.
SharedSurface fan(int size, float mark) {
  ShownSurface shown;
  for (int v = 0; v < size + 2; ++v) {
    shown.positions.emplace_back(mark, static_cast<float>(v), static_cast<float>(size));
    shown.normals.push_back(static_cast<std::uint32_t>(v));
  }
  std::vector<glm::uvec3> triangles;
  triangles.reserve(static_cast<std::size_t>(size));
  for (int f = 0; f < size; ++f) triangles.emplace_back(0, f + 1, f + 2);
  shown.triangles = std::move(triangles);
  return std::make_shared<const ShownSurface>(shown);
}

Moment surface_moment(const std::string& stage, int component, int iteration, SharedSurface shown) {
  Moment moment;
  moment.stage = stage;
  moment.component = component;
  moment.iteration = iteration;
  moment.surface = std::move(shown);
  return moment;
}

Moment skeleton_moment() {
  Moment moment;
  moment.stage = "skeleton";
  moment.skeleton = std::make_shared<const CurveSkeleton>();
  return moment;
}

/// As `extract` would tell it: component by component, fairing and then contraction.
std::vector<Moment> random_run(std::mt19937& random, int components) {
  std::vector<Moment> moments;
  float mark = 0;
  for (int component = 0; component < components; ++component) {
    for (const char* stage : {"fair", "contract"}) {
      const int iterations = static_cast<int>(random() % 4);
      for (int i = 0; i < iterations; ++i) {
        mark += 1;
        moments.push_back(
            surface_moment(stage, component, i, fan(1 + static_cast<int>(random() % 5), mark)));
      }
    }
  }
  moments.push_back(skeleton_moment());
  return moments;
}

/// The corners of all triangles as points: what is drawn, however it is numbered.
std::vector<glm::vec3> drawn(const ShownSurface& surface) {
  std::vector<glm::vec3> corners;
  for (const glm::uvec3& triangle : surface.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      corners.push_back(surface.positions.at(triangle[corner]));
    }
  }
  return corners;
}

TEST(Recording, BeginsWithTheInput) {
  const Recording recording;
  ASSERT_EQ(recording.moments().size(), 1U);
  EXPECT_EQ(recording.moments()[0].stage, "input");
  EXPECT_TRUE(recording.surface_at(0).positions.empty());
  EXPECT_EQ(recording.skeleton_at(0), nullptr);
}

TEST(Recording, ComposesTheLatestOfEachComponent) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    Recording recording;
    for (const Moment& moment : random_run(random, 1 + static_cast<int>(seed % 4))) {
      recording.add(moment);
    }
    std::map<int, SharedSurface> latest;
    for (std::size_t index = 0; index < recording.moments().size(); ++index) {
      const Moment& moment = recording.moments()[index];
      if (moment.surface) latest[moment.component] = moment.surface;
      std::vector<glm::vec3> expected;
      std::size_t vertices = 0;
      if (!moment.skeleton) {
        for (const auto& [component, surface] : latest) {
          const std::vector<glm::vec3> part = drawn(*surface);
          expected.insert(expected.end(), part.begin(), part.end());
          vertices += surface->positions.size();
        }
      }
      const ShownSurface whole = recording.surface_at(index);
      EXPECT_EQ(drawn(whole), expected);
      EXPECT_EQ(whole.positions.size(), vertices);
      EXPECT_EQ(whole.normals.size(), vertices);
    }
  }
}

TEST(Recording, HasEveryComponentAsItWasFaired) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    Recording recording;
    for (const Moment& moment : random_run(random, 1 + static_cast<int>(seed % 4))) {
      recording.add(moment);
    }
    const std::vector<Moment>& moments = recording.moments();
    for (std::size_t index = 0; index < moments.size(); ++index) {
      std::map<int, SharedSurface> faired;
      for (std::size_t i = moments.size(); i-- > 0;) {  // the first of those to come,
        if (moments[i].stage == "fair") faired[moments[i].component] = moments[i].surface;
      }
      for (std::size_t i = 0; i <= index; ++i) {  // but the last of those that came
        if (moments[i].stage == "fair") faired[moments[i].component] = moments[i].surface;
      }
      std::vector<glm::vec3> expected;
      for (const auto& [component, surface] : faired) {
        const std::vector<glm::vec3> part = drawn(*surface);
        expected.insert(expected.end(), part.begin(), part.end());
      }
      EXPECT_EQ(drawn(recording.faired_at(index)), expected);
    }
  }
}

TEST(Recording, CutFromAStageIsAsIfItHadNeverCome) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const std::vector<Moment> run = random_run(random, 1 + static_cast<int>(seed % 4));
    const std::vector<std::string> order{"fair", "contract", "skeleton"};
    for (auto stage = order.begin(); stage != order.end(); ++stage) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", " + *stage);
      Recording cut;
      Recording expected;
      for (const Moment& moment : run) {
        cut.add(moment);
        if (std::find(order.begin(), stage, moment.stage) != stage) expected.add(moment);
      }
      cut.cut_from(*stage);
      ASSERT_EQ(cut.moments().size(), expected.moments().size());
      EXPECT_EQ(drawn(cut.surface_at(cut.moments().size() - 1)),
                drawn(expected.surface_at(expected.moments().size() - 1)));
    }
  }
}

TEST(Recording, CutFromWhatNeverCameKeepsAll) {
  Recording recording;
  recording.add(surface_moment("contract", 0, 0, fan(3, 1)));
  recording.cut_from("skeleton");
  EXPECT_EQ(recording.moments().size(), 2U);
}

TEST(Recording, ShowsTheSkeletonFromItsMomentOn) {
  Recording recording;
  recording.add(surface_moment("contract", 0, 0, fan(3, 1)));
  const Moment skeleton = skeleton_moment();
  recording.add(skeleton);
  EXPECT_EQ(recording.skeleton_at(0), nullptr);
  EXPECT_EQ(recording.skeleton_at(1), nullptr);
  EXPECT_EQ(recording.skeleton_at(2), skeleton.skeleton);
  EXPECT_EQ(recording.skeleton_at(99), skeleton.skeleton);
  EXPECT_TRUE(recording.surface_at(99).positions.empty());
}

TEST(Recording, CopiesShareTheirSurfaces) {
  Recording recording;
  recording.add(surface_moment("contract", 0, 0, fan(3, 1)));
  Recording copy = recording;
  EXPECT_EQ(copy.moments()[1].surface, recording.moments()[1].surface);
  copy.cut_from("contract");
  EXPECT_EQ(recording.moments().size(), 2U);
}

// ---- Tries --------------------------------------------------------------------------------------

Moment of_try(Moment moment, int number, int of_surface, const std::string& name) {
  moment.try_number = number;
  moment.of_surface = of_surface;
  moment.try_name = name;
  return moment;
}

Moment curve_moment() {
  Moment moment = skeleton_moment();
  moment.stage = "surgery";
  return moment;
}

/// As asked, two components, the second of them cut twice; then faired, and this is kept.
std::vector<Try> faired_history() {
  const auto one = [](std::string_view name, int component, int part_of, Outcome outcome) {
    Try made;
    made.name = name;
    made.component = component;
    made.part_of = part_of;
    made.outcome = outcome;
    return made;
  };
  return {
      one(try_as_asked, -1, -1, Outcome::not_better), one(try_as_asked, 0, 0, Outcome::not_better),
      one(try_as_asked, 1, 0, Outcome::failed),       one(try_gentler, 1, 0, Outcome::not_better),
      one(try_faired, -1, -1, Outcome::kept),         one(try_as_asked, 0, 4, Outcome::kept),
      one(try_as_asked, 1, 4, Outcome::failed),       one(try_gentler, 1, 4, Outcome::kept)};
}

std::vector<Moment> faired_run() {
  const std::string gentler = "gentler contraction";
  return {of_try(surface_moment("contract", 0, 0, fan(1, 1)), 1, 0, "as asked"),
          of_try(curve_moment(), 1, 0, "as asked"),
          of_try(surface_moment("contract", 1, 0, fan(2, 2)), 2, 0, "as asked"),
          of_try(surface_moment("contract", 1, 0, fan(3, 3)), 3, 0, gentler),
          of_try(surface_moment("fair", 0, 1, fan(4, 4)), 4, 4, "faired"),
          of_try(surface_moment("contract", 0, 0, fan(5, 5)), 5, 4, "faired"),
          of_try(surface_moment("contract", 1, 0, fan(6, 6)), 6, 4, "faired"),
          of_try(surface_moment("contract", 1, 0, fan(7, 7)), 7, 4, "faired, " + gentler),
          skeleton_moment()};
}

// A second try's surfaces and curves lay on top of the first's.
TEST(Tries, DoNotMix) {
  Recording recording;
  const std::vector<Moment> run = faired_run();
  for (const Moment& moment : run) recording.add(moment);
  ASSERT_EQ(recording.moments().size(), run.size() + 1);
  EXPECT_EQ(drawn(recording.surface_at(1)), drawn(*run[0].surface));
  EXPECT_EQ(recording.surface_at(4).triangles.size(), 1U + 3U);
  EXPECT_NE(recording.skeleton_at(4), nullptr);
  EXPECT_EQ(drawn(recording.surface_at(5)), drawn(*run[4].surface));
  EXPECT_EQ(drawn(recording.faired_at(5)), drawn(*run[4].surface));
  EXPECT_EQ(drawn(recording.surface_at(6)), drawn(*run[5].surface));
  EXPECT_EQ(recording.skeleton_at(5), nullptr) << "of the try before";
  EXPECT_EQ(recording.skeleton_at(6), nullptr) << "of the try before";
  EXPECT_EQ(recording.skeleton_at(9), run[8].skeleton);
}

// Each moment had a copy of all that came before it.
TEST(Surgery, ShowsTheCurvesSoFarAndKeepsEachOnce) {
  constexpr int components = 5;
  Recording recording;
  Positions nodes(2, 3);
  Edges edges(1, 2);
  edges << 0, 1;
  for (int component = 0; component < components; ++component) {
    nodes.setConstant(component);
    recording.add(moment_of(CurveFrame{"surgery", component, nodes, edges}, 0));
    EXPECT_EQ(recording.moments().back().skeleton->nodes.rows(), 2);
  }
  for (int last = 0; last < components; ++last) {
    const std::size_t index = static_cast<std::size_t>(last) + 1;
    const auto shown = recording.skeleton_at(index);
    ASSERT_EQ(shown->nodes.rows(), 2 * (last + 1));
    for (int component = 0; component <= last; ++component) {
      EXPECT_EQ(shown->nodes.row(2 * component + 1), Eigen::RowVector3d::Constant(component));
      EXPECT_EQ(shown->edges.row(component), Eigen::RowVector2i(2 * component, 2 * component + 1));
    }
    EXPECT_EQ(recording.skeleton_at(index), shown) << "not another one, to be drawn again";
  }
}

TEST(Tries, OnlyTheOneThatWasKeptIsShownUnlessAllAre) {
  Recording recording;
  const std::vector<Moment> run = faired_run();
  for (const Moment& moment : run) recording.add(moment);
  EXPECT_FALSE(recording.has_other_tries());
  recording.settle(faired_history());
  EXPECT_TRUE(recording.has_other_tries());
  const auto titles = [&] {
    std::vector<std::string> all;
    for (const Moment& moment : recording.moments()) all.push_back(title_of(moment));
    return all;
  };
  const std::vector<std::string> kept{"input", "fairing 1 (faired)", "contraction 0 (faired)",
                                      "contraction 0 (faired, gentler contraction)", "skeleton"};
  EXPECT_EQ(titles(), kept);
  recording.show_all_tries(true);
  EXPECT_EQ(recording.moments().size(), run.size() + 1);
  recording.show_all_tries(false);
  EXPECT_EQ(titles(), kept);
  recording.cut_from("skeleton");
  EXPECT_EQ(recording.moments().size(), kept.size() - 1);
  recording.show_all_tries(true);
  EXPECT_EQ(recording.moments().size(), run.size());
  recording.cut_from("fair");
  EXPECT_EQ(recording.moments().size(), 1U);
  EXPECT_FALSE(recording.has_other_tries());
}

TEST(Tries, OfAnotherRunThatHaveTheSameNumberAreNotTaken) {
  Recording recording;
  for (const Moment& moment : faired_run()) recording.add(moment);
  std::vector<Try> history = faired_history();
  history[4].name = "all vertices";  // the new run has another try in its place
  recording.settle(history);
  EXPECT_EQ(recording.moments().size(), 2U) << "input and skeleton";
}

TEST(TitleOf, IsWhatTheCommandLineCallsIt) {
  EXPECT_EQ(title_of(surface_moment("contract", 0, 3, nullptr)), "contraction 3");
  EXPECT_EQ(title_of(surface_moment("fair", 0, 12, nullptr)), "fairing 12");
  EXPECT_EQ(title_of(skeleton_moment()), "skeleton");
  EXPECT_EQ(title_of(Recording().moments()[0]), "input");
}

TEST(MomentOf, KeepsTheFrame) {
  const shapes::Shape shape = shapes::torus(3, 1, 8);
  const Frame frame{"contract", 2, 5, 0.25, 0.125, 1e-6, shape.surface};
  const Moment moment = moment_of(frame, DrawnSpace{}, 1.5);
  EXPECT_EQ(moment.stage, "contract");
  EXPECT_EQ(moment.component, 2);
  EXPECT_EQ(moment.iteration, 5);
  EXPECT_EQ(moment.area_ratio, 0.25);
  EXPECT_EQ(moment.volume_ratio, 0.125);
  EXPECT_EQ(moment.residual, 1e-6);
  EXPECT_EQ(moment.seconds, 1.5);
  ASSERT_TRUE(moment.surface);
  EXPECT_EQ(moment.surface->positions.size(),
            static_cast<std::size_t>(shape.surface.positions.rows()));
}

TEST(MomentOf, FarFromTheOriginKeepsItsDigits) {
  const shapes::Shape near = shapes::torus(3, 1, 8);
  const Moment expected = moment_of({"contract", 0, 0, 1, 1, 0, near.surface}, DrawnSpace{}, 0);
  for (const double offset : {1e3, 1e6, 1e9}) {
    const Eigen::RowVector3d origin(offset, -2 * offset, offset / 3);
    const shapes::Shape far = shapes::translated(near, origin.transpose());
    const Moment moment = moment_of({"contract", 0, 0, 1, 1, 0, far.surface}, {origin}, 0);
    const double step = 4 * offset * std::numeric_limits<double>::epsilon();  // of the input itself
    for (std::size_t v = 0; v < expected.surface->positions.size(); ++v) {
      EXPECT_LT(glm::distance(glm::dvec3(moment.surface->positions[v]),
                              glm::dvec3(expected.surface->positions[v])),
                step + 1e-6)
          << "offset " << offset;
    }
  }
}

TEST(MomentOf, ALargeSurfaceHasASimplerFormThatMovesWithIt) {
  Surface surface = shapes::torus(3, 1, 60).surface;
  const DrawnSpace space;
  const Moment first = moment_of({"contract", 0, 0, 1, 1, 0, surface}, space, 0);
  const auto& fewer = first.surface->fewer;
  ASSERT_FALSE(fewer.empty());
  EXPECT_LT(fewer.size(), first.surface->triangles.size() / 2);
  for (const glm::uvec3& triangle : fewer) {
    for (int corner = 0; corner < 3; ++corner) {
      EXPECT_LT(triangle[corner], first.surface->positions.size());
    }
  }
  surface.positions *= 0.1;  // where it would be clustered otherwise
  surface.positions.col(0) *= 0.01;
  const Moment next =
      moment_of({"contract", 0, 1, 1, 1, 0, surface}, space, 0, first.surface.get());
  EXPECT_EQ(next.surface->fewer, fewer);
  EXPECT_EQ(&next.surface->triangles.list(), &first.surface->triangles.list()) << "kept once";
  EXPECT_EQ(&next.surface->fewer.list(), &fewer.list());
  const Surface small = shapes::torus(3, 1, 10).surface;
  const Moment other = moment_of({"contract", 1, 0, 1, 1, 0, small}, space, 0, next.surface.get());
  EXPECT_TRUE(other.surface->fewer.empty());
  Recording recording;
  recording.add(first);
  EXPECT_EQ(recording.surface_at(1).fewer, fewer);
  recording.add(other);
  EXPECT_EQ(recording.surface_at(2).fewer.size(), fewer.size() + other.surface->triangles.size());
}

}  // namespace
}  // namespace curveskel::viewer::recording_laws
