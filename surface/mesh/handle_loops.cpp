#include "surface/mesh/handle_loops.hpp"

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/error.hpp>
#include "surface/mesh/silence_openmesh.hpp"

namespace curveskel {
namespace {

/// Connectivity alone.
struct LoopTraits : OpenMesh::DefaultTraitsDouble {
  VertexAttributes(0);
  HalfedgeAttributes(0);
  EdgeAttributes(0);
  FaceAttributes(0);
};
using LoopMesh = OpenMesh::TriMesh_ArrayKernelT<LoopTraits>;
using LoopVertex = OpenMesh::VertexHandle;
using LoopHalfEdge = OpenMesh::HalfedgeHandle;
using LoopFace = OpenMesh::FaceHandle;

/// Edges are numbered in the order in which the faces' corners reach them, and the first half-edge
/// of each is that of the face that came first.
LoopMesh loop_mesh(const Surface& surface) {
  silence_openmesh();
  LoopMesh mesh;
  const auto vertices = idx(surface.positions.rows());
  const auto faces = idx(surface.triangles.rows());
  mesh.reserve(vertices, 3 * faces / 2, faces);
  for (std::size_t v = 0; v < vertices; ++v) mesh.new_vertex();
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const auto corner = surface.triangles.row(f);
    if (mesh.add_face(LoopVertex(corner[0]), LoopVertex(corner[1]), LoopVertex(corner[2]))
            .is_valid()) {
      continue;
    }
    throw Error(Fault::input, "found face " + std::to_string(f) +
                                  ", counted from 0, in no oriented 2-manifold, needed a closed "
                                  "surface to look for its handles; clean or repair it first");
  }
  return mesh;
}

class TreeAndCotree {
 public:
  explicit TreeAndCotree(const Surface& surface)
      : mesh_(loop_mesh(surface)),
        way_in_(mesh_.n_vertices()),
        depth_(mesh_.n_vertices(), -1),
        taken_(mesh_.n_edges(), 0) {
    span_vertices();
    span_faces();
  }

  /// The edges on the loop that every edge left over closes.
  [[nodiscard]] std::vector<std::vector<int>> loops() const {
    std::vector<std::vector<int>> result;
    for (int e = 0; e < static_cast<int>(taken_.size()); ++e) {
      if (taken_[idx(e)] != 0) continue;
      result.push_back({e});
      auto [a, b] = ends(e);
      while (a != b) {
        int& deeper = depth_[idx(a)] >= depth_[idx(b)] ? a : b;
        const LoopHalfEdge in = way_in_[idx(deeper)];
        result.back().push_back(mesh_.edge_handle(in).idx());
        deeper = mesh_.from_vertex_handle(in).idx();
      }
    }
    return result;
  }

  [[nodiscard]] std::array<int, 2> ends(int edge) const {
    const LoopHalfEdge h = mesh_.halfedge_handle(OpenMesh::EdgeHandle(edge), 0);
    return {mesh_.from_vertex_handle(h).idx(), mesh_.to_vertex_handle(h).idx()};
  }
  [[nodiscard]] int edges() const { return static_cast<int>(taken_.size()); }
  [[nodiscard]] int components() const { return components_; }

 private:
  [[nodiscard]] char& taken(LoopHalfEdge h) { return taken_[idx(mesh_.edge_handle(h).idx())]; }

  /// The half-edge from the first corner of a face.
  [[nodiscard]] LoopHalfEdge first_of(int face) const {
    return mesh_.next_halfedge_handle(mesh_.halfedge_handle(LoopFace(face)));
  }

  /// Of each vertex, the half-edge that leaves it in the first face that it is a corner of.
  [[nodiscard]] std::vector<LoopHalfEdge> half_edges_out() const {
    std::vector<LoopHalfEdge> out(depth_.size());
    for (auto f = static_cast<int>(mesh_.n_faces()) - 1; f >= 0; --f) {
      LoopHalfEdge h = first_of(f);
      for (int k = 0; k < 3; ++k) {
        out[idx(mesh_.from_vertex_handle(h).idx())] = h;
        h = mesh_.next_halfedge_handle(h);
      }
    }
    return out;
  }

