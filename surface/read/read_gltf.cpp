#include <tiny_gltf.h>

#include <cstddef>
#include <string>

#include "surface/read/formats.hpp"
#include "surface/read/gltf_file.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {
namespace {

/// Of a file whose meshes have points or lines and no triangles.
void refuse_points_and_lines(const FileBytes& file, const tinygltf::Model& model) {
  std::size_t points = 0;
  std::size_t lines = 0;
  for (const tinygltf::Mesh& mesh : model.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (primitive.mode == TINYGLTF_MODE_POINTS) {
        ++points;
      } else if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        ++lines;
      }
    }
  }
  if (lines > 0) {
    file.fail("a drawing of lines: " + std::to_string(lines) +
                  (lines == 1 ? " primitive" : " primitives") + " of them and no faces",
              "a surface with faces", "give the surface, of which a skeleton can be made");
  }
  if (points > 0) {
    file.fail("a point cloud: " + std::to_string(points) +
                  (points == 1 ? " primitive" : " primitives") + " of points and no faces",
              "a surface with faces", "reconstruct a surface from the points first");
  }
}

}  // namespace

PolygonSoup read_gltf(const FileBytes& file, const Monitor& monitor, const ReadOptions& options) {
  const tinygltf::Model model = parse_gltf(file, monitor);
  PolygonSoup soup = read_gltf_scene(file, model, monitor, {options.as_bound, false}).soup;
  if (soup.offsets.size() < 2) refuse_points_and_lines(file, model);
  soup.format = looks_like_glb(file) ? SurfaceFormat::glb : SurfaceFormat::gltf;
  soup.faces_minus_z = model.extensions.contains("VRM");  // VRM 1.0 looks along z: "VRMC_vrm"
  return soup;
}

bool looks_like_gltf(const FileBytes& file) {
  constexpr const char* blank = " \t\r\n";
  const std::size_t first = file.content.find_first_not_of(blank);
  if (first == std::string::npos || file.content[first] != '{') return false;
  // A name comes next, in JSON; other data may begin with the same byte.
  const std::size_t next = file.content.find_first_not_of(blank, first + 1);
  return next != std::string::npos && (file.content[next] == '"' || file.content[next] == '}');
}

bool looks_like_glb(const FileBytes& file) { return file.content.starts_with("glTF"); }

}  // namespace curveskel
