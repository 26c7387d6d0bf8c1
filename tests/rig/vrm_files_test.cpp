// Laws of VRM files whose joints are kept: they stay the VRM that they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/role_names.hpp>
#include "rig/gltf/gltf_document.hpp"
#include "surface/read/file_bytes.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/plan_subjects.hpp"

namespace curveskel::vrm_file_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const VrmMeta meta{"Ann", "a person", "https://vrm.dev/licenses/1.0/"};

std::string read_all(const fs::path& file) { return read_file(file, {}).content; }

struct Parted {
  Json json;
  std::string rest;
};

Parted parted(const std::string& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, sizeof length);
  return {Json::parse(glb.substr(20, length)), glb.substr(20 + length)};
}

std::map<std::string, std::string> roles_by_joint(const Rig& rig) {
  std::map<std::string, std::string> roles;
  for (std::size_t joint = 0; joint < rig.roles.size(); ++joint) {
    roles[rig.names[joint]] = rig.roles[joint];
  }
  return roles;
}

class VrmFiles : public testing::Test {
 protected:
  /// A human as VRM 1.0, its JSON changed.
  fs::path human_file(const std::function<void(Json&)>& change = {}) {
    static const RigSubject subject = human();
    static const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan);
    name_roles(rig, plan, NameStyle::unreal);
    roles_ = roles_by_joint(rig);
    Parted file = parted(format_rig(subject.surface, rig, RigFormat::vrm, "ann", "a test", meta));
    if (change) change(file.json);
    return folder_.write("human.vrm", glb_head(file.json.dump(), file.rest.size()) + file.rest);
  }

  [[nodiscard]] static Json kept(const fs::path& file, const Rig& rig, const VrmMeta& given) {
    return parted(format_rig_into(file, rig, {RigFormat::vrm, OldRig::kept, "", "", given})->bytes)
        .json;
  }

  OwnFolder folder_;
  std::map<std::string, std::string> roles_;
};

void make_version_0(Json& json) {
  Json bones = Json::array();
  for (const auto& [role, bone] :
       json["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"].items()) {
    bones.push_back({{"bone", role}, {"node", bone["node"]}});
  }
  json["extensions"] = {
      {"VRM", {{"humanoid", {{"humanBones", bones}}}, {"meta", {{"title", "A"}}}}}};
}

TEST_F(VrmFiles, SayTheRolesOfTheirJoints) {
  EXPECT_EQ(roles_by_joint(*read_rig(human_file())), roles_);
  EXPECT_EQ(roles_by_joint(*read_rig(human_file(make_version_0))), roles_);
  EXPECT_EQ(roles_by_joint(read_joints(human_file())), roles_);
  EXPECT_TRUE(read_rig(human_file([](Json& json) { json.erase("extensions"); }))->roles.empty());
}

TEST_F(VrmFiles, OfVersion0CountTheJointsOfThumbsAsOfFingers) {
  const fs::path file = human_file([](Json& json) {
    make_version_0(json);
    Json& bones = json["extensions"]["VRM"]["humanoid"]["humanBones"];
    bones[0]["bone"] = "leftThumbProximal";
    bones[1]["bone"] = "rightThumbIntermediate";
    bones[2]["bone"] = "rightThumbDistal";
  });
  const std::vector<std::string> roles = read_rig(file)->roles;
  for (const char* const role : {"leftThumbMetacarpal", "rightThumbProximal", "rightThumbDistal"}) {
    EXPECT_EQ(std::count(roles.begin(), roles.end(), role), 1) << role;
  }
}

TEST_F(VrmFiles, SayTheirTexts) {
  const auto said = read_vrm(human_file());
  ASSERT_TRUE(said);
  EXPECT_FALSE(said->is_version_0);
  EXPECT_EQ(said->meta.name, meta.name);
  EXPECT_EQ(said->meta.author, meta.author);
  EXPECT_EQ(said->meta.licence_url, meta.licence_url);
  EXPECT_TRUE(read_vrm(human_file(make_version_0))->is_version_0);
  EXPECT_FALSE(read_vrm(human_file([](Json& json) { json.erase("extensions"); })));
  EXPECT_FALSE(read_vrm(folder_.write("a.off", "OFF\n0 0 0\n")));
}

