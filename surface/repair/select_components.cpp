#include "surface/repair/select_components.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/monitor.hpp>
#include "surface/mesh/component_areas.hpp"
#include "surface/mesh/nearest_vertex.hpp"
#include "surface/repair/renumber.hpp"
#include "surface/repair/weld.hpp"
#include "surface/spatial/box_tree.hpp"

namespace curveskel {
namespace {

/// The vertices' groups of each component, ascending; vertices that lie within the distance are of
/// one group. Of components that have as many vertices and faces as another; empty of others.
std::vector<std::vector<std::int32_t>> groups_where_alike(const Surface& surface,
                                                          const Topology& counted,
                                                          double distance) {
  std::map<std::pair<std::int64_t, std::int64_t>, int> number_of;
  for (int c = 0; c < counted.components(); ++c) {
    ++number_of[{counted.vertices[idx(c)], counted.faces[idx(c)]}];
  }
  std::vector<bool> among(idx(surface.positions.rows()));
  for (std::size_t v = 0; v < among.size(); ++v) {
    const int c = counted.component_of_vertex[static_cast<Eigen::Index>(v)];
    among[v] = number_of[{counted.vertices[idx(c)], counted.faces[idx(c)]}] > 1;
  }
  const auto group = distance > 0 ? nearby_vertices(surface.positions, among, distance)
                                  : coincident_vertices(surface.positions, among);
  std::vector<std::vector<std::int32_t>> groups(idx(counted.components()));
  for (std::size_t v = 0; v < among.size(); ++v) {
    const int c = counted.component_of_vertex[static_cast<Eigen::Index>(v)];
    if (among[v]) groups[idx(c)].push_back(group[v]);
  }
  for (auto& of_component : groups) std::sort(of_component.begin(), of_component.end());
  return groups;
}

/// A copy has as many vertices and faces as an earlier component, and each vertex where that has
/// one.
void mark_copies(const Surface& surface, const Topology& counted, double distance,
                 std::vector<Fate>& fates) {
  const auto groups = groups_where_alike(surface, counted, distance);
  std::set<std::pair<std::int64_t, std::vector<std::int32_t>>> seen;
  for (int c = 0; c < counted.components(); ++c) {
    if (groups[idx(c)].empty()) continue;
    if (!seen.emplace(counted.faces[idx(c)], groups[idx(c)]).second) fates[idx(c)] = Fate::copy;
  }
}

/// Groups components that have a position in common; each has the first one's number.
std::vector<int> touching_groups(const Surface& surface, const Topology& counted) {
  UnionFind joined(counted.components());
  const auto same = coincident_vertices(surface.positions,
                                        std::vector<bool>(idx(surface.positions.rows()), true));
  for (std::size_t v = 0; v < same.size(); ++v) {
    joined.unite(counted.component_of_vertex[static_cast<Eigen::Index>(v)],
                 counted.component_of_vertex[same[v]]);
  }
  std::vector<int> group(idx(counted.components()));
  for (int c = 0; c < counted.components(); ++c) group[idx(c)] = joined.root(c);
  return group;
}

void mark_crumbs(const Surface& surface, const Topology& counted, const std::vector<double>& area,
                 double least, std::vector<Fate>& fates) {
  const auto group = touching_groups(surface, counted);
  std::vector<double> largest(group.size(), 0);
  for (std::size_t c = 0; c < group.size(); ++c) {
    if (fates[c] == Fate::kept) largest[idx(group[c])] = std::max(largest[idx(group[c])], area[c]);
  }
  for (std::size_t c = 0; c < group.size(); ++c) {
    if (fates[c] == Fate::kept && area[c] < least * largest[idx(group[c])]) fates[c] = Fate::crumb;
  }
}

using Boxes = std::vector<Eigen::AlignedBox3d>;

Boxes boxes_of(const Surface& surface, const Topology& counted) {
  Boxes boxes(idx(counted.components()));
  for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
    boxes[idx(counted.component_of_vertex[v])].extend(surface.positions.row(v).transpose());
  }
  return boxes;
}

/// The boxes of the components, to be asked for the one of the largest area.
class BoxesByArea {
 public:
  BoxesByArea(Boxes boxes, const std::vector<double>& area)
      : boxes_(std::move(boxes)), area_(area), tree_(middles_of_boxes(boxes_)) {
    for (std::size_t c = 0; c < boxes_.size(); ++c) tree_.put(c, {boxes_[c], area[c]});
  }

  /// The largest area of the other components whose boxes hold the middle of this one's, or else
  /// meet this one's; 0: none does.
  [[nodiscard]] double largest_about(std::size_t component) const {
    const Eigen::AlignedBox3d& own = boxes_[component];
    const double holds = largest_of_others(
        component, [&](const Eigen::AlignedBox3d& box) { return box.contains(own.center()); });
    if (holds > 0) return holds;
    return largest_of_others(component,
                             [&](const Eigen::AlignedBox3d& box) { return box.intersects(own); });
  }

