// The meshes of an FBX file where its models show them. Internal to surface/ and rig/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <curveskel/read.hpp>
#include "surface/read/fbx_bind.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"
#include "surface/read/placed_meshes.hpp"

namespace curveskel {

/// All are there while the file is.
struct FbxShownMesh {
  const FbxRecord& model;
  const FbxRecord& geometry;
  const PolygonSoup& polygons;  ///< of the geometry, morphed by the weights that the file gives
  Eigen::Affine3d frame;        ///< from the geometry to the world
  MeshSkin skin;
};

/// A shape of a channel, where it is in full.
struct FbxShape {
  std::string name;
  double weight = 0;  ///< that the file gives it
  std::vector<std::size_t> vertices;
  std::vector<Eigen::RowVector3d> moves;  ///< of these, in the geometry
};

/// Of a geometry with so many vertices: the stops of all its `fbx_channels`. The last of a channel
/// has the channel's name. Throws Error(Fault::input).
[[nodiscard]] std::vector<FbxShape> fbx_shapes(const FileBytes& file, const FbxScene& scene,
                                               const FbxRecord& geometry, Eigen::Index vertices);

/// Each geometry with polygons as often as a model shows it, in the order of meshes below.
void for_each_fbx_geometry(
    const FbxScene& scene,
    const std::function<void(const FbxRecord& model, const FbxRecord& geometry)>& take);

/// Each mesh as often as a model shows it, in the order in which `read_polygons` has them; nullptr
/// for `bind`: as shown. Throws Error(Fault::input).
void for_each_fbx_mesh(const FileBytes& file, const FbxScene& scene, const FbxBind* bind,
                       const std::function<void(const FbxShownMesh&)>& take);

/// Throws Error(Fault::input) for files of before version 7, whose objects have no numbers.
void require_fbx_version(const FileBytes& file, const FbxRecord& root);

}  // namespace curveskel
