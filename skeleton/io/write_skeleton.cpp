// The choice of the format, and the formats that are little more than a list of points and lines.
#include <cstdint>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/levels.hpp>
#include <curveskel/skeleton_files.hpp>
#include "base/decimal.hpp"
#include "base/one_line.hpp"
#include "skeleton/graph/sound_skeleton.hpp"
#include "skeleton/io/skeleton_formats.hpp"
#include "skeleton/picture/picture.hpp"

namespace curveskel {
namespace {

const Surface& surface_in(const SkeletonContext& context, SkeletonFormat format) {
  if (context.surface == nullptr || context.surface->positions.rows() == 0) {
    throw Error(Fault::output, "a picture (" + std::string(name_of(skeleton_formats, format)) +
                                   ") found no surface, needed the one that the skeleton is of; "
                                   "pass it or choose another format");
  }
  return *context.surface;
}

PictureOptions pictured(const SkeletonContext& context) {
  PictureOptions options;
  options.up = context.up;
  return options;
}

void append_points(std::string& text, const CurveSkeleton& skeleton, const Branch& branch) {
  append_decimal(text, branch.nodes.size());
  for (const int node : branch.nodes) {
    text += ' ';
    append_decimals(text, skeleton.nodes.row(node), ' ');
  }
  text += '\n';
}

}  // namespace

std::vector<int> isolated_nodes(const CurveSkeleton& skeleton) {
  std::vector<bool> touched(static_cast<std::size_t>(skeleton.nodes.rows()), false);
  for (const std::int32_t node : skeleton.edges.reshaped()) {
    touched[static_cast<std::size_t>(node)] = true;
  }
  std::vector<int> isolated;
  for (int node = 0; node < skeleton.nodes.rows(); ++node) {
    if (!touched[static_cast<std::size_t>(node)]) isolated.push_back(node);
  }
  return isolated;
}

std::string obj_from(const CurveSkeleton& skeleton, const SkeletonContext& context) {
  std::string text;
  if (!context.provenance.empty()) text += "# " + in_one_line(context.provenance) + "\n";
  for (const auto& node : skeleton.nodes.rowwise()) {
    text += "v ";
    append_decimals(text, node, ' ');
    text += '\n';
  }
  for (const auto& edge : skeleton.edges.rowwise()) {
    text += "l ";
    append_decimals(text, edge.array() + 1, ' ');
    text += '\n';
  }
  for (const int node : isolated_nodes(skeleton)) {
    text += "p ";
    append_decimal(text, node + 1);
    text += '\n';
  }
  return text;
}

std::string ply_from(const CurveSkeleton& skeleton, const SkeletonContext& context) {
  const bool has_radii = skeleton.radii.size() > 0;
  const bool with_lives = has_lives(skeleton);
  std::string text = "ply\nformat ascii 1.0\n";
  if (!context.provenance.empty()) text += "comment " + in_one_line(context.provenance) + "\n";
  text += "element vertex ";
  append_decimal(text, skeleton.nodes.rows());
  text += "\nproperty double x\nproperty double y\nproperty double z\n";
  if (has_radii) text += "property double radius\n";
  if (with_lives) text += "property double life\n";
  text += "element edge ";
  append_decimal(text, skeleton.edges.rows());
  text += "\nproperty int vertex1\nproperty int vertex2\n";
  if (with_lives) {
    text += "property double life\nproperty int branch\nproperty int parent\n";
    text += "property double merge\n";
  }
  text += "end_header\n";
  for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) {
    append_decimals(text, skeleton.nodes.row(node), ' ');
    if (has_radii) {
      text += ' ';
      append_decimal(text, skeleton.radii(node));
    }
    if (with_lives) {
      text += ' ';
      append_decimal(text, skeleton.lives(node));
    }
    text += '\n';
  }
  const std::vector<BranchLevel> levels = branch_levels(skeleton);
  const std::vector<int> branch_of_edge = branch_of_edges(skeleton);
  for (Eigen::Index edge = 0; edge < skeleton.edges.rows(); ++edge) {
    append_decimals(text, skeleton.edges.row(edge), ' ');
    if (with_lives) {
      const BranchLevel& level = levels[idx(branch_of_edge[idx(edge)])];
      text += ' ';
      append_decimals(
          text,
          Eigen::RowVector4d(level.life, branch_of_edge[idx(edge)], level.parent, level.merge),
          ' ');
    }
    text += '\n';
  }
  return text;
}

std::string polylines_from(const CurveSkeleton& skeleton) {
  std::string text;
  for (const Branch& branch : branches(skeleton)) append_points(text, skeleton, branch);
  for (const int node : isolated_nodes(skeleton)) append_points(text, skeleton, Branch{{node}});
  return text;
}

std::string format_skeleton(const CurveSkeleton& skeleton, SkeletonFormat format,
                            const SkeletonContext& context) {
  require_sound(skeleton, "format_skeleton");
  if (context.surface != nullptr) require_corners(*context.surface, "format_skeleton");
  if (context.root < -1 || context.root >= skeleton.nodes.rows()) {
    throw Error(Fault::output, "the skeleton's root is node " + std::to_string(context.root) +
                                   ", needed one of its " + std::to_string(skeleton.nodes.rows()) +
                                   " nodes, or -1 for none");
  }
  const bool is_picture = format == SkeletonFormat::svg || format == SkeletonFormat::png;
  if (is_picture) require_sound_places(skeleton, "format_skeleton");
  switch (format) {
    case SkeletonFormat::obj:
      return obj_from(skeleton, context);
    case SkeletonFormat::ply:
      return ply_from(skeleton, context);
    case SkeletonFormat::cgal:
      return polylines_from(skeleton);
    case SkeletonFormat::swc:
      return swc_from(skeleton, context);
    case SkeletonFormat::vtp:
      return vtp_from(skeleton, context);
    case SkeletonFormat::csv:
      return csv_from(skeleton, context);
    case SkeletonFormat::graphml:
      return graphml_from(skeleton, context);
    case SkeletonFormat::json:
      return json_from(skeleton, context);
    case SkeletonFormat::svg:
      return svg_picture(skeleton, surface_in(context, format), pictured(context));
    case SkeletonFormat::png:
      return png_picture(skeleton, surface_in(context, format), pictured(context));
  }
  throw Error(Fault::output, "found an unknown skeleton format, needed one of " +
                                 names_in(skeleton_formats) + "; choose one of these");
}

}  // namespace curveskel
