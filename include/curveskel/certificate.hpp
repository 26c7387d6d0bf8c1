// Numbers that say how good a skeleton is, whoever made it.
#pragma once

#include <string>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct CertificateOptions {
  double sample_spacing = 1.0 / 400;  ///< along the edges, in units of D
  double inside_needed = 0.999;       ///< share of the length
  int rays = 32;                      ///< in the plane normal to the curve, for centredness
  int threads = 0;                    ///< 0 = one per core

  [[nodiscard]] bool operator==(const CertificateOptions&) const = default;
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const CertificateOptions& options);

/// Under this share of its area near the faces given, a wrap is another shape.
inline constexpr double wrap_followed_needed = 0.75;
/// Under this share of its area near the curve, a surface is not made of tubes.
inline constexpr double tube_share_needed = 0.5;
/// Farther than this share of D from the curve, the surface ahead of a tip is a limb that the curve
/// has left half-way.
inline constexpr double reach_at_tips_allowed = 0.1;

/// D = the surface's bounding-box diagonal. docs/method.md has the definitions.
struct Certificate {
  int components = 0;
  int components_of_surface = 0;
  int components_without_curve = 0;  ///< of the surface, that have none of the skeleton's to
                                     ///< themselves inside, though there are as many; else 0
  int cycle_rank = 0;
  int genus = 0;                  ///< summed over the surface's components
  int homology_rank = 0;          ///< cycles that are independent inside the surface: equal to the
                                  ///< genus where each handle has its own
  double length = 0;              ///< of all edges / D
  double inside_fraction = 0;     ///< share of the samples inside the surface
  double deepest_exit = 0;        ///< largest distance of an outside sample to the surface / D
  double centredness_median = 0;  ///< coefficient of variation of the ray lengths; 0 = centred,
                                  ///< infinity = outside
  double centredness_p90 = 0;     ///< 90th percentile of the same
  double coverage = 0;            ///< share of surface vertices within 1.5 local radii of the curve
  double tube_share = 0;          ///< share of the surface's area within 2.5 inscribed radii (those
                                  ///< at the curve's nearest point) of the curve
  double reach = 0;               ///< 95th percentile of the distance from surface vertices to the
                                  ///< nearest inscribed ball of the curve / D
  double reach_at_tips = 0;  ///< the largest such distance from the points of the surface straight
                             ///< ahead of the curve's tips / D
  int tips = 0;
  int junctions = 0;
  int spurs = 0;  ///< leaf branches shorter than the inscribed radius at their junction
  double total_curvature = 0;  ///< the sum of the turns at scale D/100, radians per D of length
  [[nodiscard]] bool components_right() const {
    return components == components_of_surface && components_without_curve == 0;
  }
  [[nodiscard]] bool topology_correct() const {
    return components_right() && cycle_rank == genus && homology_rank == genus;
  }
  bool inside_enough = false;  ///< inside_fraction >= inside_needed
  bool curve_like = false;  ///< tube_share >= tube_share_needed: the surface is made of tubes, so
                            ///< that a curve can stand for it
  /// Of a surface with wraps (see `repair`): the share of its area that lies near the faces given.
  /// Known to `extract_repaired` and `evaluate_repaired` alone.
  double wrap_followed = 1;
  [[nodiscard]] bool wrap_follows() const { return wrap_followed >= wrap_followed_needed; }
  /// The skeleton is right, of whatever shape.
  [[nodiscard]] bool correct() const { return topology_correct() && inside_enough; }
  /// No tip stops far from the end of its limb.
  [[nodiscard]] bool reaches_ends() const { return reach_at_tips <= reach_at_tips_allowed; }
  /// It is right, runs through to the ends of the limbs in which it lies, the shape has a curve
  /// skeleton in the first place, and is that of the file.
  [[nodiscard]] bool holds() const {
    return correct() && reaches_ends() && curve_like && wrap_follows();
  }
};

/// Precondition: a clean surface (see Surface). The skeleton may be anyone's: radii and vertex map
/// are not used, and how finely it is divided into edges hardly matters. Coverage and reach are
/// taken over every k-th vertex such that at most 20,000 remain. Deterministic; O(#F log #F) for
/// the tree and a few microseconds per sample and ray.
/// Throws Error(Fault::input) if a node's position is no finite number.
[[nodiscard]] Certificate evaluate(const Surface& surface, const CurveSkeleton& skeleton,
                                   const CertificateOptions& options = {},
                                   const Monitor& monitor = {});

/// The conditions of `correct` that fail, in one line; empty if none.
[[nodiscard]] std::string failures(const Certificate& certificate,
                                   const CertificateOptions& options);

/// That a tip stops far from the end of its limb, in one line; empty if none does.
[[nodiscard]] std::string tip_failure(const Certificate& certificate);

/// That the surface is not `curve_like`, in one line; empty if it is.
[[nodiscard]] std::string shape_failure(const Certificate& certificate);

/// That the wrap does not follow what it stands for, in one line; empty if it does.
[[nodiscard]] std::string wrap_failure(const Certificate& certificate);

/// The surface that a certificate compares a skeleton with.
struct CertifiedSurface {
  const Surface& surface;
  const SurfaceTree& tree;
  double diagonal;  ///< D
  int components;
  int genus;  ///< sum over the components
};

/// The same for a surface of which all this is known; that it is closed is not asked again. Throws
/// Error(Fault::input) where it has no faces, corners that are no vertices or places that are not
/// finite, and for a diagonal that is not above 0.
[[nodiscard]] Certificate evaluate(const CertifiedSurface& surface, const CurveSkeleton& skeleton,
                                   const CertificateOptions& options, const Monitor& monitor);

/// One-sided distances in both directions, sampled every `spacing` (model units); the larger one.
/// Throws Error(Fault::usage) unless the spacing is above 0, and Error(Fault::input) for nodes that
/// are not at finite places; so does `mean_distance`.
[[nodiscard]] double hausdorff_distance(const CurveSkeleton& a, const CurveSkeleton& b,
                                        double spacing);

/// The mean over the length of one of the distance to the other, averaged over both directions:
/// one branch more or less counts by its length. Infinite if one of them is
/// empty.
[[nodiscard]] double mean_distance(const CurveSkeleton& a, const CurveSkeleton& b, double spacing);

/// Two skeletons of one surface where both run: the one that also goes where no curve can be
/// centred, into a sheet, is not behind for that.
struct CommonGround {
  struct Side {
    double share = 0;               ///< of its length that lies on common ground
    double centredness_median = 0;  ///< there; infinite if there is no such place
  };
  Side a;
  Side b;
};

/// A sample is on common ground if the other's curve passes it within its inscribed radius, or D /
/// 100 where that is more. Precondition and errors as of `evaluate`; `diagonal` is D.
[[nodiscard]] CommonGround common_ground(const SurfaceTree& tree, double diagonal,
                                         const CurveSkeleton& a, const CurveSkeleton& b,
                                         const CertificateOptions& options, const Monitor& monitor);

}  // namespace curveskel
