#include "rig/gltf/vrm.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/error.hpp>
#include "base/utf8.hpp"
#include "rig/gltf/gltf_document.hpp"
#include "rig/gltf/skin_numbers.hpp"
#include "rig/joints/figure_name.hpp"

namespace curveskel {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view extension = "VRMC_vrm";

bool has_role(const Rig& rig, std::string_view role) {
  return std::find(rig.roles.begin(), rig.roles.end(), role) != rig.roles.end();
}

/// A human's roles are VRM's words; joints without one, and those of a scene's other figures, have
/// none there either.
Json bones_of(const Json& gltf, const Rig& rig) {
  const Json& nodes = gltf.at("skins").back().at("joints");
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

}  // namespace

void require_whole(const VrmMeta& meta) {
  if (meta.name.empty() || meta.author.empty() || meta.licence_url.empty()) {
    throw Error(Fault::usage,
                "a .vrm file needs a name, an author and a licence: give --vrm-name, --vrm-author "
                "and --vrm-licence (the address of its text, as "
                "https://vrm.dev/licenses/1.0/)");
  }
  if (!is_web_address(meta.licence_url)) {
    throw Error(Fault::usage,
                "--vrm-licence: found '" + meta.licence_url +
                    "', needed the address of the licence's text, beginning with https:// or "
                    "http://; VRM's own is https://vrm.dev/licenses/1.0/");
  }
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

void add_vrm(Json& gltf, const Rig& rig, const VrmMeta& meta) {
  Json& used = gltf["extensionsUsed"];
  if (std::find(used.begin(), used.end(), std::string(extension)) == used.end()) {
    used.push_back(std::string(extension));
  }
  gltf["extensions"][std::string(extension)] = {{"specVersion", "1.0"},
                                                {"humanoid", {{"humanBones", bones_of(gltf, rig)}}},
                                                {"meta",
                                                 {{"name", as_utf8(meta.name)},
                                                  {"authors", Json::array({as_utf8(meta.author)})},
                                                  {"licenseUrl", as_utf8(meta.licence_url)}}}};
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
