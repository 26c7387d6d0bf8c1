// Laws of rigs in formats of other programs: what goes in is what they hold, and joints read back.
#include <curveskel/rig_files.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read_rig.hpp>
#include "rig/joints/bone_axes.hpp"
#include "surface/read/zip_archive.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/random_rigs.hpp"

namespace curveskel::rig_formats_laws {
namespace {

using Json = nlohmann::json;

std::string formatted(const Rig& rig, RigFormat format, const VrmMeta& vrm = {}) {
  return format_rig(torus_surface(), rig, format, "a torus", "a test", vrm);
}

Rig random_rig_of(const WrittenCase& one) {
  return random_rig(torus_surface().positions.rows(), one.joints, one.name);
}

/// By name; blanks are `_` in formats that part words by them.
void expect_same_joints(const Rig& found, const Rig& rig, bool by_words, double off = 0) {
  ASSERT_EQ(found.joints.rows(), rig.joints.rows());
  const auto name_of = [&](const Rig& of, int joint) {
    if (joint < 0) return std::string();
    std::string name = of.names[idx(joint)];
    if (by_words) std::replace(name.begin(), name.end(), ' ', '_');
    return name;
  };
  std::map<std::string, int> number;
  for (int joint = 0; joint < found.joints.rows(); ++joint) number[name_of(found, joint)] = joint;
  for (int joint = 0; joint < rig.joints.rows(); ++joint) {
    const auto same = number.find(name_of(rig, joint));
    ASSERT_NE(same, number.end()) << rig.names[idx(joint)];
    EXPECT_LE((found.joints.row(same->second) - rig.joints.row(joint)).norm(), off);
    EXPECT_EQ(name_of(found, found.parents[same->second]), name_of(rig, rig.parents[joint]));
    EXPECT_LT(found.parents[same->second], same->second);
  }
}

class RigFormats : public testing::Test {
 protected:
  [[nodiscard]] std::string refusal(const std::string& name, const std::string& content) {
    try {
      (void)read_joints(folder_.write(name, content), {});
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      return error.what();
    }
    return "";
  }
  OwnFolder folder_;
};

TEST_F(RigFormats, JointsReadBackFromJsonTextAndGltf) {
  for (const WrittenCase& one : written_cases()) {
    const Rig rig = random_rig_of(one);
    expect_same_joints(read_joints(folder_.write("rig.json", formatted(rig, RigFormat::json)), {}),
                       rig, false);
    expect_same_joints(read_joints(folder_.write("rig.txt", formatted(rig, RigFormat::txt)), {}),
                       rig, true);
    const Rig from_gltf =
        read_joints(folder_.write("rig.gltf", formatted(rig, RigFormat::gltf)), {});
    expect_same_joints(from_gltf, rig, false, 1e-5);
    EXPECT_EQ(from_gltf.weights.rows(), 0);
  }
}

TEST_F(RigFormats, JointsMayComeInAnyOrder) {
  const std::string children_first =
      R"({"joints": [{"name": "c", "parent": 1, "position": [2, 0, 0]},
                     {"name": "b", "parent": 2, "position": [1, 0, 0], "role": "spine"},
                     {"name": "a", "parent": -1, "position": [0, 0, 0]},
                     {"name": "d", "parent": null, "position": [9, 0, 0]}]})";
  const Rig rig = read_joints(folder_.write("joints.json", children_first), {});
  EXPECT_EQ(rig.names, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(rig.parents, Eigen::Vector4i(-1, 0, 1, -1));
  EXPECT_EQ(rig.joints(2, 0), 2);
  EXPECT_EQ(rig.roles[1], "spine");
}

TEST_F(RigFormats, WrongJointsAreRefusedByName) {
  const auto joint = [](const std::string& parent, const std::string& place) {
    return R"({"joints": [{"name": "a", "parent": )" + parent + R"(, "position": )" + place + "}]}";
  };
  EXPECT_NE(refusal("a.json", joint("0", "[0, 0, 0]")).find("hangs from itself"),
            std::string::npos);
  EXPECT_NE(refusal("a.json", joint("7", "[0, 0, 0]")).find("parent 7"), std::string::npos);
  EXPECT_NE(refusal("a.json", joint("-1", "[0, 0]")).find("position"), std::string::npos);
  EXPECT_NE(refusal("a.json", R"({"joints": []})").find("no joint"), std::string::npos);
  EXPECT_NE(refusal("a.json", "{\"joints\": ").find("JSON"), std::string::npos);
  EXPECT_NE(refusal("a.txt", "joints a 0 0 0\njoints a 1 0 0\n").find("two joints"),
            std::string::npos);
  EXPECT_NE(refusal("a.txt", "joints a 0 0\n").find("line 1"), std::string::npos);
  EXPECT_NE(refusal("a.txt", "joints a 0 0 0\nhier a b\n").find("\"b\""), std::string::npos);
  EXPECT_NE(refusal("a.txt", "no rig at all").find("no joint"), std::string::npos);
}

