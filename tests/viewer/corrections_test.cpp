// Laws of corrections by hand: none is lost without a word, each is of what is shown.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include <curveskel/skeleton_files.hpp>
#include <nlohmann/json.hpp>
#include "tests/own_folder.hpp"
#include "tests/viewer/waiting.hpp"

namespace curveskel::viewer::corrections_laws {
namespace {

namespace fs = std::filesystem;

class Corrections : public testing::Test {
 protected:
  void open(const std::vector<fs::path>& files) {
    const Scene* const before = bench.scene.get();
    bench.open(files);
    ASSERT_TRUE(wait_for(bench, [&] { return bench.scene.get() != before; }));
    ASSERT_TRUE(wait_for_rest(bench));
    ASSERT_NE(bench.scene->skeleton(), nullptr);
  }
  void open_y() { open({mesh_called("y.off")}); }
  [[nodiscard]] fs::path copy_of(const std::string& name) const {
    fs::copy_file(mesh_called(name), folder.path() / name);
    return folder.path() / name;
  }
  void split_an_edge() {
    select_edge(bench, 0);
    bench.split();
  }
  /// As somebody else would write it.
  static void touch(const fs::path& file) {
    fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(2));
  }
  void reread() {
    bench.watch_files();
    ASSERT_TRUE(wait_for_rest(bench));
  }
  [[nodiscard]] const Message& last() const { return bench.messages().back(); }

