#include "rig/gltf/gltf_node_numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <curveskel/advanced/file_names.hpp>
#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

constexpr std::string_view pointer_start = "/nodes/";

void renumber_list(OrderedJson& owner, const std::string& name, const std::vector<int>& new_node) {
  const auto list = owner.find(name);
  if (list == owner.end()) return;
  OrderedJson kept = OrderedJson::array();
  for (const OrderedJson& node : *list) {
    const int number = new_node.at(node.get<std::size_t>());
    if (number >= 0) kept.push_back(number);
  }
  if (kept.empty()) {
    owner.erase(name);  // the standard has no empty lists
  } else {
    *list = std::move(kept);
  }
}

/// Of a pointer into the nodes of the file; the text behind the number goes to `rest`.
std::optional<std::size_t> node_of_pointer(std::string_view pointer, std::string_view& rest) {
  if (!pointer.starts_with(pointer_start)) return std::nullopt;
  const std::string_view behind = pointer.substr(pointer_start.size());
  std::size_t node = 0;
  const auto [end, error] = std::from_chars(behind.data(), behind.data() + behind.size(), node);
  if (error != std::errc()) return std::nullopt;
  rest = behind.substr(static_cast<std::size_t>(end - behind.data()));
  return node;
}

/// False: its node is gone.
bool renumber_channel(OrderedJson& channel, const std::vector<int>& new_node) {
  OrderedJson& target = channel.at("target");
  if (target.contains("node")) {
    const int number = new_node.at(target["node"].get<std::size_t>());
    target["node"] = number;
    return number >= 0;
  }
  const OrderedJson::json_pointer place("/extensions/KHR_animation_pointer/pointer");
  if (!target.contains(place) || !target[place].is_string()) return true;
  const std::string pointer = target[place];
  std::string_view rest;
  const auto node = node_of_pointer(pointer, rest);
  if (!node || *node >= new_node.size()) return true;
  target[place] = std::string(pointer_start) + std::to_string(new_node[*node]) + std::string(rest);
  return new_node[*node] >= 0;
}

int renumber_animations(OrderedJson& file, const std::vector<int>& new_node) {
  if (!file.contains("animations")) return 0;
  int gone = 0;
  OrderedJson animations = OrderedJson::array();
  for (OrderedJson& moving : file["animations"]) {
    OrderedJson kept = OrderedJson::array();
    for (OrderedJson& channel : moving.at("channels")) {
      if (renumber_channel(channel, new_node)) {
        kept.push_back(std::move(channel));
      } else {
        ++gone;
      }
    }
    moving["channels"] = std::move(kept);
    if (!moving["channels"].empty()) animations.push_back(std::move(moving));
  }
  if (animations.empty()) {
    file.erase("animations");
  } else {
    file["animations"] = std::move(animations);
  }
  return gone;
}

bool names_nodes(const std::string& name) {
  constexpr std::array<std::string_view, 3> parts{"node", "bone", "joint"};
  constexpr std::array<std::string_view, 3> whole{"source", "center", "ids"};
  const std::string key = in_lower_case(name);
  return std::find(whole.begin(), whole.end(), key) != whole.end() ||
         std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return key.find(part) != key.npos; });
}

/// A number, or a list with one, under a key that speaks of nodes; or a pointer to one. Depth is
/// limited by the reader.
bool mentions_nodes(const OrderedJson& value) {
  if (value.is_string()) return value.get_ref<const std::string&>().starts_with(pointer_start);
  if (!value.is_structured()) return false;
  for (const auto& [key, member] : value.items()) {
    const bool is_number = member.is_number_integer() ||
                           (member.is_array() && !member.empty() && member[0].is_number_integer());
    if (value.is_object() && is_number && names_nodes(key)) return true;
    if (mentions_nodes(member)) return true;
  }
  return false;
}

void refuse_extensions_of(const OrderedJson& owner, const FileBytes& file) {
  const auto extensions = owner.find("extensions");
  if (extensions == owner.end() || !extensions->is_object()) return;
  for (const auto& [name, extension] : extensions->items()) {
    if (!mentions_nodes(extension)) continue;
    file.fail("the extension " + in_quotes(name) + ", which names nodes of the rig that is there",
              "a file whose old rig can go, or one without a rig",
              "use --keep-rig (weights for the joints that are there) or --bare (the surface "
              "alone), or export the file without that extension");
  }
}

}  // namespace

int renumber_nodes(GltfDocument& document, const std::vector<int>& new_node) {
  OrderedJson& file = document.json;
  OrderedJson nodes = OrderedJson::array();
  for (std::size_t i = 0; i < file["nodes"].size(); ++i) {
    if (new_node[i] < 0) continue;
    renumber_list(file["nodes"][i], "children", new_node);
    nodes.push_back(std::move(file["nodes"][i]));
  }
  file["nodes"] = std::move(nodes);
  for (const char* owners : {"scenes", "skins"}) {
    if (!file.contains(owners)) continue;
    const bool are_scenes = std::string_view(owners) == "scenes";
    for (OrderedJson& owner : file[owners]) {
      renumber_list(owner, are_scenes ? "nodes" : "joints", new_node);
      if (!owner.contains("skeleton")) continue;
      const int skeleton = new_node.at(owner["skeleton"].get<std::size_t>());
      owner["skeleton"] = skeleton;
      if (skeleton < 0) owner.erase("skeleton");
    }
  }
  return renumber_animations(file, new_node);
}

void refuse_node_numbers_in_extensions(const GltfDocument& document, const FileBytes& file) {
  refuse_extensions_of(document.json, file);
  for (const char* owners : {"scenes", "nodes"}) {
    const auto list = document.json.find(owners);
    if (list == document.json.end()) continue;
    for (const OrderedJson& owner : *list) refuse_extensions_of(owner, file);
  }
}

}  // namespace curveskel
