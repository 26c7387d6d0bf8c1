// The vertices of a glTF file where its joints show them.
#pragma once

#include <vector>

#include "rig/gltf/gltf_document.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {

/// Meshes that joints bend get numbers of their own in the scene's coordinates, in single
/// precision: positions, normals, tangents and all that morph targets add to them; the old ones
/// stay where they are. `parts` are those of the scene, which rests as shown, by the document's
/// nodes, each the only one that shows its mesh; those written have no move afterwards.
/// Throws Error(Fault::input) where numbers are wrong. O(vertices x targets).
void write_bent_vertices(GltfDocument& document, std::vector<GltfPart>& parts,
                         const FileBytes& file, const tinygltf::Model& model,
                         const GltfScene& scene);

}  // namespace curveskel
