#include "surface/repair/close_surface.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "surface/repair/hole_triangulation.hpp"

namespace curveskel {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using ClosingKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using HalfEdgeMesh = CGAL::Surface_mesh<ClosingKernel::Point_3>;
using MeshVertex = HalfEdgeMesh::Vertex_index;
using MeshFace = HalfEdgeMesh::Face_index;
using MeshHalfEdge = HalfEdgeMesh::Halfedge_index;

struct ClosingMesh {
  HalfEdgeMesh mesh;
  HalfEdgeMesh::Property_map<MeshVertex, std::int32_t> given;     // -1 = added
  HalfEdgeMesh::Property_map<MeshFace, std::int32_t> given_face;  // -1 = added
};

/// The triangles with the vertices doubled where they would meet in no 2-manifold.
ClosingMesh oriented_mesh(const Surface& surface, std::int64_t& vertices_copied) {
  // CGAL's orienter only copies "points": numbers of vertices do for them.
  std::vector<std::int32_t> vertex(idx(surface.positions.rows()));
  for (std::size_t v = 0; v < vertex.size(); ++v) vertex[v] = static_cast<std::int32_t>(v);
  std::vector<std::array<std::size_t, 3>> faces(idx(surface.triangles.rows()));
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) faces[idx(f)][idx(k)] = idx(surface.triangles(f, k));
  }
  pmp::orient_polygon_soup(vertex, faces);
  vertices_copied = static_cast<std::int64_t>(vertex.size()) - surface.positions.rows();

  ClosingMesh result;
  result.given = result.mesh.add_property_map<MeshVertex, std::int32_t>("v:given", -1).first;
  result.given_face = result.mesh.add_property_map<MeshFace, std::int32_t>("f:given", -1).first;
  std::vector<MeshVertex> mesh_vertex(vertex.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& face = faces[f];
    for (const std::size_t v : face) {
      if (mesh_vertex[v] != HalfEdgeMesh::null_vertex()) continue;
      const auto p = surface.positions.row(vertex[v]);
      mesh_vertex[v] = result.mesh.add_vertex({p.x(), p.y(), p.z()});
      result.given[mesh_vertex[v]] = vertex[v];
    }
    const MeshFace added =
        result.mesh.add_face(mesh_vertex[face[0]], mesh_vertex[face[1]], mesh_vertex[face[2]]);
    if (added != HalfEdgeMesh::null_face()) result.given_face[added] = static_cast<std::int32_t>(f);
  }
  return result;
}

/// Stitches copies of an edge to one another where that leaves a manifold.
void stitch(HalfEdgeMesh& mesh) {
  pmp::stitch_borders(mesh, CGAL::parameters::apply_per_connected_component(true));
  pmp::stitch_borders(mesh);
}

/// A fan round the middle of the hole, for holes that no triangulation of their corners can fill.
void fan(HalfEdgeMesh& mesh, const std::vector<MeshHalfEdge>& border) {
  CGAL::Vector_3<ClosingKernel> sum(0, 0, 0);
  for (const MeshHalfEdge h : border) sum = sum + (mesh.point(mesh.target(h)) - CGAL::ORIGIN);
  const MeshVertex middle =
      mesh.add_vertex(CGAL::ORIGIN + sum / static_cast<double>(border.size()));
  for (const MeshHalfEdge h : border) mesh.add_face(mesh.source(h), mesh.target(h), middle);
}

std::vector<MeshHalfEdge> border_of(const HalfEdgeMesh& mesh, MeshHalfEdge at_hole) {
  std::vector<MeshHalfEdge> border;
  for (const MeshHalfEdge h : CGAL::halfedges_around_face(at_hole, mesh)) border.push_back(h);
  return border;
}

