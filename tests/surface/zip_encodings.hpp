// ZIP archives, and the box of `encodings` as 3MF.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/surface/encodings.hpp"

namespace curveskel::encodings {

/// Stored, or packed by deflate.
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& files,
                       bool packed = false) {
  std::string bytes;
  std::string directory;
  for (const auto& [name, content] : files) {
    std::string data = content;
    if (packed) {
      data.resize(compressBound(content.size()));
      uLongf length = data.size();
      compress(reinterpret_cast<Bytef*>(data.data()), &length,
               reinterpret_cast<const Bytef*>(content.data()), content.size());
      data = data.substr(2, length - 6);  // without zlib's header and checksum
    }
    std::string entry;
    append(entry, std::uint16_t{20});
    append(entry, std::uint16_t{0});
    append(entry, static_cast<std::uint16_t>(packed ? 8 : 0));
    append(entry, std::uint32_t{0x5a210000});  // a date
    append(entry,
           static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(content.data()),
                                            static_cast<uInt>(content.size()))));
    append(entry, static_cast<std::uint32_t>(data.size()));
    append(entry, static_cast<std::uint32_t>(content.size()));
    append(entry, static_cast<std::uint16_t>(name.size()));
    append(entry, std::uint16_t{0});
    directory.append("PK\1\2").append("\x14\0", 2).append(entry).append(10, '\0');
    append(directory, static_cast<std::uint32_t>(bytes.size()));
    directory += name;
    bytes.append("PK\3\4").append(entry).append(name).append(data);
  }
  const std::size_t begin = bytes.size();
  bytes += directory + "PK\5\6" + std::string(4, '\0');
  for (int k = 0; k < 2; ++k) append(bytes, static_cast<std::uint16_t>(files.size()));
  append(bytes, static_cast<std::uint32_t>(directory.size()));
  append(bytes, static_cast<std::uint32_t>(begin));
  return bytes + std::string(2, '\0');
}

inline const std::string core_3mf =
    R"(xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02")";

/// `model`: the whole part; `target` names it, `name` is its name in the archive.
inline std::string archive_3mf(const std::string& model, bool packed = true,
                               const std::string& target = "/3D/box.model",
                               const std::string& name = "3D/box.model") {
  const std::string relationships =
      R"(<?xml version="1.0"?><Relationships
 xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Id="r0" Type="http://schemas.openxmlformats.org/thumbnail" Target="/a.png"/>
<Relationship Id="r1" Target=")" +
      target + R"("
 Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";
  return zip({{"[Content_Types].xml", "<Types/>"}, {"_rels/.rels", relationships}, {name, model}},
             packed);
}

/// A mesh of the box with every coordinate times a number.
inline std::string mesh_3mf(int times = 1) {
  std::string text = "<mesh><vertices>\n";
  for (const auto& p : corners) {
    text += "<vertex x=\"" + std::to_string(times * p[0]) + "\" y=\"" +
            std::to_string(times * p[1]) + "\" z=\"" + std::to_string(times * p[2]) + "\"/>\n";
  }
  text += "</vertices><triangles>\n";
  for (const auto& t : triangles()) {
    text += "<triangle v1=\"" + std::to_string(t[0]) + "\" v2=\"" + std::to_string(t[1]) +
            "\" v3=\"" + std::to_string(t[2]) + "\" pid=\"1\"/>\n";
  }
  return text + "</triangles></mesh>";
}

inline std::string model_3mf(const std::string& attributes, const std::string& resources,
                             const std::string& build) {
  return "<?xml version=\"1.0\"?>\n<model " + core_3mf + " " + attributes + "><resources>\n" +
         resources + "</resources>\n<build>" + build + "</build></model>\n";
}

inline std::string simple_3mf() {
  return model_3mf("unit=\"millimeter\"", "<object id=\"7\">" + mesh_3mf() + "</object>",
                   "<item objectid=\"7\"/>");
}

inline std::vector<Encoding> all_of_3mf() {
  const std::string moved = "<component objectid=\"7\" transform=\"10 0 0 0 10 0 0 0 10 -5 0 0\"/>";
  return {{"threemf_stored", ".3mf", archive_3mf(simple_3mf(), false), false},
          {"threemf_packed", ".3mf", archive_3mf(simple_3mf()), false},
          {"threemf_with_a_blank", ".3mf",
           archive_3mf(simple_3mf(), true, "/3D/my%20box.model", "3D/my box.model"), false},
          {"threemf_in_another_case", ".3mf",
           archive_3mf(simple_3mf(), true, "/3D/box.model", "3d/Box.model"), false},
          {"threemf_with_support", ".3mf",
           archive_3mf(model_3mf("",
                                 "<object id=\"7\">" + mesh_3mf() +
                                     "</object><object id=\"8\" type=\"support\">" + mesh_3mf(2) +
                                     "</object>",
                                 "<item objectid=\"8\"/><item objectid=\"7\" transform=\"+1 0 0 "
                                 "0 +1 0 0 0 1 0 0 0\"/>")),
           false},
          {"threemf_placed_in_centimetres", ".3mf",
           archive_3mf(model_3mf("unit=\"centimeter\"",
                                 "<object id=\"7\">" + mesh_3mf() + "</object>\n<object id=\"8\">" +
                                     "<components>" + moved + "</components></object>",
                                 "<item objectid=\"8\" transform=\"0.01 0 0 0 0.01 0 0 0 0.01 "
                                 "0.05 0 0\"/>")),
           false}};
}

}  // namespace curveskel::encodings
