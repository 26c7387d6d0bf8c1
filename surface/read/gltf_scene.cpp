// glTF 2.0 and GLB. Every mesh that the scene shows is taken where the scene shows it: a skinned
// one in the pose of its joints' nodes, as Blender opens it.
#include "surface/read/gltf_scene.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "surface/read/formats.hpp"
#include "surface/read/gltf_pose.hpp"
#include "surface/read/gltf_seams.hpp"

namespace curveskel {
namespace {

constexpr std::string_view gltf_remedy = "export the file again";

class SceneReader {
 public:
  SceneReader(const FileBytes& file, const tinygltf::Model& model, const Monitor& monitor,
              const GltfReading& reading)
      : file_(file),
        model_(model),
        monitor_(monitor),
        reading_(reading),
        visited_(model.nodes.size(), false) {
    scene_.soup.offsets.push_back(0);
    scene_.frames.assign(model.nodes.size(), unmoved());
    scene_.parents.assign(model.nodes.size(), -1);
  }

  GltfScene read() {
    place_nodes();
    const std::vector<Eigen::Affine3d> frames =
        reading_.as_bound ? frames_as_bound() : scene_.frames;
    for (const int index : scene_.nodes) {
      const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
      if (node.mesh >= 0) read_mesh(node, index, frames[static_cast<std::size_t>(index)]);
    }
    if (model_.nodes.empty()) {
      for (int mesh = 0; mesh < static_cast<int>(model_.meshes.size()); ++mesh) {
        tinygltf::Node node;
        node.mesh = mesh;
        read_mesh(node, mesh, unmoved());
      }
    }
    if (any_bent_) rejoin_seams(std::move(seams_), coordinates_);
    scene_.soup.positions = positions_from(coordinates_);
    scene_.loose = positions_from(loose_);
    return std::move(scene_);
  }

 private:
  static Eigen::Affine3d unmoved() { return Eigen::Affine3d::Identity(); }

  /// Of the default scene, else the first; of a file without scenes all nodes that are no child.
  [[nodiscard]] std::vector<int> root_nodes() const {
    if (model_.scenes.empty()) return parentless_nodes();
    return gltf_element(file_, model_.scenes, std::max(model_.defaultScene, 0), "scene").nodes;
  }

