// Laws of FBX: records are read as they were written, and a rig's file has its surface, joints and
// weights.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/write_file.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "rig/fbx/fbx_of_glb.hpp"
#include "rig/fbx/fbx_records.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/rig_subjects.hpp"
#include "tests/rig/rigged_bar.hpp"

namespace curveskel::fbx_laws {
namespace {

using Values =
    std::variant<std::int32_t, std::int64_t, double, std::string, std::vector<double>,
                 std::vector<std::int32_t>, std::vector<float>, std::vector<std::int64_t>>;

struct Branch {
  std::string name;
  std::vector<Values> values;
  std::vector<Branch> within;
};

class RandomTree {
 public:
  explicit RandomTree(unsigned seed) : random_(seed) {}

  Branch branch(int depth) {
    Branch made;
    made.name = "record" + std::to_string(below(1000));
    for (int k = below(4); k > 0; --k) made.values.push_back(value());
    for (int k = depth > 0 ? below(4) : 0; k > 0; --k) made.within.push_back(branch(depth - 1));
    return made;
  }

 private:
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

  Values value() {
    switch (below(8)) {
      case 0:
        return static_cast<std::int32_t>(random_());
      case 1:
        return static_cast<std::int64_t>(random_()) << 20;
      case 2:
        return static_cast<double>(random_()) / 3;
      case 3:
        return std::string(idx(below(300)), 'x');
      case 4:
        return std::vector<double>(idx(below(300)), static_cast<double>(random_()) / 7);
      case 5:
        return std::vector<float>(idx(below(300)), static_cast<float>(random_()) / 7);
      case 6:
        return std::vector<std::int64_t>(idx(below(300)), std::int64_t{below(1000)} << 40);
      default:
        return std::vector<std::int32_t>(idx(below(300)), below(1000));
    }
  }

  std::mt19937 random_;
};

void write(FbxRecords& records, const Branch& branch) {
  records.begin(branch.name);
  for (const Values& value : branch.values) {
    std::visit([&](const auto& one) { records.add(one); }, value);
  }
  for (const Branch& inner : branch.within) write(records, inner);
  records.end();
}

struct Compare {
  const FileBytes& file;
  const FbxRecord& found;
  std::size_t place;

  void operator()(std::int32_t wanted) const { EXPECT_EQ(found.integer(place, -1), wanted); }
  void operator()(std::int64_t wanted) const { EXPECT_EQ(found.integer(place, -1), wanted); }
  void operator()(double wanted) const { EXPECT_EQ(found.number(place, -1), wanted); }
  void operator()(const std::string& wanted) const { EXPECT_EQ(found.text(place), wanted); }
  template <typename Number>
  void operator()(const std::vector<Number>& wanted) const {
    const auto* array = std::get_if<FbxArray>(&found.values[place]);
    ASSERT_NE(array, nullptr);
    ASSERT_EQ(array->count, wanted.size());
    FbxRecord alone;
    alone.values.emplace_back(*array);
    const std::vector<double> numbers = fbx_numbers(file, alone);
    EXPECT_EQ(numbers, std::vector<double>(wanted.begin(), wanted.end()));
  }
};

void expect_same(const FileBytes& file, const FbxRecord& found, const Branch& wanted) {
  EXPECT_EQ(found.name, wanted.name);
  ASSERT_EQ(found.values.size(), wanted.values.size());
  for (std::size_t k = 0; k < wanted.values.size(); ++k) {
    std::visit(Compare{file, found, k}, wanted.values[k]);
  }
  ASSERT_EQ(found.children.size(), wanted.within.size());
  for (std::size_t k = 0; k < wanted.within.size(); ++k) {
    expect_same(file, found.children[k], wanted.within[k]);
  }
}

TEST(Fbx, RecordsAreReadAsTheyWereWritten) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Branch all;
    FbxRecords records;
    RandomTree random(seed);
    for (int k = 0; k < 5; ++k) {
      all.within.push_back(random.branch(4));
      write(records, all.within.back());
    }
    const FileBytes file{"random.fbx", std::move(records).finish()};
    ASSERT_TRUE(is_binary_fbx(file));
    expect_same(file, parse_fbx(file), all);
  }
}

