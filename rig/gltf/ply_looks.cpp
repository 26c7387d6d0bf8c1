#include "rig/gltf/ply_looks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/read.hpp>
#include "rig/gltf/colours.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/ply_header.hpp"
#include "surface/read/ply_values.hpp"

namespace curveskel {
namespace {

/// Of a vertex: red, green, blue, alpha, a normal, a place in a picture.
constexpr std::size_t columns = 9;
using VertexLook = std::array<double, columns>;

/// The column of a property, or -1.
int column_of(const PlyProperty& property) {
  constexpr std::array<std::pair<std::string_view, int>, 13> known{{{"red", 0},
                                                                    {"green", 1},
                                                                    {"blue", 2},
                                                                    {"alpha", 3},
                                                                    {"nx", 4},
                                                                    {"ny", 5},
                                                                    {"nz", 6},
                                                                    {"s", 7},
                                                                    {"t", 8},
                                                                    {"u", 7},
                                                                    {"v", 8},
                                                                    {"texture_u", 7},
                                                                    {"texture_v", 8}}};
  for (const auto& [name, column] : known) {
    if (property.name == name && !property.is_list) return column;
  }
  return -1;
}

/// That stands for all light.
double full_value(PlyType type) {
  if (type == PlyType::uint8) return 255;
  if (type == PlyType::uint16) return 65535;
  return 1;
}

bool is_look(const PlyElement& element, const PlyProperty& property) {
  return (element.name == "vertex" && column_of(property) >= 0) ||
         (element.name == "face" && property.is_list && property.name == "texcoord");
}

class PlyLookReader {
 public:
  PlyLookReader(const FileBytes& file, PlyHeader header, const Monitor& monitor)
      : header_(std::move(header)), soup_(read_ply(file, monitor)) {
    with_ply_values(file, header_, [this](auto values) { read(std::move(values)); });
  }

  DressedFile dressed(const FileBytes& file) {
    DressedFile made;
    made.mesh.offsets = soup_.offsets;
    made.mesh.places.assign(soup_.positions.data(),
                            soup_.positions.data() + soup_.positions.size());
    for (const std::int32_t place : soup_.corners) made.mesh.corners.push_back({place});
    if (has(0) && has(1) && has(2)) colour(made.mesh);
    if (has(4) && has(5) && has(6)) add_normals(made.mesh);
    add_textures(made.mesh);
    made.mesh.material_of_face.assign(soup_.offsets.size() - 1, -1);
    const std::string picture = named_picture(file);
    if (!made.mesh.textures.empty() && !picture.empty()) {
      made.mesh.drop_colours();  // a copy of the picture, mostly, of which it would be a factor
      MaterialLook look;
      look.base = DressedPicture{file.path.parent_path() / picture, picture, {}};
      made.materials.push_back({std::filesystem::path(picture).stem().string(), look});
    } else if (!made.mesh.colours.empty()) {
      made.materials.push_back({coloured_material, MaterialLook{}});
    }
    if (!made.materials.empty()) {
      made.mesh.materials.push_back(made.materials.front().name);
      std::fill(made.mesh.material_of_face.begin(), made.mesh.material_of_face.end(), 0);
    }
    return made;
  }

 private:
  template <typename Values>
  void read(Values values) {
    for (const PlyElement& element : header_.elements) {
      const bool is_vertex = element.name == "vertex";
      const bool is_face = element.name == "face";
      if (is_vertex) vertices_.assign(static_cast<std::size_t>(element.count), VertexLook{});
      PlyPlace place{&element, nullptr, 0};
      for (; place.row < element.count; ++place.row) {
        for (const PlyProperty& property : element.properties) {
          place.property = &property;
          const int column = is_vertex ? column_of(property) : -1;
          if (column >= 0) {
            has_[idx(column)] = true;
            const double full = column < 4 ? full_value(property.type) : 1;
            vertices_[static_cast<std::size_t>(place.row)][idx(column)] =
                values.number(property.type, place) / full;
          } else if (is_face && property.is_list && property.name == "texcoord") {
            for (std::int64_t left = list_length(values, place); left > 0; --left) {
              texcoords_.push_back(values.number(property.type, place));
            }
          } else {
            values.skip(property.type, property.is_list ? list_length(values, place) : 1, place);
          }
        }
      }
    }
  }

  [[nodiscard]] bool has(std::size_t column) const { return has_[column]; }

  void colour(DressedMesh& mesh) const {
    for (const VertexLook& look : vertices_) {
      const auto [r, g, b, a] = linear_colour({look[0], look[1], look[2], has(3) ? look[3] : 1});
      mesh.colours.push_back({r, g, b, a});
    }
    for (DressedCorner& corner : mesh.corners) corner.colour = corner.place;
  }

  void add_normals(DressedMesh& mesh) const {
    for (const VertexLook& look : vertices_) {
      mesh.normals.push_back(
          {static_cast<float>(look[4]), static_cast<float>(look[5]), static_cast<float>(look[6])});
    }
    for (DressedCorner& corner : mesh.corners) corner.normal = corner.place;
  }

  /// Those of corners, if there are as many as the polygons have.
  void add_textures(DressedMesh& mesh) const {
    if (!texcoords_.empty() && texcoords_.size() == 2 * mesh.corners.size()) {
      std::map<std::array<float, 2>, std::int32_t> rows;
      for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
        const std::array<float, 2> at{static_cast<float>(texcoords_[2 * c]),
                                      static_cast<float>(texcoords_[2 * c + 1])};
        if (!std::isfinite(at[0]) || !std::isfinite(at[1])) continue;
        const auto [row, is_new] =
            rows.try_emplace(at, static_cast<std::int32_t>(mesh.textures.size()));
        if (is_new) mesh.textures.push_back({at[0], at[1]});
        mesh.corners[c].texture = row->second;
      }
    } else if (has(7) && has(8)) {
      for (const VertexLook& look : vertices_) {
        mesh.textures.push_back({static_cast<float>(look[7]), static_cast<float>(look[8])});
      }
      for (DressedCorner& corner : mesh.corners) corner.texture = corner.place;
    }
  }

  static std::string named_picture(const FileBytes& file) {
    constexpr std::string_view key = "comment TextureFile ";
    const std::string_view text(file.content);
    const std::string_view header = text.substr(0, text.find("end_header"));
    const std::size_t at = header.find(key);
    if (at == std::string_view::npos) return "";
    const std::string_view rest = header.substr(at + key.size());
    return std::string(rest.substr(0, rest.find_first_of("\r\n")));
  }

  PlyHeader header_;
  PolygonSoup soup_;
  std::vector<VertexLook> vertices_;
  std::array<bool, columns> has_{};
  std::vector<double> texcoords_;
};

}  // namespace

std::optional<DressedFile> read_ply_looks(const FileBytes& file, const Monitor& monitor) {
  PlyHeader header = read_ply_header(file);
  const bool has_looks =
      std::any_of(header.elements.begin(), header.elements.end(), [](const PlyElement& element) {
        return std::any_of(element.properties.begin(), element.properties.end(),
                           [&](const PlyProperty& property) { return is_look(element, property); });
      });
  if (!has_looks) return std::nullopt;
  return PlyLookReader(file, std::move(header), monitor).dressed(file);
}

}  // namespace curveskel
