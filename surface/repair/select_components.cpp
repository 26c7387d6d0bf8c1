#include "surface/repair/select_components.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/advanced/union_find.hpp>
#include "surface/mesh/nearest_vertex.hpp"
#include "surface/repair/weld.hpp"

namespace curveskel {
namespace {

std::vector<double> areas(const Surface& surface, const Topology& counted) {
  std::vector<double> result(idx(counted.components()), 0);
  for (const auto& t : surface.triangles.rowwise()) {
    const Eigen::RowVector3d a = surface.positions.row(t(0));
    const Eigen::RowVector3d ab = surface.positions.row(t(1)) - a;
    const Eigen::RowVector3d ac = surface.positions.row(t(2)) - a;
    result[idx(counted.component_of_vertex[t(0)])] += ab.cross(ac).norm() / 2;
  }
  return result;
}

using PositionList = std::vector<std::array<double, 3>>;

PositionList sorted_positions(const Surface& surface, const std::vector<std::int32_t>& vertices) {
  PositionList list;
  list.reserve(vertices.size());
  for (const std::int32_t v : vertices) {
    const auto p = surface.positions.row(v);
    list.push_back({p.x() + 0.0, p.y() + 0.0, p.z() + 0.0});  // -0.0 becomes 0.0
  }
  std::sort(list.begin(), list.end());
  return list;
}

/// Components with as many vertices and faces and the same bounding box are compared in full.
void mark_copies(const Surface& surface, const Topology& counted, std::vector<Fate>& fates) {
  std::vector<std::vector<std::int32_t>> vertices(idx(counted.components()));
  std::vector<std::array<double, 8>> key(idx(counted.components()));
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(surface.positions.rows()); ++v) {
    vertices[idx(counted.component_of_vertex[v])].push_back(v);
  }
  for (int c = 0; c < counted.components(); ++c) {
    const auto box = surface.positions(vertices[idx(c)], Eigen::all);
    const Eigen::RowVector3d low = box.colwise().minCoeff();
    const Eigen::RowVector3d high = box.colwise().maxCoeff();
    key[idx(c)] = {double(counted.vertices[idx(c)]),
                   double(counted.faces[idx(c)]),
                   low.x() + 0.0,
                   low.y() + 0.0,
                   low.z() + 0.0,
                   high.x() + 0.0,
                   high.y() + 0.0,
                   high.z() + 0.0};
  }
  std::map<std::array<double, 8>, std::vector<int>> alike;
  for (int c = 0; c < counted.components(); ++c) alike[key[idx(c)]].push_back(c);
  for (const auto& [same, group] : alike) {
    std::map<PositionList, int> seen;
    if (group.size() < 2) continue;
    for (const int c : group) {
      if (!seen.try_emplace(sorted_positions(surface, vertices[idx(c)]), c).second) {
        fates[idx(c)] = Fate::copy;
      }
    }
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

/// Fate of each component, by the order of the rules in `leave_out_components`.
std::vector<Fate> choose_components(const Surface& surface, const Topology& counted,
                                    const SelectionRules& rules) {
  std::vector<Fate> fates(idx(counted.components()), Fate::kept);
  if (counted.components() < 2) return fates;
  mark_copies(surface, counted, fates);
  const auto area = areas(surface, counted);
  if (rules.least_crumb > 0) mark_crumbs(surface, counted, area, rules.least_crumb, fates);
  const double least = rules.least_area * *std::max_element(area.begin(), area.end());
  std::vector<int> by_area;
  for (int c = 0; c < counted.components(); ++c) {
    if (fates[idx(c)] != Fate::kept) continue;
    if (area[idx(c)] < least) {
      fates[idx(c)] = Fate::speck;
    } else {
      by_area.push_back(c);
    }
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

void leave_out_components(RepairedSurface& result, const SelectionRules& rules) {
  const Topology counted = topology(result.surface);
  const auto fates = choose_components(result.surface, counted, rules);
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
  for (int& v : result.vertex_of_input) v = v < 0 ? -1 : number[idx(v)];
  std::erase_if(result.rims, [&](const auto& rim) {
    return fates[idx(counted.component_of_vertex[rim[0]])] != Fate::kept;
  });
  for (auto& rim : result.rims) {
    for (std::int32_t& v : rim) v = number[idx(v)];
  }
}

}  // namespace curveskel