/// The FBX of a subject's rig.
struct Written {
  Rig rig;
  FileBytes file;
  FbxRecord root;  // views of the file
  FbxScene scene;

  explicit Written(const RigSubject& subject)
      : rig(make_rig(subject.surface, subject.skeleton, {}, {})),
        file{"rig.fbx", format_rig(subject.surface, rig, RigFormat::fbx, subject.name, "test")},
        root(parse_fbx(file)),
        scene(file, root) {}
};

const FbxRecord& only(const std::vector<const FbxRecord*>& found) {
  EXPECT_EQ(found.size(), 1U);
  return *found.front();
}

std::vector<double> numbers_in(const FileBytes& file, const FbxRecord& record, const char* name) {
  const FbxRecord* child = record.child(name);
  return child == nullptr ? std::vector<double>{} : fbx_numbers(file, *child);
}

TEST(Fbx, HasTheSurface) {
  for (const RigSubject& subject : rig_subjects()) {
    SCOPED_TRACE(subject.name);
    const Written written(subject);
    const FbxScene& scene = written.scene;
    const FbxRecord& geometry = only(scene.all("Geometry"));
    const std::vector<double> places = numbers_in(written.file, geometry, "Vertices");
    ASSERT_EQ(places.size(), idx(subject.surface.positions.size()));
    const double size = subject.surface.positions.cwiseAbs().maxCoeff();
    for (Eigen::Index k = 0; k < subject.surface.positions.size(); ++k) {
      EXPECT_NEAR(places[idx(k)], subject.surface.positions(k / 3, k % 3), 1e-6 * size);
    }
    const std::vector<double> corners = numbers_in(written.file, geometry, "PolygonVertexIndex");
    ASSERT_EQ(corners.size(), idx(subject.surface.triangles.size()));
    for (Eigen::Index k = 0; k < subject.surface.triangles.size(); ++k) {
      const int corner = subject.surface.triangles(k / 3, k % 3);
      EXPECT_EQ(corners[idx(k)], k % 3 == 2 ? -corner - 1 : corner);
    }
  }
}

std::string name_of(const FbxRecord& object) {
  const std::string_view text = object.text(1);
  return std::string(text.substr(0, text.find('\0')));
}

TEST(Fbx, HasJointsWhereTheyAreAndAllTheirWeights) {
  for (const RigSubject& subject : rig_subjects()) {
    SCOPED_TRACE(subject.name);
    const Written written(subject);
    const FbxScene& scene = written.scene;
    const double size = subject.surface.positions.cwiseAbs().maxCoeff();
    std::map<std::string, int> joint_of;
    for (std::size_t k = 0; k < written.rig.names.size(); ++k) {
      joint_of[written.rig.names[k]] = static_cast<int>(k);
    }
    std::size_t joints = 0;
    for (const FbxRecord* model : scene.all("Model")) {
      if (model->text(2) != "LimbNode") continue;
      ++joints;
      const Eigen::Vector3d place = scene.frame(*model).translation();
      EXPECT_LT((place.transpose() - written.rig.joints.row(joint_of.at(name_of(*model)))).norm(),
                1e-5 * size);
    }
    EXPECT_EQ(joints, written.rig.names.size());
    SkinWeights weights(written.rig.weights.rows(), written.rig.weights.cols());
    for (const FbxRecord* cluster : scene.all("Deformer")) {
      if (cluster->text(2) != "Cluster") continue;
      const int joint = joint_of.at(name_of(*cluster));
      const std::vector<double> vertices = numbers_in(written.file, *cluster, "Indexes");
      const std::vector<double> shares = numbers_in(written.file, *cluster, "Weights");
      ASSERT_EQ(vertices.size(), shares.size());
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        weights.coeffRef(static_cast<Eigen::Index>(vertices[k]), joint) =
            static_cast<float>(shares[k]);
      }
      const Eigen::Affine3d bound = scene.matrix(*cluster->child("TransformLink"));
      EXPECT_LT((bound.translation().transpose() - written.rig.joints.row(joint)).norm(),
                1e-5 * size);
    }
    EXPECT_LT((weights - written.rig.weights).norm(), 1e-4);
  }
}

