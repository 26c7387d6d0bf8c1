// COLLADA: every mesh that the scene shows, where the scene shows it. A skinned mesh is taken in
// its rest pose, in which its joints are as their nodes place them. Units and axes are the file's.
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "surface/read/dae_document.hpp"
#include "surface/read/dae_mesh.hpp"
#include "surface/read/dae_skin.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/placed_meshes.hpp"

namespace curveskel {
namespace {

constexpr std::string_view dae_start = "<COLLADA";
constexpr int deepest_node = 500;  // chains of joints nest

/// x right, y up, -z ahead: what <lookat> turns towards its point of interest.
Eigen::Affine3d looking(const std::vector<double>& numbers) {
  const Eigen::Vector3d eye(numbers[0], numbers[1], numbers[2]);
  const Eigen::Vector3d interest(numbers[3], numbers[4], numbers[5]);
  const Eigen::Vector3d up(numbers[6], numbers[7], numbers[8]);
  const Eigen::Vector3d back = (eye - interest).normalized();
  const Eigen::Vector3d right = up.cross(back).normalized();
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  result.linear() << right, back.cross(right), back;
  result.translation() = eye;
  return result;
}

class DaeSceneReader {
 public:
  DaeSceneReader(const FileBytes& file, const DaeDocument& document, const Monitor& monitor)
      : document_(document), monitor_(monitor), meshes_(file, monitor) {}

  PolygonSoup read() {
    const XmlElement* scene = shown_scene();
    if (scene == nullptr) {
      for (const XmlElement* library : document_.root().all("library_geometries")) {
        for (const XmlElement* geometry : library->all("geometry")) {
          meshes_.add(mesh_of(*geometry), Eigen::Affine3d::Identity());
        }
      }
      return meshes_.soup(SurfaceFormat::dae);
    }
    place_nodes(*scene);
    for (const auto& [node, frame] : placed_) {
      for (const XmlElement& child : node->children) {
        if (child.name == "instance_geometry") {
          meshes_.add(mesh_of(document_.referred(child, "url")), frame);
        } else if (child.name == "instance_controller") {
          add_controlled(child, frame);
        }
      }
    }
    return meshes_.soup(SurfaceFormat::dae);
  }

 private:
  using Placed = std::pair<const XmlElement*, Eigen::Affine3d>;

  [[nodiscard]] const XmlElement* shown_scene() const {
    const XmlElement* scene = document_.root().child("scene");
    const XmlElement* instance = scene == nullptr ? nullptr : scene->child("instance_visual_scene");
    if (instance != nullptr) return &document_.referred(*instance, "url");
    const XmlElement* library = document_.root().child("library_visual_scenes");
    return library == nullptr ? nullptr : library->child("visual_scene");
  }

  /// Depth first, in the file's order; instances of nodes may refer in circles, or multiply.
  void place_nodes(const XmlElement& scene) {
    constexpr std::size_t most_nodes = 1000000;
    std::vector<Placed> open{{&scene, Eigen::Affine3d::Identity()}};
    while (!open.empty()) {
      monitor_.report("read", 0.3);
      const auto [node, parent] = open.back();
      open.pop_back();
      const Eigen::Affine3d frame = parent * transform(*node);
      placed_.emplace_back(node, frame);
      frame_of_.emplace(node, frame);
      if (placed_.size() + open.size() > most_nodes) {
        document_.fail(*node, "more than " + std::to_string(most_nodes) + " nodes in the scene",
                       "fewer, and no node in itself");
      }
      for (std::size_t i = node->children.size(); i-- > 0;) {
        const XmlElement& child = node->children[i];
        if (child.name == "node") open.emplace_back(&child, frame);
        if (child.name == "instance_node") {
          open.emplace_back(&document_.referred(child, "url"), frame);
        }
      }
    }
  }

  /// The product of a node's transformations in their order.
  [[nodiscard]] Eigen::Affine3d transform(const XmlElement& node) const {
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    for (const XmlElement& child : node.children) {
      const auto numbers = [&](std::size_t count) {
        std::vector<double> values = document_.numbers(child);
        if (values.size() != count) {
          document_.fail(child, std::to_string(values.size()) + " numbers in <" + child.name + ">",
                         std::to_string(count));
        }
        return values;
      };
      if (child.name == "matrix") {
        frame = frame * document_.matrix(child, numbers(16).data());
      } else if (child.name == "translate") {
        frame.translate(Eigen::Vector3d(numbers(3).data()));
      } else if (child.name == "scale") {
        frame.scale(Eigen::Vector3d(numbers(3).data()));
      } else if (child.name == "rotate") {
        const std::vector<double> turn = numbers(4);
        const Eigen::Vector3d axis(turn.data());
        if (axis.norm() == 0) continue;
        frame.rotate(Eigen::AngleAxisd(turn[3] * std::numbers::pi / 180, axis.normalized()));
      } else if (child.name == "lookat") {
        frame = frame * looking(numbers(9));
      } else if (child.name == "skew") {
        document_.fail(child, "<skew>", "a <matrix> instead");
      }
    }
    if (!frame.matrix().allFinite()) document_.fail(node, "a transform of no numbers", "numbers");
    return frame;
  }

