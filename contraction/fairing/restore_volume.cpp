// M. Desbrun, M. Meyer, P. Schroeder, A. Barr: Implicit fairing of irregular meshes using diffusion
// and curvature flow, SIGGRAPH 1999 (scale).
#include "contraction/fairing/restore_volume.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/topology.hpp>

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

[[noreturn]] void fail(const std::string& what, double found, double target, VolumeRule rule) {
  char text[120];
  std::snprintf(text, sizeof text,
                " was faired to the volume %.3g, from which %s cannot restore %.3g", found,
                std::string(name_of(volume_rules, rule)).c_str(), target);
  throw Error(Fault::solver, what + text + "; take fewer iterations, or keep the volume as it is");
}

}  // namespace

void restore_volume(Surface& surface, const Positions& before, const std::vector<bool>& held,
                    VolumeRule rule) {
  if (rule == VolumeRule::keep) return;
  const Topology parts = topology(surface);
  std::vector<Component> components = split_components(surface, parts);
  for (std::size_t i = 0; i < components.size(); ++i) {
    auto& [component, vertex_in_whole] = components[i];
    Surface original{Positions(component.positions.rows(), 3), component.triangles};
    bool closed = component.triangles.rows() > 0;
    for (std::size_t v = 0; v < vertex_in_whole.size(); ++v) {
      closed = closed && !held[static_cast<std::size_t>(vertex_in_whole[v])];
      original.positions.row(static_cast<Eigen::Index>(v)) = before.row(vertex_in_whole[v]);
    }
    const double target = volume(original);
    if (!closed || target == 0) continue;
    const double found = volume(component);
    Restoration restoration(component, target);
    // The second step takes away the rounding of the first.
    for (int step = 0; step < 3 && !restoration.done(); ++step) {
      const bool moved = rule == VolumeRule::offset ? restoration.offset() : restoration.scale();
      if (moved) continue;
      fail(components.size() == 1 ? "the surface" : "component " + std::to_string(i), found, target,
           rule);
    }
    for (std::size_t v = 0; v < vertex_in_whole.size(); ++v) {
      surface.positions.row(vertex_in_whole[v]) =
          component.positions.row(static_cast<Eigen::Index>(v));
    }
  }
}

}  // namespace curveskel
