// The animations of a glTF file as FBX. Internal to rig/.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/fbx/fbx_document.hpp"
#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// The objects of a document that nodes have become.
struct FbxNodes {
  std::map<int, std::int64_t> models;                ///< by node
  std::map<int, std::vector<std::int64_t>> sliders;  ///< by node; of its mesh's shapes
};

/// A stack of one layer for each animation that moves one of the nodes. FBX turns by three angles,
/// between which it draws lines, so a curve has the keys of glTF and as many between these as make
/// 30 a second, but no more than a thousand; a step is a line of a tenth of a millisecond. Curves
/// that only say what the node has at rest are left out. Throws as `read_gltf_animations`. O(nodes
/// times keys).
void add_fbx_animations(FbxDocument& document, const FileBytes& file, const tinygltf::Model& model,
                        const FbxNodes& nodes, const Monitor& monitor);

}  // namespace curveskel
