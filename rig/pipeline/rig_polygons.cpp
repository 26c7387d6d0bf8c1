#include <curveskel/rig_polygons.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/extract_repaired.hpp>
#include <curveskel/levels.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/topology.hpp>
#include "rig/pipeline/figures.hpp"
#include "rig/plan/frames.hpp"
#include "skeleton/certify/verdict.hpp"
#include "surface/repair/sound_repaired.hpp"

namespace curveskel {
namespace {

/// The level at which all is there that the surgery and growth make, see
/// `least_life`.
constexpr double usual_detail = EmbedOptions().detail;

/// Of the area. One vertex of each sheet is known.
double share_of_sheets(const RepairedSurface& body) {
  if (body.sheets.empty()) return 0;
  const Topology counted = topology(body.surface);
  std::vector<char> is_sheet(idx(counted.components()), 0);
  for (const std::int32_t v : body.sheets) is_sheet[idx(counted.component_of_vertex[v])] = 1;
  std::vector<Eigen::Index> faces;
  for (Eigen::Index f = 0; f < body.surface.triangles.rows(); ++f) {
    const std::int32_t v = body.surface.triangles(f, 0);
    if (is_sheet[idx(counted.component_of_vertex[v])] != 0) faces.push_back(f);
  }
  const Surface sheets{body.surface.positions, body.surface.triangles(faces, Eigen::all)};
  return area(sheets) / area(body.surface);
}

/// Given or extracted.
struct Curve {
  CurveSkeleton skeleton;
  std::optional<Certificate> certificate;
  std::optional<CurveSkeleton> usual;  ///< the default level, where that is coarser
};

/// `body` becomes its wrap where only a wrap would do. Everything is named first; then what a
/// coarser level does without goes.
Curve curve_for(const RigSources& sources, const RigPolygonsOptions& options, RepairedSurface& body,
                const Monitor& monitor, ExtractionCache& cache) {
  Curve curve;
  if (sources.skeleton) {  // beside joints that are given
    curve.skeleton = skeleton_of_repaired(*sources.skeleton, body.vertex_of_input,
                                          body.surface.positions.rows());
    return curve;
  }
  ExtractOptions wanted = options.extract;
  wanted.threads = options.threads;
  wanted.embed.detail = usual_detail;
  RepairedExtraction found = extract_repaired(body, options.repair, wanted, monitor, cache);
  if (options.extract.embed.detail > usual_detail) {
    curve.usual = std::move(found.extraction.skeleton);
    wanted.embed.detail = options.extract.embed.detail;
    found = extract_repaired(body, options.repair, wanted, monitor, cache);
  }
  if (found.repaired_again) body = std::move(*found.repaired_again);
  curve.certificate = found.extraction.certificate;
  curve.certificate->curve_like = made_of_tubes_but_for_sheets(curve.certificate->tube_share, body);
  curve.skeleton = std::move(found.extraction.skeleton);
  return curve;
}

double share_inside(const Surface& surface, const CurveSkeleton& skeleton,
                    const RigPolygonsOptions& options, const Monitor& monitor) {
  const Topology counted = topology(surface);
  const SurfaceTree tree(surface, options.threads);
  const CertifiedSurface certified{surface, tree, bounding_box_diagonal(surface.positions),
                                   counted.components(), counted.total_genus()};
  return verdict(certified, skeleton, options.extract.certificate, monitor).inside_fraction;
}

/// The plan of a single figure that has one, to be asked for at a finer level:
/// a rabbit's tail makes no bird of it.
BodyKind kind_of(const RepairedSurface& body, const CurveSkeleton& skeleton,
                 const FigureOptions& options, const Monitor& monitor) {
  const CurveSkeleton dense = dense_skeleton(body.surface, skeleton, monitor);
  const std::vector<Figure> figures = find_figures(body, dense, options, monitor.stop);
  const BodyKind kind = figures.front().plan.plan;
  return figures.size() > 1 || kind == BodyKind::other ? options.plan.plan : kind;
}

}  // namespace

RepairOptions repair_for_rigs() {
  RepairOptions options;
  options.least_sheet = 0.1;
  return options;
}

Eigen::Matrix3d axes_to_gltf(SurfaceFormat format, const Eigen::Matrix3d& stated,
                             const BodyPlan& plan, Direction asked) {
  if (!stated_up(format, stated).isZero()) return stated;
  const bool is_known = !plan.joints.empty() || asked != Direction::automatic;
  Eigen::Matrix3d axes = plan.axes;
  if (plan.joints.empty() && asked != Direction::automatic) {
    PlanOptions standing;
    standing.up = asked;
    axes = frames_of(standing).front();
  }
  const Eigen::RowVector3d up = axes.row(1);
  if (!is_known || up == Eigen::RowVector3d::UnitY()) return Eigen::Matrix3d::Identity();
  if (up != Eigen::RowVector3d::UnitZ()) {
    const bool lies = asked == Direction::automatic;
    return lies ? Eigen::Matrix3d::Identity() : axes;
  }
  return (Eigen::Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
}

bool made_of_tubes_but_for_sheets(double tube_share, const RepairedSurface& body) {
  require_sound(body, "made_of_tubes_but_for_sheets");
  return tube_share >= tube_share_needed * (1 - share_of_sheets(body));
}

PolygonsRig rig_polygons(const PolygonSoup& soup, const RigSources& sources,
                         const RigPolygonsOptions& options, const Monitor& monitor) {
  ExtractionCache cache;
  return rig_polygons(soup, sources, options, monitor, cache);
}

PolygonsRig rig_polygons(const PolygonSoup& soup, const RigSources& sources,
                         const RigPolygonsOptions& options, const Monitor& monitor,
                         ExtractionCache& cache) {
  CharacterOptions wanted = options.character;
  wanted.rig.skin.threads = wanted.parts.threads = options.threads;
  wanted.rig.faces_minus_z = wanted.plan.faces_minus_z = soup.faces_minus_z;
  wanted.plan.z_is_up = soup.z_is_up;
  if (sources.joints || wanted.rig.joints.root >= 0) wanted.parts.follow = 0;

  require_valid(wanted.plan);
  const RepairedSurface repaired = repair(soup, options.repair, monitor, options.threads);
  const Surface given{soup.positions, triangulate(soup)};
  PolygonsRig result;
  result.vertex_of_input = repaired.vertex_of_input;
  if (sources.skeleton && !sources.joints) {
    const CurveSkeleton whole = skeleton_of_repaired(*sources.skeleton, repaired.vertex_of_input,
                                                     repaired.surface.positions.rows());
    result.character = rig_character(given, repaired, whole, wanted, monitor);
    result.given_inside = share_inside(repaired.surface, whole, options, monitor);
    result.character.rig.to_y_up =
        axes_to_gltf(soup.format, soup.to_gltf, result.character.plan, wanted.plan.up);
    return result;
  }
  RigParts parts = find_parts(repaired.surface, wanted.parts, monitor);
  RepairedSurface body = body_of(repaired, parts);
  const auto [skeleton, certificate, usual] = curve_for(sources, options, body, monitor, cache);
  result.certificate = certificate;
  if (sources.joints) {
    const CurveSkeleton dense = dense_skeleton(body.surface, skeleton, monitor);
    const Rig made =
        weights_on_joints(body.surface, dense, *sources.joints, wanted.rig.skin, monitor);
    result.character.rig =
        rig_of_given(made, body.surface, dense, body.vertex_of_input, given, wanted.rig.skin);
    result.character.follows = followers_of(body.vertex_of_input);
  } else {
    wanted.plan.made_of_tubes = !certificate || certificate->curve_like;
    if (usual && wanted.plan.plan == BodyKind::automatic) {
      wanted.plan.plan = kind_of(body, *usual, {wanted.plan, options.threads}, monitor);
    }
    CharacterRig level = level_of_character(rig_body(given, body, skeleton, wanted, monitor),
                                            skeleton, least_life(options.extract.embed.detail));
    result.character = within_budget(std::move(level), given, wanted.joint_budget);
  }
  result.character.rig.to_y_up =
      axes_to_gltf(soup.format, soup.to_gltf, result.character.plan, wanted.plan.up);
  result.character.parts = std::move(parts);
  return result;
}

}  // namespace curveskel
