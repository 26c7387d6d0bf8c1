#include "contraction/flow/collapsible_mesh.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <curveskel/error.hpp>
#include "surface/mesh/half_edges.hpp"

namespace curveskel {

CollapsibleMesh::CollapsibleMesh(const Triangles& triangles, int vertices)
    : from_(triangles.data(), triangles.data() + triangles.size()),
      outgoing_(vertices, -1),
      mark_(vertices, 0) {
  HalfEdges paired = pair_half_edges(triangles, vertices);
  twin_ = std::move(paired.twin);
  for (int h = 0; h < count(); ++h) {
    outgoing_[from(h)] = h;
    if (twin(h) >= 0 && from(twin(h)) != to(h)) fail(h, "faces of opposite orientation");
    if (twin(h) < 0 && paired.crowded_edges > 0) fail(h, "one or more than two faces");
  }
}

void CollapsibleMesh::fail(int h, const std::string& found) const {
  throw Error(Fault::input, "edge (" + std::to_string(from(h)) + ", " + std::to_string(to(h)) +
                                ") has " + found +
                                "; two that agree are needed: clean the surface first");
}

void CollapsibleMesh::glue(int a, int b) {
  twin_[a] = b;
  twin_[b] = a;
}

bool CollapsibleMesh::can_collapse(int h) const {
  const int a = from(h);
  const int stamp = ++stamp_;
  int valence_a = 0;
  int e = h;
  do {
    mark_[to(e)] = stamp;
    ++valence_a;
    e = around(e);
  } while (e != h);

  int valence_b = 0;
  int common = 0;
  const int t = twin_[h];
  e = t;
  do {
    const int other = to(e);
    if (other != a && mark_[other] == stamp) ++common;
    ++valence_b;
    e = around(e);
  } while (e != t);
  return common == 2 && (valence_a > 3 || valence_b > 3);
}

void CollapsibleMesh::collapse(int h) {
  const int t = twin_[h];
  const int a = from(h);
  const int b = to(h);
  for (int e = around(t); e != t; e = around(e)) from_[e] = a;

  // The two triangles that vanish: each leaves one edge where it had two.
  const int h1 = next(h);
  const int h2 = prev(h);
  const int t1 = next(t);
  const int t2 = prev(t);
  const int c = from(h2);
  const int d = from(t2);
  const int ac = twin_[h2];  // a -> c
  const int ca = twin_[h1];  // c -> a, was c -> b
  const int da = twin_[t1];  // d -> a
  const int ad = twin_[t2];  // a -> d, was b -> d
  glue(ac, ca);
  glue(ad, da);
  outgoing_[a] = ac;
  outgoing_[c] = ca;
  outgoing_[d] = da;
  outgoing_[b] = -1;
  for (const int e : {h, h1, h2, t, t1, t2}) from_[e] = -1;
}

std::vector<int> CollapsibleMesh::compact() {
  std::vector<int> new_vertex(outgoing_.size(), -1);
  int vertices = 0;
  for (std::size_t v = 0; v < outgoing_.size(); ++v) {
    if (outgoing_[v] >= 0) new_vertex[v] = vertices++;
  }
  std::vector<int> new_half(from_.size(), -1);
  int halves = 0;
  for (int h = 0; h < count(); ++h) {
    if (alive(h)) new_half[h] = halves++;
  }
  for (int h = 0; h < count(); ++h) {
    if (!alive(h)) continue;
    from_[new_half[h]] = new_vertex[from_[h]];
    twin_[new_half[h]] = new_half[twin_[h]];
  }
  for (std::size_t v = 0; v < outgoing_.size(); ++v) {
    if (new_vertex[v] >= 0) outgoing_[new_vertex[v]] = new_half[outgoing_[v]];
  }
  from_.resize(halves);
  twin_.resize(halves);
  outgoing_.resize(vertices);
  mark_.assign(vertices, 0);
  stamp_ = 0;
  return new_vertex;
}

Triangles CollapsibleMesh::triangles() const {
  return Eigen::Map<const Triangles>(from_.data(), count() / 3, 3);
}

}  // namespace curveskel
