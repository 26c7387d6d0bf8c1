// Laws of the camera, held over random cameras, points and pictures.
#include "viewer/render/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace curveskel::viewer::camera_laws {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int seeds = 60;
constexpr std::array aspects{0.3F, 1.0F, 1.6F, 4.0F};

class Random {
 public:
  explicit Random(int seed) : engine_(static_cast<unsigned>(seed)) {}
  float within(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine_);
  }
  float magnitude(float low, float high) { return std::exp(within(std::log(low), std::log(high))); }
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
  bool flip() { return below(2) == 1; }
  glm::vec3 in_box(const glm::vec3& half) {
    return {within(-half.x, half.x), within(-half.y, half.y), within(-half.z, half.z)};
  }

 private:
  std::mt19937 engine_;
};

/// Rows right, up, to the viewer of a shape that stands on y or on z.
glm::mat3 upright(bool z_up) {
  return z_up ? glm::mat3({1, 0, 0}, {0, 0, 1}, {0, -1, 0}) : glm::mat3(1);
}

Camera random_camera(Random& random, float size = 1) {
  Camera camera;
  const auto side = sides[static_cast<std::size_t>(random.below(7))].value;
  look_from(camera, side, upright(random.flip()));
  orbit(camera, random.within(-pi, pi), random.within(-1, 1));
  camera.target = random.in_box(glm::vec3(3 * size));
  camera.distance = size * random.magnitude(0.5F, 20);
  camera.field_of_view = random.within(0.1F, 1.4F);
  camera.orthographic = random.flip();
  return camera;
}

std::vector<glm::vec3> random_points(Random& random) {
  const float size = random.magnitude(1e-4F, 1e4F);
  const std::array<glm::vec3, 4> forms{
      {{1, 1, 1}, {1, 0.01F, 0.3F}, {0.002F, 1, 0.5F}, {0.2F, 0.1F, 1}}};
  const glm::vec3 half = forms[static_cast<std::size_t>(random.below(4))] * size;
  const glm::vec3 middle = random.in_box(glm::vec3(10 * size));
  std::vector<glm::vec3> points(100);
  for (glm::vec3& point : points) point = middle + random.in_box(half);
  return points;
}

std::array<glm::vec3, 8> corners_of(const Bounds& bounds) {
  std::array<glm::vec3, 8> corners{};
  for (unsigned i = 0; i < 8; ++i) {
    corners[i] = {(i & 1U) != 0 ? bounds.high.x : bounds.low.x,
                  (i & 2U) != 0 ? bounds.high.y : bounds.low.y,
                  (i & 4U) != 0 ? bounds.high.z : bounds.low.z};
  }
  return corners;
}

glm::vec3 seen(const Camera& camera, const glm::vec3& point) {
  return {camera.view() * glm::vec4(point, 1)};
}

/// -1..1 in the picture, right and up; z between the clipping planes.
glm::vec3 projected(const Camera& camera, const glm::vec3& point, float aspect,
                    const Bounds& bounds) {
  const glm::vec4 at = camera.projection(aspect, bounds) * camera.view() * glm::vec4(point, 1);
  return glm::vec3(at) / at.w;
}

glm::vec2 pixel_of(const Camera& camera, const glm::vec3& point, int width, int height) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const glm::vec3 at = projected(camera, point, aspect, bounds_of(std::span(&point, 1)));
  return {(at.x + 1) / 2 * static_cast<float>(width), (1 - at.y) / 2 * static_cast<float>(height)};
}

/// Where the plane through the target is met; x, y in -1..1 of half the height.
glm::vec3 on_target_plane(const Camera& camera, float x, float y) {
  const float high = std::tan(camera.field_of_view / 2) * camera.distance;
  return camera.target + (camera.axis(0) * x + camera.axis(1) * y) * high;
}

void expect_orthonormal(const Camera& camera) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(glm::length(camera.axis(i)), 1, 1e-5F);
    EXPECT_NEAR(glm::dot(camera.axis(i), camera.axis((i + 1) % 3)), 0, 1e-5F);
  }
  EXPECT_GT(glm::dot(glm::cross(camera.axis(0), camera.axis(1)), camera.axis(2)), 0);
}

float elevation_of(const Camera& camera) {
  return std::atan2(glm::dot(camera.axis(2), camera.up), glm::dot(camera.axis(1), camera.up));
}

