#include "rig/gltf/dressed_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// The row of a key, which is the next one if the key is new.
template <typename Map, typename Rows, typename Make>
std::int32_t row_of(Map& known, const typename Map::key_type& key, Rows& rows, const Make& make) {
  const auto [entry, is_new] = known.try_emplace(key, static_cast<std::int32_t>(rows.size()));
  if (is_new) rows.push_back(make());
  return entry->second;
}

template <typename Numbers>
bool all_finite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](auto one) { return std::isfinite(one); });
}

}  // namespace

void DressedRows::begin_mesh() {
  textures_.clear();
  normals_.clear();
  colours_.clear();
}

std::int32_t DressedRows::texture(const TextureRow& row) {
  if (!all_finite(row)) return -1;
  return row_of(textures_, row, mesh_.textures, [&] { return row; });
}

std::int32_t DressedRows::normal(std::size_t vertex, const Eigen::Vector3d& given,
                                 const Eigen::Matrix3d& map) {
  if (!given.allFinite()) return -1;
  const Eigen::Vector3f said = given.cast<float>();
  return row_of(normals_, {vertex, said.x(), said.y(), said.z()}, mesh_.normals, [&] {
    const Eigen::Vector3f turned = (map * given).normalized().cast<float>();
    return std::array<float, 3>{turned.x(), turned.y(), turned.z()};
  });
}

std::int32_t DressedRows::colour(const ColourRow& row) {
  if (!all_finite(row)) return -1;
  return row_of(colours_, row, mesh_.colours, [&] { return row; });
}

void DressedRows::place(const PolygonSoup& soup) {
  mesh_.places.assign(soup.positions.data(), soup.positions.data() + soup.positions.size());
  mesh_.offsets = soup.offsets;
  for (std::size_t c = 0; c < soup.corners.size(); ++c) mesh_.corners[c].place = soup.corners[c];
  for (const DressedShape& shape : mesh_.shapes) {
    if (shape.weight == 0) continue;
    for (const auto& [place, move] : shape.moves) {
      Eigen::Map<Eigen::Vector3d>(&mesh_.places[3 * idx(place)]) -= shape.weight * move;
    }
  }
}

}  // namespace curveskel
