// COLLADA files of a box, and what becomes of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/read.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/own_folder.hpp"
#include "tests/rig/random_rigs.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::dae_subjects {

inline const std::string png("\x89PNG\r\n\x1a\n no true picture", 24);
constexpr int faces = 6;

/// The parts of a file of which tests change some.
struct Dae {
  std::string sources;        ///< of the mesh, beside those of places
  std::string vertex_inputs;  ///< beside that of places
  std::string polygons;
  std::string binding;  ///< within the instance
  std::string node;     ///< beside the instance
  std::string libraries;
  std::string asset = "<unit meter=\"1\"/><up_axis>Y_UP</up_axis>";
  std::string instance = "instance_geometry url=\"#box\"";

  [[nodiscard]] std::string text() const {
    std::string points;
    for (const auto& p : encodings::corners) points += encodings::spaced(p) + " ";
    return "<COLLADA version=\"1.4.1\"><asset>" + asset +
           "</asset><library_geometries><geometry id=\"box\"><mesh>" + source("points", 3, points) +
           sources + "<vertices id=\"corners\"><input semantic=\"POSITION\" source=\"#points\"/>" +
           vertex_inputs + "</vertices>" + polygons + "</mesh></geometry></library_geometries>" +
           libraries + "<library_visual_scenes><visual_scene id=\"scene\"><node>" + node + "<" +
           instance + ">" + binding + "</" + instance.substr(0, instance.find(' ')) +
           "></node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
           "url=\"#scene\"/></scene></COLLADA>";
  }

  static std::string source(const std::string& id, int width, const std::string& numbers) {
    const auto count = std::count(numbers.begin(), numbers.end(), ' ') / width;
    return "<source id=\"" + id + "\"><float_array id=\"" + id + "-a\">" + numbers +
           "</float_array><technique_common><accessor source=\"#" + id + "-a\" count=\"" +
           std::to_string(count) + "\" stride=\"" + std::to_string(width) +
           "\"/></technique_common></source>";
  }
};

inline std::string input(const std::string& semantic, const std::string& source, int offset,
                         int set) {
  return "<input semantic=\"" + semantic + "\" source=\"#" + source + "\" offset=\"" +
         std::to_string(offset) + "\" set=\"" + std::to_string(set) + "\"/>";
}

/// The corners of a face, as pairs of a vertex and a row: row 4 face + corner.
inline std::string indices_of(int face, const std::vector<int>& order) {
  std::string text;
  for (const int corner : order) {
    text += std::to_string(encodings::quads[idx(face)][idx(corner)]) + " " +
            std::to_string(4 * face + corner) + " ";
  }
  return text;
}

/// The box in each way in which COLLADA gives polygons; `given` is the material and the inputs of
/// two indices a corner.
inline std::string polygons_of(const std::string& kind, const std::string& given) {
  std::string all;
  std::string runs;
  for (int face = 0; face < faces; ++face) {
    const bool is_strip = kind == "tristrips";
    const std::string corners =
        kind == "triangles"
            ? indices_of(face, {0, 1, 2, 0, 2, 3})
            : indices_of(face, is_strip ? std::vector{0, 1, 3, 2} : std::vector{0, 1, 2, 3});
    all += corners;
    runs += "<p>" + corners + "</p>";
  }
  const bool is_one = kind == "triangles" || kind == "polylist";
  return "<" + kind + " " + given + (kind == "polylist" ? "<vcount>4 4 4 4 4 4</vcount>" : "") +
         (is_one ? "<p>" + all + "</p>" : runs) + "</" + kind + ">";
}

constexpr std::array kinds{"polylist", "polygons", "triangles", "tristrips", "trifans"};

/// Row r is (.01 r, .02 r, ...).
inline std::string rows_of(int rows, int width) {
  std::string text;
  for (int row = 0; row < rows; ++row) {
    for (int k = 1; k <= width; ++k) text += encodings::fbx_number(0.01 * k * row) + " ";
  }
  return text;
}

/// A material called `name` whose technique is `shader`.
inline std::string material(const std::string& name, const std::string& shader,
                            const std::string& parameters = {}, const std::string& extra = {}) {
  return "<library_effects><effect id=\"" + name + "-fx\"><profile_COMMON>" + parameters +
         "<technique sid=\"common\">" + shader + "</technique></profile_COMMON>" + extra +
         "</effect></library_effects><library_materials><material id=\"" + name + "-id\" name=\"" +
         name + "\"><instance_effect url=\"#" + name + "-fx\"/></material></library_materials>";
}

inline std::string bound(const std::string& symbol, const std::string& target,
                         const std::string& inputs = {}) {
  return "<bind_material><technique_common><instance_material symbol=\"" + symbol +
         "\" target=\"#" + target + "\">" + inputs +
         "</instance_material></technique_common></bind_material>";
}

inline const std::string plain =
    ">" + input("VERTEX", "corners", 0, 0) + input("UNKNOWN", "points", 1, 0);

class DaeDressing : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path written(const Dae& file) const {
    return folder_.write("a thing.dae", file.text());
  }

  [[nodiscard]] EditedFile dressed(const std::filesystem::path& file) const {
    const Eigen::Index rows = read_polygons(file).positions.rows();
    const auto edited = format_rig_into(file, random_rig(rows, 5, "bone "),
                                        {RigFormat::glb, OldRig::replaced, "rig", "a test"});
    EXPECT_TRUE(edited);
    return edited.value_or(EditedFile{});
  }

  OwnFolder folder_;
};

}  // namespace curveskel::dae_subjects
