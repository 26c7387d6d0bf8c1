#include "rig/usd/usd_mesh.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/usd/usd_names.hpp"

namespace curveskel {
namespace {

std::string last_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::vector<double> extent_of(const MeshRows& places) {
  constexpr double far = std::numeric_limits<double>::max();
  std::vector<double> bounds{far, far, far, -far, -far, -far};
  for (std::size_t k = 0; k < places.size(); ++k) {
    bounds[k % 3] = std::min(bounds[k % 3], places[k]);
    bounds[3 + k % 3] = std::max(bounds[3 + k % 3], places[k]);
  }
  return places.empty() ? std::vector<double>(6, 0) : bounds;
}

class MeshPrim {
 public:
  MeshPrim(UsdText& text, const WholeMesh& mesh, const UsdMeshLinks& links)
      : text_(text), mesh_(mesh), links_(links) {
    const std::size_t places = mesh.places.size() / 3;
    is_by_corner_ = mesh.place_of_vertex.size() > places;
  }

  void write() {
    text_.begin("Mesh", last_name(links_.path), {schemas(), links_.true_name});
    text_.append(links_.place);
    write_faces();
    write_normals();
    write_maps();
    write_colours();
    write_binding();
    write_skin();
    const std::vector<std::string> shapes = write_shape_links();
    write_subsets();
    for (std::size_t k = 0; k < shapes.size(); ++k) write_shape(mesh_.shapes[k], shapes[k]);
    text_.end();
  }

 private:
  [[nodiscard]] std::vector<const char*> schemas() const {
    std::vector<const char*> all;
    const bool is_bound =
        std::ranges::any_of(links_.materials, [](const auto& path) { return !path.empty(); });
    if (is_bound) all.push_back("MaterialBindingAPI");
    if (!links_.skeleton.empty()) all.push_back("SkelBindingAPI");
    return all;
  }

  void write_faces() {
    text_.line("uniform token subdivisionScheme = \"none\"");
    if (links_.is_double_sided) text_.line("uniform bool doubleSided = 1");
    text_.numbers("float3[] extent", extent_of(mesh_.places), 3);
    std::vector<std::int32_t> counts;
    for (std::size_t face = 0; face + 1 < mesh_.offsets.size(); ++face) {
      counts.push_back(static_cast<std::int32_t>(mesh_.offsets[face + 1] - mesh_.offsets[face]));
    }
    std::vector<std::int32_t> corners = mesh_.corners;
    if (!mesh_.place_of_vertex.empty()) {
      for (std::int32_t& corner : corners) corner = mesh_.place_of_vertex[idx(corner)];
    }
    text_.integers("int[] faceVertexCounts", counts);
    text_.integers("int[] faceVertexIndices", corners);
    text_.numbers("point3f[] points", mesh_.places, 3);
  }

  /// Without indices, as programs want normals.
  void write_normals() {
    if (mesh_.normals.empty()) return;
    if (!is_by_corner_) {
      text_.numbers("normal3f[] normals", mesh_.normals, 3, {"vertex"});
      return;
    }
    MeshRows rows;
    rows.reserve(3 * mesh_.corners.size());
    for (const std::int32_t corner : mesh_.corners) {
      for (std::size_t k = 0; k < 3; ++k) rows.push_back(mesh_.normals[3 * idx(corner) + k]);
    }
    text_.numbers("normal3f[] normals", rows, 3, {"faceVarying"});
  }

  /// By vertex, of several at one place by corner with the numbers of vertices.
  void write_rows(const std::string& type, const std::string& name, const MeshRows& rows,
                  std::size_t width) {
    const std::string head = type + " primvars:" + name;
    text_.numbers(head, rows, width, {is_by_corner_ ? "faceVarying" : "vertex"});
    if (is_by_corner_) text_.integers("int[] primvars:" + name + ":indices", mesh_.corners);
  }

  void write_maps() {
    for (std::size_t k = 0; k < mesh_.maps.size(); ++k) {
      write_rows("texCoord2f[]", k == 0 ? "st" : "st" + std::to_string(k), mesh_.maps[k], 2);
    }
  }

