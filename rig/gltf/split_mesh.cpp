#include "rig/gltf/split_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "surface/read/formats.hpp"
#include "surface/read/placed_vertices.hpp"

namespace curveskel {
namespace {

/// Places ascend, mostly without a gap.
std::size_t number_of_place(const std::vector<std::int32_t>& places, std::int32_t place) {
  const auto guess = static_cast<std::size_t>(place - places.front());
  if (guess < places.size() && places[guess] == place) return guess;
  return idx(std::lower_bound(places.begin(), places.end(), place) - places.begin());
}

/// Of each corner the vertex: the file's own for the first corner there and those like it.
class Splitting {
 public:
  explicit Splitting(const std::vector<std::int32_t>& places)
      : places_(places), split_(places.size()), named_(places.size(), false) {}

  std::int32_t vertex_of(const DressedCorner& corner) {
    const std::size_t own = number_of_place(places_, corner.place);
    if (!named_[own]) {
      named_[own] = true;
      split_[own] = corner;
    }
    const auto is_same = [&](const DressedCorner& other) {
      return other.texture == corner.texture && other.normal == corner.normal &&
             other.colour == corner.colour;
    };
    if (is_same(split_[own])) return static_cast<std::int32_t>(own);
    const std::array<std::int32_t, 4> key{corner.place, corner.texture, corner.normal,
                                          corner.colour};
    const auto [copy, is_new] = copies_.try_emplace(key, static_cast<std::int32_t>(split_.size()));
    if (is_new) split_.push_back(corner);
    return copy->second;
  }

  std::vector<DressedCorner> take() {
    for (std::size_t v = 0; v < named_.size(); ++v) split_[v].place = places_[v];
    return std::move(split_);
  }

 private:
  const std::vector<std::int32_t>& places_;  ///< ascending
  std::vector<DressedCorner> split_;
  std::vector<bool> named_;
  std::map<std::array<std::int32_t, 4>, std::int32_t> copies_;
};

/// Of each part the places that its faces have, and of its own those that no face has.
class PlacesOfParts {
 public:
  explicit PlacesOfParts(const DressedMesh& mesh)
      : mesh_(mesh), last_part_(mesh.places.size() / 3, none) {}

  std::vector<PartRange> ranges() {
    std::vector<PartRange> ranges;
    for (std::size_t k = 0; k < mesh_.parts.size(); ++k) {
      const bool is_last = k + 1 == mesh_.parts.size();
      ranges.push_back({k,
                        mesh_.parts[k],
                        {},
                        mesh_.parts[k].first_face,
                        is_last ? mesh_.material_of_face.size() : mesh_.parts[k + 1].first_face});
      add_places_of_faces(ranges.back());
    }
    std::size_t k = 0;
    for (std::size_t place = 0; place < last_part_.size(); ++place) {
      while (k + 1 < ranges.size() && mesh_.parts[k + 1].first_place <= place) ++k;
      if (last_part_[place] == none) ranges[k].places.push_back(static_cast<std::int32_t>(place));
    }
    for (PartRange& range : ranges) std::sort(range.places.begin(), range.places.end());
    return ranges;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  void add_places_of_faces(PartRange& part) {
    const auto begin = mesh_.corners.begin() + mesh_.offsets[part.first_face];
    const auto end = mesh_.corners.begin() + mesh_.offsets[part.end_face];
    for (auto corner = begin; corner != end; ++corner) {
      std::size_t& last = last_part_[idx(corner->place)];
      if (last != part.number) part.places.push_back(corner->place);
      last = part.number;
    }
  }

  const DressedMesh& mesh_;
  std::vector<std::size_t> last_part_;  // whose faces have the place
};

bool has_places(const DressedMesh& mesh, std::size_t face) {
  const auto begin = mesh.corners.begin() + mesh.offsets[face];
  const auto end = mesh.corners.begin() + mesh.offsets[face + 1];
  return std::all_of(begin, end, [&](const DressedCorner& corner) {
    const double* place = mesh.places.data() + 3 * idx(corner.place);
    return std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]);
  });
}

/// One past the last for none.
std::size_t material_or_none(const DressedMesh& mesh, std::size_t face) {
  const int material = mesh.material_of_face[face];
  return material < 0 ? mesh.materials.size() : idx(material);
}

}  // namespace

std::vector<PartRange> ranges_of(const DressedMesh& mesh) { return PlacesOfParts(mesh).ranges(); }

SplitMesh split(const DressedMesh& mesh, const PartRange& part, const FileBytes& file) {
  SplitMesh result;
  std::vector<std::size_t> faces;
  for (std::size_t face = part.first_face; face < part.end_face; ++face) {
    if (!has_places(mesh, face)) continue;
    faces.push_back(face);
    result.materials.push_back(material_or_none(mesh, face));
  }
  std::sort(result.materials.begin(), result.materials.end());
  result.materials.erase(std::unique(result.materials.begin(), result.materials.end()),
                         result.materials.end());
  result.corners.resize(result.materials.size());
  result.offsets.resize(result.materials.size(), {0});
  Splitting splitting(part.places);
  for (const std::size_t face : faces) {
    const auto own = std::ranges::lower_bound(result.materials, material_or_none(mesh, face));
    const std::size_t group = idx(own - result.materials.begin());
    const auto begin = mesh.corners.begin() + mesh.offsets[face];
    const auto end = mesh.corners.begin() + mesh.offsets[face + 1];
    for (auto corner = begin; corner != end; ++corner) {
      result.corners[group].push_back(splitting.vertex_of(*corner));
    }
    result.group_of_face.push_back(group);
    result.offsets[group].push_back(static_cast<std::int64_t>(result.corners[group].size()));
  }
  result.vertices = splitting.take();
  for (const DressedCorner& vertex : result.vertices) {
    result.place_of_vertex.push_back(
        static_cast<std::int32_t>(number_of_place(part.places, vertex.place)));
  }
  std::vector<double> coordinates;
  for (const DressedCorner& vertex : result.vertices) {
    const double* place = mesh.places.data() + 3 * idx(vertex.place);
    coordinates.insert(coordinates.end(), place, place + 3);
  }
  result.soup.positions = positions_from(coordinates);
  result.soup.offsets = {0};
  drop_unplaced_vertices(result.soup, file);
  return result;
}

}  // namespace curveskel
