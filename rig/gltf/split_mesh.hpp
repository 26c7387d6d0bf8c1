// The parts of a mesh, each with one row of everything a vertex, as glTF wants them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <curveskel/read.hpp>
#include "rig/gltf/dressed_mesh.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// Vertices, each with one row of texture coordinates, one normal and one colour.
struct SplitMesh {
  PolygonSoup soup;                     ///< without faces
  std::vector<DressedCorner> vertices;  ///< the first corner there of the file's; then the copies
  std::vector<std::size_t> materials;   ///< of the groups of faces, ascending; past all: none
  std::vector<std::vector<std::int32_t>> corners;  ///< by group
  std::vector<std::vector<std::int64_t>> offsets;  ///< likewise
  std::vector<std::size_t> group_of_face;          ///< in the file's order
  std::vector<std::int32_t> place_of_vertex;       ///< the number of the part's place
};

/// Places, ascending, and faces of one part of a mesh, to which it refers.
struct PartRange {
  std::size_t number;
  const DressedPart& part;
  std::vector<std::int32_t> places;
  std::size_t first_face;
  std::size_t end_face;
};

/// Places that no face has are in the part between whose first place and the next one's they lie.
/// O(#corners + #V log #V).
[[nodiscard]] std::vector<PartRange> ranges_of(const DressedMesh& mesh);

/// The part's own places first, in their order, then copies at seams. A face with a vertex that has
/// no place is left out; vertices without one are put as by `drop_unplaced_vertices`. Groups are
/// those of the materials that the other faces have. O(#corners * log #groups + #V log #V).
[[nodiscard]] SplitMesh split(const DressedMesh& mesh, const PartRange& part,
                              const FileBytes& file);

}  // namespace curveskel
