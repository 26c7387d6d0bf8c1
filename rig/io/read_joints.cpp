#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read_rig.hpp>
#include "rig/dae/dae_joints.hpp"
#include "rig/fbx/fbx_joints.hpp"
#include "rig/io/rig_formats.hpp"
#include "rig/joints/parents_first.hpp"
#include "surface/read/dae_nodes.hpp"
#include "surface/read/dae_scene.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"
#include "surface/read/file_bytes.hpp"
#include "surface/read/formats.hpp"

namespace curveskel {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* joints_remedy =
    "give a glTF file with a skin, an FBX file with limbs, a COLLADA file with joints, the .json "
    "or "
    ".txt that `curveskel rig` writes, or RigNet's .txt";

struct GivenJoint {
  std::string name;
  int parent = -1;
  Eigen::RowVector3d position = Eigen::RowVector3d::Zero();
  std::string role;
};

std::vector<int> order_of(const std::vector<GivenJoint>& joints, const FileBytes& file) {
  std::vector<int> parents;
  parents.reserve(joints.size());
  for (const GivenJoint& joint : joints) parents.push_back(joint.parent);
  std::vector<int> order = parents_first(parents);
  if (order.size() == joints.size()) return order;
  std::vector<char> done(joints.size(), 0);
  for (const int joint : order) done[idx(joint)] = 1;
  const auto lost = std::find(done.begin(), done.end(), 0) - done.begin();
  file.fail("joint " + in_quotes(joints[idx(lost)].name) + ", which hangs from itself",
            "parents that lead to a root", "mend its parent");
}

Rig rig_of(const std::vector<GivenJoint>& joints, const FileBytes& file) {
  if (joints.empty()) file.fail("no joint", "one at least", joints_remedy);
  const std::vector<int> order = order_of(joints, file);
  std::vector<int> number(joints.size(), -1);
  Rig rig;
  rig.joints.resize(static_cast<Eigen::Index>(order.size()), 3);
  rig.parents.resize(rig.joints.rows());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const GivenJoint& joint = joints[idx(order[k])];
    number[idx(order[k])] = static_cast<int>(k);
    if (!joint.position.allFinite()) {
      file.fail("a position of joint " + in_quotes(joint.name) + " that is no number",
                "three finite numbers", "mend it");
    }
    const auto row = static_cast<Eigen::Index>(k);
    rig.joints.row(row) = joint.position;
    rig.parents[row] = joint.parent < 0 ? -1 : number[idx(joint.parent)];
    rig.names.push_back(joint.name);
    rig.roles.push_back(joint.role);
  }
  name_nameless(rig.names);
  return rig;
}

/// Every glTF file has the member.
bool says_gltf(const std::string& content) {
  const Json parsed = Json::parse(content, nullptr, false);
  return parsed.is_object() && parsed.contains("asset");
}

/// The parent that the entry of the joint `name` gives, one of so many joints; -1 = none.
int parent_in(const Json& entry, const std::string& name, std::size_t joints,
              const FileBytes& file) {
  const Json& parent = entry.at("parent");
  if (parent.is_null()) return -1;
  if (parent.is_number_unsigned()) {
    if (parent.get<std::uint64_t>() < joints) return parent.get<int>();
  } else if (parent.is_number_integer() && parent.get<std::int64_t>() == -1) {
    return -1;
  }
  file.fail("joint " + in_quotes(name) + " with parent " + parent.dump(),
            "the number of one of the " + std::to_string(joints) + " joints, counted from 0, or -1",
            "mend it");
}

Rig joints_of_json(const FileBytes& file) {
  std::vector<GivenJoint> joints;
  try {
    const Json parsed = Json::parse(file.content);
    if (parsed.is_object() && parsed.contains("nodes") && !parsed.contains("joints")) {
      file.fail("a skeleton's nodes", "joints", "give it as --skeleton instead");
    }
    const Json& entries = parsed.at("joints");
    for (const Json& entry : entries) {
      GivenJoint joint;
      joint.name = entry.at("name").get<std::string>();
      joint.parent = parent_in(entry, joint.name, entries.size(), file);
      for (int axis = 0; axis < 3; ++axis) {
        joint.position[axis] = entry.at("position").at(idx(axis)).get<double>();
      }
      joint.role = entry.value("role", "");
      joints.push_back(std::move(joint));
    }
  } catch (const Json::exception& error) {
    file.fail(std::string("JSON that has no such joints: ") + error.what(),
              "{\"joints\": [{\"name\": ..., \"parent\": number or -1, \"position\": [x, y, z]}]}",
              joints_remedy);
  }
  return rig_of(joints, file);
}