/// None of these is a number of a joint, though it may become one when it is rounded or cut.
TEST_F(RigFormats, ParentsThatAreNoNumbersOfJointsAreRefused) {
  for (const char* const parent :
       {"1.9", "0.0", "1e+300", "-2", "2", "4294967295", "18446744073709551615", "true", "\"a\""}) {
    const std::string found =
        refusal("a.json", std::string(R"({"joints": [{"name": "a", "parent": -1, "position":)") +
                              R"([0, 0, 0]}, {"name": "b", "parent": )" + parent +
                              R"(, "position": [1, 0, 0]}]})");
    EXPECT_NE(found.find("joint \"b\" with parent " + std::string(parent)), std::string::npos)
        << parent << ": " << found;
  }
}

TEST_F(RigFormats, AJointOfTextHasOneParent) {
  const std::string joints = "joints a 0 0 0\njoints b 1 0 0\njoints c 2 0 0\nhier a c\n";
  EXPECT_EQ(refusal("a.txt", joints), "");
  const std::string found = refusal("a.txt", joints + "hier b c\n");
  EXPECT_NE(found.find("joint \"c\" with the parents \"a\" and \"b\""), std::string::npos) << found;
}

TEST_F(RigFormats, JointsMayBeginWithAByteOrderMark) {
  const Rig rig = random_rig_of(written_cases()[1]);
  for (const auto& [name, format] :
       {std::pair{"rig.json", RigFormat::json}, std::pair{"rig.txt", RigFormat::txt}}) {
    const std::string marked = "\xEF\xBB\xBF" + formatted(rig, format);
    expect_same_joints(read_joints(folder_.write(name, marked), {}), rig, true);
  }
}

