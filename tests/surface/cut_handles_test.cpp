#include "surface/repair/cut_handles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <stop_token>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/topology.hpp>
#include "meshes/shapes.hpp"
#include "surface/mesh/whole.hpp"
#include "tests/volumes.hpp"

namespace curveskel::cut_handles_laws {
namespace {

using volumes::Volume;

double diagonal_of(const Surface& surface) { return bounding_box_diagonal(surface.positions); }
int genus_of(const Surface& surface) { return topology(surface).total_genus(); }

/// The genus that cuts along loops up to this share of D leave a surface.
int genus_without(const Surface& surface, double longest) {
  return genus_of(cut_handles(surface, longest * diagonal_of(surface)).surface);
}

struct NoisyBody {
  std::string name;
  Surface surface;
  int genus = 0;  // without the noise
};

std::vector<NoisyBody> noisy_bodies() {
  using Point = Eigen::Vector3d;
  const auto ring = [](const Point& p) { return volumes::ring(p, 1, 0.35); };
  const auto ball = [](const Point& p) { return volumes::ball(p, Point::Zero(), 1); };
  const auto glasses = [](const Point& p) {
    return std::min(volumes::ring(p - Point(0.9, 0, 0), 0.7, 0.3),
                    volumes::ring(p + Point(0.9, 0, 0), 0.7, 0.3));
  };
  std::vector<NoisyBody> bodies;
  for (const std::uint32_t seed : {1U, 2U}) {
    const std::string name = " " + std::to_string(seed);
    const auto noisy = [&](const volumes::Field& field, const Point& half_size) {
      return volumes::largest_component(Volume(field, half_size, 0.06, 0.04, seed).surface());
    };
    bodies.push_back({"ring" + name, noisy(ring, {1.6, 1.6, 0.6}), 1});
    bodies.push_back({"ball" + name, noisy(ball, {1.3, 1.3, 1.3}), 0});
    bodies.push_back({"glasses" + name, noisy(glasses, {2.1, 1.3, 0.6}), 2});
  }
  return bodies;
}

TEST(CutHandles, ThoseOfNoiseGoAndThoseOfTheShapeStay) {
  for (const NoisyBody& body : noisy_bodies()) {
    SCOPED_TRACE(body.name);
    ASSERT_GT(genus_of(body.surface), body.genus + 10) << "no test: raise the noise";
    EXPECT_EQ(genus_without(body.surface, 0.15), body.genus);
  }
}

TEST(CutHandles, EachCutTakesOneHandleAndLeavesTheRestAsItWas) {
  for (const NoisyBody& body : noisy_bodies()) {
    SCOPED_TRACE(body.name);
    const double longest = 0.1 * diagonal_of(body.surface);
    const CutSurface cut = cut_handles(body.surface, longest);
    EXPECT_TRUE(is_whole(cut.surface, 1));
    EXPECT_EQ(topology(cut.surface).components(), 1);
    EXPECT_EQ(genus_of(cut.surface), genus_of(body.surface) - cut.handles_cut);
    EXPECT_GT(cut.handles_cut, 0);
    EXPECT_LE(cut.longest_loop, longest);
    for (Eigen::Index v = 0; v < body.surface.positions.rows(); ++v) {
      const double moved = (cut.surface.positions.row(v) - body.surface.positions.row(v)).norm();
      if (std::binary_search(cut.on_a_loop.begin(), cut.on_a_loop.end(), v)) {
        EXPECT_LE(moved, longest);
      } else {
        ASSERT_EQ(moved, 0) << v;
      }
    }
  }
}

TEST(CutHandles, AShortBridgeAndAShortTunnelGoAWireAndADeepHoleStay) {
  using Point = Eigen::Vector3d;
  // Two balls that touch by a stub above and a stub below their middle.
  const auto bridged = [](const Point& p) {
    const double balls =
        std::min(volumes::ball(p, {-1.05, 0, 0}, 1), volumes::ball(p, {1.05, 0, 0}, 1));
    const double above = volumes::rod(p, {-0.4, 0, 0.5}, {0.4, 0, 0.5}, 0.15);
    const double below = volumes::rod(p, {-0.4, 0, -0.5}, {0.4, 0, -0.5}, 0.15);
    return std::min({balls, above, below});
  };
  // A ball with a handle of wire, as long as the ball is wide.
  const auto wired = [](const Point& p) {
    return std::min({volumes::ball(p, Point::Zero(), 0.7),
                     volumes::rod(p, {0, 0.3, 0}, {1.9, 0.3, 0}, 0.12),
                     volumes::rod(p, {1.9, 0.3, 0}, {1.9, -0.3, 0}, 0.12),
                     volumes::rod(p, {1.9, -0.3, 0}, {0, -0.3, 0}, 0.12)});
  };
  // Plates with one hole each, and a block.
  const auto holed = [](double half_thickness) {
    return [half_thickness](const Point& p) {
      const Eigen::Array3d out = p.array().abs() - Eigen::Array3d(1, 1, half_thickness);
      return std::max(out.maxCoeff(), 0.13 - std::hypot(p.x() - 0.3, p.y()));
    };
  };
  const auto surface_of = [](const volumes::Field& field, const Point& half_size) {
    return volumes::largest_component(Volume(field, half_size, 0.0571).surface());
  };
  const Surface balls = surface_of(bridged, {2.2, 1.2, 1.2});
  const Surface handle = surface_of(wired, {2.2, 1, 1});
  const Surface plate = surface_of(holed(0.1), {1.2, 1.2, 0.3});
  const Surface block = surface_of(holed(0.9), {1.2, 1.2, 1.2});
  for (const Surface* one : {&balls, &handle, &plate, &block}) ASSERT_EQ(genus_of(*one), 1);
  EXPECT_EQ(genus_without(balls, 0.3), 0);
  EXPECT_EQ(genus_without(plate, 0.4), 0);
  EXPECT_EQ(genus_without(handle, 0.3), 1);
  EXPECT_EQ(genus_without(block, 0.4), 1);
}

TEST(CutHandles, WhatIsOneTubeStays) {
  for (const auto& shape :
       {shapes::torus(3, 1, 30), shapes::torus(3, 0.3, 12), shapes::linked_rings(3, 0.5, 20)}) {
    EXPECT_EQ(cut_handles(shape.surface, 0.5 * diagonal_of(shape.surface)).handles_cut, 0)
        << shape.name;
  }
}

TEST(CutHandles, ALongerLimitCutsNoFewer) {
  for (const NoisyBody& body : noisy_bodies()) {
    std::int64_t before = 0;
    for (const double longest : {0.02, 0.05, 0.1, 0.2}) {
      const double length = longest * diagonal_of(body.surface);
      const std::int64_t cut = cut_handles(body.surface, length).handles_cut;
      EXPECT_GE(cut, before) << body.name << ' ' << longest;
      before = cut;
    }
  }
}

TEST(CutHandles, RepairCutsThemIfAskedAndSaysSo) {
  const NoisyBody body = noisy_bodies().front();
  const PolygonSoup soup = soup_of(body.surface);
  EXPECT_EQ(repair(soup).repairs.handles_cut, 0);
  RepairOptions options;
  options.least_handle = 0.15;
  const RepairedSurface repaired = repair(soup, options);
  EXPECT_EQ(genus_of(repaired.surface), 1);
  EXPECT_EQ(repaired.repairs.handles_cut, genus_of(body.surface) - 1);
  EXPECT_GT(repaired.repairs.longest_handle_loop, 0);
  EXPECT_LE(repaired.repairs.longest_handle_loop, 0.15);
  ASSERT_EQ(repaired.repairs.lines.size(), 1U);
  EXPECT_NE(repaired.repairs.lines.front().find("small handles cut"), std::string::npos);
  ASSERT_EQ(repaired.vertex_of_input.size(), body.surface.positions.rows());
  EXPECT_EQ(repaired.vertex_of_input.maxCoeff(), body.surface.positions.rows() - 1);
}

TEST(CutHandles, OnlyTheComponentsNamedLoseThem) {
  const std::vector<NoisyBody> bodies = noisy_bodies();
  RepairedSurface repaired;
  Surface& both = repaired.surface;
  const Surface& first = bodies[0].surface;
  const Surface& second = bodies[1].surface;
  const auto count = first.positions.rows();
  both.positions.resize(count + second.positions.rows(), 3);
  both.positions << first.positions, second.positions.rowwise() + Eigen::RowVector3d(9, 0, 0);
  both.triangles.resize(first.triangles.rows() + second.triangles.rows(), 3);
  both.triangles << first.triangles, second.triangles.array() + static_cast<int>(count);
  repaired.vertex_of_input = Eigen::VectorXi::LinSpaced(
      both.positions.rows(), 0, static_cast<int>(both.positions.rows()) - 1);
  const auto parts = split_components(both, topology(both));
  const CutSurface cut = cut_handles(parts[1].surface, 0.15 * diagonal_of(parts[1].surface));
  const RepairedSurface left = with_handles_cut(repaired, {{1, cut}}, {});
  const Topology counted = topology(left.surface);
  EXPECT_TRUE(is_whole(left.surface, 1));
  ASSERT_EQ(counted.components(), 2);
  EXPECT_EQ(counted.genus[0], genus_of(first));
  EXPECT_EQ(counted.genus[1], bodies[1].genus);
  EXPECT_EQ(left.surface.positions.topRows(count), first.positions);
  EXPECT_EQ(left.surface.triangles.topRows(first.triangles.rows()), first.triangles);
  EXPECT_EQ(left.repairs.handles_cut, cut.handles_cut);
}

TEST(CutHandles, ARequestedStopEndsIt) {
  std::stop_source stop;
  stop.request_stop();
  const NoisyBody body = noisy_bodies().front();
  EXPECT_THROW((void)cut_handles(body.surface, 1, stop.get_token()), Cancelled);
}

}  // namespace
}  // namespace curveskel::cut_handles_laws
