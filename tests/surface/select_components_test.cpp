// Laws of specks: beside what they lie in, or else beside what they touch, as by asking each.
#include "surface/repair/select_components.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stop_token>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"
#include "surface/mesh/component_areas.hpp"

namespace curveskel::select_components_laws {
namespace {

/// Boxes of sides over three powers of ten, each elsewhere on a lattice, so that some only touch;
/// many of one size, as leaves have.
RepairedSurface scene_of_boxes(int count, unsigned seed) {
  std::mt19937 draw(seed);
  constexpr std::size_t side = 16;
  std::vector<int> cells(side * side * side);
  std::iota(cells.begin(), cells.end(), 0);
  std::shuffle(cells.begin(), cells.end(), draw);
  std::vector<shapes::Shape> boxes;
  for (int k = 0; k < count; ++k) {
    const double size = k % 3 == 0 ? 1 : std::pow(10, 3 * double(draw()) / double(draw.max()) - 2);
    const int cell = cells[idx(k)];
    const Eigen::Vector3i place(cell % 16, cell / 16 % 16, cell / 256);
    boxes.push_back(shapes::translated(shapes::box({size, size, size}, 1), place.cast<double>()));
  }
  RepairedSurface scene;
  scene.surface = shapes::together("boxes", boxes).surface;
  const auto vertices = static_cast<int>(scene.surface.positions.rows());
  scene.vertex_of_input = Eigen::VectorXi::LinSpaced(vertices, 0, vertices - 1);
  return scene;
}

/// By component, asking each of each.
std::vector<bool> specks_in(const Surface& surface, const Topology& counted, double least) {
  const std::vector<double> area = component_areas(surface, counted);
  std::vector<Eigen::AlignedBox3d> boxes(area.size());
  for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
    boxes[idx(counted.component_of_vertex[v])].extend(surface.positions.row(v).transpose());
  }
  const double largest = *std::max_element(area.begin(), area.end());
  std::vector<bool> specks;
  for (std::size_t c = 0; c < area.size(); ++c) {
    double holds = 0;
    double meets = 0;
    for (std::size_t other = 0; other < area.size(); ++other) {
      if (other == c || !boxes[other].intersects(boxes[c])) continue;
      meets = std::max(meets, area[other]);
      if (boxes[other].contains(boxes[c].center())) holds = std::max(holds, area[other]);
    }
    const double about = holds > 0 ? holds : meets;
    specks.push_back(area[c] < least * (about > 0 ? std::min(about, largest) : largest));
  }
  return specks;
}

TEST(Specks, AreThoseThatAskingEachOfEachFinds) {
  constexpr double least = 0.01;
  for (const int count : {2, 9, 65, 700}) {
    RepairedSurface scene = scene_of_boxes(count, unsigned(count));
    const Topology counted = topology(scene.surface);
    const std::vector<bool> specks = specks_in(scene.surface, counted, least);
    leave_out_components(scene, {0, least, true, 0, 0}, {});
    EXPECT_EQ(scene.repairs.specks_dropped, std::count(specks.begin(), specks.end(), true))
        << count;
    for (Eigen::Index v = 0; v < scene.vertex_of_input.size(); ++v) {
      ASSERT_EQ(scene.vertex_of_input[v] < 0, specks[idx(counted.component_of_vertex[v])])
          << "vertex " << v << " of " << count << " boxes";
    }
  }
}

TEST(Specks, AreLookedForUntilAStop) {
  RepairedSurface scene = scene_of_boxes(65, 65);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(leave_out_components(scene, {0, 0.01, true, 0, 0}, stop.get_token()), Cancelled);
}

}  // namespace
}  // namespace curveskel::select_components_laws
