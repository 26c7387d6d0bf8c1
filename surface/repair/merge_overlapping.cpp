#include "surface/repair/merge_overlapping.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "surface/mesh/nearest_vertex.hpp"
#include "surface/mesh/overlaps.hpp"
#include "surface/repair/assembly.hpp"
#include "surface/repair/renumber.hpp"
#include "surface/repair/unite.hpp"

namespace curveskel {
namespace {

/// The pairs of components that meet and of which neither is covered.
std::vector<std::pair<int, int>> pairs_to_unite(const Overlaps& overlaps) {
  std::vector<std::pair<int, int>> pairs;
  for (int a = 0; a < static_cast<int>(overlaps.met.size()); ++a) {
    if (overlaps.around[idx(a)] >= 0) continue;
    for (const int b : overlaps.met[idx(a)]) {
      if (b > a && overlaps.around[idx(b)] < 0) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

/// The component that is nobody's inside, around `component` or itself.
int outermost(const Overlaps& overlaps, int component) {
  while (overlaps.around[idx(component)] >= 0) component = overlaps.around[idx(component)];
  return component;
}

/// Components that are outermost and belong together: each body's, and each of no body alone.
std::vector<std::vector<int>> solids_of(const Overlaps& overlaps, const Unions& unions) {
  std::vector<std::vector<int>> solids;
  std::vector<char> in_body(overlaps.around.size(), 0);
  for (const UnitedBody& body : unions.bodies) {
    solids.push_back(body.parts);
    for (const int part : body.parts) in_body[idx(part)] = 1;
  }
  for (int c = 0; c < static_cast<int>(in_body.size()); ++c) {
    if (in_body[idx(c)] == 0 && overlaps.around[idx(c)] < 0) solids.push_back({c});
  }
  return solids;
}

bool meet(const Overlaps& overlaps, const std::vector<int>& one, const std::vector<int>& other) {
  return std::any_of(one.begin(), one.end(), [&](int c) {
    const auto& met = overlaps.met[idx(c)];
    return std::any_of(other.begin(), other.end(),
                       [&](int o) { return std::binary_search(met.begin(), met.end(), o); });
  });
}

/// A cavity that the parts of a body close in between them is filled: components in it lie inside
/// the body from now on, of which the first part stands for all.
void cover_in_cavities(const std::vector<Component>& parts, Unions& unions, Overlaps& overlaps) {
  const auto solids = solids_of(overlaps, unions);
  for (const UnitedBody& body : unions.bodies) {
    if (body.cavities == 0) continue;
    const SurfaceTree tree(body.surface);
    for (const std::vector<int>& solid : solids) {
      if (overlaps.around[idx(solid.front())] >= 0 || solid == body.parts) continue;
      const Eigen::Vector3d vertex = parts[idx(solid.front())].surface.positions.row(0);
      if (!tree.inside(vertex) || meet(overlaps, solid, body.parts)) continue;
      for (const int c : solid) overlaps.around[idx(c)] = body.parts.front();
    }
  }
  const auto is_covered = [&](int c) { return overlaps.around[idx(c)] >= 0; };
  std::erase_if(unions.bodies,
                [&](const UnitedBody& body) { return is_covered(body.parts.front()); });
  std::erase_if(unions.refused, [&](const RefusedUnion& one) {
    return is_covered(one.one) || is_covered(one.other);
  });
}

Merging record_of(const Topology& counted, const Overlaps& overlaps, const Unions& unions) {
  Merging merging;
  merging.components = static_cast<int>(overlaps.around.size());
  for (const UnitedBody& body : unions.bodies) {
    merging.bodies.push_back(body.parts);
    merging.cavities_filled += body.cavities;
    int handles = topology(body.surface).total_genus();
    for (const int part : body.parts) handles -= counted.genus[idx(part)];
    merging.handles_made += std::max(handles, 0);
  }
  for (int c = 0; c < merging.components; ++c) {
    if (overlaps.around[idx(c)] >= 0) merging.covered.push_back({c, overlaps.around[idx(c)]});
  }
  for (const RefusedUnion& one : unions.refused) {
    merging.apart.push_back({one.one, one.other, one.why});
  }
  return merging;
}

/// The surface of bodies, and where each vertex of the components has gone.
class MergedSurface {
 public:
  MergedSurface(const std::vector<Component>& parts, const Overlaps& overlaps, const Unions& unions,
                Eigen::Index vertices)
      : parts_(parts), number_(idx(vertices), -1), stays_(idx(vertices), 0) {
    std::vector<int> body_of(parts.size(), -1);
    for (int b = 0; b < static_cast<int>(unions.bodies.size()); ++b) {
      for (const int c : unions.bodies[idx(b)].parts) body_of[idx(c)] = b;
    }
    std::map<int, std::vector<int>> followers;  // of the component that stands for the body
    for (int c = 0; c < static_cast<int>(parts.size()); ++c) {
      const int outer = outermost(overlaps, c);
      const int body = body_of[idx(outer)];
      followers[body < 0 ? outer : unions.bodies[idx(body)].parts.front()].push_back(c);
    }
    for (const auto& [first, components] : followers) {
      const int body = body_of[idx(first)];
      add(body < 0 ? parts[idx(first)].surface : unions.bodies[idx(body)].surface, components,
          body < 0 ? first : -1);
    }
  }

  [[nodiscard]] Surface whole() const { return assembly_.whole(); }
  [[nodiscard]] std::int32_t number(std::int32_t vertex) const { return number_[idx(vertex)]; }
  /// True if the vertex is still one of the surface, not only near one.
  [[nodiscard]] bool stays(std::int32_t vertex) const { return stays_[idx(vertex)] != 0; }

 private:
  /// `itself` is the component that the body is, vertex by vertex; -1 = none.
  void add(const Surface& body, const std::vector<int>& components, int itself) {
    const std::int32_t first = assembly_.add(body);
    if (itself >= 0) {
      const auto& in_whole = parts_[idx(itself)].vertex_in_whole;
      for (std::size_t v = 0; v < in_whole.size(); ++v) {
        number_[idx(in_whole[v])] = first + static_cast<std::int32_t>(v);
        stays_[idx(in_whole[v])] = 1;
      }
      if (components.size() == 1) return;
    }
    const SurfaceTree tree(body);
    for (const int c : components) {
      if (c == itself) continue;
      const auto& [surface, in_whole] = parts_[idx(c)];
      for (std::size_t v = 0; v < in_whole.size(); ++v) {
        const Eigen::RowVector3d p = surface.positions.row(static_cast<Eigen::Index>(v));
        const std::int32_t nearest = nearest_vertex(body, tree, p);
        number_[idx(in_whole[v])] = first + nearest;
        stays_[idx(in_whole[v])] = body.positions.row(nearest) == p ? 1 : 0;
      }
    }
  }

  const std::vector<Component>& parts_;
  Assembly assembly_;
  std::vector<std::int32_t> number_;
  std::vector<char> stays_;
};

}  // namespace

void merge_overlapping(RepairedSurface& result, const Monitor& monitor) {
  const Topology counted = topology(result.surface);
  Overlaps overlaps = overlaps_of(result.surface, counted, monitor);
  const auto parts = split_components(result.surface, counted);
  Unions unions = unite(parts, pairs_to_unite(overlaps), monitor);
  cover_in_cavities(parts, unions, overlaps);
  result.repairs.merging = record_of(counted, overlaps, unions);
  if (unions.bodies.empty() && result.repairs.merging.covered.empty()) return;
  const MergedSurface merged(parts, overlaps, unions, result.surface.positions.rows());
  result.surface = merged.whole();
  renumber(
      result, [&](std::int32_t v) { return merged.number(v); },
      [&](std::int32_t v) { return !merged.stays(v); });
}

}  // namespace curveskel
