#include "viewer/render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <sstream>

namespace curveskel::viewer {
namespace {

/// The factor from distance to half of the height that is seen.
float half_height(const Camera& camera) { return std::tan(camera.field_of_view / 2); }

glm::quat from_axes(const glm::vec3& right, const glm::vec3& up) {
  return glm::normalize(glm::quat_cast(glm::mat3(right, up, glm::cross(right, up))));
}

}  // namespace

Bounds bounds_of(std::span<const glm::vec3> points) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  Bounds bounds{glm::vec3(infinite), glm::vec3(-infinite)};
  for (const glm::vec3& point : points) {
    bounds.low = glm::min(bounds.low, point);
    bounds.high = glm::max(bounds.high, point);
  }
  if (!(bounds.low.x <= bounds.high.x)) return {};
  const float diagonal = bounds.diagonal();
  constexpr float thinnest = 1e-3F;  // of the diagonal
  constexpr float rounding = 1e-6F;
  const float least =
      std::max(diagonal > 0 ? thinnest * diagonal : 1.0F, rounding * glm::length(bounds.middle()));
  const glm::vec3 grow =
      glm::max(glm::vec3(0), glm::vec3(least) - (bounds.high - bounds.low)) * 0.5F;
  bounds.low -= grow;
  bounds.high += grow;
  return bounds;
}

glm::vec3 Camera::axis(int which) const { return glm::mat3_cast(orientation)[which]; }

glm::mat4 Camera::view() const {
  return glm::mat4_cast(glm::conjugate(orientation)) * glm::translate(glm::mat4(1), -eye());
}

glm::mat4 Camera::projection(float aspect, const Bounds& bounds) const {
  const float ahead = glm::dot(eye() - bounds.middle(), axis(2));
  const float radius = bounds.diagonal() * 0.55F;
  const float far = std::max(ahead + radius, 1e-3F * radius);
  if (orthographic) {
    const float high = half_height(*this) * distance;
    return glm::ortho(-high * aspect, high * aspect, -high, high, ahead - radius, far);
  }
  const float near = std::max(ahead - radius, 1e-3F * far);
  return glm::perspective(field_of_view, aspect, near, far);
}

float Camera::unit_per_pixel(int height_pixels) const {
  return 2 * half_height(*this) * distance / static_cast<float>(std::max(height_pixels, 1));
}

PickRay ray_through(const Camera& camera, float x, float y, int width, int height) {
  const float unit = camera.unit_per_pixel(height);
  const glm::vec3 beside = camera.axis(0) * ((x - static_cast<float>(width) / 2) * unit) -
                           camera.axis(1) * ((y - static_cast<float>(height) / 2) * unit);
  if (!camera.orthographic) {
    return {camera.eye(), glm::normalize(beside - camera.axis(2) * camera.distance)};
  }
  constexpr float far_off = 100;  // an orthographic eye is anywhere along its axis
  return {camera.target + beside + camera.axis(2) * camera.distance * far_off, -camera.axis(2)};
}

void orbit(Camera& camera, float right, float down) {
  constexpr float pole = std::numbers::pi_v<float> / 2;
  const float elevation =
      std::atan2(glm::dot(camera.axis(2), camera.up), glm::dot(camera.axis(1), camera.up));
  const float rise = std::clamp(elevation + down, -pole, pole) - elevation;
  camera.orientation = glm::normalize(glm::angleAxis(-right, camera.up) * camera.orientation *
                                      glm::angleAxis(-rise, glm::vec3(1, 0, 0)));
}

void pan(Camera& camera, float right, float down, int height_pixels) {
  const float unit = camera.unit_per_pixel(height_pixels);
  camera.target += (camera.axis(1) * down - camera.axis(0) * right) * unit;
}

void zoom(Camera& camera, float factor, float x, float y) {
  const float high = half_height(camera) * camera.distance;
  camera.target += (camera.axis(0) * x + camera.axis(1) * y) * (high * (1 - factor));
  camera.distance = std::max(camera.distance * factor, std::numeric_limits<float>::min());
}

void fit(Camera& camera, std::span<const glm::vec3> points, float aspect, float share) {
  if (points.empty()) return;
  const glm::mat3 to_camera = glm::transpose(glm::mat3_cast(camera.orientation));
  constexpr float infinite = std::numeric_limits<float>::infinity();
  glm::vec3 low(infinite);
  glm::vec3 high(-infinite);
  for (const glm::vec3& point : points) {
    const glm::vec3 seen = to_camera * point;
    low = glm::min(low, seen);
    high = glm::max(high, seen);
  }
  const glm::vec3 middle = (low + high) * 0.5F;
  const float tall = half_height(camera) * share;
  const float wide = tall * aspect;
  float distance = 0;
  for (const glm::vec3& point : points) {
    const glm::vec3 seen = to_camera * point - middle;
    const float needed = std::max(std::abs(seen.x) / wide, std::abs(seen.y) / tall);
    distance = std::max(distance, camera.orthographic ? needed : needed + seen.z);
  }
  camera.target = glm::mat3_cast(camera.orientation) * middle;
  const float size = glm::length(high - low);
  const float of_a_point = 0.5F / std::min(tall, wide);  // which is seen as the unit cube about it
  camera.distance =
      std::max({size > 0 ? distance : of_a_point, 1e-3F * size, 1e-6F * glm::length(middle)});
}

void look_from(Camera& camera, Side side, const glm::mat3& best) {
  camera.up = best[1];
  if (side == Side::best) {
    camera.orientation = from_axes(best[0], best[1]);
    return;
  }
  const bool z_up = std::abs(best[1].z) > std::abs(best[1].y);
  const glm::vec3 up = z_up ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  const glm::vec3 front = z_up ? glm::vec3(0, -1, 0) : glm::vec3(0, 0, 1);
  const glm::vec3 right = glm::cross(up, front);
  camera.up = up;
  const auto face = [&](const glm::vec3& to_viewer, const glm::vec3& upwards) {
    camera.orientation = from_axes(glm::cross(upwards, to_viewer), upwards);
  };
  switch (side) {
    case Side::best:
      return;
    case Side::front:
      return face(front, up);
    case Side::back:
      return face(-front, up);
    case Side::left:
      return face(right, up);  // facing us, its left is on our right
    case Side::right:
      return face(-right, up);
    case Side::top:
      return face(up, -front);
    case Side::bottom:
      return face(-up, front);
  }
}

Camera between(const Camera& from, const Camera& to, float t) {
  const float eased = t * t * (3 - 2 * t);
  Camera camera = to;
  camera.target = glm::mix(from.target, to.target, eased);
  camera.orientation = glm::normalize(glm::slerp(from.orientation, to.orientation, eased));
  camera.distance = from.distance * std::pow(to.distance / from.distance, eased);
  return camera;
}

std::optional<CameraWish> camera_wish(const std::string& text) {
  CameraWish wish;
  if (const auto side = choice_of(sides, text)) {
    wish.side = *side;
    return wish;
  }
  std::istringstream in(text);
  char comma = 0;
  if (!(in >> wish.azimuth >> comma >> wish.elevation) || comma != ',') return std::nullopt;
  if (in.peek() == ',' && !(in >> comma >> wish.zoom)) return std::nullopt;
  const bool all_read = in.eof() || in.peek() == std::istringstream::traits_type::eof();
  if (!all_read || !(wish.zoom > 0)) return std::nullopt;
  return wish;
}

}  // namespace curveskel::viewer
