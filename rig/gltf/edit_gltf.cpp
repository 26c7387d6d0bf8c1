// The input's own file with a rig in it.
#include <tiny_gltf.h>

#include <algorithm>
#include <exception>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include <curveskel/rig_files.hpp>
#include "base/option_ranges.hpp"
#include "base/utf8.hpp"
#include "rig/animations/add_animations.hpp"
#include "rig/animations/read_joint_animations.hpp"
#include "rig/fbx/fbx_of_glb.hpp"
#include "rig/fbx/fbx_shape_animations.hpp"
#include "rig/gltf/add_gltf_rig.hpp"
#include "rig/gltf/bent_vertices.hpp"
#include "rig/gltf/dressed_document.hpp"
#include "rig/gltf/dressed_file.hpp"
#include "rig/gltf/gltf_decoded.hpp"
#include "rig/gltf/gltf_document.hpp"
#include "rig/gltf/gltf_weights.hpp"
#include "rig/gltf/hanging_parts.hpp"
#include "rig/gltf/remove_gltf_rig.hpp"
#include "rig/gltf/skin_numbers.hpp"
#include "rig/gltf/vrm.hpp"
#include "rig/io/rig_formats.hpp"
#include "rig/joints/placed_rig.hpp"
#include "rig/joints/sound_rig.hpp"
#include "rig/usd/usd_of_glb.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/gltf_file.hpp"
#include "surface/read/placed_vertices.hpp"

