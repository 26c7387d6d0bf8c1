// Laws of rigs in the viewer: what is drawn, coloured, picked and selected of a bar whose rig is
// known.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include <curveskel/error.hpp>
#include "tests/own_folder.hpp"
#include "tests/rig/rigged_bar.hpp"
#include "viewer/render/scene.hpp"
#include "viewer/workbench/pick.hpp"
#include "viewer/workbench/workbench.hpp"

namespace curveskel::viewer::rig_view_laws {
namespace {

namespace fs = std::filesystem;

class RigView : public testing::Test {
 protected:
  RigView() { write_rigged_bar(file(), {.joints = joints, .first_weight = 0}); }

  [[nodiscard]] fs::path file() const { return folder_.path() / "bar.gltf"; }
  [[nodiscard]] Document document() const { return open_document({file()}, {}); }

  static constexpr int joints = 5;

 private:
  OwnFolder folder_;
};

Look look_by_weight() {
  Look look;
  look.surface_colour = ColourBy::weight;
  return look;
}

void open_all(Workbench& bench) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (bench.busy()) {
    ASSERT_LT(std::chrono::steady_clock::now(), end);
    bench.update();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST_F(RigView, BonesGoFromJointToJoint) {
  const Document opened = document();
  ASSERT_TRUE(opened.rig);
  const ShownSkeleton shown = shown_rig(*opened.rig, opened.rig->joints, opened.space, 5, {}, {});
  ASSERT_EQ(shown.nodes.size(), static_cast<std::size_t>(joints));
  ASSERT_EQ(shown.edges.size(), static_cast<std::size_t>(2 * (joints - 1)));
  for (int bone = 0; bone + 1 < joints; ++bone) {
    const TubeInstance& head = shown.edges[2 * static_cast<std::size_t>(bone)];
    const TubeInstance& tail = shown.edges[2 * static_cast<std::size_t>(bone) + 1];
    EXPECT_EQ(head.to, tail.from);
    EXPECT_GT(head.to.w, 0);
    EXPECT_EQ(head.from.w, 0);
    EXPECT_EQ(tail.to.w, 0);
    const glm::vec3 along = glm::vec3(tail.to) - glm::vec3(head.from);
    const float bone_length = shown_length(1, opened.space);
    EXPECT_NEAR(along.x / bone_length, 1, 1e-5);
    EXPECT_NEAR(glm::length(along) / bone_length, 1, 1e-5);
  }
}

TEST_F(RigView, ARoleHasItsColourWhateverElseThereIs) {
  const Document opened = document();
  Look look;
  look.surface_colour = ColourBy::role;
  const auto colours = [&](const std::vector<std::string>& roles) {
    Rig rig = *opened.rig;
    rig.roles = roles;
    return surface_colours(opened.surface, {nullptr, &rig, nullptr, nullptr}, look, {});
  };
  const auto all = colours({"hips", "spine", "chest", "neck", "head"});
  const auto without_hips = colours({"", "spine", "chest", "neck", "head"});
  ASSERT_EQ(all.size(), without_hips.size());
  int same = 0;
  for (Eigen::Index vertex = 0; vertex < opened.rig->weights.rows(); ++vertex) {
    const auto at = static_cast<std::size_t>(vertex);
    const Eigen::RowVectorXf shares = opened.rig->weights.row(vertex).toDense();
    if (shares[0] > 0) continue;
    EXPECT_EQ(all[at], without_hips[at]);
    ++same;
  }
  EXPECT_GT(same, 0);
}

TEST_F(RigView, WeightsOfOneJointGoThroughTheMap) {
  const Document opened = document();
  const Look look = look_by_weight();
  for (int joint = 0; joint < joints; ++joint) {
    Highlights lit;
    lit.joint = joint;
    const auto colours = surface_colours(opened.surface, {nullptr, opened.rig.get()}, look, lit);
    ASSERT_EQ(colours.size(), static_cast<std::size_t>(opened.surface.positions.rows()));
    EXPECT_EQ(colours[0], rgba(palette_of(look.theme).surface)) << "nothing moves it";
    for (std::size_t v = 1; v < colours.size(); ++v) {
      const float weight = opened.rig->weights.coeff(static_cast<Eigen::Index>(v), joint);
      EXPECT_EQ(colours[v], rgba(mapped(look.map, weight))) << v << ' ' << joint;
    }
  }
}

TEST_F(RigView, WeightsOfAllJointsMixTheirColours) {
  const Document opened = document();
  const auto colours =
      surface_colours(opened.surface, {nullptr, opened.rig.get()}, look_by_weight(), {});
  EXPECT_EQ(colours[1], rgba(category(0)));
  EXPECT_EQ(colours[4], rgba(glm::mix(category(0), category(1), 0.5F)));
  EXPECT_EQ(colours.back(), rgba(category(joints - 1)));
}

TEST_F(RigView, WeightsOfAnotherSurfaceAreNotShown) {
  const Document opened = document();
  Surface other = opened.surface;
  other.positions.conservativeResize(other.positions.rows() + 1, 3);
  other.positions.bottomRows<1>().setZero();
  EXPECT_TRUE(surface_colours(other, {nullptr, opened.rig.get()}, look_by_weight(), {}).empty());
  EXPECT_TRUE(surface_colours(opened.surface, {}, look_by_weight(), {}).empty());
}

TEST_F(RigView, JointsArePickedWhereTheyAreSeen) {
  constexpr int width = 640;
  constexpr int height = 400;
  Scene scene(document());
  fit(scene.camera, scene.points(), float(width) / height);
  for (int joint = 0; joint < joints; ++joint) {
    const glm::vec3 place =
        shown_point(scene.document.rig->joints.row(joint), scene.document.space);
    const glm::vec2 at(pixel_of(scene.camera, scene.bounds(), place, width, height));
    const Pick found = pick(scene, at, width, height);
    EXPECT_EQ(found.kind, Pick::Kind::joint);
    EXPECT_EQ(found.index, joint);
    EXPECT_LT(glm::length(found.place - place), 1e-6);
    scene.look.bones = false;
    EXPECT_EQ(pick(scene, at, width, height).kind, Pick::Kind::face);
    scene.look.bones = true;
  }
}

TEST_F(RigView, JointsAreAsEasyToPickOnAFineDisplay) {
  constexpr int width = 640;
  constexpr int height = 400;
  Scene scene(document());
  scene.look.surface = SurfaceStyle::hidden;
  fit(scene.camera, scene.points(), float(width) / height);
  const glm::vec3 place = shown_point(scene.document.rig->joints.row(0), scene.document.space);
  const glm::vec2 at(pixel_of(scene.camera, scene.bounds(), place, width, height));
  const glm::vec2 beside = at + glm::vec2(0, 14);
  EXPECT_EQ(pick(scene, beside, width, height).kind, Pick::Kind::nothing);
  EXPECT_EQ(pick(scene, beside, width, height, 2).kind, Pick::Kind::joint);
}

TEST_F(RigView, JointThatThereIsNotIsNamed) {
  Scene scene(document());
  scene.look = {};
  EXPECT_THROW(look_at_rig(scene, "elbow"), Error);
  EXPECT_EQ(scene.highlights.joint, -1);
  EXPECT_EQ(scene.look_now().surface_colour, ColourBy::weight) << "all of them are shown";
  ViewOptions options;
  options.files = {file()};
  options.joint = "elbow";
  Workbench bench(options);
  open_all(bench);
  ASSERT_FALSE(bench.messages().empty());
  const Message& last = bench.messages().back();
  EXPECT_TRUE(last.bad);
  EXPECT_NE(last.text.find("no joint is called elbow; there are joint 0, "), std::string::npos)
      << last.text;
}

TEST_F(RigView, IsOpenedToBeLookedAt) {
  ViewOptions options;
  options.files = {file()};
  options.joint = "joint 2";
  Workbench bench(options);
  open_all(bench);
  ASSERT_TRUE(bench.scene->document.rig);
  EXPECT_EQ(bench.scene->recording.moments().size(), 1U) << "no run";
  EXPECT_EQ(bench.scene->look_now().surface_colour, ColourBy::weight);
  EXPECT_EQ(bench.selected_joint(), 2);
  EXPECT_EQ(bench.scene->highlights.joint, 2);
  Pick other;
  other.kind = Pick::Kind::joint;
  other.index = 4;
  bench.select(other, false);
  EXPECT_EQ(bench.scene->highlights.joint, 4);
  bench.select(other, false);
  EXPECT_EQ(bench.scene->highlights.joint, -1) << "again: all of them";
  bench.select_joint(1);
  bench.clear_selection();
  EXPECT_EQ(bench.selected_joint(), -1);
}

}  // namespace
}  // namespace curveskel::viewer::rig_view_laws
