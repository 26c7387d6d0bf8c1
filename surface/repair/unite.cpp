#include "surface/repair/unite.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/union_find.hpp>
#include "surface/mesh/cgal_mesh.hpp"
#include "surface/repair/open_pairs.hpp"

namespace curveskel {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using UnitingKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using BodyMesh = CGAL::Surface_mesh<UnitingKernel::Point_3>;

/// A body while others are added to it.
struct Growing {
  BodyMesh mesh;
  double volume = 0;
  int cavities = 0;  ///< filled so far
  bool is_united = false;
};

/// The volume of a union is the greater one's at least and the sum at most.
bool has_volume_of_union(double found, double one, double other) {
  constexpr double rounding = 1e-9;
  const double sum = one + other;
  return found >= std::max(one, other) - rounding * sum && found <= sum * (1 + rounding);
}

/// Without faces that have no area. Returns why it cannot be united with anything, else nothing:
/// CGAL's unions need surfaces that cross themselves nowhere.
std::string begin(Growing& body, const Surface& surface) {
  body.mesh = cgal_mesh<BodyMesh>(surface);
  body.volume = volume(surface);
  const bool taken_out = pmp::remove_degenerate_faces(body.mesh);
  body.mesh.collect_garbage();
  if (!taken_out || !CGAL::is_closed(body.mesh) || !CGAL::is_valid_polygon_mesh(body.mesh)) {
    return "one has faces without area that cannot be taken out";
  }
  return pmp::does_self_intersect(body.mesh) ? "one crosses itself" : "";
}

/// Either the union or the reason why there is none.
struct UnionOrReason {
  std::optional<Growing> body;
  std::string why;
};

double volume_within(const BodyMesh& mesh, const std::vector<BodyMesh::Face_index>& faces) {
  using Eigen::Vector3d;
  const auto place = [&](BodyMesh::Vertex_index v) -> Vector3d {
    const auto& p = mesh.point(v);
    return {p.x(), p.y(), p.z()};
  };
  const Vector3d origin = place(mesh.target(mesh.halfedge(faces.front())));
  double sum = 0;
  for (const auto f : faces) {
    const auto h = mesh.halfedge(f);
    const Vector3d a = place(mesh.source(h)) - origin;
    const Vector3d b = place(mesh.target(h)) - origin;
    const Vector3d c = place(mesh.target(mesh.next(h))) - origin;
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

/// Of the boundary of a body all but the outer component; false if there are several of these.
bool fill_cavities(Growing& body) {
  BodyMesh& mesh = body.mesh;
  auto number = mesh.add_property_map<BodyMesh::Face_index, std::size_t>("f:part", 0).first;
  const std::size_t parts = pmp::connected_components(mesh, number);
  std::vector<std::vector<BodyMesh::Face_index>> faces(parts);
  for (const auto f : mesh.faces()) faces[number[f]].push_back(f);
  std::vector<std::size_t> outer;
  for (std::size_t part = 0; part < parts; ++part) {
    const double its = volume_within(mesh, faces[part]);
    if (its <= 0) continue;
    outer.push_back(part);
    body.volume = its;
  }
  if (outer.size() != 1) return false;
  body.cavities += static_cast<int>(parts) - 1;
  if (parts > 1) {
    pmp::keep_connected_components(mesh, outer, number);
    mesh.collect_garbage();
  }
  mesh.remove_property_map(number);
  return true;
}

/// The same surface, its vertices in the order of their places and its faces in that of their
/// corners. CGAL numbers what it cuts by addresses in memory, which differ from run to run.
BodyMesh numbered_by_place(const BodyMesh& mesh) {
  const Surface given = surface_of_cgal(mesh);
  const auto place = [&](std::int32_t v) {
    const auto p = given.positions.row(v);
    return std::array{p.x(), p.y(), p.z()};
  };
  std::vector<std::int32_t> order(idx(given.positions.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, place);
  std::vector<std::int32_t> number(order.size());
  Surface sorted = given;
  for (std::size_t k = 0; k < order.size(); ++k) {
    number[idx(order[k])] = static_cast<std::int32_t>(k);
    sorted.positions.row(static_cast<Eigen::Index>(k)) = given.positions.row(order[k]);
  }
  std::vector<std::array<std::int32_t, 3>> faces;
  faces.reserve(idx(given.triangles.rows()));
  for (const auto& t : given.triangles.rowwise()) {
    std::array<std::int32_t, 3> face{number[idx(t[0])], number[idx(t[1])], number[idx(t[2])]};
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
    faces.push_back(face);
  }
  std::ranges::sort(faces);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    sorted.triangles.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  }
  return cgal_mesh<BodyMesh>(sorted);
}

constexpr const char* crossing = "their union would cross itself";
constexpr const char* touching = "they touch in an edge or a vertex only, where no body can be one";

/// While one lives, CGAL rounds the points that it constructs from their exact coordinates. From an
/// interval, as it does otherwise, the last digits depend on which end of an edge came first.
class RoundedFromExact {
  using Number = CGAL::Exact_predicates_exact_constructions_kernel::FT;

 public:
  RoundedFromExact() : before_(Number::get_relative_precision_of_to_double()) {
    Number::set_relative_precision_of_to_double(std::numeric_limits<double>::min());
  }
  ~RoundedFromExact() { Number::set_relative_precision_of_to_double(before_); }
  RoundedFromExact(const RoundedFromExact&) = delete;
  RoundedFromExact& operator=(const RoundedFromExact&) = delete;
  RoundedFromExact(RoundedFromExact&&) = delete;
  RoundedFromExact& operator=(RoundedFromExact&&) = delete;

 private:
  double before_;
};

/// As both are.
UnionOrReason union_as_given(const Growing& one, const Growing& other) {
  BodyMesh a = one.mesh;
  BodyMesh b = other.mesh;
  Growing found;
  found.is_united = true;
  found.cavities = one.cavities + other.cavities;
  try {
    const RoundedFromExact rounded;
    const auto strictly = CGAL::parameters::throw_on_self_intersection(true);
    if (!pmp::corefine_and_compute_union(a, b, found.mesh, strictly)) {
      return {std::nullopt, touching};
    }
  } catch (const pmp::Corefinement::Self_intersection_exception&) {
    return {std::nullopt, crossing};
  } catch (const CGAL::Failure_exception&) {
    return {std::nullopt, "one has no clear inside where they meet"};
  }
  found.mesh.collect_garbage();
  found.mesh = numbered_by_place(found.mesh);
  const double its_volume = CGAL::to_double(pmp::volume(found.mesh));
  if (!has_volume_of_union(its_volume, one.volume, other.volume)) {
    return {std::nullopt, "what came of them has not the volume of a union"};
  }
  if (!fill_cavities(found)) return {std::nullopt, touching};
  if (pmp::does_self_intersect(found.mesh)) return {std::nullopt, crossing};
  return {std::move(found), {}};
}

/// A little larger in all directions: faces that lay in those of another lie in them no more.
Growing grown(const Growing& body, double by) {
  Growing result = body;
  const auto box = pmp::bbox(body.mesh);
  const double middle[] = {(box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2,
                           (box.zmin() + box.zmax()) / 2};
  const double factor[] = {1 + by / (box.xmax() - box.xmin()), 1 + by / (box.ymax() - box.ymin()),
                           1 + by / (box.zmax() - box.zmin())};
  for (const auto v : result.mesh.vertices()) {
    auto& p = result.mesh.point(v);
    p = UnitingKernel::Point_3(middle[0] + factor[0] * (p.x() - middle[0]),
                               middle[1] + factor[1] * (p.y() - middle[1]),
                               middle[2] + factor[2] * (p.z() - middle[2]));
  }
  result.volume *= factor[0] * factor[1] * factor[2];
  return result;
}

/// Where coordinates as doubles make slivers cross one another, once more with the second a
/// millionth of the extent larger.
UnionOrReason union_of(const Growing& one, const Growing& other, double extent) {
  UnionOrReason found = union_as_given(one, other);
  if (found.body || found.why != crossing) return found;
  return union_as_given(one, grown(other, 1e-6 * extent));
}

std::vector<UnitedBody> united_bodies(std::vector<Growing>& bodies, UnionFind& joined) {
  std::vector<UnitedBody> result;
  std::vector<int> place(bodies.size(), -1);
  for (int c = 0; c < static_cast<int>(bodies.size()); ++c) {
    const int root = joined.root(c);
    if (!bodies[idx(root)].is_united) continue;
    if (place[idx(root)] < 0) {
      place[idx(root)] = static_cast<int>(result.size());
      result.push_back({{}, surface_of_cgal(bodies[idx(root)].mesh), bodies[idx(root)].cavities});
    }
    result[idx(place[idx(root)])].parts.push_back(c);
  }
  return result;
}

/// Bodies that grow from the parts, and the pairs that are still to be united.
class Uniting {
  using Pairs = std::vector<std::size_t>;

 public:
  Uniting(const std::vector<Component>& parts, const std::vector<std::pair<int, int>>& meeting)
      : meeting_(meeting),
        open_(meeting.size()),
        joined_(static_cast<std::int64_t>(parts.size())),
        bodies_(parts.size()),
        pairs_of_(parts.size()) {
    for (std::size_t pair = 0; pair < meeting.size(); ++pair) {
      pairs_of_[idx(meeting[pair].first)].push_back(pair);
      pairs_of_[idx(meeting[pair].second)].push_back(pair);
    }
    std::vector<std::string> unfit(parts.size());
    Eigen::AlignedBox3d box;
    for (const auto& [a, b] : meeting) {
      for (const int c : {a, b}) {
        if (bodies_[idx(c)].mesh.number_of_faces() > 0) continue;
        unfit[idx(c)] = begin(bodies_[idx(c)], parts[idx(c)].surface);
        const Positions& positions = parts[idx(c)].surface.positions;
        box.extend(Eigen::Vector3d(positions.colwise().minCoeff()));
        box.extend(Eigen::Vector3d(positions.colwise().maxCoeff()));
      }
    }
    if (!meeting.empty()) extent_ = box.diagonal().norm();
    for (std::size_t pair = 0; pair < meeting.size(); ++pair) {
      const auto& [a, b] = meeting[pair];
      const std::string& why = unfit[idx(a)].empty() ? unfit[idx(b)] : unfit[idx(a)];
      if (why.empty()) {
        open_.open(pair, size_of(pair));
      } else {
        refused_.push_back({a, b, why});
      }
    }
  }

  void run(const Monitor& monitor) {
    while (open_.count() > 0) {
      monitor.report("merge", double(meeting_.size() - open_.count()) / double(meeting_.size()));
      const std::size_t smallest = open_.smallest();
      const auto& [a, b] = meeting_[smallest];
      const int hub = triangles(joined_.root(a)) < triangles(joined_.root(b)) ? b : a;
      unite_with(hub, pairs_at(hub, smallest), monitor);
    }
  }

  [[nodiscard]] Unions result() {
    std::erase_if(refused_, [&](const RefusedUnion& one) {
      return joined_.root(one.one) == joined_.root(one.other);
    });
    return {united_bodies(bodies_, joined_), std::move(refused_)};
  }

 private:
  [[nodiscard]] std::size_t triangles(int root) const {
    return bodies_[idx(root)].mesh.number_of_faces();
  }

  [[nodiscard]] std::size_t size_of(std::size_t pair) {
    const auto& [a, b] = meeting_[pair];
    return triangles(joined_.root(a)) + triangles(joined_.root(b));
  }

  /// The pairs of a body that has grown: without those that came to belong to it.
  void sort_pairs_of(int root) {
    Pairs& pairs = pairs_of_[idx(root)];
    std::erase_if(pairs, [&](std::size_t pair) {
      const bool is_within = other_than(root, pair) == root;
      if (is_within) open_.close(pair);
      return is_within;
    });
    for (const std::size_t pair : pairs) {
      if (open_.has(pair)) open_.open(pair, size_of(pair));
    }
  }

  /// An open pair for each of several bodies that meet the hub, but not one another; `first` is one
  /// of the pairs. None is larger than the hub: a body that took every part in turn would be gone
  /// through for each.
  Pairs pairs_at(int hub, std::size_t first) {
    const int root = joined_.root(hub);
    Pairs at_hub = pairs_of_[idx(root)];
    std::sort(at_hub.begin(), at_hub.end());
    at_hub.insert(at_hub.begin(), first);
    Pairs chosen;
    std::set<int> barred{root};
    for (const std::size_t pair : at_hub) {
      const int other = other_than(root, pair);
      if (!open_.has(pair) || triangles(other) > triangles(root)) continue;
      if (!barred.insert(other).second) continue;
      for (const std::size_t its : pairs_of_[idx(other)]) barred.insert(other_than(other, its));
      chosen.push_back(pair);
    }
    return chosen;
  }

  int other_than(int root, std::size_t pair) {
    const int a = joined_.root(meeting_[pair].first);
    return a == root ? joined_.root(meeting_[pair].second) : a;
  }

  /// Two bodies meet in many pairs of parts: what could not be united for one of these is not tried
  /// for the next.
  UnionOrReason asked_once(int root, std::size_t pair, const Growing& other) {
    const std::pair<int, int> both = std::minmax(root, other_than(root, pair));
    const auto known = refusals_.find(both);
    if (known != refusals_.end()) return {std::nullopt, known->second};
    UnionOrReason outcome = union_of(bodies_[idx(root)], other, extent_);
    if (!outcome.body) refusals_.emplace(both, outcome.why);
    return outcome;
  }

  /// All at once; where that fails in halves, so that one that cannot be united bars no other.
  void unite_with(int hub, const Pairs& pairs, const Monitor& monitor) {
    throw_if_stopped(monitor.stop);
    const int root = joined_.root(hub);
    Growing others;
    for (const std::size_t pair : pairs) {
      const Growing& one = bodies_[idx(other_than(root, pair))];
      CGAL::copy_face_graph(one.mesh, others.mesh);
      others.volume += one.volume;
      others.cavities += one.cavities;
    }
    UnionOrReason outcome = pairs.size() == 1 ? asked_once(root, pairs.front(), others)
                                              : union_of(bodies_[idx(root)], others, extent_);
    if (!outcome.body && pairs.size() > 1) {
      const auto half = pairs.begin() + static_cast<std::ptrdiff_t>(pairs.size() / 2);
      unite_with(hub, {pairs.begin(), half}, monitor);
      unite_with(hub, {half, pairs.end()}, monitor);
      return;
    }
    for (const std::size_t pair : pairs) {
      open_.close(pair);
      const auto& [a, b] = meeting_[pair];
      if (!outcome.body) {
        refused_.push_back({a, b, outcome.why});
        continue;
      }
      join(joined_.root(a), joined_.root(b));
    }
    if (!outcome.body) return;
    const int united = joined_.root(hub);
    bodies_[idx(united)] = std::move(*outcome.body);
    sort_pairs_of(united);
  }

  /// Two bodies; the mesh of the union is still to be given to the one that stands for it.
  void join(int one, int other) {
    std::erase_if(refusals_, [&](const auto& refusal) {
      const auto& [a, b] = refusal.first;
      return a == one || a == other || b == one || b == other;
    });
    bodies_[idx(one)].mesh.clear();
    bodies_[idx(other)].mesh.clear();
    Pairs pairs = std::move(pairs_of_[idx(one)]);
    Pairs more = std::move(pairs_of_[idx(other)]);
    if (pairs.size() < more.size()) pairs.swap(more);
    pairs.insert(pairs.end(), more.begin(), more.end());
    joined_.unite(one, other);
    pairs_of_[idx(joined_.root(one))] = std::move(pairs);
  }

  const std::vector<std::pair<int, int>>& meeting_;
  OpenPairs open_;  // by the triangles of both bodies
  UnionFind joined_;
  std::vector<Growing> bodies_;
  std::vector<Pairs> pairs_of_;  // with a part of the body, by the part that stands for it
  std::vector<RefusedUnion> refused_;
  std::map<std::pair<int, int>, std::string> refusals_;  // of bodies as they are, by their parts
  double extent_ = 0;                                    ///< of all parts together
};

}  // namespace

Unions unite(const std::vector<Component>& parts, const std::vector<std::pair<int, int>>& meeting,
             const Monitor& monitor) {
  Uniting uniting(parts, meeting);
  uniting.run(monitor);
  return uniting.result();
}

}  // namespace curveskel
