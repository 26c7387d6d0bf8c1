#include "surface/read/dae_mesh.hpp"

#include <limits>
#include <string>
#include <utility>

#include "surface/read/formats.hpp"
#include "surface/read/triangle_strip.hpp"

namespace curveskel {
namespace {

/// Appends the polygons of one <triangles>, <polylist>, <polygons>, <tristrips> or <trifans>.
class DaePrimitiveReader {
 public:
  DaePrimitiveReader(const DaeDocument& document, const XmlElement& primitive, PolygonSoup& soup)
      : document_(document),
        primitive_(primitive),
        stride_(document.indices_per_corner(primitive)),
        offset_(document.input(primitive, "VERTEX").offset),
        soup_(soup) {}

  void read() {
    if (primitive_.child("ph") != nullptr) {
      document_.fail(*primitive_.child("ph"), "a polygon with holes", "polygons without");
    }
    if (primitive_.name == "polylist") return read_list();
    for (const XmlElement* p : primitive_.all("p")) {
      const std::vector<std::int32_t> corners = corners_of(*p);
      if (primitive_.name == "tristrips") {
        append_strip(corners, soup_);
      } else if (primitive_.name == "trifans") {
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
          append({corners[0], corners[i], corners[i + 1]});
        }
      } else if (primitive_.name == "polygons") {
        append(corners);
      } else {
        if (corners.size() % 3 != 0) {
          document_.fail(*p, std::to_string(corners.size()) + " corners of triangles",
                         "a multiple of three");
        }
        for (std::size_t i = 0; i < corners.size(); i += 3) {
          append({corners[i], corners[i + 1], corners[i + 2]});
        }
      }
    }
  }

 private:
  void read_list() {
    const XmlElement* counts = primitive_.child("vcount");
    const XmlElement* p = primitive_.child("p");
    if (counts == nullptr || p == nullptr) return;  // of no polygons
    const std::vector<std::int32_t> corners = corners_of(*p);
    std::size_t begin = 0;
    for (const std::size_t count : document_.indices(*counts, corners.size() + 1)) {
      if (count > corners.size() - begin) {
        document_.fail(*counts,
                       "more corners than the " + std::to_string(corners.size()) + " of <p>",
                       "as many");
      }
      const auto first = corners.begin() + static_cast<std::ptrdiff_t>(begin);
      append({first, first + static_cast<std::ptrdiff_t>(count)});
      begin += count;
    }
  }

  [[nodiscard]] std::vector<std::int32_t> corners_of(const XmlElement& p) const {
    const auto any = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
    const std::vector<std::size_t> all = document_.indices(p, any);
    if (all.size() % stride_ != 0) {
      document_.fail(p, std::to_string(all.size()) + " indices",
                     "a multiple of " + std::to_string(stride_) + ", the inputs of a corner");
    }
    std::vector<std::int32_t> corners;
    corners.reserve(all.size() / stride_);
    for (std::size_t i = offset_; i < all.size(); i += stride_) {
      if (all[i] >= static_cast<std::size_t>(soup_.positions.rows())) {
        document_.fail(p, "vertex index " + std::to_string(all[i]),
                       "one from 0 to " + std::to_string(soup_.positions.rows()) + " - 1");
      }
      corners.push_back(static_cast<std::int32_t>(all[i]));
    }
    return corners;
  }

  void append(const std::vector<std::int32_t>& polygon) {
    soup_.corners.insert(soup_.corners.end(), polygon.begin(), polygon.end());
    end_polygon(soup_);
  }

  const DaeDocument& document_;
  const XmlElement& primitive_;
  std::size_t stride_;
  std::size_t offset_;
  PolygonSoup& soup_;
};

bool holds_polygons(const XmlElement& element) {
  return element.name == "triangles" || element.name == "polylist" || element.name == "polygons" ||
         element.name == "tristrips" || element.name == "trifans";
}

}  // namespace

PolygonSoup read_dae_mesh(const DaeDocument& document, const XmlElement& geometry) {
  PolygonSoup soup;
  soup.offsets.push_back(0);
  const XmlElement* mesh = geometry.child("mesh");
  if (mesh == nullptr) mesh = geometry.child("convex_mesh");
  const XmlElement* vertices = mesh == nullptr ? nullptr : mesh->child("vertices");
  if (vertices == nullptr) return soup;
  const DaeInput position = document.input(*vertices, "POSITION");
  if (position.source == nullptr) document.fail(*vertices, "vertices without positions", "some");
  soup.positions = positions_from(document.rows(*position.source, 3));
  if (soup.positions.rows() > most_vertices) {
    document.fail(*vertices, "more than " + std::to_string(most_vertices) + " vertices", "fewer");
  }
  for (const XmlElement& child : mesh->children) {
    if (!holds_polygons(child)) continue;
    const DaeInput corner = document.input(child, "VERTEX");
    if (corner.source != vertices) {
      document.fail(child, "<" + child.name + "> of other vertices", "those of its mesh");
    }
    DaePrimitiveReader(document, child, soup).read();
  }
  return soup;
}

}  // namespace curveskel
