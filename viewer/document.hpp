// What is open: a surface as its file has it, what was repaired, and a skeleton.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "skeleton/certificate.hpp"
#include "skeleton/curve_skeleton.hpp"
#include "surface/read.hpp"
#include "surface/repair.hpp"
#include "surface/surface.hpp"

namespace curveskel::viewer {

struct Document {
  std::filesystem::path mesh_file;          ///< empty = none
  std::filesystem::path skeleton_file;      ///< empty = none was opened
  std::shared_ptr<const PolygonSoup> soup;  ///< as read; empty without a mesh
  Surface surface;                          ///< the soup's triangles, nothing repaired
  std::optional<CurveSkeleton> skeleton;    ///< node_of_vertex by the file's vertices, or empty
  Eigen::RowVector3d origin = Eigen::RowVector3d::Zero();  ///< of what is drawn
};

/// Opens one surface, one skeleton, or both; which is which follows from the content.
/// Throws Error(Fault::input) where a file is neither, or there are two of a kind.
[[nodiscard]] Document open_document(const std::vector<std::filesystem::path>& files,
                                     const Monitor& monitor);

}  // namespace curveskel::viewer
