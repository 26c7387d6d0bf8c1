// The shapes of a file other than glTF over time. Internal to rig/.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace curveskel {

/// How much of a mesh's shapes is there.
struct ShapeTrack {
  std::size_t part = 0;  ///< the mesh: one of `DressedMesh::parts`
  std::vector<double> seconds;
  std::vector<std::vector<double>> weights;  ///< by second; of all its shapes, in their order
};

struct ShapeAnimation {
  std::size_t clip = 0;  ///< its number among all of the file
  std::string name;      ///< may be empty
  std::vector<ShapeTrack> tracks;
};

}  // namespace curveskel