  void span_vertices() {
    const std::vector<LoopHalfEdge> out = half_edges_out();
    std::vector<int> queue;
    for (int root = 0; root < static_cast<int>(out.size()); ++root) {
      if (depth_[idx(root)] >= 0 || !out[idx(root)].is_valid()) continue;
      ++components_;
      depth_[idx(root)] = 0;
      queue.assign(1, root);
      for (std::size_t i = 0; i < queue.size(); ++i) {
        const int v = queue[i];
        LoopHalfEdge h = out[idx(v)];
        do {
          const int next = mesh_.to_vertex_handle(h).idx();
          if (depth_[idx(next)] < 0) {
            depth_[idx(next)] = depth_[idx(v)] + 1;
            way_in_[idx(next)] = h;
            taken(h) = 1;
            queue.push_back(next);
          }
          h = mesh_.opposite_halfedge_handle(mesh_.prev_halfedge_handle(h));
        } while (h != out[idx(v)]);
      }
    }
  }

  void span_faces() {
    std::vector<char> reached(mesh_.n_faces(), 0);
    std::vector<int> queue;
    for (int root = 0; root < static_cast<int>(reached.size()); ++root) {
      if (std::exchange(reached[idx(root)], 1) != 0) continue;
      queue.assign(1, root);
      for (std::size_t i = 0; i < queue.size(); ++i) {
        LoopHalfEdge h = first_of(queue[i]);
        for (int k = 0; k < 3; ++k, h = mesh_.next_halfedge_handle(h)) {
          const LoopFace beyond = mesh_.opposite_face_handle(h);
          if (taken(h) != 0 || !beyond.is_valid() || reached[idx(beyond.idx())] != 0) continue;
          reached[idx(beyond.idx())] = 1;
          taken(h) = 1;
          queue.push_back(beyond.idx());
        }
      }
    }
  }

  LoopMesh mesh_;
  std::vector<LoopHalfEdge> way_in_;  // per vertex, from its parent
  std::vector<int> depth_;            // per vertex
  std::vector<char> taken_;           // per edge, by either tree
  int components_ = 0;
};

struct Counts {
  int components = 0;
  int handles = 0;
};

/// Vertices without a face count for nothing. On a closed surface 2 E = 3 F.
Counts counts_of(const Surface& surface) {
  UnionFind joined(surface.positions.rows());
  std::vector<char> used(idx(surface.positions.rows()), 0);
  int vertices = 0;
  int joints = 0;
  for (const auto& t : surface.triangles.rowwise()) {
    for (const int v : t) vertices += std::exchange(used[idx(v)], 1) == 0 ? 1 : 0;
    for (int k = 1; k < 3; ++k) joints += joined.unite(t[0], t[k]) ? 1 : 0;
  }
  const int components = vertices - joints;
  const int euler = vertices - static_cast<int>(surface.triangles.rows() / 2);
  return {components, components - euler / 2};
}

}  // namespace

HandleLoops handle_loops(const Surface& surface) {
  HandleLoops result;
  // Most surfaces have no handle: counting is much quicker than making half-edges.
  const Counts counts = counts_of(surface);
  if (counts.handles == 0) {
    result.components = counts.components;
    return result;
  }
  const TreeAndCotree trees(surface);
  result.components = trees.components();
  std::vector<int> row(idx(trees.edges()), -1);
  for (const auto& loop : trees.loops()) {
    auto& edges = result.loops.emplace_back();
    for (const int e : loop) {
      if (row[idx(e)] < 0) {
        row[idx(e)] = static_cast<int>(result.edges.size());
        result.edges.push_back(trees.ends(e));
      }
      edges.push_back(row[idx(e)]);
    }
  }
  return result;
}

}  // namespace curveskel
