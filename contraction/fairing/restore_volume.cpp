// M. Desbrun, M. Meyer, P. Schroeder, A. Barr: Implicit fairing of irregular meshes using diffusion
// and curvature flow, SIGGRAPH 1999 (scale).
#include "contraction/fairing/restore_volume.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>

namespace curveskel {
namespace {

double triple(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return a.dot(b.cross(c));
}

/// The root of c0 + c1 h + c2 h^2 + c3 h^3 that Newton's method finds from 0, if it does before
/// |h| exceeds the limit.
std::optional<double> root_near_zero(const Eigen::Vector4d& c, double limit) {
  double h = 0;
  for (int step = 0; step < 50; ++step) {
    const double value = c[0] + h * (c[1] + h * (c[2] + h * c[3]));
    const double slope = c[1] + h * (2 * c[2] + h * 3 * c[3]);
    const double change = value / slope;
    h -= change;
    if (!std::isfinite(h) || std::abs(h) > limit) return std::nullopt;
    if (std::abs(change) <= 1e-15 * std::abs(h) || value == 0) return h;
  }
  return std::nullopt;
}

class Restoration {
 public:
  Restoration(Surface& component, double target) : surface_(component), target_(target) {}

  [[nodiscard]] bool done() const {
    return std::abs(volume(surface_) - target_) <= 1e-12 * std::abs(target_);
  }

  bool scale() {
    const double ratio = target_ / volume(surface_);
    if (!(ratio > 0) || !std::isfinite(ratio)) return false;
    const Eigen::RowVector3d centre = surface_.positions.colwise().mean();
    const double factor = std::cbrt(ratio);
    surface_.positions = ((surface_.positions.rowwise() - centre) * factor).rowwise() + centre;
    return true;
  }

  /// Along the unit vertex normals, all by the same length: the volume is a cubic of it.
  bool offset() {
    const Positions normals = vertex_normals(surface_);
    const Eigen::RowVector3d origin = surface_.positions.colwise().mean();
    Eigen::Vector4d cubic = Eigen::Vector4d::Zero();
    for (Eigen::Index f = 0; f < surface_.triangles.rows(); ++f) {
      Eigen::Matrix3d p;
      Eigen::Matrix3d n;
      for (int k = 0; k < 3; ++k) {
        p.col(k) = (surface_.positions.row(surface_.triangles(f, k)) - origin).transpose();
        n.col(k) = normals.row(surface_.triangles(f, k)).transpose();
      }
      cubic[0] += triple(p.col(0), p.col(1), p.col(2));
      cubic[1] += triple(n.col(0), p.col(1), p.col(2)) + triple(p.col(0), n.col(1), p.col(2)) +
                  triple(p.col(0), p.col(1), n.col(2));
      cubic[2] += triple(p.col(0), n.col(1), n.col(2)) + triple(n.col(0), p.col(1), n.col(2)) +
                  triple(n.col(0), n.col(1), p.col(2));
      cubic[3] += triple(n.col(0), n.col(1), n.col(2));
    }
    cubic /= 6;
    cubic[0] -= target_;
    const auto h = root_near_zero(cubic, bounding_box_diagonal(surface_.positions));
    if (h) surface_.positions += *h * normals;
    return h.has_value();
  }

 private:
  Surface& surface_;
  double target_;
};

/// Of the volume that was, before it is restored, and of the area, once it is: surfaces within
/// these limits have their old shape (docs/study/fairing.md, "What is too coarse").
constexpr double least_volume_kept = 0.1;
constexpr double most_volume_kept = 2;
constexpr double most_area = 1.5;
constexpr double least_volume = 1e-12;  // in the unit box; below lies the rounding of its sum

/// Takes the component to the volume of `original`; false where it cannot be done, or should not.
bool restore(Surface& component, const Surface& original, VolumeRule rule) {
  const double wanted = volume(original);
  const double kept = volume(component) / wanted;
  if (!(kept >= least_volume_kept && kept <= most_volume_kept)) return false;
  Restoration restoration(component, wanted);
  // The second step takes away the rounding of the first.
  for (int step = 0; step < 3 && !restoration.done(); ++step) {
    const bool moved = rule == VolumeRule::offset ? restoration.offset() : restoration.scale();
    if (!moved) return false;
  }
  return area(component) <= most_area * area(original);
}

Positions rows_of(const Positions& positions, const std::vector<int>& rows) {
  Positions result(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.row(static_cast<Eigen::Index>(i)) = positions.row(rows[i]);
  }
  return result;
}

}  // namespace

std::vector<bool> restore_volume(Surface& surface, const Topology& parts, const Positions& before,
                                 const std::vector<bool>& held, VolumeRule rule) {
  std::vector<bool> failed(idx(parts.components()));
  if (rule == VolumeRule::keep) return failed;
  std::vector<Component> components = split_components(surface, parts);
  for (std::size_t i = 0; i < components.size(); ++i) {
    auto& [component, vertex_in_whole] = components[i];
    const bool closed = std::none_of(vertex_in_whole.begin(), vertex_in_whole.end(),
                                     [&](int v) -> bool { return held[idx(v)]; });
    if (!closed) continue;
    const Surface original{rows_of(before, vertex_in_whole), component.triangles};
    if (std::abs(volume(original)) <= least_volume) continue;
    failed[i] = !restore(component, original, rule);
    for (std::size_t v = 0; v < vertex_in_whole.size(); ++v) {
      surface.positions.row(vertex_in_whole[v]) =
          component.positions.row(static_cast<Eigen::Index>(v));
    }
  }
  return failed;
}

}  // namespace curveskel
