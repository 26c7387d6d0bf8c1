#include "surface/read/dae_mesh.hpp"

#include <array>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "surface/read/formats.hpp"
#include "surface/read/triangle_strip.hpp"

namespace curveskel {
namespace {

/// Appends the polygons of one <triangles>, <polylist>, <polygons>, <tristrips> or <trifans>.
class DaePrimitiveReader {
 public:
  DaePrimitiveReader(const DaeDocument& document, const XmlElement& element, DaeMesh& mesh)
      : document_(document),
        element_(element),
        offset_(document.input(element, "VERTEX").offset),
        mesh_(mesh) {
    made_.element = &element;
    made_.first_corner = mesh.polygons.corners.size();
    made_.stride = document.indices_per_corner(element);
  }

  void read() {
    if (element_.child("ph") != nullptr) {
      document_.fail(*element_.child("ph"), "a polygon with holes", "polygons without");
    }
    if (element_.name == "polylist") {
      read_list();
    } else {
      for (const XmlElement* p : element_.all("p")) read_run(*p);
    }
    name_vertices();
    mesh_.primitives.push_back(std::move(made_));
  }

 private:
  void read_list() {
    const XmlElement* counts = element_.child("vcount");
    const XmlElement* p = element_.child("p");
    if (counts == nullptr || p == nullptr) return;  // of no polygons
    const std::vector<std::int32_t> tuples = tuples_of(*p);
    std::size_t begin = 0;
    for (const std::size_t count : document_.indices(*counts, tuples.size() + 1)) {
      if (count > tuples.size() - begin) {
        document_.fail(*counts,
                       "more corners than the " + std::to_string(tuples.size()) + " of <p>",
                       "as many");
      }
      append(std::span(tuples).subspan(begin, count));
      begin += count;
    }
  }

  void read_run(const XmlElement& p) {
    const std::vector<std::int32_t> tuples = tuples_of(p);
    if (element_.name == "tristrips") {
      append_strip(tuples, mesh_.polygons);
    } else if (element_.name == "trifans") {
      for (std::size_t i = 1; i + 1 < tuples.size(); ++i) {
        append(std::array{tuples[0], tuples[i], tuples[i + 1]});
      }
    } else if (element_.name == "polygons") {
      append(tuples);
    } else {
      if (tuples.size() % 3 != 0) {
        document_.fail(p, std::to_string(tuples.size()) + " corners of triangles",
                       "a multiple of three");
      }
      for (std::size_t i = 0; i < tuples.size(); i += 3) append(std::span(tuples).subspan(i, 3));
    }
  }

  /// Takes in the indices of <p>; their tuples.
  std::vector<std::int32_t> tuples_of(const XmlElement& p) {
    const auto any = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
    const std::vector<std::size_t> all = document_.indices(p, any);
    if (all.size() % made_.stride != 0) {
      document_.fail(p, std::to_string(all.size()) + " indices",
                     "a multiple of " + std::to_string(made_.stride) + ", the inputs of a corner");
    }
    for (std::size_t i = offset_; i < all.size(); i += made_.stride) {
      if (all[i] >= static_cast<std::size_t>(mesh_.polygons.positions.rows())) {
        document_.fail(p, "vertex index " + std::to_string(all[i]),
                       "one from 0 to " + std::to_string(mesh_.polygons.positions.rows()) + " - 1");
      }
    }
    std::vector<std::int32_t> tuples(all.size() / made_.stride);
    std::iota(tuples.begin(), tuples.end(),
              static_cast<std::int32_t>(made_.indices.size() / made_.stride));
    made_.indices.reserve(made_.indices.size() + all.size());
    for (const std::size_t index : all) made_.indices.push_back(static_cast<std::int32_t>(index));
    return tuples;
  }

  void append(std::span<const std::int32_t> polygon) {
    std::vector<std::int32_t>& corners = mesh_.polygons.corners;
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    end_polygon(mesh_.polygons);
  }

  /// The corners that were made so far are tuples.
  void name_vertices() {
    std::vector<std::int32_t>& corners = mesh_.polygons.corners;
    for (std::size_t c = made_.first_corner; c < corners.size(); ++c) {
      mesh_.tuples.push_back(corners[c]);
      const std::size_t at = static_cast<std::size_t>(corners[c]) * made_.stride + offset_;
      corners[c] = made_.indices[at];
    }
  }

  const DaeDocument& document_;
  const XmlElement& element_;
  std::size_t offset_;
  DaeMesh& mesh_;
  DaePrimitive made_;
};

bool holds_polygons(const XmlElement& element) {
  return element.name == "triangles" || element.name == "polylist" || element.name == "polygons" ||
         element.name == "tristrips" || element.name == "trifans";
}

}  // namespace

DaeMesh read_dae_mesh(const DaeDocument& document, const XmlElement& geometry) {
  DaeMesh result;
  PolygonSoup& polygons = result.polygons;
  polygons.offsets.push_back(0);
  const XmlElement* mesh = geometry.child("mesh");
  if (mesh == nullptr) mesh = geometry.child("convex_mesh");
  const XmlElement* vertices = mesh == nullptr ? nullptr : mesh->child("vertices");
  if (vertices == nullptr) return result;
  result.vertices = vertices;
  const DaeInput position = document.input(*vertices, "POSITION");
  if (position.source == nullptr) document.fail(*vertices, "vertices without positions", "some");
  polygons.positions = positions_from(document.rows(*position.source, 3));
  if (polygons.positions.rows() > most_vertices) {
    document.fail(*vertices, "more than " + std::to_string(most_vertices) + " vertices", "fewer");
  }
  for (const XmlElement& child : mesh->children) {
    if (!holds_polygons(child)) continue;
    const DaeInput corner = document.input(child, "VERTEX");
    if (corner.source != vertices) {
      document.fail(child, "<" + child.name + "> of other vertices", "those of its mesh");
    }
    DaePrimitiveReader(document, child, result).read();
  }
  return result;
}

}  // namespace curveskel
