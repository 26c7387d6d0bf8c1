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

// The timeline ended with what had been recorded, and looked as if that had become the skeleton.
TEST_F(Succession, ARunThatIsCancelledLeavesTheSkeletonThatThereWas) {
  open({mesh_called("y.off")});
  run();
  EXPECT_EQ(bench.run_state(), Run::State::finished);
  const auto made = bench.scene->skeleton();
  bench.pipeline.extract.resolution /= 2;
  bench.start(true);
  ASSERT_TRUE(wait_for(bench, [&] { return bench.run_state() == Run::State::paused; }));
  ASSERT_NE(bench.scene->recording.moments().back().stage, "skeleton");
  bench.cancel();
  EXPECT_EQ(bench.run_state(), Run::State::cancelled);
  EXPECT_EQ(bench.scene->skeleton(), nullptr) << "here it was not there yet";
  EXPECT_EQ(bench.judgement(), nullptr);
  bench.go_to(bench.scene->recording.moments().size() - 1);
  EXPECT_EQ(bench.scene->recording.moments().back().stage, "skeleton");
  EXPECT_EQ(bench.scene->skeleton(), made);
  ASSERT_TRUE(wait_for_rest(bench));
  EXPECT_NE(bench.judgement(), nullptr);
}

TEST_F(Succession, NoCurveIsSavedForASkeletonThatIsNotThereYet) {
  open({mesh_called("y.off")});
  bench.start(true);
  const auto paused = [&] { return bench.run_state() == Run::State::paused; };
  do {
    ASSERT_TRUE(wait_for(bench, paused));
    bench.step();
    bench.update();
  } while (bench.scene->recording.moments().back().stage != "surgery");
  ASSERT_NE(bench.scene->skeleton(), nullptr);
  bench.save(folder.path() / "early.json");
  EXPECT_TRUE(last().bad) << last().text;
  EXPECT_FALSE(fs::exists(folder.path() / "early.json"));
  bench.cancel();
  bench.save(folder.path() / "early.json");
  EXPECT_FALSE(fs::exists(folder.path() / "early.json"));
}

// The slider stayed where it was, and did nothing there.
TEST_F(Succession, TheDetailIsThatOfTheSkeletonThatIsShown) {
  open({mesh_called("y.off")});
  run();
  double& detail = bench.pipeline.extract.embed.detail;
  const double usual = detail;
  const auto nodes = [&] { return bench.scene->skeleton()->nodes.rows(); };
  const auto all = nodes();
  bench.start(false);
  ASSERT_TRUE(wait_for_rest(bench));
  detail = 0;
  bench.show_level();
  const auto few = nodes();
  ASSERT_LT(few, all);
  bench.undo();
  EXPECT_EQ(nodes(), all);
  EXPECT_EQ(detail, usual);
  bench.redo();
  EXPECT_EQ(detail, 0);
  bench.undo();
  detail = 0;
  bench.show_level();
  EXPECT_EQ(nodes(), few);
}

// Each repetition began it anew.
TEST_F(Succession, AHeldKeyBeginsNoRigAndEndsNone) {
  open({mesh_called("y.off")});
  run();
  bench.step(true);
  EXPECT_FALSE(bench.making_rig());
  bench.step();
  ASSERT_TRUE(bench.making_rig());
  const auto frames = [&] {
    bench.step(true);
    bench.step();
    return !bench.busy();
  };
  ASSERT_TRUE(wait_for(bench, frames));
  EXPECT_TRUE(bench.has_rig());
}

TEST_F(Succession, WhatIsRedCanBeClearedAgain) {
  open({folder.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")});
  ASSERT_TRUE(wait_for_rest(bench));
  ASSERT_NE(bench.defects(), nullptr);
  const std::vector<int> faces = bench.defects()->open;
  const auto& red = bench.scene->highlights.failed_faces;
  bench.show_faces(faces);
  EXPECT_EQ(red, faces);
  bench.show_faces(faces);
  EXPECT_TRUE(red.empty()) << "once more";
  bench.show_faces(faces);
  bench.clear_faults();
  EXPECT_TRUE(red.empty());
}

TEST_F(Succession, AFileThatIsOpenedCanBeLeft) {
  open({mesh_called("y.off")});
  const auto before = bench.scene;
  bench.open({mesh_called("torus.off")});
  bench.cancel_opening();
  ASSERT_TRUE(wait_for_rest(bench));
  EXPECT_EQ(bench.scene, before);
  EXPECT_EQ(last().text, "opening was cancelled");
  open({mesh_called("torus.off")});
  EXPECT_NE(bench.scene, before);
}

TEST_F(Succession, ANameToSaveIsAfterTheOpenFileAndNotItsOwn) {
  open({mesh_called("y.off")});
  EXPECT_EQ(bench.suggested_name(), "y.json");
  run();
  EXPECT_EQ(bench.suggested_name(), "y.json");
  make_rig();
  EXPECT_EQ(bench.suggested_name(), "y.glb");
  const EditSubject subject(folder.path(), {.name = "subject", .rich = true});
  open({subject.path()});
  run();
  make_rig();
  const std::string stem = subject.path().stem().string();
  EXPECT_NE(bench.suggested_name(), subject.path().filename().string());
  EXPECT_TRUE(bench.suggested_name().starts_with(stem)) << bench.suggested_name();
}

}  // namespace
}  // namespace curveskel::viewer::succession_laws
