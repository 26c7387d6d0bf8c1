#include "surface/read/dae_scene.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

#include "surface/read/bound_joints.hpp"
#include "surface/read/dae_morph.hpp"
#include "surface/read/dae_nodes.hpp"
#include "surface/read/dae_skin.hpp"

namespace curveskel {
namespace {

constexpr int deepest_node = 500;  // chains of joints nest

const XmlElement* asset_entry(const DaeDocument& document, std::string_view name) {
  const XmlElement* asset = document.root().child("asset");
  return asset == nullptr ? nullptr : asset->child(name);
}

/// As the file has it, without blanks; empty where it does not say.
std::string up_axis(const DaeDocument& document) {
  const XmlElement* entry = asset_entry(document, "up_axis");
  std::string text = entry == nullptr ? "" : entry->text;
  std::erase_if(text, [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); });
  return text;
}

double metres_per_unit(const DaeDocument& document) {
  const XmlElement* unit = asset_entry(document, "unit");
  if (unit == nullptr) return 1;
  const std::string text(unit->attribute("meter"));
  double metres = 0;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), metres);
  return error == std::errc() && metres > 0 && std::isfinite(metres) ? metres : 1;
}

class DaeSceneReader {
 public:
  DaeSceneReader(const DaeDocument& document, const Monitor& monitor,
                 const std::function<void(const DaeShownMesh&)>& take)
      : document_(document),
        monitor_(monitor),
        take_(take),
        loose_morphs_(loose_dae_morphs(document)) {}

  /// True if joints bend meshes away from where they were bound.
  bool read(bool as_bound) {
    placed_ = dae_nodes(document_, monitor_);
    if (placed_.empty()) {
      for (const XmlElement* library : document_.root().all("library_geometries")) {
        for (const XmlElement* geometry : library->all("geometry")) {
          const DaeMesh& mesh = mesh_of(*geometry);
          const std::string_view name = geometry->attribute("name");
          take_({nullptr, mesh, Eigen::Affine3d::Identity(), {}, nullptr, name, mesh});
        }
      }
      return false;
    }
    for (std::size_t k = 0; k < placed_.size(); ++k) place_of_.emplace(placed_[k].element, k);
    bent_ = bent_figures();
    const bool is_posed = !bent_.empty();
    if (!as_bound) bent_.clear();
    for (const DaeNode& node : placed_) {
      for (const XmlElement& child : node.element->children) {
        const bool is_mesh = child.name == "instance_geometry";
        if (is_mesh || child.name == "instance_controller") take_shown(child, node);
      }
    }
    return is_posed;
  }

 private:
  const DaeMesh& mesh_of(const XmlElement& geometry) {
    const auto [entry, is_new] = mesh_of_.try_emplace(&geometry);
    if (is_new) entry->second = read_dae_mesh(document_, geometry);
    return entry->second;
  }

  /// The base of a morph by the weights that the file gives.
  const DaeMesh& morphed(const XmlElement& morph, const DaeMesh& base) {
    if (!is_morphed(document_, morph)) return base;
    const auto [entry, is_new] = morphed_.try_emplace(&morph, base);
    if (!is_new) return entry->second;
    for (const DaeShape& shape : dae_shapes(document_, morph, base)) {
      entry->second.polygons.positions += shape.weight * shape.moves;
    }
    return entry->second;
  }

  /// The things that an instance puts together.
  struct Controlled {
    const XmlElement* geometry = nullptr;
    const XmlElement* skin = nullptr;
    const XmlElement* morph = nullptr;
  };

  [[nodiscard]] Controlled controlled(const XmlElement& instance) const {
    constexpr int deepest_controller = 10;
    Controlled found;
    const XmlElement* target = &document_.referred(instance, "url");
    for (int depth = 0; target->name == "controller"; ++depth) {
      const XmlElement* inner = target->child("skin");
      if (inner != nullptr) {
        found.skin = inner;
      } else {
        inner = target->child("morph");
        found.morph = inner;
      }
      if (inner == nullptr || depth > deepest_controller) {
        document_.fail(*target, "a controller that is neither skin nor morph of a mesh", "one");
      }
      target = &document_.referred(*inner, "source");
    }
    found.geometry = target;
    const auto loose = loose_morphs_.find(target);
    if (found.morph == nullptr && loose != loose_morphs_.end()) found.morph = loose->second;
    return found;
  }

