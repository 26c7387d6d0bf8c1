#include "rig/usd/usd_of_glb.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/decimal.hpp"
#include "rig/usd/usd_animations.hpp"
#include "rig/usd/usd_materials.hpp"
#include "rig/usd/usd_mesh.hpp"
#include "rig/usd/usd_names.hpp"
#include "rig/usd/usd_pictures.hpp"
#include "rig/usd/usd_skeletons.hpp"
#include "rig/usd/usd_text.hpp"
#include "surface/read/gltf_file.hpp"
#include "surface/read/gltf_numbers.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {
namespace {

using Eigen::Affine3d;

constexpr const char* usd_root = "/Model";

std::set<int> moved_nodes(const std::vector<GltfAnimation>& animations) {
  std::set<int> moved;
  for (const GltfAnimation& animation : animations) {
    for (const auto& [node, motion] : animation.motions) {
      const bool moves_it = !motion.shift.empty() || !motion.turn.empty() || !motion.scale.empty();
      if (moves_it) moved.insert(node);
    }
  }
  return moved;
}

class LayerWriter {
 public:
  LayerWriter(const FileBytes& file, const tinygltf::Model& model,
              const std::vector<MeshPolygons>& polygons, const Monitor& monitor)
      : file_(file),
        model_(model),
        polygons_(polygons),
        monitor_(monitor),
        scene_(read_gltf_scene(file, model, monitor)),
        animations_(read_gltf_animations(file, model)),
        skeletons_(usd_skeletons(file, model, scene_, moved_nodes(animations_))),
        sliders_(skeletons_.all.size()),
        shown_(scene_.frames.size(), false) {
    for (const int node : scene_.nodes) shown_[idx(node)] = true;
    (void)names_of_root_.free("Materials", "");
    for (const UsdSkeleton& skeleton : skeletons_.all) (void)names_of_root_.free(skeleton.name, "");
  }

  UsdLayer write(const UsdOptions& options, std::vector<std::string>& notes) {
    UsdPictures pictures(file_, model_, options.picture_folder, options.packed, notes);
    UsdText materials(1);
    materials_ = write_usd_materials(materials, model_, usd_root, pictures);
    UsdText nodes(1);
    for (const int node : scene_.nodes) {
      const int parent = scene_.parents[idx(node)];
      if (parent < 0 || !shown_[idx(parent)]) add_node(nodes, node, usd_root, names_of_root_);
    }
    for (const int node : scene_.nodes) {
      throw_if_stopped(monitor_.stop);
      if (stands_alone(node)) add_mesh(nodes, node, usd_root, names_of_root_);
    }
    UsdText all(1);
    for (std::size_t k = 0; k < skeletons_.all.size(); ++k) add_skeleton(all, k);
    std::string text = header(options);
    text += all.text();
    text += nodes.text();
    text += materials.text();
    text += "}\n";
    return {std::move(text), std::move(pictures).taken()};
  }

 private:
  [[nodiscard]] const tinygltf::Node& node_of(int node) const { return model_.nodes[idx(node)]; }

  /// A mesh that joints move, or that hangs from one, lies below the root.
  [[nodiscard]] bool stands_alone(int node) const {
    return node_of(node).mesh >= 0 && (node_of(node).skin >= 0 || joint_of(node) >= 0);
  }

  /// The node itself or its parent, if that is a joint; else -1.
  [[nodiscard]] int joint_of(int node) const {
    const int parent = scene_.parents[idx(node)];
    if (skeletons_.is_joint[idx(node)]) return node;
    return parent >= 0 && skeletons_.is_joint[idx(parent)] ? parent : -1;
  }

  /// False of joints, of what holds them alone, and of what only holds meshes that they move.
  [[nodiscard]] bool is_needed(int node) const {
    const tinygltf::Node& given = node_of(node);
    if (!shown_[idx(node)] || joint_of(node) >= 0) return false;
    if (given.mesh >= 0 && given.skin < 0) return true;
    if (given.children.empty()) return given.mesh < 0;
    return std::ranges::any_of(given.children, [&](int child) { return is_needed(child); });
  }

  void add_node(UsdText& text, int node, const std::string& above, UsdNames& names) {
    if (!is_needed(node)) return;
    const tinygltf::Node& given = node_of(node);
    const bool is_mesh = given.mesh >= 0 && given.skin < 0;
    const bool has_more =
        std::ranges::any_of(given.children, [&](int child) { return is_needed(child); });
    if (is_mesh && !has_more) return add_mesh(text, node, above, names);
    const std::string name = names.free(given.name, "node");
    const std::string path = above + "/" + name;
    text.begin("Xform", name, {{}, usd_true_name(given.name, name)});
    text.append(place_of(node, path));
    UsdNames children;
    for (const int child : given.children) add_node(text, child, path, children);
    if (is_mesh) add_mesh(text, node, path, children, true);
    text.end();
  }

