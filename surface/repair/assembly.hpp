// A surface of several surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Surfaces one after the other, in the order that they were added.
class Assembly {
 public:
  /// The number of the added surface's first vertex.
  std::int32_t add(const Surface& surface) {
    const auto first = static_cast<std::int32_t>(vertices_);
    vertices_ += surface.positions.rows();
    faces_ += surface.triangles.rows();
    parts_.push_back(surface);
    return first;
  }

  [[nodiscard]] Surface whole() const {
    Surface result;
    result.positions.resize(vertices_, 3);
    result.triangles.resize(faces_, 3);
    Eigen::Index vertex = 0;
    Eigen::Index face = 0;
    for (const Surface& part : parts_) {
      result.positions.middleRows(vertex, part.positions.rows()) = part.positions;
      result.triangles.middleRows(face, part.triangles.rows()) =
          part.triangles.array() + static_cast<std::int32_t>(vertex);
      vertex += part.positions.rows();
      face += part.triangles.rows();
    }
    return result;
  }

 private:
  std::vector<Surface> parts_;
  Eigen::Index vertices_ = 0;
  Eigen::Index faces_ = 0;
};

}  // namespace curveskel
