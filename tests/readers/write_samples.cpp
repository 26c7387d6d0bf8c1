// usage: write_samples FOLDER: replaces FOLDER by every sample skeleton in every format,
// NAME.FORMAT, and what it is in NAME.truth: "node x y z radius" and "edge i j" lines, numbers as
// hexadecimal floats.
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include <curveskel/advanced/write_file.hpp>
#include <curveskel/skeleton_files.hpp>
#include "tests/skeleton/skeleton_samples.hpp"

namespace {

std::string hexadecimal(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), " %a", value);
  return text.data();
}

std::string truth_of(const curveskel::CurveSkeleton& skeleton) {
  std::string text;
  for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) {
    text += "node";
    for (const double value : skeleton.nodes.row(node)) text += hexadecimal(value);
    text += skeleton.radii.size() > 0 ? hexadecimal(skeleton.radii(node)) : " none";
    text += '\n';
  }
  for (const auto& edge : skeleton.edges.rowwise()) {
    text += "edge " + std::to_string(edge(0)) + " " + std::to_string(edge(1)) + "\n";
  }
  return text;
}

/// A tetrahedron round nothing: pictures need a surface.
curveskel::Surface tetrahedron() {
  curveskel::Surface surface;
  surface.positions.resize(4, 3);
  surface.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  surface.triangles.resize(4, 3);
  surface.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  return surface;
}

}  // namespace

int main(int count, char** arguments) {
  using namespace curveskel;
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const Surface surface = tetrahedron();
  const SkeletonContext context{&surface, "a <test> & more -- here",
                                R"({"parameters": {"detail": 0.5}, "certificate": {"genus": 0}})"};
  for (const auto& [name, skeleton] : skeleton_samples()) {
    write_file(folder / (name + ".truth"), truth_of(skeleton));
    for (const auto& format : skeleton_formats) {
      const bool picture =
          format.value == SkeletonFormat::png || format.value == SkeletonFormat::svg;
      if (picture && name != "tripod") continue;
      write_file(folder / (name + "." + std::string(format.name)),
                 format_skeleton(skeleton, format.value, context));
    }
  }
}
