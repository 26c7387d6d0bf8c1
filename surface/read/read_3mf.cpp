// 3MF: a ZIP archive whose relationships name the model, in millimetres.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/file_names.hpp>
#include "base/memory.hpp"
#include "base/uri.hpp"
#include "surface/read/foreign_formats.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/model_3mf.hpp"
#include "surface/read/xml.hpp"
#include "surface/read/zip_archive.hpp"

namespace curveskel {
namespace {

constexpr std::string_view relationships = "_rels/.rels";
constexpr std::string_view model_type =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

/// Rows and corners of one object with all of its components, as often as they occur.
struct Extent3mf {
  double vertices = 0;
  double triangles = 0;
  double objects = 1;
};

/// Objects may multiply: ten in ten in ten ... So all is counted before anything is copied.
std::vector<Extent3mf> extents_of(const Model3mf& model) {
  std::vector<Extent3mf> extents;
  for (const Object3mf& object : model.objects) {
    Extent3mf extent{static_cast<double>(object.coordinates.size() / 3),
                     static_cast<double>(object.corners.size() / 3)};
    for (const Placed3mf& component : object.components) {
      extent.vertices += extents[component.object].vertices;
      extent.triangles += extents[component.object].triangles;
      extent.objects += extents[component.object].objects;
    }
    extents.push_back(extent);
  }
  return extents;
}

void check_extent(const FileBytes& file, const Model3mf& model) {
  constexpr double bytes_per_vertex = 48;  // a position, and room for it to grow
  constexpr double bytes_per_triangle = 40;
  constexpr double most_objects = 1e7;
  const std::vector<Extent3mf> extents = extents_of(model);
  Extent3mf whole;
  for (const Placed3mf& item : model.items) {
    whole.vertices += extents[item.object].vertices;
    whole.triangles += extents[item.object].triangles;
    whole.objects += extents[item.object].objects;
  }
  if (whole.objects > most_objects) {
    file.fail("more than " + std::to_string(static_cast<int>(most_objects)) +
                  " objects in what is to be built",
              "fewer", "export the model as one mesh");
  }
  if (whole.vertices > static_cast<double>(most_vertices)) {
    file.fail("more than " + std::to_string(most_vertices) + " vertices in what is to be built",
              "fewer", "split or decimate the surface first");
  }
  require_memory(whole.vertices * bytes_per_vertex + whole.triangles * bytes_per_triangle,
                 available_memory_bytes(), file.path.string(), Fault::input,
                 "it is too large for this machine, or no honest file");
}

void append_mesh(const Object3mf& object, const Eigen::Affine3d& frame,
                 std::vector<double>& coordinates, PolygonSoup& soup) {
  const auto first = static_cast<std::int32_t>(coordinates.size() / 3);
  for (std::size_t i = 0; i + 2 < object.coordinates.size(); i += 3) {
    const Eigen::Vector3d point =
        frame * Eigen::Map<const Eigen::Vector3d>(object.coordinates.data() + i);
    coordinates.insert(coordinates.end(), {point.x(), point.y(), point.z()});
  }
  const bool mirrored = frame.linear().determinant() < 0;
  for (std::size_t i = 0; i + 2 < object.corners.size(); i += 3) {
    std::array<std::int32_t, 3> corner{object.corners[i], object.corners[i + 1],
                                       object.corners[i + 2]};
    if (mirrored) std::swap(corner[1], corner[2]);
    for (const std::int32_t vertex : corner) soup.corners.push_back(first + vertex);
    end_polygon(soup);
  }
}

/// Depth first, an object's own mesh before its components.
PolygonSoup built(const Model3mf& model, const Monitor& monitor) {
  PolygonSoup soup;
  soup.offsets.push_back(0);
  std::vector<double> coordinates;
  std::vector<Placed3mf> open;
  for (auto item = model.items.rbegin(); item != model.items.rend(); ++item) {
    open.push_back(*item);
    open.back().frame = Eigen::Scaling(model.millimetres) * item->frame;
  }
  while (!open.empty()) {
    monitor.report("read", 0.5);
    const Placed3mf placed = open.back();
    open.pop_back();
    const Object3mf& object = model.objects[placed.object];
    append_mesh(object, placed.frame, coordinates, soup);
    for (auto part = object.components.rbegin(); part != object.components.rend(); ++part) {
      open.push_back({part->object, placed.frame * part->frame});
    }
  }
  soup.positions = positions_from(coordinates);
  return soup;
}

/// As the archive has it: names of parts are alike in any case.
std::string name_in_archive(const ZipArchive& archive, const std::string& name) {
  if (archive.holds(name)) return name;
  const auto alike = std::find_if(
      archive.names().begin(), archive.names().end(),
      [&](const std::string& other) { return in_lower_case(other) == in_lower_case(name); });
  return alike == archive.names().end() ? name : *alike;
}

/// The model's name in the archive; empty where no relationship names one.
std::string model_name(const ZipArchive& archive, const Monitor& monitor) {
  const std::string name = name_in_archive(archive, std::string(relationships));
  if (!archive.holds(name)) return {};
  const FileBytes part = archive.unpack(name, monitor);
  const XmlElement root = parse_xml(part);
  for (const XmlElement* relationship : root.all("Relationship")) {
    if (relationship->attribute("Type") != model_type) continue;
    std::string_view target = relationship->attribute("Target");
    if (target.starts_with('/')) target.remove_prefix(1);
    const std::string as_it_is = name_in_archive(archive, std::string(target));
    return archive.holds(as_it_is) ? as_it_is : name_in_archive(archive, without_escapes(target));
  }
  return {};
}

}  // namespace

PolygonSoup read_3mf(const FileBytes& file, const Monitor& monitor) {
  const ZipArchive archive(file);
  const std::string name = model_name(archive, monitor);
  if (name.empty()) {
    refuse_foreign_format(file);
    std::string found = "a ZIP archive that is no 3MF";
    if (!archive.names().empty()) found += " and begins with " + in_quotes(archive.names()[0]);
    file.fail(found, "3MF, whose " + std::string(relationships) + " names a model",
              "unpack it and give the surface file that is in it");
  }
  const Model3mf model = parse_3mf_model(archive.unpack(name, monitor), monitor);
  check_extent(file, model);
  PolygonSoup soup = built(model, monitor);
  soup.format = SurfaceFormat::three_mf;
  return soup;
}

bool looks_like_3mf(const FileBytes& file) { return is_zipped(file.content); }

}  // namespace curveskel