namespace curveskel {
namespace {

constexpr std::string_view bare_remedy = "use --bare, which writes the surface alone";

void refuse_instancing(const GltfDocument& document, const FileBytes& file) {
  constexpr std::string_view instancing = "EXT_mesh_gpu_instancing";
  const OrderedJson used = document.json.value("extensionsUsed", OrderedJson::array());
  if (std::find(used.begin(), used.end(), std::string(instancing)) == used.end()) return;
  file.fail("the extension " + in_quotes(instancing) + ", which repeats a mesh without nodes",
            "a node for each mesh that is shown",
            "export the file without it, or " + std::string(bare_remedy));
}

void require_rows(Eigen::Index rows, const Rig& rig, const FileBytes& file) {
  if (rows == rig.weights.rows()) return;
  file.fail(std::to_string(rows) + " vertices",
            "the " + std::to_string(rig.weights.rows()) + " that the rig has weights for",
            "leave the file alone while it is rigged");
}

/// Points and lines move with the nearest vertex.
SkinWeights loose_weights(const GltfScene& scene, const Rig& rig, const FileBytes& file) {
  if (scene.loose.rows() == 0) return {};
  PolygonSoup soup = scene.soup;
  drop_unplaced_vertices(soup, file);
  const Surface surface{soup.positions, triangulate(soup)};
  const SurfaceTree tree(surface);
  std::vector<int> nearest;
  for (const auto& place : scene.loose.rowwise()) {
    const auto corners =
        surface.triangles.row(place.allFinite() ? tree.nearest(place.transpose()).triangle : 0);
    const auto distance = [&](int v) { return (surface.positions.row(v) - place).squaredNorm(); };
    nearest.push_back(*std::min_element(corners.begin(), corners.end(),
                                        [&](int a, int b) { return distance(a) < distance(b); }));
  }
  return chosen_rows(rig.weights, nearest);
}

/// Of each of the rig's joints the number in the skin: its own, else that of the nearest joint
/// above it that is there, else -1.
GltfSkinJoints joints_in_skin(const GltfRig& own, const std::vector<int>& skin_nodes, int skin) {
  GltfSkinJoints found{skin, {}};
  for (std::size_t joint = 0; joint < own.nodes.size(); ++joint) {
    const auto place = std::find(skin_nodes.begin(), skin_nodes.end(), own.nodes[joint]);
    const int parent = own.rig.parents[static_cast<Eigen::Index>(joint)];
    found.joints.push_back(place != skin_nodes.end() ? static_cast<int>(place - skin_nodes.begin())
                           : parent >= 0             ? found.joints[idx(parent)]
                                                     : -1);
  }
  return found;
}

/// New weights for the skins that are there. Returns the node of each of the rig's joints.
std::vector<int> keep_gltf_rig(GltfDocument& document, const FileBytes& file,
                               const tinygltf::Model& model, const GltfScene& scene,
                               const GltfWeights& weights) {
  GltfRig own = rig_of_scene(file, model, scene);
  if (own.nodes.size() != idx(weights.of_soup.cols())) {
    file.fail(std::to_string(own.nodes.size()) + " joints in the file",
              "the " + std::to_string(weights.of_soup.cols()) + " of the rig",
              "give the joints that `read_rig` finds in this file");
  }
  std::vector<GltfPart> parts;
  std::vector<GltfSkinJoints> joints;
  for (const GltfPart& part : scene.parts) {
    const int skin = model.nodes[idx(part.node)].skin;
    if (skin < 0) continue;  // moves with its node, as before
    parts.push_back(part);
    joints.push_back(joints_in_skin(own, model.skins[idx(skin)].joints, skin));
  }
  write_gltf_weights(document, parts, weights, joints);
  return std::move(own.nodes);
}

/// Joints that rest apart from their bind pose bend the surface at rest, and new weights bend it in
/// another way. `document` has them.
void note_changed_rest(const GltfDocument& document, const FileBytes& file, const GltfScene& scene,
                       std::vector<std::string>& notes, const Monitor& monitor) {
  constexpr double visible = 1e-3;
  const FileBytes written{file.path, format_gltf(document, RigFormat::glb)};
  const tinygltf::Model model = parse_gltf(written, monitor);
  const Positions now = read_gltf_scene(written, model, monitor).soup.positions;
  const Positions& before = scene.soup.positions;
  const double farthest = (now - before).rowwise().norm().maxCoeff<Eigen::PropagateNumbers>();
  const double share = farthest / bounding_box_diagonal(before);
  if (!(share >= visible)) return;
  std::ostringstream note;
  note.precision(2);
  note << "the joints rest in another pose than they were bound in, and the new weights bend the "
          "surface there in another way than the old ones, by up to "
       << 100 * share
       << " % of the size; --joints with this file itself binds the same joints to the surface as "
          "it is shown, without their animations";
  notes.push_back(note.str());
}

/// By node.
std::vector<bool> shown_nodes(const GltfDocument& document, const GltfScene& scene) {
  const auto nodes = document.json.find("nodes");
  std::vector<bool> shown(nodes == document.json.end() ? 0 : nodes->size(), scene.nodes.empty());
  for (const int node : scene.nodes) shown[idx(node)] = true;
  return shown;
}

RemovedRig replace_gltf_rig(GltfDocument& document, const FileBytes& file,
                            const tinygltf::Model& model, const GltfScene& scene, const Rig& rig,
                            const GltfWeights& weights, const EditOptions& options) {
  add_missing_nodes(document);
  const std::vector<bool> shown = shown_nodes(document, scene);
  RemovedRig removed = remove_gltf_rig(document, shown, file);
  std::vector<GltfPart> parts = scene.parts;
  for (GltfPart& part : parts) part.node = removed.new_node[idx(part.node)];
  write_gltf_weights(document, parts, weights,
                     std::vector<GltfSkinJoints>(parts.size(), GltfSkinJoints{-1, {}}));
  if (!options.as_bound) write_bent_vertices(document, parts, file, model, scene);
  const int holder = removed.holder;
  const bool stays = holder >= 0 && shown[idx(holder)] &&
                     scene.frames[idx(holder)].matrix() == Eigen::Matrix4d::Identity();
  add_gltf_rig(document, parts, rig, options.name, stays ? removed.new_node[idx(holder)] : -1);
  return removed;
}

/// Beside what the file says of itself.
void sign(GltfDocument& document, const std::string& provenance) {
  OrderedJson& asset = document.json["asset"];
  if (asset.contains("extras") && !asset["extras"].is_object()) return;
  asset["extras"]["rigged_by"] = as_utf8(provenance);
}

/// Of what the parser took all the same.
[[noreturn]] void refuse_broken(const FileBytes& file, const std::exception_ptr& failure) {
  const std::string remedy = "export the file again, or " + std::string(bare_remedy);
  try {
    std::rethrow_exception(failure);
  } catch (const nlohmann::json::exception& broken) {
    file.fail(std::string("JSON that is no valid glTF: ") + broken.what(), "glTF 2.0", remedy);
  } catch (const std::out_of_range& broken) {
    file.fail(std::string("a number of what is not there: ") + broken.what(), "glTF 2.0", remedy);
  }
}

void finish(EditedFile& edited, GltfDocument document, const EditOptions& options,
            const Monitor& monitor, const std::vector<MeshPolygons>& polygons = {}) {
  const bool is_fbx = options.format == RigFormat::fbx;
  const bool is_plain = !is_fbx && !is_usd(options.format);
  edited.bytes = format_gltf(std::move(document), is_plain ? options.format : RigFormat::glb);
  if (is_fbx) {
    edited.bytes = fbx_of_glb(std::move(edited.bytes), options.provenance, polygons, monitor);
  }
  if (!is_usd(options.format)) return;
  const bool packed = options.format == RigFormat::usdz;
  UsdLayer layer = usd_of_glb(
      std::move(edited.bytes),
      {options.name, options.provenance, packed ? "textures" : options.picture_folder, packed},
      edited.notes, polygons, monitor);
  edited.bytes = packed ? usdz_of(layer, "rig.usda") : std::move(layer.text);
  if (!packed) edited.side_files = std::move(layer.pictures);
}

/// Of a file with its new joints, which keep the names of their roles: programs find them by these.
void note_shared_names(const OrderedJson& gltf, std::vector<std::string>& notes) {
  std::map<std::string, bool> joints;  // by name, true if another node has it
  std::set<std::size_t> numbers;
  for (const OrderedJson& joint : gltf.at("skins").back().at("joints")) {
    numbers.insert(joint.get<std::size_t>());
  }
  const OrderedJson& nodes = gltf.at("nodes");
  for (const std::size_t number : numbers) joints[nodes.at(number).value("name", "")] = false;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const auto joint = joints.find(nodes[node].value("name", ""));
    if (joint != joints.end() && !numbers.contains(node)) joint->second = true;
  }
  std::string shared;
  for (const auto& [name, is_shared] : joints) {
    if (is_shared && !name.empty()) shared += (shared.empty() ? "" : ", ") + in_quotes(name);
  }
  if (shared.empty()) return;
  notes.push_back("joints have the names of other nodes (" + shared +
                  "), so a program may put a number behind either; rename those nodes, or give "
                  "the joints other names (--names; beside --joints, in that file)");
}

EditedFile edit_gltf(const FileBytes& file, const Rig& rig, const EditOptions& options,
                     const Monitor& monitor) {
  const tinygltf::Model model = parse_gltf(file, monitor, GltfAttributes::all);
  const bool replaces = options.old_rig == OldRig::replaced;
  const GltfScene scene =
      read_gltf_scene(file, model, monitor, {replaces && options.as_bound, true});
  require_rows(scene.soup.positions.rows(), rig, file);
  EditedFile edited;
  GltfDocument document = read_gltf_document(file, model, edited.notes, monitor);
  refuse_instancing(document, file);
  const GltfWeights weights{rig.weights, loose_weights(scene, rig, file)};
  std::vector<int> kept_nodes;
  try {
    decode_gltf(document, model);
    if (replaces) {
      const RemovedRig removed =
          replace_gltf_rig(document, file, model, scene, rig, weights, options);
      edited.joints_replaced = removed.joints;
      edited.channels_removed = removed.channels;
      note_shared_names(document.json, edited.notes);
    } else {
      kept_nodes = keep_gltf_rig(document, file, model, scene, weights);
      if (scene.soup.posed) note_changed_rest(document, file, scene, edited.notes, monitor);
    }
    sign(document, options.provenance);
  } catch (const std::exception&) {
    refuse_broken(file, std::current_exception());
  }
  if (options.format == RigFormat::vrm) {
    if (replaces) {
      add_vrm(document.json, rig, options.vrm);
    } else {
      keep_vrm(document.json, rig, kept_nodes, options.vrm);
    }
  }
  finish(edited, std::move(document), options, monitor);
  return edited;
}

bool keeps_polygons(RigFormat format) { return format == RigFormat::fbx || is_usd(format); }

/// Of the file's own joints.
AnimatedJoints read_animations(const FileBytes& file, const Rig& rig, const Monitor& monitor) {
  AnimatedJoints animated = read_joint_animations(file, monitor);
  if (!animated.animations.empty() && animated.rest.size() != idx(rig.parents.size())) {
    file.fail(std::to_string(animated.rest.size()) + " joints in the file",
              "the " + std::to_string(rig.parents.size()) + " of the rig",
              "give the joints that `read_joints` finds in this file");
  }
  return animated;
}

std::vector<ShapeAnimation> read_shape_animations(const FileBytes& file,
                                                  std::optional<SurfaceFormat> format,
                                                  const Monitor& monitor) {
  if (format == SurfaceFormat::fbx) return read_fbx_shape_animations(file, monitor);
  return {};
}

/// Nothing: the file has no more than a bare rig has.
std::optional<EditedFile> dress(const FileBytes& file, const Rig& rig, const EditOptions& options,
                                const Monitor& monitor) {
  EditedFile edited;
  const bool keeps = options.old_rig == OldRig::kept;
  AnimatedJoints animated;
  if (keeps) animated = read_animations(file, rig, monitor);
  const LookOptions looks{options.as_bound && !keeps, keeps_polygons(options.format),
                          !animated.animations.empty()};
  auto dressed = read_dressed_file(file, looks, edited.notes, monitor);
  if (!dressed) return std::nullopt;
  const auto format = surface_format_of(file);
  const bool states_axes = format == SurfaceFormat::fbx || format == SurfaceFormat::dae;
  if (!states_axes) dressed->mesh.to_gltf = Eigen::Affine3d(rig.to_y_up);
  require_rows(static_cast<Eigen::Index>(dressed->mesh.places.size() / 3), rig, file);
  DressedDocument made = dressed_document(dressed->mesh, dressed->materials, file,
                                          file.path.stem().string(), edited.notes, monitor);
  SkinWeights rows = chosen_rows(rig.weights, made.row_of_vertex);
  if (keeps) rows = with_hanging_parts(rows, made, dressed->mesh.parts);
  write_gltf_weights(made.document, made.parts, {rows, {}},
                     std::vector<GltfSkinJoints>(made.parts.size(), GltfSkinJoints{-1, {}}));
  const Rig upright = placed(rig, dressed->mesh.to_gltf);
  const std::size_t first_joint = add_gltf_rig(made.document, made.parts, upright, options.name);
  const GltfJoints joints{upright, first_joint, dressed->mesh.to_gltf};
  const std::vector<ShapeAnimation> shapes = read_shape_animations(file, format, monitor);
  add_animations(made.document, animated, joints, shapes, made.node_of_part);
  if (keeps) add_hanging_places(made.document, file, joints, monitor);
  note_shared_names(made.document.json, edited.notes);
  if (!keeps) {
    const FileJoints old = count_joints(file, monitor);
    edited.joints_replaced = old.joints;
    edited.channels_removed = old.channels;
  }
  made.document.json["asset"]["generator"] = as_utf8(options.provenance);
  if (options.format == RigFormat::vrm) add_vrm(made.document.json, rig, options.vrm);
  finish(edited, std::move(made.document), options, monitor, made.polygons);
  return edited;
}

}  // namespace

