// An FBX file as a tree of records, from its binary form or from text. Internal to surface/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// An array as it stands in the file: unpacked when it is asked for, as most are passed over.
struct FbxArray {
  char type = 't';  ///< f, d, l, i, b, or t for text
  std::size_t count = 0;
  bool zipped = false;
  std::string_view bytes;
};

using FbxValue = std::variant<std::int64_t, double, std::string_view, FbxArray>;

struct FbxRecord {
  std::string_view name;
  std::vector<FbxValue> values;
  std::vector<FbxRecord> children;
  std::size_t position = 0;  ///< in the file's content

  /// The first child with that name, or nullptr.
  [[nodiscard]] const FbxRecord* child(std::string_view child_name) const;
  /// Value number `i` as a number, or as text; `otherwise` where there is none of that kind.
  [[nodiscard]] double number(std::size_t i, double otherwise) const;
  [[nodiscard]] std::int64_t integer(std::size_t i, std::int64_t otherwise) const;
  [[nodiscard]] std::string_view text(std::size_t i) const;
};

/// All records of the file, below a root of no name; texts and arrays are views of the file, which
/// must outlive the tree. Throws Error(Fault::input) with the byte or the line. O(bytes).
[[nodiscard]] FbxRecord parse_fbx(const FileBytes& file);

/// The numbers of a record: of its array, or its values one by one. Throws Error(Fault::input).
[[nodiscard]] std::vector<double> fbx_numbers(const FileBytes& file, const FbxRecord& record);

/// True for FBX's binary form; else it is text.
[[nodiscard]] bool is_binary_fbx(const FileBytes& file);

/// The two forms.
[[nodiscard]] FbxRecord parse_binary_fbx(const FileBytes& file);
[[nodiscard]] FbxRecord parse_text_fbx(const FileBytes& file);

inline constexpr std::string_view fbx_remedy =
    "the file is truncated or broken: fetch or export it again";
inline constexpr int deepest_fbx_record = 64;

}  // namespace curveskel
