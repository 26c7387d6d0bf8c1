#include "surface/wrap.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <vector>

#include "surface/element_index.hpp"
#include "surface/measures.hpp"
#include "surface/memory.hpp"

namespace curveskel {
namespace {

using WrapKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using WrapMesh = CGAL::Surface_mesh<WrapKernel::Point_3>;

/// Lets a stop out of CGAL's loop.
struct StoppableWrapping : CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
  explicit StoppableWrapping(const Monitor& given) : monitor(&given) {}

  template <typename Wrapper, typename Gate>
  void before_facet_treatment(const Wrapper& /*wrapper*/, const Gate& /*gate*/) {
    constexpr int facets_between_checks = 256;
    if (++facets % facets_between_checks == 0) monitor->report("wrap", 0.5);
  }

  const Monitor* monitor;
  int facets = 0;
};

}  // namespace

Surface wrap(const Surface& triangles, const WrapOptions& options, const Monitor& monitor) {
  monitor.report("wrap", 0);
  // As measured: the hierarchy over the faces, and a triangulation with that many vertices.
  const double expected_vertices = area(triangles) / (options.opening * options.opening);
  require_memory(600.0 * double(triangles.triangles.rows()) + 3500 * expected_vertices,
                 available_memory_bytes(), "wrapping", Fault::input,
                 "choose a wider --wrap-opening or decimate the surface first");
  std::vector<WrapKernel::Point_3> points;
  points.reserve(at(triangles.positions.rows()));
  for (const auto& p : triangles.positions.rowwise()) points.emplace_back(p.x(), p.y(), p.z());
  std::vector<std::array<std::size_t, 3>> faces;
  faces.reserve(at(triangles.triangles.rows()));
  for (const auto& t : triangles.triangles.rowwise())
    faces.push_back({at(t(0)), at(t(1)), at(t(2))});

  WrapMesh mesh;
  StoppableWrapping visitor(monitor);
  CGAL::alpha_wrap_3(points, faces, options.opening, options.offset, mesh,
                     CGAL::parameters::default_values(), CGAL::parameters::visitor(visitor));

  Surface result;
  result.positions.resize(mesh.number_of_vertices(), 3);
  result.triangles.resize(mesh.number_of_faces(), 3);
  std::vector<std::int32_t> number(mesh.num_vertices(), -1);
  std::int32_t vertices = 0;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.positions.row(vertices) << p.x(), p.y(), p.z();
    number[v.idx()] = vertices++;
  }
  Eigen::Index row = 0;
  for (const auto f : mesh.faces()) {
    int k = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      result.triangles(row, k++) = number[v.idx()];
    }
    ++row;
  }
  monitor.report("wrap", 1);
  return result;
}

}  // namespace curveskel