void require_editable(const std::filesystem::path& input, OldRig old_rig, const Monitor& monitor) {
  const FileBytes file = read_file(input, monitor);
  const auto format = surface_format_of(file);
  if (format != SurfaceFormat::glb && format != SurfaceFormat::gltf) return;
  const tinygltf::Model model = parse_gltf(file, monitor, GltfAttributes::all);
  const GltfScene scene = read_gltf_scene(file, model, monitor);
  std::vector<std::string> notes;
  GltfDocument document = read_gltf_document(file, model, notes, monitor);
  refuse_instancing(document, file);
  if (old_rig == OldRig::kept) return;
  try {
    add_missing_nodes(document);
    (void)remove_gltf_rig(document, shown_nodes(document, scene), file);
  } catch (const std::exception&) {
    refuse_broken(file, std::current_exception());
  }
}

std::optional<EditedFile> format_rig_into(const std::filesystem::path& input, const Rig& rig,
                                          const EditOptions& options, const Monitor& monitor) {
  const OptionCheck check("EditOptions");
  check.choice("format", options.format, rig_formats);
  check.number("old_rig", static_cast<int>(options.old_rig), {0, 1});
  if (!keeps_the_file(options.format)) return std::nullopt;
  require_writable(rig, "format_rig_into");
  const FileBytes file = read_file(input, monitor);
  const auto format = surface_format_of(file);
  const bool is_gltf = format == SurfaceFormat::glb || format == SurfaceFormat::gltf;
  const bool may_be_vrm = is_gltf && options.old_rig == OldRig::kept;
  if (options.format == RigFormat::vrm && !may_be_vrm) require_vrm(rig, options.vrm);
  if (is_gltf) {
    return edit_gltf(file, rig, options, monitor);
  }
  return dress(file, rig, options, monitor);
}

}  // namespace curveskel
