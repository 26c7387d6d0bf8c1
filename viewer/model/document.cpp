#include "viewer/model/document.hpp"

#include <algorithm>
#include <string>

#include <curveskel/advanced/file_names.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/skeleton_files.hpp>

namespace curveskel::viewer {
namespace {

namespace fs = std::filesystem;

bool has_surface_name(const fs::path& file) {
  return choice_of(surface_formats, lower_extension(without_gz(file))).has_value();
}

bool has_skeleton_name(const fs::path& file) {
  return choice_of(skeleton_formats, lower_extension(without_gz(file))).has_value();
}

bool has_same_triangles(const PolygonSoup& soup, const Triangles& triangles) {
  const auto corners = static_cast<std::size_t>(triangles.size());
  if (soup.corners.size() != corners || soup.offsets.size() != corners / 3 + 1) return false;
  for (std::size_t polygon = 0; polygon < soup.offsets.size(); ++polygon) {
    if (soup.offsets[polygon] != static_cast<std::int64_t>(3 * polygon)) return false;
  }
  return std::equal(soup.corners.begin(), soup.corners.end(), triangles.data());
}

void add_surface(Document& document, PolygonSoup soup, const fs::path& file,
                 const Monitor& monitor) {
  if (document.has_surface()) {
    throw Error(Fault::input, file.string() + ": a second surface, beside " +
                                  document.mesh_file.string() + "; open one at a time");
  }
  if (soup.format == SurfaceFormat::gltf || soup.format == SurfaceFormat::glb) {
    if (auto rig = read_rig(file, monitor)) {
      document.rig = std::make_shared<const Rig>(std::move(*rig));
    }
  }
  document.mesh_file = file;
  document.format = soup.format;
  document.faces_minus_z = soup.faces_minus_z;
  document.z_is_up = soup.z_is_up;
  document.to_gltf = soup.to_gltf;
  document.surface.triangles = triangulate(soup, monitor.stop);
  if (has_same_triangles(soup, document.surface.triangles)) {
    document.surface.positions = std::move(soup.positions);
  } else {
    document.surface.positions = soup.positions;
    document.soup = std::make_shared<const PolygonSoup>(std::move(soup));
  }
}

void add_skeleton(Document& document, RootedSkeleton read, const fs::path& file) {
  if (document.skeleton) {
    throw Error(Fault::input, file.string() + ": a second skeleton, beside " +
                                  document.skeleton_file.string() + "; open one at a time");
  }
  document.skeleton = std::move(read.skeleton);
  document.root = read.root;
  document.skeleton_file = file;
}

/// Formats that hold either are tried as a surface first: a skeleton's file has no faces.
void add_file(Document& document, const fs::path& file, const Monitor& monitor) {
  if (!has_surface_name(file)) {
    try {
      add_skeleton(document, read_rooted_skeleton(file), file);
      return;
    } catch (const Error& skeleton_error) {
      try {
        add_surface(document, read_polygons(file, monitor), file, monitor);
        return;
      } catch (const Error&) {
        if (has_skeleton_name(file)) throw skeleton_error;
        throw;
      }
    }
  }
  std::optional<PolygonSoup> soup;
  try {
    soup = read_polygons(file, monitor);
  } catch (const Error& surface_error) {
    std::optional<RootedSkeleton> skeleton;
    try {
      skeleton = read_rooted_skeleton(file);
    } catch (const Error&) {
      throw surface_error;
    }
    add_skeleton(document, std::move(*skeleton), file);
    return;
  }
  const bool lines_only = soup->offsets.size() <= 1;
  if (lines_only) {
    add_skeleton(document, read_rooted_skeleton(file), file);
  } else {
    add_surface(document, std::move(*soup), file, monitor);
  }
}

}  // namespace

std::shared_ptr<const PolygonSoup> Document::polygons() const {
  if (soup) return soup;
  auto made = std::make_shared<PolygonSoup>(soup_of(surface));
  made->format = format;
  made->faces_minus_z = faces_minus_z;
  made->z_is_up = z_is_up;
  made->to_gltf = to_gltf;
  made->file = mesh_file;
  return made;
}

Document open_document(const std::vector<fs::path>& files, const Monitor& monitor) {
  Document document;
  for (const fs::path& file : files) add_file(document, file, monitor);
  const Positions& points = document.has_surface() ? document.surface.positions
                            : document.skeleton    ? document.skeleton->nodes
                                                   : document.surface.positions;
  document.space = space_round(points);
  if (document.skeleton && document.has_surface() &&
      document.skeleton->node_of_vertex.size() != document.surface.positions.rows()) {
    document.skeleton->node_of_vertex.resize(0);  // of another surface
  }
  return document;
}

}  // namespace curveskel::viewer
