// Does fairing help? Gaussian noise along the normals of clean surfaces: the mean normal error and
// the skeleton's distance from that of the clean surface, without and with `extract --fair`; means
// over several draws of the noise, as a branch that comes or goes outweighs all else in one draw.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/fair.hpp>
#include <curveskel/read.hpp>

namespace curveskel::bench {
namespace {

Surface with_noise(const Surface& surface, double sigma, unsigned seed) {
  std::mt19937_64 random(seed);
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

/// The result of one number of iterations, over the draws.
struct Tally {
  double normal_error = 0;  // degrees
  double hausdorff = 0;     // / D
  double mean = 0;          // / D
  int fewest_tips = std::numeric_limits<int>::max();
  int most_tips = 0;
  int nearer = 0;  // draws in which the mean distance is less than without fairing
};

void study(const std::filesystem::path& file, const std::vector<int>& iterations, int draws) {
  const Surface clean_surface = clean(read_polygons(file, {}), {}).surface;
  const double diagonal = bounding_box_diagonal(clean_surface.positions);
  const Skeleton wanted = skeleton_of(clean_surface, 0);
  const double spacing = diagonal / 400;
  for (const double percent : {0.2, 0.5, 1.0}) {
    std::vector<Tally> tallies(iterations.size());
    for (int draw = 1; draw <= draws; ++draw) {
      const Surface noisy =
          with_noise(clean_surface, percent / 100 * diagonal, static_cast<unsigned>(draw));
      double unfaired_mean = 0;
      for (std::size_t i = 0; i < iterations.size(); ++i) {
        Tally& tally = tallies[i];
        FairOptions options;
        options.iterations = iterations[i];
        const Skeleton found = skeleton_of(noisy, iterations[i]);
        const double mean = mean_distance(found.curve, wanted.curve, spacing) / diagonal;
        if (iterations[i] == 0) unfaired_mean = mean;
        tally.nearer += mean < unfaired_mean ? 1 : 0;
        tally.mean += mean / draws;
        tally.hausdorff +=
            hausdorff_distance(found.curve, wanted.curve, spacing) / diagonal / draws;
        tally.normal_error += mean_normal_error_degrees(fair(noisy, options, {}), clean_surface) /
                              static_cast<double>(draws);
        tally.fewest_tips = std::min(tally.fewest_tips, found.tips);
        tally.most_tips = std::max(tally.most_tips, found.tips);
      }
    }
    std::cout << fmt::format("| {} | {} | {} |", file.stem().string(), percent, wanted.tips);
    for (std::size_t i = 0; i < iterations.size(); ++i) {
      const Tally& tally = tallies[i];
      const std::string nearer = iterations[i] == 0 ? "" : fmt::format(", {}", tally.nearer);
      std::cout << fmt::format(" {:.1f} | {:.4f}, {:.2f}{} ({}-{}) |", tally.normal_error,
                               tally.hausdorff, 1000 * tally.mean, nearer, tally.fewest_tips,
                               tally.most_tips);
    }
    std::cout << "\n" << std::flush;
  }
}

int run(int argc, char** argv) {
  CLI::App app("What fairing does to noise and to skeletons");
  std::vector<std::filesystem::path> files;
  std::vector<int> iterations{3, 10};
  int draws = 5;
  app.add_option("files", files, "clean surfaces")->required();
  app.add_option("--iterations", iterations)->capture_default_str();
  app.add_option("--draws", draws, "of the noise")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  iterations.insert(iterations.begin(), 0);
  std::string head = "| surface | noise, % D | tips |";
  std::string rule = "|---|---|---|";
  for (const int n : iterations) {
    head += n == 0 ? " normal error | off by (tips) |"
                   : fmt::format(" error, --fair {} | off by, nearer in (tips) |", n);
    rule += "---|---|";
  }
  std::cout << head << "\n" << rule << "\n";
  for (const auto& file : files) study(file, iterations, draws);
  return 0;
}

}  // namespace
}  // namespace curveskel::bench

int main(int argc, char** argv) {
  try {
    return curveskel::bench::run(argc, argv);
  } catch (const curveskel::Error& error) {
    std::cerr << error.what() << "\n";
    return 3;
  }
}
