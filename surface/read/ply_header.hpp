// The header of a PLY file: which elements follow, with which properties, in which encoding.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/read/file_bytes.hpp"

namespace curveskel {

enum class PlyEncoding { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Bytes of one value in a binary file.
[[nodiscard]] std::size_t bytes_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  ///< of a list: of its items
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< lists only
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Bytes that one row takes at least (exactly, if there is no list).
  [[nodiscard]] std::int64_t least_row_bytes(PlyEncoding encoding) const;
  [[nodiscard]] bool has_list() const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t data_begin = 0;  ///< where in the content the first element starts
};

/// Throws Error(Fault::input), also where the counts cannot fit into the file.
[[nodiscard]] PlyHeader read_ply_header(const FileBytes& file);

}  // namespace curveskel
