// Laws of the rig at the end of the timeline. Waits are bounded by a minute, which only a hang
// takes.
#include "viewer/model/rigging.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <curveskel/extract_repaired.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "meshes/shapes.hpp"
#include "tests/glb.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/edit_subjects.hpp"
#include "tests/viewer/waiting.hpp"
#include "viewer/workbench/workbench.hpp"

namespace curveskel::viewer::rigging_laws {
namespace {

using namespace std::chrono_literals;

std::filesystem::path mesh(const char* name) {
  return std::filesystem::path(CURVESKEL_SOURCE_DIR) / "meshes" / name;
}

class Rigging : public testing::Test {
 protected:
  void open_y() {
    bench.open({mesh("y.off")});
    ASSERT_TRUE(wait([&] { return bench.result() != nullptr && !bench.busy(); }));
  }
  template <typename Condition>
  bool wait(const Condition& wanted) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    for (bench.update(); !wanted(); bench.update()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(1ms);
    }
    return true;
  }
  void make_rig() {
    bench.rig();
    ASSERT_TRUE(wait([&] { return bench.has_rig(); }));
  }
  [[nodiscard]] const std::string& stage() const {
    return bench.scene->recording.moments()[bench.scene->moment].stage;
  }
  [[nodiscard]] std::string last_said() const { return bench.messages().back().text; }