/// Adds a ring of triangles with half as many edges within the hole, as wide as the edges of a
/// round hole of that size are long, and returns a half-edge of the hole that is left. Teeth of the
/// border are half smoothed away.
MeshHalfEdge add_ring(HalfEdgeMesh& mesh, MeshHalfEdge at_hole) {
  const std::vector<MeshHalfEdge> border = border_of(mesh, at_hole);
  const std::size_t corners = border.size();
  const std::size_t ring_size = corners / 2;
  std::vector<MeshVertex> outer;
  ClosingKernel::Vector_3 sum(0, 0, 0);
  for (const MeshHalfEdge h : border) {
    outer.push_back(mesh.source(h));
    sum = sum + (mesh.point(outer.back()) - CGAL::ORIGIN);
  }
  const ClosingKernel::Point_3 middle = CGAL::ORIGIN + sum / static_cast<double>(corners);
  double radius = 0;
  for (const MeshVertex v : outer) {
    radius += std::sqrt(CGAL::squared_distance(mesh.point(v), middle)) / double(corners);
  }
  const double width = 2 * std::numbers::pi * radius / double(corners);
  std::vector<MeshVertex> ring;
  for (std::size_t j = 0; j < ring_size; ++j) {
    const auto& here = mesh.point(outer[2 * j]);
    const auto& before = mesh.point(outer[(2 * j + corners - 1) % corners]);
    const auto& after = mesh.point(outer[2 * j + 1]);
    const auto smooth = CGAL::midpoint(here, CGAL::midpoint(before, after));
    const auto inward = middle - smooth;
    const double distance = std::sqrt(inward.squared_length());
    ring.push_back(
        mesh.add_vertex(distance > 0 ? smooth + inward * std::min(0.5, width / distance) : smooth));
  }
  for (std::size_t j = 0; j < ring_size; ++j) {
    const MeshVertex next = ring[(j + 1) % ring_size];
    const std::size_t end = j + 1 < ring_size ? 2 * j + 2 : corners;
    mesh.add_face(outer[2 * j], outer[2 * j + 1], ring[j]);
    mesh.add_face(outer[2 * j + 1], next, ring[j]);
    for (std::size_t i = 2 * j + 1; i < end; ++i) {
      mesh.add_face(outer[i], outer[(i + 1) % corners], next);
    }
    at_hole = mesh.halfedge(ring[j], next);
  }
  return at_hole;
}

/// Ends the search for a triangulation when the user wants it.
class StopAtSteps : public pmp::Hole_filling::Default_visitor {
 public:
  explicit StopAtSteps(const std::stop_token& token) : stop_(&token) {}
  void quadratic_step() const { look(); }
  void cubic_step() const { look(); }

 private:
  void look() const { throw_if_stopped(*stop_); }
  const std::stop_token* stop_;
};

bool passes_a_vertex_twice(const HalfEdgeMesh& mesh, const std::vector<MeshHalfEdge>& border) {
  std::vector<MeshVertex> passed;
  passed.reserve(border.size());
  for (const MeshHalfEdge h : border) passed.push_back(mesh.source(h));
  std::sort(passed.begin(), passed.end());
  return std::adjacent_find(passed.begin(), passed.end()) != passed.end();
}

/// Adds the triangles that `triangulate_hole` chooses; none where it finds none.
std::vector<MeshFace> add_delaunay_faces(HalfEdgeMesh& mesh,
                                         const std::vector<MeshHalfEdge>& border,
                                         const Monitor& monitor) {
  std::vector<MeshFace> faces;
  if (passes_a_vertex_twice(mesh, border)) return faces;
  const auto count = static_cast<Eigen::Index>(border.size());
  Positions corners(count, 3);
  Positions beyond(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const MeshHalfEdge h = border[idx(i)];
    const auto& corner = mesh.point(mesh.source(h));
    const auto& third = mesh.point(mesh.target(mesh.next(mesh.opposite(h))));
    corners.row(i) << corner.x(), corner.y(), corner.z();
    beyond.row(i) << third.x(), third.y(), third.z();
  }
  const auto vertex = [&](std::int32_t i) { return mesh.source(border[idx(i)]); };
  const auto joined = [&](std::int32_t i, std::int32_t k) {
    return mesh.halfedge(vertex(i), vertex(k)) != HalfEdgeMesh::null_halfedge();
  };
  for (const auto& [i, j, k] : triangulate_hole(corners, beyond, joined, monitor.stop)) {
    const MeshFace added = mesh.add_face(vertex(i), vertex(j), vertex(k));
    if (added != HalfEdgeMesh::null_face()) faces.push_back(added);
  }
  return faces;
}

