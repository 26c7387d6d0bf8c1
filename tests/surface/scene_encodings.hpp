// The box of `encodings` as COLLADA and as FBX, and the pieces of which tests build other scenes.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/surface/encodings.hpp"

namespace curveskel::encodings {

// ---- COLLADA ------------------------------------------------------------------------------------

/// <geometry id="box">: the corners with a normal each; `polygons` are elements that refer to them
/// by `dae_inputs`.
inline std::string dae_geometry(const std::string& polygons) {
  std::string points;
  for (const auto& p : corners) points += spaced(p) + " ";
  return "<geometry id=\"box\"><mesh>\n<source id=\"points\"><float_array id=\"array\" "
         "count=\"24\">" +
         points +
         "</float_array><technique_common><accessor source=\"#array\" count=\"8\" stride=\"3\">"
         "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
         "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>\n"
         "<source id=\"normals\"><float_array count=\"3\">0 0 1</float_array></source>\n"
         "<vertices id=\"corners\"><input semantic=\"POSITION\" source=\"#points\"/></vertices>\n" +
         polygons + "</mesh></geometry>\n";
}

inline const std::string dae_inputs =
    "<input semantic=\"NORMAL\" source=\"#normals\" offset=\"0\"/>"
    "<input semantic=\"VERTEX\" source=\"#corners\" offset=\"1\"/>";

/// Indices of the polygons' corners, each behind that of a normal.
template <typename Polygons>
std::string dae_indices(const Polygons& polygons) {
  std::string text;
  for (const auto& polygon : polygons) {
    for (const int v : polygon) text += "0 " + std::to_string(v) + " ";
  }
  return text;
}

inline std::string dae_quads() {
  return "<polylist count=\"6\">" + dae_inputs + "<vcount>4 4 4 4 4 4</vcount><p>" +
         dae_indices(quads) + "</p></polylist>\n";
}

/// `nodes` stand in the scene, `libraries` beside the geometry.
inline std::string dae(const std::string& geometry, const std::string& nodes,
                       const std::string& libraries = {}) {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA "
         "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
         "<asset><unit name=\"inch\" meter=\"0.0254\"/><up_axis>Z_UP</up_axis></asset>\n"
         "<library_geometries>" +
         geometry + "</library_geometries>\n" + libraries +
         "<library_visual_scenes><visual_scene id=\"scene\">\n" + nodes +
         "</visual_scene></library_visual_scenes>\n"
         "<scene><instance_visual_scene url=\"#scene\"/></scene>\n</COLLADA>\n";
}

inline const std::string dae_box_node = "<node><instance_geometry url=\"#box\"/></node>\n";

inline std::string dae_triangles_and_fans() {
  std::string triangles_of_five;
  const std::vector<std::array<int, 4>> five(quads.begin(), quads.begin() + 5);
  for (const auto& q : five) {
    triangles_of_five += dae_indices(std::vector{std::array{q[0], q[1], q[2]}});
    triangles_of_five += dae_indices(std::vector{std::array{q[0], q[2], q[3]}});
  }
  return "<triangles count=\"10\">" + dae_inputs + "<p>" + triangles_of_five +
         "</p></triangles>\n<trifans count=\"1\">" + dae_inputs + "<p>" +
         dae_indices(std::vector{quads[5]}) + "</p></trifans>\n";
}

inline std::string dae_polygons() {
  std::string text = "<polygons count=\"6\">" + dae_inputs;
  for (const auto& q : quads) text += "<p>" + dae_indices(std::vector{q}) + "</p>";
  return text + "</polygons>\n";
}

// ---- FBX ----------------------------------------------------------------------------------------

struct FbxItem;
using FbxItems = std::vector<FbxItem>;
using FbxContent = std::variant<int, std::int64_t, double, std::string, std::vector<double>,
                                std::vector<int>, std::vector<signed char>>;

/// A record, to be written in either form.
struct FbxItem {
  std::string name;
  std::vector<FbxContent> values;
  FbxItems children = {};
};

enum class FbxForm { text, binary, binary_wide_and_zipped };

inline std::string fbx_number(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

template <typename Value>
std::string fbx_text_array(const std::vector<Value>& values) {
  std::string text = "*" + std::to_string(values.size()) + " {\n a: ";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += (i > 0 ? "," : "") + fbx_number(static_cast<double>(values[i]));
    if (i % 7 == 6) text += "\n";
  }
  return text + "\n}";
}

inline std::string fbx_as_text(const FbxItem& item) {
  std::string text = item.name + ": ";
  for (std::size_t i = 0; i < item.values.size(); ++i) {
    if (i > 0) text += ", ";
    text += std::visit(
        [](const auto& value) -> std::string {
          using Value = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<Value, std::string>) {
            return "\"" + value + "\"";
          } else if constexpr (std::is_arithmetic_v<Value>) {
            return std::is_floating_point_v<Value> ? fbx_number(static_cast<double>(value))
                                                   : std::to_string(value);
          } else {
            return fbx_text_array(value);
          }
        },
        item.values[i]);
  }
  if (!item.children.empty()) {
    text += " {\n";
    for (const FbxItem& child : item.children) text += fbx_as_text(child);
    text += "}";
  }
  return text + "\n";
}

