// The components of a surface that fail their certificate.
#pragma once

#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

/// The component of the surface that each node belongs to, from the skeleton's vertex map; -1 for
/// nodes of a piece that no vertex maps to. Precondition: the map is of this surface.
[[nodiscard]] std::vector<int> component_by_map(const CurveSkeleton& skeleton,
                                                const Topology& counted);

/// The same without a map: the component that holds most of the piece's nodes, the smaller of two
/// (what lies within another is inside both); -1 if none holds any. `parts` as of
/// `split_components`.
[[nodiscard]] std::vector<int> component_by_place(const CurveSkeleton& skeleton,
                                                  const std::vector<Component>& parts);

/// The part of a skeleton that belongs to each component of its surface, without radii and map.
[[nodiscard]] std::vector<CurveSkeleton> divided(const CurveSkeleton& skeleton,
                                                 const std::vector<int>& component_of_node,
                                                 int components);

/// The verdict on a component alone; `diagonal` is D, that of the whole surface.
[[nodiscard]] Certificate verdict_alone(const Surface& component, int genus, double diagonal,
                                        const CurveSkeleton& skeleton,
                                        const CertificateOptions& options, const Monitor& monitor);

/// Share of the area, by 256 samples, beyond whose faces, not behind them, the surface winds round
/// something: of limbs whose faces had to be turned to agree with those of the body. `tree` is the
/// surface's. O(#F + log #F for each sample). Precondition: closed.
[[nodiscard]] double turned_share(const Surface& surface, const SurfaceTree& tree);

/// True if more than a twentieth of the area is inside out, as limbs are that had to be turned to
/// agree with their body: inscribed balls have no room there, so that the curve has no such limb.
[[nodiscard]] bool has_turned_limbs(const Surface& component);

/// A component whose own certificate does not hold, or that has turned limbs.
struct FailingComponent {
  int number = 0;  ///< in `topology`
  Surface surface;
  int genus = 0;
  CurveSkeleton skeleton;  ///< the part that belongs to the component
};

/// In the order of their numbers. D is the whole surface's for all. Turned limbs are looked for
/// where `may_be_turned`.
[[nodiscard]] std::vector<FailingComponent> failing_components(
    const Surface& surface, const Topology& counted, const CurveSkeleton& skeleton,
    const std::vector<int>& component_of_node, const CertificateOptions& options,
    bool may_be_turned, const Monitor& monitor);

/// The same for what was extracted from the surface.
[[nodiscard]] std::vector<FailingComponent> failing_of(const Surface& surface,
                                                       const Extraction& extraction,
                                                       const CertificateOptions& options,
                                                       bool may_be_turned, const Monitor& monitor);

}  // namespace curveskel
