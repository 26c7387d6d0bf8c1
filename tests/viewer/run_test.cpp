// Laws of a run on its own thread; also for ThreadSanitizer. Waits are bounded by a minute, which
// only a hang takes.
#include "viewer/model/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <random>
#include <thread>

#include "meshes/shapes.hpp"

namespace curveskel::viewer::run_laws {
namespace {

using namespace std::chrono_literals;
using State = Run::State;

constexpr auto patience = 60s;

Surface small_surface() { return shapes::torus(3, 1, 10).surface; }

/// A run and all of its news so far.
class Watched {
 public:
  explicit Watched(const Surface& surface, bool paused = false, RunOptions options = {},
                   std::shared_ptr<RunMemory> memory = std::make_shared<RunMemory>())
      : run_(std::make_unique<Run>(std::make_shared<const PolygonSoup>(soup_of(surface)),
                                   std::move(options), DrawnSpace{}, std::move(memory), paused)) {}

  Run& run() { return *run_; }
  void look() {
    Run::News news = run_->take();
    state = news.state;
    for (Moment& moment : news.moments) moments.push_back(std::move(moment));
    if (news.result) {
      EXPECT_FALSE(result) << "the result came twice";
      result = std::move(news.result);
    }
    error = news.error;
    fault = news.fault;
  }
  /// False where it did not come about.
  bool wait(const std::function<bool()>& wanted) {
    const auto end = std::chrono::steady_clock::now() + patience;
    for (look(); !wanted(); look()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(1ms);
    }
    return true;
  }
  bool wait_for(State wanted) {
    return wait([&] { return state == wanted; });
  }
  bool ended() const {
    return state == State::finished || state == State::cancelled || state == State::failed;
  }

  State state = State::running;
  std::vector<Moment> moments;
  std::optional<RunResult> result;
  std::string error;
  Fault fault = Fault::solver;

