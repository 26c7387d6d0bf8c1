#include "bench/cgal_skeleton.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/extract_mean_curvature_flow_skeleton.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include <curveskel/clean.hpp>
#include <curveskel/read.hpp>
#include "surface/mesh/cgal_mesh.hpp"

namespace curveskel::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Skeletonization = CGAL::Mean_curvature_flow_skeletonization<Mesh>;
namespace processing = CGAL::Polygon_mesh_processing;

Mesh read_mesh(const std::filesystem::path& file) {
  constexpr std::array own_formats{".off", ".obj", ".ply"};
  Mesh mesh;
  if (std::find(own_formats.begin(), own_formats.end(), file.extension()) != own_formats.end() &&
      CGAL::IO::read_polygon_mesh(file.string(), mesh)) {
    processing::triangulate_faces(mesh);
    return mesh;
  }
  return cgal_mesh<Mesh>(clean(read_polygons(file, {}), {}).surface);
}

void append(const Skeletonization::Skeleton& part, CurveSkeleton& whole,
            std::vector<std::pair<int, int>>& edges) {
  const Eigen::Index before = whole.nodes.rows();
  whole.nodes.conservativeResize(before + static_cast<Eigen::Index>(num_vertices(part)), 3);
  for (const auto vertex : CGAL::make_range(vertices(part))) {
    const Kernel::Point_3& p = part[vertex].point;
    whole.nodes.row(before + static_cast<Eigen::Index>(vertex)) << p.x(), p.y(), p.z();
  }
  for (const auto edge : CGAL::make_range(boost::edges(part))) {
    const auto a = static_cast<int>(before + static_cast<Eigen::Index>(source(edge, part)));
    const auto b = static_cast<int>(before + static_cast<Eigen::Index>(target(edge, part)));
    edges.emplace_back(std::min(a, b), std::max(a, b));
  }
}

CurveSkeleton skeleton_of(const Mesh& mesh) {
  if (!CGAL::is_closed(mesh)) throw std::runtime_error("CGAL reads no closed surface");
  std::vector<Mesh> components;
  processing::split_connected_components(mesh, components);
  CurveSkeleton whole;
  std::vector<std::pair<int, int>> edges;
  for (Mesh& component : components) {
    if (!processing::is_outward_oriented(component)) {
      processing::reverse_face_orientations(component);
    }
    Skeletonization::Skeleton skeleton;
    CGAL::extract_mean_curvature_flow_skeleton(component, skeleton);
    append(skeleton, whole, edges);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  whole.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    whole.edges.row(static_cast<Eigen::Index>(i)) << edges[i].first, edges[i].second;
  }
  return whole;
}

}  // namespace

CurveSkeleton cgal_skeleton(const std::filesystem::path& file) {
  return skeleton_of(read_mesh(file));
}

CurveSkeleton cgal_skeleton(const Surface& surface) {
  return skeleton_of(cgal_mesh<Mesh>(surface));
}

}  // namespace curveskel::bench
