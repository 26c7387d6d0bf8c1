#include "surface/repair/bodies_and_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "base/buckets.hpp"
#include "surface/mesh/crosses_itself.hpp"
#include "surface/mesh/half_edges.hpp"
#include "surface/mesh/triangle_area.hpp"
#include "surface/repair/tangles.hpp"

namespace curveskel {
namespace {

/// True if the face runs through its corners in the given order.
bool runs_as_given(const ClosedParts& closed, const Joined& joined, Eigen::Index f) {
  const auto given = joined.surface.triangles.row(closed.face_given[idx(f)]);
  const auto position_of = [&](int corner) {
    return closed.surface.positions.row(closed.surface.triangles(f, corner));
  };
  // Stitching may have put a coincident vertex in a corner's place, so positions are compared.
  for (int turn = 0; turn < 3; ++turn) {
    bool same = true;
    for (int k = 0; k < 3; ++k) {
      same = same && position_of((k + turn) % 3) == joined.surface.positions.row(given(k));
    }
    if (same) return true;
  }
  return false;
}

/// True if a surface has no boundary, and no orientation.
bool is_one_sided(const Joined& joined) {
  const HalfEdges half_edges = pair_half_edges(
      joined.surface.triangles, static_cast<std::int32_t>(joined.surface.positions.rows()));
  if (half_edges.first_unpaired >= 0) return false;
  return orient(joined.surface.triangles, half_edges).conflict >= 0;
}

/// Components one by one, each with its own vertices alone.
class ComponentsApart {
 public:
  ComponentsApart(const Surface& whole, const Orientation& orientation)
      : whole_(whole),
        faces_(bucket<std::int32_t>(
            whole.triangles.rows(), orientation.components,
            [&](std::int64_t f) { return orientation.component_of_face[idx(f)]; },
            [](std::int64_t f) { return static_cast<std::int32_t>(f); })) {}

  [[nodiscard]] Surface operator[](std::size_t number) const {
    const std::vector<std::int32_t> rows(faces_.values.begin() + faces_.offsets[number],
                                         faces_.values.begin() + faces_.offsets[number + 1]);
    Surface own{{}, whole_.triangles(rows, Eigen::all)};
    const auto corners = own.triangles.reshaped();
    std::vector<std::int32_t> used(corners.begin(), corners.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    own.positions = whole_.positions(used, Eigen::all);
    for (std::int32_t& corner : own.triangles.reshaped()) {
      corner = static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), corner) -
                                         used.begin());
    }
    return own;
  }

 private:
  const Surface& whole_;
  Buckets<std::int32_t> faces_;
};

/// A car's body without its floor and windows, a mask, a dome: a flat sheet has no volume, the cap
/// of a sphere up to 45 degrees .039 area^1.5, half a sphere .072, a cube .068.
bool is_roomy(const ComponentSums& part) {
  constexpr double least_volume = 0.04;  // of area^1.5
  return std::abs(part.volume) >= least_volume * std::pow(part.area, 1.5);
}

}  // namespace

JudgedParts judge_parts(const ClosedParts& closed, const Joined& joined,
                        const RepairOptions& options, int threads, const Monitor& monitor) {
  const auto vertices = static_cast<std::int32_t>(closed.surface.positions.rows());
  JudgedParts judged;
  judged.orientation =
      orient(closed.surface.triangles, pair_half_edges(closed.surface.triangles, vertices));
  judged.parts.resize(idx(judged.orientation.components));
  for (Eigen::Index f = 0; f < closed.surface.triangles.rows(); ++f) {
    JudgedPart& part = judged.parts[idx(judged.orientation.component_of_face[idx(f)])];
    const double area = twice_area(closed.surface, f) / 2;
    part.area += area;
    if (closed.face_given[idx(f)] < 0) {
      part.added_area += area;
    } else {
      ++part.given_faces;
      part.faces_as_given += runs_as_given(closed, joined, f) ? 1 : 0;
    }
  }
  constexpr double more_if_roomy = 4.0 / 3;
  const auto sums = component_sums(closed.surface, judged.orientation, threads);
  constexpr double small_cut = 0.05;  // of the vertices
  const bool was_cut_much =
      double(closed.vertices_copied) > small_cut * double(joined.surface.positions.rows());
  // Cut open along its conflict, which leaves a shape of its own.
  const bool one_sided = was_cut_much && is_one_sided(joined);
  const ComponentsApart components(closed.surface, judged.orientation);
  for (std::size_t c = 0; c < judged.parts.size(); ++c) {
    throw_if_stopped(monitor.stop);
    JudgedPart& part = judged.parts[c];
    part.volume = sums[c].volume;
    const double most = options.most_added_area * part.area;
    part.is_tangle = is_tangle(components[c], was_cut_much);
    part.is_body =
        !one_sided && sums[c].encloses_something() &&
        (part.added_area <= most || (part.added_area <= more_if_roomy * most && is_roomy(sums[c]) &&
                                     !crosses_itself(components[c]))) &&
        !part.is_tangle;
  }
  return judged;
}

Triangles outward_bodies(const ClosedParts& closed, const JudgedParts& judged, Changes& changes) {
  for (const JudgedPart& part : judged.parts) {
    if (!part.is_body) continue;
    const bool inward = part.volume < 0;
    const std::int64_t as_given =
        inward ? part.given_faces - part.faces_as_given : part.faces_as_given;
    const std::int64_t turned = part.given_faces - as_given;
    changes.components_turned += turned > as_given ? 1 : 0;
    changes.faces_flipped += std::min(turned, as_given);
  }
  Triangles result(closed.surface.triangles.rows(), 3);
  Eigen::Index rows = 0;
  for (Eigen::Index f = 0; f < closed.surface.triangles.rows(); ++f) {
    const JudgedPart& part = judged.parts[idx(judged.orientation.component_of_face[idx(f)])];
    if (!part.is_body) continue;
    result.row(rows) = closed.surface.triangles.row(f);
    if (part.volume < 0) std::swap(result(rows, 1), result(rows, 2));
    ++rows;
  }
  result.conservativeResize(rows, 3);
  return result;
}

Sheets sheets_of(const ClosedParts& closed, const JudgedParts& judged, const Joined& joined) {
  Sheets sheets{{joined.surface.positions, {}}, 0, 0};
  for (const JudgedPart& part : judged.parts) {
    if (part.is_body) continue;
    ++sheets.components;
    sheets.area += part.area - part.added_area;
  }
  std::vector<std::int32_t> rows;
  for (std::size_t f = 0; f < closed.face_given.size(); ++f) {
    if (closed.face_given[f] < 0) continue;
    if (!judged.parts[idx(judged.orientation.component_of_face[f])].is_body) {
      rows.push_back(closed.face_given[f]);
    }
  }
  sheets.surface.triangles = joined.surface.triangles(rows, Eigen::all);
  return sheets;
}

}  // namespace curveskel
