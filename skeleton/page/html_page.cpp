#include <curveskel/html_page.hpp>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/branch_profiles.hpp>
#include <curveskel/branch_territories.hpp>
#include <curveskel/labelled_surface.hpp>
#include <curveskel/view.hpp>
#include "base/base64.hpp"
#include "base/utf8.hpp"
#include "skeleton/graph/sound_skeleton.hpp"
#include "skeleton/page/page.hpp"

namespace curveskel {
namespace {

using PageJson = nlohmann::ordered_json;

/// Numbers in the machine's order, which is that of every browser's machine.
template <typename Value>
std::string base64_of_values(const std::vector<Value>& values) {
  return base64_of({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
}

struct Shown {
  Surface surface;
  Eigen::VectorXi branch_of_vertex;
};

Shown shown_surface(const Surface& surface, const Eigen::VectorXi& branch_of_vertex, int threads) {
  constexpr int most_vertices = 60000;
  if (surface.positions.rows() <= most_vertices) return {surface, branch_of_vertex};
  const Coarsened coarse = coarsen(surface, {most_vertices, threads});
  Shown shown{coarse.surface, Eigen::VectorXi::Constant(coarse.surface.positions.rows(), -1)};
  for (Eigen::Index v = 0; v < branch_of_vertex.size(); ++v) {
    shown.branch_of_vertex[coarse.vertex_of_input[v]] = branch_of_vertex[v];
  }
  return shown;
}

/// About the middle of the box, the half diagonal 1.
struct UnitFrame {
  Eigen::RowVector3d centre;
  double scale;

  explicit UnitFrame(const Positions& positions) {
    const Eigen::RowVector3d low = positions.colwise().minCoeff();
    const Eigen::RowVector3d high = positions.colwise().maxCoeff();
    centre = (low + high) / 2;
    scale = 2 / (high - low).norm();
  }
};

PageJson json_of(const Shown& shown, const UnitFrame& frame) {
  std::vector<float> places;
  places.reserve(3 * idx(shown.surface.positions.rows()));
  for (const auto& row : shown.surface.positions.rowwise()) {
    const Eigen::RowVector3d at = (row - frame.centre) * frame.scale;
    for (const double value : at) places.push_back(static_cast<float>(value));
  }
  const Triangles& triangles = shown.surface.triangles;
  return {{"places", base64_of_values(places)},
          {"triangles", base64_of_values(std::vector<std::uint32_t>(
                            triangles.data(), triangles.data() + triangles.size()))},
          {"branch", base64_of_values(std::vector<std::int32_t>(
                         shown.branch_of_vertex.data(),
                         shown.branch_of_vertex.data() + shown.branch_of_vertex.size()))}};
}

PageJson nodes_of(const CurveSkeleton& skeleton, const UnitFrame& frame) {
  PageJson nodes = PageJson::array();
  for (const auto& row : skeleton.nodes.rowwise()) {
    const Eigen::RowVector3d at = (row - frame.centre) * frame.scale;
    nodes.push_back(
        {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])});
  }
  return nodes;
}

PageJson rows_of(const Eigen::Matrix3d& axes) {
  PageJson rows = PageJson::array();
  for (const double value : axes.reshaped<Eigen::RowMajor>()) rows.push_back(value);
  return rows;
}

/// Text that stands in a script element, where no tag may begin.
std::string in_script(const PageJson& data) {
  std::string text;
  for (const char c : data.dump(-1, ' ', false, PageJson::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    if (c == '<') {
      html += "&lt;";
    } else if (c == '&') {
      html += "&amp;";
    } else {
      html += c;
    }
  }
  return html;
}

}  // namespace

std::string html_page(const Surface& surface, const CurveSkeleton& skeleton,
                      const PageContent& content, int threads) {
  require_sound(surface, "html_page");
  require_sound_places(skeleton, "html_page");
  require_map_of(skeleton, surface, "html_page");
  const BranchTerritories territories = branch_territories(surface, skeleton);
  SkeletonContext context;
  context.territories = &territories;
  const std::vector<Branch> all = branches(skeleton);
  PageJson lines = PageJson::array();
  PageJson colours = PageJson::array();
  for (std::size_t b = 0; b < all.size(); ++b) {
    lines.push_back(all[b].nodes);
    PageJson colour = PageJson::array();
    for (const std::uint8_t part : branch_colour(static_cast<int>(b))) {
      colour.push_back(std::round(part / 0.255) / 1000);
    }
    colours.push_back(std::move(colour));
  }
  const UnitFrame frame(surface.positions);
  const PageJson data = {
      {"title", content.title},
      {"counts", std::to_string(surface.positions.rows()) + " vertices, " +
                     std::to_string(surface.triangles.rows()) + " triangles; " +
                     std::to_string(skeleton.nodes.rows()) + " nodes, " +
                     std::to_string(all.size()) + " branches"},
      {"failures", content.failures},
      {"certificate", content.certificate},
      {"provenance", content.provenance},
      {"surface", json_of(shown_surface(surface, territories.branch_of_vertex, threads), frame)},
      {"view", rows_of(best_views(surface, 300, 200, content.up)[0].axes)},
      {"nodes", nodes_of(skeleton, frame)},
      {"lines", std::move(lines)},
      {"colours", std::move(colours)},
      {"branches", format_skeleton(skeleton, SkeletonFormat::csv, context)},
      {"profiles", format_profiles(branch_profiles(surface, skeleton, {0, threads, content.rims}))},
      {"junctions", format_junctions(skeleton)}};
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(as_utf8(content.title)) + "</title>\n<style>\n" + std::string(page_style_source) +
         "</style>\n</head>\n<body>\n" + std::string(page_body_source) +
         "<script id=\"data\" type=\"application/json\">" + in_script(data) +
         "</script>\n<script>\n" + std::string(page_script_source) +
         "</script>\n</body>\n</html>\n";
}

}  // namespace curveskel
