#include "surface/repair/unite.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/union_find.hpp>

namespace curveskel {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using UnitingKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<UnitingKernel::Point_3>;

ExactMesh exact_mesh(const Surface& surface) {
  ExactMesh mesh;
  using Vertex = ExactMesh::Vertex_index;
  for (const auto& p : surface.positions.rowwise()) mesh.add_vertex({p.x(), p.y(), p.z()});
  const auto vertex = [](std::int32_t v) { return Vertex(static_cast<std::uint32_t>(v)); };
  for (const auto& t : surface.triangles.rowwise()) {
    mesh.add_face(vertex(t(0)), vertex(t(1)), vertex(t(2)));
  }
  return mesh;
}

Surface rounded(const ExactMesh& mesh) {
  Surface surface;
  surface.positions.resize(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
  surface.triangles.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  std::vector<std::int32_t> number(mesh.num_vertices(), -1);
  std::int32_t vertices = 0;
  for (const auto v : mesh.vertices()) {
    const auto& p = CGAL::exact(mesh.point(v));
    surface.positions.row(vertices) << CGAL::to_double(p.x()), CGAL::to_double(p.y()),
        CGAL::to_double(p.z());
    number[v] = vertices++;
  }
  Eigen::Index faces = 0;
  for (const auto f : mesh.faces()) {
    int k = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      surface.triangles(faces, k++) = number[v];
    }
    ++faces;
  }
  return surface;
}

/// A body while others are added to it.
struct Growing {
  ExactMesh mesh;
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

/// Without faces that have no area; false if they cannot be taken out.
bool begin(Growing& body, const Surface& surface) {
  body.mesh = exact_mesh(surface);
  body.volume = volume(surface);
  const bool taken_out = pmp::remove_degenerate_faces(body.mesh);
  body.mesh.collect_garbage();
  return taken_out && CGAL::is_closed(body.mesh) && CGAL::is_valid_polygon_mesh(body.mesh);
}

/// Either the union or the reason why there is none.
struct UnionOrReason {
  std::optional<Growing> body;
  std::string why;
};

/// The exact points of a mesh that have doubles in their place.
class RoundedPoints {
 public:
  explicit RoundedPoints(ExactMesh& mesh) : mesh_(mesh) {
    for (const auto v : mesh.vertices()) {
      const auto& p = CGAL::exact(mesh.point(v));
      const UnitingKernel::Point_3 nearest(CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                                           CGAL::to_double(p.z()));
      if (nearest == mesh.point(v)) continue;
      exact_.emplace(v, mesh.point(v));
      mesh.point(v) = nearest;
    }
  }

  /// Gives back the points of faces that cross others, or have no area, because of the rounding.
  /// True if there were none.
  bool give_back_crossing() {
    std::vector<ExactMesh::Face_index> crossing;
    std::vector<ExactMesh::Face_index> flat;
    const auto rounded = faces_with_rounded_points();
    for (const auto f : rounded) {
      if (pmp::is_degenerate_triangle_face(f, mesh_)) flat.push_back(f);
    }
    if (flat.empty()) {
      std::vector<std::pair<ExactMesh::Face_index, ExactMesh::Face_index>> pairs;
      pmp::self_intersections(rounded, mesh_, std::back_inserter(pairs));
      for (const auto& [f, g] : pairs) crossing.insert(crossing.end(), {f, g});
    }
    for (const auto& faces : {flat, crossing}) {
      for (const auto f : faces) give_back(f);
    }
    return flat.empty() && crossing.empty();
  }

  void give_back_all() {
    for (const auto& [v, p] : exact_) mesh_.point(v) = p;
    exact_.clear();
  }