TEST_F(RigFormats, RigsThatNoFileHoldsAreRefused) {
  const Eigen::Index vertices = torus_surface().positions.rows();
  Rig without_joints;
  without_joints.joints.resize(0, 3);
  without_joints.weights.resize(vertices, 0);
  Rig negative = random_rig_of(written_cases()[1]);
  negative.weights.coeffRef(5, 1) = -0.5F;
  const auto refused = [](const Rig& rig, RigFormat format, const std::string& words) {
    try {
      (void)formatted(rig, format);
      ADD_FAILURE() << "no error that says " << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  for (const auto& format : rig_formats) {
    SCOPED_TRACE(format.name);
    refused(without_joints, format.value, "no joint");
    refused(negative, format.value, "a weight below 0");
  }
}

TEST_F(RigFormats, RolesOfJsonAreUtf8) {
  Rig rig = random_rig_of(written_cases()[1]);
  rig.roles = {"\xFF\xFE", "spine"};
  const Json json = Json::parse(formatted(rig, RigFormat::json));
  EXPECT_NE(json["joints"][0]["role"], "");
  EXPECT_EQ(json["joints"][1]["role"], "spine");
}

TEST_F(RigFormats, JsonHasFourWeightsOfSumOneForEachVertex) {
  for (const WrittenCase& one : written_cases()) {
    const Rig rig = random_rig_of(one);
    const Json json = Json::parse(formatted(rig, RigFormat::json));
    EXPECT_EQ(json["format"], "curveskel-rig");
    EXPECT_EQ(json["vertices"], rig.weights.rows());
    const Json& joints = json["weights"]["joints"];
    const Json& values = json["weights"]["values"];
    ASSERT_EQ(joints.size(), idx(rig.weights.rows()));
    ASSERT_EQ(values.size(), joints.size());
    for (std::size_t vertex = 0; vertex < joints.size(); ++vertex) {
      ASSERT_EQ(joints[vertex].size(), 4U);
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto value = values[vertex][k].get<float>();
        sum += static_cast<double>(value);
        if (value == 0) continue;
        const int number = joints[vertex][k].get<int>();
        EXPECT_NEAR(value, rig.weights.coeff(static_cast<Eigen::Index>(vertex), number), 1e-6F);
      }
      EXPECT_NEAR(sum, 1, 1e-6);
    }
  }
}

TEST_F(RigFormats, JsonHasTheAxesOfBonesAndSaysWhatIsAnEnd) {
  for (const WrittenCase& one : written_cases()) {
    const Rig rig = random_rig_of(one);
    const Json json = Json::parse(formatted(rig, RigFormat::json));
    const auto axes = bone_axes(rig);
    for (int joint = 0; joint < static_cast<int>(axes.size()); ++joint) {
      const Json& line = json["joints"][idx(joint)];
      const Eigen::Vector3d axis(line["axis"][0], line["axis"][1], line["axis"][2]);
      EXPECT_LT((axis - axes[idx(joint)] * Eigen::Vector3d::UnitY()).norm(), 2e-6);
      const bool has_children = (rig.parents.array() == joint).any();
      const bool moves = Eigen::MatrixXf(rig.weights).col(joint).any();
      EXPECT_EQ(line.value("end", false), !has_children && !moves);
    }
  }
}

TEST_F(RigFormats, RignetsTextHasAWeightForWhatMoves) {
  const Rig rig = random_rig_of(written_cases()[3]);
  std::istringstream lines(formatted(rig, RigFormat::txt));
  std::map<std::string, int> counts;
  for (std::string line; std::getline(lines, line);) {
    const std::string word = line.substr(0, line.find(' '));
    ++counts[word];
    if (word != "skin") continue;
    std::istringstream words(line.substr(5));
    Eigen::Index vertex = -1;
    words >> vertex;
    float sum = 0;
    std::string name;
    for (float weight = 0; words >> name >> weight;) sum += weight;
    EXPECT_EQ(vertex, counts[word] - 1);
    EXPECT_NEAR(sum, 1, 1e-5F);
  }
  EXPECT_EQ(counts["joints"], rig.joints.rows());
  EXPECT_EQ(counts["root"], 1);
  EXPECT_EQ(counts["hier"], rig.joints.rows() - 1);
  EXPECT_EQ(counts["skin"], rig.weights.rows());
}

/// Offsets from the root on lead to the joints.
TEST_F(RigFormats, BvhHasEveryJointAtItsPlace) {
  for (const WrittenCase& one : written_cases()) {
    const Rig rig = random_rig_of(one);
    std::istringstream words(formatted(rig, RigFormat::bvh));
    std::map<std::string, Eigen::RowVector3d> places;
    std::vector<Eigen::RowVector3d> open;
    std::string name;
    int channels = 0;
    for (std::string word; words >> word && word != "Time:";) {
      if (word == "ROOT" || word == "JOINT") words >> name;
      if (word == "Site") name.clear();
      if (word == "{") open.push_back(open.empty() ? Eigen::RowVector3d::Zero() : open.back());
      if (word == "}") open.pop_back();
      if (word == "CHANNELS") {
        int more = 0;
        words >> more;
        channels += more;
      }
      if (word != "OFFSET") continue;
      Eigen::RowVector3d by;
      words >> by[0] >> by[1] >> by[2];
      open.back() += by;
      if (!name.empty()) places[name] = open.back();
    }
    EXPECT_TRUE(open.empty());
    ASSERT_EQ(places.size(), idx(rig.joints.rows()));
    for (int joint = 0; joint < rig.joints.rows(); ++joint) {
      std::string written = rig.names[idx(joint)];
      std::replace(written.begin(), written.end(), ' ', '_');
      ASSERT_EQ(places.count(written), 1U) << written;
      EXPECT_LT((places[written] - rig.joints.row(joint)).norm(), 1e-9);
    }
    double frame_time = 0;
    words >> frame_time;
    std::vector<double> still;
    for (double value = 0; words >> value;) still.push_back(value);
    EXPECT_EQ(still.size(), idx(channels));
    EXPECT_EQ(still[0], rig.joints(0, 0)) << "a root's position is absolute";
  }
}

/// Assimp and three.js refuse a second one.
TEST_F(RigFormats, BvhHasOneRoot) {
  for (const WrittenCase& one : written_cases()) {
    Rig rig = random_rig_of(one);
    for (const int roots : {1, 2, 3}) {
      for (int joint = 0; joint < std::min<int>(roots, static_cast<int>(rig.parents.size()));
           ++joint) {
        rig.parents[joint] = -1;
      }
      const std::string text = formatted(rig, RigFormat::bvh);
      const std::size_t first = text.find("ROOT ");
      EXPECT_EQ(text.find("ROOT ", first + 1), std::string::npos);
      int depth = 0;
      for (std::size_t at = first; at < text.find("MOTION"); ++at) {
        depth += text[at] == '{' ? 1 : text[at] == '}' ? -1 : 0;
        const bool ends_early = text[at] == '}' && depth == 0 && text[at + 2] != 'M';
        EXPECT_FALSE(ends_early);
      }
    }
  }
}

/// The text between the brackets behind `key`.
std::string list_after(const std::string& text, const std::string& key) {
  const std::size_t begin = text.find(key + " = [");
  EXPECT_NE(begin, std::string::npos) << key;
  if (begin == std::string::npos) return "";
  const std::size_t first = begin + key.size() + 4;
  return text.substr(first, text.find(']', first) - first);
}

/// Those in quotes, without the backslashes before quotes.
std::vector<std::string> words_in(const std::string& list) {
  std::vector<std::string> words;
  bool is_open = false;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list[k] == '"') {
      is_open = !is_open;
      if (is_open) words.emplace_back();
    } else if (is_open) {
      words.back() += list[k] == '\\' ? list[++k] : list[k];
    }
  }
  return words;
}

