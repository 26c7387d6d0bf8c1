// Tubes swept along curves; frames by double reflection (Wang et al. 2008).
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "meshes/shapes.hpp"

namespace curveskel::shapes {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

struct Ring {
  Vector3d centre;
  Vector3d tangent;
  Vector3d side;  ///< unit, normal to the tangent: where the ring's first vertex lies
  double radius;
};

Vector3d tangent_at(const Curve& curve, double t, bool closed) {
  constexpr double step = 1e-5;
  double before = t - step;
  double after = t + step;
  if (closed) {
    before -= std::floor(before);
    after -= std::floor(after);
  } else {
    before = std::max(before, 0.0);
    after = std::min(after, 1.0);
  }
  return (curve(after) - curve(before)).normalized();
}

// Parameters of rings whose distance is the distance of the vertices round them.
std::vector<double> ring_parameters(const Curve& curve, const Profile& radius, int sides,
                                    bool closed) {
  constexpr int samples = 20'000;
  std::vector<double> rings_until(samples + 1, 0);
  for (int i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    const double step = (curve(t + 1.0 / samples) - curve(t)).norm();
    rings_until[static_cast<std::size_t>(i) + 1] =
        rings_until[static_cast<std::size_t>(i)] + step * sides / (2 * pi * radius(t));
  }
  const int count = std::max(3, static_cast<int>(std::lround(rings_until.back())));
  std::vector<double> parameters;
  for (int i = 0; i < count + (closed ? 0 : 1); ++i) {
    const double wanted = rings_until.back() * (static_cast<double>(i) / count);
    const auto after = std::lower_bound(rings_until.begin(), rings_until.end(), wanted);
    const auto index = std::max<std::ptrdiff_t>(after - rings_until.begin(), 1);
    const double low = rings_until[static_cast<std::size_t>(index) - 1];
    const double high = rings_until[static_cast<std::size_t>(index)];
    parameters.push_back((static_cast<double>(index - 1) + (wanted - low) / (high - low)) /
                         samples);
  }
  return parameters;
}

Vector3d transported(const Ring& from, const Vector3d& centre, const Vector3d& tangent) {
  const auto reflect = [](const Vector3d& v, const Vector3d& mirror) -> Vector3d {
    const double square = mirror.squaredNorm();
    return square == 0 ? v : Vector3d(v - 2 * mirror.dot(v) / square * mirror);
  };
  const Vector3d along = centre - from.centre;
  const Vector3d side = reflect(from.side, along);
  return reflect(side, tangent - reflect(from.tangent, along)).normalized();
}

std::vector<Ring> ring_frames(const Curve& curve, const Profile& radius, int sides, bool closed) {
  const std::vector<double> parameters = ring_parameters(curve, radius, sides, closed);
  std::vector<Ring> rings;
  for (const double t : parameters) {
    Ring ring{curve(t), tangent_at(curve, t, closed), Vector3d::Zero(), radius(t)};
    ring.side = rings.empty() ? ring.tangent.unitOrthogonal()
                              : transported(rings.back(), ring.centre, ring.tangent);
    rings.push_back(ring);
  }
  if (closed) {  // The frame comes back turned: spread that turn over all rings.
    const Ring& first = rings.front();
    const Vector3d back = transported(rings.back(), first.centre, first.tangent);
    const double turn = std::atan2(first.tangent.dot(first.side.cross(back)), first.side.dot(back));
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const double angle = -turn * static_cast<double>(i) / static_cast<double>(rings.size());
      rings[i].side = Eigen::AngleAxisd(angle, rings[i].tangent) * rings[i].side;
    }
  }
  return rings;
}

class Sweep {
 public:
  explicit Sweep(int sides) : sides_(sides) {}

  void ring(const Vector3d& centre, const Ring& frame, double radius) {
    const Vector3d other = frame.tangent.cross(frame.side);
    for (int j = 0; j < sides_; ++j) {
      const double angle = 2 * pi * j / sides_;
      points_.emplace_back(centre +
                           radius * (std::cos(angle) * frame.side + std::sin(angle) * other));
    }
    ++rings_;
  }

  void close() { strip(rings_ - 1, 0); }

  Surface capped(const Vector3d& first_pole, const Vector3d& last_pole) {
    const auto first = static_cast<int>(points_.size());
    points_.push_back(first_pole);
    points_.push_back(last_pole);
    for (int j = 0; j < sides_; ++j) {
      const int next = (j + 1) % sides_;
      faces_.push_back({first, next, j});
      faces_.push_back({first + 1, (rings_ - 1) * sides_ + j, (rings_ - 1) * sides_ + next});
    }
    return surface();
  }

  Surface surface() {
    for (int i = 0; i + 1 < rings_; ++i) strip(i, i + 1);
    Surface result;
    result.positions.resize(static_cast<Eigen::Index>(points_.size()), 3);
    for (std::size_t i = 0; i < points_.size(); ++i)
      result.positions.row(static_cast<Eigen::Index>(i)) = points_[i].transpose();
    result.triangles.resize(static_cast<Eigen::Index>(faces_.size()), 3);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      result.triangles.row(static_cast<Eigen::Index>(i)) << faces_[i][0], faces_[i][1],
          faces_[i][2];
    return result;
  }

