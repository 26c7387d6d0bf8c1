#include "rig/gltf/vrm.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/error.hpp>
#include <curveskel/role_names.hpp>
#include "base/utf8.hpp"
#include "rig/gltf/gltf_document.hpp"
#include "rig/gltf/read_vrm.hpp"
#include "rig/gltf/skin_numbers.hpp"

namespace curveskel {
namespace {

using Json = nlohmann::ordered_json;

bool has_role(const Rig& rig, std::string_view role) {
  return std::find(rig.roles.begin(), rig.roles.end(), role) != rig.roles.end();
}

/// A human's roles are VRM's words; joints of other roles, and those of a scene's other figures,
/// have none there, as programs refuse a file with other bones. Of several joints with one role the
/// first is the bone, as where VRM is read.
Json bones_of(const Rig& rig, const std::vector<int>& nodes) {
  const std::vector<std::string> human = roles_of(BodyKind::humanoid);
  Json bones = Json::object();
  for (std::size_t joint = 0; joint < rig.roles.size(); ++joint) {
    const std::string& role = rig.roles[joint];
    const bool is_bone = std::find(human.begin(), human.end(), role) != human.end();
    if (!is_bone || bones.contains(role)) continue;
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

/// Texts that are not given stay, and so do the authors after the first.
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
  if (std::find(used.begin(), used.end(), std::string(vrm_extension)) == used.end()) {
    used.push_back(std::string(vrm_extension));
  }
  gltf["extensions"][std::string(vrm_extension)] = {
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
  if (has(vrm_extension)) {
    replace_texts(extensions[std::string(vrm_extension)]["meta"], meta);
  } else if (!has(vrm_0_extension)) {
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
