#include "rig/gltf/vrm.hpp"

#include <tiny_gltf.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/error.hpp>
#include "base/utf8.hpp"
#include "rig/gltf/gltf_document.hpp"
#include "rig/gltf/skin_numbers.hpp"
#include "rig/joints/figure_name.hpp"
#include "surface/read/file_bytes.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/gltf_file.hpp"

namespace curveskel {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view extension = "VRMC_vrm";
constexpr std::string_view extension_0 = "VRM";  // of VRM 0.x

using Value = tinygltf::Value;

/// Null where there is none.
const Value& member(const Value& object, const std::string& name) {
  static const Value none;
  return object.Has(name) ? object.Get(name) : none;
}

const Value& member(const tinygltf::Model& model, std::string_view name) {
  static const Value none;
  const auto found = model.extensions.find(std::string(name));
  return found == model.extensions.end() ? none : found->second;
}

std::string text_of(const Value& value) {
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
  const Value& node = member(bone, "node");
  if (node.IsInt() && !role.empty()) roles.try_emplace(node.GetNumberAsInt(), role);
}

bool has_role(const Rig& rig, std::string_view role) {
  return std::find(rig.roles.begin(), rig.roles.end(), role) != rig.roles.end();
}

/// A human's roles are VRM's words; joints without one, and those of a scene's other figures, have
/// none there either.
Json bones_of(const Rig& rig, const std::vector<int>& nodes) {
  Json bones = Json::object();
  for (std::size_t joint = 0; joint < rig.roles.size(); ++joint) {
    const std::string& role = rig.roles[joint];
    if (role.empty() || of_figure(role).figure > 0) continue;
    bones[role] = {{"node", nodes.at(joint)}};
  }
  return bones;
}

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// True for an absolute address of the web, which a link in another program opens.
bool is_web_address(std::string_view text) {
  std::size_t host = 0;
  for (const std::string_view scheme : {"https://", "http://"}) {
    if (text.starts_with(scheme)) host = scheme.size();
  }
  const auto is_space = [](char letter) { return static_cast<unsigned char>(letter) <= ' '; };
  return host > 0 && host < text.size() && text[host] != '/' &&
         std::none_of(text.begin(), text.end(), is_space);
}

void require_web_address(const std::string& licence) {
  if (is_web_address(licence)) return;
  throw Error(Fault::usage,
              "--vrm-licence: found '" + licence +
                  "', needed the address of the licence's text, beginning with https:// or "
                  "http://; VRM's own is https://vrm.dev/licenses/1.0/");
}

Json texts_of(const VrmMeta& meta) {
  return {{"name", as_utf8(meta.name)},
          {"authors", Json::array({as_utf8(meta.author)})},
          {"licenseUrl", as_utf8(meta.licence_url)}};
}

/// What is not given stays, and so do the authors after the first.
void replace_texts(Json& meta, const VrmMeta& given) {
  if (!given.licence_url.empty()) require_web_address(given.licence_url);
  if (!meta.is_object()) meta = Json::object();
  const Json texts = texts_of(given);
  if (!given.name.empty()) meta["name"] = texts["name"];
  if (!given.licence_url.empty()) meta["licenseUrl"] = texts["licenseUrl"];
  if (given.author.empty()) return;
  Json& authors = meta["authors"];
  if (!authors.is_array() || authors.empty()) authors = Json::array({""});
  authors[0] = texts["authors"][0];
}

}  // namespace

std::map<int, std::string> vrm_roles(const tinygltf::Model& model) {
  std::map<int, std::string> roles;
  const Value& bones = member(member(member(model, extension), "humanoid"), "humanBones");
  if (bones.IsObject()) {
    for (const std::string& role : bones.Keys()) add_role(roles, bones.Get(role), role);
    return roles;
  }
  const Value& old = member(member(member(model, extension_0), "humanoid"), "humanBones");
  for (std::size_t k = 0; old.IsArray() && k < old.ArrayLen(); ++k) {
    const Value& bone = old.Get(k);
    add_role(roles, bone, role_of_version_0(text_of(member(bone, "bone"))));
  }
  return roles;
}

std::optional<VrmOfFile> read_vrm(const std::filesystem::path& path, const Monitor& monitor) {
  const FileBytes file = read_file(path, monitor);
  if (!looks_like_glb(file) && !looks_like_gltf(file)) return std::nullopt;
  const tinygltf::Model model = parse_gltf(file, monitor);
  const Value& said = member(model, extension);
  if (!said.IsObject()) {
    if (!member(model, extension_0).IsObject()) return std::nullopt;
    return VrmOfFile{true, {}};
  }
  const Value& meta = member(said, "meta");
  const Value& authors = member(meta, "authors");
  const bool has_author = authors.IsArray() && authors.ArrayLen() > 0;
  return VrmOfFile{false,
                   {text_of(member(meta, "name")), has_author ? text_of(authors.Get(0)) : "",
                    text_of(member(meta, "licenseUrl"))}};
}

void require_whole(const VrmMeta& meta) {
  if (meta.name.empty() || meta.author.empty() || meta.licence_url.empty()) {
    throw Error(Fault::usage,
                "a .vrm file needs a name, an author and a licence: give --vrm-name, --vrm-author "
                "and --vrm-licence (the address of its text, as "
                "https://vrm.dev/licenses/1.0/)");
  }
  require_web_address(meta.licence_url);
}

void require_vrm(const Rig& rig, const VrmMeta& meta) {
  require_whole(meta);
  std::string missing;
  for (const char* role : required_human_roles) {
    if (!has_role(rig, role)) missing += (missing.empty() ? "" : ", ") + std::string(role);
  }
  if (missing.empty()) return;
  throw Error(Fault::input, "a .vrm file is of a human, found no " + missing +
                                "; see what was found (--report), say --plan humanoid, --up or "
                                "--front, or write .glb");
}

void add_vrm(Json& gltf, const Rig& rig, const std::vector<int>& nodes, const VrmMeta& meta) {
  Json& used = gltf["extensionsUsed"];
  if (std::find(used.begin(), used.end(), std::string(extension)) == used.end()) {
    used.push_back(std::string(extension));
  }
  gltf["extensions"][std::string(extension)] = {
      {"specVersion", "1.0"},
      {"humanoid", {{"humanBones", bones_of(rig, nodes)}}},
      {"meta", texts_of(meta)}};
}

void add_vrm(Json& gltf, const Rig& rig, const VrmMeta& meta) {
  add_vrm(gltf, rig, gltf.at("skins").back().at("joints").get<std::vector<int>>(), meta);
}

void keep_vrm(Json& gltf, const Rig& rig, const std::vector<int>& nodes, const VrmMeta& meta) {
  Json& extensions = gltf["extensions"];
  const auto has = [&](std::string_view name) {
    const auto found = extensions.find(std::string(name));
    return found != extensions.end() && found->is_object();
  };
  if (has(extension)) {
    replace_texts(extensions[std::string(extension)]["meta"], meta);
  } else if (!has(extension_0)) {
    require_vrm(rig, meta);
    add_vrm(gltf, rig, nodes, meta);
  }
}

std::string with_vrm(const std::string& glb, const Rig& rig, const VrmMeta& meta) {
  constexpr std::size_t head = 12;
  constexpr std::size_t chunk_head = 8;
  const std::size_t length = word_at(glb, head);
  Json gltf = Json::parse(glb.substr(head + chunk_head, length));
  add_vrm(gltf, rig, meta);
  const std::string rest = glb.substr(head + chunk_head + length);
  return glb_head(gltf.dump(), rest.size()) + rest;
}

}  // namespace curveskel
