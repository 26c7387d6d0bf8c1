#include <curveskel/advanced/coarsen.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <thread>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include "base/option_ranges.hpp"
#include "base/parallel.hpp"
#include "surface/resample/coarsen_whole.hpp"
#include "surface/resample/collapse.hpp"
#include "surface/spatial/morton.hpp"

namespace curveskel {
namespace {

using Index = std::int32_t;

constexpr const char* stage_name = "coarsen";
constexpr std::size_t part_size = 16384;  // vertices; such a part fits the second-level cache
constexpr std::size_t parts_leave = 2;    // times the target, before the last collapses
constexpr std::size_t parts_pay = 8;      // times the target: surfaces at least as fine

void add_planes(CollapsingPatch& patch, const std::array<Index, 3>& face) {
  const auto& p = patch.vertices[static_cast<std::size_t>(face[0])].position;
  const auto& q = patch.vertices[static_cast<std::size_t>(face[1])].position;
  const auto& r = patch.vertices[static_cast<std::size_t>(face[2])].position;
  const Eigen::Vector3d cross = (patch.scale * (q - p)).cross(patch.scale * (r - p));
  const double twice_area = cross.norm();
  if (!(twice_area > 0)) return;
  const Eigen::Vector3f normal = (cross / twice_area).cast<float>();
  for (const Index v : face) {
    patch.vertices[static_cast<std::size_t>(v)].quadric.add_plane(
        normal, static_cast<float>(twice_area / 2));
  }
}

// The surface with its vertices in this order, its faces sorted by their smallest vertex.
CollapsingPatch patch_in_order(const Surface& surface, const std::vector<Index>& order,
                               const std::vector<Index>& rank) {
  CollapsingPatch patch;
  patch.vertices.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    patch.vertices[i].position = surface.positions.row(order[i]).transpose();
  }
  patch.fixed.assign(order.size(), 0);