 private:
  std::unique_ptr<Run> run_;
};

struct Timed {
  std::string stage;
  int component;
  int iteration;
  bool operator==(const Timed&) const = default;
};

std::vector<Timed> timeline(const std::vector<Moment>& moments) {
  std::vector<Timed> entries;
  entries.reserve(moments.size());
  for (const Moment& moment : moments) {
    entries.push_back({moment.stage, moment.component, moment.iteration});
  }
  return entries;
}

void expect_same_skeleton(const CurveSkeleton& found, const CurveSkeleton& expected) {
  EXPECT_EQ(found.nodes, expected.nodes);
  EXPECT_EQ(found.edges, expected.edges);
  EXPECT_EQ(found.radii, expected.radii);
  EXPECT_EQ(found.node_of_vertex, expected.node_of_vertex);
}

TEST(DurationText, HasThreeDigitsAndNoPointAtItsEnd) {
  EXPECT_EQ(duration_text(0), "0.00 s");
  EXPECT_EQ(duration_text(1.234), "1.23 s");
  EXPECT_EQ(duration_text(9.996), "10.0 s");
  EXPECT_EQ(duration_text(12.34), "12.3 s");
  EXPECT_EQ(duration_text(99.96), "100 s");
  EXPECT_EQ(duration_text(123.4), "123 s");
  EXPECT_EQ(duration_text(7200), "7200 s");
}

TEST(Run, EndsWithWhatExtractGives) {
  for (const shapes::Shape& shape :
       {shapes::torus(3, 1, 10), shapes::linked_rings(3, 0.7, 8), shapes::cone(1, 4, 16)}) {
    SCOPED_TRACE(shape.name);
    Watched watched(shape.surface);
    ASSERT_TRUE(watched.wait([&] { return watched.ended(); }));
    ASSERT_EQ(watched.state, State::finished) << watched.error;
    ASSERT_TRUE(watched.result);
    const RepairedSurface repaired = repair(soup_of(shape.surface), {}, {});
    ExtractOptions options;
    options.rims = repaired.rims;
    expect_same_skeleton(watched.result->extraction->skeleton,
                         extract(repaired.surface, options, {}).skeleton);
    ASSERT_FALSE(watched.moments.empty());
    EXPECT_EQ(watched.moments.back().stage, "skeleton");
    EXPECT_EQ(watched.moments.back().skeleton, watched.result->skeleton);
  }
}

TEST(Run, MapsTheVerticesOfTheFile) {
  const Surface whole = small_surface();
  Surface with_unused = whole;  // three vertices in front that no face has
  with_unused.positions.resize(whole.positions.rows() + 3, 3);
  with_unused.positions << Positions::Constant(3, 3, 9), whole.positions;
  with_unused.triangles.array() += 3;
  Watched plain(whole);
  Watched moved(with_unused);
  ASSERT_TRUE(plain.wait_for(State::finished));
  ASSERT_TRUE(moved.wait_for(State::finished));
  const Eigen::VectorXi& map = moved.result->skeleton->node_of_vertex;
  ASSERT_EQ(map.size(), with_unused.positions.rows());
  EXPECT_EQ(map.head(3), Eigen::Vector3i::Constant(-1));
  EXPECT_EQ(map.tail(whole.positions.rows()), plain.result->skeleton->node_of_vertex);
}

TEST(Run, ShowsEachIterationOfEachComponentOnce) {
  RunOptions options;
  options.extract.fairing = true;
  options.extract.fair.iterations = 3;
  Watched watched(shapes::linked_rings(3, 0.7, 8).surface, false, options);
  ASSERT_TRUE(watched.wait_for(State::finished));
  Timed before{"", -1, -1};
  for (const Timed& now : timeline(watched.moments)) {
    if (now.stage == before.stage && now.component == before.component) {
      EXPECT_EQ(now.iteration, before.iteration + 1);
    } else {
      EXPECT_EQ(now.iteration, 0) << now.stage;
    }
    before = now;
  }
  for (const Moment& moment : watched.moments) {
    const bool curve = moment.stage == "surgery" || moment.stage == "skeleton";
    EXPECT_EQ(moment.surface != nullptr, !curve);
    EXPECT_EQ(moment.skeleton != nullptr, curve);
  }
}

// The curve of a second try came on top of the first's.
TEST(Run, ShowsEachTryByItself) {
  RunOptions options;
  options.extract.certificate.inside_needed = 2;  // more than any curve has: all tries
  options.repair.wrap = Wrapping::never;
  const shapes::Shape ring = shapes::noisy(shapes::torus(3, 1, 30), 1e-3, 1);  // no flat edges
  Watched watched(ring.surface, false, options);
  ASSERT_TRUE(watched.wait_for(State::finished));
  const std::vector<Try>& history = watched.result->extraction->history;
  int curves = 0;
  for (const Moment& moment : watched.moments) {
    if (moment.stage == "skeleton") continue;
    ASSERT_GE(moment.try_number, 0);
    ASSERT_LT(moment.try_number, static_cast<int>(history.size()));
    EXPECT_EQ(moment.try_name, full_name(history, moment.try_number));
    EXPECT_EQ(history[static_cast<std::size_t>(moment.of_surface)].component, -1);
    if (moment.stage != "surgery") continue;
    ++curves;
    const std::vector<int> piece = component_of_node(*moment.skeleton);
    EXPECT_EQ(*std::max_element(piece.begin(), piece.end()), 0) << "one curve, not two";
  }
  EXPECT_EQ(curves, 3) << "as asked, faired, from all vertices";
}

TEST(Pause, StopsAtAMoment) {
  Watched watched(small_surface(), true);
  ASSERT_TRUE(watched.wait_for(State::paused));
  const std::size_t shown = watched.moments.size();
  EXPECT_EQ(shown, 1U);
  std::this_thread::sleep_for(200ms);
  watched.look();
  EXPECT_EQ(watched.state, State::paused);
  EXPECT_EQ(watched.moments.size(), shown);
}

TEST(Pause, AndResumeAnywhereChangeNothing) {
  Watched undisturbed(small_surface());
  ASSERT_TRUE(undisturbed.wait_for(State::finished));
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    Watched watched(small_surface());
    while (!watched.ended()) {
      switch (random() % 3) {
        case 0:
          watched.run().pause();
          break;
        case 1:
          watched.run().step();
          break;
        default:
          watched.run().resume();
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(random() % 5));
      watched.look();
    }
    EXPECT_EQ(timeline(watched.moments), timeline(undisturbed.moments));
    ASSERT_TRUE(watched.result);
    expect_same_skeleton(*watched.result->skeleton, *undisturbed.result->skeleton);
  }
}

TEST(Step, GivesExactlyOneMore) {
  Watched undisturbed(small_surface());
  ASSERT_TRUE(undisturbed.wait_for(State::finished));
  Watched watched(small_surface(), true);
  ASSERT_TRUE(watched.wait_for(State::paused));
  while (!watched.ended()) {
    const std::size_t before = watched.moments.size();
    watched.run().step();
    ASSERT_TRUE(watched.wait([&] { return watched.state != State::running; }));
    EXPECT_EQ(watched.moments.size(), before + 1);
  }
  EXPECT_EQ(watched.state, State::finished);
  EXPECT_EQ(timeline(watched.moments), timeline(undisturbed.moments));
}

TEST(Step, OfARunThatIsNotPausedPausesAtTheNextMoment) {
  Watched watched(small_surface());
  watched.run().step();  // long before the first moment: repair comes first
  ASSERT_TRUE(watched.wait([&] { return watched.state != State::running; }));
  EXPECT_EQ(watched.state, State::paused);
  EXPECT_EQ(watched.moments.size(), 1U);
}

TEST(Resume, ForgetsStepsNotYetTaken) {
  Watched watched(small_surface(), true);
  for (int i = 0; i < 1000; ++i) watched.run().step();
  watched.run().resume();
  watched.run().pause();
  ASSERT_TRUE(watched.wait([&] { return watched.state == State::paused || watched.ended(); }));
  EXPECT_EQ(watched.state, State::paused);
}

/// Paused runs never finish, so what ends them is the cancellation, however fast the machine is.
TEST(Cancel, EndsSoon) {
  const Surface large = shapes::subdivided(shapes::subdivided(shapes::torus(3, 1, 40))).surface;
  for (const auto delay : {0ms, 20ms, 100ms, 300ms}) {
    for (const int steps : {0, 1, 3}) {
      Watched watched(large, true);
      for (int i = 0; i < steps; ++i) watched.run().step();
      std::this_thread::sleep_for(delay);
      watched.run().cancel();
      const auto began = std::chrono::steady_clock::now();
      ASSERT_TRUE(watched.wait([&] { return watched.ended(); }));
      // 0.1 s is what is promised of a machine that does nothing else.
      EXPECT_LT(std::chrono::steady_clock::now() - began, 10s);
      EXPECT_EQ(watched.state, State::cancelled) << "after " << delay.count() << " ms";
      EXPECT_FALSE(watched.result);
      EXPECT_EQ(watched.error, "");
    }
  }
}

TEST(Cancel, EndsARunThatIsPaused) {
  Watched watched(small_surface(), true);
  ASSERT_TRUE(watched.wait_for(State::paused));
  watched.run().cancel();
  ASSERT_TRUE(watched.wait([&] { return watched.ended(); }));
  EXPECT_EQ(watched.state, State::cancelled);
  EXPECT_EQ(watched.moments.size(), 1U);
}

TEST(Cancel, AfterTheEndChangesNothing) {
  Watched watched(small_surface());
  ASSERT_TRUE(watched.wait_for(State::finished));
  watched.run().cancel();
  watched.look();
  EXPECT_EQ(watched.state, State::finished);
}

TEST(Destruction, InTheMiddleEndsTheRun) {
  for (const auto delay : {0ms, 1ms, 10ms, 50ms}) {
    for (const bool paused : {false, true}) {
      Watched watched(small_surface(), paused);
      std::this_thread::sleep_for(delay);
    }
  }
}

TEST(Failure, IsNews) {
  Surface sheet;  // two triangles of a square enclose nothing
  sheet.positions.resize(4, 3);
  sheet.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  sheet.triangles.resize(2, 3);
  sheet.triangles << 0, 1, 2, 0, 2, 3;
  for (const bool paused : {false, true}) {
    Watched watched(sheet, paused);
    ASSERT_TRUE(watched.wait([&] { return watched.ended(); }));
    EXPECT_EQ(watched.state, State::failed);
    EXPECT_FALSE(watched.result);
    EXPECT_FALSE(watched.error.empty());
    EXPECT_EQ(watched.fault, Fault::input);
  }
}

TEST(Memory, SparesTheNextRunTheRepair) {
  const auto memory = std::make_shared<RunMemory>();
  Watched first(small_surface(), false, {}, memory);
  ASSERT_TRUE(first.wait_for(State::finished));
  const auto repaired = memory->repaired;
  ASSERT_TRUE(repaired);
  RunOptions other;
  other.extract.embed.detail = 0.1;
  Watched second(small_surface(), false, other, memory);
  ASSERT_TRUE(second.wait_for(State::finished));
  EXPECT_EQ(second.result->repaired, repaired);
  other.repair.components = 1;
  Watched third(small_surface(), false, other, memory);
  ASSERT_TRUE(third.wait_for(State::finished));
  EXPECT_NE(third.result->repaired, repaired);
}

}  // namespace
}  // namespace curveskel::viewer::run_laws
