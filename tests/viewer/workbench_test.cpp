// Laws of the workbench over many documents. Waits are bounded by a minute, which only a hang
// takes.
#include "viewer/workbench/workbench.hpp"

#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include <curveskel/levels.hpp>
#include "viewer/headless/headless.hpp"
#include "viewer/render/renderer.hpp"

namespace curveskel::viewer::workbench_laws {
namespace {

using namespace std::chrono_literals;

std::filesystem::path mesh(const char* name) {
  return std::filesystem::path(CURVESKEL_SOURCE_DIR) / "meshes" / name;
}

template <typename Condition>
bool wait(Workbench& bench, const Condition& wanted) {
  const auto end = std::chrono::steady_clock::now() + 60s;
  for (bench.update(); !wanted(); bench.update()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

void draw(Scene& scene, Renderer& renderer) {
  scene.forget_uploads();
  scene.upload(renderer);
  renderer.draw(scene.camera, scene.look_now(), {160, 100, {}, scene.bounds()});
}

double resident_megabytes() {
  malloc_trim(0);  // what is free is not leaked
  std::ifstream in("/proc/self/statm");
  double all = 0;
  double resident = 0;
  in >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Opens it and draws it, while it is worked on and when it is done, with a correction taken back;
/// or leaves it to the next one to end its run.
void look_at(Workbench& bench, Renderer& renderer, const std::filesystem::path& file, bool whole) {
  const Scene* const before = bench.scene.get();
  bench.open({file});
  ASSERT_TRUE(wait(bench, [&] { return bench.scene.get() != before; })) << file;
  draw(*bench.scene, renderer);
  ASSERT_TRUE(wait(bench, [&] { return bench.scene->recording.moments().size() > 2; })) << file;
  bench.go_to(1);
  draw(*bench.scene, renderer);
  if (!whole) return;
  ASSERT_TRUE(wait(bench, [&] { return bench.result() != nullptr && !bench.busy(); })) << file;
  bench.resume();  // to the end, whatever was looked at meanwhile
  ASSERT_TRUE(wait(bench, [&] { return !bench.busy(); })) << file;
  draw(*bench.scene, renderer);
  ASSERT_NE(bench.scene->skeleton(), nullptr);
  Pick edge;
  edge.kind = Pick::Kind::edge;
  edge.index = 0;
  bench.select(edge, false);
  bench.split();
  draw(*bench.scene, renderer);
  bench.undo();
}

TEST(Workbench, HundredDocumentsTakeNoMoreMemoryThanTwenty) {
  // A document of this kind takes 1 MB or so; arenas of threads, which come and go, some.
  constexpr double most_megabytes = 6;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr int cycles = 20;  // what is freed stays with the sanitizer, which looks itself
#else
  constexpr int cycles = 100;
#endif
  const HeadlessContext context;
  Renderer renderer;
  Workbench bench(ViewOptions{});
  double early = 0;
  for (int cycle = 1; cycle <= cycles; ++cycle) {
    look_at(bench, renderer, mesh(cycle % 2 == 0 ? "y.off" : "torus.off"), cycle % 4 < 2);
    ASSERT_FALSE(HasFatalFailure()) << cycle;
    if (cycle == 20) early = resident_megabytes();
  }
  const double late = resident_megabytes();
  RecordProperty("early", std::to_string(early));
  RecordProperty("late", std::to_string(late));
  EXPECT_LT(late - early, most_megabytes) << early << " MB, then " << late << " MB";
}

TEST(Workbench, LevelsAreShownAtOnceUnlessCorrectionsWouldBeLost) {
  Workbench bench{ViewOptions{}};
  bench.open({mesh("y.off")});
  ASSERT_TRUE(wait(bench, [&] { return bench.result() != nullptr && !bench.busy(); }));
  const CurveSkeleton whole = *bench.scene->skeleton();
  ASSERT_TRUE(has_lives(whole));
  for (const double detail : {0.0, 0.25, 0.5}) {
    bench.pipeline.extract.embed.detail = detail;
    bench.show_level();
    EXPECT_FALSE(bench.running());
    EXPECT_EQ(bench.scene->skeleton()->edges, level_of(whole, least_life(detail)).edges);
  }
  EXPECT_EQ(bench.scene->skeleton()->edges, whole.edges);
  Pick edge;
  edge.kind = Pick::Kind::edge;
  edge.index = 0;
  bench.select(edge, false);
  bench.split();
  const auto corrected = bench.scene->skeleton();
  bench.pipeline.extract.embed.detail = 0;
  bench.show_level();
  EXPECT_EQ(bench.scene->skeleton(), corrected);
  EXPECT_TRUE(bench.messages().back().bad);
}

// Another run's skeleton took the place of the one that was gone back to, and all after it went.
TEST(Workbench, LevelsAreOfTheSkeletonThatIsShown) {
  Workbench bench{ViewOptions{}};
  bench.open({mesh("y.off")});
  ASSERT_TRUE(wait(bench, [&] { return bench.result() != nullptr && !bench.busy(); }));
  const CurveSkeleton first = *bench.scene->skeleton();
  Pick edge;
  edge.kind = Pick::Kind::edge;
  edge.index = 0;
  bench.select(edge, false);
  bench.split();
  const CurveSkeleton corrected = *bench.scene->skeleton();
  bench.pipeline.extract.fairing = true;
  bench.pipeline.extract.fair.iterations = 20;
  bench.start(false);
  ASSERT_TRUE(wait(bench, [&] { return !bench.running() && !bench.busy(); }));
  const CurveSkeleton second = *bench.scene->skeleton();
  ASSERT_NE(second.nodes, first.nodes);
  bench.undo();
  bench.undo();
  EXPECT_EQ(bench.scene->skeleton()->nodes, first.nodes);
  bench.pipeline.extract.embed.detail = 0.25;
  bench.show_level();
  const CurveSkeleton level = level_of(first, least_life(0.25));
  EXPECT_EQ(bench.scene->skeleton()->nodes, level.nodes);
  bench.redo();
  EXPECT_EQ(bench.scene->skeleton()->nodes, corrected.nodes);
  bench.redo();
  EXPECT_EQ(bench.scene->skeleton()->nodes, second.nodes);
}

}  // namespace
}  // namespace curveskel::viewer::workbench_laws
