// One box, 1 by 2 by 3, in every encoding that the reader knows: what the tests of reading run
// over.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace curveskel::encodings {

/// Small integers, so that every number type of every format holds them exactly.
inline constexpr std::array<std::array<int, 3>, 8> corners{
    {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}}};
inline constexpr std::array<std::array<int, 4>, 6> quads{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

inline std::vector<std::array<int, 3>> triangles() {
  std::vector<std::array<int, 3>> result;
  for (const auto& q : quads) {
    result.push_back({q[0], q[1], q[2]});
    result.push_back({q[0], q[2], q[3]});
  }
  return result;
}

struct Encoding {
  std::string name;       ///< a valid C++ identifier
  std::string extension;  ///< with the dot
  std::string bytes;
  bool is_quads = true;  ///< otherwise `triangles()`

  friend void PrintTo(const Encoding& encoding, std::ostream* out) { *out << encoding.name; }
};

// ---- Text ---------------------------------------------------------------------------------------

inline std::string spaced(const std::array<int, 3>& p) {
  return std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]);
}

inline std::string obj() {
  std::string text = "# a box\nmtllib box.mtl\no box\n";
  for (const auto& p : corners) text.append("v ").append(spaced(p)).append("\n");
  for (const auto& q : quads) {
    text += "f";
    for (const int v : q) text += " " + std::to_string(v + 1);
    text += "\n";
  }
  return text;
}

/// CR LF, tabs, exponents, colours, vt and vn, negative indices, continued lines, indented lines.
inline std::string obj_with_everything() {
  std::string text =
      "\xEF\xBB\xBF# all that OBJ allows \\\r\ng left right\r\nvt 0 0\r\nvn 0 0 1\r\n";
  for (const auto& p : corners) {
    text += "  v\t" + std::to_string(10 * p[0]) + ".0e-1 \\\r\n +" + std::to_string(p[1]) + ".\t" +
            std::to_string(p[2]) + " 1.0 0.5 0.25\r\n";
  }
  text += "s off\r\nusemtl red\r\nvp 1 2\r\n";
  int face = 0;
  for (const auto& q : quads) {
    text += "f ";
    for (const int v : q) {
      const std::string index = std::to_string(v - static_cast<int>(corners.size()));
      const std::array<std::string, 4> forms{index, index + "/1", index + "//-1", index + "/1/1"};
      text += forms[static_cast<std::size_t>(face % 4)] + (v == q[1] ? " \\\r\n\t" : " ");
    }
    text += face++ % 2 == 0 ? "# comment\r\n" : "\r\n";
  }
  return text;
}

/// Corners with texture coordinates, the line continued directly behind the second one.
inline std::string obj_continued(const std::string& line_end) {
  std::string text;
  for (const auto& p : corners) text.append("v ").append(spaced(p)).append(line_end);
  for (const auto& q : quads) {
    text += "f";
    for (const int v : q) {
      text.append(" ").append(std::to_string(v + 1)).append("/1");
      if (v == q[1]) text.append("\\").append(line_end);
    }
    text += line_end;
  }
  return text;
}

/// Line ends, in order, stand behind the keyword, each count, each vertex and each face.
inline std::string off_lines(const std::string& keyword, const std::string& count,
                             const std::string& vertex, const std::string& face) {
  std::string text = "OFF" + keyword + "8" + count + "6" + count + "12" + count;
  for (const auto& p : corners) text += spaced(p) + vertex;
  for (const auto& q : quads) {
    text += "4";
    for (const int v : q) text += " " + std::to_string(v);
    text += face;
  }
  return text;
}

/// `extra` stands behind every position, `colour` behind every face.
inline std::string off(const std::string& header, const std::string& extra = {},
                       const std::string& colour = {}) {
  std::string text = header;
  for (const auto& p : corners) text += spaced(p) + extra + "\n";
  for (const auto& q : quads) {
    text += "4 " + std::to_string(q[0]) + " " + std::to_string(q[1]) + "  " + std::to_string(q[2]) +
            "\t" + std::to_string(q[3]) + colour + "\n";
  }
  return text;
}

