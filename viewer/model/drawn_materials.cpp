#include "viewer/model/drawn_materials.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <utility>

#include <curveskel/error.hpp>

namespace curveskel::viewer {
namespace {

float srgb(float linear) {
  const float value = std::clamp(linear, 0.0F, 1.0F);
  return value <= 0.0031308F ? 12.92F * value : 1.055F * std::pow(value, 1 / 2.4F) - 0.055F;
}

float wrapped(float place, bool repeats) {
  return repeats ? place - std::floor(place) : std::clamp(place, 0.0F, 1.0F);
}

/// The pixel there, 0..1.
glm::vec3 sampled(const Picture& picture, const glm::vec2& place, std::array<bool, 2> repeats) {
  const auto pixel = [](float share, int size) {
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>(share * static_cast<float>(size)), 0, size - 1));
  };
  const std::size_t x = pixel(wrapped(place.x, repeats[0]), picture.width);
  const std::size_t y = pixel(wrapped(place.y, repeats[1]), picture.height);
  const std::uint8_t* at = &picture.bytes[(y * static_cast<std::size_t>(picture.width) + x) * 4];
  return glm::vec3(at[0], at[1], at[2]) / 255.0F;
}

class Drawing {
 public:
  Drawing(const SurfaceMaterials& given, std::size_t vertices) : given_(given) {
    made_.colour_of_vertex.assign(vertices, rgba(glm::vec3(1)));
    for (const EncodedPicture& picture : given.pictures) {
      made_.pictures.push_back(decoded(picture));
    }
    for (const int vertex : given.vertices) {
      made_.vertices.push_back(static_cast<std::uint32_t>(vertex));
    }
    for (const auto& place : given.places_in_picture.rowwise()) {
      made_.places.emplace_back(place[0], place[1]);
    }
    made_.colours.assign(made_.vertices.size(), rgba(glm::vec3(1)));
  }

  DrawnMaterials draw() {
    std::vector<Eigen::Index> order(given_.material.size());
    std::iota(order.begin(), order.end(), 0);
    const auto material_of = [&](Eigen::Index f) {
      return given_.material[static_cast<std::size_t>(f)];
    };
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return material_of(a) < material_of(b);
    });
    for (const Eigen::Index f : order) {
      if (made_.runs.empty() || material_of(f) != last_) begin(material_of(f));
      if (is_clear()) continue;
      ++made_.runs.back().count;
      add(f);
    }
    return std::move(made_);
  }

 private:
  void begin(int material) {
    last_ = material;
    material_ =
        material < 0 ? SurfaceMaterial{} : given_.materials[static_cast<std::size_t>(material)];
    const bool is_seen = material_.picture >= 0 &&
                         !made_.pictures[static_cast<std::size_t>(material_.picture)].bytes.empty();
    if (!is_seen) material_.picture = -1;
    made_.runs.push_back(
        {material_.picture, material_.is_cut_out, material_.repeats, made_.triangles.size(), 0});
  }

  /// Glass, as over eyes.
  [[nodiscard]] bool is_clear() const { return material_.is_cut_out && material_.colour[3] < 0.5F; }

  void add(Eigen::Index f) {
    const auto corner = [&](int k) { return static_cast<std::uint32_t>(given_.triangles(f, k)); };
    made_.triangles.emplace_back(corner(0), corner(1), corner(2));
    for (int k = 0; k < 3; ++k) colour(corner(k));
  }

  void colour(std::uint32_t vertex) {
    glm::vec3 factor(0);
    for (int k = 0; k < 3; ++k) {
      factor[k] = srgb(material_.colour[static_cast<std::size_t>(k)] *
                       given_.colours(static_cast<Eigen::Index>(vertex), k));
    }
    made_.colours[vertex] = rgba(factor);
    const glm::vec3 seen =
        material_.picture < 0 ? glm::vec3(1)
                              : sampled(made_.pictures[static_cast<std::size_t>(material_.picture)],
                                        made_.places[vertex], material_.repeats);
    made_.colour_of_vertex[made_.vertices[vertex]] = rgba(factor * seen);
  }

  const SurfaceMaterials& given_;
  DrawnMaterials made_;
  int last_ = -1;  // the material of the run
  SurfaceMaterial material_;
};

}  // namespace

DrawnMaterials drawn_materials(const SurfaceMaterials& given, std::size_t vertices) {
  return Drawing(given, vertices).draw();
}

std::shared_ptr<const DrawnMaterials> materials_of(const std::filesystem::path& file,
                                                   std::size_t vertices, const Monitor& monitor) {
  try {
    const auto given = read_materials(file, monitor);
    const bool fits =
        given && std::all_of(given->vertices.begin(), given->vertices.end(), [&](int vertex) {
          return static_cast<std::size_t>(vertex) < vertices;
        });
    if (!fits) return nullptr;
    return std::make_shared<const DrawnMaterials>(drawn_materials(*given, vertices));
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception&) {
    return nullptr;
  }
}

}  // namespace curveskel::viewer
