// The shapes of a COLLADA morph. Internal to surface/ and rig/.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "surface/read/dae_document.hpp"
#include "surface/read/dae_mesh.hpp"

namespace curveskel {

/// A target of a morph, where it is in full.
struct DaeShape {
  std::string name;
  double weight = 0;  ///< that the file gives it
  Positions moves;    ///< from the base mesh, by vertex
};

/// Targets with other vertices than the base mesh are passed over. Throws Error(Fault::input) with
/// the line.
[[nodiscard]] std::vector<DaeShape> dae_shapes(const DaeDocument& document, const XmlElement& morph,
                                               const DaeMesh& base);

/// By <geometry> the <morph> of it that nothing refers to: Blender writes it beside the mesh that
/// it morphs. O(elements).
[[nodiscard]] std::map<const XmlElement*, const XmlElement*> loose_dae_morphs(
    const DaeDocument& document);

/// True if the file's weights move the base mesh.
[[nodiscard]] bool is_morphed(const DaeDocument& document, const XmlElement& morph);

}  // namespace curveskel
