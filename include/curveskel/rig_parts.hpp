// Which components of a surface are the body that gets joints, and which follow it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct PartOptions {
  /// A component follows the body if it reaches out of the body no farther than this, in the
  /// body's thickness there: teeth, eyes, buttons and straps have .2 to 1.1, phalanges and hands
  /// 1.2 to 5, arms, legs and heads more. 0 = every component is body. 0..100.
  double follow = 1.15;
  int threads = 0;  ///< at most, 0 = one per core; the result does not depend on it
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const PartOptions& options);

struct RigPart {
  double area_share = 0;  ///< of the whole surface's area
  bool follows = false;   ///< else it is body
  int host = -1;          ///< the component of the body that it follows; -1 for body
  double reach = 0;       ///< how far it reaches out of the larger parts of the body, in the
                          ///< body's thickness there; 0 for the largest component
  int twin = -1;          ///< its mirror image among the components; -1 = none
};

struct RigParts {
  std::vector<RigPart> parts;      ///< by component, in the order of `topology`
  Eigen::VectorXi part_of_vertex;  ///< #V
  [[nodiscard]] bool all_body() const;
};

/// From the largest component on, each is compared with the body found so far. Its reach is the
/// 98th percentile, over its surface, of the distance to the body, in the thickness of the body
/// there: the radius of the largest inscribed ball about the places where the two are nearest
/// (median over a tenth), or of most of the body within half of the component's diagonal, if that
/// is more. Mirror images through a plane normal to an axis decide together, by the mean.
/// Precondition: closed oriented manifold. Throws Cancelled on a stop. A query of the body for
/// each of some hundred places of each component: O(#F log #F), but with very many components that
/// lie close to many others each, these times those.
[[nodiscard]] RigParts find_parts(const Surface& surface, const PartOptions& options = {},
                                  const Monitor& monitor = {});

/// The rest if the followers are left out: `vertex_of_input` is -1 for theirs.
[[nodiscard]] RepairedSurface body_of(const RepairedSurface& repaired, const RigParts& parts);

}  // namespace curveskel
