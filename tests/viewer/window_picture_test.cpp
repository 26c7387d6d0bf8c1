// Laws of the window's picture: it is drawn anew whenever another one would be seen.
#include "viewer/window/window_picture.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "tests/own_folder.hpp"
#include "tests/rig/rigged_bar.hpp"
#include "viewer/headless/headless.hpp"

namespace curveskel::viewer::window_picture_laws {
namespace {

constexpr int width = 160;
constexpr int height = 100;

class DrawnAgain : public testing::Test {
 protected:
  DrawnAgain() {
    write_rigged_bar(file(), {.joints = 5, .first_weight = 0});
    scene.emplace(open_document({file()}, {}));
    scene->look.surface = SurfaceStyle::opaque;
    fit(scene->camera, scene->points(), 1.6F);
    picture.may_be_coarse = false;
    picture.draw(*scene, width, height);
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "bar.gltf"; }
  /// True if it was drawn, and differs.
  bool after(const std::function<void()>& change) {
    const auto before = picture.renderer().read().bytes;
    EXPECT_FALSE(picture.draw(*scene, width, height)) << "nothing has changed yet";
    change();
    return picture.draw(*scene, width, height) && picture.renderer().read().bytes != before;
  }

  HeadlessContext context;
  WindowPicture picture;
  std::optional<Scene> scene;

 private:
  OwnFolder folder_;
};

TEST_F(DrawnAgain, WhereAJointIsTurnedAndTurnedBack) {
  JointTurns turns(scene->rig()->names.size(), Eigen::Quaterniond::Identity());
  turns[1] = turn_by({40, 60, 0});
  EXPECT_TRUE(after([&] { scene->turn(turns); }));
  EXPECT_TRUE(after([&] { scene->turn_back(); }));
}

TEST_F(DrawnAgain, WhereTheRigIsAnotherOne) {
  EXPECT_TRUE(after([&] {
    Rig other = *scene->rig();
    other.joints.col(1).array() += 0.3;
    scene->document.rig = std::make_shared<const Rig>(other);
  }));
}

TEST_F(DrawnAgain, WhereMaterialsCome) {
  scene->look.bones = false;  // else the colours change, too
  picture.draw(*scene, width, height);
  EXPECT_TRUE(after([&] {
    DrawnMaterials red;
    const Surface& surface = scene->document.surface;
    const auto vertices = static_cast<std::size_t>(surface.positions.rows());
    for (std::uint32_t v = 0; v < vertices; ++v) red.vertices.push_back(v);
    for (const auto& corners : surface.triangles.rowwise()) {
      red.triangles.emplace_back(corners[0], corners[1], corners[2]);
    }
    red.places.assign(vertices, glm::vec2(0));
    red.colours.assign(vertices, rgba({1, 0, 0}));
    red.colour_of_vertex = red.colours;
    red.runs.push_back({.first = 0, .count = red.triangles.size()});
    scene->materials = std::make_shared<const DrawnMaterials>(red);
  }));
}

}  // namespace
}  // namespace curveskel::viewer::window_picture_laws