  /// As of the animation that is shown.
  [[nodiscard]] std::string place_of(int node, const std::string& path) {
    const auto depth = static_cast<std::size_t>(std::ranges::count(path, '/'));
    const GltfMotion* motion = nullptr;
    if (const GltfAnimation* shown = shown_animation()) {
      const auto found = shown->motions.find(node);
      if (found != shown->motions.end()) motion = &found->second;
    }
    return usd_place(node_of(node), motion, depth, span_);
  }

  /// The first that moves what the scene has.
  [[nodiscard]] const GltfAnimation* shown_animation() const {
    const auto moves_it = [&](const GltfAnimation& animation) {
      return std::ranges::any_of(animation.motions,
                                 [&](const auto& one) { return shown_[idx(one.first)]; });
    };
    const auto found = std::ranges::find_if(animations_, moves_it);
    return found == animations_.end() ? nullptr : &*found;
  }

  void add_mesh(UsdText& text, int node, const std::string& above, UsdNames& names,
                bool is_placed = false) {
    const tinygltf::Node& given = node_of(node);
    const bool is_skinned = given.skin >= 0;
    const std::size_t joints =
        is_skinned ? gltf_element(file_, model_.skins, given.skin, "skin").joints.size() : 0;
    const tinygltf::Mesh& own = gltf_element(file_, model_.meshes, given.mesh, "mesh");
    const auto number = idx(given.mesh);
    WholeMesh mesh = read_whole_mesh(file_, model_, given.mesh, joints, sets_of(own));
    if (number < polygons_.size()) take_polygons(mesh, polygons_[number]);
    if (mesh.empty()) return;
    for (std::size_t k = 0; k < std::min(mesh.shapes.size(), given.weights.size()); ++k) {
      mesh.shapes[k].weight = given.weights[k];
    }
    const std::string& true_name = given.name.empty() ? own.name : given.name;
    const std::string name = names.free(true_name, "Surface");
    UsdMeshLinks links;
    links.path = above + "/" + name;
    links.true_name = usd_true_name(true_name, name);
    const std::size_t skeleton = bind(mesh, node, links);
    if (!stands_alone(node) && !is_placed) links.place = place_of(node, links.path);
    link_materials(mesh, links);
    link_shapes(mesh, node, skeleton, links);
    write_usd_mesh(text, mesh, links);
  }

  /// Into the scene, as it was bound. Returns the skeleton's number.
  std::size_t bind(WholeMesh& mesh, int node, UsdMeshLinks& links) {
    const int skin = node_of(node).skin;
    if (!stands_alone(node) || skeletons_.all.empty()) return 0;
    const std::size_t number = skin >= 0 ? skeletons_.of_skin[idx(skin)] : 0;
    const UsdSkeleton& skeleton = skeletons_.all[number];
    links.skeleton = path_of(skeleton);
    std::vector<int> numbers;
    const auto number_of = [&](int joint) {
      const auto found = skeleton.number_of_node.find(joint);
      return found == skeleton.number_of_node.end() ? -1 : static_cast<int>(found->second);
    };
    Affine3d placed = Affine3d::Identity();
    if (skin >= 0) {
      for (const int joint : model_.skins[idx(skin)].joints) numbers.push_back(number_of(joint));
      placed = skeletons_.placed[idx(skin)];
    } else {
      const int joint = joint_of(node);
      numbers.push_back(number_of(joint));
      mesh.moved.resize(1);
      for (std::int32_t vertex = 0; idx(vertex) < mesh.places.size() / 3; ++vertex) {
        mesh.moved[0].emplace_back(vertex, 1.0);
      }
      placed = skeleton.bound[idx(numbers.front())];
      if (joint != node) placed = placed * frame_of(node_of(node));
    }
    if (!placed.matrix().isIdentity(0)) move(mesh, placed);
    links.weights = usd_weights(mesh, numbers);
    return number;
  }

  [[nodiscard]] static std::string path_of(const UsdSkeleton& skeleton) {
    return std::string(usd_root) + "/" + skeleton.name;
  }