inline std::string with(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

inline std::string stl_text() {
  std::string text;
  int facet = 0;
  for (const auto& t : triangles()) {
    if (facet == 0) text += "solid vertex 1 2 3\n";  // a name that looks like content
    if (facet++ == 6) text += "endsolid\nSOLID second\n";
    text += "  facet normal 0 0 0\n    OUTER LOOP\n";
    for (const int v : t) {
      text += "      vertex " + spaced(corners[static_cast<std::size_t>(v)]) + "\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid second\n";
}

// ---- Binary -------------------------------------------------------------------------------------

template <typename Value>
void append(std::string& bytes, Value value, bool big_endian = false) {
  std::array<char, sizeof(Value)> raw{};
  std::memcpy(raw.data(), &value, sizeof(Value));
  if (big_endian) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

inline std::string stl_binary(std::string_view header, std::uint32_t announced = 12) {
  std::string bytes(header);
  bytes.resize(80, ' ');
  append(bytes, announced);
  for (const auto& t : triangles()) {
    for (int k = 0; k < 3; ++k) append(bytes, 0.0F);
    for (const int v : t) {
      for (const int x : corners[static_cast<std::size_t>(v)]) {
        append(bytes, static_cast<float>(x));
      }
    }
    append(bytes, std::uint16_t{7});
  }
  return bytes;
}

/// `extra`: words of zero behind every position; Geomview's has a count of colours behind faces.
inline std::string off_binary(const std::string& keyword, int extra, bool geomview = true) {
  std::string bytes = keyword + " BINARY\n";
  for (const int count : {8, 6, 12}) append(bytes, std::int32_t{count}, geomview);
  for (const auto& p : corners) {
    for (const int x : p) append(bytes, static_cast<float>(x), geomview);
    for (int k = 0; k < extra; ++k) append(bytes, 0.0F, geomview);
  }
  for (const auto& q : quads) {
    append(bytes, std::int32_t{4}, geomview);
    for (const int v : q) append(bytes, std::int32_t{v}, geomview);
    if (!geomview) continue;
    const int colours = q[0] == 0 ? 4 : 0;
    append(bytes, std::int32_t{colours}, true);
    for (int k = 0; k < colours; ++k) append(bytes, 0.5F, true);
  }
  return bytes;
}

/// With a byte order mark; `text` is ASCII.
inline std::string utf16(const std::string& text, bool big_endian) {
  std::string bytes;
  append(bytes, std::uint16_t{0xFEFF}, big_endian);
  for (const char c : text) append(bytes, static_cast<std::uint16_t>(c), big_endian);
  return bytes;
}

// ---- PLY ----------------------------------------------------------------------------------------

/// Appends a number as PLY's type of this name, as text with a space when not `binary`.
struct PlyWriter {
  bool binary = true;
  bool big_endian = false;

  void operator()(std::string& bytes, const std::string& type, int value) const {
    if (!binary) {
      bytes += std::to_string(value) + " ";
    } else if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") {
      append(bytes, static_cast<std::int8_t>(value), big_endian);
    } else if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") {
      append(bytes, static_cast<std::int16_t>(value), big_endian);
    } else if (type == "float" || type == "float32") {
      append(bytes, static_cast<float>(value), big_endian);
    } else if (type == "double" || type == "float64") {
      append(bytes, static_cast<double>(value), big_endian);
    } else {
      append(bytes, std::int32_t{value}, big_endian);
    }
  }
};

/// With an element before the vertices, one between and one behind, properties round those that
/// count, and lists where none are expected.
inline std::string ply(const std::string& encoding, const std::string& coordinate,
                       const std::string& length, const std::string& index,
                       const std::string& line_end = "\n") {
  const PlyWriter write{encoding != "ascii", encoding == "binary_big_endian"};
  const std::string row_end = encoding == "ascii" ? line_end : "";
  std::string header = "ply\nformat " + encoding +
                       " 1.0\ncomment made for a test\nobj_info none\n"
                       "element camera 1\nproperty list uchar short view\nproperty float zoom\n"
                       "element vertex 8\nproperty uchar flag\nproperty " +
                       coordinate + " x\nproperty " + coordinate + " y\nproperty " + coordinate +
                       " z\nproperty list int float weights\n"
                       "element note 2\nproperty double value\n"
                       "element face 6\nproperty list uchar float texcoord\nproperty list " +
                       length + " " + index +
                       " vertex_indices\nproperty ushort group\n"
                       "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n";
  std::string text;
  for (const char c : header) text += c == '\n' ? line_end : std::string(1, c);
  write(text, "uchar", 2);
  for (const int v : {5, -6}) write(text, "short", v);
  write(text, "float", 1);
  text += row_end;
  for (const auto& p : corners) {
    write(text, "uchar", 1);
    for (const int x : p) write(text, coordinate, x);
    write(text, "int", p[0]);
    for (int i = 0; i < p[0]; ++i) write(text, "float", 9);
    text += row_end;
  }
  for (const int v : {1, 2}) {
    write(text, "double", v);
    text += row_end;
  }
  for (const auto& q : quads) {
    write(text, "uchar", 1);
    write(text, "float", 0);
    write(text, length, 4);
    for (const int v : q) write(text, index, v);
    write(text, "ushort", 3);
    text += row_end;
  }
  write(text, "int", 0);
  write(text, "int", 1);
  return text + row_end;
}

// ---- glTF ---------------------------------------------------------------------------------------

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto byte =
          i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : std::uint8_t{0};
      group = group << 8U | byte;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63U];
    }
  }
  return text;
}

