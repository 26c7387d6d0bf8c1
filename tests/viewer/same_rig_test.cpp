// Laws that the window's rig is the program's: files of both have the same bytes. Waits are bounded
// by a minute, which only a hang takes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "meshes/shapes.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/edit_subjects.hpp"
#include "tests/viewer/waiting.hpp"
#include "viewer/workbench/workbench.hpp"

namespace curveskel::viewer::same_rig_laws {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// `curveskel rig`; 0 where it is done.
int run_rig_verb(const fs::path& file, const fs::path& output, const Words& options) {
  std::string command =
      CURVESKEL_PROGRAM " rig -q '" + file.string() + "' -o '" + output.string() + "'";
  for (const std::string& word : options) command += " " + word;
  return std::system(command.c_str());
}

std::string obj_of(const Surface& surface, const std::string& more = "") {
  std::ostringstream obj;
  obj.precision(17);
  for (const auto& place : surface.positions.rowwise()) obj << "v " << place << '\n';
  for (const auto& corners : surface.triangles.rowwise()) {
    obj << "f " << corners.array() + 1 << '\n';
  }
  obj << more;
  return std::move(obj).str();
}

shapes::Shape bent_tube() {
  return shapes::tube("", shapes::s_curve(16, 6), shapes::constant(1), 16);
}

shapes::Shape ball_at(double radius, const Eigen::RowVector3d& place) {
  return shapes::translated(shapes::ellipsoid({radius, radius, radius}, 2), place.transpose());
}

/// Two buttons, which follow, and a ball that is body: it stands far out.
Surface tube_of_several_parts() {
  const shapes::Shape tube = bent_tube();
  const Positions& axis = tube.axis.nodes;
  const Eigen::RowVector3d up(0, 0, 0.95);
  return shapes::together("", {ball_at(0.2, axis.row(axis.rows() / 5) + up), tube,
                               ball_at(0.25, axis.row(4 * axis.rows() / 5) + up),
                               ball_at(1.5, axis.row(axis.rows() - 1) + 2 * up)})
      .surface;
}

/// A large square, beside all else.
const char* const sheet = "v 9 -2 0\nv 14 -2 0\nv 14 2 0\nv 9 2 0\nf -4 -3 -2 -1\n";

/// A change in the window, and the program's words for it.
struct Wish {
  Words words;
  std::function<void(Workbench&)> make = [](Workbench&) {};
};

ViewOptions as_the_program_starts() {
  ViewOptions options;
  options.pipeline.extract.fair.iterations = 0;
  return options;
}

class SameRig : public testing::Test {
 protected:
  void open(const fs::path& opened) {
    file = opened;
    bench.open({file});
    ASSERT_TRUE(wait_for_rest(bench));
    if (bench.result() == nullptr) run();  // a file that has a rig waits for its person
  }
  void run() {
    bench.start(false);
    ASSERT_TRUE(wait_for_rest(bench));
    ASSERT_NE(bench.result(), nullptr);
  }
  void show_detail(double detail) {
    bench.pipeline.extract.embed.detail = detail;
    bench.show_level();
    if (bench.wants_finer_run()) run();
  }
  void make_rig() {
    bench.rig();
    ASSERT_TRUE(wait_for_rest(bench));
    ASSERT_TRUE(bench.has_rig()) << last_said();
  }
  [[nodiscard]] std::string last_said() const { return bench.messages().back().text; }
  [[nodiscard]] std::string all_said() const {
    std::string all;
    for (const Message& message : bench.messages()) all += message.text + "\n";
    return all;
  }
  void save(const std::string& name) {
    bench.save(folder.path() / name, true);
    ASSERT_TRUE(wait_for_rest(bench));
  }
  void expect_same(const Words& options, const std::string& extension = "glb") {
    SCOPED_TRACE(testing::PrintToString(options) + " " + extension);
    const std::string name = "hero." + extension;
    const fs::path written = folder.path() / "program" / name;
    fs::create_directory(written.parent_path());
    ASSERT_EQ(run_rig_verb(file, written, options), 0);
    save(name);
    ASSERT_TRUE(fs::exists(folder.path() / name)) << all_said();
    EXPECT_EQ(bytes_of(folder.path() / name) == bytes_of(written), true) << all_said();
    fs::remove(folder.path() / name);
  }

