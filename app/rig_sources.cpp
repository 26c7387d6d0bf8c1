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

/// A skeleton of this surface is not mostly elsewhere.
void require_nodes_nearby(const CurveSkeleton& skeleton, const PolygonSoup& soup,
                          const std::string& file) {
  const Eigen::RowVector3d low = soup.positions.colwise().minCoeff();
  const Eigen::RowVector3d high = soup.positions.colwise().maxCoeff();
  Eigen::Index within = 0;
  for (const auto& node : skeleton.nodes.rowwise()) {
    within += (node.array() >= low.array()).all() && (node.array() <= high.array()).all() ? 1 : 0;
  }
  if (2 * within >= skeleton.nodes.rows()) return;
  throw Error(Fault::input,
              fmt::format("{}: {} of {} nodes lie within the box of {}; needed is a skeleton of "
                          "this surface, in its coordinates",
                          file, within, skeleton.nodes.rows(), soup.file.filename().string()));
}

/// Of the joints, times a factor, those within the surface's box.
Eigen::Index joints_within(const Rig& rig, const Positions& positions, double factor) {
  const Eigen::Array3d low = positions.colwise().minCoeff().transpose();
  const Eigen::Array3d high = positions.colwise().maxCoeff().transpose();
  Eigen::Index within = 0;
  for (const auto& joint : rig.joints.rowwise()) {
    const Eigen::Array3d place = factor * joint.transpose();
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
  require_nodes_nearby(skeleton, soup, name);
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

JointPlaces places_of(const Rig& rig, const Positions& positions,
                      const std::filesystem::path& file) {
  const Eigen::Index count = rig.joints.rows();
  const Eigen::Index within = joints_within(rig, positions, 1);
  const double sizes = bounding_box_diagonal(rig.joints) / bounding_box_diagonal(positions);
  const auto fits_times = [&](double factor) {
    constexpr double alike = 3;  // a skeleton is about as large as its body
    const bool is_as_large = factor * sizes < alike && factor * sizes > 1 / alike;
    return is_as_large && 2 * joints_within(rig, positions, factor) >= count;
  };
  if (2 * within >= count) {
    if (!fits_times(100)) return {};
    return {true, fmt::format("{}: the joints lie within {:.2g} of the size of the surface; times "
                              "100 they would be as large as it: export both in one unit",
                              file.string(), sizes)};
  }
  std::string remedy =
      "needed are joints in its coordinates (glTF has y up, Blender z: export both the same way)";
  for (const double factor : {0.01, 100.0}) {
    if (!fits_times(factor)) continue;
    remedy = fmt::format("times {} they would: export both in one unit", factor);
  }
  return {within > 0,
          fmt::format("{}: {} of {} joints lie within the box of the surface; {}", file.string(),
                      within == 0 ? "none" : std::to_string(within), count, remedy)};
}

GivenJoints joints_for(const std::filesystem::path& file, const PolygonSoup& soup,
                       const Monitor& monitor) {
  Rig rig = with_roles(read_joints(file, monitor));
  JointPlaces places = places_of(rig, soup.positions, file);
  if (!places.any_within) throw Error(Fault::input, places.finding);
  return {std::move(rig), std::move(places.finding)};
}

}  // namespace curveskel
