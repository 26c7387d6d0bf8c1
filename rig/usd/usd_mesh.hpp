// A mesh prim. Internal to rig/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rig/gltf/whole_mesh.hpp"
#include "rig/usd/usd_skeletons.hpp"
#include "rig/usd/usd_text.hpp"

namespace curveskel {

/// The rest of the layer as a mesh names it.
struct UsdMeshLinks {
  std::string path;       ///< of the prim
  std::string true_name;  ///< where it is another
  std::string place;      ///< lines of its transform
  std::string skeleton;   ///< path; empty = none
  std::optional<UsdWeights> weights;
  std::vector<std::string> materials;     ///< paths by the mesh's numbers; empty = none
  std::vector<std::string> shape_tokens;  ///< by shape
  bool is_double_sided = false;
};

/// Points, faces, normals, texture coordinates (`st`, `st1` ...), colours (`displayColor` and
/// `displayOpacity`, further sets as `color1` ...), one subset for each of several materials,
/// weights, shapes. What differs from corner to corner of a vertex is by corner, all else by
/// vertex. O(numbers).
void write_usd_mesh(UsdText& text, const WholeMesh& mesh, const UsdMeshLinks& links);

}  // namespace curveskel
