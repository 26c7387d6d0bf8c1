#include <curveskel/clean.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <sstream>
#include <tuple>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"
#include "surface/mesh/half_edges.hpp"
#include "surface/mesh/whole.hpp"
#include "surface/repair/orient.hpp"
#include "surface/repair/repeated_polygons.hpp"
#include "surface/repair/sound_soup.hpp"
#include "surface/repair/weld.hpp"

namespace curveskel {
namespace {

/// Half-edges, three per face, are counted in 32 bits.
constexpr std::int64_t most_faces = 2147483647 / 3;

/// The work in progress: triangles over the vertices of the file until they are renumbered.
struct Draft {
  const PolygonSoup& soup;
  Surface surface;
  Changes changes;

  [[noreturn]] void fail(const std::string& found, const std::string& needed,
                         const std::string& remedy) const {
    const std::string file = soup.file.empty() ? "surface" : soup.file.string();
    throw Error(Fault::input, file + ": found " + found + ", needed " + needed + "; " + remedy);
  }

  [[nodiscard]] std::int32_t vertices() const {
    return static_cast<std::int32_t>(surface.positions.rows());
  }

  [[nodiscard]] std::string edge_words(std::int32_t half_edge) const {
    const std::int32_t a = surface.triangles.data()[half_edge];
    const std::int32_t b = surface.triangles.data()[next_half_edge(half_edge)];
    return "the edge between vertices " + vertex_words(std::min(a, b)) + " and " +
           vertex_words(std::max(a, b)) + ", counted from 0,";
  }

  [[nodiscard]] std::string vertex_words(std::int32_t vertex) const {
    const auto position = surface.positions.row(vertex);
    std::ostringstream words;
    words << vertex << " at (" << position.x() << " " << position.y() << " " << position.z() << ")";
    return words.str();
  }
};

void drop_repeats(Draft& draft) {
  draft.changes.degenerate_faces_dropped += drop_degenerate_faces(draft.surface.triangles);
  draft.changes.duplicate_faces_dropped +=
      drop_duplicate_faces(draft.surface.triangles, draft.vertices());
  if (draft.surface.triangles.rows() > 0) return;
  draft.fail("no face with three different vertices (" +
                 std::to_string(draft.changes.degenerate_faces_dropped) + " degenerate ones)",
             "a closed surface", "export the file again");
}

/// Drops repeats and pairs the rest; as most surfaces have no repeats, both are begun at once.
HalfEdges pair_without_repeats(Draft& draft, int threads) {
  auto paired =
      in_background(threads, [triangles = draft.surface.triangles, vertices = draft.vertices()] {
        return pair_half_edges(triangles, vertices);
      });
  const Eigen::Index given = draft.surface.triangles.rows();
  drop_repeats(draft);
  if (draft.surface.triangles.rows() == given) return paired.get();
  return pair_half_edges(draft.surface.triangles, draft.vertices());
}

/// Merges along the boundary alone: only there can merging close anything, and elsewhere it would
/// pinch a surface that is whole. Returns the vertex that each vertex of the file was merged into.
std::vector<std::int32_t> close_seams(Draft& draft, const std::vector<bool>& on_boundary) {
  auto merged_into = coincident_vertices(draft.surface.positions, on_boundary);
  for (std::int32_t v = 0; v < draft.vertices(); ++v) {
    draft.changes.vertices_merged += merged_into[idx(v)] != v ? 1 : 0;
  }
  for (std::int32_t& corner : draft.surface.triangles.reshaped<Eigen::RowMajor>()) {
    corner = merged_into[idx(corner)];
  }
  return merged_into;
}

void require_closed(const Draft& draft, const HalfEdges& half_edges) {
  if (half_edges.first_unpaired < 0) return;
  const std::string counts = " (in all " + std::to_string(half_edges.boundary_edges) +
                             " edges with one face, " + std::to_string(half_edges.crowded_edges) +
                             " with three or more)";
  const bool open = half_edges.faces_at_first == 1;
  draft.fail(draft.edge_words(half_edges.first_unpaired) + " with " +
                 std::to_string(half_edges.faces_at_first) + (open ? " face" : " faces") + counts,
             "a closed 2-manifold, every edge with exactly two faces",
             open ? "fill the holes, or weld vertices that nearly coincide, in a mesh editor first"
                  : "separate the parts that touch there, or remove inner faces, in a mesh editor "
                    "first");
}

void orient_consistently(Draft& draft, const Orientation& orientation) {
  if (orientation.conflict >= 0) {
    draft.fail("a one-sided (non-orientable) surface: at " +
                   draft.edge_words(orientation.conflict) +
                   " the two faces cannot be made to agree",
               "an orientable surface with an inside and an outside",
               "cut it there or thicken it in a mesh editor first");
  }
  for (Eigen::Index f = 0; f < draft.surface.triangles.rows(); ++f) {
    if (!orientation.turn[idx(f)]) continue;
    std::swap(draft.surface.triangles(f, 1), draft.surface.triangles(f, 2));
    ++draft.changes.faces_flipped;
  }
}

void turn_outward(Draft& draft, const Orientation& orientation, int threads) {
  const auto sums = component_sums(draft.surface, orientation, threads);
  for (const ComponentSums& sum : sums) {
    if (sum.encloses_something()) {
      draft.changes.components_turned += sum.volume < 0 ? 1 : 0;
      continue;
    }
    std::ostringstream found;
    found << "a closed component without volume (" << sum.volume << " of " << sum.area
          << " area, extent as unit): it is flat or its sides cancel; it begins with "
          << draft.edge_words(3 * sum.first_face);
    draft.fail(found.str(), "a surface that encloses some volume",
               "thicken or remove it in a mesh editor first");
  }
  for (Eigen::Index f = 0; f < draft.surface.triangles.rows(); ++f) {
    if (sums[idx(orientation.component_of_face[idx(f)])].volume < 0) {
      std::swap(draft.surface.triangles(f, 1), draft.surface.triangles(f, 2));
    }
  }
}

std::int64_t count_polygons_to_split(const PolygonSoup& soup) {
  std::int64_t count = 0;
  for (std::size_t p = 1; p < soup.offsets.size(); ++p) {
    count += soup.offsets[p] - soup.offsets[p - 1] > 3 ? 1 : 0;
  }
  return count;
}

Orientation orientation_of_whole(const Surface& surface, const Topology& whole) {
  Orientation orientation;
  orientation.components = whole.components();
  orientation.component_of_face.resize(idx(surface.triangles.rows()));
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    orientation.component_of_face[idx(f)] = whole.component_of_vertex[surface.triangles(f, 0)];
  }
  return orientation;
}

/// Closes, splits and orients; the vertices that it merges are noted.
Orientation mend(Draft& draft, std::vector<std::int32_t>& merged_into, const Monitor& monitor,
                 int threads) {
  HalfEdges half_edges = pair_without_repeats(draft, threads);
  monitor.report("clean", 0.4);
  if (half_edges.boundary_edges > 0) {
    merged_into = close_seams(draft, half_edges.vertex_on_boundary);
    drop_repeats(draft);
    monitor.report("clean", 0.6);
    half_edges = pair_half_edges(draft.surface.triangles, draft.vertices());
  }
  require_closed(draft, half_edges);
  monitor.report("clean", 0.8);
  auto oriented = in_background(threads, [&half_edges, triangles = draft.surface.triangles] {
    return orient(triangles, half_edges);
  });
  draft.changes.vertices_split_off = split_umbrellas(draft.surface, half_edges);
  Orientation orientation = oriented.get();
  orient_consistently(draft, orientation);
  return orientation;
}

}  // namespace

