#include "surface/repair/split_edges.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "surface/mesh/half_edges.hpp"
#include "surface/repair/ear_clipping.hpp"

namespace curveskel {
namespace {

using NumberedBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;

NumberedBox numbered_box(const Eigen::AlignedBox3d& box, std::int32_t number) {
  return {CGAL::Bbox_3(box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(),
                       box.max().z()),
          number};
}

std::int32_t start_of(const Triangles& triangles, std::int32_t half_edge) {
  return triangles.data()[half_edge];
}
std::int32_t end_of(const Triangles& triangles, std::int32_t half_edge) {
  return triangles.data()[next_half_edge(half_edge)];
}

/// Of the edges with one face, in no order that matters.
std::vector<std::int32_t> boundary_half_edges(const Triangles& triangles,
                                              const HalfEdges& half_edges) {
  std::vector<std::pair<std::uint64_t, std::int32_t>> open;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(half_edges.twin.size()); ++h) {
    if (half_edges.twin[idx(h)] >= 0) continue;
    open.emplace_back(edge_key(start_of(triangles, h), end_of(triangles, h)), h);
  }
  std::sort(open.begin(), open.end());
  std::vector<std::int32_t> boundary;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const bool like_last = i > 0 && open[i - 1].first == open[i].first;
    const bool like_next = i + 1 < open.size() && open[i + 1].first == open[i].first;
    if (!like_last && !like_next) boundary.push_back(open[i].second);
  }
  return boundary;
}

/// A vertex on a half-edge, `along` from its start in 0..1.
struct OnEdge {
  std::int32_t half_edge = 0;
  double along = 0;
  std::int32_t vertex = 0;
};

/// Appends the vertex if it lies on the edge.
void note_if_on(const Surface& surface, std::int32_t half_edge, std::int32_t vertex,
                double distance, std::vector<OnEdge>& found) {
  const auto face = surface.triangles.row(half_edge / 3);
  if (face(0) == vertex || face(1) == vertex || face(2) == vertex) return;
  const Eigen::RowVector3d from = surface.positions.row(start_of(surface.triangles, half_edge));
  const Eigen::RowVector3d to = surface.positions.row(end_of(surface.triangles, half_edge));
  const Eigen::RowVector3d p = surface.positions.row(vertex);
  const Eigen::RowVector3d way = to - from;
  const double along = (p - from).dot(way) / way.squaredNorm();
  const bool between =
      (p - from).norm() > distance && (p - to).norm() > distance && along > 0 && along < 1;
  if (!between || (from + along * way - p).norm() > distance) return;
  found.push_back({half_edge, along, vertex});
}

/// By half-edge, and from its start to its end.
std::vector<OnEdge> vertices_on_edges(const Surface& surface, double distance) {
  const auto vertices = static_cast<std::int32_t>(surface.positions.rows());
  const HalfEdges half_edges = pair_half_edges(surface.triangles, vertices);
  std::vector<OnEdge> found;
  if (half_edges.boundary_edges == 0) return found;
  const auto place = [&](std::int32_t v) -> Eigen::Vector3d { return surface.positions.row(v); };
  std::vector<NumberedBox> points;
  for (std::int32_t v = 0; v < vertices; ++v) {
    if (!half_edges.vertex_on_boundary[idx(v)]) continue;
    points.push_back(numbered_box(Eigen::AlignedBox3d(place(v)), v));
  }
  const auto boundary = boundary_half_edges(surface.triangles, half_edges);
  std::vector<NumberedBox> edges;
  edges.reserve(boundary.size());
  for (const std::int32_t h : boundary) {
    Eigen::AlignedBox3d box(place(start_of(surface.triangles, h)));
    box.extend(place(end_of(surface.triangles, h)));
    box.min().array() -= distance;
    box.max().array() += distance;
    edges.push_back(numbered_box(box, h));
  }
  CGAL::box_intersection_d(edges.begin(), edges.end(), points.begin(), points.end(),
                           [&](const NumberedBox& edge, const NumberedBox& point) {
                             note_if_on(surface, edge.info(), point.info(), distance, found);
                           });
  std::sort(found.begin(), found.end(), [](const OnEdge& a, const OnEdge& b) {
    return std::tie(a.half_edge, a.along, a.vertex) < std::tie(b.half_edge, b.along, b.vertex);
  });
  return found;
}

/// Cuts one edge of each face that has vertices on its edges. Returns how many were cut.
std::int64_t split_once(Triangles& triangles, const std::vector<OnEdge>& on_edges) {
  std::vector<std::array<std::int32_t, 3>> more;
  std::int64_t cut = 0;
  for (std::size_t i = 0; i < on_edges.size();) {
    const std::int32_t h = on_edges[i].half_edge;
    const std::int32_t face = h / 3;
    const std::int32_t end = end_of(triangles, h);
    const std::int32_t beyond = triangles.data()[previous_half_edge(h)];
    triangles.data()[next_half_edge(h)] = on_edges[i].vertex;
    ++cut;
    for (; i < on_edges.size() && on_edges[i].half_edge == h; ++i) {
      const bool last = i + 1 == on_edges.size() || on_edges[i + 1].half_edge != h;
      more.push_back({on_edges[i].vertex, last ? end : on_edges[i + 1].vertex, beyond});
    }
    while (i < on_edges.size() && on_edges[i].half_edge / 3 == face) ++i;  // in the next round
  }
  Eigen::Index row = triangles.rows();
  triangles.conservativeResize(row + static_cast<Eigen::Index>(more.size()), 3);
  for (const auto& face : more) triangles.row(row++) << face[0], face[1], face[2];
  return cut;
}

}  // namespace

std::int64_t split_edges_at_vertices(Surface& surface, double distance) {
  constexpr int most_rounds = 4;  // one for each edge of a face, one for what they bring
  std::int64_t cut = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const auto on_edges = vertices_on_edges(surface, distance);
    if (on_edges.empty()) break;
    cut += split_once(surface.triangles, on_edges);
  }
  return cut;
}

}  // namespace curveskel
