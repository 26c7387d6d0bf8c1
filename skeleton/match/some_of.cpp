#include "skeleton/match/some_of.hpp"

#include <map>

namespace curveskel {

std::vector<int> evenly(const std::vector<int>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<int> some;
  some.reserve(most);
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
  return some;
}

SurfacePart part_of(const Surface& surface, const std::vector<int>& faces) {
  SurfacePart part;
  std::map<int, int> number;
  part.surface.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    for (int corner = 0; corner < 3; ++corner) {
      const int vertex = surface.triangles(faces[k], corner);
      const auto [known, added] = number.emplace(vertex, static_cast<int>(part.vertices.size()));
      if (added) part.vertices.push_back(vertex);
      part.surface.triangles(static_cast<Eigen::Index>(k), corner) = known->second;
    }
  }
  part.surface.positions = surface.positions(part.vertices, Eigen::all);
  return part;
}

}  // namespace curveskel