  Workbench bench{ViewOptions{}};
  OwnFolder folder;
};

TEST_F(Rigging, IsOneMomentMoreAfterTheSkeleton) {
  open_y();
  EXPECT_EQ(stage(), "skeleton");
  EXPECT_EQ(bench.scene->rig(), nullptr);
  const std::size_t moments = bench.scene->recording.moments().size();
  bench.step();
  ASSERT_TRUE(wait([&] { return bench.has_rig(); }));
  EXPECT_EQ(bench.scene->recording.moments().size(), moments + 1);
  EXPECT_EQ(stage(), "rig");
  const auto rig = bench.scene->rig();
  ASSERT_NE(rig, nullptr);
  EXPECT_GT(rig->joints.rows(), 4);
  EXPECT_EQ(rig->weights.rows(), bench.scene->document.surface.positions.rows());
  EXPECT_FALSE(bench.scene->shows_curve());
  EXPECT_EQ(bench.scene->look_now().surface_colour, ColourBy::weight);
  bench.go_to(moments - 1);
  EXPECT_EQ(bench.scene->rig(), nullptr);
  EXPECT_TRUE(bench.scene->shows_curve());
  EXPECT_EQ(bench.scene->look_now().surface_colour, ColourBy::file);
  bench.step();
  EXPECT_EQ(stage(), "rig") << "it is there already";
  EXPECT_FALSE(bench.busy());
}

TEST_F(Rigging, GoesWithTheSkeletonItWasMadeOf) {
  open_y();
  make_rig();
  const auto of_all = bench.scene->rig();
  Pick edge;
  edge.kind = Pick::Kind::edge;
  edge.index = 0;
  bench.select(edge, false);
  bench.prune();
  EXPECT_FALSE(bench.has_rig());
  EXPECT_EQ(stage(), "skeleton");
  make_rig();
  EXPECT_LT(bench.scene->rig()->joints.rows(), of_all->joints.rows());
  bench.undo();
  EXPECT_FALSE(bench.has_rig());
  make_rig();
  EXPECT_EQ(bench.scene->rig()->joints, of_all->joints);
  bench.start(false);
  ASSERT_TRUE(wait([&] { return !bench.busy(); }));
  EXPECT_FALSE(bench.has_rig()) << "the skeleton is a new one";
}

/// It was saved without its materials, as its numbers are those of another pose.
TEST_F(Rigging, OfAFileThatRestsInAnotherPoseIsSavedIntoTheFile) {
  const EditSubject subject(folder.path(),
                            {.name = "posed", .rich = true, .old_rig = 4, .old_turn = 0.4});
  bench.open({subject.path()});
  ASSERT_TRUE(wait([&] { return bench.scene->document.has_surface() && !bench.busy(); }));
  bench.start(false);
  ASSERT_TRUE(wait([&] { return bench.result() != nullptr && !bench.busy(); }));
  make_rig();
  const std::filesystem::path saved = folder.path() / "saved.glb";
  bench.save(saved);
  EXPECT_TRUE(last_said().ends_with("saved.glb")) << last_said();
  const Positions shown = read_polygons(subject.path()).positions;
  const Positions found = read_polygons(saved).positions;
  ASSERT_EQ(found.rows(), shown.rows());
  EXPECT_LT((found - shown).rowwise().norm().maxCoeff(), 1e-5);
  std::ifstream stream(saved, std::ios::binary);
  const Glb glb = glb_of(std::string(std::istreambuf_iterator<char>(stream), {}));
  EXPECT_EQ(glb.json["materials"], subject.json()["materials"]);
  const std::filesystem::path layer = folder.path() / "saved.usda";
  bench.save(layer);
  EXPECT_TRUE(last_said().ends_with("saved.usda")) << last_said();
  std::ifstream text(layer);
  const std::string usd(std::istreambuf_iterator<char>(text), {});
  EXPECT_NE(usd.find("@./saved_textures/picture_1.png@"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "saved_textures" / "picture_1.png"));
}

TEST_F(Rigging, HangsFromTheRootThatWasSet) {
  open_y();
  Pick node;
  node.kind = Pick::Kind::node;
  node.index = static_cast<int>(bench.scene->skeleton()->nodes.rows()) - 1;
  bench.select(node, false);
  bench.set_root();
  const Eigen::RowVector3d place = bench.scene->skeleton()->nodes.row(node.index);
  make_rig();
  EXPECT_EQ(bench.scene->rig()->parents[0], -1);
  EXPECT_EQ(bench.scene->rig()->joints.row(0), place);
}

// It was dropped without a word whenever there were fewer nodes.
TEST_F(Rigging, TheRootStaysWithItsNodeOrGoesToItsHeir) {
  open_y();
  const auto skeleton = bench.scene->skeleton();
  const auto all = branches(*skeleton);
  int at_tips = 0;
  for (const Branch& branch : all) {
    for (const int root : {0, static_cast<int>(skeleton->nodes.rows()) - 1, branch.nodes[1]}) {
      SCOPED_TRACE("root " + std::to_string(root));
      Pick picked;
      picked.kind = Pick::Kind::node;
      picked.index = root;
      bench.select(picked, false);
      bench.set_root();
      picked.kind = Pick::Kind::edge;
      picked.index = edge_between(*skeleton, branch.nodes[0], branch.nodes[1]);
      bench.select(picked, false);
      bench.prune();
      const auto pruned = bench.scene->skeleton();
      ASSERT_LT(pruned->nodes.rows(), skeleton->nodes.rows());
      ASSERT_GE(bench.root(), 0);
      const bool on_it =
          std::find(branch.nodes.begin(), branch.nodes.end(), root) != branch.nodes.end();
      const Eigen::RowVector3d place = pruned->nodes.row(bench.root());
      if (place == skeleton->nodes.row(root)) {
        EXPECT_EQ(last_said(), "pruned a branch");
      } else {
        EXPECT_TRUE(on_it);
        const bool at_an_end = place == skeleton->nodes.row(branch.nodes.front()) ||
                               place == skeleton->nodes.row(branch.nodes.back());
        EXPECT_TRUE(at_an_end) << "the branch hangs there";
        EXPECT_NE(last_said().find("the root is node " + std::to_string(bench.root())),
                  std::string::npos)
            << last_said();
        ++at_tips;
      }
      bench.undo();
      EXPECT_EQ(bench.root(), root);
    }
  }
  EXPECT_GT(at_tips, 0);
}

TEST_F(Rigging, ANewSkeletonHasNoRootAndSaysSo) {
  open_y();
  Pick node;
  node.kind = Pick::Kind::node;
  node.index = 0;
  bench.select(node, false);
  bench.set_root();
  bench.start(false);
  ASSERT_TRUE(wait([&] { return !bench.busy(); }));
  EXPECT_EQ(bench.root(), -1);
  EXPECT_NE(last_said().find("root"), std::string::npos) << last_said();
}

TEST_F(Rigging, FollowsItsParametersEvenWhileItIsMade) {
  open_y();
  bench.pipeline.character.rig.joints.bone_length = 100;
  make_rig();
  const auto few = bench.scene->rig()->joints.rows();
  bench.pipeline.character.rig.joints.bone_length = 50;
  bench.rig();
  bench.pipeline.character.rig.joints.bone_length = 1;
  bench.rig();
  ASSERT_TRUE(wait([&] { return !bench.busy(); }));
  EXPECT_GT(bench.scene->rig()->joints.rows(), 2 * few);
}

TEST_F(Rigging, IsSavedAndMadeFirstIfNeedBe) {
  open_y();
  for (const char* name : {"first.glb", "second.GLTF"}) {
    const auto file = folder.path() / name;
    bench.save(file);
    ASSERT_TRUE(wait([&] { return !bench.busy(); }));
    ASSERT_TRUE(std::filesystem::exists(file)) << last_said();
    const auto read = read_rig(file, {});
    ASSERT_TRUE(read);
    EXPECT_EQ(read->joints.rows(), bench.scene->rig()->joints.rows());
    EXPECT_EQ(read_polygons(file, {}).positions.rows(),
              bench.scene->document.surface.positions.rows());
  }
  bench.save(folder.path() / "wrong.x3d");
  EXPECT_NE(last_said().find("for a rig, glb, gltf"), std::string::npos) << last_said();
}

TEST_F(Rigging, IsSavedBeforeAnotherFileIsOpened) {
  open_y();
  const auto file = folder.path() / "y.glb";
  bench.save(file);
  bench.open({mesh("torus.off")});
  EXPECT_TRUE(bench.wants_to_abandon);
  EXPECT_FALSE(bench.opening());
  ASSERT_TRUE(wait([&] { return bench.opening(); })) << "once the rig is saved";
  EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_FALSE(bench.wants_to_abandon);
}

TEST_F(Rigging, SaysSoWhereItsSurfaceIsReadAnewBeforeItIsSaved) {
  open_y();
  const auto file = folder.path() / "y.glb";
  const Scene* const before = bench.scene.get();
  bench.reload();
  ASSERT_TRUE(wait([&] {
    if (bench.scene.get() == before && !bench.making_rig() && !bench.has_rig()) bench.save(file);
    return bench.scene.get() != before || bench.has_rig();
  }));
  const auto& all = bench.messages();
  const bool told = std::any_of(all.begin(), all.end(), [](const Message& one) {
    return one.bad && one.text.find("was not saved") != std::string::npos;
  });
  EXPECT_NE(told, std::filesystem::exists(file));
}

TEST_F(Rigging, AVrmFileHasItsNameAuthorAndLicence) {
  open_y();
  const auto file = folder.path() / "human.vrm";
  bench.save(file);
  EXPECT_NE(last_said().find("--vrm-name"), std::string::npos) << last_said();
  EXPECT_FALSE(bench.busy()) << "before any rig is made for it";

  ViewOptions options;
  options.vrm = {"a", "b", "https://vrm.dev/licenses/1.0/"};
  options.pipeline.character.plan.front = Direction::minus_x;
  Workbench human(options);
  human.open({mesh("free/humanoid-10k.ply.gz")});
  const auto wait_for = [&](const auto& wanted) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    for (human.update(); !wanted(); human.update()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(1ms);
    }
    return true;
  };
  ASSERT_TRUE(wait_for([&] { return human.result() != nullptr && !human.busy(); }));
  human.save(file);
  ASSERT_TRUE(wait_for([&] { return !human.busy(); }));
  ASSERT_TRUE(std::filesystem::exists(file)) << human.messages().back().text;
  EXPECT_NE(human.messages().back().text.find("look along z"), std::string::npos)
      << human.messages().back().text;
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(bytes.find("https://vrm.dev/licenses/1.0/"), std::string::npos);
}