  const DaeSkin& skin_of(const XmlElement& skin, const DaeMesh& mesh) {
    const auto [entry, is_new] = skin_of_.try_emplace(&skin);
    if (is_new) {
      entry->second =
          read_dae_skin(document_, skin, static_cast<std::size_t>(mesh.polygons.positions.rows()));
    }
    return entry->second;
  }

  void take_shown(const XmlElement& instance, const DaeNode& node) {
    const auto [geometry, skin, morph] = controlled(instance);
    const std::string_view name = node.element->attribute("name");
    const DaeMesh& base = mesh_of(*geometry);
    const DaeMesh& mesh = morph == nullptr ? base : morphed(*morph, base);
    const auto number = static_cast<int>(&node - placed_.data());
    if (skin == nullptr) {
      return take_({&instance, mesh, frame_of(node), {}, morph, name, base, number});
    }
    const DaeSkin& read = skin_of(*skin, base);
    if (const auto move = move_of(instance, read)) {
      return take_({&instance, mesh, *move * read.bind_shape, {}, morph, name, base, number});
    }
    MeshSkin posed{{}, read.weights};
    for (std::size_t j = 0; j < read.joints.size(); ++j) {
      posed.joints.push_back(frame_of(joint_of(instance, read, j)) * read.inverse_bind[j] *
                             read.bind_shape);
    }
    take_({&instance, mesh, frame_of(node) * read.bind_shape, std::move(posed), morph, name, base,
           number});
  }

  /// The joints of these, by elements.
  [[nodiscard]] std::unordered_map<SceneNode, MovedJoint> bent_figures() {
    BoundJoints joints;
    for (const DaeNode& node : placed_) {
      for (const XmlElement* instance : node.element->all("instance_controller")) {
        const Controlled found = controlled(*instance);
        if (found.skin == nullptr) continue;
        add_joints(*instance, skin_of(*found.skin, mesh_of(*found.geometry)), joints);
      }
    }
    for (const DaeNode& node : placed_) {
      if (joints.contains(node.element)) joints.join(node.element, top_of_chain(node, joints));
    }
    return joints.bent_figures();
  }

