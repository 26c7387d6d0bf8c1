// Parts that are copies of one another, as a tree's leaves: one of each kind is extracted.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "skeleton/pipeline/component.hpp"

namespace curveskel {

/// Of each of `asked`, numbers of parts, the first among them that it is a copy of, itself where it
/// is the first of its kind: turned, moved and scaled by no more than a quarter, with the same
/// faces in the same order, and within a ten-thousandth of the whole's extent, a hundredth of its
/// own, in each vertex: as near as the last digits of a file leave them. Near-linear: of what is
/// much alike, a few are compared.
[[nodiscard]] std::vector<std::size_t> firsts_of_kind(const std::vector<Part>& parts,
                                                      const std::vector<std::size_t>& asked);

/// The first one's result as that of its copy, moved as a whole or, where it would leave the copy
/// so, as its nodes lie among the vertices; with radii of its own. None where it would leave the
/// copy all the same. Without times and tries.
[[nodiscard]] std::optional<ComponentResult> result_of_copy(const Part& first,
                                                            const ComponentResult& result,
                                                            const Part& copy);

}  // namespace curveskel