/// Until no more edges are left than these. Returns whether rings were needed.
bool narrow(HalfEdgeMesh& mesh, MeshHalfEdge& at_hole, std::vector<MeshHalfEdge>& border,
            std::int64_t most_edges) {
  bool narrowed = false;
  for (; border.size() > idx(most_edges); narrowed = true) {
    at_hole = add_ring(mesh, at_hole);
    border = border_of(mesh, at_hole);
  }
  return narrowed;
}

/// Returns whether rings came first.
bool fill(ClosingMesh& closing, MeshHalfEdge at_hole, const Monitor& monitor) {
  HalfEdgeMesh& mesh = closing.mesh;
  std::vector<MeshHalfEdge> border = border_of(mesh, at_hole);
  bool narrowed = narrow(mesh, at_hole, border, most_edges_without_rings);
  std::vector<MeshFace> faces = add_delaunay_faces(mesh, border, monitor);
  if (faces.empty() && narrow(mesh, at_hole, border, most_edges_without_delaunay)) {
    narrowed = true;
    faces = add_delaunay_faces(mesh, border, monitor);
  }
  if (faces.empty()) {
    pmp::triangulate_hole(
        mesh, at_hole, std::back_inserter(faces),
        CGAL::parameters::use_delaunay_triangulation(false).visitor(StopAtSteps(monitor.stop)));
  }
  if (faces.empty()) {
    fan(mesh, border);
    return narrowed;
  }
  std::vector<MeshFace> refined;
  std::vector<MeshVertex> added;
  pmp::refine(mesh, faces, std::back_inserter(refined), std::back_inserter(added));
  return narrowed;
}

std::vector<MeshHalfEdge> border_cycles(const HalfEdgeMesh& mesh) {
  std::vector<MeshHalfEdge> cycles;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(cycles));
  return cycles;
}

/// Back to plain arrays; `holes` names the mesh's vertices so far.
void to_arrays(const ClosingMesh& closing, ClosedParts& parts) {
  const HalfEdgeMesh& mesh = closing.mesh;
  std::vector<std::int32_t> number(mesh.num_vertices() + mesh.number_of_removed_vertices(), -1);
  parts.surface.positions.resize(mesh.number_of_vertices(), 3);
  for (const MeshVertex v : mesh.vertices()) {
    const auto row = static_cast<std::int32_t>(parts.vertex_given.size());
    const auto& p = mesh.point(v);
    parts.surface.positions.row(row) << p.x(), p.y(), p.z();
    parts.vertex_given.push_back(closing.given[v]);
    number[idx(std::int64_t{v})] = row;
  }
  parts.surface.triangles.resize(mesh.number_of_faces(), 3);
  for (const MeshFace f : mesh.faces()) {
    const auto row = static_cast<Eigen::Index>(parts.face_given.size());
    int k = 0;
    for (const MeshVertex v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      parts.surface.triangles(row, k++) = number[idx(std::int64_t{v})];
    }
    parts.face_given.push_back(closing.given_face[f]);
  }
  for (auto& hole : parts.holes) {
    for (std::int32_t& v : hole) v = number[idx(v)];
  }
}

}  // namespace

ClosedParts close_surface(const Surface& given, const Monitor& monitor) {
  ClosedParts parts;
  monitor.report("repair", 0);
  ClosingMesh closing = oriented_mesh(given, parts.vertices_copied);
  monitor.report("repair", 0.2);
  stitch(closing.mesh);
  const auto cycles = border_cycles(closing.mesh);
  for (std::size_t c = 0; c < cycles.size(); ++c) {
    monitor.report("repair", 0.3 + 0.6 * double(c) / double(cycles.size()));
    auto& hole = parts.holes.emplace_back();
    for (const MeshHalfEdge h : CGAL::halfedges_around_face(cycles[c], closing.mesh)) {
      hole.push_back(static_cast<std::int32_t>(closing.mesh.target(h)));
    }
    parts.holes_narrowed += fill(closing, cycles[c], monitor) ? 1 : 0;
  }
  to_arrays(closing, parts);
  monitor.report("repair", 0.9);
  return parts;
}

}  // namespace curveskel