  void add_joints(const XmlElement& instance, const DaeSkin& skin, BoundJoints& joints) const {
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      if (!is_invertible(skin.inverse_bind[j])) continue;
      const DaeNode& joint = joint_of(instance, skin, j);
      const bool moves_vertices =
          std::ranges::any_of(skin.weights, [j](const SkinWeight& one) { return one.joint == j; });
      int nodes_above = 0;
      for (const DaeNode* next = parent(joint); next != nullptr; next = parent(*next)) {
        ++nodes_above;
      }
      joints.add(joint.element,
                 {joint.frame, skin.inverse_bind[j].inverse(), nodes_above, moves_vertices});
      joints.join(joint.element, &instance);
    }
  }

  [[nodiscard]] const DaeNode* parent(const DaeNode& node) const {
    return node.parent < 0 ? nullptr : &placed_[static_cast<std::size_t>(node.parent)];
  }

  /// Joints hang from each other where there is nothing but joints between them.
  [[nodiscard]] SceneNode top_of_chain(const DaeNode& joint, const BoundJoints& joints) const {
    const DaeNode* topmost = &joint;
    for (const DaeNode* next = parent(joint); next != nullptr; next = parent(*next)) {
      const bool is_joint = next->element->attribute("type") == "JOINT";
      if (!is_joint && !joints.contains(next->element)) break;
      topmost = next;
    }
    return topmost->element;
  }

  /// That of the figure to which it belongs, if that is read as bound.
  [[nodiscard]] std::optional<Eigen::Affine3d> move_of(const XmlElement& instance,
                                                       const DaeSkin& skin) const {
    for (std::size_t j = 0; j < skin.joints.size() && !bent_.empty(); ++j) {
      const auto found = bent_.find(joint_of(instance, skin, j).element);
      if (found != bent_.end()) return found->second.move;
    }
    return std::nullopt;
  }

  /// A node goes with the joint above it.
  [[nodiscard]] Eigen::Affine3d frame_of(const DaeNode& node) const {
    for (const DaeNode* next = &node; next != nullptr && !bent_.empty(); next = parent(*next)) {
      const auto found = bent_.find(next->element);
      if (found == bent_.end() || !is_invertible(next->frame)) continue;
      const auto& [bound, move] = found->second;
      return move * bound * next->frame.inverse() * node.frame;
    }
    return node.frame;
  }

  /// The node with that sid below the instance's skeletons, or with that id; exporters that leave
  /// the sid out use the name.
  [[nodiscard]] const DaeNode& joint_of(const XmlElement& instance, const DaeSkin& skin,
                                        std::size_t number) const {
    const std::string& joint = skin.joints[number];
    if (skin.joints_are_ids && document_.has(joint)) {
      for (const DaeNode& node : placed_) {
        if (node.element->attribute("id") == joint) return node;
      }
    }
    for (const std::string_view key : {"sid", "name", "id"}) {
      for (const XmlElement* skeleton : instance.all("skeleton")) {
        std::string root(skeleton->text);
        const std::size_t begin = root.find_first_not_of(" \t\r\n#");
        if (begin == std::string::npos) continue;
        root = root.substr(begin, root.find_last_not_of(" \t\r\n") + 1 - begin);
        for (const DaeNode& node : placed_) {
          if (node.element->attribute("id") != root) continue;
          const XmlElement* found = below(*node.element, key, joint);
          const auto at = found == nullptr ? place_of_.end() : place_of_.find(found);
          if (at != place_of_.end()) return placed_[at->second];
        }
      }
      for (const DaeNode& node : placed_) {
        if (node.element->attribute(key) == joint) return node;
      }
    }
    document_.fail(instance, "no node that is the joint " + in_quotes(joint), "one in the scene");
  }

  static const XmlElement* below(const XmlElement& node, std::string_view key,
                                 std::string_view value) {
    if (node.attribute(key) == value) return &node;
    for (const XmlElement& child : node.children) {
      if (child.name != "node") continue;
      if (const XmlElement* found = below(child, key, value)) return found;
    }
    return nullptr;
  }

  const DaeDocument& document_;
  const Monitor& monitor_;
  const std::function<void(const DaeShownMesh&)>& take_;
  std::map<const XmlElement*, const XmlElement*> loose_morphs_;  // by <geometry>
  std::vector<DaeNode> placed_;
  std::map<const XmlElement*, std::size_t> place_of_;  // the first, among these
  std::map<const XmlElement*, DaeSkin> skin_of_;
  std::unordered_map<SceneNode, MovedJoint> bent_;  // joints, where meshes are read as bound
  std::map<const XmlElement*, DaeMesh> mesh_of_;
  std::map<const XmlElement*, DaeMesh> morphed_;  // by <morph>
};

}  // namespace

bool for_each_dae_mesh(const DaeDocument& document, const Monitor& monitor, bool as_bound,
                       const std::function<void(const DaeShownMesh&)>& take) {
  return DaeSceneReader(document, monitor, take).read(as_bound);
}

bool has_z_up(const DaeDocument& document) { return up_axis(document) == "Z_UP"; }

Eigen::Affine3d dae_to_gltf(const DaeDocument& document) {
  const std::string up = up_axis(document);
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (up == "Z_UP") axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  if (up == "X_UP") axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  result.linear() = metres_per_unit(document) * axes;
  return result;
}

XmlElement parse_dae(const FileBytes& file) {
  XmlElement root = parse_xml(file, deepest_node);
  if (root.name != "COLLADA") {
    file.fail("XML that begins with <" + root.name + ">", "<COLLADA>",
              "check the file's content, or name it by its format");
  }
  return root;
}

}  // namespace curveskel
