// A body that lacks a limb, with the mirror image of the one on the other side in its place.
#pragma once

#include <optional>

#include "rig/plan/curve_tree.hpp"

namespace curveskel {

struct Completed {
  CurveTree tree;  ///< its last nodes are the image's, see `CurveTree::own_nodes`
  TipPairs pairs;
};

/// With the image of the longest limb that has none. Nothing where each limb has one.
[[nodiscard]] std::optional<Completed> with_missing_limb(const CurveTree& tree,
                                                         const TipPairs& pairs, const Limbs& limbs);

/// Of a limb whose one side ends within the other: with the image of all beyond that place at its
/// end. Nothing where both sides end at tips, or the end itself lies beyond that place.
[[nodiscard]] std::optional<Completed> with_whole_limb(const CurveTree& tree, const TipPairs& pairs,
                                                       const LimbWay& limb);

}  // namespace curveskel
