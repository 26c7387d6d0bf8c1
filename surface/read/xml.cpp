#include "surface/read/xml.hpp"

#include <algorithm>
#include <pugixml.hpp>

namespace curveskel {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::string_view appended_data = "AppendedData";

std::string without_prefix(std::string_view name) {
  const std::size_t colon = name.find(':');
  return std::string(colon == std::string_view::npos ? name : name.substr(colon + 1));
}

/// The place in the file of VTK's raw data, which is no XML and is left out of what is parsed.
struct RawData {
  std::size_t begin = 0;
  std::size_t end = 0;  ///< begin = none
  /// The place in the file of a place in the text that is parsed.
  [[nodiscard]] std::size_t in_file(std::size_t place) const {
    return place < begin ? place : place + (end - begin);
  }
};

RawData raw_data(const FileBytes& file) {
  const std::string_view text = file.content;
  const std::size_t tag = text.find("<" + std::string(appended_data));
  const std::size_t tag_end = tag < text.size() ? text.find('>', tag) : tag;
  if (tag_end == std::string_view::npos) return {};
  pugi::xml_document element;
  const std::string alone = std::string(text.substr(tag, tag_end - tag)) + "/>";
  if (!element.load_buffer(alone.data(), alone.size()) ||
      std::string_view(element.document_element().attribute("encoding").value()) != "raw") {
    return {};
  }
  const std::size_t end = text.rfind("</" + std::string(appended_data));
  if (end == std::string_view::npos || end < tag_end) {
    fail_at(file, tag, "no end of the data", "</AppendedData>");
  }
  return {tag_end + 1, end};
}

/// The tag at a place in the text, or what else stands there.
std::string excerpt(std::string_view text, std::size_t place) {
  constexpr std::size_t most = 40;
  const std::size_t tag = text.substr(0, place + 1).rfind('<');
  if (tag != std::string_view::npos && place - tag < most) place = tag;
  return place >= text.size() ? "the end of the file" : in_quotes(text.substr(place, most));
}

/// The one element that is no other's.
pugi::xml_node root_of(const FileBytes& file, const RawData& raw,
                       const pugi::xml_document& document) {
  const pugi::xml_node root = document.document_element();
  if (!root) fail_at(file, 0, "no element", "one");
  for (const pugi::xml_node& other : document.children()) {
    const std::string_view text = other.value();
    const bool blank = text.find_first_not_of(blanks) == std::string_view::npos;
    if (other == root || (blank && other.type() != pugi::node_element)) continue;
    const std::size_t place = raw.in_file(static_cast<std::size_t>(other.offset_debug()));
    fail_at(file, place, excerpt(file.content, place), "one element and nothing beside it");
  }
  return root;
}

XmlElement element_of(const FileBytes& file, const RawData& raw, const pugi::xml_node& node,
                      int depth, int deepest) {
  XmlElement element;
  element.position = raw.in_file(static_cast<std::size_t>(node.offset_debug()));
  if (depth > deepest) {
    fail_at(file, element.position,
            "elements nested more than " + std::to_string(deepest) + " deep", "fewer");
  }
  element.name = without_prefix(node.name());
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    element.attributes.emplace_back(attribute.name(), attribute.value());
  }
  for (const pugi::xml_node& child : node.children()) {
    if (child.type() == pugi::node_element) {
      element.children.push_back(element_of(file, raw, child, depth + 1, deepest));
    } else {
      element.text += child.value();
    }
  }
  if (raw.begin < raw.end && element.name == appended_data) {
    element.text = file.content.substr(raw.begin, raw.end - raw.begin);
  }
  return element;
}

}  // namespace

std::string_view XmlElement::attribute(std::string_view key, std::string_view otherwise) const {
  for (const auto& [name_of, value] : attributes) {
    if (name_of == key) return value;
  }
  return otherwise;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  for (const XmlElement& element : children) {
    if (element.name == child_name) return &element;
  }
  return nullptr;
}

std::vector<const XmlElement*> XmlElement::all(std::string_view child_name) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement& element : children) {
    if (element.name == child_name) found.push_back(&element);
  }
  return found;
}

XmlElement parse_xml(const FileBytes& file, int deepest) {
  const RawData raw = raw_data(file);
  std::string joined;
  std::string_view text = file.content;
  if (raw.begin < raw.end) {
    joined.assign(text.substr(0, raw.begin)).append(text.substr(raw.end));
    text = joined;
  }
  const std::size_t zero = text.find('\0');
  if (zero != std::string_view::npos) fail_at(file, raw.in_file(zero), "a zero byte", "text");
  // Blanks between comments keep numbers apart; a fragment's text beside the root is seen, not
  // lost.
  constexpr unsigned options = pugi::parse_default | pugi::parse_ws_pcdata | pugi::parse_fragment;
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), options, pugi::encoding_utf8);
  if (!result) {
    const std::size_t at = raw.in_file(static_cast<std::size_t>(result.offset));
    fail_at(file, at, excerpt(file.content, at),
            std::string("sound XML (") + result.description() + ")");
  }
  return element_of(file, raw, root_of(file, raw, document), 0, deepest);
}

void fail_at(const FileBytes& file, std::size_t position, std::string_view found,
             std::string_view needed) {
  const std::string_view before = std::string_view(file.content).substr(0, position);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  throw Error(Fault::input, file.path.string() + ", line " + std::to_string(line) + ": found " +
                                std::string(found) + ", needed " + std::string(needed) +
                                "; correct it or export the file again");
}

bool begins_as_xml(const FileBytes& file, std::string_view mark) {
  constexpr std::size_t first_lines = 2000;
  const std::string_view text = std::string_view(file.content).substr(0, first_lines);
  const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return begin != std::string_view::npos && text[begin] == '<' &&
         text.find(mark) != std::string_view::npos;
}

}  // namespace curveskel