TEST(Camera, MovesKeepItsAxesOrthonormalAndTheHorizonLevel) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Camera camera = random_camera(random);
    for (int move = 0; move < 300; ++move) {
      orbit(camera, random.within(-1, 1), random.within(-1, 1));
      pan(camera, random.within(-50, 50), random.within(-50, 50), 400);
      zoom(camera, random.within(0.8F, 1.25F), random.within(-1, 1), random.within(-1, 1));
    }
    expect_orthonormal(camera);
    EXPECT_NEAR(glm::dot(camera.axis(0), camera.up), 0, 1e-4F);
  }
}

TEST(Orbit, NeverPassesAPole) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Camera camera = random_camera(random);
    for (int move = 0; move < 100; ++move) {
      const float most = random.flip() ? 0.1F : 4;
      orbit(camera, random.within(-most, most), random.within(-most, most));
      EXPECT_GE(glm::dot(camera.axis(1), camera.up), -1e-4F) << "move " << move;
    }
  }
}

TEST(Orbit, RisesByTheAngleUpToThePole) {
  for (const bool z_up : {false, true}) {
    for (const auto& side : {Side::best, Side::front, Side::left, Side::back}) {
      for (int eighths = -24; eighths <= 24; ++eighths) {
        const float down = static_cast<float>(eighths) / 8;
        Camera camera;
        look_from(camera, side, upright(z_up));
        orbit(camera, 0.7F, down);
        EXPECT_NEAR(elevation_of(camera), std::clamp(down, -pi / 2, pi / 2), 1e-3F)
            << name_of(sides, side) << " by " << down;
      }
    }
  }
}

TEST(Orbit, LeavesThePolesOfTopAndBottom) {
  for (const bool z_up : {false, true}) {
    for (const auto& [side, down] : {std::pair(Side::top, -0.5F), std::pair(Side::bottom, 0.5F)}) {
      Camera camera;
      look_from(camera, side, upright(z_up));
      orbit(camera, 0, down);
      EXPECT_NEAR(std::abs(elevation_of(camera)), pi / 2 - 0.5F, 1e-3F);
    }
  }
}

TEST(Orbit, AboutTheUpAxisAllAroundComesBack) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Camera before = random_camera(random);
    Camera camera = before;
    for (int step = 0; step < 36; ++step) {
      orbit(camera, 2 * pi / 36, 0);
      EXPECT_NEAR(elevation_of(camera), elevation_of(before), 1e-3F);
    }
    EXPECT_LT(glm::length(camera.axis(2) - before.axis(2)), 1e-4F);
    EXPECT_EQ(camera.target, before.target);
  }
}

TEST(Pan, TakesThePointUnderThePointerAlong) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Camera camera = random_camera(random);
    const glm::vec3 point = on_target_plane(camera, random.within(-1, 1), random.within(-1, 1));
    const glm::vec2 from = pixel_of(camera, point, 600, 400);
    const glm::vec2 by(random.within(-99, 99), random.within(-99, 99));
    pan(camera, by.x, by.y, 400);
    EXPECT_LT(glm::length(pixel_of(camera, point, 600, 400) - (from + by)), 0.05F);
  }
}

TEST(Zoom, KeepsThePointUnderThePointer) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Camera camera = random_camera(random);
    const glm::vec2 pointer(random.within(-1.5F, 1.5F), random.within(-1, 1));
    const glm::vec3 point = on_target_plane(camera, pointer.x, pointer.y);
    const glm::vec2 before = pixel_of(camera, point, 600, 400);
    const float distance = camera.distance;
    const float factor = random.magnitude(0.2F, 5);
    zoom(camera, factor, pointer.x, pointer.y);
    EXPECT_LT(glm::length(pixel_of(camera, point, 600, 400) - before), 0.05F);
    EXPECT_NEAR(camera.distance / distance, factor, 1e-5F * factor);
  }
}

TEST(Zoom, NeverReachesTheTarget) {
  Camera camera;
  for (int i = 0; i < 10000; ++i) zoom(camera, 0.5F, 0.3F, 0.1F);
  EXPECT_GT(camera.distance, 0);
  EXPECT_TRUE(std::isfinite(camera.target.x));
}

TEST(Fit, FillsItsShareOfThePictureAndNoMore) {
  for (int seed = 0; seed < seeds; ++seed) {
    for (const float aspect : aspects) {
      for (const bool orthographic : {false, true}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", aspect " + std::to_string(aspect) +
                     (orthographic ? ", orthographic" : ", perspective"));
        Random random(seed);
        const std::vector<glm::vec3> points = random_points(random);
        Camera camera = random_camera(random);
        camera.orthographic = orthographic;
        const float share = random.within(0.5F, 1);
        fit(camera, points, aspect, share);
        float furthest = 0;
        for (const glm::vec3& point : points) {
          if (!orthographic) {
            ASSERT_LT(seen(camera, point).z, 0);
          }
          const glm::vec3 at = projected(camera, point, aspect, bounds_of(points));
          furthest = std::max({furthest, std::abs(at.x), std::abs(at.y)});
        }
        EXPECT_NEAR(furthest, share, 2e-3F);
      }
    }
  }
}

