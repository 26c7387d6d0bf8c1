// A limb with a hollow in its end, as an animal's muzzle with its mouth, has its curve up to the
// end, however deep the hollow is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/surgery.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/contract.hpp>
#include <curveskel/extract.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/embed/branches/pockets.hpp"
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/working_surface.hpp"
#include "surface/resample/canonical.hpp"

namespace curveskel::pocket_laws {
namespace {

constexpr double half_length = 5;

/// A tube along x of radius 1 with round ends; its last end has a slit at height `z` that leads
/// back along the tube and narrows all the way.
Surface tube_with_mouth(double depth, double z, double half_width, double half_height) {
  Surface tube =
      shapes::tube("tube", shapes::straight(2 * half_length), shapes::constant(1), 64).surface;
  for (auto p : tube.positions.rowwise()) {
    if (p.x() <= half_length) continue;
    const double off = std::hypot(p.y() / half_width, (p.z() - z) / half_height);
    p.x() -= depth * std::pow(std::clamp(1 - off, 0.0, 1.0), 0.7);
  }
  return tube;
}

double distance_to(const CurveSkeleton& skeleton, const Eigen::Vector3d& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& node : skeleton.nodes.rowwise()) {
    least = std::min(least, (node.transpose() - place).norm());
  }
  return least;
}

TEST(Pockets, DoNotShortenTheLimbThatTheyAreIn) {
  struct Mouth {
    double depth, z, half_width, half_height;
  };
  for (const Mouth& mouth : {Mouth{4, -0.4, 0.6, 0.25}, Mouth{6, -0.4, 0.6, 0.2},
                             Mouth{5, -0.3, 0.4, 0.3}, Mouth{7, -0.5, 0.5, 0.3}}) {
    const Extraction found =
        extract(tube_with_mouth(mouth.depth, mouth.z, mouth.half_width, mouth.half_height));
    EXPECT_TRUE(found.certificate.topology_correct() && found.certificate.inside_enough);
    EXPECT_EQ(found.certificate.tips, 2) << "depth " << mouth.depth;
    for (const double end : {-half_length, half_length}) {
      EXPECT_LT(distance_to(found.skeleton, {end, 0, 0}), 0.75)
          << "depth " << mouth.depth << ", end " << end;
    }
  }
}

/// Groups at the mean of their ball centres, cut curves at that of the edges that they cross.
std::vector<Point> middles_of(const PartitionGraph& partition, const InscribedBalls& balls) {
  std::vector<Point> middles(idx(partition.nodes()), Point::Zero());
  std::vector<double> count(middles.size(), 0);
  const auto add = [&](int node, int vertex) {
    middles[idx(node)] += balls.centres.row(vertex).transpose();
    ++count[idx(node)];
  };
  for (int v = 0; v < static_cast<int>(partition.group_of_vertex.size()); ++v) {
    add(partition.group_of_vertex[v], v);
  }
  for (int c = 0; c < static_cast<int>(partition.cut_curves.size()); ++c) {
    for (const auto& edge : partition.cut_curves[idx(c)]) {
      for (const int v : edge) add(partition.groups + c, v);
    }
  }
  for (std::size_t n = 0; n < middles.size(); ++n) middles[n] /= count[n];
  return middles;
}

/// Arcs are led round handles group by group, over one cut curve to the next: what was in the
/// pocket may not come in between.
TEST(Pockets, LeaveTheCourseOfEachArcWhole) {
  constexpr double limit = 1.15;
  for (const double depth : {4.5, 5.5, 7.0}) {
    const Surface surface = canonical_form(tube_with_mouth(depth, -0.5, 0.7, 0.25)).surface;
    const SurfaceTree tree(surface);
    const InscribedBalls balls = inscribed_balls(surface, tree, 0);
    const auto partition =
        surgery(surface, contract(surface, smoothed_centres(surface, balls, 2), {}, {}), {}, {});
    ASSERT_TRUE(partition);
    SkeletonGraph graph = skeleton_graph_of(*partition, middles_of(*partition, balls));
    const int before = graph.living_arcs();
    cut_pockets(graph, WorkingSurface(surface, balls), *partition, limit);
    ASSERT_LT(graph.living_arcs(), before) << "no leaf was all hollow, depth " << depth;
    std::set<std::pair<int, int>> touch;
    for (const auto& edge : partition->edges.rowwise()) {
      touch.insert({edge[0], edge[1]});
      touch.insert({edge[1], edge[0]});
    }
    for (const Arc& arc : graph.arcs) {
      if (!arc.alive) continue;
      std::vector<int> course{graph.nodes[idx(arc.from)].pieces.front()};
      course.insert(course.end(), arc.pieces.begin(), arc.pieces.end());
      course.push_back(graph.nodes[idx(arc.to)].pieces.front());
      for (std::size_t i = 0; i + 1 < course.size(); ++i) {
        EXPECT_TRUE(touch.contains({course[i], course[i + 1]})) << "depth " << depth;
      }
    }
  }
}

}  // namespace
}  // namespace curveskel::pocket_laws
