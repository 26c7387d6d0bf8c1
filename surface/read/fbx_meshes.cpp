#include "surface/read/fbx_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "surface/read/fbx_channels.hpp"
#include "surface/read/formats.hpp"

namespace curveskel {
namespace {

class FbxMeshes {
 public:
  /// As bound where there is a bind.
  FbxMeshes(const FileBytes& file, const FbxScene& scene, const FbxBind* bind)
      : file_(file), scene_(scene), bind_(bind) {}

  void give(const std::function<void(const FbxShownMesh&)>& take) {
    for_each_fbx_geometry(scene_, [&](const FbxRecord& model, const FbxRecord& geometry) {
      take(shown(model, geometry));
    });
  }

  [[nodiscard]] std::vector<FbxShape> all_shapes(const FbxRecord& geometry,
                                                 Eigen::Index vertices) const {
    return shapes(geometry, vertices, [](double) { return true; });
  }

 private:
  FbxShownMesh shown(const FbxRecord& model, const FbxRecord& geometry) {
    const auto [entry, is_new] = mesh_of_.try_emplace(&geometry);
    if (is_new) entry->second = mesh(geometry);
    const Eigen::Affine3d geometric = scene_.geometric(model);
    const Eigen::Affine3d frame = bind_ == nullptr ? scene_.frame(model) : bind_->frame(model);
    FbxShownMesh result{model, geometry, entry->second, frame * geometric,
                        skin(geometry, geometric, entry->second.positions.rows())};
    const auto bound = bind_ == nullptr ? std::nullopt : bind_->mesh(geometry);
    if (bound) result.frame = *bound * geometric;
    return result;
  }

  [[noreturn]] void fail(const FbxRecord& at, const std::string& found,
                         const std::string& needed) const {
    file_.fail(
        found + " in \"" + std::string(at.name) + "\" at byte " + std::to_string(at.position),
        needed, fbx_remedy);
  }

  /// A polygon's last index is -1 - vertex.
  [[nodiscard]] PolygonSoup mesh(const FbxRecord& geometry) const {
    PolygonSoup soup;
    soup.offsets.push_back(0);
    const FbxRecord* vertices = geometry.child("Vertices");
    if (vertices != nullptr) soup.positions = positions_from(rows_of_three(*vertices));
    morph(geometry, soup.positions);
    const FbxRecord& indices = *geometry.child("PolygonVertexIndex");
    for (const double index : fbx_numbers(file_, indices)) {
      const double vertex = index < 0 ? -1 - index : index;
      soup.corners.push_back(
          static_cast<std::int32_t>(checked(indices, vertex, soup.positions.rows())));
      if (index < 0) end_polygon(soup);
    }
    soup.corners.resize(static_cast<std::size_t>(soup.offsets.back()));
    return soup;
  }

  [[nodiscard]] std::vector<double> rows_of_three(const FbxRecord& record) const {
    std::vector<double> numbers = fbx_numbers(file_, record);
    if (numbers.size() % 3 != 0 || numbers.size() / 3 > static_cast<std::size_t>(most_vertices)) {
      fail(record, std::to_string(numbers.size()) + " coordinates", "three per vertex");
    }
    return numbers;
  }

  /// The vertex, if it is one.
  [[nodiscard]] std::size_t checked(const FbxRecord& record, double vertex,
                                    Eigen::Index vertices) const {
    if (!(vertex >= 0 && vertex < static_cast<double>(vertices) && std::floor(vertex) == vertex)) {
      fail(record, "vertex index " + std::to_string(vertex),
           "whole numbers below " + std::to_string(vertices));
    }
    return static_cast<std::size_t>(vertex);
  }

  template <typename Wanted>
  [[nodiscard]] std::vector<FbxShape> shapes(const FbxRecord& geometry, Eigen::Index vertices,
                                             const Wanted& wanted) const {
    std::vector<FbxShape> result;
    for (const FbxChannel& channel : fbx_channels(file_, scene_, geometry)) {
      const std::vector<double> shares = channel.shares(channel.percent);
      for (std::size_t k = 0; k < shares.size(); ++k) {
        if (!wanted(shares[k])) continue;
        const bool is_last = k + 1 == shares.size();
        const FbxRecord& shape = *channel.stops[k].shape;
        result.push_back({fbx_name(is_last ? *channel.record : shape), shares[k], {}, {}});
        read_shape(shape, vertices, result.back());
      }
    }
    return result;
  }

