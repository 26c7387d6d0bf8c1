// Meshes of a scene, gathered where the scene shows them. Internal to surface/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
#include "surface/read/file_bytes.hpp"

namespace curveskel {

struct SkinWeight {
  std::size_t vertex = 0;
  std::size_t joint = 0;
  double weight = 0;
};

struct MeshSkin {
  std::vector<Eigen::Affine3d> joints;  ///< from the mesh as modelled to the world
  std::vector<SkinWeight> weights;      ///< in any order; of a vertex they need not sum to 1
};

/// True if the mesh as shown is a mirror image, for most of its weight: then its polygons' corners
/// are reversed.
[[nodiscard]] bool is_mirrored(const Eigen::Affine3d& frame, const MeshSkin& skin);

class PlacedMeshes {
 public:
  PlacedMeshes(const FileBytes& file, const Monitor& monitor) : file_(file), monitor_(monitor) {
    soup_.offsets.push_back(0);
  }

  /// Appends the polygons of `mesh`: vertices move with their joints, those without weights, and
  /// all where there is no skin, with `frame`. Throws Error(Fault::input) where the scene has grown
  /// beyond this machine. Precondition: corners and weights refer to vertices and joints that are
  /// there.
  void add(const PolygonSoup& mesh, const Eigen::Affine3d& frame, const MeshSkin& skin = {});

  [[nodiscard]] PolygonSoup soup(SurfaceFormat format);

 private:
  void require_room(const PolygonSoup& mesh);
  const FileBytes& file_;
  const Monitor& monitor_;
  std::vector<double> coordinates_;
  PolygonSoup soup_;
  double bytes_allowed_ = 0;
};

}  // namespace curveskel
