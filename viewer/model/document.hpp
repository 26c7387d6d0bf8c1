// The open files: a surface as its file has it, its repairs, and a skeleton.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <curveskel/certificate.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>
#include "viewer/render/shapes_shown.hpp"

namespace curveskel::viewer {

struct Document {
  std::filesystem::path mesh_file;      ///< empty = none
  std::filesystem::path skeleton_file;  ///< empty = none was opened
  /// As read; empty where its polygons are the surface's triangles, and without a mesh.
  std::shared_ptr<const PolygonSoup> soup;
  SurfaceFormat format = SurfaceFormat::obj;              ///< of the mesh's file
  bool faces_minus_z = false;                             ///< as in PolygonSoup
  bool z_is_up = false;                                   ///< likewise
  Eigen::Matrix3d to_gltf = Eigen::Matrix3d::Identity();  ///< likewise
  Surface surface;                        ///< the file's triangles, nothing repaired
  std::shared_ptr<const Rig> rig;         ///< in the mesh's file; null without one
  std::optional<CurveSkeleton> skeleton;  ///< node_of_vertex by the file's vertices, or empty
  int root = -1;                          ///< node, as the skeleton's file names it; -1 = none
  DrawnSpace space;                       ///< round all of it

  [[nodiscard]] bool has_surface() const { return surface.positions.rows() > 0; }
  /// The surface of the file, or a copy if that is the same. Precondition: has_surface().
  [[nodiscard]] std::shared_ptr<const PolygonSoup> polygons() const;
};

/// Opens one surface (with its rig, if the file has one), one skeleton, or both; which is which
/// follows from the content. Throws Error(Fault::input) where a file is neither, or there are two
/// of a kind.
[[nodiscard]] Document open_document(const std::vector<std::filesystem::path>& files,
                                     const Monitor& monitor);

}  // namespace curveskel::viewer