/// 12 triangles of uint16 indices from byte 0, 8 positions of floats from byte 72.
inline std::string gltf_buffer() {
  std::string bytes;
  for (const auto& t : triangles()) {
    for (const int v : t) append(bytes, static_cast<std::uint16_t>(v));
  }
  for (const auto& p : corners) {
    for (const int x : p) append(bytes, static_cast<float>(x));
  }
  return bytes;
}

inline const std::string one_node = R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])";

/// `scene`: the members "scenes", "nodes" and others; `buffer`: those of the one buffer beside its
/// length; `primitive`: those beside the positions.
inline std::string gltf_json(const std::string& buffer, const std::string& scene = one_node,
                             const std::string& primitive = R"("indices": 0)") {
  return R"({"asset": {"version": "2.0"}, )" + scene +
         R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, )" + primitive +
         R"(}]}], "accessors": [
  {"bufferView": 0, "componentType": 5123, "count": 36, "type": "SCALAR"},
  {"bufferView": 1, "componentType": 5126, "count": 8, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 72},
                 {"buffer": 0, "byteOffset": 72, "byteLength": 96}],
 "buffers": [{)" +
         buffer + R"("byteLength": 168}]})";
}

inline std::string gltf_embedded(const std::string& scene = one_node) {
  return gltf_json(
      R"("uri": "data:application/octet-stream;base64,)" + base64(gltf_buffer()) + R"(", )", scene);
}