TEST_F(RigFormats, UsdHasPathsFramesAndWeights) {
  for (const WrittenCase& one : written_cases()) {
    const Rig rig = random_rig_of(one);
    const std::string text = formatted(rig, RigFormat::usda);
    EXPECT_EQ(text.rfind("#usda 1.0\n", 0), 0U);
    for (const auto& [opening, closing] : {std::pair{'{', '}'}, {'(', ')'}, {'[', ']'}}) {
      EXPECT_EQ(std::count(text.begin(), text.end(), opening),
                std::count(text.begin(), text.end(), closing));
    }
    const std::vector<std::string> all_paths = words_in(list_after(text, "token[] joints"));
    const std::vector<std::string> names = words_in(list_after(text, "token[] jointNames"));
    ASSERT_EQ(all_paths.size(), idx(rig.joints.rows()));
    ASSERT_EQ(names.size(), all_paths.size());
    std::vector<std::string> paths;  // in the rig's order
    for (const std::string& name : rig.names) {
      const auto place = std::find(names.begin(), names.end(), name);
      ASSERT_NE(place, names.end()) << name;
      paths.push_back(all_paths[static_cast<std::size_t>(place - names.begin())]);
    }
    EXPECT_EQ(std::set<std::string>(paths.begin(), paths.end()).size(), paths.size());
    for (int joint = 0; joint < rig.joints.rows(); ++joint) {
      const std::string& path = paths[idx(joint)];
      const std::size_t slash = path.rfind('/');
      const std::string parent = slash == std::string::npos ? "" : path.substr(0, slash);
      EXPECT_EQ(parent, rig.parents[joint] < 0 ? "" : paths[idx(rig.parents[joint])]);
      for (const char c : path.substr(slash + 1)) {
        EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') << path;
      }
    }
    const auto numbers = [&](const std::string& key) {
      const std::string list = list_after(text, key);
      return list.empty() ? 0 : 1 + std::count(list.begin(), list.end(), ',');
    };
    EXPECT_EQ(numbers("bindTransforms"), 16 * rig.joints.rows());
    EXPECT_EQ(numbers("restTransforms"), 16 * rig.joints.rows());
    EXPECT_EQ(numbers("points"), 3 * rig.weights.rows());
    Eigen::Index most = 1;
    for (Eigen::Index row = 0; row < rig.weights.rows(); ++row) {
      most = std::max<Eigen::Index>(most, rig.weights.row(row).nonZeros());
    }
    EXPECT_NE(text.find("elementSize = " + std::to_string(most) + "\n"), std::string::npos);
    EXPECT_EQ(numbers("skel:jointIndices"), most * rig.weights.rows());
    EXPECT_EQ(numbers("skel:jointWeights"), most * rig.weights.rows());
  }
}

