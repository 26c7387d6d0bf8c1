// Rig files, out: glTF 2.0 and formats of other programs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/names.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

enum class RigFormat { glb, gltf, vrm, fbx, usda, usdz, bvh, json, npz, txt };

inline constexpr NameTable<RigFormat, 10> rig_formats{{
    {RigFormat::glb, "glb", "glTF 2.0, one binary file"},
    {RigFormat::gltf, "gltf", "glTF 2.0, text with its numbers inside"},
    {RigFormat::vrm, "vrm", "VRM 1.0, of humanoids: glb that says which joint is which"},
    {RigFormat::fbx, "fbx", "FBX 7.4: the surface, joints, weights, materials, pictures inside"},
    {RigFormat::usda, "usda", "USD, text: the same as FBX, pictures in a folder beside it"},
    {RigFormat::usdz, "usdz", "the same in one archive with its pictures"},
    {RigFormat::bvh, "bvh", "joints alone, at rest, for programs of motion capture"},
    {RigFormat::json, "json", "joints, roles and weights by vertex, for programs"},
    {RigFormat::npz, "npz", "the same for NumPy"},
    {RigFormat::txt, "txt", "RigNet's: joints, hierarchy, weights"},
}};

/// VRM wants all three.
struct VrmMeta {
  std::string name;
  std::string author;
  std::string licence_url;
};

/// Throws Error(Fault::usage) that says what is missing.
void require_whole(const VrmMeta& meta);

/// A VRM file, as it says of itself.
struct VrmOfFile {
  bool is_version_0 = false;  ///< VRM 0.x, of which no texts are read
  VrmMeta meta;               ///< the first author; "" where there is none
};

/// Nothing of a file that is no VRM. Throws Error(Fault::input) where it can't be read. Linear in
/// the file.
[[nodiscard]] std::optional<VrmOfFile> read_vrm(const std::filesystem::path& path,
                                                const Monitor& monitor = {});

/// True for USD.
[[nodiscard]] constexpr bool is_usd(RigFormat format) {
  return format == RigFormat::usda || format == RigFormat::usdz;
}

/// True for those that `format_rig_into` writes: glTF, and FBX and USD, which are made from it.
[[nodiscard]] constexpr bool keeps_the_file(RigFormat format) {
  return format == RigFormat::glb || format == RigFormat::gltf || format == RigFormat::vrm ||
         format == RigFormat::fbx || is_usd(format);
}

/// The surface with its joints and weights, for Blender and whatever else reads glTF; give the
/// bytes to `write_file`; it has no pictures. docs/formats.md has what the other formats hold: bvh,
/// json, npz and txt have joints and weights without the surface. In glTF, vertices and triangles
/// keep their order, positions and weights are in single precision (as glTF has them), normals are
/// those of `vertex_normals`, the same for all vertices in one place. The y axis of a joint points
/// along its bone. All hang from one node named `name`. `provenance` goes to the file's generator.
/// Precondition: weights have a row for each vertex, of sum 1 and at most four joints. Throws
/// Error(Fault::output) where there are more than 65,536 joints or where single precision does not
/// suffice for the coordinates, Error(Fault::input) for a rig without joints, numbers that are not
/// finite and weights below 0; of vrm, Error(Fault::usage) where `vrm` is not whole and
/// Error(Fault::input) where the roles that VRM requires are not there. O(#V + #F + joints).
[[nodiscard]] std::string format_rig(const Surface& surface, const Rig& rig, RigFormat format,
                                     const std::string& name, const std::string& provenance,
                                     const VrmMeta& vrm = {});

enum class OldRig { replaced, kept };

struct EditOptions {
  RigFormat format = RigFormat::glb;
  OldRig old_rig = OldRig::replaced;
  std::string name;        ///< of the node that holds all joints
  std::string provenance;  ///< `asset.extras.rigged_by`; the generator of what was no glTF
  VrmMeta vrm = {};        ///< where the rig of a VRM 1.0 file is kept, "" = as the file says
  /// glTF, FBX and COLLADA whose old joints rest in another pose than they were bound in: the new
  /// rig rests as the old one was bound, where the file's numbers stay as they are; false = as the
  /// file is shown, for which positions, normals and tangents are written anew.
  bool as_bound = true;
  std::string picture_folder = "textures";  ///< of usda, see `picture_folder_of`
};

/// A file that another one names.
struct SideFile {
  std::string name;  ///< from the other's folder: "hero_textures/skin.png"
  std::string bytes;
};

struct EditedFile {
  std::string bytes;
  std::vector<std::string> notes;         ///< what is missing or left out, a line each
  int joints_replaced = 0;                ///< of an old rig
  int channels_removed = 0;               ///< of animations that moved them
  std::vector<SideFile> side_files = {};  ///< of usda: its pictures, for `write_rig_file`
};

/// The file itself with the rig in it. Of glTF every byte of the buffers and every member of the
/// JSON stays, but for what docs/formats.md lists; appended are joints, skins, inverse bind
/// matrices, JOINTS_0 and WEIGHTS_0; files beside it (buffers, pictures) are taken in, compressed
/// meshes made plain. A rig that is there goes, or is kept: then `rig` has the joints that
/// `read_rig` finds in the file, and only their weights are written. OBJ with materials, texture
/// coordinates or normals becomes glTF that has them: the vertices of the file in their order, then
/// copies for corners with other texture coordinates or normals; FBX, COLLADA and PLY likewise.
/// If the old rig of FBX or COLLADA is kept, `rig` has the joints that `read_joints` finds in
/// the file, and its animations move them, and what hangs from them without a skin. Shapes that an
/// FBX file moves go on moving in either case. Nothing for all other files, for which `format_rig`
/// loses nothing. Precondition: weights have a row for each vertex that `read_polygons` finds in
/// the file, read with the same `as_bound` (false where the old rig is kept). Throws
/// Error(Fault::input) for what cannot be edited, by name, and Error(Fault::output) as
/// `format_rig`. O(bytes of the file).
[[nodiscard]] std::optional<EditedFile> format_rig_into(const std::filesystem::path& input,
                                                        const Rig& rig,
                                                        const EditOptions& options = {},
                                                        const Monitor& monitor = {});

/// The folder for pictures beside a file, called after it: "hero_textures" of "out/hero.usda".
[[nodiscard]] std::string picture_folder_of(const std::filesystem::path& output);

/// Throws Error(Fault::output) where a side file would take the place of a file that is there and
/// that the file which is replaced does not name. O(bytes).
void require_free_places(const std::filesystem::path& file,
                         const std::vector<SideFile>& side_files);

/// `write_file` of each side file, then of the file itself, so that it never names what is not
/// there; those that are there already stay. Nothing is written where `require_free_places` throws.
/// Throws Error(Fault::output). O(bytes).
void write_rig_file(const std::filesystem::path& file, std::string_view bytes,
                    const std::vector<SideFile>& side_files = {});

/// Throws Error(Fault::input) where `format_rig_into` would, before a rig is made. O(bytes).
void require_editable(const std::filesystem::path& input, OldRig old_rig,
                      const Monitor& monitor = {});

}  // namespace curveskel
