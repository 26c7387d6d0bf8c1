// Laws of writing rigs: what is written reads back the same, what cannot be is refused.
#include <curveskel/rig_files.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_rig.hpp>
#include "tests/own_folder.hpp"
#include "tests/rig/random_rigs.hpp"

namespace curveskel::write_rig_laws {
namespace {

class WriteRig : public testing::TestWithParam<RigFormat> {
 protected:
  [[nodiscard]] std::string format(const Surface& surface, const Rig& rig) const {
    return format_rig(surface, rig, GetParam(), "a torus", "a test");
  }
  [[nodiscard]] std::filesystem::path write(const Surface& surface, const Rig& rig) const {
    const bool is_binary = GetParam() == RigFormat::glb;
    return folder_.write(is_binary ? "rig.glb" : "rig.gltf", format(surface, rig));
  }
  [[nodiscard]] std::string refusal(const Surface& surface, const Rig& rig) const {
    try {
      (void)format(surface, rig);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::output);
      return error.what();
    }
    return "";
  }

 private:
  OwnFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Formats, WriteRig, testing::Values(RigFormat::glb, RigFormat::gltf),
                         [](const auto& one) {
                           return one.param == RigFormat::glb ? "glb" : "gltf";
                         });

/// Joints may come back in another order: each by its name.
void expect_same_rig(const Rig& found, const Rig& rig) {
  ASSERT_EQ(found.joints.rows(), rig.joints.rows());
  ASSERT_EQ(found.weights.rows(), rig.weights.rows());
  std::map<std::string, int> joint_of_name;
  for (int joint = 0; joint < found.joints.rows(); ++joint) {
    joint_of_name[found.names[idx(joint)]] = joint;
  }
  Eigen::MatrixXf reordered(rig.weights.rows(), rig.weights.cols());
  const Eigen::MatrixXf dense = found.weights;
  for (int joint = 0; joint < rig.joints.rows(); ++joint) {
    ASSERT_TRUE(joint_of_name.contains(rig.names[idx(joint)])) << rig.names[idx(joint)];
    const int other = joint_of_name[rig.names[idx(joint)]];
    EXPECT_LT((found.joints.row(other) - rig.joints.row(joint)).norm(), 1e-5);
    const int parent = rig.parents[joint];
    const int above = found.parents[other];
    EXPECT_EQ(above < 0 ? "" : found.names[idx(above)], parent < 0 ? "" : rig.names[idx(parent)]);
    reordered.col(joint) = dense.col(other);
  }
  EXPECT_LT((reordered - Eigen::MatrixXf(rig.weights)).cwiseAbs().maxCoeff(), 1e-6F);
}

TEST_P(WriteRig, ReadsBackTheSame) {
  const Surface surface = torus_surface();
  for (const WrittenCase& one : written_cases()) {
    SCOPED_TRACE(one.joints);
    const Rig rig = random_rig(surface.positions.rows(), one.joints, one.name);
    const std::filesystem::path file = write(surface, rig);
    const PolygonSoup soup = read_polygons(file, {});
    EXPECT_EQ(soup.positions, surface.positions.cast<float>().cast<double>());
    EXPECT_EQ(triangulate(soup), surface.triangles);
    const std::optional<Rig> found = read_rig(file, {});
    ASSERT_TRUE(found);
    expect_same_rig(*found, rig);
  }
}

TEST_P(WriteRig, GivesTheSameBytesEachTime) {
  const Surface surface = torus_surface();
  const Rig rig = random_rig(surface.positions.rows(), 20, "joint ");
  EXPECT_EQ(format(surface, rig), format(surface, rig));
}

TEST_P(WriteRig, RefusesWhatIsBeyondSinglePrecision) {
  const Surface surface = torus_surface();
  const Rig rig = random_rig(surface.positions.rows(), 3, "joint ");
  EXPECT_EQ(refusal(surface, rig), "");
  for (const double far : {1e39, -1e39}) {
    Surface huge = surface;
    huge.positions(7, 1) = far;
    EXPECT_NE(refusal(huge, rig).find("single precision"), std::string::npos);
    Rig reaching = rig;
    reaching.joints(2, 0) = far;
    EXPECT_NE(refusal(surface, reaching).find("single precision"), std::string::npos);
  }
}

TEST_P(WriteRig, SaysWhyDigitsWouldBeLost) {
  const Surface surface = torus_surface();
  const Rig rig = random_rig(surface.positions.rows(), 3, "joint ");
  Surface tiny = surface;
  tiny.positions *= 1e-60;
  EXPECT_NE(refusal(tiny, rig).find("scale the surface up"), std::string::npos);
  Surface far = surface;
  far.positions.col(1).array() += 1e9;
  EXPECT_NE(refusal(far, rig).find("move the surface to the origin"), std::string::npos);
}

TEST_P(WriteRig, RefusesMoreJointsThanSixteenBitsCount) {
  const Surface surface = torus_surface();
  const Rig rig = random_rig(surface.positions.rows(), 65537, "joint ");
  EXPECT_NE(refusal(surface, rig).find("65537 joints, needed at most 65536"), std::string::npos);
}

/// File names are bytes; glTF is UTF-8.
TEST_P(WriteRig, TakesNamesThatAreNoUtf8) {
  const Surface surface = torus_surface();
  const Rig rig = random_rig(surface.positions.rows(), 3, "joint ");
  const std::string text = format_rig(surface, rig, GetParam(), "caf\xe9", "from caf\xe9.obj");
  EXPECT_NE(text.find("caf\xef\xbf\xbd"), std::string::npos);
}

/// A weight of zero that is stored is none.
TEST_P(WriteRig, VerticesWithoutAWeightGoWithTheFirstJoint) {
  const Surface surface = torus_surface();
  Rig rig = random_rig(surface.positions.rows(), 7, "b");
  for (SkinWeights::InnerIterator it(rig.weights, 5); it; ++it) it.valueRef() = 0;
  rig.weights.coeffRef(5, 6) = 0;
  const auto found = read_rig(write(surface, rig));
  ASSERT_TRUE(found);
  for (SkinWeights::InnerIterator it(found->weights, 5); it; ++it) {
    EXPECT_EQ(found->names[idx(it.col())], "b0");
    EXPECT_EQ(it.value(), 1);
  }
}

TEST(WriteRigFile, ThatFailsLeavesWhatWasThereBefore) {
  const OwnFolder folder;
  std::filesystem::create_directory(folder.path() / "rig.usda");
  std::filesystem::create_directory(folder.path() / "kept");
  const auto write_it = [&](const std::string& side) {
    write_rig_file(folder.path() / "rig.usda", "#usda", {{side, "a picture"}});
  };
  EXPECT_THROW(write_it("rig_textures/skin.png"), Error);
  EXPECT_THROW(write_it("kept/skin.png"), Error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "rig_textures"));
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "kept"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "kept"));
  std::filesystem::remove(folder.path() / "rig.usda");
  write_it("rig_textures/skin.png");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "rig_textures" / "skin.png"));
}

}  // namespace
}  // namespace curveskel::write_rig_laws