TEST_F(Rigging, OfASkeletonThatHasChangedMeanwhileIsNotShown) {
  open_y();
  Pick edge;
  edge.kind = Pick::Kind::edge;
  edge.index = 0;
  for (const bool finished : {false, true}) {
    bench.rig();
    if (finished) std::this_thread::sleep_for(2s);  // nobody has taken it yet
    bench.select(edge, false);
    bench.split();
    ASSERT_TRUE(wait([&] { return !bench.busy(); }));
    EXPECT_FALSE(bench.has_rig());
    EXPECT_EQ(stage(), "skeleton");
  }
  const auto file = folder.path() / "changed.glb";
  bench.save(file);
  bench.select(edge, false);
  bench.prune();
  ASSERT_TRUE(wait([&] { return !bench.busy(); }));
  ASSERT_TRUE(bench.has_rig());
  const auto saved = read_rig(file, {});
  ASSERT_TRUE(saved) << "what was to be saved is the skeleton as it is";
  EXPECT_EQ(saved->joints.rows(), bench.scene->rig()->joints.rows());
}

TEST_F(Rigging, IsSavedThoughAChangeWasMadeAndTakenBackMeanwhile) {
  open_y();
  Pick edge;
  edge.kind = Pick::Kind::edge;
  edge.index = 0;
  bench.select(edge, false);
  bench.split();
  const auto file = folder.path() / "as-before.glb";
  bench.save(file);
  bench.undo();
  bench.redo();
  ASSERT_TRUE(wait([&] { return !bench.busy(); }));
  EXPECT_TRUE(bench.has_rig());
  EXPECT_TRUE(std::filesystem::exists(file));
}