  Workbench bench{as_the_program_starts()};
  OwnFolder folder;
  fs::path file;
};

TEST_F(SameRig, OfOnePart) {
  open(mesh_called("y.off"));
  expect_same({});
}

TEST_F(SameRig, AtAnyDetail) {
  const Surface several = tube_of_several_parts();
  for (const fs::path& one :
       {mesh_called("free/spot-3k.obj"), folder.write("parts.obj", obj_of(several))}) {
    open(one);
    for (const double detail : {0.2, 0.5, 0.8, 0.1}) {
      show_detail(detail);
      expect_same({"--detail", std::to_string(detail)});
    }
    show_detail(0.5);
  }
}

TEST_F(SameRig, OfSheets) {
  for (const Surface& surface : {bent_tube().surface, tube_of_several_parts()}) {
    open(folder.write("sheet.obj", obj_of(surface, sheet)));
    expect_same({});
    make_rig();
    EXPECT_EQ(all_said().find("least sheet"), std::string::npos);
    bench.pipeline.repair.least_sheet = 0.4;
    run();
    expect_same({"--least-sheet", "0.4"});
    bench.pipeline.repair.least_sheet = 0;
    run();
    expect_same({});
  }
}

TEST_F(SameRig, OfSeveralPartsWithEachOption) {
  open(folder.write("parts.obj", obj_of(tube_of_several_parts())));
  CharacterOptions& character = bench.pipeline.character;
  const CharacterOptions usual = character;
  const std::vector<Wish> wishes{
      {{}, [](Workbench&) {}},
      {{"--bone-length", "4"}, [&](Workbench&) { character.rig.joints.bone_length = 4; }},
      {{"--joint-budget", "5"}, [&](Workbench&) { character.joint_budget = 5; }},
      {{"--follow", "0"}, [&](Workbench&) { character.parts.follow = 0; }},
      {{"--plan", "none"}, [&](Workbench&) { character.plan.plan = BodyKind::none; }},
      {{"--plan", "humanoid"}, [&](Workbench&) { character.plan.plan = BodyKind::humanoid; }},
      {{"--up", "x"}, [&](Workbench&) { character.plan.up = Direction::x; }},
      {{"--names", "mixamo"}, [&](Workbench&) { character.names = NameStyle::mixamo; }},
      {{"--softness", "2"}, [&](Workbench&) { character.rig.skin.softness = 2; }},
      {{"--no-ends"}, [](Workbench& one) { one.exported.ends = false; }},
      {{"--ground-root"}, [](Workbench& one) { one.exported.ground_root = true; }}};
  for (const Wish& wish : wishes) {
    character = usual;
    bench.exported = {};
    wish.make(bench);
    make_rig();
    expect_same(wish.words);
  }
}

TEST_F(SameRig, InEachFormat) {
  open(folder.write("parts.obj", obj_of(tube_of_several_parts(), sheet)));
  for (const char* extension : {"glb", "gltf", "fbx", "usda", "usdz", "bvh", "npz", "txt"}) {
    expect_same({}, extension);
  }
}

TEST_F(SameRig, OfAHumanInATPose) {
  open(mesh_called("free/humanoid-10k.ply.gz"));
  bench.pipeline.character.joint_budget = 20;
  bench.exported.pose = RestPose::t;
  expect_same({"--joint-budget", "20", "--pose", "t"});
  EXPECT_EQ(bench.scene->turns(), nullptr) << "the picture stays";
}

TEST_F(SameRig, OfAFileThatHasARigAlready) {
  const EditSubject at_rest(folder.path(), {.name = "rigged", .rich = true, .old_rig = 5});
  open(at_rest.path());
  expect_same({});
  const EditSubject posed(folder.path(),
                          {.name = "posed", .rich = true, .old_rig = 4, .old_turn = 0.4});
  open(posed.path());
  expect_same({"--as-shown"});
}

TEST_F(SameRig, OfTheRunWhoseSkeletonIsShown) {
  open(folder.write("parts.obj", obj_of(tube_of_several_parts())));
  bench.pipeline.extract.fair.iterations = 10;
  run();
  expect_same({"--fair", "10"});
  bench.undo();
  expect_same({});
  bench.redo();
  bench.pipeline.extract.fair.iterations = 0;
  bench.start(false);
  bench.cancel();
  expect_same({"--fair", "10"});
}

TEST_F(SameRig, OnceACorrectionIsTakenBack) {
  open(folder.write("parts.obj", obj_of(tube_of_several_parts(), sheet)));
  make_rig();
  const auto before = bench.scene->rig();
  select_edge(bench, 0);
  bench.split();
  make_rig();
  EXPECT_NE(all_said().find("least sheet"), std::string::npos) << "which the skeleton is without";
  bench.undo();
  expect_same({});
  make_rig();
  EXPECT_EQ(bench.scene->rig()->joints, before->joints);
}

TEST_F(SameRig, OfASkeletonThatWasCorrected) {
  open(folder.write("parts.obj", obj_of(tube_of_several_parts())));
  select_edge(bench, 0);
  bench.split();
  const fs::path skeleton = folder.path() / "corrected.json";
  bench.save(skeleton);
  expect_same({"--skeleton", skeleton.string()});
  select_node(bench, 3);
  bench.set_root();
  expect_same({"--skeleton", skeleton.string(), "--root", "3"});
}

TEST_F(SameRig, HasItsPartsByTheVerticesOfTheFile) {
  open(folder.write("parts.obj", obj_of(tube_of_several_parts(), sheet)));
  make_rig();
  const auto character = bench.scene->character();
  const auto vertices = bench.scene->document.surface.positions.rows();
  const RigParts& parts = character->parts;
  ASSERT_EQ(parts.part_of_vertex.size(), vertices);
  ASSERT_EQ(static_cast<Eigen::Index>(character->follows.size()), vertices);
  int followers = 0;
  for (Eigen::Index v = 0; v < vertices; ++v) {
    const int part = parts.part_of_vertex[v];
    ASSERT_GE(part, 0) << "vertex " << v;
    const bool follows = parts.parts[static_cast<std::size_t>(part)].follows;
    EXPECT_EQ(character->follows[static_cast<std::size_t>(v)], follows) << "vertex " << v;
    followers += follows ? 1 : 0;
  }
  EXPECT_GT(followers, 0);
  EXPECT_LT(followers, vertices);
}

TEST_F(SameRig, InNoPoseThatItCannotHave) {
  open(mesh_called("y.off"));
  bench.exported.pose = RestPose::t;
  for (const char* name : {"y.bvh", "y.npz"}) {
    save(name);
    EXPECT_NE(last_said().find("has no pose at rest"), std::string::npos) << last_said();
    EXPECT_FALSE(bench.has_rig()) << "before one is made";
  }
  save("y.glb");
  EXPECT_NE(last_said().find("the T pose is a human's"), std::string::npos) << last_said();
  EXPECT_TRUE(bench.messages().back().bad);
  for (const char* name : {"y.bvh", "y.npz", "y.glb"}) {
    EXPECT_FALSE(fs::exists(folder.path() / name));
  }
}

TEST_F(SameRig, SaysWhatTheProgramWarnsOf) {
  open(mesh_called("y.off"));
  bench.pipeline.character.joint_budget = 1;
  bench.pipeline.character.plan.plan = BodyKind::fish;
  make_rig();
  EXPECT_NE(all_said().find("joint budget"), std::string::npos) << all_said();
}

}  // namespace
}  // namespace curveskel::viewer::same_rig_laws
