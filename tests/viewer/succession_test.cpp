// Laws of what goes when another thing takes its place: rigs, certificates, runs, files. Waits are
// bounded by a minute, which only a hang takes.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "tests/own_folder.hpp"
#include "tests/rig/edit_subjects.hpp"
#include "tests/viewer/waiting.hpp"
#include "viewer/model/rigging.hpp"

namespace curveskel::viewer::succession_laws {
namespace {

namespace fs = std::filesystem;

class Succession : public testing::Test {
 protected:
  void open(const std::vector<fs::path>& files) {
    const Scene* const before = bench.scene.get();
    bench.open(files);
    ASSERT_TRUE(wait_for(bench, [&] { return bench.scene.get() != before; }));
  }
  void run() {
    bench.start(false);
    ASSERT_TRUE(wait_for_rest(bench));
    ASSERT_NE(bench.result(), nullptr);
  }
  void make_rig() {
    bench.rig();
    ASSERT_TRUE(wait_for_rest(bench));
    ASSERT_TRUE(bench.has_rig());
  }
  /// With its skeleton beside it.
  [[nodiscard]] std::vector<fs::path> with_skeleton(const std::string& name) {
    open({mesh_called(name)});
    run();
    const fs::path skeleton = folder.path() / (fs::path(name).stem().string() + ".json");
    bench.save(skeleton);
    return {mesh_called(name), skeleton};
  }
  [[nodiscard]] const Message& last() const { return bench.messages().back(); }

  Workbench bench{[] {
    ViewOptions options;
    options.run = false;
    return options;
  }()};
  OwnFolder folder;
};

// The choice and the turns stayed, for a rig of fewer joints.
TEST_F(Succession, TurnsAndTheChosenJointGoWithTheirRig) {
  const EditSubject subject(folder.path(), {.name = "rigged", .rich = true, .old_rig = 2});
  open({subject.path()});
  for (const bool by_a_root : {true, false}) {
    run();
    make_rig();
    const int joint = static_cast<int>(bench.scene->rig()->joints.rows()) - 1;
    ASSERT_GE(joint, 2);
    select_node(bench, 0);
    bench.select_joint(joint);
    bench.turn_joint(joint, Eigen::Quaterniond(0, 1, 0, 0));
    ASSERT_NE(bench.scene->turns(), nullptr);
    if (by_a_root) {
      bench.set_root();
    } else {
      bench.pipeline.extract.resolution /= 2;
      bench.start(true);
      ASSERT_TRUE(wait_for(bench, [&] { return bench.run_state() == Run::State::paused; }));
    }
    ASSERT_EQ(bench.scene->rig(), bench.scene->document.rig) << "the file's own";
    EXPECT_EQ(bench.selected_joint(), -1);
    EXPECT_EQ(bench.scene->highlights.joint, -1);
    EXPECT_EQ(bench.scene->turns(), nullptr);
    EXPECT_EQ(bench.scene->joints_now(), bench.scene->document.rig->joints);
  }
}

TEST_F(Succession, ASurfaceIsNoGroundForTheNextFile) {
  const auto first = with_skeleton("y.off");
  const auto second = with_skeleton("torus.off");
  open(first);  // its skeleton is being judged now
  const Scene* const before = bench.scene.get();
  bench.open(second);
  std::this_thread::sleep_for(std::chrono::seconds(1));  // both are done, and nobody knows
  bench.update();
  ASSERT_TRUE(wait_for(bench, [&] { return bench.scene.get() != before; }));
  ASSERT_TRUE(wait_for(bench, [&] { return bench.tree() != nullptr; }));
  ASSERT_NE(bench.judgement(), nullptr);
  EXPECT_EQ(bench.judgement()->certificate.genus, 1);
}

// The certificate that is not there yet was passed over, or that of another skeleton taken.
TEST_F(Succession, ARigDoesNotDependOnWhenItWasAskedFor) {
  const auto files = with_skeleton("free/casting-5k-inward.off.gz");  // not made of tubes
  std::vector<std::string> found;
  for (const bool judged : {false, true}) {
    open(files);
    if (judged) {
      ASSERT_TRUE(wait_for_rest(bench));
    }
    make_rig();
    found.push_back(words_of(*bench.scene->character()));
  }
  EXPECT_EQ(found[0], found[1]);
}

}  // namespace
}  // namespace curveskel::viewer::succession_laws
