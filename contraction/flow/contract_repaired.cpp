#include <curveskel/contract_repaired.hpp>

#include <utility>

#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

RepairedContraction contract_repaired(const RepairedSurface& repaired,
                                      const ContractionOptions& options, const Monitor& monitor) {
  RepairedContraction result;
  result.positions = repaired.surface.positions;
  Monitor with_number = monitor;
  for (const auto& [surface, vertex_in_whole] :
       split_components(repaired.surface, topology(repaired.surface))) {
    if (monitor.frame) {
      const int component = static_cast<int>(result.components.size());
      with_number.frame = [&monitor, component](const Frame& now) {
        monitor.frame({now.stage, component, now.iteration, now.area_ratio, now.volume_ratio,
                       now.residual, now.surface, now.made_in});
      };
    }
    Positions centres;
    if (options.flow == Flow::medial) {
      const SurfaceTree tree(surface, options.threads);
      centres = inscribed_balls(surface, tree, options.threads, monitor.stop).centres;
    }
    Contraction contraction = contract(surface, centres, options, with_number);
    for (std::size_t v = 0; v < vertex_in_whole.size(); ++v) {
      result.positions.row(vertex_in_whole[v]) = contraction.surface.positions.row(
          contraction.vertex_of_input[static_cast<Eigen::Index>(v)]);
    }
    result.components.push_back(std::move(contraction));
  }
  return result;
}

Surface moved_vertices(const PolygonSoup& soup, const RepairedSurface& repaired,
                       const Positions& positions) {
  if (repaired.vertex_of_input.size() != soup.positions.rows() ||
      (repaired.vertex_of_input.array() >= static_cast<int>(positions.rows())).any()) {
    throw Error(Fault::input, "moved_vertices: found a map of " +
                                  std::to_string(repaired.vertex_of_input.size()) +
                                  " vertices to " + std::to_string(positions.rows()) +
                                  " positions or beyond, needed one of the polygons' " +
                                  std::to_string(soup.positions.rows()) +
                                  " vertices to positions that are there");
  }
  Surface moved{soup.positions, triangulate(soup)};
  for (Eigen::Index v = 0; v < moved.positions.rows(); ++v) {
    const int vertex = repaired.vertex_of_input[v];
    if (vertex >= 0) moved.positions.row(v) = positions.row(vertex);
  }
  return moved;
}

}  // namespace curveskel
