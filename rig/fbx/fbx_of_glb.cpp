#include "rig/fbx/fbx_of_glb.hpp"

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/fbx/fbx_animations.hpp"
#include "rig/fbx/fbx_document.hpp"
#include "rig/fbx/fbx_materials.hpp"
#include "rig/fbx/fbx_mesh.hpp"
#include "rig/fbx/fbx_set_names.hpp"
#include "rig/fbx/local_move.hpp"
#include "rig/io/rig_formats.hpp"
#include "surface/read/gltf_file.hpp"
#include "surface/read/gltf_numbers.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

/// A frame times its inverse, which a file has in single precision.
bool is_rounding(const Affine3d& move, const Affine3d& frame) {
  constexpr double single = 1e-6;
  return (move.linear() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= single &&
         move.translation().norm() <= single * frame.translation().norm();
}

void write_model(FbxRecords& records, const FbxMove& move) {
  records.record("Version", 232);
  records.begin("Properties70");
  const auto property = [&](const char* name, const Vector3d& value) {
    records.property(name, name, "", "A", value.x(), value.y(), value.z());
  };
  property("Lcl Translation", move.shift);
  property("Lcl Rotation", move.angles);
  property("Lcl Scaling", move.scale);
  constexpr std::int32_t scale_of_parent_turns_too = 1;
  records.property("InheritType", "enum", "", "", scale_of_parent_turns_too);
  records.end();
  records.record("Culling", "CullingOff");
}

class SceneWriter {
 public:
  SceneWriter(const FileBytes& file, const tinygltf::Model& model,
              const std::vector<MeshPolygons>& polygons, const Monitor& monitor)
      : file_(file),
        model_(model),
        polygons_(polygons),
        monitor_(monitor),
        scene_(read_gltf_scene(file, model, monitor)),
        map_names_(fbx_map_names(model)),
        is_joint_(model.nodes.size(), false) {
    for (const tinygltf::Skin& skin : model.skins) {
      for (const int node : skin.joints) is_joint_[idx(node)] = true;
    }
    name_joints();
  }

  std::string write(const std::string& provenance) {
    materials_ = add_fbx_materials(document_, model_, map_names_);
    for (const int node : scene_.nodes) add_node(node);
    for (const int node : scene_.nodes) add_mesh(node);
    add_bind_pose();
    add_fbx_animations(document_, file_, model_, made_, monitor_);
    return document_.bytes(provenance);
  }

 private:
  /// As `read_rig` does: programs find joints and the vertices that they move by names.
  void name_joints() {
    std::vector<std::string> names;
    for (const int node : scene_.nodes) {
      if (is_joint_[idx(node)]) names.push_back(node_of(node).name);
    }
    name_nameless(names);
    auto name = names.begin();
    for (const int node : scene_.nodes) {
      if (is_joint_[idx(node)]) joint_name_[node] = *name++;
    }
  }

  /// The frame of Blender's armature: the topmost node from which a joint hangs directly. Without
  /// it Blender takes that node's own move for its place in the scene.
  [[nodiscard]] Affine3d armature_of(int joint) const {
    Affine3d frame = Affine3d::Identity();
    for (int node = joint; node >= 0;) {
      const int parent = scene_.parents[idx(node)];
      if (parent >= 0 && !is_joint_[idx(parent)] && has_joint(parent)) {
        frame = scene_.frames[idx(parent)];
      } else if (parent < 0 && is_joint_[idx(node)]) {
        frame = Affine3d::Identity();
      }
      node = parent;
    }
    return frame;
  }

  [[nodiscard]] bool has_joint(int node) const {
    const std::vector<int>& children = node_of(node).children;
    return std::any_of(children.begin(), children.end(),
                       [&](int child) { return is_joint_[idx(child)]; });
  }

  [[nodiscard]] const std::string& name_of(int node) const {
    return is_joint_[idx(node)] ? joint_name_.at(node) : node_of(node).name;
  }

  [[nodiscard]] const tinygltf::Node& node_of(int node) const { return model_.nodes[idx(node)]; }

  [[nodiscard]] Affine3d local(int node) const {
    const int parent = scene_.parents[idx(node)];
    const Affine3d& frame = scene_.frames[idx(node)];
    return parent < 0 ? frame : Affine3d(scene_.frames[idx(parent)].inverse() * frame);
  }

  /// A node that only holds a mesh which joints move is not needed: that mesh stands alone.
  [[nodiscard]] bool is_needed(int node) const {
    const tinygltf::Node& given = node_of(node);
    return is_joint_[idx(node)] || given.mesh < 0 || given.skin < 0 || !given.children.empty();
  }

  [[nodiscard]] bool is_plain_mesh(int node) const {
    return node_of(node).mesh >= 0 && node_of(node).skin < 0 && !is_joint_[idx(node)];
  }

  void add_node(int node) {
    if (!is_needed(node)) return;
    const bool is_joint = is_joint_[idx(node)];
    const char* kind = is_joint ? "LimbNode" : is_plain_mesh(node) ? "Mesh" : "Null";
    const std::int64_t number = add_model(name_of(node), kind, local(node));
    made_.models[node] = number;
    const auto parent = made_.models.find(scene_.parents[idx(node)]);
    document_.connect(number, parent == made_.models.end() ? FbxDocument::root : parent->second);
    if (is_plain_mesh(node)) return;
    const std::int64_t attribute = document_.add(
        "NodeAttribute", name_of(node), "NodeAttribute", kind, [is_joint](FbxRecords& records) {
          records.record("TypeFlags", is_joint ? "Skeleton" : "Null");
        });
    document_.connect(attribute, number);
  }

  std::int64_t add_model(const std::string& name, const char* kind, const Affine3d& frame) {
    const FbxMove move = local_move(frame);
    return document_.add("Model", name, "Model", kind,
                         [move](FbxRecords& records) { write_model(records, move); });
  }

  void add_mesh(int node) {
    const tinygltf::Node& given = node_of(node);
    if (given.mesh < 0) return;
    const int skin = given.skin;
    const std::size_t joints =
        skin < 0 ? 0 : gltf_element(file_, model_.skins, skin, "skin").joints.size();
    gltf_element(file_, model_.meshes, given.mesh, "mesh");
    const auto number = idx(given.mesh);
    FbxMesh mesh = read_fbx_mesh(file_, model_, given.mesh, joints, map_names_[number]);
    if (number < polygons_.size()) take_polygons(mesh, polygons_[number]);
    if (mesh.empty()) return;
    const std::string& own = model_.meshes[idx(given.mesh)].name;
    const std::string name = given.name.empty() ? own : given.name;
    std::vector<Affine3d> bound;
    std::int64_t holder = 0;
    if (skin >= 0) {
      bound = place_as_bound(skin, mesh);
      holder = add_model(name, "Mesh", Affine3d::Identity());
      document_.connect(holder, FbxDocument::root);
      bind_pose_.emplace_back(holder, Affine3d::Identity());
    } else if (is_plain_mesh(node)) {
      holder = made_.models.at(node);
    } else {  // on a joint
      holder = add_model(name, "Mesh", Affine3d::Identity());
      document_.connect(holder, made_.models.at(node));
    }
    for (const int material : mesh.has_materials() ? mesh.materials : std::vector<int>{}) {
      document_.connect(material < 0 ? plain_material() : materials_[idx(material)], holder);
    }
    const auto moved = std::move(mesh.moved);
    FbxGeometry geometry = add_fbx_geometry(document_, own.empty() ? name : own, std::move(mesh));
    document_.connect(geometry.number, holder);
    if (!geometry.sliders.empty()) made_.sliders[node] = std::move(geometry.sliders);
    if (skin >= 0) add_skin(skin, bound, moved, geometry.number, name);
  }

  std::int64_t plain_material() {
    if (plain_material_ == 0) plain_material_ = add_fbx_plain_material(document_);
    return plain_material_;
  }

  /// The joints' frames when the mesh was bound to them, in the scene, into which it is moved.
  std::vector<Affine3d> place_as_bound(int number, FbxMesh& mesh) const {
    const tinygltf::Skin& skin = model_.skins[idx(number)];
    std::vector<Affine3d> from_joint;  // to the mesh
    from_joint.reserve(skin.joints.size());
    for (std::size_t k = 0; k < skin.joints.size(); ++k) {
      from_joint.push_back(inverse_bind(skin, k).inverse());
    }
    const Affine3d& frame_of_first = scene_.frames[idx(skin.joints.front())];
    const Affine3d placed = frame_of_first * from_joint.front().inverse();
    if (is_rounding(placed, frame_of_first)) return from_joint;
    move(mesh, placed);
    for (Affine3d& frame : from_joint) frame = placed * frame;
    return from_joint;
  }

  [[nodiscard]] Affine3d inverse_bind(const tinygltf::Skin& skin, std::size_t joint) const {
    Affine3d frame = Affine3d::Identity();
    if (skin.inverseBindMatrices < 0) return frame;
    const GltfNumbers numbers =
        gltf_numbers(file_, model_, skin.inverseBindMatrices, 16, "inverse bind matrices");
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        frame.matrix()(row, column) = numbers.at(joint, idx(4 * column + row));
      }
    }
    return frame;
  }

  void add_skin(int number, const std::vector<Affine3d>& bound,
                const std::vector<std::vector<std::pair<std::int32_t, double>>>& moved,
                std::int64_t geometry, const std::string& name) {
    const std::int64_t skin =
        document_.add("Deformer", name, "Deformer", "Skin", [](FbxRecords& records) {
          constexpr double accuracy = 50;  // as every program writes it
          records.record("Version", 101);
          records.record("Link_DeformAcuracy", accuracy);
        });
    document_.connect(skin, geometry);
    const std::vector<int>& joints = model_.skins[idx(number)].joints;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const auto joint = made_.models.find(joints[k]);
      if (joint == made_.models.end()) continue;  // outside the scene
      const bool is_new = is_bound_.emplace(joint->second, true).second;
      if (moved[k].empty() && !is_new) continue;  // a thousand meshes have a thousand joints
      const std::int64_t cluster =
          add_cluster(name_of(joints[k]), moved[k], bound[k], armature_of(joints[k]));
      document_.connect(cluster, skin);
      document_.connect(joint->second, cluster);
      if (is_new) bind_pose_.emplace_back(joint->second, bound[k]);
    }
  }

  std::int64_t add_cluster(const std::string& name,
                           const std::vector<std::pair<std::int32_t, double>>& moved,
                           const Affine3d& bound, const Affine3d& armature) {
    std::vector<std::int32_t> vertices;
    std::vector<double> weights;
    for (const auto& [vertex, weight] : moved) {
      vertices.push_back(vertex);
      weights.push_back(weight);
    }
    return document_.add("Deformer", name, "SubDeformer", "Cluster",
                         [vertices, weights, bound, armature](FbxRecords& records) {
                           records.record("Version", 100);
                           records.record("UserData", "", "");
                           if (!vertices.empty()) {
                             records.record("Indexes", vertices);
                             records.record("Weights", weights);
                           }
                           records.record("Transform", fbx_matrix(bound.inverse()));
                           records.record("TransformLink", fbx_matrix(bound));
                           records.record("TransformAssociateModel", fbx_matrix(armature));
                         });
  }

  void add_bind_pose() {
    if (bind_pose_.empty()) return;
    const auto pose = bind_pose_;
    (void)document_.add("Pose", "bind pose", "Pose", "BindPose", [pose](FbxRecords& records) {
      records.record("Type", "BindPose");
      records.record("Version", 100);
      records.record("NbPoseNodes", static_cast<std::int32_t>(pose.size()));
      for (const auto& [model, frame] : pose) {
        records.begin("PoseNode");
        records.record("Node", model);
        records.record("Matrix", fbx_matrix(frame));
        records.end();
      }
    });
  }

  const FileBytes& file_;
  const tinygltf::Model& model_;
  const std::vector<MeshPolygons>& polygons_;  // by mesh, or none
  const Monitor& monitor_;
  GltfScene scene_;
  std::vector<std::vector<std::string>> map_names_;  // by mesh
  std::vector<bool> is_joint_;                       // by node
  std::map<int, std::string> joint_name_;            // by node
  FbxDocument document_;
  std::vector<std::int64_t> materials_;
  std::int64_t plain_material_ = 0;
  FbxNodes made_;
  std::map<std::int64_t, bool> is_bound_;
  std::vector<std::pair<std::int64_t, Affine3d>> bind_pose_;
};

}  // namespace

std::string fbx_of_glb(std::string glb, const std::string& provenance,
                       const std::vector<MeshPolygons>& polygons, const Monitor& monitor) {
  const FileBytes file{"rig.glb", std::move(glb)};
  const tinygltf::Model model = parse_gltf(file, monitor, GltfAttributes::all);
  return SceneWriter(file, model, polygons, monitor).write(provenance);
}

}  // namespace curveskel
