// FBX's binary form: records with the place of their end, little-endian; the end and the counts
// have 64 bits from version 7500 on.
#include <string>

#include "surface/read/binary_cursor.hpp"
#include "surface/read/fbx_tree.hpp"

namespace curveskel {
namespace {

constexpr std::string_view fbx_magic("Kaydara FBX Binary  \0", 21);
constexpr std::size_t version_begin = 23;
constexpr std::uint32_t first_wide_version = 7500;

class FbxBinaryReader {
 public:
  explicit FbxBinaryReader(const FileBytes& file)
      : file_(file), bytes_(file, version_begin, std::endian::little) {}

  FbxRecord read() {
    wide_ = bytes_.take<std::uint32_t>() >= first_wide_version;
    FbxRecord root;
    read_children(root, file_.content.size(), 0);
    return root;
  }

 private:
  std::size_t take_count() {
    return wide_ ? static_cast<std::size_t>(bytes_.take<std::uint64_t>())
                 : std::size_t{bytes_.take<std::uint32_t>()};
  }

  /// Up to `end`, or to the record of zeros that ends a list.
  void read_children(FbxRecord& parent, std::size_t end, int depth) {
    const std::size_t header = (wide_ ? 24 : 12) + 1;
    // The list of all records must have its end, others may do without.
    while (depth == 0 || end - bytes_.place() >= header) {
      FbxRecord record;
      record.position = bytes_.place();
      const std::size_t record_end = take_count();
      const std::size_t values = take_count();
      const std::size_t value_bytes = take_count();
      const auto name_bytes = std::size_t{bytes_.take<std::uint8_t>()};
      if (record_end == 0) return;
      record.name = take_text(name_bytes);
      const std::size_t values_begin = bytes_.place();
      if (record_end > end || record_end < values_begin ||
          value_bytes > record_end - values_begin || values > value_bytes ||
          depth > deepest_fbx_record) {
        file_.fail(
            "a record at byte " + std::to_string(record.position) + " that runs past what holds it",
            "one that ends within", fbx_remedy);
      }
      for (std::size_t i = 0; i < values; ++i) record.values.push_back(take_value());
      if (bytes_.place() != values_begin + value_bytes) {
        file_.fail("values up to byte " + std::to_string(bytes_.place()) + " in the record at " +
                       std::to_string(record.position),
                   "up to byte " + std::to_string(values_begin + value_bytes), fbx_remedy);
      }
      read_children(record, record_end, depth + 1);
      bytes_.skip(record_end - bytes_.place());
      parent.children.push_back(std::move(record));
    }
  }

  std::string_view take_text(std::size_t length) {
    const std::size_t begin = bytes_.place();
    bytes_.skip(length);
    return std::string_view(file_.content).substr(begin, length);
  }

  FbxValue take_value() {
    const std::size_t place = bytes_.place();
    const char type = bytes_.take<char>();
    switch (type) {
      case 'C':
      case 'B':
        return std::int64_t{bytes_.take<std::uint8_t>() & 1};
      case 'Y':
        return std::int64_t{bytes_.take<std::int16_t>()};
      case 'I':
        return std::int64_t{bytes_.take<std::int32_t>()};
      case 'L':
        return bytes_.take<std::int64_t>();
      case 'F':
        return static_cast<double>(bytes_.take<float>());
      case 'D':
        return bytes_.take<double>();
      case 'S':
      case 'R':
        return take_text(bytes_.take<std::uint32_t>());
      case 'f':
      case 'd':
      case 'l':
      case 'i':
      case 'b':
      case 'c': {
        FbxArray array{type, bytes_.take<std::uint32_t>(), bytes_.take<std::uint32_t>() == 1, {}};
        array.bytes = take_text(bytes_.take<std::uint32_t>());
        return array;
      }
      default:
        file_.fail("a value of type " + in_quotes({&type, 1}) + " at byte " + std::to_string(place),
                   "one of C, Y, I, L, F, D, S, R, f, d, l, i, b and c", fbx_remedy);
    }
  }

  const FileBytes& file_;
  BinaryCursor bytes_;
  bool wide_ = false;
};

}  // namespace

bool is_binary_fbx(const FileBytes& file) { return file.content.starts_with(fbx_magic); }

FbxRecord parse_binary_fbx(const FileBytes& file) {
  if (file.content.size() < version_begin) {
    file.fail(std::to_string(file.content.size()) + " bytes", "a version behind FBX's mark",
              fbx_remedy);
  }
  return FbxBinaryReader(file).read();
}

}  // namespace curveskel
