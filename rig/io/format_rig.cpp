#include <string>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/rig_files.hpp>
#include "base/option_ranges.hpp"
#include "rig/fbx/fbx_of_glb.hpp"
#include "rig/gltf/vrm.hpp"
#include "rig/io/rig_writers.hpp"
#include "rig/joints/placed_rig.hpp"
#include "rig/joints/sound_rig.hpp"
#include "rig/usd/usd_of_glb.hpp"

namespace curveskel {
namespace {

UsdLayer usd_layer(const Surface& surface, const Rig& rig, const std::string& name,
                   const std::string& provenance) {
  std::vector<std::string> notes;  // none without pictures
  return usd_of_glb(format_gltf_rig(surface, rig, RigFormat::glb, name, provenance),
                    {name, provenance}, notes);
}

}  // namespace

std::string format_rig(const Surface& surface, const Rig& rig, RigFormat format,
                       const std::string& name, const std::string& provenance, const VrmMeta& vrm) {
  OptionCheck("format_rig").choice("format", format, rig_formats);
  require_sound(surface, "format_rig");
  require_writable(rig, "format_rig");
  require_weights_of(rig, surface.positions.rows(), "format_rig");
  const bool has_y_up = keeps_the_file(format);
  if (has_y_up && !rig.to_y_up.isIdentity(0)) {
    const Surface turned{surface.positions * rig.to_y_up.transpose(), surface.triangles};
    return format_rig(turned, placed(rig, Eigen::Affine3d(rig.to_y_up)), format, name, provenance,
                      vrm);
  }
  switch (format) {
    case RigFormat::vrm:
      require_vrm(rig, vrm);
      return with_vrm(format_gltf_rig(surface, rig, RigFormat::glb, name, provenance), rig, vrm);
    case RigFormat::fbx:
      return fbx_of_glb(format_gltf_rig(surface, rig, RigFormat::glb, name, provenance),
                        provenance);
    case RigFormat::json:
      return format_json_rig(rig, provenance);
    case RigFormat::npz:
      return format_npz_rig(rig);
    case RigFormat::txt:
      return format_rignet_rig(rig);
    case RigFormat::bvh:
      return format_bvh_rig(rig);
    case RigFormat::usda:
      return usd_layer(surface, rig, name, provenance).text;
    case RigFormat::usdz:
      return usdz_of(usd_layer(surface, rig, name, provenance), "rig.usda");
    case RigFormat::glb:
    case RigFormat::gltf:
      break;
  }
  return format_gltf_rig(surface, rig, format, name, provenance);
}

}  // namespace curveskel
