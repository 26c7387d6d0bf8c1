#include "rig/gltf/read_vrm.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <curveskel/rig_files.hpp>
#include "surface/read/file_bytes.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/gltf_file.hpp"

namespace curveskel {
namespace {

using Value = tinygltf::Value;

/// Null where there is none.
const Value& vrm_member(const Value& object, const std::string& name) {
  static const Value none;
  return object.Has(name) ? object.Get(name) : none;
}

const Value& vrm_member(const tinygltf::Model& model, std::string_view name) {
  static const Value none;
  const auto found = model.extensions.find(std::string(name));
  return found == model.extensions.end() ? none : found->second;
}

std::string vrm_text(const Value& value) {
  return value.IsString() ? value.Get<std::string>() : std::string();
}

/// VRM 0.x counts the joints of a thumb as those of the other fingers.
std::string role_of_version_0(std::string bone) {
  for (const char* const side : {"left", "right"}) {
    for (const auto& [old, now] : {std::pair{"ThumbProximal", "ThumbMetacarpal"},
                                   std::pair{"ThumbIntermediate", "ThumbProximal"}}) {
      if (bone == std::string(side) + old) return std::string(side) + now;
    }
  }
  return bone;
}

void add_role(std::map<int, std::string>& roles, const Value& bone, const std::string& role) {
  const Value& node = vrm_member(bone, "node");
  if (node.IsInt() && !role.empty()) roles.try_emplace(node.GetNumberAsInt(), role);
}

}  // namespace

std::map<int, std::string> vrm_roles(const tinygltf::Model& model) {
  std::map<int, std::string> roles;
  const Value& bones =
      vrm_member(vrm_member(vrm_member(model, vrm_extension), "humanoid"), "humanBones");
  if (bones.IsObject()) {
    for (const std::string& role : bones.Keys()) add_role(roles, bones.Get(role), role);
    return roles;
  }
  const Value& old =
      vrm_member(vrm_member(vrm_member(model, vrm_0_extension), "humanoid"), "humanBones");
  for (std::size_t k = 0; old.IsArray() && k < old.ArrayLen(); ++k) {
    const Value& bone = old.Get(k);
    add_role(roles, bone, role_of_version_0(vrm_text(vrm_member(bone, "bone"))));
  }
  return roles;
}

std::optional<VrmOfFile> read_vrm(const std::filesystem::path& path, const Monitor& monitor) {
  const FileBytes file = read_file(path, monitor);
  if (!looks_like_glb(file) && !looks_like_gltf(file)) return std::nullopt;
  const tinygltf::Model model = parse_gltf(file, monitor);
  const Value& said = vrm_member(model, vrm_extension);
  if (!said.IsObject()) {
    if (!vrm_member(model, vrm_0_extension).IsObject()) return std::nullopt;
    return VrmOfFile{true, {}};
  }
  const Value& meta = vrm_member(said, "meta");
  const Value& authors = vrm_member(meta, "authors");
  const bool has_author = authors.IsArray() && authors.ArrayLen() > 0;
  return VrmOfFile{false,
                   {vrm_text(vrm_member(meta, "name")), has_author ? vrm_text(authors.Get(0)) : "",
                    vrm_text(vrm_member(meta, "licenseUrl"))}};
}

}  // namespace curveskel
