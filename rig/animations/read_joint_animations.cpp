#include "rig/animations/read_joint_animations.hpp"

#include <set>
#include <string_view>

#include <curveskel/advanced/indices.hpp>
#include "rig/dae/dae_joint_animations.hpp"
#include "rig/dae/dae_joints.hpp"
#include "rig/fbx/fbx_joint_animations.hpp"
#include "rig/fbx/fbx_joints.hpp"
#include "surface/read/dae_scene.hpp"
#include "surface/read/formats.hpp"

namespace curveskel {
namespace {

FileJoints count_fbx_joints(const FileBytes& file) {
  const FbxRecord root = parse_fbx(file);
  const FbxScene scene(file, root);
  FileJoints count;
  for (const FbxJoint& joint : fbx_joints(scene)) {
    ++count.joints;
    for (const char* property : {"Lcl Translation", "Lcl Rotation", "Lcl Scaling"}) {
      const auto moved = scene.all_at_property(*joint.model, property, "AnimationCurveNode");
      count.channels += static_cast<int>(moved.size());
    }
  }
  return count;
}

int channels_below(const XmlElement& element, const std::set<std::string_view>& ids) {
  int count = 0;
  for (const XmlElement& child : element.children) {
    if (child.name == "animation") count += channels_below(child, ids);
    if (child.name != "channel") continue;
    const std::string_view target = child.attribute("target");
    count += ids.contains(target.substr(0, target.find('/'))) ? 1 : 0;
  }
  return count;
}

FileJoints count_dae_joints(const FileBytes& file, const Monitor& monitor) {
  const XmlElement root = parse_dae(file);
  const DaeDocument document(file, root);
  const std::vector<DaeNode> nodes = dae_nodes(document, monitor);
  FileJoints count;
  std::set<std::string_view> ids;
  for (const DaeJoint& joint : dae_joints(nodes)) {
    ++count.joints;
    ids.insert(nodes[idx(joint.node)].element->attribute("id"));
  }
  for (const XmlElement* library : root.all("library_animations")) {
    count.channels += channels_below(*library, ids);
  }
  return count;
}

}  // namespace

AnimatedJoints read_joint_animations(const FileBytes& file, const Monitor& monitor) {
  const auto format = surface_format_of(file);
  if (format == SurfaceFormat::fbx) return read_fbx_joint_animations(file, monitor);
  if (format == SurfaceFormat::dae) return read_dae_joint_animations(file, monitor);
  return {};
}

FileJoints count_joints(const FileBytes& file, const Monitor& monitor) {
  const auto format = surface_format_of(file);
  if (format == SurfaceFormat::fbx) return count_fbx_joints(file);
  if (format == SurfaceFormat::dae) return count_dae_joints(file, monitor);
  return {};
}

}  // namespace curveskel