/// RigNet's: joints NAME X Y Z; root NAME; skin ...; hier PARENT CHILD.
Rig joints_of_text(const FileBytes& file) {
  std::vector<GivenJoint> joints;
  std::map<std::string, int> number;
  std::vector<std::pair<std::string, std::string>> links;
  std::istringstream lines(file.content);
  int at = 0;
  for (std::string line; std::getline(lines, line);) {
    ++at;
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "joints") {
      GivenJoint joint;
      words >> joint.name >> joint.position[0] >> joint.position[1] >> joint.position[2];
      if (!words) {
        file.fail("line " + std::to_string(at) + " " + in_quotes(line), "joints NAME X Y Z",
                  "mend the line");
      }
      if (!number.emplace(joint.name, static_cast<int>(joints.size())).second) {
        file.fail("two joints " + in_quotes(joint.name), "a name of its own for each",
                  "call one of them otherwise");
      }
      joints.push_back(std::move(joint));
    } else if (word == "hier") {
      auto& [parent, child] = links.emplace_back();
      words >> parent >> child;
    }
  }
  for (const auto& [parent, child] : links) {
    for (const std::string& name : {parent, child}) {
      if (number.count(name) == 0) {
        file.fail("a link with " + in_quotes(name), "joints of the file", "add the joint");
      }
    }
    GivenJoint& joint = joints[idx(number.at(child))];
    if (joint.parent >= 0) {
      file.fail("joint " + in_quotes(child) + " with the parents " +
                    in_quotes(joints[idx(joint.parent)].name) + " and " + in_quotes(parent),
                "one line hier for each joint", "leave out one of the two lines");
    }
    joint.parent = number.at(parent);
  }
  return rig_of(joints, file);
}

/// The limbs of the file where its nodes rest.
Rig joints_of_fbx(const FileBytes& file) {
  const FbxRecord root = parse_fbx(file);
  const FbxScene scene(file, root);
  std::vector<GivenJoint> joints;
  for (const FbxJoint& joint : fbx_joints(scene)) {
    joints.push_back({fbx_name(*joint.model), joint.parent,
                      scene.frame(*joint.model).translation().transpose(), ""});
  }
  return rig_of(joints, file);
}

/// The nodes of the file that say that they are joints, where the scene rests.
Rig joints_of_dae(const FileBytes& file, const Monitor& monitor) {
  const XmlElement root = parse_dae(file);
  const DaeDocument document(file, root);
  const std::vector<DaeNode> nodes = dae_nodes(document, monitor);
  std::vector<GivenJoint> joints;
  for (const DaeJoint& joint : dae_joints(nodes)) {
    const DaeNode& node = nodes[idx(joint.node)];
    const std::string_view id = node.element->attribute("id");
    const std::string name(node.element->attribute("name", id));
    joints.push_back({name, joint.parent, node.frame.translation().transpose(), ""});
  }
  return rig_of(joints, file);
}

}  // namespace

Rig read_joints(const std::filesystem::path& path, const Monitor& monitor) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  FileBytes file = read_file(path, monitor, "joints");
  if (file.content.starts_with(byte_order_mark)) file.content.erase(0, byte_order_mark.size());
  const std::size_t first = file.content.find_first_not_of(" \t\r\n");
  const bool is_text = first != std::string::npos && file.content[first] == '{';
  if (is_text && !says_gltf(file.content)) return joints_of_json(file);
  if (surface_format_of(file) == SurfaceFormat::dae) return joints_of_dae(file, monitor);
  const bool is_fbx = is_binary_fbx(file) || surface_format_of(file) == SurfaceFormat::fbx;
  if (is_fbx) return joints_of_fbx(file);
  if (!is_text && !file.content.starts_with("glTF")) return joints_of_text(file);
  std::optional<Rig> rig = read_gltf_rig(file, monitor);
  if (!rig) file.fail("no skin", "joints", joints_remedy);
  rig->weights = SkinWeights(0, rig->joints.rows());
  return std::move(*rig);
}

}  // namespace curveskel
