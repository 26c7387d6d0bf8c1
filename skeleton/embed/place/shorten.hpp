// Straight lines in place of detours.
#pragma once

#include <cstddef>
#include <vector>

#include "skeleton/embed/skeleton_graph.hpp"

namespace curveskel {

/// The line's ends, and of the points between those that are needed: from each on to the farthest
/// of 1, 2, 4, ... points ahead up to which may_skip(first, last) says that a straight line may
/// take the way's place. Precondition: the line has points. O(points) questions.
template <typename PointOfLine, typename MaySkip>
[[nodiscard]] std::vector<PointOfLine> shortened(const std::vector<PointOfLine>& line,
                                                 const MaySkip& may_skip) {
  std::vector<PointOfLine> kept{line.front()};
  for (std::size_t here = 0; here + 1 < line.size();) {
    std::size_t next = here + 1;
    for (std::size_t step = 2; here + step < line.size(); step *= 2) {
      if (!may_skip(here, here + step)) break;
      next = here + step;
    }
    kept.push_back(line[next]);
    here = next;
  }
  return kept;
}

}  // namespace curveskel