  [[nodiscard]] std::vector<int> parentless_nodes() const {
    std::vector<bool> is_child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int child : node.children) {
        gltf_element(file_, model_.nodes, child, "child node");
        is_child[static_cast<std::size_t>(child)] = true;
      }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) roots.push_back(static_cast<int>(i));
    }
    return roots;
  }

  /// All of the scene before any mesh: a mesh may be shown before the joints that move it. Then the
  /// nodes of other scenes, which should hold no joints, but do.
  void place_nodes() {
    for (const int index : below(root_nodes())) scene_.nodes.push_back(index);
    const std::vector<bool> shown = visited_;
    for (const int root : parentless_nodes()) (void)below({root}, &shown);
  }

  /// Joints where they are as the skin was bound that has them first, in the place where that skin
  /// stands; what hangs from a joint goes along: a robot's chest with its hands.
  std::vector<Eigen::Affine3d> frames_as_bound() {
    std::map<int, Eigen::Affine3d> joints;
    for (const int index : scene_.nodes) {
      const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
      if (node.mesh < 0 || node.skin < 0) continue;
      const GltfSkinPose& pose = *pose_of(node.skin);
      const auto& of_skin = model_.skins[static_cast<std::size_t>(node.skin)].joints;
      for (std::size_t k = 0; k < of_skin.size(); ++k) {
        const Eigen::Affine3d& shown = scene_.frames[static_cast<std::size_t>(of_skin[k])];
        if (pose.joints[k].linear().determinant() == 0) continue;
        joints.try_emplace(of_skin[k], pose.topmost * pose.joints[k].inverse() * shown);
      }
    }
    std::vector<Eigen::Affine3d> frames = scene_.frames;
    for (const int index : scene_.nodes) {  // parents first
      const auto joint = joints.find(index);
      const int parent = scene_.parents[static_cast<std::size_t>(index)];
      Eigen::Affine3d& frame = frames[static_cast<std::size_t>(index)];
      if (joint != joints.end()) {
        frame = joint->second;
      } else if (parent >= 0) {
        const auto above = static_cast<std::size_t>(parent);
        if (frames[above].matrix() == scene_.frames[above].matrix()) continue;
        frame = frames[above] * transform(model_.nodes[static_cast<std::size_t>(index)], index);
      }
    }
    return frames;
  }

  /// Those nodes and all below them, placed, each before its children; of `left_out` none.
  std::vector<int> below(const std::vector<int>& roots,
                         const std::vector<bool>* left_out = nullptr) {
    std::vector<int> found;
    std::vector<std::pair<int, Eigen::Affine3d>> open;
    const auto is_left_out = [&](int node) {
      return left_out != nullptr && node >= 0 &&
             static_cast<std::size_t>(node) < left_out->size() &&
             (*left_out)[static_cast<std::size_t>(node)];
    };
    const auto add = [&](const std::vector<int>& nodes, const Eigen::Affine3d& frame) {
      for (std::size_t i = nodes.size(); i-- > 0;) {
        if (!is_left_out(nodes[i])) open.emplace_back(nodes[i], frame);
      }
    };
    add(roots, unmoved());
    while (!open.empty()) {
      const auto [index, parent] = open.back();
      open.pop_back();
      const tinygltf::Node& node = visit(index);
      const Eigen::Affine3d frame = parent * transform(node, index);
      found.push_back(index);
      scene_.frames[static_cast<std::size_t>(index)] = frame;
      add(node.children, frame);
      for (const int child : node.children) {
        gltf_element(file_, model_.nodes, child, "child node");
        if (!is_left_out(child)) scene_.parents[static_cast<std::size_t>(child)] = index;
      }
    }
    return found;
  }

  const tinygltf::Node& visit(int index) {
    const tinygltf::Node& node = gltf_element(file_, model_.nodes, index, "node");
    if (visited_[static_cast<std::size_t>(index)]) {
      file_.fail("node " + std::to_string(index) + " twice in the scene", "a tree of nodes",
                 gltf_remedy);
    }
    visited_[static_cast<std::size_t>(index)] = true;
    return node;
  }

  [[nodiscard]] Eigen::Affine3d transform(const tinygltf::Node& node, int index) const {
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    if (node.matrix.size() == 16) {
      result.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    } else {
      if (node.translation.size() == 3) {
        result.translate(Eigen::Map<const Eigen::Vector3d>(node.translation.data()));
      }
      if (node.rotation.size() == 4) {
        result.rotate(Eigen::Quaterniond(node.rotation.data()).normalized());
      }
      if (node.scale.size() == 3) {
        result.scale(Eigen::Map<const Eigen::Vector3d>(node.scale.data()));
      }
    }
    if (!result.matrix().allFinite() || result.matrix().row(3) != Eigen::RowVector4d::UnitW()) {
      file_.fail("a transform of node " + std::to_string(index) + " that is not affine",
                 "finite numbers and a last row of 0 0 0 1", gltf_remedy);
    }
    return result;
  }

  void read_mesh(const tinygltf::Node& node, int index, const Eigen::Affine3d& frame) {
    const tinygltf::Mesh& mesh = gltf_element(file_, model_.meshes, node.mesh, "mesh");
    // Primitives with the same accessors share their vertices; others meet in coincident ones.
    std::map<std::vector<int>, Run> runs;
    const std::size_t first_part = scene_.parts.size();
    for (std::size_t number = 0; number < mesh.primitives.size(); ++number) {
      const tinygltf::Primitive& primitive = mesh.primitives[number];
      const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
      const bool in_soup = mode == TINYGLTF_MODE_TRIANGLES ||
                           mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                           mode == TINYGLTF_MODE_TRIANGLE_FAN;
      if (!in_soup && !reading_.with_loose) continue;            // points and lines
      if (!primitive.attributes.contains("POSITION")) continue;  // nothing to show, by the standard
      std::vector<int> key = accessors_of_positions(primitive);
      key.push_back(in_soup ? 1 : 0);
      const auto [entry, is_new] = runs.try_emplace(std::move(key));
      Run& run = entry->second;
      if (is_new) run = append_positions(primitive, node, mesh, frame, in_soup);
      scene_.parts.push_back({index, node.mesh, static_cast<int>(number), in_soup, run.first,
                              static_cast<std::int64_t>(run.count), run.move, run.bent});
      if (in_soup) append_triangles(vertices_of(primitive, run.count), mode, run);
    }
    if (node.skin >= 0) mark_bent(first_part);
  }

  /// A mesh has one skin, so one bind pose: where joints move its primitives in different ways, all
  /// are bent. `first_part` and those behind it are the mesh's.
  void mark_bent(std::size_t first_part) {
    constexpr double alike = 1e-5;  // as for joints, see `placed_positions`
    const std::span parts = std::span(scene_.parts).subspan(first_part);
    const auto first =
        std::find_if(parts.begin(), parts.end(), [](const GltfPart& part) { return part.in_soup; });
    if (first == parts.end()) return;
    const double size = std::max(first->move.linear().norm(), first->move.translation().norm());
    const bool apart = std::any_of(parts.begin(), parts.end(), [&](const GltfPart& part) {
      const Eigen::Matrix4d difference = part.move.matrix() - first->move.matrix();
      return part.in_soup && (part.bent || difference.norm() > alike * size);
    });
    if (!apart) return;
    scene_.soup.posed = true;
    for (GltfPart& part : parts) part.bent = true;
  }

  /// Vertices first, first + 1, ... of the soup.
  struct Run {
    std::int64_t first = 0;
    std::size_t count = 0;
    bool mirrored = false;
    Eigen::Affine3d move = unmoved();
    bool bent = false;
  };

  /// Skinned ones as bound: as their topmost joint moves them.
  [[nodiscard]] GltfPlaced placed(const tinygltf::Primitive& primitive, const tinygltf::Node& node,
                                  const tinygltf::Mesh& mesh, const Eigen::Affine3d& frame) {
    const auto& morph_weights = node.weights.empty() ? mesh.weights : node.weights;
    const GltfSkinPose* pose = pose_of(node.skin);
    const bool as_bound = reading_.as_bound && pose != nullptr;
    return placed_positions(file_, model_, primitive, morph_weights,
                            as_bound ? pose->topmost : frame, as_bound ? nullptr : pose, monitor_);
  }

  Run append_positions(const tinygltf::Primitive& primitive, const tinygltf::Node& node,
                       const tinygltf::Mesh& mesh, const Eigen::Affine3d& frame, bool in_soup) {
    const GltfPlaced placed = this->placed(primitive, node, mesh, frame);
    std::vector<double>& coordinates = in_soup ? coordinates_ : loose_;
    const auto first = static_cast<std::int64_t>(coordinates.size() / 3);
    const std::size_t count = placed.positions.size();
    if (coordinates.size() / 3 + count > static_cast<std::size_t>(most_vertices)) {
      file_.fail("more than " + std::to_string(most_vertices) + " vertices", "fewer",
                 "split or decimate the surface first");
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d& point = placed.positions[i];
      coordinates.insert(coordinates.end(), {point.x(), point.y(), point.z()});
    }
    if (node.skin >= 0 && in_soup) {
      scene_.skinned.push_back({&primitive, node.skin, first});
      any_bent_ = any_bent_ || placed.bent;
      for (std::size_t i = 0; i < count; ++i) {
        if (!placed.positions[i].allFinite() || !placed.modelled[i].allFinite()) continue;
        seams_.push_back({first + static_cast<std::int64_t>(i), placed.modelled[i]});
      }
    }
    return {first, count, placed.mirrored, placed.move, placed.bent};
  }

  /// Null: not skinned.
  const GltfSkinPose* pose_of(int skin) {
    if (skin < 0) return nullptr;
    const auto entry = poses_.find(skin);
    if (entry != poses_.end()) return &entry->second;
    return &poses_.emplace(skin, skin_pose(file_, model_, skin, scene_.frames, scene_.parents))
                .first->second;
  }

  [[nodiscard]] std::vector<std::int64_t> vertices_of(const tinygltf::Primitive& primitive,
                                                      std::size_t points) const {
    std::vector<std::int64_t> vertices;
    if (primitive.indices < 0) {
      for (std::size_t i = 0; i < points; ++i) vertices.push_back(static_cast<std::int64_t>(i));
      return vertices;
    }
    const GltfNumbers indices = gltf_numbers(file_, model_, primitive.indices, 1, "indices");
    vertices.reserve(indices.rows());
    for (std::size_t i = 0; i < indices.rows(); ++i) {
      const double vertex = indices.at(i, 0);
      if (!(vertex >= 0 && vertex < static_cast<double>(points) && std::floor(vertex) == vertex)) {
        file_.fail("vertex index " + std::to_string(vertex) + " in accessor " +
                       std::to_string(primitive.indices),
                   "whole numbers from 0 to " + std::to_string(points) + " - 1", gltf_remedy);
      }
      vertices.push_back(static_cast<std::int64_t>(vertex));
    }
    return vertices;
  }

  /// The corners of triangle i by mode are those of section 3.7.2.1 of the standard.
  void append_triangles(const std::vector<std::int64_t>& vertices, int mode, const Run& run) {
    if (mode == TINYGLTF_MODE_TRIANGLES && vertices.size() % 3 != 0) {
      file_.fail(std::to_string(vertices.size()) + " indices of triangles", "a multiple of three",
                 gltf_remedy);
    }
    for (std::size_t i = 0; i < gltf_triangle_count(mode, vertices.size()); ++i) {
      std::array<std::size_t, 3> corner = gltf_triangle(mode, i);
      if (run.mirrored) std::swap(corner[1], corner[2]);
      for (const std::size_t k : corner) {
        scene_.soup.corners.push_back(static_cast<std::int32_t>(run.first + vertices[k]));
      }
      end_polygon(scene_.soup);
    }
  }

  const FileBytes& file_;
  const tinygltf::Model& model_;
  const Monitor& monitor_;
  const GltfReading reading_;
  std::vector<bool> visited_;  // per node
  std::vector<double> coordinates_;
  std::vector<double> loose_;
  std::map<int, GltfSkinPose> poses_;  // by skin
  std::vector<GltfSeamVertex> seams_;  // all vertices that skins move
  bool any_bent_ = false;
  GltfScene scene_;
};

}  // namespace

std::size_t gltf_triangle_count(int mode, std::size_t corners) {
  const bool joined = mode == TINYGLTF_MODE_TRIANGLE_STRIP || mode == TINYGLTF_MODE_TRIANGLE_FAN;
  return joined ? std::max<std::size_t>(corners, 2) - 2 : corners / 3;
}

std::array<std::size_t, 3> gltf_triangle(int mode, std::size_t number) {
  const std::size_t i = number;
  if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) return {i, i + 1 + i % 2, i + 2 - i % 2};
  if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {i + 1, i + 2, 0};
  return {3 * i, 3 * i + 1, 3 * i + 2};
}

GltfScene read_gltf_scene(const FileBytes& file, const tinygltf::Model& model,
                          const Monitor& monitor, const GltfReading& reading) {
  GltfScene scene = SceneReader(file, model, monitor, {false, reading.with_loose}).read();
  if (!reading.as_bound || !scene.soup.posed) return scene;
  scene = SceneReader(file, model, monitor, reading).read();
  scene.soup.posed = true;
  return scene;
}

}  // namespace curveskel
