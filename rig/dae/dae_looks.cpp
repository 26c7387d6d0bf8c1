#include "rig/dae/dae_looks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/dae/dae_joints.hpp"
#include "rig/dae/dae_layers.hpp"
#include "rig/dae/dae_look_materials.hpp"
#include "rig/gltf/dressed_rows.hpp"
#include "rig/gltf/vertex_maps.hpp"
#include "surface/read/dae_morph.hpp"
#include "surface/read/dae_scene.hpp"

namespace curveskel {
namespace {

/// Of one primitive.
struct PrimitiveLayers {
  std::vector<DaeLayer> textures;
  std::vector<DaeLayer> normals;
  std::vector<DaeLayer> colours;
  int material = -1;  ///< of the file's
};

class DaeLookReader {
 public:
  DaeLookReader(const FileBytes& file, const DaeDocument& document, std::vector<std::string>& notes,
                const Monitor& monitor)
      : file_(file),
        document_(document),
        notes_(notes),
        monitor_(monitor),
        joint_of_node_(dae_joint_of_node(dae_nodes(document, monitor))),
        meshes_(file, monitor) {}

  DressedFile read(bool as_bound) {
    for_each_dae_mesh(document_, monitor_, as_bound,
                      [this](const DaeShownMesh& shown) { add(shown); });
    made_.mesh.to_gltf = dae_to_gltf(document_);
    rows_.place(meshes_.soup(SurfaceFormat::dae));
    return std::move(made_);
  }

 private:
  void add(const DaeShownMesh& shown) {
    const PolygonSoup& polygons = shown.mesh.polygons;
    const std::vector<Eigen::Matrix3d> moving =
        vertex_maps(shown.skin, shown.frame, static_cast<std::size_t>(polygons.positions.rows()));
    made_.mesh.parts.push_back({std::string(shown.name), static_cast<std::size_t>(first_vertex_),
                                made_.mesh.material_of_face.size()});
    const bool hangs = shown.skin.joints.empty() && shown.node >= 0;
    if (hangs) made_.mesh.parts.back().joint = joint_of_node_[idx(shown.node)];
    if (shown.morph != nullptr) add_shapes(*shown.morph, shown.base, moving);
    first_vertex_ += polygons.positions.rows();
    meshes_.add(polygons, shown.frame, shown.skin);
    rows_.begin_mesh();
    const std::vector<Eigen::Matrix3d> maps = normal_maps(moving);
    const bool mirrored = is_mirrored(shown.frame, shown.skin);
    std::size_t polygon = 0;
    for (std::size_t k = 0; k < shown.mesh.primitives.size(); ++k) {
      const DaePrimitive& primitive = shown.mesh.primitives[k];
      const bool is_last = k + 1 == shown.mesh.primitives.size();
      const std::size_t end =
          is_last ? polygons.corners.size() : shown.mesh.primitives[k + 1].first_corner;
      const PrimitiveLayers layers = layers_of(shown, primitive);
      for (; polygon + 1 < polygons.offsets.size() && idx(polygons.offsets[polygon + 1]) <= end;
           ++polygon) {
        const auto first = idx(polygons.offsets[polygon]);
        const auto last = idx(polygons.offsets[polygon + 1]);
        for (std::size_t at = first; at < last; ++at) {
          add_corner(shown.mesh, primitive, layers, mirrored ? first + last - 1 - at : at, maps);
        }
        made_.mesh.material_of_face.push_back(layers.material);
      }
    }
  }

  PrimitiveLayers layers_of(const DaeShownMesh& shown, const DaePrimitive& primitive) {
    PrimitiveLayers layers{dae_layers(document_, shown.mesh, primitive, "TEXCOORD", {2, 2}),
                           dae_layers(document_, shown.mesh, primitive, "NORMAL", {3, 3}),
                           dae_layers(document_, shown.mesh, primitive, "COLOR", {3, 4}), -1};
    const auto grow = [](std::vector<std::string>& sets, std::size_t count) {
      sets.resize(std::max(sets.size(), count));
    };
    grow(made_.mesh.parts.back().texture_sets, layers.textures.size());
    grow(made_.mesh.parts.back().colour_sets, layers.colours.size());
    layers.material = material_of(shown, *primitive.element, layers.textures);
    return layers;
  }