TEST(Fit, LeavesTheCameraAloneWithoutPoints) {
  Camera camera;
  fit(camera, {}, 1.6F);
  EXPECT_EQ(camera.target, Camera{}.target);
  EXPECT_EQ(camera.distance, Camera{}.distance);
}

TEST(Fit, OfOnePointLooksAtIt) {
  for (const bool orthographic : {false, true}) {
    const glm::vec3 point(3, -4, 5);
    Camera camera;
    camera.orthographic = orthographic;
    fit(camera, std::span(&point, 1), 1.6F);
    EXPECT_LT(glm::length(camera.target - point), 1e-5F);
    const float depth = projected(camera, point, 1.6F, bounds_of(std::span(&point, 1))).z;
    EXPECT_LE(std::abs(depth), 1) << "it is clipped away";
  }
}

TEST(Projection, PlanesContainTheBounds) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Bounds bounds = bounds_of(random_points(random));
    Camera camera = random_camera(random, bounds.diagonal());
    camera.target += bounds.middle();
    float furthest = 0;
    for (const glm::vec3& corner : corners_of(bounds)) {
      furthest = std::max(furthest, -seen(camera, corner).z);
    }
    for (const glm::vec3& corner : corners_of(bounds)) {
      // A perspective cannot have what is at the eye or behind it.
      if (!camera.orthographic && -seen(camera, corner).z < 3e-3F * furthest) continue;
      const float depth = projected(camera, corner, 1.5F, bounds).z;
      EXPECT_GE(depth, -1);
      EXPECT_LE(depth, 1);
    }
  }
}

TEST(Projection, TellsNearFromFar) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::vector<glm::vec3> points = random_points(random);
    Camera camera = random_camera(random);
    fit(camera, points, 1.5F);
    const Bounds bounds = bounds_of(points);
    const float step = 1e-3F * bounds.diagonal();
    const float near = projected(camera, bounds.middle() + camera.axis(2) * step, 1.5F, bounds).z;
    const float far = projected(camera, bounds.middle() - camera.axis(2) * step, 1.5F, bounds).z;
    EXPECT_LT(near, far);
  }
}

TEST(Bounds, ContainTheirPointsAndAreNeverFlat) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::vector<glm::vec3> points = random_points(random);
    const int flat = random.below(4);
    for (glm::vec3& point : points) {
      for (int axis = 0; axis < flat; ++axis) point[axis] = points[0][axis];
    }
    const Bounds bounds = bounds_of(points);
    for (const glm::vec3& point : points) {
      EXPECT_EQ(glm::clamp(point, bounds.low, bounds.high), point);
    }
    for (int axis = 0; axis < 3; ++axis) EXPECT_GT(bounds.high[axis], bounds.low[axis]);
  }
  EXPECT_GT(bounds_of({}).diagonal(), 0);
  const glm::vec3 origin(0);
  EXPECT_GT(bounds_of(std::span(&origin, 1)).diagonal(), 0);
}

TEST(RayThrough, MeetsThePointThatIsSeenThere) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::vector<glm::vec3> points = random_points(random);
    Camera camera = random_camera(random);
    constexpr int width = 640;
    constexpr int height = 400;
    fit(camera, points, 1.6F);
    const Bounds bounds = bounds_of(points);
    for (const glm::vec3& point : points) {
      const glm::vec2 pixel = pixel_of(camera, point, width, height);
      const PickRay ray = ray_through(camera, pixel.x, pixel.y, width, height);
      EXPECT_NEAR(glm::length(ray.direction), 1, 1e-5F);
      const glm::vec3 to_point = point - ray.origin;
      EXPECT_GT(glm::dot(to_point, ray.direction), 0);
      EXPECT_LT(glm::length(glm::cross(to_point, ray.direction)), 1e-3F * bounds.diagonal());
    }
  }
}

struct SideSeen {
  Side side;
  glm::vec3 to_viewer;
  glm::vec3 upwards;
};

