#include "surface/read/placed_meshes.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "base/memory.hpp"
#include "surface/read/formats.hpp"

namespace curveskel {
namespace {

/// Rows of `given`, moved by the weighted mean of their joints.
Positions moved(const Positions& given, const Eigen::Affine3d& frame, const MeshSkin& skin) {
  std::vector<double> sums(static_cast<std::size_t>(given.rows()), 0);
  Positions result = Positions::Zero(given.rows(), 3);
  for (const SkinWeight& one : skin.weights) {
    const auto v = static_cast<Eigen::Index>(one.vertex);
    result.row(v) += one.weight * (skin.joints[one.joint] * given.row(v).transpose()).transpose();
    sums[one.vertex] += one.weight;
  }
  for (Eigen::Index v = 0; v < given.rows(); ++v) {
    const double sum = sums[static_cast<std::size_t>(v)];
    if (sum > 0) {
      result.row(v) /= sum;
    } else {
      result.row(v) = (frame * given.row(v).transpose()).transpose();
    }
  }
  return result;
}

}  // namespace

bool is_mirrored(const Eigen::Affine3d& frame, const MeshSkin& skin) {
  if (skin.weights.empty()) return frame.linear().determinant() < 0;
  std::vector<double> signs;
  for (const Eigen::Affine3d& joint : skin.joints) {
    signs.push_back(joint.linear().determinant() < 0 ? -1 : 1);
  }
  double sum = 0;
  for (const SkinWeight& one : skin.weights) sum += one.weight * signs[one.joint];
  return sum < 0;
}

/// A small file may show a mesh any number of times, so memory is asked for before it is taken.
void PlacedMeshes::require_room(const PolygonSoup& mesh) {
  const std::size_t vertices =
      coordinates_.size() / 3 + static_cast<std::size_t>(mesh.positions.rows());
  if (vertices > static_cast<std::size_t>(most_vertices)) {
    file_.fail("more than " + std::to_string(most_vertices) + " vertices", "fewer",
               "split or decimate the surface first");
  }
  constexpr double bytes_per_vertex = 96;  // a position, room for it to grow, and the moved ones
  constexpr double bytes_per_corner = 24;  // an index or an offset, and room to grow
  const double bytes =
      bytes_per_vertex * static_cast<double>(vertices) +
      bytes_per_corner * static_cast<double>(soup_.corners.size() + mesh.corners.size() +
                                             soup_.offsets.size() + mesh.offsets.size());
  if (bytes <= bytes_allowed_) return;
  bytes_allowed_ = 2 * bytes;
  require_memory(bytes_allowed_, available_memory_bytes(), file_.path.string(), Fault::input,
                 "it is too large for this machine, or no honest file");
}

void PlacedMeshes::add(const PolygonSoup& mesh, const Eigen::Affine3d& frame,
                       const MeshSkin& skin) {
  monitor_.report("read", 0.5);
  require_room(mesh);
  const auto first = static_cast<std::int32_t>(coordinates_.size() / 3);
  const Positions placed = moved(mesh.positions, frame, skin);
  coordinates_.insert(coordinates_.end(), placed.data(), placed.data() + placed.size());
  const bool mirrored = is_mirrored(frame, skin);
  for (std::size_t p = 0; p + 1 < mesh.offsets.size(); ++p) {
    const auto begin = static_cast<std::ptrdiff_t>(soup_.corners.size());
    for (auto i = mesh.offsets[p]; i < mesh.offsets[p + 1]; ++i) {
      soup_.corners.push_back(first + mesh.corners[static_cast<std::size_t>(i)]);
    }
    if (mirrored) std::reverse(soup_.corners.begin() + begin, soup_.corners.end());
    end_polygon(soup_);
  }
}

PolygonSoup PlacedMeshes::soup(SurfaceFormat format) {
  soup_.positions = positions_from(coordinates_);
  soup_.format = format;
  return std::move(soup_);
}

}  // namespace curveskel