/// Beyond one limb of the letter, in its plane.
std::string y_with_a_wing() {
  std::ostringstream obj;
  const PolygonSoup y = read_polygons(mesh("y.off"));
  for (const auto& place : y.positions.rowwise()) obj << "v " << place << '\n';
  obj << "v 7.1 -2 0\nv 12 -2 0\nv 12 2 0\nv 7.1 2 0\n";
  for (std::size_t c = 0; c < y.corners.size(); ++c) {  // triangles
    obj << (c % 3 == 0 ? "\nf " : " ") << y.corners[c] + 1;
  }
  const Eigen::Index last = y.positions.rows() + 4;
  obj << "\nf " << last - 3 << ' ' << last - 2 << ' ' << last - 1 << ' ' << last << '\n';
  return std::move(obj).str();
}

TEST_F(Rigging, OfACorrectedSkeletonSaysHowSheetsGetJoints) {
  const auto file = folder.write("wing.obj", y_with_a_wing());
  const auto joints_in_the_wing = [&](double least_sheet) {
    bench.pipeline.repair.least_sheet = least_sheet;
    const Scene* const before = bench.scene.get();
    bench.open({file}, true);
    EXPECT_TRUE(wait([&] { return bench.scene.get() != before && bench.result() != nullptr; }));
    EXPECT_TRUE(wait([&] { return !bench.busy(); }));
    select_edge(bench, 0);
    bench.split();
    make_rig();
    return (bench.scene->rig()->joints.col(0).array() > 7.1).count();
  };
  EXPECT_EQ(joints_in_the_wing(0), 0);
  EXPECT_NE(last_said().find("least sheet of 0.1"), std::string::npos) << last_said();
  EXPECT_GE(joints_in_the_wing(0.1), 1);
  EXPECT_EQ(last_said().find("least sheet"), std::string::npos) << last_said();
}

TEST_F(Rigging, OfSheetsFollowsTheLeastSheetOfTheNextRun) {
  bench.open({folder.write("wing.obj", y_with_a_wing())});
  ASSERT_TRUE(wait([&] { return bench.result() != nullptr && !bench.busy(); }));
  for (const double least_sheet : {0.0, 0.9, 0.1}) {
    bench.pipeline.repair.least_sheet = least_sheet;  // as the slider does
    bench.start(false);
    ASSERT_TRUE(wait([&] { return !bench.busy(); }));
    make_rig();
    const bool has_joints = (bench.scene->rig()->joints.col(0).array() > 7.1).any();
    EXPECT_EQ(has_joints, least_sheet < 0.9) << least_sheet;
  }
}

TEST_F(Rigging, NeedsASkeletonAndSaysSo) {
  bench.rig();
  EXPECT_TRUE(bench.messages().back().bad);
  EXPECT_NE(last_said().find("needs a surface and its skeleton"), std::string::npos);
  bench.save(folder.path() / "nothing.glb");
  EXPECT_TRUE(bench.messages().back().bad);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "nothing.glb"));
  EXPECT_FALSE(bench.busy());
}

TEST_F(Rigging, OfAnotherDocumentIsNotShown) {
  open_y();
  bench.rig();
  const Scene* const before = bench.scene.get();
  bench.open({mesh("torus.off")});
  ASSERT_TRUE(wait([&] { return bench.scene.get() != before; }));
  ASSERT_TRUE(wait([&] { return !bench.busy(); }));
  EXPECT_FALSE(bench.has_rig());
}

TEST_F(Rigging, ChosenJointIsOfTheRigThatIsShown) {
  open_y();
  make_rig();
  bench.select_joint(2);
  EXPECT_EQ(bench.scene->highlights.joint, 2);
  bench.go_to(0);
  EXPECT_EQ(bench.selected_joint(), -1);
}