TEST(LookFrom, ShowsTheSideOfWhatStandsOnY) {
  const std::array<SideSeen, 7> expected{{{Side::best, {0, 0, 1}, {0, 1, 0}},
                                          {Side::front, {0, 0, 1}, {0, 1, 0}},
                                          {Side::back, {0, 0, -1}, {0, 1, 0}},
                                          {Side::left, {1, 0, 0}, {0, 1, 0}},
                                          {Side::right, {-1, 0, 0}, {0, 1, 0}},
                                          {Side::top, {0, 1, 0}, {0, 0, -1}},
                                          {Side::bottom, {0, -1, 0}, {0, 0, 1}}}};
  for (const SideSeen& one : expected) {
    Camera camera;
    look_from(camera, one.side, upright(false));
    expect_orthonormal(camera);
    EXPECT_LT(glm::length(camera.axis(2) - one.to_viewer), 1e-6F) << name_of(sides, one.side);
    EXPECT_LT(glm::length(camera.axis(1) - one.upwards), 1e-6F) << name_of(sides, one.side);
  }
}

TEST(LookFrom, ShowsTheSideOfWhatStandsOnZ) {
  const std::array<SideSeen, 7> expected{{{Side::best, {0, -1, 0}, {0, 0, 1}},
                                          {Side::front, {0, -1, 0}, {0, 0, 1}},
                                          {Side::back, {0, 1, 0}, {0, 0, 1}},
                                          {Side::left, {1, 0, 0}, {0, 0, 1}},
                                          {Side::right, {-1, 0, 0}, {0, 0, 1}},
                                          {Side::top, {0, 0, 1}, {0, 1, 0}},
                                          {Side::bottom, {0, 0, -1}, {0, -1, 0}}}};
  for (const SideSeen& one : expected) {
    Camera camera;
    look_from(camera, one.side, upright(true));
    expect_orthonormal(camera);
    EXPECT_LT(glm::length(camera.axis(2) - one.to_viewer), 1e-6F) << name_of(sides, one.side);
    EXPECT_LT(glm::length(camera.axis(1) - one.upwards), 1e-6F) << name_of(sides, one.side);
  }
}

TEST(Between, EndsAtItsEndsAndStaysACamera) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Camera from = random_camera(random);
    const Camera to = random_camera(random);
    const auto expect_same_place = [](const Camera& found, const Camera& wanted) {
      EXPECT_LT(glm::length(found.target - wanted.target), 1e-5F);
      EXPECT_NEAR(found.distance, wanted.distance, 1e-4F * wanted.distance);
      for (int i = 0; i < 3; ++i) {
        EXPECT_LT(glm::length(found.axis(i) - wanted.axis(i)), 1e-4F);
      }
    };
    expect_same_place(between(from, to, 0), from);
    expect_same_place(between(from, to, 1), to);
    float least = std::numeric_limits<float>::infinity();
    float most = 0;
    for (int step = 0; step <= 16; ++step) {
      const Camera camera = between(from, to, static_cast<float>(step) / 16);
      expect_orthonormal(camera);
      least = std::min(least, camera.distance);
      most = std::max(most, camera.distance);
    }
    EXPECT_GE(least, 0.999F * std::min(from.distance, to.distance));
    EXPECT_LE(most, 1.001F * std::max(from.distance, to.distance));
  }
}

TEST(CameraWish, KnowsEverySide) {
  for (const auto& side : sides) {
    const auto wish = camera_wish(std::string(side.name));
    ASSERT_TRUE(wish) << side.name;
    EXPECT_EQ(wish->side, side.value);
    EXPECT_EQ(wish->azimuth, 0);
    EXPECT_EQ(wish->zoom, 1);
  }
}

TEST(CameraWish, ReadsAngles) {
  const auto two = camera_wish("-30,12.5");
  ASSERT_TRUE(two);
  EXPECT_EQ(two->azimuth, -30);
  EXPECT_EQ(two->elevation, 12.5F);
  EXPECT_EQ(two->zoom, 1);
  const auto three = camera_wish("0,-90,2.5");
  ASSERT_TRUE(three);
  EXPECT_EQ(three->elevation, -90);
  EXPECT_EQ(three->zoom, 2.5F);
}

TEST(CameraWish, RefusesTheRest) {
  for (const char* text :
       {"", "up", "Front", "30", "30,", ",30", "30;20", "30,20,", "30,20,0", "30,20,-1",
        "30,20,1,1", "30,20 1", "a,b", "nan,0", "0,inf", "1e99,0", "30,20,1x", "front,back"}) {
    EXPECT_FALSE(camera_wish(text)) << text;
  }
}

}  // namespace
}  // namespace curveskel::viewer::camera_laws
