#include "rig/gltf/vertex_maps.hpp"

namespace curveskel {

std::vector<Eigen::Matrix3d> vertex_maps(const MeshSkin& skin, const Eigen::Affine3d& frame,
                                         std::size_t count) {
  std::vector<Eigen::Matrix3d> maps(count, Eigen::Matrix3d::Zero());
  std::vector<double> sums(count, 0);
  for (const SkinWeight& one : skin.weights) {
    maps[one.vertex] += one.weight * skin.joints[one.joint].linear();
    sums[one.vertex] += one.weight;
  }
  for (std::size_t v = 0; v < count; ++v) {
    maps[v] = sums[v] > 0 ? Eigen::Matrix3d(maps[v] / sums[v]) : frame.linear();
  }
  return maps;
}

std::vector<Eigen::Matrix3d> normal_maps(std::vector<Eigen::Matrix3d> maps) {
  for (Eigen::Matrix3d& map : maps) {
    // The cofactors, which are there for flattened vertices, too.
    const Eigen::Matrix3d moved = map;
    map.col(0) = moved.col(1).cross(moved.col(2));
    map.col(1) = moved.col(2).cross(moved.col(0));
    map.col(2) = moved.col(0).cross(moved.col(1));
    if (moved.determinant() < 0) map = -map;
  }
  return maps;
}

}  // namespace curveskel