TEST_F(VrmFiles, ThatKeepTheirJointsStayWhatTheyAre) {
  const auto add_others = [](Json& json) {
    json["extensions"]["VRMC_vrm"]["expressions"] = {{"preset", {{"happy", Json::object()}}}};
    json["extensions"]["VRMC_vrm"]["meta"]["authors"].push_back("another");
    json["extensions"]["VRMC_springBone"] = {{"specVersion", "1.0"}};
  };
  for (const auto& change : {std::function<void(Json&)>(add_others), {make_version_0}}) {
    const fs::path file = human_file(change);
    const Json before = parted(read_all(file)).json;
    const Json after = kept(file, *read_rig(file), {});
    EXPECT_EQ(after["extensions"], before["extensions"]);
    EXPECT_EQ(after["nodes"], before["nodes"]);
  }
  const fs::path file = human_file(add_others);
  Json wanted = parted(read_all(file)).json["extensions"];
  wanted["VRMC_vrm"]["meta"]["name"] = "Bo";
  wanted["VRMC_vrm"]["meta"]["authors"][0] = "B";
  EXPECT_EQ(kept(file, *read_rig(file), {"Bo", "B", ""})["extensions"], wanted);
  EXPECT_THROW((void)kept(file, *read_rig(file), {"Bo", "B", "free"}), Error);
}

/// VRM has no bone "tail", and one joint for each that it has.
TEST_F(VrmFiles, HaveTheBonesOfVrmAloneEachOnce) {
  const auto bones_of = [](const Json& json) {  // in any order
    const Json& bones = json["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"];
    return nlohmann::json::parse(bones.dump());
  };
  const nlohmann::json before = bones_of(parted(read_all(human_file())).json);
  const fs::path file = human_file([](Json& json) { json.erase("extensions"); });
  Rig rig = *read_rig(file);
  rig.roles = roles_by_name(rig);
  const auto last_without = std::find(rig.roles.rbegin(), rig.roles.rend(), "");
  ASSERT_NE(last_without, rig.roles.rend());
  for (const char* const role : {"tail", "hips", "leftTail", "left"}) {
    *last_without = role;
    EXPECT_EQ(bones_of(kept(file, rig, meta)), before) << role;
  }
}

TEST_F(VrmFiles, AreMadeOfJointsWhoseRolesAreKnown) {
  const Json vrm = parted(read_all(human_file())).json["extensions"];
  const fs::path file = human_file([](Json& json) { json.erase("extensions"); });
  Rig rig = *read_rig(file);
  EXPECT_THROW((void)kept(file, rig, meta), Error);
  rig.roles = roles_by_name(rig);
  EXPECT_EQ(nlohmann::json(kept(file, rig, meta)["extensions"]), nlohmann::json(vrm));
  EXPECT_THROW((void)kept(file, rig, {}), Error);
}

/// An extension that is called so and is no VRM counts for nothing.
TEST_F(VrmFiles, ThatAreBrokenAreNone) {
  for (const Json& broken : {Json(3), Json("x"), Json::array(), Json(nullptr)}) {
    const fs::path file = human_file([&](Json& json) {
      json["extensions"] = {{"VRMC_vrm", broken}};
    });
    EXPECT_FALSE(read_vrm(file));
    EXPECT_TRUE(read_rig(file)->roles.empty());
    Rig rig = *read_rig(file);
    rig.roles = roles_by_name(rig);
    EXPECT_EQ(kept(file, rig, meta)["extensions"]["VRMC_vrm"]["meta"]["name"], "Ann");
  }
  for (const Json& broken : {Json(3), Json("x"), Json::array({1, "b"}), Json{{"hips", 1}}}) {
    for (const bool is_old : {false, true}) {
      const fs::path file = human_file([&](Json& json) {
        json["extensions"] = {{is_old ? "VRM" : "VRMC_vrm",
                               {{"meta", broken}, {"humanoid", {{"humanBones", broken}}}}}};
      });
      EXPECT_TRUE(read_vrm(file));
      EXPECT_TRUE(read_rig(file)->roles.empty());
      EXPECT_FALSE(kept(file, *read_rig(file), {}).empty());
    }
  }
}

}  // namespace
}  // namespace curveskel::vrm_file_laws
