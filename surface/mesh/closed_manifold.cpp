#include <curveskel/advanced/closed_manifold.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include "surface/mesh/whole.hpp"

namespace curveskel {
namespace {

/// The number of places where something is wrong, and the first of them.
struct Defect {
  std::int64_t count = 0;
  std::string first;

  void add(const std::string& place) {
    if (count++ == 0) first = place;
  }
};

std::string vertex_words(std::int32_t vertex) { return "vertex " + std::to_string(vertex); }

std::string edge_words(std::int32_t a, std::int32_t b) {
  return "from vertex " + std::to_string(a) + " to " + std::to_string(b);
}

/// A face's edge, its lower vertex first.
struct FaceSide {
  std::int32_t low;
  std::int32_t high;
  bool upward;  // whether the face runs from low to high

  [[nodiscard]] bool operator<(const FaceSide& other) const {
    return low != other.low ? low < other.low : high < other.high;
  }
};

struct Defects {
  Defect repeated_corners;
  Defect open_edges;
  Defect crowded_edges;
  Defect opposed_faces;
  Defect lone_vertices;
  Defect pinched_vertices;
  Defect double_faces;
};

void look_at_edges(const Surface& surface, Defects& defects) {
  std::vector<FaceSide> sides;
  sides.reserve(idx(surface.triangles.size()));
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = surface.triangles(f, k);
      const std::int32_t b = surface.triangles(f, (k + 1) % 3);
      if (a == b) {
        defects.repeated_corners.add("face " + std::to_string(f));
      } else {
        sides.push_back({std::min(a, b), std::max(a, b), a < b});
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  for (auto run = sides.begin(); run != sides.end();) {
    const auto end = std::upper_bound(run, sides.end(), *run);
    const std::string place = edge_words(run->low, run->high);
    if (end - run == 1) defects.open_edges.add(place);
    if (end - run > 2) defects.crowded_edges.add(place);
    if (end - run == 2 && run[0].upward == run[1].upward) defects.opposed_faces.add(place);
    run = end;
  }
}

/// The faces round each vertex are one fan where the edges opposite to it make one circle.
void look_at_vertices(const Surface& surface, Defects& defects) {
  std::vector<std::vector<std::array<std::int32_t, 2>>> around(idx(surface.positions.rows()));
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      around[idx(surface.triangles(f, k))].push_back(
          {surface.triangles(f, (k + 1) % 3), surface.triangles(f, (k + 2) % 3)});
    }
  }
  for (std::size_t v = 0; v < around.size(); ++v) {
    const auto& edges = around[v];
    const auto vertex = static_cast<std::int32_t>(v);
    if (edges.empty()) {
      defects.lone_vertices.add(vertex_words(vertex));
      continue;
    }
    std::size_t steps = 0;
    std::int32_t now = edges.front()[0];
    do {
      const auto next = std::find_if(edges.begin(), edges.end(),
                                     [now](const auto& edge) { return edge[0] == now; });
      if (next == edges.end()) break;
      now = (*next)[1];
      ++steps;
    } while (now != edges.front()[0] && steps <= edges.size());
    if (steps != edges.size()) defects.pinched_vertices.add(vertex_words(vertex));
  }
}

void look_at_faces(const Surface& surface, Defects& defects) {
  std::vector<std::array<std::int32_t, 3>> faces;
  faces.reserve(idx(surface.triangles.rows()));
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    std::array<std::int32_t, 3> face{surface.triangles(f, 0), surface.triangles(f, 1),
                                     surface.triangles(f, 2)};
    std::sort(face.begin(), face.end());
    faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end());
  for (std::size_t f = 1; f < faces.size(); ++f) {
    if (faces[f] != faces[f - 1]) continue;
    const auto& [a, b, c] = faces[f];
    defects.double_faces.add("vertices " + std::to_string(a) + ", " + std::to_string(b) + ", " +
                             std::to_string(c));
  }
}

Defects defects_of(const Surface& surface) {
  Defects defects;
  look_at_edges(surface, defects);
  // Round the ends of such edges no fan can be expected.
  const bool edges_pair = defects.repeated_corners.count + defects.open_edges.count +
                              defects.crowded_edges.count + defects.opposed_faces.count ==
                          0;
  if (edges_pair) look_at_vertices(surface, defects);
  if (edges_pair) look_at_faces(surface, defects);
  return defects;
}

std::string defect_words(const Defects& defects) {
  std::string text;
  const auto say = [&text](const Defect& defect, const std::string& one, const std::string& many) {
    if (defect.count == 0) return;
    text += (text.empty() ? "" : ", ") + std::to_string(defect.count) + " " +
            (defect.count == 1 ? one + " (" : many + " (the first: ") + defect.first + ")";
  };
  say(defects.repeated_corners, "face with a repeated corner", "faces with a repeated corner");
  say(defects.open_edges, "open edge", "open edges");
  say(defects.crowded_edges, "non-manifold edge", "non-manifold edges");
  say(defects.opposed_faces, "edge whose faces are turned opposite ways",
      "edges whose faces are turned opposite ways");
  say(defects.lone_vertices, "vertex without a face", "vertices without a face");
  say(defects.pinched_vertices, "non-manifold vertex", "non-manifold vertices");
  say(defects.double_faces, "face that another one repeats", "faces that others repeat");
  return text;
}

[[noreturn]] void refuse(std::string_view purpose, const std::string& found,
                         const std::string& needed) {
  throw Error(Fault::input,
              std::string(purpose) + ": the surface has " + found + ", needed " + needed);
}

/// The squares of lengths have to be numbers.
void require_usual_size(const Surface& surface, std::string_view purpose) {
  constexpr double least = 1e-150;
  constexpr double most = 1e150;
  const double diagonal = bounding_box_diagonal(surface.positions);
  if (diagonal == 0 || (diagonal >= least && diagonal <= most)) return;
  std::ostringstream found;
  found << "a bounding box with the diagonal " << diagonal;
  refuse(purpose, found.str(), "one between 1e-150 and 1e150: scale the surface");
}

}  // namespace

void require_corners(const Surface& surface, std::string_view purpose) {
  const Eigen::Index vertices = surface.positions.rows();
  const auto out_of_range = [vertices](std::int32_t v) { return v < 0 || v >= vertices; };
  const std::int32_t* const corners = surface.triangles.data();
  const std::int32_t* const end = corners + surface.triangles.size();
  if (const auto* wrong = std::find_if(corners, end, out_of_range); wrong != end) {
    refuse(purpose,
           "a face (number " + std::to_string((wrong - corners) / 3) + ") with corner " +
               std::to_string(*wrong),
           "a surface whose corners are vertices, 0.." + std::to_string(vertices - 1));
  }
}

void require_sound(const Surface& surface, std::string_view purpose) {
  if (surface.triangles.rows() == 0) {
    refuse(purpose, std::to_string(surface.positions.rows()) + " vertices without faces",
           "a surface with faces");
  }
  require_corners(surface, purpose);
  if (surface.positions.allFinite()) return;
  Eigen::Index vertex = 0;
  while (surface.positions.row(vertex).allFinite()) ++vertex;
  refuse(purpose, "a coordinate that is no finite number (vertex " + std::to_string(vertex) + ")",
         "a surface of finite coordinates");
}

void require_closed_manifold(const Surface& surface, std::string_view purpose, int threads) {
  require_sound(surface, purpose);
  require_usual_size(surface, purpose);
  if (is_whole(surface, threads)) return;
  refuse(purpose, defect_words(defects_of(surface)), "a closed manifold; repair() makes one of it");
}

}  // namespace curveskel
