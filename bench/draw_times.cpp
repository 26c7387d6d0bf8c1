// The time of a picture, by its content: milliseconds, the median of some, as CSV.
// usage: draw_times MESH [WIDTH HEIGHT]
#include <epoxy/gl.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <utility>
#include <vector>

#include "viewer/headless/headless.hpp"
#include "viewer/model/document.hpp"
#include "viewer/render/renderer.hpp"
#include "viewer/render/scene.hpp"

namespace {

using namespace curveskel;
using namespace curveskel::viewer;

double median_milliseconds(Scene& scene, Renderer& renderer, const Renderer::Frame& frame) {
  constexpr int pictures = 7;
  std::vector<double> times;
  for (int i = 0; i <= pictures; ++i) {
    orbit(scene.camera, 0.05F, 0);
    const auto began = std::chrono::steady_clock::now();
    renderer.draw(scene.camera, scene.look_now(), frame);
    glFinish();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - began;
    if (i > 0) times.push_back(taken.count());  // the first one compiles shaders
  }
  std::nth_element(times.begin(), times.begin() + pictures / 2, times.end());
  return times[pictures / 2];
}

int run(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: draw_times MESH [WIDTH HEIGHT]\n");
    return 2;
  }
  Scene scene(open_document({argv[1]}, Monitor{}));
  const HeadlessContext context;
  Renderer renderer;
  scene.upload(renderer);
  const int width = argc > 3 ? std::atoi(argv[2]) : 1000;
  const int height = argc > 3 ? std::atoi(argv[3]) : 800;
  fit(scene.camera, scene.points(), static_cast<float>(width) / static_cast<float>(height));
  fmt::print("driver,surface,triangles,samples,shrink,milliseconds\n");
  for (const auto& style : surface_styles) {
    for (int level = 0; level < Pace::levels; ++level) {
      for (const auto& [samples, shrink] : {std::pair(4, 1), std::pair(1, 1), std::pair(1, 2)}) {
        scene.look.surface = style.value;
        const double time = median_milliseconds(
            scene, renderer,
            {width / shrink, height / shrink, {level, samples, shrink}, scene.bounds()});
        fmt::print("{},{},{},{},{},{:.2f}\n", gl_name(), style.name,
                   scene.sizes()[static_cast<std::size_t>(level)], samples, shrink, time);
      }
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
}
