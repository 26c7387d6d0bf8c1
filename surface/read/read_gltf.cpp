#include <tiny_gltf.h>

#include <string>

#include "surface/read/formats.hpp"
#include "surface/read/gltf_file.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {

PolygonSoup read_gltf(const FileBytes& file, const Monitor& monitor, const ReadOptions& options) {
  const tinygltf::Model model = parse_gltf(file, monitor);
  PolygonSoup soup = read_gltf_scene(file, model, monitor, {options.as_bound, false}).soup;
  soup.format = looks_like_glb(file) ? SurfaceFormat::glb : SurfaceFormat::gltf;
  soup.faces_minus_z = model.extensions.contains("VRM");  // VRM 1.0 looks along z: "VRMC_vrm"
  return soup;
}

bool looks_like_gltf(const FileBytes& file) {
  const std::size_t first = file.content.find_first_not_of(" \t\r\n");
  return first != std::string::npos && file.content[first] == '{';
}

bool looks_like_glb(const FileBytes& file) { return file.content.starts_with("glTF"); }

}  // namespace curveskel
