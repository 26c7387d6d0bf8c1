// Surfaces as scanned volumes have them: not smoothed, with needles, and with handles of noise.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <curveskel/topology.hpp>

namespace curveskel::volumes {

/// Negative inside.
using Field = std::function<double(const Eigen::Vector3d&)>;

/// Samples of a field over a box about the origin, with noise of this standard deviation.
class Volume {
 public:
  Volume(const Field& field, const Eigen::Vector3d& half_size, double spacing, double noise = 0,
         std::uint32_t seed = 1)
      : spacing_(spacing), origin_(-half_size) {
    for (int k = 0; k < 3; ++k) count_[k] = static_cast<int>(2 * half_size[k] / spacing) + 1;
    std::mt19937 random(seed);
    for (int i = 0; i < count_.prod(); ++i) {
      // A sum of twelve is normal enough, and the same with every library.
      double sum = -6;
      for (int k = 0; k < 12; ++k) sum += static_cast<double>(random()) / 4294967296.0;
      values_.push_back(field(place(i)) + noise * sum);
    }
  }

  /// Marching tetrahedra, six to a cell (Kuhn): a closed oriented 2-manifold, if all samples on the
  /// box are outside.
  [[nodiscard]] Surface surface() const {
    std::map<std::pair<int, int>, int> vertex_of_edge;
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::array<int, 3>> faces;
    const auto vertex = [&](int inside, int outside) {
      const auto [entry, is_new] = vertex_of_edge.try_emplace(std::minmax(inside, outside),
                                                              static_cast<int>(vertices.size()));
      if (is_new) {
        const auto [a, b] = entry->first;
        const double share = value(a) / (value(a) - value(b));
        vertices.emplace_back(place(a) + share * (place(b) - place(a)));
      }
      return entry->second;
    };
    for_tetrahedra([&](std::array<int, 4> corners) {
      const auto last_inside = std::stable_partition(corners.begin(), corners.end(),
                                                     [&](int c) { return value(c) < 0; });
      const auto inside = last_inside - corners.begin();
      if (inside == 0 || inside == 4) return;
      const Eigen::Vector3d outward =
          middle(last_inside, corners.end()) - middle(corners.begin(), last_inside);
      const auto [a, b, c, d] = corners;
      const auto add = [&](int u, int v, int w) {
        const Eigen::Vector3d& p = vertices[static_cast<std::size_t>(u)];
        const Eigen::Vector3d q = vertices[static_cast<std::size_t>(v)] - p;
        const Eigen::Vector3d r = vertices[static_cast<std::size_t>(w)] - p;
        if (q.cross(r).dot(outward) < 0) std::swap(v, w);
        faces.push_back({u, v, w});
      };
      if (inside == 1) add(vertex(a, b), vertex(a, c), vertex(a, d));
      if (inside == 3) add(vertex(a, d), vertex(b, d), vertex(c, d));
      if (inside == 2) {
        add(vertex(a, c), vertex(a, d), vertex(b, d));
        add(vertex(a, c), vertex(b, d), vertex(b, c));
      }
    });
    Surface result;
    result.positions.resize(std::ssize(vertices), 3);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      result.positions.row(static_cast<Eigen::Index>(v)) = vertices[v].transpose();
    }
    result.triangles.resize(std::ssize(faces), 3);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      result.triangles.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    }
    return result;
  }

 private:
  [[nodiscard]] double value(int i) const { return values_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Eigen::Vector3d place(int i) const {
    const int layer = count_[0] * count_[1];
    const Eigen::Vector3i cell(i % count_[0], i / count_[0] % count_[1], i / layer);
    return origin_ + spacing_ * cell.cast<double>();
  }
  template <typename Corner>
  [[nodiscard]] Eigen::Vector3d middle(Corner first, Corner last) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Corner c = first; c != last; ++c) sum += place(*c);
    return sum / static_cast<double>(last - first);
  }
  template <typename Visit>
  void for_tetrahedra(const Visit& visit) const {
    const std::array<int, 3> step{1, count_[0], count_[0] * count_[1]};
    for (int i = 0; i < count_.prod(); ++i) {
      if (i % step[1] == step[1] - 1 || i / step[1] % count_[1] == count_[1] - 1) continue;
      if (i / step[2] == count_[2] - 1) break;
      std::array<std::size_t, 3> order{0, 1, 2};
      do {
        const int b = i + step[order[0]];
        const int c = b + step[order[1]];
        visit({i, b, c, c + step[order[2]]});
      } while (std::next_permutation(order.begin(), order.end()));
    }
  }

  double spacing_;
  Eigen::Vector3d origin_;
  Eigen::Vector3i count_;
  std::vector<double> values_;
};

inline Surface largest_component(const Surface& surface) {
  const Topology counted = topology(surface);
  const auto most = std::max_element(counted.vertices.begin(), counted.vertices.end());
  const auto parts = split_components(surface, counted);
  return parts[static_cast<std::size_t>(most - counted.vertices.begin())].surface;
}

inline double ball(const Eigen::Vector3d& p, const Eigen::Vector3d& centre, double radius) {
  return (p - centre).norm() - radius;
}

/// About the z axis.
inline double ring(const Eigen::Vector3d& p, double major_radius, double minor_radius) {
  return std::hypot(std::hypot(p.x(), p.y()) - major_radius, p.z()) - minor_radius;
}

/// A rod between two points.
inline double rod(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  double radius) {
  const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - along * (b - a)).norm() - radius;
}

}  // namespace curveskel::volumes