 private:
  [[nodiscard]] std::vector<ExactMesh::Face_index> faces_with_rounded_points() const {
    std::vector<ExactMesh::Face_index> faces;
    for (const auto& [v, p] : exact_) {
      for (const auto f : CGAL::faces_around_target(mesh_.halfedge(v), mesh_)) faces.push_back(f);
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  void give_back(ExactMesh::Face_index f) {
    for (const auto v : CGAL::vertices_around_face(mesh_.halfedge(f), mesh_)) {
      const auto found = exact_.find(v);
      if (found == exact_.end()) continue;
      mesh_.point(v) = found->second;
      exact_.erase(found);
    }
  }

  ExactMesh& mesh_;
  std::map<ExactMesh::Vertex_index, UnitingKernel::Point_3> exact_;
};

/// Points of intersection of faces between such points have numbers several times as long each
/// time: doubles take their place wherever no faces cross for it.
void round_where_nothing_crosses(ExactMesh& mesh) {
  constexpr int rounds = 4;  // most crossings are gone after one
  RoundedPoints points(mesh);
  for (int round = 0; round < rounds; ++round) {
    if (points.give_back_crossing()) return;
  }
  points.give_back_all();
}

/// A double is enough to tell a hollow from a body.
double rough_volume(const ExactMesh& mesh, const std::vector<ExactMesh::Face_index>& faces) {
  using Eigen::Vector3d;
  const auto place = [&](ExactMesh::Vertex_index v) -> Vector3d {
    const auto& p = mesh.point(v);
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
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
  ExactMesh& mesh = body.mesh;
  auto number = mesh.add_property_map<ExactMesh::Face_index, std::size_t>("f:part", 0).first;
  const std::size_t parts = pmp::connected_components(mesh, number);
  std::vector<std::vector<ExactMesh::Face_index>> faces(parts);
  for (const auto f : mesh.faces()) faces[number[f]].push_back(f);
  std::vector<std::size_t> outer;
  for (std::size_t part = 0; part < parts; ++part) {
    const double its = rough_volume(mesh, faces[part]);
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

constexpr const char* touching = "they touch in an edge or a vertex only, where no body can be one";

UnionOrReason union_of(const Growing& one, const Growing& other) {
  ExactMesh a = one.mesh;
  ExactMesh b = other.mesh;
  Growing found;
  found.is_united = true;
  found.cavities = one.cavities + other.cavities;
  try {
    const auto strictly = CGAL::parameters::throw_on_self_intersection(true);
    if (!pmp::corefine_and_compute_union(a, b, found.mesh, strictly)) {
      return {std::nullopt, touching};
    }
  } catch (const pmp::Corefinement::Self_intersection_exception&) {
    return {std::nullopt, "one crosses itself where they meet"};
  } catch (const CGAL::Failure_exception&) {
    return {std::nullopt, "one has no clear inside where they meet"};
  }
  pmp::duplicate_non_manifold_vertices(found.mesh);
  found.mesh.collect_garbage();
  if (!CGAL::is_valid_polygon_mesh(found.mesh)) return {std::nullopt, touching};
  if (!has_volume_of_union(CGAL::to_double(pmp::volume(found.mesh)), one.volume, other.volume)) {
    return {std::nullopt, "one crosses itself, so that the union has not its volume"};
  }
  if (!fill_cavities(found)) return {std::nullopt, touching};
  round_where_nothing_crosses(found.mesh);
  return {std::move(found), {}};
}

std::vector<UnitedBody> united_bodies(std::vector<Growing>& bodies, UnionFind& joined) {
  std::vector<UnitedBody> result;
  std::vector<int> place(bodies.size(), -1);
  for (int c = 0; c < static_cast<int>(bodies.size()); ++c) {
    const int root = joined.root(c);
    if (!bodies[idx(root)].is_united) continue;
    if (place[idx(root)] < 0) {
      place[idx(root)] = static_cast<int>(result.size());
      result.push_back({{}, rounded(bodies[idx(root)].mesh), bodies[idx(root)].cavities});
    }
    result[idx(place[idx(root)])].parts.push_back(c);
  }
  return result;
}

/// Bodies that grow from the parts, and the pairs that are still to be united.
class Uniting {
 public:
  Uniting(const std::vector<Component>& parts, const std::vector<std::pair<int, int>>& meeting)
      : meeting_(meeting),
        is_open_(meeting.size(), 1),
        joined_(static_cast<std::int64_t>(parts.size())),
        bodies_(parts.size()) {
    std::vector<char> is_fit(parts.size(), 0);
    for (const auto& [a, b] : meeting) {
      for (const int c : {a, b}) {
        if (bodies_[idx(c)].mesh.number_of_faces() > 0) continue;
        is_fit[idx(c)] = begin(bodies_[idx(c)], parts[idx(c)].surface) ? 1 : 0;
      }
    }
    for (std::size_t pair = 0; pair < meeting.size(); ++pair) {
      const auto& [a, b] = meeting[pair];
      if (is_fit[idx(a)] && is_fit[idx(b)]) continue;
      is_open_[pair] = 0;
      refused_.push_back({a, b, "one has faces without area that cannot be taken out"});
    }
  }

  void run(const Monitor& monitor) {
    while (const auto next = smallest_pair()) {
      monitor.report("merge", double(std::count(is_open_.begin(), is_open_.end(), char{0})) /
                                  double(meeting_.size()));
      const auto& [a, b] = meeting_[*next];
      const int hub = triangles(joined_.root(a)) < triangles(joined_.root(b)) ? b : a;
      unite_with(hub, pairs_at(hub, *next), monitor);
    }
  }

  [[nodiscard]] Unions result() {
    std::erase_if(refused_, [&](const RefusedUnion& one) {
      return joined_.root(one.one) == joined_.root(one.other);
    });
    return {united_bodies(bodies_, joined_), std::move(refused_)};
  }

 private:
  using Pairs = std::vector<std::size_t>;

  [[nodiscard]] std::size_t triangles(int root) const {
    return bodies_[idx(root)].mesh.number_of_faces();
  }

  /// Of the open pairs; closes those that came to belong to one body.
  std::optional<std::size_t> smallest_pair() {
    std::optional<std::size_t> smallest;
    std::size_t fewest = 0;
    for (std::size_t pair = 0; pair < meeting_.size(); ++pair) {
      if (!is_open_[pair]) continue;
      const int a = joined_.root(meeting_[pair].first);
      const int b = joined_.root(meeting_[pair].second);
      if (a == b) is_open_[pair] = 0;
      const std::size_t both = triangles(a) + triangles(b);
      if (a == b || (smallest && both >= fewest)) continue;
      smallest = pair;
      fewest = both;
    }
    return smallest;
  }

  /// An open pair for each of several bodies that meet the hub, but not one another; `first` is one
  /// of the pairs.
  Pairs pairs_at(int hub, std::size_t first) {
    const int root = joined_.root(hub);
    std::map<int, std::set<int>> met;
    Pairs at_hub{first};
    for (std::size_t pair = 0; pair < meeting_.size(); ++pair) {
      const int a = joined_.root(meeting_[pair].first);
      const int b = joined_.root(meeting_[pair].second);
      met[a].insert(b);
      met[b].insert(a);
      if (is_open_[pair] && (a == root) != (b == root) && pair != first) at_hub.push_back(pair);
    }
    Pairs chosen;
    std::set<int> barred{root};
    for (const std::size_t pair : at_hub) {
      const int other = other_than(root, pair);
      if (!barred.insert(other).second) continue;
      barred.insert(met[other].begin(), met[other].end());
      chosen.push_back(pair);
    }
    return chosen;
  }

  int other_than(int root, std::size_t pair) {
    const int a = joined_.root(meeting_[pair].first);
    return a == root ? joined_.root(meeting_[pair].second) : a;
  }

  /// All at once; where that fails in halves, so that one that cannot be united bars no other.
  void unite_with(int hub, const Pairs& pairs, const Monitor& monitor) {
    if (monitor.stop.stop_requested()) throw Cancelled();
    const int root = joined_.root(hub);
    Growing others;
    for (const std::size_t pair : pairs) {
      const Growing& one = bodies_[idx(other_than(root, pair))];
      CGAL::copy_face_graph(one.mesh, others.mesh);
      others.volume += one.volume;
      others.cavities += one.cavities;
    }
    UnionOrReason outcome = union_of(bodies_[idx(root)], others);
    if (!outcome.body && pairs.size() > 1) {
      const auto half = pairs.begin() + static_cast<std::ptrdiff_t>(pairs.size() / 2);
      unite_with(hub, {pairs.begin(), half}, monitor);
      unite_with(hub, {half, pairs.end()}, monitor);
      return;
    }
    for (const std::size_t pair : pairs) {
      is_open_[pair] = 0;
      const auto& [a, b] = meeting_[pair];
      if (!outcome.body) {
        refused_.push_back({a, b, outcome.why});
        continue;
      }
      bodies_[idx(joined_.root(a))].mesh.clear();
      bodies_[idx(joined_.root(b))].mesh.clear();
      joined_.unite(a, b);
    }
    if (outcome.body) bodies_[idx(joined_.root(hub))] = std::move(*outcome.body);
  }

  const std::vector<std::pair<int, int>>& meeting_;
  std::vector<char> is_open_;
  UnionFind joined_;
  std::vector<Growing> bodies_;
  std::vector<RefusedUnion> refused_;
};

}  // namespace

Unions unite(const std::vector<Component>& parts, const std::vector<std::pair<int, int>>& meeting,
             const Monitor& monitor) {
  Uniting uniting(parts, meeting);
  uniting.run(monitor);
  return uniting.result();
}

}  // namespace curveskel