  void write_colours() {
    for (std::size_t set = 0; set < mesh_.colours.size(); ++set) {
      const MeshRows& all = mesh_.colours[set];
      if (set > 0) {
        write_rows("color4f[]", "color" + std::to_string(set), all, 4);
        continue;
      }
      MeshRows colours;
      MeshRows opacities;
      for (std::size_t k = 0; k < all.size(); ++k) {
        constexpr std::size_t opacity = 3;
        (k % 4 == opacity ? opacities : colours).push_back(all[k]);
      }
      write_rows("color3f[]", "displayColor", colours, 3);
      if (std::ranges::all_of(opacities, [](double share) { return share == 1; })) continue;
      write_rows("float[]", "displayOpacity", opacities, 1);
    }
  }

  void write_binding() {
    if (mesh_.materials.size() == 1) {
      if (!links_.materials[0].empty()) bind(links_.materials[0]);
      return;
    }
    const bool has_all =
        std::ranges::none_of(links_.materials, [](const auto& path) { return path.empty(); });
    text_.line(std::string("uniform token subsetFamily:materialBind:familyType = \"") +
               (has_all ? "partition\"" : "nonOverlapping\""));
  }

  void write_subsets() {
    if (mesh_.materials.size() == 1) return;
    std::vector<std::vector<std::int32_t>> faces(mesh_.materials.size());
    for (std::size_t face = 0; face < mesh_.material_of_face.size(); ++face) {
      faces[idx(mesh_.material_of_face[face])].push_back(static_cast<std::int32_t>(face));
    }
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const std::string& path = links_.materials[k];
      if (path.empty() || faces[k].empty()) continue;
      text_.begin("GeomSubset", children_.free(last_name(path), ""), {{"MaterialBindingAPI"}, ""});
      text_.line("uniform token elementType = \"face\"");
      text_.line("uniform token familyName = \"materialBind\"");
      text_.integers("int[] indices", faces[k]);
      bind(path);
      text_.end();
    }
  }

  void bind(const std::string& material) {
    text_.line("rel material:binding = " + usd_target(material));
  }

  void write_skin() {
    if (links_.skeleton.empty()) return;
    text_.line("rel skel:skeleton = " + usd_target(links_.skeleton));
    if (!links_.weights) return;
    const UsdWeights& weights = *links_.weights;
    const UsdAttribute rows{"vertex", weights.width};
    text_.line("matrix4d primvars:skel:geomBindTransform = " +
               usd_matrix(Eigen::Affine3d::Identity()));
    text_.integers("int[] primvars:skel:jointIndices", weights.joints, rows);
    text_.numbers("float[] primvars:skel:jointWeights", weights.weights, 1, rows);
  }

  /// The names of the shapes' prims.
  std::vector<std::string> write_shape_links() {
    std::vector<std::string> names;
    if (links_.shape_tokens.empty()) return names;
    std::string targets;
    for (const std::string& token : links_.shape_tokens) {
      names.push_back(children_.free(token, "shape"));
      targets += (targets.empty() ? "" : ", ") + usd_target(links_.path + "/" + names.back());
    }
    text_.words("uniform token[] skel:blendShapes", links_.shape_tokens);
    text_.line("rel skel:blendShapeTargets = [" + targets + "]");
    return names;
  }

  /// The places that the shape moves, and how far.
  void write_shape(const WholeMesh::Shape& shape, const std::string& name) {
    std::vector<std::int32_t> places;
    MeshRows moves;
    for (std::size_t v = 0; v < shape.offsets.size() / 3; ++v) {
      const auto first = shape.offsets.begin() + std::ptrdiff_t(3 * v);
      const bool moves_it = std::any_of(first, first + 3, [](double x) { return x != 0; });
      if (!moves_it && v > 0) continue;  // a shape has one place at least
      places.push_back(static_cast<std::int32_t>(v));
      moves.insert(moves.end(), first, first + 3);
    }
    text_.begin("BlendShape", name, {{}, usd_true_name(shape.name, name)});
    text_.numbers("uniform vector3f[] offsets", moves, 3);
    text_.integers("uniform int[] pointIndices", places);
    text_.end();
  }

  UsdText& text_;
  const WholeMesh& mesh_;
  const UsdMeshLinks& links_;
  UsdNames children_;
  bool is_by_corner_ = false;  // what vertices have, as places have several of them
};

}  // namespace

void write_usd_mesh(UsdText& text, const WholeMesh& mesh, const UsdMeshLinks& links) {
  MeshPrim(text, mesh, links).write();
}

}  // namespace curveskel
