#include "viewer/model/defects.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

namespace curveskel::viewer {
namespace {

/// Asks now and then for a stop, within sorts, too.
class Heed {
 public:
  explicit Heed(const Monitor& monitor) : monitor_(monitor) {}
  void operator()() {
    constexpr unsigned every = 1U << 16U;
    if (++calls_ % every == 0) throw_if_stopped(monitor_.stop);
  }

 private:
  const Monitor& monitor_;
  unsigned calls_ = 0;
};

/// For each vertex the lowest one at its place.
std::vector<int> places_of(const Positions& positions, Heed& heed) {
  std::vector<int> order(static_cast<std::size_t>(positions.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int v) {
    return std::array{positions(v, 0), positions(v, 1), positions(v, 2)};
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    heed();
    return std::pair(key(a), a) < std::pair(key(b), b);
  });
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    place[static_cast<std::size_t>(order[i])] =
        same ? place[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return place;
}

struct FaceEdge {
  std::array<int, 2> ends;  // lower first
  int face;
  bool upwards;  // from the lower end to the higher one
};

bool has_area(const Surface& surface, const std::array<int, 3>& corners) {
  const auto at = [&](int corner) -> Eigen::Vector3d {
    return surface.positions.row(corners[static_cast<std::size_t>(corner)]);
  };
  return (at(1) - at(0)).cross(at(2) - at(0)).squaredNorm() > 0;
}

void sort_out(std::vector<int>& faces) {
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

}  // namespace

Defects defects_of(const Surface& surface, const Monitor& monitor) {
  Heed heed(monitor);
  const std::vector<int> place = places_of(surface.positions, heed);
  Defects defects;
  std::vector<FaceEdge> face_edges;
  face_edges.reserve(3 * static_cast<std::size_t>(surface.triangles.rows()));
  for (int face = 0; face < static_cast<int>(surface.triangles.rows()); ++face) {
    std::array<int, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] =
          place[static_cast<std::size_t>(surface.triangles(face, static_cast<Eigen::Index>(c)))];
    }
    if (!has_area(surface, corners)) defects.degenerate.push_back(face);
    for (std::size_t c = 0; c < 3; ++c) {
      const int a = corners[c];
      const int b = corners[(c + 1) % 3];
      if (a != b) face_edges.push_back({{std::min(a, b), std::max(a, b)}, face, a < b});
    }
  }
  std::sort(face_edges.begin(), face_edges.end(), [&](const FaceEdge& a, const FaceEdge& b) {
    heed();
    return a.ends != b.ends ? a.ends < b.ends : a.face < b.face;
  });
  for (std::size_t first = 0; first < face_edges.size();) {
    std::size_t last = first;
    while (last < face_edges.size() && face_edges[last].ends == face_edges[first].ends) ++last;
    const std::size_t count = last - first;
    const bool same_way = count == 2 && face_edges[first].upwards == face_edges[first + 1].upwards;
    for (std::size_t i = first; i < last; ++i) {
      if (count == 1) defects.open.push_back(face_edges[i].face);
      if (count > 2) defects.non_manifold.push_back(face_edges[i].face);
      if (same_way) defects.flipped.push_back(face_edges[i].face);
    }
    first = last;
  }
  sort_out(defects.open);
  sort_out(defects.non_manifold);
  sort_out(defects.flipped);
  return defects;
}

}  // namespace curveskel::viewer