TEST_F(RigFormats, NumpysArchiveHasTheNumbersAndNoTime) {
  const Rig rig = random_rig_of(written_cases()[2]);
  const std::string bytes = formatted(rig, RigFormat::npz);
  EXPECT_EQ(bytes, formatted(rig, RigFormat::npz));
  const FileBytes file{"rig.npz", bytes};
  const ZipArchive archive(file);
  EXPECT_EQ(archive.names().size(), 6U);
  const auto numbers = [&](const std::string& name, const std::string& type) {
    const std::string array = archive.unpack(name, {}).content;
    EXPECT_EQ(array.substr(0, 6), "\x93NUMPY");
    std::uint16_t head = 0;
    std::memcpy(&head, array.data() + 8, sizeof head);
    EXPECT_EQ((10 + head) % 64, 0);
    EXPECT_NE(array.find("'descr': '" + type + "'"), std::string::npos) << name;
    return array.substr(10U + head);
  };
  const std::string joints = numbers("joints.npy", "<f8");
  ASSERT_EQ(joints.size(), 24 * idx(rig.joints.rows()));
  double second = 0;
  std::memcpy(&second, joints.data() + 8, sizeof second);
  EXPECT_EQ(second, rig.joints(0, 1));
  EXPECT_EQ(numbers("parents.npy", "<i4").size(), 4 * idx(rig.joints.rows()));
  EXPECT_EQ(numbers("weights.npy", "<f4").size(), 16 * idx(rig.weights.rows()));
  EXPECT_EQ(numbers("weight_joints.npy", "<i4").size(), 16 * idx(rig.weights.rows()));
  // "Höhle "骨" 🦴 0" has 13 code points of four bytes.
  EXPECT_EQ(numbers("names.npy", "<U13").size(), 52 * idx(rig.joints.rows()));
}

Rig human_rig() {
  const auto joints = static_cast<int>(required_human_roles.size());
  Rig rig = random_rig(torus_surface().positions.rows(), joints + 2, "j");
  rig.roles.assign(rig.names.size(), "");
  for (std::size_t k = 0; k < required_human_roles.size(); ++k) {
    rig.roles[k + 1] = required_human_roles[k];
  }
  return rig;
}

TEST_F(RigFormats, VrmSaysWhichNodeIsWhichBone) {
  const Rig rig = human_rig();
  const VrmMeta meta{"Ann", "a person", "https://vrm.dev/licenses/1.0/"};
  const std::string glb = formatted(rig, RigFormat::vrm, meta);
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 8, sizeof length);
  EXPECT_EQ(length, glb.size());
  std::memcpy(&length, glb.data() + 12, sizeof length);
  const Json json = Json::parse(glb.substr(20, length));
  const Json& vrm = json["extensions"]["VRMC_vrm"];
  EXPECT_EQ(json["extensionsUsed"], Json::array({"VRMC_vrm"}));
  EXPECT_EQ(vrm["specVersion"], "1.0");
  EXPECT_EQ(vrm["meta"]["name"], "Ann");
  EXPECT_EQ(vrm["meta"]["authors"], Json::array({"a person"}));
  EXPECT_EQ(vrm["meta"]["licenseUrl"], meta.licence_url);
  const Json& bones = vrm["humanoid"]["humanBones"];
  EXPECT_EQ(bones.size(), required_human_roles.size());
  for (std::size_t joint = 0; joint < rig.roles.size(); ++joint) {
    if (rig.roles[joint].empty()) continue;
    const int node = bones[rig.roles[joint]]["node"];
    EXPECT_EQ(json["nodes"][idx(node)]["name"], rig.names[joint]);
  }
  const auto same = read_rig(folder_.write("rig.vrm", glb), {});
  ASSERT_TRUE(same);
  EXPECT_EQ(same->joints.rows(), rig.joints.rows());
}

TEST_F(RigFormats, VrmWantsAHumanAndItsAuthor) {
  const VrmMeta meta{"Ann", "a person", "https://vrm.dev/licenses/1.0/"};
  Rig rig = human_rig();
  const std::string address = meta.licence_url;
  for (const VrmMeta& lacking :
       {VrmMeta{"", "b", address}, VrmMeta{"a", "", address}, VrmMeta{"a", "b", ""}}) {
    EXPECT_THROW((void)formatted(rig, RigFormat::vrm, lacking), Error);
  }
  for (const std::string text : {"foo", "CC-BY-4.0", "https://", "https:///a", "http://a b",
                                 "vrm.dev/licenses/1.0/", "ftp://vrm.dev/licenses"}) {
    try {
      (void)formatted(rig, RigFormat::vrm, {"a", "b", text});
      ADD_FAILURE() << text << " for a licence";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("'" + text + "'"), std::string::npos);
      EXPECT_EQ(error.fault(), Fault::usage);
    }
  }
  rig.roles[3] = "";  // the head
  try {
    (void)formatted(rig, RigFormat::vrm, meta);
    FAIL() << "a human without a head";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no head"), std::string::npos) << error.what();
  }
  rig.roles.clear();
  EXPECT_THROW((void)formatted(rig, RigFormat::vrm, meta), Error);
}

}  // namespace
}  // namespace curveskel::rig_formats_laws
