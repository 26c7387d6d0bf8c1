// Files that are no surface which this program reads, by name. For surface/ and skeleton/io/.
#pragma once

#include <optional>
#include <string_view>

#include "surface/read/file_bytes.hpp"

namespace curveskel {

struct ForeignFormat {
  std::string_view start;   ///< of the file, or of one of its elements
  std::string_view name;    ///< with its article
  std::string_view remedy;  ///< of one who has it for a surface
};

/// The kind of the file, if its first bytes tell.
[[nodiscard]] std::optional<ForeignFormat> foreign_format_of(const FileBytes& file);

/// Throws Error(Fault::input) for a skeleton or a rig that this program wrote as JSON.
void refuse_own_json(const FileBytes& file);

/// Throws Error(Fault::input) for a name that is a skeleton's alone; the content tells nothing.
void refuse_skeleton(const FileBytes& file);

/// Throws Error(Fault::input) that says what the file is, if its first bytes tell.
void refuse_foreign_format(const FileBytes& file);

}  // namespace curveskel