 private:
  void strip(int from, int to) {
    for (int j = 0; j < sides_; ++j) {
      const int next = (j + 1) % sides_;
      const int a = from * sides_ + j;
      const int b = from * sides_ + next;
      const int c = to * sides_ + next;
      const int d = to * sides_ + j;
      if ((from + j) % 2 == 0) {
        faces_.push_back({a, b, c});
        faces_.push_back({a, c, d});
      } else {
        faces_.push_back({a, b, d});
        faces_.push_back({b, c, d});
      }
    }
  }

  int sides_;
  int rings_ = 0;
  std::vector<Vector3d> points_;
  std::vector<std::array<int, 3>> faces_;
};

CurveSkeleton axis_of(const std::vector<Ring>& rings, bool closed) {
  const auto count = static_cast<Eigen::Index>(rings.size());
  CurveSkeleton axis;
  axis.nodes.resize(count, 3);
  axis.radii.resize(count);
  axis.edges.resize(closed ? count : count - 1, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    axis.nodes.row(i) = rings[static_cast<std::size_t>(i)].centre.transpose();
    axis.radii[i] = rings[static_cast<std::size_t>(i)].radius;
  }
  Eigen::Index row = 0;
  const auto add = [&](Eigen::Index i, Eigen::Index j) {
    axis.edges.row(row++) << static_cast<std::int32_t>(i), static_cast<std::int32_t>(j);
  };
  add(0, 1);
  if (closed) add(0, count - 1);
  for (Eigen::Index i = 1; i + 1 < count; ++i) add(i, i + 1);
  return axis;
}

}  // namespace

Curve straight(double length) {
  return [=](double t) { return Vector3d(length * (t - 0.5), 0, 0); };
}

Curve arc(double radius, double angle) {
  return [=](double t) {
    return Vector3d(radius * std::cos(angle * t), radius * std::sin(angle * t), 0);
  };
}

Curve s_curve(double length, double width) {
  return
      [=](double t) { return Vector3d(length * (t - 0.5), width / 2 * std::sin(2 * pi * t), 0); };
}

Curve helix(double radius, double pitch, double turns) {
  return [=](double t) {
    const double angle = 2 * pi * turns * t;
    return Vector3d(radius * std::cos(angle), radius * std::sin(angle), pitch * turns * (t - 0.5));
  };
}

Curve circle(double radius) { return arc(radius, 2 * pi); }

Curve trefoil(double scale) {
  return [=](double t) {
    const double a = 2 * pi * t;
    return Vector3d(scale * Vector3d(std::sin(a) + 2 * std::sin(2 * a),
                                     std::cos(a) - 2 * std::cos(2 * a), -std::sin(3 * a)));
  };
}

Profile constant(double radius) {
  return [=](double) { return radius; };
}

Profile tapered(double first, double last) {
  return [=](double t) { return first + (last - first) * t; };
}

Profile wavy(double radius, double amplitude, double waves) {
  return [=](double t) { return radius + amplitude * std::sin(2 * pi * waves * t); };
}

Shape tube(std::string name, const Curve& curve, const Profile& radius, int sides) {
  const bool closed = (curve(0) - curve(1)).norm() < 1e-9 * (curve(0.5) - curve(0)).norm();
  const std::vector<Ring> rings = ring_frames(curve, radius, sides, closed);
  Sweep sweep(sides);
  Shape shape;
  shape.name = std::move(name);
  shape.axis = axis_of(rings, closed);
  shape.genus = shape.cycles = closed ? 1 : 0;
  shape.tips = closed ? 0 : 2;
  shape.junctions = 0;
  if (closed) {
    for (const Ring& ring : rings) sweep.ring(ring.centre, ring, ring.radius);
    sweep.close();
    shape.surface = sweep.surface();
    return shape;
  }
  const int latitudes = std::max(2, sides / 4);
  const auto cap_ring = [&](const Ring& ring, int step, double sign) {
    const double latitude = pi / 2 * step / latitudes;
    sweep.ring(ring.centre + sign * ring.radius * std::sin(latitude) * ring.tangent, ring,
               ring.radius * std::cos(latitude));
  };
  for (int i = latitudes - 1; i > 0; --i) cap_ring(rings.front(), i, -1);
  for (const Ring& ring : rings) sweep.ring(ring.centre, ring, ring.radius);
  for (int i = 1; i < latitudes; ++i) cap_ring(rings.back(), i, 1);
  const Ring& a = rings.front();
  const Ring& b = rings.back();
  shape.surface = sweep.capped(a.centre - a.radius * a.tangent, b.centre + b.radius * b.tangent);
  return shape;
}

Shape torus(double major_radius, double minor_radius, int around) {
  return tube("torus", circle(major_radius), constant(minor_radius), around);
}

Shape linked_rings(double major_radius, double minor_radius, int around) {
  const Shape ring = torus(major_radius, minor_radius, around);
  const Shape other =
      translated(rotated(ring, Vector3d::UnitX(), pi / 2), Vector3d(major_radius, 0, 0));
  return together("linked-rings", {ring, other});
}

}  // namespace curveskel::shapes
