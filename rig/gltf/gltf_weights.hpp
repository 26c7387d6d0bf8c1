// JOINTS_0 and WEIGHTS_0 of the primitives of a glTF file.
#pragma once

#include <vector>

#include <curveskel/rig.hpp>
#include "rig/gltf/gltf_document.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {

struct GltfWeights {
  const SkinWeights& of_soup;  ///< by vertex of the soup
  SkinWeights of_loose;        ///< by vertex of points and lines
};

/// The joints of a skin, by the rig's numbers; empty = the same.
struct GltfSkinJoints {
  int skin;
  std::vector<int> joints;
};

/// Gives the primitives of these parts the rows of joints and weights that `joints_of(part)` wants,
/// in the place of all that they had. A mesh that another node shows, too, is copied for the second
/// node; its numbers stay shared but for these rows. `parts` have the document's node numbers.
void write_gltf_weights(GltfDocument& document, const std::vector<GltfPart>& parts,
                        const GltfWeights& weights,
                        const std::vector<GltfSkinJoints>& joints_of_part);

}  // namespace curveskel
