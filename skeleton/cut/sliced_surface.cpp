#include "skeleton/cut/sliced_surface.hpp"

#include <algorithm>
#include <array>

namespace curveskel {
namespace {

/// The triangles that those with a vertex on some of their edges (-1 = none) are cut into.
void append_split(const Sliced& sliced, Eigen::Index t, const std::array<int, 3>& middle,
                  std::vector<std::array<int, 3>>& triangles) {
  const auto corner = sliced.surface.triangles.row(t);
  const auto split = std::count_if(middle.begin(), middle.end(), [](int m) { return m >= 0; });
  if (split == 0) {
    triangles.push_back({corner[0], corner[1], corner[2]});
  } else if (split == 3) {
    triangles.push_back({corner[0], middle[2], middle[1]});
    triangles.push_back({middle[2], corner[1], middle[0]});
    triangles.push_back({middle[1], middle[0], corner[2]});
    triangles.push_back({middle[0], middle[1], middle[2]});
  } else {
    // k is the edge that is alone in being split, or in not being so; a lies opposite to it.
    std::size_t k = 0;
    while ((middle[k] >= 0) != (split == 1)) ++k;
    const int a = corner[static_cast<Eigen::Index>(k)];
    const int b = corner[static_cast<Eigen::Index>((k + 1) % 3)];
    const int c = corner[static_cast<Eigen::Index>((k + 2) % 3)];
    if (split == 1) {
      triangles.push_back({a, b, middle[k]});
      triangles.push_back({a, middle[k], c});
      return;
    }
    const int ca = middle[(k + 1) % 3];
    const int ab = middle[(k + 2) % 3];
    triangles.push_back({a, ab, ca});
    const auto& value = sliced.value;
    if (std::abs(value[idx(b)] - value[idx(ca)]) <= std::abs(value[idx(c)] - value[idx(ab)])) {
      triangles.push_back({ab, b, ca});
      triangles.push_back({b, c, ca});
    } else {
      triangles.push_back({ab, b, c});
      triangles.push_back({ab, c, ca});
    }
  }
}

}  // namespace

void split_edges(Sliced& sliced, const std::vector<EdgeMiddle>& middles) {
  auto& positions = sliced.surface.positions;
  auto middle = static_cast<int>(positions.rows());
  positions.conservativeResize(positions.rows() + static_cast<Eigen::Index>(middles.size()), 3);
  std::vector<int> middle_of(sliced.index.edges.size(), -1);
  for (const EdgeMiddle& made : middles) {
    const auto& [a, b] = sliced.index.edges[made.edge];
    positions.row(middle) = 0.5 * (positions.row(a) + positions.row(b));
    sliced.value.push_back(sliced.middle_value(made.edge));
    sliced.group.push_back(made.group);
    middle_of[made.edge] = middle++;
  }
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(idx(sliced.surface.triangles.rows()) + 2 * middles.size());
  for (Eigen::Index t = 0; t < sliced.surface.triangles.rows(); ++t) {
    const auto edge = sliced.index.edge_of_corner.row(t);
    append_split(sliced, t,
                 {middle_of[idx(edge[0])], middle_of[idx(edge[1])], middle_of[idx(edge[2])]},
                 triangles);
  }
  sliced.surface.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    sliced.surface.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1],
        triangles[t][2];
  }
  sliced.index = index_edges(sliced.surface.triangles);
}

}  // namespace curveskel
