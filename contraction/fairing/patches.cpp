#include "contraction/fairing/patches.hpp"

#include <algorithm>

namespace curveskel {

PatchFinder::PatchFinder(const Triangles& triangles, const CornersByVertex& corners, int rings)
    : triangles_(triangles),
      corners_(corners),
      rings_(rings),
      local_(corners.start.size() - 1, -1) {}

const Patch& PatchFinder::of(std::int32_t centre) {
  patch_.vertices.assign(1, centre);
  patch_.triangles.clear();
  local_[static_cast<std::size_t>(centre)] = 0;
  std::size_t begin = 0;
  for (int ring = 0; ring < rings_; ++ring) {
    const std::size_t end = patch_.vertices.size();
    for (std::size_t i = begin; i < end; ++i) add_faces_of(static_cast<std::int32_t>(i));
    if (end == patch_.vertices.size()) break;  // the whole component
    begin = end;
  }
  for (const std::int32_t v : patch_.vertices) local_[static_cast<std::size_t>(v)] = -1;
  return patch_;
}

void PatchFinder::add_faces_of(std::int32_t local) {
  const auto vertex = static_cast<std::size_t>(patch_.vertices[static_cast<std::size_t>(local)]);
  for (const std::int32_t corner : corners_.of(vertex)) {
    const auto face = triangles_.row(corner / 3);
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    std::array<std::int32_t, 3> indices{};
    bool known = false;
    for (int k = 0; k < 3; ++k) {
      std::int32_t& index = local_[static_cast<std::size_t>(face[k])];
      // Vertices are visited in their order in the patch: a lower one has brought this face in.
      known = known || (index >= 0 && index < local);
      if (index < 0) {
        index = static_cast<std::int32_t>(patch_.vertices.size());
        patch_.vertices.push_back(face[k]);
      }
      indices[static_cast<std::size_t>(k)] = index;
    }
    if (!known) patch_.triangles.push_back(indices);
  }
}

}  // namespace curveskel
