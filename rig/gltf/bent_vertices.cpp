#include "rig/gltf/bent_vertices.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/gltf/number_bytes.hpp"
#include "rig/gltf/vertex_maps.hpp"
#include "surface/read/gltf_numbers.hpp"
#include "surface/read/gltf_pose.hpp"

namespace curveskel {
namespace {

using Vectors = Eigen::Matrix3Xd;  // by vertex
using Attributes = std::map<std::string, int>;

Vectors vectors_in(const FileBytes& file, const tinygltf::Model& model, int accessor,
                   Eigen::Index count, int components, const std::string& meaning) {
  const GltfNumbers rows = gltf_numbers(file, model, accessor, components, meaning);
  if (static_cast<Eigen::Index>(rows.rows()) != count) {
    file.fail(std::to_string(rows.rows()) + " rows of " + meaning,
              "one for each of the " + std::to_string(count) + " vertices",
              "export the file again");
  }
  Vectors vectors(3, count);
  for (Eigen::Index v = 0; v < count; ++v) {
    for (Eigen::Index k = 0; k < 3; ++k) vectors(k, v) = rows.at(idx(v), idx(k));
  }
  return vectors;
}

/// The vertices of one primitive that joints bend.
class BentPrimitive {
 public:
  BentPrimitive(const FileBytes& file, const tinygltf::Model& model, const GltfScene& scene,
                const GltfPart& part)
      : file_(file),
        model_(model),
        node_(model.nodes[idx(part.node)]),
        mesh_(model.meshes[idx(part.mesh)]),
        primitive_(mesh_.primitives[idx(part.primitive)]),
        count_(static_cast<Eigen::Index>(part.count)) {
    const Positions& all = part.in_soup ? scene.soup.positions : scene.loose;
    shown_ = all.middleRows(part.first_vertex, count_).transpose();
    const GltfSkinPose pose = skin_pose(file, model, node_.skin, scene.frames, scene.parents);
    for (const GltfMove& move : vertex_moves(file, model, primitive_, pose, idx(count_))) {
      turns_.emplace_back(move.leftCols<3>());
    }
  }

  void write(GltfDocument& document, OrderedJson& primitive) const {
    OrderedJson attributes = primitive["attributes"];
    OrderedJson targets = primitive.value("targets", OrderedJson::array());
    write_positions(document, attributes, targets);
    write_normals(document, attributes, targets);
    write_tangents(document, attributes, targets);
    primitive["attributes"] = std::move(attributes);
    if (!targets.empty()) primitive["targets"] = std::move(targets);
  }

 private:
  [[nodiscard]] Vectors read(int accessor, int components, const std::string& meaning) const {
    return vectors_in(file_, model_, accessor, count_, components, meaning);
  }

  /// The vertices as shown less what the targets that are shown add to them.
  void write_positions(GltfDocument& document, OrderedJson& attributes,
                       OrderedJson& targets) const {
    const auto& weights = node_.weights.empty() ? mesh_.weights : node_.weights;
    Vectors places = shown_;
    for_each_target("POSITION", [&](std::size_t target, Vectors shifts) {
      for (Eigen::Index v = 0; v < count_; ++v) shifts.col(v) = turns_[idx(v)] * shifts.col(v);
      if (target < weights.size()) places -= weights[target] * shifts;
      targets.at(target)["POSITION"] = add_places(document, shifts.cast<float>());
    });
    attributes["POSITION"] = add_places(document, places.cast<float>());
  }

  /// Normals have the length of one; what targets add is turned, and scaled, like the normal that
  /// it is added to, so that sums point as they did.
  void write_normals(GltfDocument& document, OrderedJson& attributes, OrderedJson& targets) const {
    const auto found = primitive_.attributes.find("NORMAL");
    if (found == primitive_.attributes.end()) return;
    const Vectors normals = read(found->second, 3, "normals");
    std::vector<Eigen::Matrix3d> turns = normal_maps(turns_);
    for (Eigen::Index v = 0; v < count_; ++v) {
      turns[idx(v)] = to_unit_length(turns[idx(v)], normals.col(v));
    }
    attributes["NORMAL"] = add_vectors(document, turned(turns, normals));
    for_each_target("NORMAL", [&](std::size_t target, const Vectors& shifts) {
      targets.at(target)["NORMAL"] = add_vectors(document, turned(turns, shifts));
    });
  }

