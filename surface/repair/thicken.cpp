#include "surface/repair/thicken.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include "surface/repair/assembly.hpp"

namespace curveskel {
namespace {

using Eigen::RowVector3d;

constexpr double half_thickness = 0.01;  // of the square root of the area

/// From one vertex to another.
using DirectedEdge = std::pair<std::int32_t, std::int32_t>;

/// One sheet with vertices of its own.
struct Sheet {
  Surface surface;
  std::vector<std::int32_t> in_closed;  ///< #V
};

Sheet sheet_of(const Surface& closed, const std::vector<Eigen::Index>& faces) {
  Sheet sheet;
  sheet.surface.triangles = closed.triangles(faces, Eigen::all);
  std::map<std::int32_t, std::int32_t> number;
  for (const std::int32_t v : sheet.surface.triangles.reshaped()) number.emplace(v, 0);
  for (auto& [in_closed, own] : number) {
    own = static_cast<std::int32_t>(sheet.in_closed.size());
    sheet.in_closed.push_back(in_closed);
  }
  for (std::int32_t& v : sheet.surface.triangles.reshaped()) v = number.at(v);
  sheet.surface.positions = closed.positions(sheet.in_closed, Eigen::all);
  return sheet;
}

/// The edges of faces that no other face shares, as the faces run.
std::vector<DirectedEdge> boundary_of(const Triangles& triangles) {
  std::set<DirectedEdge> directed;
  for (const auto& t : triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) directed.emplace(t[k], t[(k + 1) % 3]);
  }
  std::vector<DirectedEdge> boundary;
  for (const auto& [from, to] : directed) {
    if (directed.count({to, from}) == 0) boundary.emplace_back(from, to);
  }
  return boundary;
}

bool passes_once(const std::vector<DirectedEdge>& boundary) {
  std::set<std::int32_t> begun;
  for (const auto& [from, to] : boundary) {
    if (!begun.insert(from).second) return false;
  }
  return true;
}

/// n x 3, the sums of the faces' vectors, whose lengths are twice the areas.
Positions area_vectors(const Surface& surface) {
  Positions sums = Positions::Zero(surface.positions.rows(), 3);
  for (const auto& t : surface.triangles.rowwise()) {
    const RowVector3d a = surface.positions.row(t[0]);
    const RowVector3d vector =
        (surface.positions.row(t[1]) - a).cross(surface.positions.row(t[2]) - a);
    for (const std::int32_t v : t) sums.row(v) += vector;
  }
  return sums;
}

/// No vertices if the sheet has no second side. The first half of the vertices are above the
/// sheet's, the others below.
Surface two_sided(const Surface& sheet) {
  const std::vector<DirectedEdge> boundary = boundary_of(sheet.triangles);
  const Positions up = area_vectors(sheet);
  const double whole = area(sheet);
  constexpr double cancelled = 1e-9;  // of the area
  const bool has_two_sides = !boundary.empty() && passes_once(boundary) &&
                             (up.rowwise().norm().array() > cancelled * whole).all();
  if (!has_two_sides) return {};
  const Positions offset = half_thickness * std::sqrt(whole) * up.rowwise().normalized();
  const Eigen::Index count = sheet.positions.rows();
  const auto below = static_cast<std::int32_t>(count);
  const Eigen::Index faces = sheet.triangles.rows();
  Surface both;
  both.positions.resize(2 * count, 3);
  both.positions << sheet.positions + offset, sheet.positions - offset;
  both.triangles.resize(2 * faces + 2 * static_cast<Eigen::Index>(boundary.size()), 3);
  both.triangles.topRows(faces) = sheet.triangles;
  both.triangles.middleRows(faces, faces) = sheet.triangles.rowwise().reverse().array() + below;
  Eigen::Index row = 2 * faces;
  for (const auto& [from, to] : boundary) {
    both.triangles.row(row++) << to, from, from + below;
    both.triangles.row(row++) << to, from + below, to + below;
  }
  return both;
}

/// The given faces of each part that is no body.
std::vector<std::vector<Eigen::Index>> faces_of_sheets(const ClosedParts& closed,
                                                       const JudgedParts& judged) {
  std::vector<std::vector<Eigen::Index>> faces(judged.parts.size());
  for (std::size_t f = 0; f < closed.face_given.size(); ++f) {
    const auto part = idx(judged.orientation.component_of_face[f]);
    if (closed.face_given[f] < 0 || judged.parts[part].is_body) continue;
    faces[part].push_back(static_cast<Eigen::Index>(f));
  }
  return faces;
}

}  // namespace

ThickSheets thicken(const ClosedParts& closed, const JudgedParts& judged, double least_extent) {
  Assembly made;
  ThickSheets result;
  result.number.assign(closed.vertex_given.size(), -1);
  for (const std::vector<Eigen::Index>& faces : faces_of_sheets(closed, judged)) {
    if (faces.empty()) continue;
    const Sheet sheet = sheet_of(closed.surface, faces);
    if (bounding_box_diagonal(sheet.surface.positions) < least_extent) continue;
    const Surface both = two_sided(sheet.surface);
    if (both.positions.rows() == 0) continue;
    const std::int32_t first = made.add(both);
    result.firsts.push_back(first);
    for (std::size_t v = 0; v < sheet.in_closed.size(); ++v) {
      result.number[idx(sheet.in_closed[v])] = first + static_cast<std::int32_t>(v);
    }
  }
  result.surface = made.whole();
  return result;
}

}  // namespace curveskel
