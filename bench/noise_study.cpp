// Does fairing help? Gaussian noise along the normals of clean surfaces: the mean normal error and
// the skeleton's distance from that of the clean surface, without and with `extract --fair`.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "contraction/fair.hpp"
#include "skeleton/certificate.hpp"
#include "skeleton/extract.hpp"
#include "surface/clean.hpp"
#include "surface/error.hpp"
#include "surface/measures.hpp"
#include "surface/read.hpp"

namespace curveskel::bench {
namespace {

Surface with_noise(const Surface& surface, double sigma) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> length(0, sigma);
  const Positions normals = vertex_normals(surface);
  Surface noisy = surface;
  for (Eigen::Index v = 0; v < noisy.positions.rows(); ++v) {
    noisy.positions.row(v) += length(random) * normals.row(v);
  }
  return noisy;
}

double mean_normal_error_degrees(const Surface& surface, const Surface& clean) {
  double sum = 0;
  double weight = 0;
  for (Eigen::Index f = 0; f < clean.triangles.rows(); ++f) {
    const auto normal = [&](const Surface& s) -> Eigen::Vector3d {
      const Eigen::Vector3d a = s.positions.row(s.triangles(f, 0));
      const Eigen::Vector3d b = s.positions.row(s.triangles(f, 1));
      const Eigen::Vector3d c = s.positions.row(s.triangles(f, 2));
      return (b - a).cross(c - a);
    };
    const Eigen::Vector3d wanted = normal(clean);
    const Eigen::Vector3d found = normal(surface);
    sum += wanted.norm() * std::atan2(found.cross(wanted).norm(), found.dot(wanted));
    weight += wanted.norm();
  }
  return sum / weight * 180 / std::numbers::pi;
}

struct Skeleton {
  CurveSkeleton curve;
  int tips = 0;
};

Skeleton skeleton_of(const Surface& surface, int iterations) {
  ExtractOptions options;
  options.fairing = iterations > 0;
  options.fair.iterations = iterations;
  auto extraction = extract(surface, options, {});
  return {std::move(extraction.skeleton), extraction.certificate.tips};
}

void study(const std::filesystem::path& file, const std::vector<int>& iterations) {
  const Surface clean_surface = clean(read_polygons(file, {}), {}).surface;
  const double diagonal = bounding_box_diagonal(clean_surface.positions);
  const Skeleton wanted = skeleton_of(clean_surface, 0);
  // Hausdorff, and the mean in thousandths of D.
  const auto distances = [&](const Skeleton& found) {
    const double spacing = diagonal / 400;
    return fmt::format("{:.4f}, {:.1f}",
                       hausdorff_distance(found.curve, wanted.curve, spacing) / diagonal,
                       1000 * mean_distance(found.curve, wanted.curve, spacing) / diagonal);
  };
  for (const double percent : {0.2, 0.5, 1.0}) {
    const Surface noisy = with_noise(clean_surface, percent / 100 * diagonal);
    const Skeleton unfaired = skeleton_of(noisy, 0);
    std::string row = fmt::format("| {} | {} | {:.1f} | {} ({}, {}) |", file.stem().string(),
                                  percent, mean_normal_error_degrees(noisy, clean_surface),
                                  distances(unfaired), unfaired.tips, wanted.tips);
    for (const int n : iterations) {
      FairOptions options;
      options.iterations = n;
      const Skeleton faired = skeleton_of(noisy, n);
      row += fmt::format(" {:.1f} | {} ({}) |",
                         mean_normal_error_degrees(fair(noisy, options, {}), clean_surface),
                         distances(faired), faired.tips);
    }
    std::cout << row << "\n" << std::flush;
  }
}

int run(int argc, char** argv) {
  CLI::App app("What fairing does to noise and to skeletons");
  std::vector<std::filesystem::path> files;
  std::vector<int> iterations{3, 10};
  app.add_option("files", files, "clean surfaces")->required();
  app.add_option("--iterations", iterations)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::string head = "| surface | noise, % D | normal error | skeleton off by (tips, wanted) |";
  std::string rule = "|---|---|---|---|";
  for (const int n : iterations) {
    head += fmt::format(" error, --fair {} | off by (tips) |", n);
    rule += "---|---|";
  }
  std::cout << head << "\n" << rule << "\n";
  for (const auto& file : files) study(file, iterations);
  return 0;
}

}  // namespace
}  // namespace curveskel::bench

int main(int argc, char** argv) { return curveskel::bench::run(argc, argv); }
