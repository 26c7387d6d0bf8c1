// The time and the memory of the largest surfaces: one body of millions of faces, one of
// many handles, and surfaces of very many small components.
// usage: stress [--faces N] [--handles N] [--components N] [--equal N]
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/extract.hpp>
#include <curveskel/repair.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"

namespace {

using namespace curveskel;
using shapes::Shape;

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1e3;
}

/// Balls, tori and rods of all sizes, 20 to 200 vertices each, in a cubic grid.
Shape crowd(int components) {
  shapes::Random random(1);
  const int side = static_cast<int>(std::ceil(std::cbrt(components)));
  const std::vector<Shape> kinds{shapes::ellipsoid({1, 1, 1}, 1), shapes::ellipsoid({2, 1, 0.7}, 2),
                                 shapes::torus(1.5, 0.5, 5),
                                 shapes::tube("", shapes::straight(3), shapes::constant(0.5), 6),
                                 shapes::torus(1.2, 0.6, 8)};
  std::vector<Shape> parts;
  for (int c = 0; c < components; ++c) {
    const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
    Shape part = shapes::rotated(kinds[random.index(kinds.size())], axis, random.uniform(0, 3));
    part = shapes::scaled(std::move(part), std::exp(random.uniform(-3, 0)));
    const int row = c / side;
    const int layer = row / side;
    parts.push_back(
        shapes::translated(std::move(part), 5.0 * Eigen::Vector3d(c % side, row % side, layer)));
  }
  return shapes::together("crowd", parts);
}

/// Balls and boxes of one size, 42 to 98 vertices each, on a jittered grid.
Shape equals(int components) {
  shapes::Random random(1);
  const int side = static_cast<int>(std::ceil(std::cbrt(components)));
  const std::vector<Shape> kinds{shapes::ellipsoid({1, 1, 1}, 1), shapes::box({1.5, 1.5, 1.5}, 4)};
  std::vector<Shape> parts;
  for (int c = 0; c < components; ++c) {
    const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
    const Eigen::Vector3d cell(c % side, c / side % side, c / side / side);
    const Eigen::Vector3d jitter(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    parts.push_back(shapes::translated(
        shapes::rotated(kinds[random.index(2)], axis, random.uniform(0, 3)), 4 * cell + jitter));
  }
  return shapes::together("balls and boxes of one size", parts);
}

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void measure(const Shape& shape) {
  const PolygonSoup soup = soup_of(shape.surface);
  const auto start = std::chrono::steady_clock::now();
  const double processor_before = processor_seconds();
  const RepairedSurface repaired = repair(soup, {}, {});
  const double repair_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Extraction found = extract(repaired.surface, {}, {});
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double processor = processor_seconds() - processor_before;
  double working = 0;
  for (const ComponentRecord& component : found.components) working += component.working_vertices;
  std::printf("| %s | %td | %d | %d | %.0f | %.1f (%.1f) | %.0f | %s |\n", shape.name.c_str(),
              shape.surface.triangles.rows(), shape.components, shape.genus, working, seconds,
              processor, peak_megabytes(),
              found.certificate.topology_correct() && found.certificate.genus == shape.genus
                  ? "right"
                  : "WRONG");
  std::printf("  repair %.1f", repair_seconds);
  for (const StageTime& time : found.times) {
    std::printf("  %s %.1f", time.stage.c_str(), time.seconds);
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** values) {
  int faces = 2000000;
  int handles = 1024;
  int components = 20000;
  int equal = 20000;
  CLI::App program("Seconds and memory of large surfaces; 0 leaves one out");
  program.add_option("--faces", faces, "of one body: a network of tubes");
  program.add_option("--handles", handles, "of one body: a plate with so many holes, about");
  program.add_option("--components", components, "of one surface, of all sizes");
  program.add_option("--equal", equal, "components of one surface, all of one size");
  CLI11_PARSE(program, count, values);
  std::printf(
      "| surface | faces | components | genus | working vertices | s (processor) | MB at most so "
      "far | "
      "topology |\n|---|---|---|---|---|---|---|---|\n");
  if (faces > 0) {
    Shape network = shapes::tube_union("network", shapes::random_graph(7, 40, 12, 1), {0.25, 1.7});
    while (network.surface.triangles.rows() < faces)
      network = shapes::subdivided(std::move(network));
    measure(network);
  }
  if (handles > 0) {
    Shape plate = shapes::sieve(static_cast<int>(std::lround(std::sqrt(handles))));
    while (plate.surface.triangles.rows() < 200000) plate = shapes::subdivided(std::move(plate));
    measure(plate);
  }
  if (components > 0) measure(crowd(components));
  if (equal > 0) measure(equals(equal));
}
