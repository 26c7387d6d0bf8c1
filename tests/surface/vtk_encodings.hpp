// The box of `encodings` in VTK's formats, in every way in which VTK writes them.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/surface/encodings.hpp"

namespace curveskel::encodings {

struct VtkXml {
  bool big_endian = false;
  bool wide_header = false;
  bool zipped = false;
  std::string format = "ascii";  ///< or "binary", "appended", "raw" (appended, as bytes)
};

/// One .vtp under construction.
class VtpWriter {
 public:
  explicit VtpWriter(VtkXml how) : how_(std::move(how)) {}

  /// One DataArray of doubles, floats, 64-bit or 32-bit integers.
  template <typename Value>
  std::string array(const std::string& name, const std::string& type,
                    const std::vector<Value>& values) {
    std::string element = "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"" +
                          (how_.format == "raw" ? "appended" : how_.format) + "\"";
    if (how_.format == "ascii") {
      std::string text;
      for (const Value value : values) text += std::to_string(value) + " ";
      return element + ">\n" + text + "\n</DataArray>\n";
    }
    std::string bytes;
    for (const Value value : values) append(bytes, value, how_.big_endian);
    const std::string packed = blocks(bytes);
    if (how_.format == "binary") return element + ">\n" + packed + "\n</DataArray>\n";
    element += " offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
    appended_ += packed;
    return element;
  }

  [[nodiscard]] std::string file(const std::string& body) const {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\"";
    text += how_.big_endian ? " byte_order=\"BigEndian\"" : " byte_order=\"LittleEndian\"";
    text += how_.wide_header ? " header_type=\"UInt64\"" : " header_type=\"UInt32\"";
    if (how_.zipped) text += " compressor=\"vtkZLibDataCompressor\"";
    text += ">\n<PolyData>\n" + body + "</PolyData>\n";
    if (!appended_.empty()) {
      const std::string encoding = how_.format == "raw" ? "raw" : "base64";
      text += "<AppendedData encoding=\"" + encoding + "\">\n_" + appended_ + "\n</AppendedData>\n";
    }
    return text + "</VTKFile>\n";
  }

 private:
  void append_size(std::string& bytes, std::size_t size) const {
    if (how_.wide_header) {
      append(bytes, static_cast<std::uint64_t>(size), how_.big_endian);
    } else {
      append(bytes, static_cast<std::uint32_t>(size), how_.big_endian);
    }
  }
  [[nodiscard]] std::string encoded(const std::string& bytes) const {
    return how_.format == "raw" ? bytes : base64(bytes);
  }
  [[nodiscard]] std::string blocks(const std::string& bytes) const {
    std::string header;
    if (!how_.zipped) {
      append_size(header, bytes.size());
      return encoded(header + bytes);
    }
    constexpr std::size_t block_bytes = 64;
    const std::size_t count = (bytes.size() + block_bytes - 1) / block_bytes;
    append_size(header, count);
    append_size(header, block_bytes);
    append_size(header, bytes.size() % block_bytes);
    std::string data;
    for (std::size_t b = 0; b < count; ++b) {
      const std::string block = bytes.substr(b * block_bytes, block_bytes);
      std::string packed(compressBound(block.size()), '\0');
      uLongf length = packed.size();
      compress(reinterpret_cast<Bytef*>(packed.data()), &length,
               reinterpret_cast<const Bytef*>(block.data()), block.size());
      data.append(packed, 0, length);
      append_size(header, length);
    }
    return encoded(header) + encoded(data);
  }

