#include "app/rig_sources.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/role_names.hpp>

namespace curveskel {
namespace {

/// Of the points, times a factor, those within the surface's box.
Eigen::Index points_within(const Positions& points, const Positions& positions, double factor) {
  const Eigen::Array3d low = positions.colwise().minCoeff().transpose();
  const Eigen::Array3d high = positions.colwise().maxCoeff().transpose();
  Eigen::Index within = 0;
  for (const auto& point : points.rowwise()) {
    const Eigen::Array3d place = factor * point.transpose();
    within += (place >= low).all() && (place <= high).all() ? 1 : 0;
  }
  return within;
}

/// The file's own, else those that the joints' names say.
Rig with_roles(Rig rig) {
  const auto is_none = [](const std::string& role) { return role.empty(); };
  if (std::all_of(rig.roles.begin(), rig.roles.end(), is_none)) rig.roles = roles_by_name(rig);
  return rig;
}

}  // namespace

void require_skeleton_of(const PolygonSoup& soup, const CurveSkeleton& skeleton,
                         const std::string& name) {
  const PointPlaces places = places_of(skeleton.nodes, "nodes", soup.positions, name);
  if (!places.most_within) throw Error(Fault::input, places.finding);
  const Eigen::Index map = skeleton.node_of_vertex.size();
  if (map == 0 || map == soup.positions.rows()) return;
  throw Error(Fault::input,
              fmt::format("{}: the skeleton has a node for each of {} vertices, needed one for "
                          "each of the surface's {}; extract it again, from this surface",
                          name, map, soup.positions.rows()));
}

Rig rig_in(const std::filesystem::path& mesh, SurfaceFormat format, const Monitor& monitor) {
  if (keeps_joints_alone(format)) return with_roles(read_joints(mesh, monitor));
  std::optional<Rig> rig = read_rig(mesh, monitor);
  if (rig) return with_roles(std::move(*rig));
  throw Error(Fault::input, mesh.string() +
                                ": found no rig, needed one for --keep-rig, in a glTF, FBX or "
                                "COLLADA file; leave out --keep-rig to have joints made");
}

bool keeps_joints_alone(SurfaceFormat format) {
  return format == SurfaceFormat::fbx || format == SurfaceFormat::dae;
}

PointPlaces places_of(const Positions& points, std::string_view kind, const Positions& positions,
                      const std::filesystem::path& file) {
  const Eigen::Index count = points.rows();
  const Eigen::Index within = points_within(points, positions, 1);
  const double sizes = bounding_box_diagonal(points) / bounding_box_diagonal(positions);
  const auto fits_times = [&](double factor) {
    constexpr double alike = 3;  // a skeleton is about as large as its body
    const bool is_as_large = factor * sizes < alike && factor * sizes > 1 / alike;
    return is_as_large && 2 * points_within(points, positions, factor) >= count;
  };
  if (2 * within >= count) {
    for (const double factor : {100.0, 1000.0}) {
      if (!fits_times(factor)) continue;
      return {true, true,
              fmt::format("{}: the {} lie within {:.2g} of the size of the surface; times {} they "
                          "would be as large as it: export both in one unit",
                          file.string(), kind, sizes, factor)};
    }
    return {};
  }
  std::string remedy = fmt::format(
      "needed are {} in its coordinates (glTF has y up, Blender z: export both the same way)",
      kind);
  for (const double factor : {0.001, 0.01, 0.1, 10.0, 100.0, 1000.0}) {
    if (!fits_times(factor)) continue;
    remedy = fmt::format("times {} they would: export both in one unit", factor);
  }
  return {within > 0, false,
          fmt::format("{}: {} of {} {} lie within the box of the surface; {}", file.string(),
                      within == 0 ? "none" : std::to_string(within), count, kind, remedy)};
}

GivenJoints joints_for(const std::filesystem::path& file, const PolygonSoup& soup,
                       const Monitor& monitor) {
  Rig rig = with_roles(read_joints(file, monitor));
  PointPlaces places = places_of(rig.joints, "joints", soup.positions, file);
  if (!places.any_within) throw Error(Fault::input, places.finding);
  return {std::move(rig), std::move(places.finding)};
}

}  // namespace curveskel