  void link_materials(WholeMesh& mesh, UsdMeshLinks& links) const {
    std::set<std::array<double, 4>> factors;
    for (const int material : mesh.materials) {
      const bool is_there = material >= 0 && idx(material) < materials_.paths.size();
      links.materials.push_back(is_there ? materials_.paths[idx(material)] : "");
      if (!is_there) continue;
      factors.insert(materials_.colour_factors[idx(material)]);
      links.is_double_sided = links.is_double_sided || model_.materials[idx(material)].doubleSided;
    }
    if (mesh.colours.empty() || factors.size() != 1) return;
    for (std::size_t k = 0; k < mesh.colours[0].size(); ++k) {
      mesh.colours[0][k] *= (*factors.begin())[k % 4];
    }
  }

  void link_shapes(const WholeMesh& mesh, int node, std::size_t skeleton, UsdMeshLinks& links) {
    if (mesh.shapes.empty() || skeletons_.all.empty()) return;
    std::vector<UsdSlider> shapes;
    for (std::size_t k = 0; k < mesh.shapes.size(); ++k) {
      shapes.push_back({mesh.shapes[k].name, node, k, mesh.shapes[k].weight});
    }
    const std::string name = links.path.substr(links.path.rfind('/') + 1);
    links.shape_tokens = usd_shape_tokens(shapes, name, animations_, sliders_[skeleton]);
    links.skeleton = path_of(skeletons_.all[skeleton]);
  }

  void add_skeleton(UsdText& text, std::size_t number) {
    const UsdSkeleton& skeleton = skeletons_.all[number];
    const std::vector<UsdSlider>& sliders = sliders_[number].all;
    const UsdMoved moved{model_, skeleton, sliders};
    UsdText animations(2);
    UsdNames names;
    std::string bound;
    for (const GltfAnimation& animation : animations_) {
      throw_if_stopped(monitor_.stop);
      UsdNames tried = names;
      const std::string name = tried.free(animation.name, "Animation");
      UsdSpan span;
      if (!write_usd_animation(animations, name, animation, moved, span)) continue;
      names = std::move(tried);
      if (!bound.empty()) continue;
      bound = name;
      span_.take({span.first, span.last});
    }
    if (bound.empty() && !sliders.empty()) {
      bound = names.free("Shapes", "");
      write_usd_rest_shapes(animations, bound, sliders);
    }
    text.begin("Skeleton", skeleton.name,
               bound.empty() ? UsdPrim{} : UsdPrim{{"SkelBindingAPI"}, ""});
    write_usd_skeleton(text, skeleton);
    if (!bound.empty()) {
      text.line("rel skel:animationSource = " + usd_target(path_of(skeleton) + "/" + bound));
    }
    text.append(animations.text());
    text.end();
  }

  [[nodiscard]] std::string header(const UsdOptions& options) const {
    std::string text = "#usda 1.0\n(\n    defaultPrim = \"Model\"\n    doc = " +
                       usd_quoted(options.name + ", by " + options.provenance) + "\n";
    if (span_.is_there) {
      text += "    endTimeCode = ";
      append_decimal(text, span_.last);
    }
    if (span_.is_there) text += "\n";
    text += "    metersPerUnit = 1\n";
    if (span_.is_there) {
      text += "    startTimeCode = ";
      append_decimal(text, span_.first);
      text += "\n    timeCodesPerSecond = ";
      append_decimal(text, usd_codes_a_second);
      text += "\n";
    }
    return text +
           "    upAxis = \"Y\"\n)\n\ndef SkelRoot \"Model\" (\n    kind = \"component\"\n)\n{\n";
  }

  const FileBytes& file_;
  const tinygltf::Model& model_;
  const std::vector<MeshPolygons>& polygons_;  // by mesh, or none
  const Monitor& monitor_;
  GltfScene scene_;
  std::vector<GltfAnimation> animations_;
  UsdSkeletons skeletons_;
  std::vector<UsdSliders> sliders_;  // by skeleton
  std::vector<bool> shown_;          // by node
  UsdNames names_of_root_;
  UsdMaterials materials_;
  UsdSpan span_;
};

}  // namespace

UsdLayer usd_of_glb(std::string glb, const UsdOptions& options, std::vector<std::string>& notes,
                    const std::vector<MeshPolygons>& polygons, const Monitor& monitor) {
  const FileBytes file{"rig.glb", std::move(glb)};
  const tinygltf::Model model = parse_gltf(file, monitor, GltfAttributes::all);
  return LayerWriter(file, model, polygons, monitor).write(options, notes);
}

}  // namespace curveskel