  void read_shape(const FbxRecord& record, Eigen::Index count, FbxShape& shape) const {
    const FbxRecord* indices = record.child("Indexes");
    const FbxRecord* offsets = record.child("Vertices");
    if (indices == nullptr || offsets == nullptr) return;
    const std::vector<double> vertices = fbx_numbers(file_, *indices);
    const std::vector<double> moves = rows_of_three(*offsets);
    if (moves.size() != 3 * vertices.size()) {
      fail(record, std::to_string(moves.size() / 3) + " offsets", "one per vertex that moves");
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      shape.vertices.push_back(checked(*indices, vertices[i], count));
      shape.moves.emplace_back(moves[3 * i], moves[3 * i + 1], moves[3 * i + 2]);
    }
  }

  void morph(const FbxRecord& geometry, Positions& positions) const {
    const auto is_seen = [](double weight) { return weight != 0; };
    for (const FbxShape& shape : shapes(geometry, positions.rows(), is_seen)) {
      for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
        positions.row(static_cast<Eigen::Index>(shape.vertices[i])) +=
            shape.weight * shape.moves[i];
      }
    }
  }

  /// "Transform" of a cluster leads from the mesh to the joint as both stood when they were bound.
  [[nodiscard]] MeshSkin skin(const FbxRecord& geometry, const Eigen::Affine3d& geometric,
                              Eigen::Index vertices) const {
    MeshSkin result;
    for (const FbxRecord* deformer : scene_.below(geometry, "Deformer", "Skin")) {
      for (const FbxRecord* cluster : scene_.below(*deformer, "Deformer", "Cluster")) {
        const FbxRecord* transform = cluster->child("Transform");
        const std::vector<const FbxRecord*> joints = scene_.below(*cluster, "Model");
        if (transform == nullptr || joints.empty()) continue;  // it moves nothing
        const Eigen::Affine3d joint = bind_ == nullptr ? scene_.frame(*joints.front())
                                                       : bind_->joint(*cluster, *joints.front());
        result.joints.push_back(joint * scene_.matrix(*transform) * geometric);
        add_weights(*cluster, vertices, result);
      }
    }
    return result;
  }

  void add_weights(const FbxRecord& cluster, Eigen::Index vertices, MeshSkin& skin) const {
    const FbxRecord* indices = cluster.child("Indexes");
    const FbxRecord* weights = cluster.child("Weights");
    if (indices == nullptr || weights == nullptr) return;
    const std::vector<double> moved = fbx_numbers(file_, *indices);
    const std::vector<double> values = fbx_numbers(file_, *weights);
    if (moved.size() != values.size() ||
        !std::all_of(values.begin(), values.end(), [](double w) { return std::isfinite(w); })) {
      fail(cluster, std::to_string(values.size()) + " weights",
           "a number for each of " + std::to_string(moved.size()) + " vertices");
    }
    for (std::size_t i = 0; i < moved.size(); ++i) {
      skin.weights.push_back(
          {checked(*indices, moved[i], vertices), skin.joints.size() - 1, values[i]});
    }
  }

  const FileBytes& file_;
  const FbxScene& scene_;
  const FbxBind* bind_;
  std::unordered_map<const FbxRecord*, PolygonSoup> mesh_of_;
};

/// The version that the file's header states, 0 if it states none.
std::int64_t version_of(const FbxRecord& root) {
  const FbxRecord* header = root.child("FBXHeaderExtension");
  const FbxRecord* version = header == nullptr ? nullptr : header->child("FBXVersion");
  return version == nullptr ? 0 : version->integer(0, 0);
}

}  // namespace

void for_each_fbx_geometry(
    const FbxScene& scene,
    const std::function<void(const FbxRecord& model, const FbxRecord& geometry)>& take) {
  for (const FbxRecord* model : scene.all("Model")) {
    for (const FbxRecord* geometry : scene.below(*model, "Geometry")) {
      if (geometry->child("PolygonVertexIndex") != nullptr) take(*model, *geometry);
    }
  }
}

std::vector<FbxShape> fbx_shapes(const FileBytes& file, const FbxScene& scene,
                                 const FbxRecord& geometry, Eigen::Index vertices) {
  return FbxMeshes(file, scene, nullptr).all_shapes(geometry, vertices);
}

void for_each_fbx_mesh(const FileBytes& file, const FbxScene& scene, const FbxBind* bind,
                       const std::function<void(const FbxShownMesh&)>& take) {
  FbxMeshes(file, scene, bind).give(take);
}

void require_fbx_version(const FileBytes& file, const FbxRecord& root) {
  constexpr std::int64_t first_version = 7000;
  const std::int64_t version = version_of(root);
  if (version >= first_version) return;
  file.fail("FBX of version " + std::to_string(version),
            "version " + std::to_string(first_version) + " or later",
            "export it again as FBX 2011 or later, for instance by Autodesk's FBX Converter");
}

}  // namespace curveskel
