#include "viewer/software/warm_up.hpp"

#include <epoxy/gl.h>

#include <chrono>
#include <cmath>
#include <numbers>

namespace curveskel::viewer {
namespace {

constexpr int warm_width = 320;
constexpr int warm_height = 240;

/// Of radius 1, with as many triangles as the simplest surfaces have.
ShownSurface warm_ball() {
  constexpr unsigned around = 96;
  constexpr unsigned across = 48;
  constexpr float pi = std::numbers::pi_v<float>;
  ShownSurface ball;
  std::vector<glm::uvec3> triangles;
  for (unsigned i = 0; i <= across; ++i) {
    const float polar = pi * static_cast<float>(i) / across;
    for (unsigned j = 0; j < around; ++j) {
      const float turn = 2 * pi * static_cast<float>(j) / around;
      ball.positions.emplace_back(std::sin(polar) * std::cos(turn), std::cos(polar),
                                  std::sin(polar) * std::sin(turn));
      if (i == across) continue;
      const unsigned here = i * around + j;
      const unsigned beside = i * around + (j + 1) % around;
      triangles.emplace_back(here, beside, here + around);
      triangles.emplace_back(beside, beside + around, here + around);
    }
  }
  ball.triangles = std::move(triangles);
  set_normals(ball);
  return ball;
}

ShownSkeleton warm_tube() {
  const glm::vec4 from(-1, 0, 0, 0.1F);
  const glm::vec4 to(1, 0, 0, 0.1F);
  return {{{from, to, {}, {}, {}, {}}}, {{from, from, {}, {}, {}, {}}}};
}

}  // namespace

void warm_up(Renderer& renderer, Pace& pace) {
  const ShownSurface ball = warm_ball();
  const Bounds bounds = bounds_of(ball.positions);
  Pace::Load load;
  load.triangles.fill(ball.triangles.size());
  load.pixels = warm_width * warm_height;
  Camera camera;
  fit(camera, ball.positions, float(warm_width) / warm_height);
  const auto milliseconds = [&](const Fineness& fineness) {
    orbit(camera, 0.05F, 0);  // else the glass would be the last one's
    const auto began = std::chrono::steady_clock::now();
    renderer.draw(camera, {}, {warm_width, warm_height, fineness, bounds});
    glFinish();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - began;
    return taken.count();
  };
  renderer.set_surface(Layer::given, ball);
  renderer.set_skeleton(warm_tube());
  constexpr Fineness coarse{2, 1, 1};
  for (const Fineness& fineness : {Fineness{0, 4, 1}, Fineness{0, 1, 1}, coarse}) {
    renderer.set_surface(Layer::contracted, ball);
    milliseconds(fineness);
    renderer.set_surface(Layer::contracted, {});
  }
  constexpr int enough = 3;
  for (int i = 0; i < enough; ++i) pace.measured(coarse, load, milliseconds(coarse));
  renderer.set_surface(Layer::given, {});
  renderer.set_skeleton({});
}

}  // namespace curveskel::viewer