inline std::string glb() {
  std::string json = gltf_json("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string buffer = gltf_buffer();
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(28 + json.size() + buffer.size()));
  append(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append(bytes, static_cast<std::uint32_t>(buffer.size()));
  return bytes + std::string("BIN\0", 4) + buffer;
}

// ---- All ----------------------------------------------------------------------------------------

inline std::vector<Encoding> all() {
  std::string carriage_returns = obj();
  std::replace(carriage_returns.begin(), carriage_returns.end(), '\n', '\r');
  std::vector<Encoding> result{
      {"obj", ".obj", obj()},
      {"obj_with_everything", ".obj", obj_with_everything()},
      {"obj_of_old_macs", ".obj", carriage_returns},
      {"obj_in_utf16_little_endian", ".obj", utf16(obj(), false)},
      {"obj_in_utf16_big_endian", ".obj", utf16(obj(), true)},
      {"obj_continued_behind_texture", ".obj", obj_continued("\n")},
      {"obj_continued_behind_texture_crlf", ".obj", obj_continued("\r\n")},
      {"obj_with_faces_of_old", ".obj", with(obj(), "\nf ", "\nfo ")},
      {"obj_named_otherwise", ".off", obj()},
      {"off", ".off", off("OFF\n8 6 12\n")},
      {"off_counts_on_first_line", ".off", off("OFF 8 6 12\n")},
      {"off_without_keyword", ".off", off("8 6 12\n")},
      {"off_without_edge_count", ".off", off("OFF # comment\n\n# 1 2 3\n8 6\n")},
      {"off_counts_on_lines", ".off", off_lines("\n", "\n", "\n", "\n")},
      {"off_on_one_line", ".off", off_lines(" ", " ", " ", " ")},
      {"off_vertices_on_one_line", ".off", off_lines("\n", "\n", " ", "\n")},
      {"off_faces_on_one_line", ".off", off_lines("\n", " ", "\n", " ")},
      {"off_more_behind_vertices", ".off", off("OFF\n8 6 12\n", " 1 2 3", " 3 0.1 0.2 0.3")},
      {"off_colours", ".off", off("COFF\n8 6 12\n", " 255 0 0 255", " 3 0.1 0.2 0.3")},
      {"off_normals", ".off", off("NOFF\r\n8 6 12\r\n", " 0 0 1\r", " # c\r")},
      {"off_all_prefixes", ".off", off("STCNOFF\n8 6 0\n", " 0 0 1 9 9 9 9 0 0")},
      {"off_texture", ".off", off("STOFF\n8 6 0\n", " 0.5 0.5")},
      {"off_binary", ".off", off_binary("OFF", 0)},
      {"off_binary_all_prefixes", ".off", off_binary("STCNOFF", 9)},
      {"off_binary_of_openmesh", ".off", off_binary("NOFF", 3, false)},
      {"off_dimension_given", ".off", off("nOFF 3\n8 6 0\n")},
      {"stl_text", ".stl", stl_text(), false},
      {"stl_on_one_line", ".stl", with(stl_text(), "\n", " "), false},
      {"stl_commented", ".stl",
       "; by hand\n# for a test\n" +
           with(stl_text(), "solid vertex 1 2 3\n", "solid a box\nof two lines\n"),
       false},
      {"stl_binary_count_of_none", ".stl", stl_binary("a box", 0), false},
      {"stl_binary_count_of_half", ".stl", stl_binary("a box", 6), false},
      {"stl_binary", ".stl", stl_binary("a box"), false},
      {"stl_binary_solid", ".stl", stl_binary("solid box"), false},
      {"ply_indices_with_point", ".ply",
       with(ply("ascii", "float", "uchar", "int"), "4 4 5 6 7", "4.0 4. 5.000 6 7")},
      {"ply_of_old_macs", ".ply", ply("ascii", "float", "uchar", "int", "\r")},
      {"ply_crlf_binary", ".ply", ply("binary_little_endian", "float", "uchar", "int", "\r\n")},
      {"gltf", ".gltf", gltf_embedded(), false},
      {"gltf_without_scenes", ".gltf", gltf_embedded(R"("nodes": [{"mesh": 0}])"), false},
      {"glb", ".glb", glb(), false},
  };
  for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const std::string type :
         {"char", "uchar", "short", "ushort", "int", "uint", "int8", "uint8", "int16", "uint16",
          "int32", "uint32", "float", "double", "float32", "float64"}) {
      const bool integer = type.find("float") == std::string::npos && type != "double";
      std::string name = "ply_";
      name.append(encoding).append("_").append(type);
      result.push_back({std::move(name), ".ply",
                        ply(encoding, type, integer ? type : "uchar", integer ? type : "int")});
    }
  }
  return result;
}

}  // namespace curveskel::encodings
