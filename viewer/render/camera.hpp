// The viewer's camera: a turntable about a target.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>

#include <curveskel/advanced/names.hpp>

namespace curveskel::viewer {

enum class Side { best, front, back, left, right, top, bottom };

inline constexpr NameTable<Side, 7> sides{{
    {Side::best, "best", "along the axis of least extent"},
    {Side::front, "front", "against +z, or against -y for what stands on z"},
    {Side::back, "back", "from behind"},
    {Side::left, "left", "the shape's left side"},
    {Side::right, "right", "the shape's right side"},
    {Side::top, "top", "from above"},
    {Side::bottom, "bottom", "from below"},
}};

/// The box of the things in view; it never is empty.
struct Bounds {
  glm::vec3 low{-0.5F};
  glm::vec3 high{0.5F};
  [[nodiscard]] glm::vec3 middle() const { return (low + high) * 0.5F; }
  [[nodiscard]] float diagonal() const { return glm::length(high - low); }
};

/// Of finite points; a unit cube about nothing or a single place, and never thinner than rounding
/// allows.
[[nodiscard]] Bounds bounds_of(std::span<const glm::vec3> points);

/// Lengths in model units. `orientation` takes camera axes (x right, y up, z to the viewer) to
/// model axes.
struct Camera {
  glm::vec3 target{0};
  glm::quat orientation{1, 0, 0, 0};
  glm::vec3 up{0, 1, 0};       ///< axis of the turntable, in the model
  float distance = 3;          ///< from the target, > 0
  float field_of_view = 0.5F;  ///< of the height, in radians
  bool orthographic = false;

  [[nodiscard]] glm::vec3 axis(int which) const;  ///< 0 right, 1 up, 2 to the viewer
  [[nodiscard]] glm::vec3 eye() const { return target + axis(2) * distance; }
  [[nodiscard]] glm::mat4 view() const;
  /// `bounds`: the box that must lie between the clipping planes.
  [[nodiscard]] glm::mat4 projection(float aspect, const Bounds& bounds) const;
  /// Model units per pixel at the target.
  [[nodiscard]] float unit_per_pixel(int height_pixels) const;
};

/// A pixel's ray.
struct PickRay {
  glm::vec3 origin;
  glm::vec3 direction;  ///< unit vector
};
/// `x`, `y` in pixels from the upper left corner.
[[nodiscard]] PickRay ray_through(const Camera& camera, float x, float y, int width, int height);

/// Turns by a drag, in radians: about the up axis, then about the camera's right; never past the
/// poles.
void orbit(Camera& camera, float right, float down);
/// Moves the target with the pointer, in pixels.
void pan(Camera& camera, float right, float down, int height_pixels);
/// Nearer for factor < 1; the point under (x, y), in -1..1 of the picture's half height, stays.
void zoom(Camera& camera, float factor, float x, float y);
/// The distance and target for which the points fill `share` of the picture.
void fit(Camera& camera, std::span<const glm::vec3> points, float aspect, float share = 0.92F);
/// Looks at a side; `best` is the rows right, up, to the viewer of the first view.
void look_from(Camera& camera, Side side, const glm::mat3& best);
/// Between two cameras, t in 0..1, eased.
[[nodiscard]] Camera between(const Camera& from, const Camera& to, float t);

/// "front", or "AZIMUTH,ELEVATION[,ZOOM]" in degrees from the best view. Nothing if it is neither.
struct CameraWish {
  Side side = Side::best;
  float azimuth = 0;    ///< degrees to the right about the up axis
  float elevation = 0;  ///< degrees upwards
  float zoom = 1;       ///< > 1 = nearer
};
[[nodiscard]] std::optional<CameraWish> camera_wish(const std::string& text);

}  // namespace curveskel::viewer