  VtkXml how_;
  std::string appended_;
};

/// In two pieces: the first three quads as polygons, the others as strips of two triangles.
inline std::string vtp(const VtkXml& how, bool as_strips) {
  VtpWriter writer(how);
  std::string body;
  for (std::size_t part = 0; part < 2; ++part) {
    std::vector<double> points;
    for (const auto& p : corners) points.insert(points.end(), p.begin(), p.end());
    std::vector<std::int64_t> connectivity;
    std::vector<std::int32_t> offsets;
    for (std::size_t q = 3 * part; q < 3 * part + 3; ++q) {
      const auto& v = quads[q];
      if (as_strips) {
        connectivity.insert(connectivity.end(), {v[1], v[2], v[0], v[3]});
      } else {
        connectivity.insert(connectivity.end(), v.begin(), v.end());
      }
      offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
    }
    body += "<Piece NumberOfPoints=\"8\">\n<PointData/>\n<Points>\n" +
            writer.array("Points", "Float64", points) + "</Points>\n";
    const std::string cells = as_strips ? "Strips" : "Polys";
    body += "<Verts></Verts>\n<" + cells + ">\n";
    body += writer.array("connectivity", "Int64", connectivity);
    body += writer.array("offsets", "Int32", offsets) + "</" + cells + ">\n</Piece>\n";
  }
  return writer.file(body);
}

inline std::string vtk_numbers(bool binary, const std::vector<int>& values, bool as_floats) {
  std::string bytes;
  for (const int value : values) {
    if (!binary) bytes += std::to_string(value) + " ";
    if (binary && as_floats) append(bytes, static_cast<float>(value), true);
    if (binary && !as_floats) append(bytes, std::int32_t{value}, true);
  }
  return bytes + "\n";
}

/// `version` 2 has cells with their sizes, 5 offsets and connectivity.
inline std::string vtk(bool binary, int version) {
  std::string bytes = "# vtk DataFile Version " + std::to_string(version) + ".0\na box\n";
  bytes += binary ? "BINARY\n" : "ASCII\n";
  bytes += "FIELD FieldData 1\nTIME 1 1 float\n" + vtk_numbers(binary, {1}, true);
  bytes += "DATASET POLYDATA\nPOINTS 8 float\n";
  std::vector<int> points;
  for (const auto& p : corners) points.insert(points.end(), p.begin(), p.end());
  bytes += vtk_numbers(binary, points, true);
  bytes += "METADATA\nINFORMATION 0\n\nVERTICES ";
  std::vector<int> list;
  std::vector<int> connectivity;
  std::vector<int> offsets{0};
  for (const auto& q : quads) {
    list.push_back(4);
    list.insert(list.end(), q.begin(), q.end());
    connectivity.insert(connectivity.end(), q.begin(), q.end());
    offsets.push_back(static_cast<int>(connectivity.size()));
  }
  if (version < 5) {
    bytes += "1 2\n" + vtk_numbers(binary, {1, 0}, false);
    bytes += "POLYGONS 6 30\n" + vtk_numbers(binary, list, false);
  } else {
    bytes += "2 1\nOFFSETS vtktypeint32\n" + vtk_numbers(binary, {0, 1}, false);
    bytes += "CONNECTIVITY vtktypeint32\n" + vtk_numbers(binary, {0}, false);
    bytes += "POLYGONS 7 24\nOFFSETS vtktypeint32\n" + vtk_numbers(binary, offsets, false);
    bytes += "CONNECTIVITY vtktypeint32\n" + vtk_numbers(binary, connectivity, false);
  }
  return bytes + "POINT_DATA 8\nNORMALS n float\n";
}

/// With arrays of bits and strings among the fields; strings of 5 and 70 bytes.
inline std::string vtk_with_other_fields(bool binary) {
  std::string fields = "FIELD FieldData 3\nflags 1 9 bit\n";
  fields += binary ? "\xAA\x80\n" : "1 0 1 0 1 0 1 0 1\n";
  fields += "names 1 2 string\n";
  const std::string name = "hello";
  const std::string longer(70, 'x');
  fields += binary ? "\xC5" + name + "\x80\x46" + longer + "\n" : name + "\n" + longer + "\n";
  return with(vtk(binary, 3), "FIELD FieldData 1\n", fields);
}

/// Keywords and types in lower case, behind the title.
inline std::string vtk_in_lower_case() {
  std::string bytes = vtk(false, 3);
  const std::size_t title = bytes.find("ASCII");
  std::transform(bytes.begin() + static_cast<std::ptrdiff_t>(title), bytes.end(),
                 bytes.begin() + static_cast<std::ptrdiff_t>(title), [](unsigned char c) {
                   return static_cast<char>(c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c);
                 });
  return bytes;
}

inline std::vector<Encoding> all_of_vtk() {
  std::vector<Encoding> result{
      {"vtk_other_fields_text", ".vtk", vtk_with_other_fields(false)},
      {"vtk_other_fields_binary", ".vtk", vtk_with_other_fields(true)},
      {"vtk_in_lower_case", ".vtk", vtk_in_lower_case()},
      {"vtp_with_signs", ".vtp", with(vtp({}, false), " 1.0", " +1.0")},
  };
  for (const bool binary : {false, true}) {
    for (const int version : {2, 5}) {
      result.push_back({"vtk_" + std::to_string(version) + (binary ? "_binary" : "_text"), ".vtk",
                        vtk(binary, version)});
    }
  }
  for (const std::string format : {"ascii", "binary", "appended", "raw"}) {
    for (const bool big : {false, true}) {
      for (const bool wide : {false, true}) {
        for (const bool zipped : {false, true}) {
          if (format == "ascii" && (big || wide || zipped)) continue;
          const std::string name = "vtp_" + format + (big ? "_big" : "") + (wide ? "_wide" : "") +
                                   (zipped ? "_zipped" : "");
          result.push_back({name, ".vtp", vtp({big, wide, zipped, format}, false)});
        }
      }
    }
  }
  return result;
}

}  // namespace curveskel::encodings