  void add_corner(const DaeMesh& mesh, const DaePrimitive& primitive, const PrimitiveLayers& layers,
                  std::size_t corner, const std::vector<Eigen::Matrix3d>& maps) {
    const std::int32_t tuple = mesh.tuples[corner];
    const auto row_in = [&](const DaeLayer& layer) { return layer.row_of(primitive, tuple); };
    DressedCorner made;
    made.texture = rows_.texture_in(layers.textures, row_in);
    made.colour = rows_.colour_in(layers.colours, row_in);
    if (!layers.normals.empty()) {
      const auto vertex = idx(mesh.polygons.corners[corner]);
      made.normal = rows_.normal_in(layers.normals.front(), row_in, vertex, maps[vertex]);
    }
    made_.mesh.corners.push_back(made);
  }

  /// The number in all of the file of the material to which the mesh's instance binds the
  /// primitive's symbol, else of that with this id; -1 = none.
  int material_of(const DaeShownMesh& shown, const XmlElement& primitive,
                  const std::vector<DaeLayer>& textures) {
    const std::string_view symbol = primitive.attribute("material");
    if (symbol.empty()) return -1;
    const XmlElement* binding = binding_of(shown, symbol);
    std::string_view id = binding == nullptr ? symbol : binding->attribute("target");
    if (id.starts_with('#')) id.remove_prefix(1);
    const XmlElement* material = document_.find(id);
    if (material == nullptr || material->name != "material") return -1;
    const auto [entry, is_new] =
        numbers_.try_emplace(material, static_cast<int>(made_.materials.size()));
    if (is_new) {
      std::vector<std::size_t> sets(textures.size());
      std::ranges::transform(textures, sets.begin(), &DaeLayer::set);
      made_.materials.push_back(dae_look_of(file_, document_, {*material, binding, sets}, notes_));
      made_.mesh.materials.push_back(made_.materials.back().name);
    }
    return entry->second;
  }

  /// Blender binds another instance's symbols where instances of a mesh have other materials than
  /// the first: then the order tells.
  static const XmlElement* binding_of(const DaeShownMesh& shown, std::string_view symbol) {
    const XmlElement* bound =
        shown.instance == nullptr ? nullptr : shown.instance->child("bind_material");
    const XmlElement* common = bound == nullptr ? nullptr : bound->child("technique_common");
    if (common == nullptr) return nullptr;
    const std::vector<const XmlElement*> bindings = common->all("instance_material");
    const std::vector<std::string_view> symbols = symbols_of(shown.mesh);
    bool is_any_named = false;
    for (const XmlElement* one : bindings) {
      const std::string_view named = one->attribute("symbol");
      if (named == symbol) return one;
      is_any_named = is_any_named || std::ranges::find(symbols, named) != symbols.end();
    }
    if (is_any_named || bindings.size() != symbols.size()) return nullptr;
    return bindings[idx(std::ranges::find(symbols, symbol) - symbols.begin())];
  }

  /// Of its polygons' materials, each once.
  static std::vector<std::string_view> symbols_of(const DaeMesh& mesh) {
    std::vector<std::string_view> symbols;
    for (const DaePrimitive& primitive : mesh.primitives) {
      const std::string_view symbol = primitive.element->attribute("material");
      const bool is_new = !symbol.empty() && std::ranges::find(symbols, symbol) == symbols.end();
      if (is_new) symbols.push_back(symbol);
    }
    return symbols;
  }

  void add_shapes(const XmlElement& morph, const DaeMesh& base,
                  const std::vector<Eigen::Matrix3d>& moving) {
    for (const DaeShape& shape : dae_shapes(document_, morph, base)) {
      made_.mesh.shapes.push_back({shape.name, made_.mesh.parts.size() - 1, shape.weight, {}});
      DressedShape& made = made_.mesh.shapes.back();
      for (Eigen::Index v = 0; v < shape.moves.rows(); ++v) {
        const Eigen::Vector3d move = moving[idx(v)] * shape.moves.row(v).transpose();
        const bool is_move = move.allFinite() && !move.isZero(0);
        if (is_move) made.moves[static_cast<std::int32_t>(first_vertex_ + v)] = move;
      }
    }
  }

  const FileBytes& file_;
  const DaeDocument& document_;
  std::vector<std::string>& notes_;
  const Monitor& monitor_;
  std::vector<int> joint_of_node_;
  PlacedMeshes meshes_;
  DressedFile made_;
  DressedRows rows_{made_.mesh};
  std::map<const XmlElement*, int> numbers_;  // of materials
  Eigen::Index first_vertex_ = 0;             // of the mesh
};

}  // namespace

DressedFile read_dae_looks(const FileBytes& file, bool as_bound, std::vector<std::string>& notes,
                           const Monitor& monitor) {
  const XmlElement root = parse_dae(file);
  return DaeLookReader(file, DaeDocument(file, root), notes, monitor).read(as_bound);
}

}  // namespace curveskel
