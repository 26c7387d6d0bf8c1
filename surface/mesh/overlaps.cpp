#include "surface/mesh/overlaps.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <stop_token>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include "surface/mesh/meeting_boxes.hpp"
#include "surface/spatial/box_tree.hpp"

namespace curveskel {
namespace {

using MeetingKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = Eigen::AlignedBox3d;
using FaceBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;

/// The components by their vertices and faces, in the order of the surface.
struct Members {
  std::vector<Box> boxes;
  std::vector<std::int32_t> a_vertex;  ///< one of each
  std::vector<std::vector<std::int32_t>> faces;
};

Members members_of(const Surface& surface, const Topology& counted) {
  const std::size_t components = counted.genus.size();
  Members members{std::vector<Box>(components), std::vector<std::int32_t>(components, -1),
                  std::vector<std::vector<std::int32_t>>(components)};
  for (Eigen::Index v = surface.positions.rows(); v-- > 0;) {
    const std::size_t own = idx(counted.component_of_vertex[v]);
    members.boxes[own].extend(Eigen::Vector3d(surface.positions.row(v)));
    members.a_vertex[own] = static_cast<std::int32_t>(v);
  }
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(surface.triangles.rows()); ++f) {
    members.faces[idx(counted.component_of_vertex[surface.triangles(f, 0)])].push_back(f);
  }
  return members;
}

/// Per component the others whose boxes have a point in common with its own, ascending.
std::vector<std::vector<int>> near_boxes(const std::vector<Box>& boxes,
                                         const std::stop_token& stop) {
  std::vector<std::vector<int>> near(boxes.size());
  for_meeting_boxes(boxes, [&](int a, int b) {
    throw_if_stopped(stop);
    near[idx(a)].push_back(b);
    near[idx(b)].push_back(a);
  });
  for (auto& its : near) std::sort(its.begin(), its.end());
  return near;
}

/// Components by their boxes.
class BoxesInReach {
 public:
  explicit BoxesInReach(const std::vector<Box>& boxes) : tree_(middles_of_boxes(boxes)) {
    for (std::size_t c = 0; c < boxes.size(); ++c) tree_.put(c, {boxes[c]});
  }

  /// True if the box of a component other than `own` has a point in common with this one.
  [[nodiscard]] bool has_other(std::size_t own, const Box& box) const {
    bool found = false;
    double most = 0;
    const auto bound = [&](const BoxTree::Item& item) {
      return item.box.intersects(box) ? 0.0 : 1.0;
    };
    tree_.search(bound, most, [&](std::size_t other) {
      if (other == own) return;
      found = true;
      most = -1;  // one will do
    });
    return found;
  }

 private:
  BoxTree tree_;
};

/// The boxes of the triangles that come into the box of a component other than their own.
std::vector<FaceBox> faces_within_reach(const Surface& surface, const Members& members,
                                        const std::vector<std::vector<int>>& near,
                                        const std::stop_token& stop) {
  const BoxesInReach boxes(members.boxes);
  std::vector<FaceBox> reached;
  for (std::size_t c = 0; c < near.size(); ++c) {
    if (near[c].empty()) continue;
    throw_if_stopped(stop);
    for (const std::int32_t f : members.faces[c]) {
      Box box;
      for (const std::int32_t v : surface.triangles.row(f)) {
        box.extend(Eigen::Vector3d(surface.positions.row(v)));
      }
      if (!boxes.has_other(c, box)) continue;
      reached.emplace_back(CGAL::Bbox_3(box.min().x(), box.min().y(), box.min().z(), box.max().x(),
                                        box.max().y(), box.max().z()),
                           f);
    }
  }
  return reached;
}

MeetingKernel::Triangle_3 triangle_of(const Surface& surface, std::int32_t face) {
  const auto corner = [&](int k) {
    const auto p = surface.positions.row(surface.triangles(face, k));
    return MeetingKernel::Point_3(p.x(), p.y(), p.z());
  };
  return {corner(0), corner(1), corner(2)};
}

/// Triangles without area meet nothing: CGAL needs a plane, and their neighbours stand for them.
std::set<std::pair<int, int>> meeting_pairs(const Surface& surface, const Topology& counted,
                                            std::vector<FaceBox>& reached,
                                            const std::stop_token& stop) {
  std::set<std::pair<int, int>> meeting;
  const auto own = [&](const FaceBox& box) {
    return counted.component_of_vertex[surface.triangles(box.info(), 0)];
  };
  const auto compare = [&](const FaceBox& a, const FaceBox& b) {
    if (own(a) == own(b)) return;
    const std::pair<int, int> both = std::minmax(own(a), own(b));
    if (meeting.contains(both)) return;
    throw_if_stopped(stop);
    const auto one = triangle_of(surface, a.info());
    const auto other = triangle_of(surface, b.info());
    if (one.is_degenerate() || other.is_degenerate()) return;
    if (CGAL::do_intersect(one, other)) meeting.insert(both);
  };
  CGAL::box_self_intersection_d(reached.begin(), reached.end(), compare);
  return meeting;
}

/// A component that meets no other lies inside it with all its vertices or with none.
std::vector<int> components_around(const Surface& surface, const Topology& counted,
                                   const Members& members,
                                   const std::vector<std::vector<int>>& near,
                                   const std::set<std::pair<int, int>>& meeting,
                                   const std::stop_token& stop) {
  std::vector<int> around(near.size(), -1);
  std::vector<Component> components;
  for (std::size_t c = 0; c < near.size(); ++c) {
    std::optional<SurfaceTree> tree;
    for (const int inner : near[c]) {
      const Box& box = members.boxes[c];
      int& so_far = around[idx(inner)];
      if (!box.contains(members.boxes[idx(inner)])) continue;
      if (meeting.contains(std::minmax(static_cast<int>(c), inner))) continue;
      if (so_far >= 0 && members.boxes[idx(so_far)].volume() <= box.volume()) continue;
      throw_if_stopped(stop);
      if (components.empty()) components = split_components(surface, counted);
      if (!tree) tree.emplace(components[c].surface);
      const Eigen::Vector3d vertex = surface.positions.row(members.a_vertex[idx(inner)]);
      if (tree->inside(vertex)) so_far = static_cast<int>(c);
    }
  }
  return around;
}

}  // namespace

Overlaps overlaps_of(const Surface& surface, const Topology& counted, const Monitor& monitor) {
  Overlaps result{std::vector<std::vector<int>>(counted.genus.size()),
                  std::vector<int>(counted.genus.size(), -1)};
  if (counted.components() < 2) return result;
  const Members members = members_of(surface, counted);
  const auto near = near_boxes(members.boxes, monitor.stop);
  auto reached = faces_within_reach(surface, members, near, monitor.stop);
  const auto meeting = meeting_pairs(surface, counted, reached, monitor.stop);
  for (const auto& [a, b] : meeting) {
    result.met[idx(a)].push_back(b);
    result.met[idx(b)].push_back(a);
  }
  for (auto& others : result.met) std::sort(others.begin(), others.end());
  result.around = components_around(surface, counted, members, near, meeting, monitor.stop);
  return result;
}

}  // namespace curveskel
