// Recognition of a file's format, and code that all formats share.
#include <optional>
#include <string>
#include <string_view>

#include <curveskel/advanced/file_names.hpp>
#include <curveskel/skeleton_files.hpp>
#include "skeleton/io/raw_graph.hpp"
#include "surface/read/foreign_formats.hpp"
#include "surface/read/formats.hpp"

namespace curveskel {
namespace {

constexpr std::string_view readable = "one of obj, ply, cgal, swc, vtp, graphml, json";

/// The formats that name themselves in their first lines.
std::optional<SkeletonFormat> skeleton_format_by_content(const FileBytes& file) {
  constexpr std::size_t first_lines = 2000;
  std::string_view text(file.content);
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return SkeletonFormat::ply;
  text = text.substr(0, first_lines);
  const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (begin == std::string_view::npos) return std::nullopt;
  if (text[begin] == '{') return SkeletonFormat::json;
  if (text[begin] != '<') return std::nullopt;
  if (text.find("<VTKFile") != std::string_view::npos) return SkeletonFormat::vtp;
  if (text.find("graphml") != std::string_view::npos) return SkeletonFormat::graphml;
  return std::nullopt;
}

std::optional<SkeletonFormat> skeleton_format_by_extension(const std::filesystem::path& path) {
  const std::string extension = lower_extension(without_gz(path));
  if (extension == "txt") return SkeletonFormat::cgal;  // CGAL's own is ".polylines.txt"
  return choice_of(skeleton_formats, std::string_view(extension));
}

RootedSkeleton read_as(SkeletonFormat format, const FileBytes& file) {
  const auto from = [](const RawGraph& graph, Joining joining) {
    return RootedSkeleton{skeleton_from(graph, joining), graph.root};
  };
  switch (format) {
    case SkeletonFormat::obj:
      return from(read_obj_lines(file), Joining::coincident);
    case SkeletonFormat::ply:
      return from(read_ply_edges(file), Joining::coincident);
    case SkeletonFormat::cgal:
      return from(read_polylines(file), Joining::coincident);
    case SkeletonFormat::swc:
      return from(read_swc(file), Joining::coincident);
    case SkeletonFormat::vtp:
      return from(read_vtp(file), Joining::coincident);
    case SkeletonFormat::graphml:
      return from(read_graphml(file), Joining::nothing);
    case SkeletonFormat::json:
      return from(read_json_graph(file), Joining::nothing);
    case SkeletonFormat::csv:
    case SkeletonFormat::svg:
    case SkeletonFormat::png:
      break;
  }
  file.fail("the format " + std::string(name_of(skeleton_formats, format)) +
                ", which does not hold the graph",
            readable, "write the skeleton again in one of these");
}

}  // namespace

RootedSkeleton read_rooted_skeleton(const std::filesystem::path& path) {
  const FileBytes file = read_file(path, Monitor{}, "a skeleton");
  std::optional<SkeletonFormat> format = skeleton_format_by_content(file);
  if (!format) {
    if (const auto foreign = foreign_format_of(file)) {
      file.fail(foreign->name, std::string("a skeleton as ") + std::string(readable), "convert it");
    }
    format = skeleton_format_by_extension(path);
  }
  const auto surface = format ? std::nullopt : surface_format_of(file);
  if (surface) {
    file.fail("a surface file (" + std::string(name_of(surface_formats, *surface)) + ")",
              std::string("a skeleton as ") + std::string(readable),
              "give the skeleton of that surface");
  }
  if (!format) {
    file.fail("content that begins with " + in_quotes(file.content.substr(0, 41)) +
                  " and no known extension",
              std::string("a skeleton as ") + std::string(readable), "convert it");
  }
  RootedSkeleton read = read_as(*format, file);
  if (read.skeleton.nodes.rows() == 0) {
    file.fail("a graph without nodes", "a skeleton",
              "check that the file holds curves, not a surface or a point cloud");
  }
  return read;
}

CurveSkeleton read_skeleton(const std::filesystem::path& path) {
  return read_rooted_skeleton(path).skeleton;
}

}  // namespace curveskel
