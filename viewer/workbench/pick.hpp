// The thing under the pointer.
#pragma once

#include <glm/glm.hpp>

#include "viewer/render/scene.hpp"

namespace curveskel::viewer {

struct Pick {
  enum class Kind { nothing, joint, node, edge, face };
  Kind kind = Kind::nothing;
  int index = -1;      ///< joint, node, row of the edges, or triangle of the surface
  int vertex = -1;     ///< of a face: its corner next to the pointer
  glm::vec3 place{0};  ///< as drawn, in the document's space
  bool operator==(const Pick& other) const {
    return kind == other.kind && index == other.index && vertex == other.vertex;
  }
};

/// (x, y) in pixels from the upper left corner of a picture of width x height. Joints come before
/// nodes, nodes before edges, edges before the surface, if they can be seen there. `scale`: of the
/// display, on which a hand is so much coarser in pixels.
/// O(#J + #N + #E), and what `FaceBlocks` takes.
[[nodiscard]] Pick pick(const Scene& scene, const glm::vec2& at, int width, int height,
                        float scale = 1);

/// A point in the picture, in pixels from the upper left corner; z: depth, -1..1 if it is within
/// the picture's depth.
[[nodiscard]] glm::vec3 pixel_of(const Camera& camera, const Bounds& bounds, const glm::vec3& point,
                                 int width, int height);

}  // namespace curveskel::viewer
