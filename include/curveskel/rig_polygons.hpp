// From a file's polygons to the rig of all that is in the file.
#pragma once

#include <Eigen/Core>
#include <optional>

#include <curveskel/advanced/extraction_cache.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/rig_character.hpp>

namespace curveskel {

/// Work that somebody has done already. Of an empty one everything is made.
struct RigSources {
  std::optional<CurveSkeleton> skeleton;  ///< by the vertices of the file, or without a vertex map
  std::optional<Rig> joints;              ///< these stay; they get weights, and there is no plan
};

/// Sheets of a tenth of D and more have joints of their own: wings, ears, tails of one layer.
[[nodiscard]] RepairOptions repair_for_rigs();

/// A certificate's `curve_like` by its `tube_share`, judged without the area of sheets that got a
/// second side, hardly any of which is a tube's. `body` is the surface that was certified.
[[nodiscard]] bool made_of_tubes_but_for_sheets(double tube_share, const RepairedSurface& body);

/// For `Rig::to_y_up`. Of formats that state their axes, and FBX and COLLADA their unit, it is
/// `stated` (`PolygonSoup::to_gltf`). Of others a turn, and none where neither the plan nor `asked`
/// tells which way is up; of z up, as Blender and scanners have it, z ahead is -y there. None of a
/// body that lies, so is upright in no file's axes, unless `asked` says that it stands.
[[nodiscard]] Eigen::Matrix3d axes_to_gltf(SurfaceFormat format, const Eigen::Matrix3d& stated,
                                           const BodyPlan& plan,
                                           Direction asked = Direction::automatic);

struct RigPolygonsOptions {
  RepairOptions repair = repair_for_rigs();
  ExtractOptions extract;
  CharacterOptions character;
  int threads =
      0;  ///< of every stage, at most; 0 = one per core. The result does not depend on it.
};

struct PolygonsRig {
  CharacterRig character;  ///< the rig is by the vertices of the file
  /// Of the skeleton, where it was extracted. `curve_like` is judged by
  /// `made_of_tubes_but_for_sheets`.
  std::optional<Certificate> certificate;
  double given_inside = 1;  ///< share of the length of a skeleton that was given
  /// Of the repaired surface, by whose vertices `character.parts` are; see RepairedSurface.
  Eigen::VectorXi vertex_of_input;
};

/// `repair`, `find_parts`, `extract_repaired` of the body alone, `rig_body` or
/// `weights_on_joints`. Of a skeleton that is given the curves of parts that follow are left out;
/// where it has no vertex map, and where joints are given or a root is chosen, every part is body,
/// as these may be for any part. Joints have their names by `character.names`. Errors as of these,
/// and Error(Fault::input) where a skeleton's vertex map is of another number of vertices.
[[nodiscard]] PolygonsRig rig_polygons(const PolygonSoup& soup, const RigSources& sources = {},
                                       const RigPolygonsOptions& options = {},
                                       const Monitor& monitor = {});

/// The same, with the stages of the body's extraction taken from `cache`.
[[nodiscard]] PolygonsRig rig_polygons(const PolygonSoup& soup, const RigSources& sources,
                                       const RigPolygonsOptions& options, const Monitor& monitor,
                                       ExtractionCache& cache);

}  // namespace curveskel
