#include "surface/repair/tangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include "surface/mesh/loose_parts.hpp"

namespace curveskel {
namespace {

constexpr double long_edge = 0.1;          // of the diagonal
constexpr Eigen::Index fewest_faces = 64;  // of which a share says something
constexpr double again_and_again = 8;      // four bodies one after the other

/// See `long_faces_on_a_line`, of each part.
std::vector<double> long_faces_on_lines(const Surface& surface,
                                        const std::vector<int>& part_of_face, std::size_t parts) {
  const auto corner = [&](Eigen::Index f, int k) -> Eigen::Vector3d {
    return surface.positions.row(surface.triangles(f, k));
  };
  std::vector<Eigen::AlignedBox3d> boxes(parts);
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) boxes[idx(part_of_face[idx(f)])].extend(corner(f, k));
  }
  std::vector<double> met(parts, 0);
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const std::size_t part = idx(part_of_face[idx(f)]);
    const Eigen::Vector3d sizes = boxes[part].sizes();
    const Eigen::Vector3d one = corner(f, 1) - corner(f, 0);
    const Eigen::Vector3d other = corner(f, 2) - corner(f, 0);
    const double longest =
        std::max({one.squaredNorm(), other.squaredNorm(), (other - one).squaredNorm()});
    if (longest < long_edge * long_edge * sizes.squaredNorm()) continue;
    const double of_box = 2 * (sizes[0] * (sizes[1] + sizes[2]) + sizes[1] * sizes[2]);
    if (of_box > 0) met[part] += one.cross(other).norm() / of_box;
  }
  return met;
}

/// True if nearly all edges of this length or more pass through other faces.
bool crosses_nearly_everywhere(const Surface& surface, double least_edge) {
  constexpr double nearly_all = 0.75;
  return surface.triangles.rows() >= fewest_faces &&
         crossing_share(surface, least_edge) > nearly_all;
}

/// Precondition: lines meet the surface's long faces again and again.
bool its_long_faces_cross(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (const int v : surface.triangles.reshaped()) {
    box.extend(Eigen::Vector3d(surface.positions.row(v)));
  }
  return crosses_nearly_everywhere(surface, long_edge * box.diagonal().norm());
}

/// The faces and the vertices that they use, in their order.
Surface part_alone(const Surface& surface, const std::vector<Eigen::Index>& faces) {
  Surface part{{}, surface.triangles(faces, Eigen::all)};
  std::vector<int> vertices(part.triangles.data(), part.triangles.data() + part.triangles.size());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  part.positions = surface.positions(vertices, Eigen::all);
  for (int& v : part.triangles.reshaped()) {
    const auto found = std::lower_bound(vertices.begin(), vertices.end(), v);
    v = static_cast<int>(found - vertices.begin());
  }
  return part;
}

}  // namespace

double long_faces_on_a_line(const Surface& surface) {
  const std::vector<int> one_part(idx(surface.triangles.rows()), 0);
  return long_faces_on_lines(surface, one_part, 1).front();
}

double crossing_share(const Surface& surface, double least_edge) {
  constexpr std::size_t most_edges = 1000;
  constexpr double ends = 1e-3;  // of the edge, left out at either end
  const Triangles& corners = surface.triangles;
  const auto end_of = [&](std::int64_t half_edge, int k) {
    return corners(half_edge / 3, (half_edge + k) % 3);
  };
  const auto way_of = [&](std::int64_t half_edge) -> Eigen::Vector3d {
    return surface.positions.row(end_of(half_edge, 1)) -
           surface.positions.row(end_of(half_edge, 0));
  };
  std::vector<std::int64_t> half_edges;
  for (std::int64_t h = 0; h < 3 * corners.rows(); ++h) {
    const double length = way_of(h).norm();
    if (length > 0 && length >= least_edge) half_edges.push_back(h);
  }
  if (half_edges.empty()) return 0;
  const SurfaceTree tree(surface);
  std::size_t step = std::max<std::size_t>(1, half_edges.size() / most_edges);
  if (step % 3 == 0) ++step;  // first, second and third edges in turn
  int asked = 0;
  int crossing = 0;
  for (std::size_t i = 0; i < half_edges.size(); i += step) {
    const std::int64_t h = half_edges[i];
    const Eigen::Vector3d way = way_of(h);
    const double length = way.norm();
    const Eigen::Vector3d begin = surface.positions.row(end_of(h, 0)).transpose() + ends * way;
    ++asked;
    const auto hit = tree.ray(begin, way / length, (1 - 2 * ends) * length);
    if (hit.triangle < 0) continue;
    const auto met = corners.row(hit.triangle);
    const bool is_own = std::any_of(met.begin(), met.end(), [&](int corner) {
      return corner == end_of(h, 0) || corner == end_of(h, 1);
    });
    crossing += is_own ? 0 : 1;
  }
  return static_cast<double>(crossing) / asked;
}

bool is_tangle(const Surface& surface, bool was_cut_much) {
  if (was_cut_much && crosses_nearly_everywhere(surface, 0)) return true;
  return long_faces_on_a_line(surface) > again_and_again && its_long_faces_cross(surface);
}

bool is_mostly_tangle(const Surface& surface) {
  const LooseParts loose = loose_parts(surface);
  const std::size_t parts = loose.areas.size();
  const auto met = long_faces_on_lines(surface, loose.part_of_face, parts);
  std::vector<std::vector<Eigen::Index>> faces(parts);  // of those that may be tangled
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const std::size_t part = idx(loose.part_of_face[idx(f)]);
    if (met[part] > again_and_again) faces[part].push_back(f);
  }
  double balance = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    const bool tangled =
        !faces[part].empty() && its_long_faces_cross(part_alone(surface, faces[part]));
    balance += tangled ? loose.areas[part] : -loose.areas[part];
  }
  return balance > 0;
}

}  // namespace curveskel
