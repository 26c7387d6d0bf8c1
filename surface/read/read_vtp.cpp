// VTK's XML PolyData: the polygons and the strips of triangles of every piece.
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "surface/read/formats.hpp"
#include "surface/read/triangle_strip.hpp"
#include "surface/read/vtk_array.hpp"
#include "surface/read/xml.hpp"

namespace curveskel {
namespace {

constexpr std::string_view vtp_start = "<VTKFile";

class VtpReader {
 public:
  VtpReader(const FileBytes& file, const XmlElement& root) : file_(file), root_(root) {}

  PolygonSoup read(const Monitor& monitor) {
    soup_.format = SurfaceFormat::vtp;
    soup_.offsets.push_back(0);
    const XmlElement* data = root_.child("PolyData");
    if (data == nullptr) fail_at(file_, root_.position, "no <PolyData>", "one");
    const auto pieces = data->all("Piece");
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      monitor.report("read", static_cast<double>(p) / static_cast<double>(pieces.size()));
      if (pieces[p]->attribute("NumberOfPoints") != "0") read_piece(*pieces[p]);
    }
    soup_.positions = positions_from(coordinates_);
    return std::move(soup_);
  }

 private:
  struct Piece {
    std::size_t first;   ///< its first vertex
    std::size_t points;  ///< how many it has
  };

  void read_piece(const XmlElement& piece) {
    const std::size_t first = coordinates_.size() / 3;
    read_points(piece);
    const Piece range{first, coordinates_.size() / 3 - first};
    for (const XmlElement* cells : piece.all("Polys")) read_cells(*cells, range, false);
    for (const XmlElement* cells : piece.all("Strips")) read_cells(*cells, range, true);
  }

  void read_points(const XmlElement& piece) {
    const XmlElement* points = piece.child("Points");
    const XmlElement* array = points == nullptr ? nullptr : points->child("DataArray");
    if (array == nullptr) fail_at(file_, piece.position, "a piece without points", "<Points>");
    const std::vector<double> values =
        vtk_values(file_, root_, *array, 3 * number_of(piece, "NumberOfPoints"));
    if (values.size() % 3 != 0) {
      fail_at(file_, array->position, std::to_string(values.size()) + " coordinates",
              "three per point");
    }
    coordinates_.insert(coordinates_.end(), values.begin(), values.end());
    if (coordinates_.size() / 3 > static_cast<std::size_t>(most_vertices)) {
      file_.fail("more than " + std::to_string(most_vertices) + " vertices", "fewer",
                 "split or decimate the surface first");
    }
  }

  /// Infinity where the piece does not say it.
  static double number_of(const XmlElement& piece, std::string_view key) {
    const std::string_view text = piece.attribute(key);
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size()
               ? double(number)
               : std::numeric_limits<double>::infinity();
  }

  static const XmlElement* array_of(const XmlElement& cells, std::string_view name) {
    for (const XmlElement* array : cells.all("DataArray")) {
      if (array->attribute("Name") == name) return array;
    }
    return nullptr;
  }

  void read_cells(const XmlElement& cells, const Piece& piece, bool strips) {
    const XmlElement* connectivity = array_of(cells, "connectivity");
    const XmlElement* offsets = array_of(cells, "offsets");
    if (connectivity == nullptr || offsets == nullptr) return;  // none of these cells
    const std::vector<double> points = vtk_values(file_, root_, *connectivity);
    std::vector<std::int32_t> vertices;
    vertices.reserve(points.size());
    for (const double point : points) {
      if (!(point >= 0 && point < static_cast<double>(piece.points) &&
            std::floor(point) == point)) {
        fail_at(file_, connectivity->position, "the point index " + std::to_string(point),
                "whole numbers from 0 to " + std::to_string(piece.points) + " - 1");
      }
      vertices.push_back(static_cast<std::int32_t>(piece.first + static_cast<std::size_t>(point)));
    }
    std::size_t begin = 0;
    for (const double offset : vtk_values(file_, root_, *offsets)) {
      if (!(offset >= static_cast<double>(begin) && offset <= static_cast<double>(points.size()))) {
        fail_at(file_, offsets->position, "an offset that runs backwards or past the connectivity",
                "ascending offsets up to " + std::to_string(points.size()));
      }
      const auto end = static_cast<std::size_t>(offset);
      const std::span cell(vertices.data() + begin, end - begin);
      begin = end;
      if (strips) {
        append_strip(cell, soup_);
      } else {
        soup_.corners.insert(soup_.corners.end(), cell.begin(), cell.end());
        end_polygon(soup_);
      }
    }
  }

  const FileBytes& file_;
  const XmlElement& root_;
  PolygonSoup soup_;
  std::vector<double> coordinates_;
};

void refuse_polylines_alone(const FileBytes& file, const XmlElement& root) {
  const XmlElement* const data = root.child("PolyData");
  if (data == nullptr) return;
  for (const XmlElement* piece : data->all("Piece")) {
    const std::string_view lines = piece->attribute("NumberOfLines");
    if (lines.empty() || lines == "0") continue;
    file.fail("a skeleton or a drawing of lines: polylines and no faces", "a surface with faces",
              "give the surface, of which a skeleton can be made");
  }
}

}  // namespace

PolygonSoup read_vtp_surface(const FileBytes& file, const Monitor& monitor) {
  const XmlElement root = parse_xml(file);
  monitor.report("read", 0);
  const std::string_view type = root.attribute("type");
  if (root.name != "VTKFile" || type != "PolyData") {
    file.fail("VTK's XML of type " + in_quotes(type), "type \"PolyData\"",
              "extract its surface, in ParaView by Filters, Extract Surface, and save that as .vtp "
              "or .ply");
  }
  PolygonSoup soup = VtpReader(file, root).read(monitor);
  if (soup.offsets.size() < 2) refuse_polylines_alone(file, root);
  return soup;
}

bool looks_like_vtp(const FileBytes& file) { return begins_as_xml(file, vtp_start); }

}  // namespace curveskel