 private:
  template <typename Fits>
  [[nodiscard]] double largest_of_others(std::size_t component, const Fits& fits) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double largest = 0;
    double most = std::nextafter(-largest, -infinity);  // of equal areas one will do
    const auto bound = [&](const BoxTree::Item& item) {
      return fits(item.box) ? -item.weight : infinity;
    };
    tree_.search(bound, most, [&](std::size_t other) {
      if (other == component || area_[other] <= largest) return;
      largest = area_[other];
      most = std::nextafter(-largest, -infinity);
    });
    return largest;
  }

  Boxes boxes_;
  const std::vector<double>& area_;
  BoxTree tree_;  // weights are areas
};

void mark_specks(const Surface& surface, const Topology& counted, const std::vector<double>& area,
                 const SelectionRules& rules, const std::stop_token& stop,
                 std::vector<Fate>& fates) {
  const double least = rules.least_area * *std::max_element(area.begin(), area.end());
  std::optional<BoxesByArea> boxes;
  for (std::size_t c = 0; c < fates.size(); ++c) {
    if (fates[c] != Fate::kept || area[c] >= least) continue;
    throw_if_stopped(stop);
    if (rules.by_place && !boxes) boxes.emplace(boxes_of(surface, counted), area);
    const double about = boxes ? boxes->largest_about(c) : 0;
    if (about == 0 || area[c] < rules.least_area * about) fates[c] = Fate::speck;
  }
}

/// Fate of each component, by the order of the rules in `leave_out_components`.
std::vector<Fate> choose_components(const Surface& surface, const Topology& counted,
                                    const SelectionRules& rules, const std::stop_token& stop) {
  std::vector<Fate> fates(idx(counted.components()), Fate::kept);
  if (counted.components() < 2) return fates;
  mark_copies(surface, counted, rules.copy_distance, fates);
  const auto area = component_areas(surface, counted);
  if (rules.least_crumb > 0) mark_crumbs(surface, counted, area, rules.least_crumb, fates);
  mark_specks(surface, counted, area, rules, stop, fates);
  std::vector<int> by_area;
  for (int c = 0; c < counted.components(); ++c) {
    if (fates[idx(c)] == Fate::kept) by_area.push_back(c);
  }
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](int a, int b) { return area[idx(a)] > area[idx(b)]; });
  for (std::size_t i = idx(rules.most); rules.most > 0 && i < by_area.size(); ++i) {
    fates[idx(by_area[i])] = Fate::not_chosen;
  }
  return fates;
}

}  // namespace

std::vector<std::int32_t> keep_components(Surface& surface, const Topology& counted,
                                          const std::vector<Fate>& fates) {
  std::vector<std::int32_t> number(idx(surface.positions.rows()), -1);
  std::int32_t vertices = 0;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(number.size()); ++v) {
    if (fates[idx(counted.component_of_vertex[v])] != Fate::kept) continue;
    surface.positions.row(vertices) = surface.positions.row(v);
    number[idx(v)] = vertices++;
  }
  Eigen::Index faces = 0;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    if (number[idx(surface.triangles(f, 0))] < 0) continue;
    for (int k = 0; k < 3; ++k) {
      surface.triangles(faces, k) = number[idx(surface.triangles(f, k))];
    }
    ++faces;
  }
  surface.positions.conservativeResize(vertices, 3);
  surface.triangles.conservativeResize(faces, 3);
  return number;
}

void leave_out_components(RepairedSurface& result, const SelectionRules& rules,
                          const std::stop_token& stop) {
  const Topology counted = topology(result.surface);
  const auto fates = choose_components(result.surface, counted, rules, stop);
  const auto count = [&](Fate fate) { return std::count(fates.begin(), fates.end(), fate); };
  result.repairs.copies_dropped += count(Fate::copy);
  result.repairs.crumbs_dropped += count(Fate::crumb);
  result.repairs.specks_dropped += count(Fate::speck);
  result.repairs.not_chosen += count(Fate::not_chosen);
  if (count(Fate::kept) == counted.components()) return;
  const Positions positions = result.surface.positions;
  auto number = keep_components(result.surface, counted, fates);
  if (count(Fate::crumb) > 0) {
    const SurfaceTree tree(result.surface);
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
      if (fates[idx(counted.component_of_vertex[v])] != Fate::crumb) continue;
      number[idx(v)] = nearest_vertex(result.surface, tree, positions.row(v));
    }
  }
  renumber(
      result, [&](std::int32_t v) { return number[idx(v)]; },
      [&](std::int32_t v) { return fates[idx(counted.component_of_vertex[v])] != Fate::kept; });
}

}  // namespace curveskel
