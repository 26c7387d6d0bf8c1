#include "surface/read/foreign_formats.hpp"

#include <array>
#include <string>

#include <curveskel/advanced/file_names.hpp>
#include "surface/read/zip_archive.hpp"

namespace curveskel {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view export_scene = "export it as .glb, .obj or .ply";
constexpr std::string_view export_usd =
    "curveskel writes USD and does not read it; export it as .glb, .obj or .ply";
constexpr std::string_view export_solid = "export it from its CAD program as .stl, .3mf or .obj";
constexpr std::string_view unpack = "unpack it and give the surface file that is in it";
constexpr std::string_view fetch = "give the surface file itself";

constexpr std::array<ForeignFormat, 23> foreign_starts{{
    {"BLENDER"sv, "a Blender scene", export_scene},
    {"PXR-USDC"sv, "a USD scene", export_usd},
    {"#usda"sv, "a USD scene", export_usd},
    {"#VRML"sv, "a VRML scene", export_scene},
    {"#X3D"sv, "an X3D scene", export_scene},
    {"Ogawa"sv, "an Alembic scene", export_scene},
    {"MM\0"sv, "a 3D Studio scene (3DS)", export_scene},
    {"AC3D"sv, "an AC3D scene", export_scene},
    {"xof "sv, "a DirectX scene", export_scene},
    {"FORM"sv, "a LightWave object", export_scene},
    {"ISO-10303-21"sv, "a STEP file", export_solid},
    {"3D Geometry File Format"sv, "a Rhino file (3DM)", export_solid},
    {"**ABCDEFGHIJKLM"sv, "a Parasolid file", export_solid},
    {"7z\xBC\xAF"sv, "a 7z archive", unpack},
    {"Rar!"sv, "a RAR archive", unpack},
    {"BZh"sv, "a file packed by bzip2", unpack},
    {"\xFD"
     "7zXZ"sv,
     "a file packed by xz", unpack},
    {"\x28\xB5\x2F\xFD"sv, "a file packed by Zstandard", unpack},
    {"HIERARCHY"sv, "a BVH motion", fetch},
    {"\x89HDF"sv, "an HDF5 file", fetch},
    {"\x89PNG"sv, "a PNG picture", fetch},
    {"%PDF"sv, "a PDF document", fetch},
    {"version https://git-lfs"sv, "a pointer of Git LFS", "fetch the file itself (git lfs pull)"},
}};

constexpr std::array<ForeignFormat, 5> foreign_elements{{
    {"<X3D"sv, "an X3D scene", export_scene},
    {"<amf"sv, "an AMF file", "export it as .3mf, .stl or .ply"},
    {"<svg"sv, "an SVG picture", fetch},
    {"<html"sv, "a web page", fetch},
    {"<!DOCTYPE html"sv, "a web page", fetch},
}};

/// The files of this program that are no surface and look like glTF, as they are JSON.
constexpr std::array<ForeignFormat, 2> own_json{{
    {"\"curveskel skeleton\""sv, "a skeleton of curveskel", "give the surface that it is in"},
    {"\"curveskel-rig\""sv, "a rig of curveskel", "give the surface, or the rig as .glb"},
}};

/// USDZ begins with the scene, as its standard asks.
bool is_usd_archive(std::string_view content) {
  constexpr std::size_t length_at = 26;  // of the first file's name, in two bytes
  constexpr std::size_t name_at = 30;
  if (content.size() < name_at || !is_zipped(std::string(content.substr(0, name_at)))) return false;
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(content[k]); };
  const std::size_t length = byte(length_at) + 256U * byte(length_at + 1);
  const std::string extension = lower_extension(content.substr(name_at, length));
  return extension == "usd" || extension == "usda" || extension == "usdc";
}

}  // namespace

std::optional<ForeignFormat> foreign_format_of(const FileBytes& file) {
  constexpr std::size_t first_lines = 2000;
  for (const ForeignFormat& format : foreign_starts) {
    if (file.content.starts_with(format.start)) return format;
  }
  if (is_usd_archive(file.content)) return ForeignFormat{"PK", "a USD scene (USDZ)", export_usd};
  const std::string_view text = std::string_view(file.content).substr(0, first_lines);
  const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (begin == std::string_view::npos || text[begin] != '<') return std::nullopt;
  for (const ForeignFormat& format : foreign_elements) {
    if (text.find(format.start) != std::string_view::npos) return format;
  }
  return std::nullopt;
}

void refuse_own_json(const FileBytes& file) {
  if (!file.content.starts_with("{")) return;
  constexpr std::size_t first_words = 60;
  const std::string_view text = std::string_view(file.content).substr(0, first_words);
  for (const ForeignFormat& format : own_json) {
    if (text.find(format.start) == std::string_view::npos) continue;
    file.fail(format.name, "a surface file", format.remedy);
  }
}

void refuse_skeleton(const FileBytes& file) {
  const std::string extension = lower_extension(without_gz(file.path));
  if (extension != "swc" && extension != "cgal" && extension != "graphml") return;
  file.fail("a skeleton file (" + extension + ")", "a surface file",
            "give the surface, of which a skeleton can be made");
}

void refuse_foreign_format(const FileBytes& file) {
  const std::optional<ForeignFormat> format = foreign_format_of(file);
  if (format) file.fail(format->name, "a surface file", format->remedy);
}

}  // namespace curveskel
