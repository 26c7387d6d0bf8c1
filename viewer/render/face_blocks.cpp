#include "viewer/render/face_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace curveskel::viewer {
namespace {

constexpr Eigen::Index faces_per_block = 128;
constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Distance to where the ray enters the box; infinite where it misses.
double entry(const Eigen::AlignedBox3f& box, const Eigen::Vector3d& origin,
             const Eigen::Vector3d& inverse) {
  const Eigen::Array3d a = (box.min().cast<double>() - origin).array() * inverse.array();
  const Eigen::Array3d b = (box.max().cast<double>() - origin).array() * inverse.array();
  double enters = 0;
  double leaves = nowhere;
  for (int axis = 0; axis < 3; ++axis) {
    // Parallel to the planes and on one of them: 0 * infinity, which bounds nothing.
    if (std::isnan(a[axis]) || std::isnan(b[axis])) continue;
    enters = std::max(enters, std::min(a[axis], b[axis]));
    leaves = std::min(leaves, std::max(a[axis], b[axis]));
  }
  return enters <= leaves ? enters : nowhere;
}

/// Möller and Trumbore 1997, from either side.
double distance_to(const Surface& surface, Eigen::Index face, const Eigen::Vector3d& origin,
                   const Eigen::Vector3d& direction) {
  const auto corner = [&](int k) {
    return Eigen::Vector3d(surface.positions.row(surface.triangles(face, k)));
  };
  const Eigen::Vector3d a = corner(0);
  const Eigen::Vector3d ab = corner(1) - a;
  const Eigen::Vector3d ac = corner(2) - a;
  const Eigen::Vector3d p = direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return nowhere;
  const Eigen::Vector3d s = origin - a;
  const double u = s.dot(p) / determinant;
  const Eigen::Vector3d q = s.cross(ab);
  const double v = direction.dot(q) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1)) return nowhere;
  const double distance = ac.dot(q) / determinant;
  return distance >= 0 ? distance : nowhere;
}

}  // namespace

FaceBlocks::FaceBlocks(const Surface& surface) {
  const Eigen::Index faces = surface.triangles.rows();
  boxes_.reserve(static_cast<std::size_t>((faces + faces_per_block - 1) / faces_per_block));
  for (Eigen::Index first = 0; first < faces; first += faces_per_block) {
    Eigen::AlignedBox3d box;
    for (Eigen::Index face = first; face < std::min(first + faces_per_block, faces); ++face) {
      for (const int vertex : surface.triangles.row(face)) {
        box.extend(surface.positions.row(vertex).transpose());
      }
    }
    // Wider than single precision rounds.
    const Eigen::Vector3d margin =
        1e-6 * (box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()) + box.sizes());
    boxes_.emplace_back((box.min() - margin).cast<float>(), (box.max() + margin).cast<float>());
  }
}

FaceBlocks::Hit FaceBlocks::first(const Surface& surface, const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d inverse = direction.cwiseInverse();
  std::vector<std::pair<double, std::size_t>> met;
  for (std::size_t block = 0; block < boxes_.size(); ++block) {
    const double enters = entry(boxes_[block], origin, inverse);
    if (enters < nowhere) met.emplace_back(enters, block);
  }
  std::sort(met.begin(), met.end());
  Hit best;
  best.distance = nowhere;
  for (const auto& [enters, block] : met) {
    if (enters > best.distance) break;
    const Eigen::Index from = static_cast<Eigen::Index>(block) * faces_per_block;
    const Eigen::Index to = std::min(from + faces_per_block, surface.triangles.rows());
    for (Eigen::Index face = from; face < to; ++face) {
      const double distance = distance_to(surface, face, origin, direction);
      const bool before = distance == best.distance && face < best.face;
      if (distance < best.distance || before) best = {static_cast<int>(face), distance};
    }
  }
  if (best.face < 0) best.distance = 0;
  return best;
}

}  // namespace curveskel::viewer
