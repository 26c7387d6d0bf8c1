// Laws of the window's picture: it is drawn anew whenever another one would be seen.
#include "viewer/window/window_picture.hpp"

#include <epoxy/gl.h>
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

// In the light theme the window was black.
TEST_F(DrawnAgain, ButNotWhereFilesAreToHaveNoBackground) {
  EXPECT_FALSE(after([&] { scene->look.transparent_background = true; }));
}

TEST_F(DrawnAgain, WhereTheRigIsAnotherOne) {
  EXPECT_TRUE(after([&] {
    Rig other = *scene->rig();
    other.joints.col(1).array() += 0.3;
    scene->document.rig = std::make_shared<const Rig>(other);
  }));
}

/// All of the surface red, in one run.
DrawnMaterials red_all_over(const Surface& surface) {
  DrawnMaterials red;
  const auto vertices = static_cast<std::size_t>(surface.positions.rows());
  for (std::uint32_t v = 0; v < vertices; ++v) red.vertices.push_back(v);
  for (const auto& corners : surface.triangles.rowwise()) {
    red.triangles.emplace_back(corners[0], corners[1], corners[2]);
  }
  red.places.assign(vertices, glm::vec2(0));
  red.colours.assign(vertices, rgba({1, 0, 0}));
  red.colour_of_vertex = red.colours;
  red.runs.push_back({.first = 0, .count = red.triangles.size()});
  return red;
}

TEST_F(DrawnAgain, WhereMaterialsCome) {
  scene->look.bones = false;  // else the colours change, too
  picture.draw(*scene, width, height);
  EXPECT_TRUE(after([&] {
    scene->materials =
        std::make_shared<const DrawnMaterials>(red_all_over(scene->document.surface));
  }));
}

int pictures_uploaded = 0;
decltype(epoxy_glTexImage2D) upload_picture = nullptr;

// Each step of a pose brought all of them anew, once for each run of triangles.
TEST_F(DrawnAgain, PicturesAreUploadedOnceForAllPoses) {
  DrawnMaterials given = red_all_over(scene->document.surface);
  given.pictures.push_back({1, 1, {255, 255, 255, 255}});
  given.runs = {{.picture = 0, .first = 0, .count = 1},
                {.picture = 0, .first = 1, .count = 1},
                {.picture = 0, .repeats = {true, false}, .first = 2, .count = 1}};
  scene->materials = std::make_shared<const DrawnMaterials>(given);
  pictures_uploaded = 0;
  upload_picture = epoxy_glTexImage2D;  // known since the first picture was drawn
  epoxy_glTexImage2D = [](auto... all) {
    ++pictures_uploaded;
    upload_picture(all...);
  };
  JointTurns turns(scene->rig()->names.size(), Eigen::Quaterniond::Identity());
  for (const double degrees : {0.0, 20.0, 40.0}) {
    turns[1] = turn_by({degrees, 0, 0});
    scene->turn(turns);
    scene->upload(picture.renderer());
    EXPECT_EQ(pictures_uploaded, 2) << "one for each way to repeat it";
  }
  epoxy_glTexImage2D = upload_picture;
}

}  // namespace
}  // namespace curveskel::viewer::window_picture_laws
