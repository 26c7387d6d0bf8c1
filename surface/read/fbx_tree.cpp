#include "surface/read/fbx_tree.hpp"

#include <fast_float/fast_float.h>
#include <zlib.h>

#include <cstring>
#include <system_error>

#include "base/memory.hpp"
#include "surface/read/binary_cursor.hpp"

namespace curveskel {
namespace {

std::size_t bytes_of(char type) {
  switch (type) {
    case 'd':
    case 'l':
      return 8;
    case 'f':
    case 'i':
      return 4;
    default:
      return 1;
  }
}

FileBytes unpacked_array(const FileBytes& file, const FbxRecord& record, const FbxArray& array) {
  constexpr std::size_t most_expanded = 1032;  // of deflate
  const std::size_t size = bytes_of(array.type) * array.count;
  FileBytes result{file.path, {}};
  if (!array.zipped) {
    result.content = array.bytes;
  } else if (size / most_expanded <= array.bytes.size()) {
    require_memory(9 * static_cast<double>(array.count), available_memory_bytes(),
                   file.path.string(), Fault::input,
                   "it is too large for this machine, or no honest file");
    result.content.resize(size);
    auto length = static_cast<uLongf>(size);
    const int code = uncompress(reinterpret_cast<Bytef*>(result.content.data()), &length,
                                reinterpret_cast<const Bytef*>(array.bytes.data()),
                                static_cast<uLong>(array.bytes.size()));
    if (code != Z_OK) length = 0;
    result.content.resize(length);
  }
  if (result.content.size() != size) {
    file.fail("an array \"" + std::string(record.name) + "\" at byte " +
                  std::to_string(record.position) + " that does not unpack",
              std::to_string(size) + " bytes in it", fbx_remedy);
  }
  return result;
}

double take_fbx_number(BinaryCursor& bytes, char type) {
  switch (type) {
    case 'd':
      return bytes.take<double>();
    case 'f':
      return static_cast<double>(bytes.take<float>());
    case 'l':
      return static_cast<double>(bytes.take<std::int64_t>());
    case 'i':
      return bytes.take<std::int32_t>();
    default:
      return bytes.take<std::uint8_t>();
  }
}

/// Numbers between commas and blanks.
std::vector<double> numbers_in_text(const FileBytes& file, const FbxRecord& record,
                                    std::string_view text) {
  std::vector<double> result;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    while (at != end && (*at == ',' || *at == ' ' || (*at >= '\t' && *at <= '\r'))) ++at;
    if (at == end) return result;
    double value = 0;
    const auto [next, error] = fast_float::from_chars(at, end, value);
    if (error != std::errc()) {
      file.fail(in_quotes({at, static_cast<std::size_t>(end - at)}) + " in the array \"" +
                    std::string(record.name) + "\" at byte " + std::to_string(record.position),
                "a number", fbx_remedy);
    }
    result.push_back(value);
    at = next;
  }
}

}  // namespace

const FbxRecord* FbxRecord::child(std::string_view child_name) const {
  for (const FbxRecord& record : children) {
    if (record.name == child_name) return &record;
  }
  return nullptr;
}

double FbxRecord::number(std::size_t i, double otherwise) const {
  if (i >= values.size()) return otherwise;
  if (const auto* value = std::get_if<double>(&values[i])) return *value;
  if (const auto* value = std::get_if<std::int64_t>(&values[i])) return static_cast<double>(*value);
  return otherwise;
}

std::int64_t FbxRecord::integer(std::size_t i, std::int64_t otherwise) const {
  if (i >= values.size()) return otherwise;
  const auto* value = std::get_if<std::int64_t>(&values[i]);
  return value == nullptr ? otherwise : *value;
}

std::string_view FbxRecord::text(std::size_t i) const {
  if (i >= values.size()) return {};
  const auto* value = std::get_if<std::string_view>(&values[i]);
  return value == nullptr ? std::string_view{} : *value;
}

std::vector<double> fbx_numbers(const FileBytes& file, const FbxRecord& record) {
  std::vector<double> result;
  for (const FbxValue& value : record.values) {
    if (const auto* array = std::get_if<FbxArray>(&value)) {
      if (array->type == 't') return numbers_in_text(file, record, array->bytes);
      const FileBytes plain = unpacked_array(file, record, *array);
      BinaryCursor bytes(plain, 0, std::endian::little);
      result.reserve(array->count);
      for (std::size_t i = 0; i < array->count; ++i) {
        result.push_back(take_fbx_number(bytes, array->type));
      }
      return result;
    }
  }
  for (std::size_t i = 0; i < record.values.size(); ++i) result.push_back(record.number(i, 0));
  return result;
}

FbxRecord parse_fbx(const FileBytes& file) {
  return is_binary_fbx(file) ? parse_binary_fbx(file) : parse_text_fbx(file);
}

}  // namespace curveskel