TEST_F(Rigging, APulledJointPointsAtThePointer) {
  open_y();
  make_rig();
  const Rig& rig = *bench.scene->rig();
  const DrawnSpace space = bench.scene->document.space;
  for (int round = 0; round < 2; ++round) {  // the second time with those above already turned
    for (int joint = 1; joint < rig.joints.rows(); ++joint) {
      const Positions before = bench.scene->joints_now();
      const int parent = rig.parents[joint];
      const Eigen::RowVector3d wanted = before.row(joint) + Eigen::RowVector3d(0.3, -0.2, 0.4);
      bench.pull_joint(joint, shown_point(wanted, space));
      const Positions now = bench.scene->joints_now();
      const Eigen::RowVector3d bone = now.row(joint) - now.row(parent);
      EXPECT_LT((now.row(parent) - before.row(parent)).norm(), 1e-9);
      EXPECT_NEAR(bone.norm(), (before.row(joint) - before.row(parent)).norm(), 1e-9);
      EXPECT_GT(bone.normalized().dot((wanted - now.row(parent)).normalized()), 1 - 1e-6);
    }
  }
  bench.turn_back();
  EXPECT_EQ(bench.scene->joints_now(), rig.joints);
}

TEST_F(Rigging, TurnsGoWithTheRig) {
  open_y();
  make_rig();
  bench.turn_joint(0, Eigen::Quaterniond(0, 1, 0, 0));
  EXPECT_NE(bench.scene->turns(), nullptr);
  bench.rig();
  ASSERT_TRUE(wait([&] { return !bench.busy(); }));
  EXPECT_EQ(bench.scene->turns(), nullptr);
}

TEST_F(Rigging, IsCancelledLikeARun) {
  open_y();
  EXPECT_FALSE(bench.can_cancel());
  bench.rig();
  EXPECT_TRUE(bench.can_cancel());
  bench.cancel_what_goes_on();
  ASSERT_TRUE(wait([&] { return !bench.busy(); }));
  EXPECT_FALSE(bench.has_rig());
  EXPECT_EQ(last_said(), "the rig was cancelled");
  make_rig();
}

TEST_F(Rigging, PosesAreTakenBackAndDoneAgainStepByStep) {
  bench.pipeline.character.plan.plan = BodyKind::humanoid;
  open_y();
  make_rig();
  const Positions rest = bench.scene->joints_now();
  EXPECT_FALSE(bench.can_undo());
  std::vector<Positions> poses{rest};
  for (const double degrees : {20.0, 40.0}) {
    bench.begin_turning();  // one step, however many turns
    for (int part = 0; part < 3; ++part) bench.turn_joint(0, turn_by({0, 0, degrees / 3}));
    poses.push_back(bench.scene->joints_now());
  }
  bench.turn_back();
  EXPECT_EQ(bench.scene->joints_now(), rest);
  bench.undo();
  EXPECT_EQ(bench.scene->joints_now(), poses[2]);
  bench.undo();
  EXPECT_EQ(bench.scene->joints_now(), poses[1]);
  bench.undo();
  EXPECT_EQ(bench.scene->joints_now(), rest);
  EXPECT_FALSE(bench.can_undo());
  bench.redo();
  EXPECT_EQ(bench.scene->joints_now(), poses[1]);
  bench.select_joint(0);
  bench.set_role("jaw");
  bench.undo();  // the role, which came last
  EXPECT_NE(bench.scene->rig()->roles[0], "jaw");
  EXPECT_EQ(bench.scene->joints_now(), poses[1]) << "the pose stays";
}

TEST_F(Rigging, ARoleIsSavedAsItWasCorrected) {
  bench.pipeline.character.plan.plan = BodyKind::humanoid;
  open_y();
  make_rig();
  bench.select_joint(0);
  bench.set_role("jaw");
  EXPECT_EQ(bench.selected_joint(), 0);
  bench.turn_joint(0, Eigen::Quaterniond(0, 1, 0, 0));
  bench.set_role("head");
  EXPECT_NE(bench.scene->turns(), nullptr) << "the pose stays";
  const std::filesystem::path file = folder.path() / "roles.glb";
  bench.save(file);
  const auto character = bench.scene->character();
  ASSERT_NE(character, nullptr);
  EXPECT_EQ(character->rig.roles[0], "head");
  EXPECT_EQ(character->rig.names[0], "head");
  const auto read = read_rig(file, {});
  ASSERT_TRUE(read);
  EXPECT_EQ(read->names[0], "head");
  EXPECT_TRUE(read->joints.isApprox(character->rig.joints, 1e-6)) << "at rest";
}