  Workbench bench{ViewOptions{}};
  OwnFolder folder;
};

TEST_F(Corrections, AreOfWhatIsShown) {
  open_y();
  const auto made = bench.scene->skeleton();
  bench.go_to(moment_called(bench, "surgery"));
  ASSERT_NE(bench.scene->skeleton(), made);
  const auto all = {std::function<void()>([&] { bench.prune(); }), {[&] { bench.split(); }}, {[&] {
                      bench.cut();
                    }}};
  for (const auto& change : all) {
    select_edge(bench, 0);
    change();
    EXPECT_TRUE(last().bad) << last().text;
  }
  select_node(bench, 0);
  bench.set_root();
  EXPECT_TRUE(last().bad) << last().text;
  EXPECT_EQ(bench.root(), -1);
  bench.move(0, glm::vec3(0));
  EXPECT_TRUE(last().bad) << last().text;
  EXPECT_EQ(bench.history().now().skeleton, made);
  bench.go_to(bench.scene->recording.moments().size() - 1);
  split_an_edge();
  EXPECT_FALSE(last().bad) << last().text;
}

TEST_F(Corrections, AreSavedWhereverTheTimelineStands) {
  open_y();
  split_an_edge();
  const auto corrected = bench.scene->skeleton();
  select_node(bench, static_cast<int>(corrected->nodes.rows()) - 1);
  bench.set_root();
  for (const char* stage : {"input", "contract", "surgery"}) {
    bench.go_to(moment_called(bench, stage));
    const fs::path file = folder.path() / (std::string(stage) + ".json");
    bench.save(file);
    ASSERT_TRUE(fs::exists(file)) << last().text;
    EXPECT_EQ(read_skeleton(file).nodes, corrected->nodes);
    std::ifstream stream(file);
    EXPECT_EQ(nlohmann::json::parse(stream)["root"], corrected->nodes.rows() - 1);
  }
}

TEST_F(Corrections, OutliveANewRun) {
  open_y();
  split_an_edge();
  const auto corrected = bench.scene->skeleton();
  bench.start(false);
  ASSERT_TRUE(wait_for_rest(bench));
  ASSERT_NE(bench.scene->skeleton(), corrected);
  bench.undo();
  EXPECT_EQ(bench.scene->skeleton(), corrected);
}

TEST_F(Corrections, OutliveANewReadingOfTheSurface) {
  const fs::path file = copy_of("y.off");
  open({file});
  split_an_edge();
  const auto corrected = bench.scene->skeleton();
  touch(file);
  reread();
  ASSERT_NE(bench.scene->skeleton(), corrected);
  bench.undo();
  EXPECT_EQ(bench.scene->skeleton(), corrected);
}

TEST_F(Corrections, SavedOntoTheOpenFileAreNotReadAgain) {
  const fs::path skeleton = folder.path() / "skeleton.json";
  open_y();
  bench.save(skeleton);
  open({mesh_called("y.off"), skeleton});
  split_an_edge();
  const auto corrected = bench.scene->skeleton();
  bench.save(skeleton, true);
  reread();
  EXPECT_EQ(bench.scene->skeleton(), corrected);
  EXPECT_EQ(read_skeleton(skeleton).nodes, corrected->nodes);
  touch(skeleton);  // by somebody else
  reread();
  bench.undo();
  EXPECT_EQ(bench.scene->skeleton(), corrected);
}

TEST_F(Corrections, TheRootOfAFileIsReadWithIt) {
  open_y();
  select_node(bench, 3);
  bench.set_root();
  const fs::path skeleton = folder.path() / "skeleton.json";
  bench.save(skeleton);
  open({mesh_called("y.off"), skeleton});
  EXPECT_EQ(bench.root(), 3);
}

TEST_F(Corrections, AreNotFloodedByTheSliderOfDetail) {
  open_y();
  split_an_edge();
  const double shown = bench.pipeline.extract.embed.detail;
  const std::size_t before = bench.messages().size();
  for (int frame = 0; frame < 20; ++frame) {
    bench.pipeline.extract.embed.detail = 0.4 - 0.01 * frame;
    bench.show_level();
    EXPECT_EQ(bench.pipeline.extract.embed.detail, shown);
  }
  EXPECT_EQ(bench.messages().size(), before + 1);
}

// Above the default it ran anew, and another skeleton came in its place.
TEST_F(Corrections, StayAtEachDetailThatTheSliderMeets) {
  open_y();
  split_an_edge();
  double& detail = bench.pipeline.extract.embed.detail;
  const double shown = detail;
  const auto corrected = bench.scene->skeleton();
  for (const double wanted : {0.1, 0.6, 1.0}) {
    detail = wanted;
    bench.show_level();
    EXPECT_EQ(detail, shown);
    EXPECT_FALSE(bench.wants_finer_run());
    EXPECT_TRUE(bench.messages().back().bad);
    EXPECT_EQ(bench.scene->skeleton(), corrected);
  }
  bench.undo();
  detail = 0.6;
  bench.show_level();
  EXPECT_TRUE(bench.wants_finer_run());
}

/// Saving takes no file away from anybody.
class Saving : public Corrections {};

TEST_F(Saving, NeverReplacesTheOpenSurface) {
  const fs::path file = copy_of("y.off");
  const fs::path link = folder.path() / "link.obj";  // a format of skeletons
  fs::create_symlink(file, link);
  open({file});
  const auto bytes = fs::file_size(file);
  for (const auto& [name, may_replace] : {std::pair(link, false), {link, true}, {file, false}}) {
    bench.save(name, may_replace);
    EXPECT_TRUE(last().bad) << last().text;
    EXPECT_NE(last().text.find("is the input"), std::string::npos) << last().text;
    EXPECT_FALSE(bench.wants_to_replace);
    EXPECT_EQ(fs::file_size(file), bytes);
  }
}

TEST_F(Saving, AsksBeforeItReplacesAnyOtherFile) {
  open_y();
  for (const char* name : {"skeleton.json", "rig.glb"}) {
    const fs::path file = folder.write(name, "somebody's");
    bench.save(file);
    ASSERT_TRUE(wait_for_rest(bench));
    EXPECT_EQ(bench.wants_to_replace, file);
    EXPECT_EQ(fs::file_size(file), 10U);
    bench.wants_to_replace.reset();
    bench.save(file, true);
    ASSERT_TRUE(wait_for_rest(bench));
    EXPECT_FALSE(bench.wants_to_replace);
    EXPECT_GT(fs::file_size(file), 10U);
  }
}

TEST_F(Corrections, AreNotLostToAnotherFileWithoutAQuestion) {
  const std::vector<fs::path> other{mesh_called("torus.off")};
  const auto would_ask = [&] {
    bench.open(other);
    const bool asks = bench.wants_to_abandon.has_value();
    EXPECT_NE(asks, bench.opening());
    bench.cancel_opening();
    EXPECT_TRUE(wait_for(bench, [&] { return !bench.opening(); }));
    bench.wants_to_abandon.reset();
    return asks;
  };
  open_y();
  EXPECT_FALSE(would_ask()) << "nothing was corrected";
  split_an_edge();
  EXPECT_TRUE(would_ask());
  bench.save(folder.path() / "picture.svg");
  EXPECT_TRUE(would_ask()) << "a picture is no skeleton";
  bench.save(folder.path() / "skeleton.json");
  EXPECT_FALSE(would_ask());
  split_an_edge();
  EXPECT_TRUE(would_ask());
  bench.undo();
  EXPECT_FALSE(would_ask()) << "this one is saved";
  bench.undo();
  EXPECT_FALSE(would_ask()) << "as it was made";
  bench.redo();
  bench.redo();
  EXPECT_TRUE(would_ask());
  const Scene* const before = bench.scene.get();
  bench.open(other, true);
  EXPECT_TRUE(wait_for(bench, [&] { return bench.scene.get() != before; }));
}

TEST(Messages, OfTheSameTextAreOne) {
  Workbench bench{ViewOptions{}};
  for (int i = 0; i < 3; ++i) bench.say("the same", true);
  bench.say("another", true);
  bench.say("the same", true);
  EXPECT_EQ(bench.messages().size(), 3U);
}

TEST(TimeLimit, CancelsARunThatIsLongerAndNoOther) {
  for (const double seconds : {1e-6, 50.0}) {
    ViewOptions options;
    options.time_limit_seconds = seconds;
    Workbench bench{options};
    bench.open({mesh_called("y.off")});
    ASSERT_TRUE(wait_for(bench, [&] { return bench.scene->document.has_surface(); }));
    ASSERT_TRUE(wait_for_rest(bench));
    const bool is_cut = seconds < 1;
    EXPECT_EQ(bench.result() == nullptr, is_cut);
    EXPECT_EQ(bench.messages().back().text.find("--time-limit") != std::string::npos, is_cut);
  }
}

}  // namespace
}  // namespace curveskel::viewer::corrections_laws
