// usage: read_cgal FOLDER: CGAL's stream operators read .cgal, its PLY reader points and radii.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/read_ply_points.h>
#include <CGAL/property_map.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/skeleton/skeleton_samples.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using PointAndRadius = std::pair<Point, double>;
using Segments = std::set<std::pair<Point, Point>>;

Point point_of(const curveskel::CurveSkeleton& skeleton, int node) {
  return {skeleton.nodes(node, 0), skeleton.nodes(node, 1), skeleton.nodes(node, 2)};
}

/// As in the examples of CGAL's Mesh_3: a count and so many points per line.
std::pair<std::set<Point>, Segments> polylines_in(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::set<Point> points;
  Segments segments;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::size_t count = 0;
    words >> count;
    std::vector<Point> chain;
    for (Point point; words >> point;) chain.push_back(point);
    if (chain.size() != count) throw std::runtime_error(file.string() + ": wrong count");
    points.insert(chain.begin(), chain.end());
    for (std::size_t k = 1; k < chain.size(); ++k) {
      segments.insert(std::minmax(chain[k - 1], chain[k]));
    }
  }
  return {points, segments};
}

bool polylines_agree(const std::filesystem::path& file, const curveskel::CurveSkeleton& skeleton) {
  std::set<Point> points;
  Segments segments;
  for (int node = 0; node < skeleton.nodes.rows(); ++node) points.insert(point_of(skeleton, node));
  for (const auto& edge : skeleton.edges.rowwise()) {
    segments.insert(std::minmax(point_of(skeleton, edge(0)), point_of(skeleton, edge(1))));
  }
  return polylines_in(file) == std::make_pair(points, segments);
}

bool ply_agrees(const std::filesystem::path& file, const curveskel::CurveSkeleton& skeleton) {
  std::vector<PointAndRadius> points;
  std::ifstream stream(file);
  const auto coordinates = [] {
    return CGAL::make_ply_point_reader(CGAL::First_of_pair_property_map<PointAndRadius>());
  };
  const bool radii = skeleton.radii.size() > 0;
  const bool read = radii ? CGAL::IO::read_PLY_with_properties<PointAndRadius>(
                                stream, std::back_inserter(points), coordinates(),
                                std::make_pair(CGAL::Second_of_pair_property_map<PointAndRadius>(),
                                               CGAL::PLY_property<double>("radius")))
                          : CGAL::IO::read_PLY_with_properties<PointAndRadius>(
                                stream, std::back_inserter(points), coordinates());
  bool same = read && std::ssize(points) == skeleton.nodes.rows();
  for (int node = 0; same && node < skeleton.nodes.rows(); ++node) {
    const auto& [point, radius] = points[static_cast<std::size_t>(node)];
    same = point == point_of(skeleton, node) && (!radii || radius == skeleton.radii(node));
  }
  return same;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  int failed = 0;
  for (const auto& [name, skeleton] : curveskel::skeleton_samples()) {
    const bool polylines = polylines_agree(folder / (name + ".cgal"), skeleton);
    const bool ply = ply_agrees(folder / (name + ".ply"), skeleton);
    if (!polylines) std::printf("FAILED: %s.cgal differs\n", name.c_str());
    if (!ply) std::printf("FAILED: %s.ply differs\n", name.c_str());
    failed += polylines && ply ? 0 : 1;
  }
  return failed == 0 ? 0 : 1;
}