  const auto face_count = static_cast<std::size_t>(surface.triangles.rows());
  std::vector<std::array<Index, 3>> faces(face_count);
  std::vector<std::uint32_t> begin(order.size() + 1, 0);
  for (std::size_t f = 0; f < face_count; ++f) {
    std::array<Index, 3>& face = faces[f];
    for (std::size_t k = 0; k < 3; ++k) {
      face[k] = rank[static_cast<std::size_t>(
          surface.triangles(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(k)))];
    }
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    ++begin[static_cast<std::size_t>(face[0]) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  patch.faces.resize(face_count);
  double length = 0;
  for (const auto& face : faces) {
    patch.faces[begin[static_cast<std::size_t>(face[0])]++] = face;
    length += (patch.vertices[static_cast<std::size_t>(face[1])].position -
               patch.vertices[static_cast<std::size_t>(face[0])].position)
                  .norm();
  }
  // A power of two: exact, and the same for all numberings of one surface.
  if (length > 0) {
    patch.scale = std::exp2(-std::round(std::log2(length / static_cast<double>(face_count))));
  }
  return patch;
}

// Stretches of the curve, each with the faces that lie within it.
struct Stretches {
  std::vector<CollapsingPatch> patches;
  std::vector<std::array<Index, 3>> between;  // faces of several patches, their corners fixed
};

Stretches cut_into_stretches(const CollapsingPatch& whole) {
  const std::size_t count = whole.vertices.size();
  const std::size_t parts = (count + part_size - 1) / part_size;
  const auto part_of = [](Index v) { return static_cast<std::size_t>(v) / part_size; };
  Stretches stretches;
  std::vector<CollapsingPatch>& patches = stretches.patches;
  patches.resize(parts);
  for (std::size_t i = 0; i < parts; ++i) {
    const auto begin = whole.vertices.begin() + static_cast<std::ptrdiff_t>(i * part_size);
    const auto end =
        whole.vertices.begin() + static_cast<std::ptrdiff_t>(std::min(count, (i + 1) * part_size));
    patches[i].vertices.assign(begin, end);
    patches[i].fixed.assign(patches[i].vertices.size(), 0);
    patches[i].scale = whole.scale;
  }
  for (const auto& face : whole.faces) {
    const std::size_t part = part_of(face[0]);
    if (part_of(face[1]) == part && part_of(face[2]) == part) {
      const auto base = static_cast<Index>(part * part_size);
      patches[part].faces.push_back({face[0] - base, face[1] - base, face[2] - base});
    } else {
      stretches.between.push_back(face);
      for (const Index v : face) {
        patches[part_of(v)].fixed[static_cast<std::size_t>(v) % part_size] = 1;
      }
    }
  }
  return stretches;
}

// Collapses each patch on its own, until the share `target` / `count` of its free vertices is left.
// Returns, per patch, the place of each vertex after.
std::vector<std::vector<Index>> collapse_stretches(std::vector<CollapsingPatch>& patches,
                                                   std::size_t target, std::size_t count,
                                                   int threads, const Monitor& monitor) {
  const std::size_t parts = patches.size();
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<std::size_t> done{0};
  std::vector<std::vector<Index>> places(parts);
  parallel_for(parts, 1, threads, [&](std::size_t i, std::size_t) {
    CollapsingPatch& patch = patches[i];
    for (const auto& face : patch.faces) add_planes(patch, face);
    const auto fixed = static_cast<std::size_t>(
        std::count(patch.fixed.begin(), patch.fixed.end(), std::uint8_t{1}));
    const std::size_t free = patch.vertices.size() - fixed;
    const CollapseOptions options{static_cast<int>(fixed + free * target / count), 1};
    places[i] =
        collapse_edges(patch, options, [&](std::size_t) { throw_if_stopped(monitor.stop); });
    ++done;
    if (std::this_thread::get_id() == caller) {
      monitor.report(stage_name, 0.7 * static_cast<double>(done) / static_cast<double>(parts));
    }
  });
  return places;
}

// The patches become the whole again. Returns the place of each vertex in it.
std::vector<Index> join_stretches(const Stretches& stretches,
                                  const std::vector<std::vector<Index>>& places,
                                  CollapsingPatch& whole) {
  std::vector<Index> place(whole.vertices.size());
  whole.vertices.clear();
  whole.faces.clear();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const CollapsingPatch& patch = stretches.patches[i];
    const auto base = static_cast<Index>(whole.vertices.size());
    for (std::size_t v = 0; v < places[i].size(); ++v) {
      place[i * part_size + v] = base + places[i][v];
    }
    whole.vertices.insert(whole.vertices.end(), patch.vertices.begin(), patch.vertices.end());
    for (const auto& face : patch.faces) {
      whole.faces.push_back({face[0] + base, face[1] + base, face[2] + base});
    }
  }
  whole.fixed.assign(whole.vertices.size(), 0);
  for (const auto& face : stretches.between) {
    whole.faces.push_back({place[static_cast<std::size_t>(face[0])],
                           place[static_cast<std::size_t>(face[1])],
                           place[static_cast<std::size_t>(face[2])]});
    add_planes(whole, whole.faces.back());
  }
  return place;
}

// A first stage for far too fine surfaces: stretches of the curve are collapsed each on its own,
// the vertices between them fixed. Returns the place of each vertex after.
std::vector<Index> coarsen_parts(CollapsingPatch& whole, std::size_t target, int threads,
                                 const Monitor& monitor) {
  Stretches stretches = cut_into_stretches(whole);
  const auto places =
      collapse_stretches(stretches.patches, target, whole.vertices.size(), threads, monitor);
  return join_stretches(stretches, places, whole);
}

Surface surface_of(const CollapsingPatch& patch) {
  Surface surface;
  surface.positions.resize(static_cast<Eigen::Index>(patch.vertices.size()), 3);
  for (std::size_t v = 0; v < patch.vertices.size(); ++v) {
    surface.positions.row(static_cast<Eigen::Index>(v)) = patch.vertices[v].position.transpose();
  }
  surface.triangles.resize(static_cast<Eigen::Index>(patch.faces.size()), 3);
  for (std::size_t f = 0; f < patch.faces.size(); ++f) {
    surface.triangles.row(static_cast<Eigen::Index>(f)) << patch.faces[f][0], patch.faces[f][1],
        patch.faces[f][2];
  }
  return surface;
}

}  // namespace

bool coarsens_in_parts(Eigen::Index vertices, const CoarsenOptions& options) {
  const auto count = static_cast<std::size_t>(vertices);
  const auto target = static_cast<std::size_t>(std::max(options.target_vertices, 0));
  return count > parts_pay * target && count > 2 * part_size;
}

void require_valid(const CoarsenOptions& options) {
  const OptionCheck check("CoarsenOptions");
  check.number("target_vertices", options.target_vertices, {});
  check.number("threads", options.threads, thread_range);
}

Coarsened coarsen(const Surface& surface, const CoarsenOptions& options, const Monitor& monitor) {
  require_valid(options);
  require_closed_manifold(surface, "coarsen", options.threads);
  return coarsen_whole(surface, options, monitor);
}

Coarsened coarsen_whole(const Surface& surface, const CoarsenOptions& options,
                        const Monitor& monitor) {
  monitor.report(stage_name, 0);
  const auto count = static_cast<std::size_t>(surface.positions.rows());
  const auto target = static_cast<std::size_t>(std::max(options.target_vertices, 0));
  Coarsened result;
  if (count <= target) {
    result.surface = surface;
    result.vertex_of_input = Eigen::VectorXi::LinSpaced(static_cast<Eigen::Index>(count), 0,
                                                        static_cast<int>(count) - 1);
    monitor.report(stage_name, 1);
    return result;
  }

  // Along the curve ties are broken by place rather than by numbering.
  const std::vector<Index> order = along_morton_curve(surface.positions, options.threads);
  std::vector<Index> place(count);  // first along the curve, then in the result, per input vertex
  for (std::size_t i = 0; i < count; ++i) {
    place[static_cast<std::size_t>(order[i])] = static_cast<Index>(i);
  }
  CollapsingPatch patch = patch_in_order(surface, order, place);
  const auto follow = [&place](const std::vector<Index>& next) {
    for (Index& v : place) v = next[static_cast<std::size_t>(v)];
  };
  if (coarsens_in_parts(surface.positions.rows(), options)) {
    follow(coarsen_parts(patch, parts_leave * target, options.threads, monitor));
    result.halfway = surface_of(patch);
  } else {
    for (const auto& face : patch.faces) add_planes(patch, face);
  }
  const std::size_t start = patch.vertices.size();
  const CollapseOptions last{static_cast<int>(target), options.threads};
  follow(collapse_edges(patch, last, [&](std::size_t left) {
    monitor.report(stage_name, 1 - 0.3 * static_cast<double>(left - target) /
                                       static_cast<double>(start - target));
  }));

  result.surface = surface_of(patch);
  result.vertex_of_input =
      Eigen::Map<const Eigen::VectorXi>(place.data(), surface.positions.rows());
  monitor.report(stage_name, 1);
  return result;
}

}  // namespace curveskel