TEST(Fbx, GivesItsJointsBack) {
  const OwnFolder folder;
  for (const RigSubject& subject : rig_subjects()) {
    SCOPED_TRACE(subject.name);
    const Written written(subject);
    write_file(folder.path() / "rig.fbx", written.file.content);
    const Rig found = read_joints(folder.path() / "rig.fbx", {});
    ASSERT_EQ(found.joints.rows(), written.rig.joints.rows());
    const double size = subject.surface.positions.cwiseAbs().maxCoeff();
    std::map<std::string, Eigen::Index> joint_of;
    for (std::size_t k = 0; k < written.rig.names.size(); ++k) {
      joint_of[written.rig.names[k]] = static_cast<Eigen::Index>(k);
    }
    for (std::size_t k = 0; k < found.names.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const Eigen::Index joint = joint_of.at(found.names[k]);
      EXPECT_LT((found.joints.row(row) - written.rig.joints.row(joint)).norm(), 1e-5 * size);
      const int parent = found.parents[row];
      const int wanted = written.rig.parents[joint];
      ASSERT_EQ(parent < 0, wanted < 0);
      if (parent >= 0) {
        EXPECT_EQ(found.names[idx(parent)], written.rig.names[idx(wanted)]);
      }
    }
  }
}

/// Blender's armature is the node from which the topmost joint hangs.
TEST(Fbx, SaysWhereTheArmatureOfARigThatIsKeptStands) {
  const OwnFolder folder;
  const std::filesystem::path given = folder.path() / "bar.gltf";
  auto bar = nlohmann::json::parse(gltf_of({.helper_nodes = true}));
  nlohmann::json& nodes = bar["nodes"];
  nodes.push_back({{"name", "armature"}, {"children", {1}}, {"translation", {0, 5, 0}}});
  nodes.push_back({{"name", "z is up"},
                   {"children", {0, nodes.size() - 1}},
                   {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}});
  bar["scenes"][0]["nodes"] = {nodes.size() - 1};
  write_file(given, bar.dump());
  const auto edited =
      format_rig_into(given, *read_rig(given), {RigFormat::fbx, OldRig::kept, "rig", "test"});
  const FileBytes file{"kept.fbx", edited->bytes};
  const FbxRecord root = parse_fbx(file);
  const FbxScene scene(file, root);
  Eigen::Affine3d armature = Eigen::Affine3d::Identity();
  for (const FbxRecord* model : scene.all("Model")) {
    if (name_of(*model) == "joint 0") armature = scene.frame(*scene.parent(*model));
  }
  EXPECT_GT(armature.translation().norm(), 1);
  int clusters = 0;
  for (const FbxRecord* cluster : scene.all("Deformer")) {
    if (cluster->text(2) != "Cluster") continue;
    ++clusters;
    const Eigen::Affine3d said = scene.matrix(*cluster->child("TransformAssociateModel"));
    EXPECT_LT((said.matrix() - armature.matrix()).norm(), 1e-5);
  }
  EXPECT_EQ(clusters, 4);
}

TEST(Fbx, IsTheSameEachTime) {
  const RigSubject subject = rig_subjects().front();
  EXPECT_EQ(Written(subject).file.content, Written(subject).file.content);
}

}  // namespace
}  // namespace curveskel::fbx_laws
