#include "surface/read/gltf_seams.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <tuple>

namespace curveskel {

void rejoin_seams(std::vector<GltfSeamVertex> vertices, std::vector<double>& coordinates) {
  constexpr double near = 5e-5;
  const auto place = [&](std::int64_t vertex) {
    return Eigen::Map<Eigen::Vector3d>(coordinates.data() + 3 * static_cast<std::size_t>(vertex));
  };
  Eigen::AlignedBox3d box;
  for (std::size_t v = 0; v < coordinates.size() / 3; ++v) {
    box.extend(place(static_cast<std::int64_t>(v)));
  }
  const double tolerance = near * box.diagonal().norm();
  std::sort(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) {
    const auto key = [](const GltfSeamVertex& one) {
      return std::make_tuple(one.modelled.x(), one.modelled.y(), one.modelled.z(), one.vertex);
    };
    return key(a) < key(b);
  });
  for (auto first = vertices.begin(); first != vertices.end();) {
    const auto last = std::find_if(first, vertices.end(), [&](const GltfSeamVertex& one) {
      return one.modelled != first->modelled;
    });
    for (auto one = first; one != last; ++one) {
      const auto near_it = std::find_if(first, one, [&](const GltfSeamVertex& earlier) {
        return (place(earlier.vertex) - place(one->vertex)).norm() <= tolerance;
      });
      if (near_it != one) place(one->vertex) = place(near_it->vertex).eval();
    }
    first = last;
  }
}

}  // namespace curveskel
