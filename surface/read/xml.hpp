// XML as the readers need it: names without prefixes, text in one piece, places for messages.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "surface/read/file_bytes.hpp"

namespace curveskel {

struct XmlElement {
  std::string name;  ///< without a namespace prefix
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;  ///< its direct text, entities resolved, comments left out
  std::vector<XmlElement> children;
  std::size_t position = 0;  ///< of its tag in the file's content

  /// The value of an attribute, `otherwise` where it is missing.
  [[nodiscard]] std::string_view attribute(std::string_view key,
                                           std::string_view otherwise = {}) const;
  /// The first child with that name, or nullptr.
  [[nodiscard]] const XmlElement* child(std::string_view child_name) const;
  /// All children with that name.
  [[nodiscard]] std::vector<const XmlElement*> all(std::string_view child_name) const;
};

/// The root element, as pugixml reads it: a DOCTYPE is passed over, and entities that it declares
/// stay as they are written. VTK's <AppendedData encoding="raw">, which is no XML, is taken as the
/// text up to its last end tag. No more than `deepest` elements may be nested.
/// Throws Error(Fault::input) with the line. O(bytes).
[[nodiscard]] XmlElement parse_xml(const FileBytes& file, int deepest = 64);

/// True if the file begins with a tag and has `mark` in its first lines.
[[nodiscard]] bool begins_as_xml(const FileBytes& file, std::string_view mark);

/// Throws Error(Fault::input) "FILE, line N: found FOUND, needed NEEDED; export the file again",
/// the line being the one of `position` in the file's content.
[[noreturn]] void fail_at(const FileBytes& file, std::size_t position, std::string_view found,
                          std::string_view needed);

}  // namespace curveskel