TEST_F(Rigging, ARoleThatWasCorrectedStaysSoAndCanBeTakenBack) {
  bench.pipeline.character.plan.plan = BodyKind::humanoid;
  open_y();
  make_rig();
  const std::vector<std::string> found = bench.scene->rig()->roles;
  const std::string name = bench.scene->rig()->names[1];
  bench.select_joint(1);
  bench.set_role("jaw");
  EXPECT_EQ(last_said(), name + " is now the jaw");
  const std::vector<std::string> corrected = bench.scene->rig()->roles;
  ASSERT_NE(corrected, found);
  bench.pipeline.character.rig.skin.softness = 2;
  bench.rig();
  ASSERT_TRUE(wait([&] { return !bench.busy(); }));
  EXPECT_EQ(bench.scene->rig()->roles, corrected) << "as another rig of the same joints has them";
  bench.undo();
  ASSERT_NE(bench.scene->rig(), nullptr) << "it need not be made anew";
  EXPECT_EQ(bench.scene->rig()->roles, found);
  bench.redo();
  EXPECT_EQ(bench.scene->rig()->roles, corrected);
}

TEST(WishedJoint, IsChosenOnceThereIsARig) {
  ViewOptions options;
  options.joint = "root";
  Workbench bench{options};
  bench.open({mesh_called("y.off")});
  ASSERT_TRUE(wait_for(bench, [&] { return bench.result() != nullptr && !bench.busy(); }));
  EXPECT_EQ(bench.selected_joint(), -1);
  bench.rig();
  ASSERT_TRUE(wait_for_rest(bench));
  ASSERT_GE(bench.selected_joint(), 0);
  EXPECT_EQ(bench.scene->rig()->names[static_cast<std::size_t>(bench.selected_joint())], "root");
  bench.select_joint(-1);
  bench.rig();
  ASSERT_TRUE(wait_for_rest(bench));
  EXPECT_EQ(bench.selected_joint(), -1) << "a person has chosen none";
}

TEST(GivenRole, IsForAJointInItsPlaceAlone) {
  CharacterRig character;
  character.plan.plan = BodyKind::humanoid;
  character.rig.joints.resize(2, 3);
  character.rig.joints << 0, 0, 0, 1, 0, 0;
  character.rig.parents = Eigen::Vector2i(-1, 0);
  character.rig.names = {"a", "b"};
  character.rig.roles = {"hips", "spine"};
  character.rig.weights.resize(0, 2);
  const std::vector<GivenRole> given{{0, {1, 0, 0}, "head"},       // the number of another rig's
                                     {0, {0.5, 0, 0}, "jaw"},      // where there is none
                                     {0, {0, 0, 0}, "tentacle"}};  // which no human has
  give_roles(character, given, 1, NameStyle::automatic);
  EXPECT_EQ(character.rig.roles, (std::vector<std::string>{"hips", "head"}));
}

/// A bent tube, and a button on it.
TEST(RigOf, IsJudgedByTheBodyWithoutThePartsThatFollow) {
  const shapes::Shape tube = shapes::tube("", shapes::s_curve(16, 6), shapes::constant(1), 16);
  const Eigen::Vector3d place =
      tube.axis.nodes.row(tube.axis.nodes.rows() / 5).transpose() + 0.95 * Eigen::Vector3d::UnitZ();
  const shapes::Shape button = shapes::translated(shapes::ellipsoid({0.2, 0.2, 0.2}, 2), place);
  Document document;
  document.surface = shapes::together("", {tube, button}).surface;
  const RepairedSurface repaired = repair(*document.polygons());
  const CurveSkeleton skeleton =
      extract_repaired(repaired, RepairOptions{}, ExtractOptions{}).extraction.skeleton;
  Certificate of_all;  // as if the button were larger, and flat
  of_all.curve_like = false;
  of_all.tube_share = 0;
  const auto reason = [&](const CharacterOptions& options) {
    return rig_of(document, repaired, skeleton, &of_all, options, {})->plan.reason;
  };
  EXPECT_EQ(reason({}).find("not made of tubes"), std::string::npos) << reason({});
  CharacterOptions all_body;
  all_body.parts.follow = 0;
  EXPECT_NE(reason(all_body).find("not made of tubes"), std::string::npos) << reason(all_body);
}

}  // namespace
}  // namespace curveskel::viewer::rigging_laws
