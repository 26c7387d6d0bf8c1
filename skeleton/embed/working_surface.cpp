#include "skeleton/embed/working_surface.hpp"

#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/laplacian.hpp>
#include <curveskel/advanced/surface_partition.hpp>

namespace curveskel {
namespace {

template <typename Value, typename Make>
const Value& made_once(std::optional<Value>& value, const Make& make) {
  if (!value) value.emplace(make());
  return *value;
}

}  // namespace

const Eigen::VectorXd& WorkingSurface::vertex_areas() const {
  return made_once(vertex_areas_, [&] { return curveskel::vertex_areas(surface_); });
}

const Graph& WorkingSurface::neighbours() const {
  return made_once(neighbours_,
                   [&] { return graph_of(vertices(), index_edges(surface_.triangles).edges); });
}

const Buckets<std::int32_t>& WorkingSurface::triangles_around() const {
  return made_once(triangles_around_, [&] {
    const std::int32_t* const corners = surface_.triangles.data();
    return bucket<std::int32_t>(
        surface_.triangles.size(), vertices(), [&](std::int64_t c) { return corners[c]; },
        [](std::int64_t c) { return static_cast<std::int32_t>(c / 3); });
  });
}

const HalfEdges& WorkingSurface::half_edges() const {
  return made_once(half_edges_, [&] { return pair_half_edges(surface_.triangles, vertices()); });
}

const std::vector<std::int32_t>& WorkingSurface::leaving() const {
  return made_once(leaving_, [&] {
    std::vector<std::int32_t> leaving(idx(vertices()), -1);
    for (auto h = static_cast<std::int32_t>(surface_.triangles.size()) - 1; h >= 0; --h) {
      leaving[idx(surface_.triangles(h / 3, h % 3))] = h;
    }
    return leaving;
  });
}

}  // namespace curveskel