  const PolygonSoup& mesh_of(const XmlElement& geometry) {
    const auto [entry, is_new] = mesh_of_.try_emplace(&geometry);
    if (is_new) entry->second = read_dae_mesh(document_, geometry);
    return entry->second;
  }

  /// Morphs stand for their base mesh: the weights of a scene at rest are zero.
  void add_controlled(const XmlElement& instance, const Eigen::Affine3d& frame) {
    constexpr int deepest_controller = 10;
    const XmlElement* target = &document_.referred(instance, "url");
    const XmlElement* skin = nullptr;
    for (int depth = 0; target->name == "controller"; ++depth) {
      const XmlElement* inner = target->child("skin");
      if (inner != nullptr) skin = inner;
      if (inner == nullptr) inner = target->child("morph");
      if (inner == nullptr || depth > deepest_controller) {
        document_.fail(*target, "a controller that is neither skin nor morph of a mesh", "one");
      }
      target = &document_.referred(*inner, "source");
    }
    const PolygonSoup& mesh = mesh_of(*target);
    if (skin == nullptr) return meshes_.add(mesh, frame);
    const DaeSkin read =
        read_dae_skin(document_, *skin, static_cast<std::size_t>(mesh.positions.rows()));
    MeshSkin posed{{}, read.weights};
    for (std::size_t j = 0; j < read.joints.size(); ++j) {
      posed.joints.push_back(joint_frame(instance, read.joints[j], read.joints_are_ids) *
                             read.to_joint[j]);
    }
    meshes_.add(mesh, frame * read.bind_shape, posed);
  }

  /// Of the node with that sid below the instance's skeletons, or with that id; exporters that
  /// leave the sid out use the name.
  [[nodiscard]] Eigen::Affine3d joint_frame(const XmlElement& instance, const std::string& joint,
                                            bool is_id) const {
    if (is_id && document_.has(joint)) {
      for (const auto& [node, frame] : placed_) {
        if (node->attribute("id") == joint) return frame;
      }
    }
    for (const std::string_view key : {"sid", "name", "id"}) {
      for (const XmlElement* skeleton : instance.all("skeleton")) {
        std::string root(skeleton->text);
        const std::size_t begin = root.find_first_not_of(" \t\r\n#");
        if (begin == std::string::npos) continue;
        root = root.substr(begin, root.find_last_not_of(" \t\r\n") + 1 - begin);
        for (const auto& [node, frame] : placed_) {
          if (node->attribute("id") != root) continue;
          const XmlElement* found = below(*node, key, joint);
          const auto at = found == nullptr ? frame_of_.end() : frame_of_.find(found);
          if (at != frame_of_.end()) return at->second;
        }
      }
      for (const auto& [node, frame] : placed_) {
        if (node->attribute(key) == joint) return frame;
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
  PlacedMeshes meshes_;
  std::vector<Placed> placed_;
  std::map<const XmlElement*, Eigen::Affine3d> frame_of_;  // where it stands first
  std::map<const XmlElement*, PolygonSoup> mesh_of_;
};

bool has_z_up(const XmlElement& root) {
  const XmlElement* asset = root.child("asset");
  const XmlElement* up = asset == nullptr ? nullptr : asset->child("up_axis");
  return up != nullptr && up->text.find("Z_UP") != std::string::npos;
}

}  // namespace

PolygonSoup read_dae(const FileBytes& file, const Monitor& monitor) {
  const XmlElement root = parse_xml(file, deepest_node);
  monitor.report("read", 0.2);
  if (root.name != "COLLADA") {
    file.fail("XML that begins with <" + root.name + ">", "<COLLADA>",
              "check the file's content, or name it by its format");
  }
  PolygonSoup soup = DaeSceneReader(file, DaeDocument(file, root), monitor).read();
  soup.z_is_up = has_z_up(root);
  return soup;
}

bool looks_like_dae(const FileBytes& file) {
  constexpr std::size_t first_lines = 2000;
  const std::string_view text = std::string_view(file.content).substr(0, first_lines);
  const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return begin != std::string_view::npos && text[begin] == '<' &&
         text.find(dae_start) != std::string_view::npos;
}

}  // namespace curveskel
