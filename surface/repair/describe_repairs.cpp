#include "surface/repair/describe_repairs.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace curveskel {
namespace {

std::string share_words(double share) {
  std::ostringstream words;
  words.precision(2);
  words << share;
  return words.str();
}

std::string wrap_words(const Repairs& repairs) {
  return "the wrap spans gaps up to " + share_words(repairs.wrap_gap) + " D and lies " +
         share_words(repairs.wrap_mean_distance) + " D from them in the mean, " +
         share_words(repairs.wrap_distance) + " D at most";
}

void line(Repairs& repairs, const Monitor& monitor, std::int64_t count, const std::string& one,
          const std::string& many, const std::string& what) {
  if (count == 0) return;
  repairs.lines.push_back(std::to_string(count) + " " + (count == 1 ? one : many) + " " + what);
  monitor.say(repairs.lines.back());
}

/// "0, 2, 5", of many the first few.
std::string list_of(const std::vector<int>& components) {
  constexpr std::size_t shown = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, components.size()); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(components[i]);
  }
  if (components.size() <= shown) return text;
  return text + " and " + std::to_string(components.size() - shown) + " more";
}

/// Bodies that were merged, by the numbers of the components without merging.
void describe_merging(Repairs& repairs, const Monitor& monitor) {
  const Merging& merging = repairs.merging;
  for (const auto& body : merging.bodies) {
    line(repairs, monitor, static_cast<std::int64_t>(body.size()), "component", "components",
         "that overlap became one body: " + list_of(body));
  }
  std::vector<int> covered;
  for (const auto& one : merging.covered) covered.push_back(one.component);
  line(repairs, monitor, static_cast<std::int64_t>(covered.size()), "component", "components",
       "left out, inside another: " + list_of(covered));
  line(repairs, monitor, merging.cavities_filled, "cavity", "cavities",
       "filled between components that became one body");
  line(repairs, monitor, merging.handles_made, "handle", "handles",
       "made by openings between components that became one body; the curve goes round each");
  std::map<std::string, std::vector<int>> apart;
  for (const auto& one : merging.apart) {
    auto& its = apart[one.why];
    its.push_back(one.component);
    its.push_back(one.other);
  }
  for (auto& [why, its] : apart) {
    std::sort(its.begin(), its.end());
    its.erase(std::unique(its.begin(), its.end()), its.end());
    line(repairs, monitor, static_cast<std::int64_t>(its.size()), "component", "components",
         "that overlap stayed apart, as " + why + ": " + list_of(its));
  }
}

}  // namespace

void describe_repairs(Repairs& repairs, const Monitor& monitor) {
  const auto said = [&](std::int64_t count, const std::string& one, const std::string& many,
                        const std::string& what) {
    line(repairs, monitor, count, one, many, what);
  };
  said(repairs.vertices_joined, "vertex", "vertices", "joined with one that nearly coincides");
  said(repairs.edges_split, "edge of a hole", "edges of holes",
       "split at vertices of another that lie on it");
  said(repairs.vertices_copied, "copy of a vertex", "copies of vertices",
       "made where faces met in no orientable 2-manifold");
  said(repairs.holes_closed, "hole", "holes",
       "closed with " + std::to_string(repairs.faces_added) +
           (repairs.faces_added == 1 ? " face" : " faces") + " and " +
           std::to_string(repairs.vertices_added) +
           (repairs.vertices_added == 1 ? " vertex" : " vertices") + " (the longest has " +
           std::to_string(repairs.longest_hole) + " edges)");
  said(repairs.holes_narrowed, "hole", "holes",
       "narrowed by rings of triangles first, each with half as many edges as the one before");
  said(repairs.faces_wrapped, "face", "faces",
       std::string("wrapped, as ") +
           (repairs.wrapped_as_asked ? "asked" : "no closing of the holes gives them an inside") +
           "; " + wrap_words(repairs));
  said(repairs.copies_dropped, "component", "components", "left out as copies of another");
  said(repairs.sheets_dropped, "open or flat part", "open or flat parts",
       "left out, enclosing nothing");
  said(repairs.sheets_thickened, "open or flat part", "open or flat parts",
       "given a second side near the first one");
  said(repairs.crumbs_dropped, "crumb", "crumbs",
       "left out (small pieces cut off a much larger one; their vertices follow its nearest)");
  said(repairs.specks_dropped, "speck", "specks",
       "left out (components with very little of the largest one's area; see --min-size)");
  describe_merging(repairs, monitor);
  describe_cut_handles(repairs, false, monitor);
  said(repairs.not_chosen, "smaller component", "smaller components", "left out as asked");
}

void describe_wrapped_components(Repairs& repairs, std::int64_t faces, const Monitor& monitor) {
  line(repairs, monitor, repairs.components_wrapped, "component", "components",
       "wrapped (" + std::to_string(faces) +
           " faces), as the skeleton's certificate failed there; " + wrap_words(repairs));
}

void describe_cut_handles(Repairs& repairs, bool certificate_failed, const Monitor& monitor) {
  line(repairs, monitor, repairs.handles_cut, "small handle", "small handles",
       "cut, along loops up to " + share_words(repairs.longest_handle_loop) + " D long, as " +
           (certificate_failed ? "the skeleton's certificate failed there" : "asked"));
}

}  // namespace curveskel