template <typename Value>
std::string fbx_binary_array(char type, const std::vector<Value>& values, bool zipped) {
  std::string plain;
  for (const Value value : values) append(plain, value);
  std::string packed = plain;
  if (zipped) {
    packed.resize(compressBound(plain.size()));
    uLongf length = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &length,
             reinterpret_cast<const Bytef*>(plain.data()), plain.size());
    packed.resize(length);
  }
  std::string bytes(1, type);
  append(bytes, static_cast<std::uint32_t>(values.size()));
  append(bytes, std::uint32_t{zipped ? 1U : 0U});
  append(bytes, static_cast<std::uint32_t>(packed.size()));
  return bytes + packed;
}

inline std::string fbx_binary_value(const FbxContent& content, bool zipped) {
  std::string bytes;
  if (const auto* value = std::get_if<int>(&content)) {
    bytes = "I";
    append(bytes, std::int32_t{*value});
  } else if (const auto* wide = std::get_if<std::int64_t>(&content)) {
    bytes = "L";
    append(bytes, *wide);
  } else if (const auto* number = std::get_if<double>(&content)) {
    bytes = "D";
    append(bytes, *number);
  } else if (const auto* text = std::get_if<std::string>(&content)) {
    bytes = "S";
    append(bytes, static_cast<std::uint32_t>(text->size()));
    bytes += *text;
  } else if (const auto* numbers = std::get_if<std::vector<double>>(&content)) {
    bytes = fbx_binary_array('d', *numbers, zipped);
  } else if (const auto* small = std::get_if<std::vector<signed char>>(&content)) {
    bytes = fbx_binary_array('c', *small, zipped);
  } else {
    bytes = fbx_binary_array('i', std::get<std::vector<int>>(content), zipped);
  }
  return bytes;
}

inline void append_fbx_count(std::string& bytes, std::size_t count, bool wide) {
  if (wide) {
    append(bytes, static_cast<std::uint64_t>(count));
  } else {
    append(bytes, static_cast<std::uint32_t>(count));
  }
}

/// `begin`: where the record will stand in the file.
inline std::string fbx_as_binary(const FbxItem& item, std::size_t begin, bool wide) {
  std::string values;
  for (const FbxContent& content : item.values) values += fbx_binary_value(content, wide);
  const std::size_t header = (wide ? 24 : 12) + 1 + item.name.size();
  std::string children;
  for (const FbxItem& child : item.children) {
    children += fbx_as_binary(child, begin + header + values.size() + children.size(), wide);
  }
  if (!item.children.empty()) children += std::string(wide ? 25 : 13, '\0');
  std::string bytes;
  append_fbx_count(bytes, begin + header + values.size() + children.size(), wide);
  append_fbx_count(bytes, item.values.size(), wide);
  append_fbx_count(bytes, values.size(), wide);
  bytes += static_cast<char>(item.name.size());
  return bytes + item.name + values + children;
}