  void write_tangents(GltfDocument& document, OrderedJson& attributes, OrderedJson& targets) const {
    const auto found = primitive_.attributes.find("TANGENT");
    if (found == primitive_.attributes.end()) return;
    const Vectors tangents = read(found->second, 4, "tangents");
    const GltfNumbers rows = gltf_numbers(file_, model_, found->second, 4, "tangents");
    std::vector<Eigen::Matrix3d> turns;
    for (Eigen::Index v = 0; v < count_; ++v) {
      turns.push_back(to_unit_length(turns_[idx(v)], tangents.col(v)));
    }
    const Vectors moved = turned(turns, tangents);
    std::string bytes;
    for (Eigen::Index v = 0; v < count_; ++v) {
      const double hand = rows.at(idx(v), 3) * (turns_[idx(v)].determinant() < 0 ? -1 : 1);
      for (const double number : moved.col(v)) put_number(bytes, static_cast<float>(number));
      put_number(bytes, static_cast<float>(hand));
    }
    attributes["TANGENT"] =
        add_accessor(document, bytes, "VEC4", gltf_float, idx(count_), gltf_vertices);
    for_each_target("TANGENT", [&](std::size_t target, const Vectors& shifts) {
      targets.at(target)["TANGENT"] = add_vectors(document, turned(turns, shifts));
    });
  }

  template <typename Visit>
  void for_each_target(const std::string& attribute, const Visit& visit) const {
    for (std::size_t target = 0; target < primitive_.targets.size(); ++target) {
      const Attributes& attributes = primitive_.targets[target];
      const auto found = attributes.find(attribute);
      if (found != attributes.end()) visit(target, read(found->second, 3, "morph targets"));
    }
  }

  static Eigen::Matrix3d to_unit_length(const Eigen::Matrix3d& turn,
                                        const Eigen::Vector3d& vector) {
    const double length = (turn * vector).norm();
    return length > 0 ? Eigen::Matrix3d(turn / length) : Eigen::Matrix3d::Identity();
  }

  static Vectors turned(const std::vector<Eigen::Matrix3d>& turns, const Vectors& vectors) {
    Vectors result(3, vectors.cols());
    for (Eigen::Index v = 0; v < vectors.cols(); ++v) {
      result.col(v) = turns[idx(v)] * vectors.col(v);
    }
    return result;
  }

  static std::size_t add_vectors(GltfDocument& document, const Vectors& vectors) {
    std::string bytes;
    for (const double number : vectors.reshaped()) {
      put_number(bytes, static_cast<float>(number));
    }
    return add_accessor(document, bytes, "VEC3", gltf_float, idx(vectors.cols()), gltf_vertices);
  }

  const FileBytes& file_;
  const tinygltf::Model& model_;
  const tinygltf::Node& node_;
  const tinygltf::Mesh& mesh_;
  const tinygltf::Primitive& primitive_;
  Eigen::Index count_;
  Vectors shown_;
  std::vector<Eigen::Matrix3d> turns_;  // by vertex
};

/// Primitives for which this is equal share their vertices, with all that is written anew.
using Shared = std::pair<std::int64_t, std::vector<int>>;

Shared shared_by(const tinygltf::Primitive& primitive, const GltfPart& part) {
  Shared shared{part.first_vertex, {part.in_soup ? 1 : 0}};
  const auto add = [&](const Attributes& attributes) {
    for (const char* name : {"POSITION", "NORMAL", "TANGENT"}) {
      const auto found = attributes.find(name);
      shared.second.push_back(found == attributes.end() ? -1 : found->second);
    }
  };
  add(primitive.attributes);
  for (const Attributes& target : primitive.targets) add(target);
  return shared;
}

void copy_written(const OrderedJson& from, OrderedJson& to) {
  const auto copy = [](const OrderedJson& source, OrderedJson& target) {
    for (const char* name : {"POSITION", "NORMAL", "TANGENT"}) {
      if (source.contains(name)) target[name] = source[name];
    }
  };
  copy(from["attributes"], to["attributes"]);
  for (std::size_t k = 0; to.contains("targets") && k < to["targets"].size(); ++k) {
    copy(from["targets"][k], to["targets"][k]);
  }
}

}  // namespace

void write_bent_vertices(GltfDocument& document, std::vector<GltfPart>& parts,
                         const FileBytes& file, const tinygltf::Model& model,
                         const GltfScene& scene) {
  std::map<Shared, OrderedJson> known;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (!parts[k].bent) continue;
    parts[k].move = Eigen::Affine3d::Identity();
    const GltfPart& part = scene.parts[k];
    if (part.count == 0) continue;
    const std::size_t mesh = document.json["nodes"][idx(parts[k].node)]["mesh"];
    // A copy, as writing makes room in the document.
    OrderedJson primitive = document.json["meshes"][mesh]["primitives"][idx(part.primitive)];
    const auto [written, is_new] = known.try_emplace(
        shared_by(model.meshes[idx(part.mesh)].primitives[idx(part.primitive)], part));
    if (is_new) {
      BentPrimitive(file, model, scene, part).write(document, primitive);
      written->second = primitive;
    } else {
      copy_written(written->second, primitive);
    }
    document.json["meshes"][mesh]["primitives"][idx(part.primitive)] = std::move(primitive);
  }
}

}  // namespace curveskel
