// FBX's box with texture coordinates and colours, in all the ways in which a file may give them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/read_materials.hpp>
#include "tests/rig/fbx_subjects.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::fbx_mappings {

using namespace fbx_subjects;

inline constexpr int faces = 6;

/// Of a corner of the box: its face, and which of the face's it is.
inline std::size_t vertex_at(int face, int corner) {
  return static_cast<std::size_t>(encodings::quads[idx(face)][idx(corner)]);
}

struct Mapping {
  std::string name;
  int rows;  ///< that it has on the box
  int (*place)(int face, int corner);
};

inline const std::vector<Mapping> mappings{
    {"ByPolygonVertex", 24, [](int face, int corner) { return 4 * face + corner; }},
    {"ByVertice", 8,
     [](int face, int corner) { return static_cast<int>(vertex_at(face, corner)); }},
    {"ByPolygon", 6, [](int face, int) { return face; }},
    {"AllSame", 1, [](int, int) { return 0; }},
};

/// Row r of the texture coordinates is (.01 r, .02 r). With indices place p has row 2 p + 1.
struct Textures {
  Mapping mapping;
  bool is_indexed;

  [[nodiscard]] int row(int face, int corner) const {
    const int place = mapping.place(face, corner);
    return is_indexed ? 2 * place + 1 : place;
  }

  [[nodiscard]] FbxItem layer() const {
    std::vector<double> values;
    std::vector<int> indices;
    indices.reserve(idx(mapping.rows));
    for (int place = 0; place < mapping.rows; ++place) {
      indices.push_back(2 * place + 1);
    }
    for (int row = 0; row < (is_indexed ? 2 : 1) * mapping.rows; ++row) {
      values.push_back(0.01 * row);
      values.push_back(0.02 * row);
    }
    FbxItem result{"LayerElementUV",
                   {0},
                   {{"MappingInformationType", {mapping.name}},
                    {"ReferenceInformationType", {is_indexed ? "IndexToDirect" : "Direct"}},
                    {"UV", {values}}}};
    if (is_indexed) result.children.push_back({"UVIndex", {indices}});
    return result;
  }
};

/// Of the face that has all three.
inline int face_of(const SurfaceMaterials& look, Eigen::Index triangle) {
  for (int face = 0; face < faces; ++face) {
    std::set<int> own;
    for (int corner = 0; corner < 4; ++corner) own.insert(int(vertex_at(face, corner)));
    const auto row = look.triangles.row(triangle);
    const bool has_all = std::all_of(row.begin(), row.end(), [&](int drawn) {
      return own.count(look.vertices[idx(drawn)]) > 0;
    });
    if (has_all) return face;
  }
  return -1;
}

}  // namespace curveskel::fbx_mappings