inline std::string fbx(const FbxItems& records, FbxForm form, int version = 7500,
                       const std::string& creator = "nobody") {
  const bool wide = form == FbxForm::binary_wide_and_zipped;
  if (form == FbxForm::binary && version >= 7500) version = 7400;
  FbxItems all{{"FBXHeaderExtension", {}, {{"FBXVersion", {version}}, {"Creator", {creator}}}}};
  all.insert(all.end(), records.begin(), records.end());
  if (form == FbxForm::text) {
    std::string text = "; FBX 7.5.0 project file\n; as text\n\n";
    for (const FbxItem& record : all) text += fbx_as_text(record);
    return text;
  }
  std::string bytes("Kaydara FBX Binary  \0\x1A\0", 23);
  append(bytes, static_cast<std::uint32_t>(version));
  for (const FbxItem& record : all) bytes += fbx_as_binary(record, bytes.size(), wide);
  return bytes + std::string(wide ? 25 : 13, '\0');
}

/// The box as geometry 1; quads.
inline FbxItem fbx_box() {
  std::vector<double> points;
  for (const auto& p : corners) points.insert(points.end(), p.begin(), p.end());
  std::vector<int> indices;
  for (const auto& q : quads) {
    indices.insert(indices.end(), q.begin(), q.end());
    indices.back() = -1 - indices.back();
  }
  return {"Geometry",
          {std::int64_t{1}, "Geometry::box", "Mesh"},
          {{"Vertices", {points}}, {"PolygonVertexIndex", {indices}}}};
}

struct FbxProperty {
  std::string name;
  std::vector<FbxContent> values;
};

inline FbxItem fbx_model(std::int64_t number, const std::vector<FbxProperty>& properties = {},
                         const std::string& kind = "Mesh") {
  FbxItem list{"Properties70", {}};
  for (const FbxProperty& property : properties) {
    FbxItem one{"P", {property.name, property.name, "", "A"}};
    one.values.insert(one.values.end(), property.values.begin(), property.values.end());
    list.children.push_back(std::move(one));
  }
  return {"Model", {number, "Model::m", kind}, {list}};
}

/// A child and its parent.
using FbxLinks = std::vector<std::pair<std::int64_t, std::int64_t>>;

inline FbxItems fbx_scene(const FbxItems& objects, const FbxLinks& links) {
  FbxItem connections{"Connections", {}};
  for (const auto& [child, parent] : links) {
    connections.children.push_back({"C", {"OO", child, parent}});
  }
  return {{"Objects", {}, objects}, connections};
}

inline FbxItems fbx_box_scene() { return fbx_scene({fbx_box(), fbx_model(2)}, {{2, 0}, {1, 2}}); }

// ---- All ----------------------------------------------------------------------------------------

inline std::vector<Encoding> all_of_scenes() {
  return {
      {"dae_polylist", ".dae", dae(dae_geometry(dae_quads()), dae_box_node)},
      {"dae_polygons", ".dae", dae(dae_geometry(dae_polygons()), dae_box_node)},
      {"dae_triangles_and_fans", ".dae", dae(dae_geometry(dae_triangles_and_fans()), dae_box_node),
       false},
      {"fbx_text", ".fbx", fbx(fbx_box_scene(), FbxForm::text)},
      {"fbx_binary", ".fbx", fbx(fbx_box_scene(), FbxForm::binary)},
      {"fbx_binary_wide_and_zipped", ".fbx", fbx(fbx_box_scene(), FbxForm::binary_wide_and_zipped)},
  };
}

}  // namespace curveskel::encodings
