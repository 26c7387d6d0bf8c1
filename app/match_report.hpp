// The report of a match, as JSON.
#pragma once

#include <string>
#include <vector>

#include <curveskel/match.hpp>

namespace curveskel {

struct MatchRecord {
  const std::string& file_a;
  const std::string& file_b;
  const CurveSkeleton& skeleton_a;
  const CurveSkeleton& skeleton_b;
  const InputMatch& found;
};

/// Branches of each without a partner, ascending.
struct UnmatchedBranches {
  std::vector<int> of_a;
  std::vector<int> of_b;
};
[[nodiscard]] UnmatchedBranches unmatched_branches(const CurveSkeleton& a, const CurveSkeleton& b,
                                                   const SkeletonMatch& match);

/// Pairs of branches with their nodes, of junctions and of vertices. Ends with a newline.
[[nodiscard]] std::string match_json(const MatchRecord& record);

}  // namespace curveskel
