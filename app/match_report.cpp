#include "app/match_report.hpp"

#include <nlohmann/json.hpp>

#include <curveskel/advanced/indices.hpp>
#include "app/report.hpp"

namespace curveskel {

UnmatchedBranches unmatched_branches(const CurveSkeleton& a, const CurveSkeleton& b,
                                     const SkeletonMatch& match) {
  std::vector<bool> in_a(branches(a).size(), false);
  std::vector<bool> in_b(branches(b).size(), false);
  for (const BranchPair& pair : match.branches) {
    in_a[idx(pair.a)] = true;
    in_b[idx(pair.b)] = true;
  }
  const auto missing = [](const std::vector<bool>& there) {
    std::vector<int> numbers;
    for (std::size_t k = 0; k < there.size(); ++k) {
      if (!there[k]) numbers.push_back(static_cast<int>(k));
    }
    return numbers;
  };
  return {missing(in_a), missing(in_b)};
}

std::string match_json(const MatchRecord& record) {
  using Json = nlohmann::ordered_json;
  const std::vector<Branch> of_a = branches(record.skeleton_a);
  const std::vector<Branch> of_b = branches(record.skeleton_b);
  const auto ends = [](const Branch& branch) {
    return Json::array({branch.nodes.front(), branch.nodes.back()});
  };
  Json pairs = Json::array();
  for (const BranchPair& pair : record.found.match.branches) {
    pairs.push_back({{"a", pair.a},
                     {"b", pair.b},
                     {"ends_a", ends(of_a[idx(pair.a)])},
                     {"ends_b", ends(of_b[idx(pair.b)])},
                     {"reversed", pair.reversed},
                     {"ambiguous", pair.ambiguous}});
  }
  Json junctions = Json::array();
  for (const auto& [a, b] : record.found.match.junctions) junctions.push_back({{"a", a}, {"b", b}});
  const UnmatchedBranches alone =
      unmatched_branches(record.skeleton_a, record.skeleton_b, record.found.match);
  const Json json = {{"program", program_and_version()},
                     {"a", record.file_a},
                     {"b", record.file_b},
                     {"by", record.found.by_vertices ? "vertices" : "shape"},
                     {"branches", pairs},
                     {"branches_without_partner", {{"a", alone.of_a}, {"b", alone.of_b}}},
                     {"junctions", junctions},
                     {"vertices", std::vector<int>(record.found.vertex_of_a.data(),
                                                   record.found.vertex_of_a.data() +
                                                       record.found.vertex_of_a.size())}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace curveskel