void describe_changes(Changes& changes, const Monitor& monitor) {
  const auto line = [&](std::int64_t count, const std::string& one, const std::string& many,
                        const std::string& what) {
    if (count == 0) return;
    changes.lines.push_back(std::to_string(count) + " " + (count == 1 ? one : many) + " " + what);
    monitor.say(changes.lines.back());
  };
  line(changes.unplaced_vertices_dropped, "vertex", "vertices",
       "with NaN or infinity left out, and " + std::to_string(changes.unplaced_polygons_dropped) +
           (changes.unplaced_polygons_dropped == 1 ? " face" : " faces") + " there");
  line(changes.polygons_triangulated, "polygon", "polygons", "triangulated");
  line(changes.vertices_merged, "vertex", "vertices", "merged with another at the same position");
  line(changes.degenerate_faces_dropped, "degenerate face", "degenerate faces",
       "dropped (repeated corner)");
  line(changes.duplicate_faces_dropped, "duplicate face", "duplicate faces",
       "dropped (same three vertices)");
  line(changes.isolated_vertices_dropped, "isolated vertex", "isolated vertices", "dropped");
  line(changes.vertices_split_off, "copy of a vertex", "copies of vertices",
       "made where parts of the surface touch in a point (bow-tie)");
  line(changes.faces_flipped, "face", "faces", "flipped to agree with the neighbours");
  line(changes.components_turned, "component", "components", "turned from inward to outward");
}

CleanSurface clean(const PolygonSoup& soup, const Monitor& monitor, int threads) {
  monitor.report("clean", 0);
  require_sound(soup);
  require_polygons(soup);
  Draft draft{soup, {soup.positions, {}}, {}};
  const auto once = without_repeated_polygons(soup, draft.changes.duplicate_faces_dropped);
  draft.surface.triangles = triangulate(once ? *once : soup, monitor.stop);
  draft.changes.polygons_triangulated = count_polygons_to_split(soup);
  draft.changes.unplaced_vertices_dropped = soup.unplaced_vertices;
  draft.changes.unplaced_polygons_dropped = soup.unplaced_polygons;
  if (draft.surface.triangles.rows() > most_faces) {
    draft.fail(std::to_string(draft.surface.triangles.rows()) + " triangles",
               "at most " + std::to_string(most_faces), "decimate the surface first");
  }
  monitor.report("clean", 0.2);
  std::vector<std::int32_t> merged_into(idx(draft.vertices()));
  std::iota(merged_into.begin(), merged_into.end(), 0);
  const std::int32_t before_split = draft.vertices();
  Orientation orientation;
  if (const auto whole = topology_if_whole(draft.surface, threads)) {
    orientation = orientation_of_whole(draft.surface, *whole);
  } else {
    orientation = mend(draft, merged_into, monitor, threads);
  }
  monitor.report("clean", 0.9);
  turn_outward(draft, orientation, threads);
  const std::vector<std::int32_t> number = drop_unused_vertices(draft.surface);

  CleanSurface result;
  result.vertex_of_input.resize(before_split);
  for (std::int32_t v = 0; v < before_split; ++v) {
    result.vertex_of_input[v] = number[idx(merged_into[idx(v)])];
    draft.changes.isolated_vertices_dropped += result.vertex_of_input[v] < 0 ? 1 : 0;
  }
  draft.changes.isolated_vertices_dropped -= soup.unplaced_vertices;
  describe_changes(draft.changes, monitor);
  result.components = orientation.components;
  result.surface = std::move(draft.surface);
  result.changes = std::move(draft.changes);
  monitor.report("clean", 1);
  return result;
}

}  // namespace curveskel
