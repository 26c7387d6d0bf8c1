#include "surface/mesh/whole.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "meshes/shapes.hpp"

namespace curveskel::whole_laws {
namespace {

TEST(Whole, ShapesAreWithTheTopologyThatTheyHave) {
  for (const auto& entry : shapes::catalogue()) {
    const Surface surface = entry.make().surface;
    for (const int threads : {1, 2, 5}) {
      const auto whole = topology_if_whole(surface, threads);
      ASSERT_TRUE(whole) << entry.name;
      const Topology counted = topology(surface);
      EXPECT_EQ(whole->genus, counted.genus) << entry.name;
      EXPECT_EQ(whole->component_of_vertex, counted.component_of_vertex) << entry.name;
    }
  }
}

void append_vertex(Surface& surface, const Eigen::RowVector3d& position) {
  surface.positions.conservativeResize(surface.positions.rows() + 1, 3);
  surface.positions.bottomRows(1) = position;
}

void append_face(Surface& surface, int a, int b, int c) {
  surface.triangles.conservativeResize(surface.triangles.rows() + 1, 3);
  surface.triangles.bottomRows(1) << a, b, c;
}

struct Defect {
  std::string name;
  std::function<void(Surface&)> make;
};

const std::vector<Defect>& defects() {
  static const std::vector<Defect> all = {
      {"a face is missing",
       [](Surface& s) { s.triangles.conservativeResize(s.triangles.rows() - 1, 3); }},
      {"a face is turned", [](Surface& s) { std::swap(s.triangles(5, 0), s.triangles(5, 1)); }},
      {"a face comes twice",
       [](Surface& s) { append_face(s, s.triangles(7, 0), s.triangles(7, 1), s.triangles(7, 2)); }},
      {"a face comes twice, once turned",
       [](Surface& s) { append_face(s, s.triangles(7, 1), s.triangles(7, 0), s.triangles(7, 2)); }},
      {"two faces are a component of their own",
       [](Surface& s) {
         const auto n = static_cast<int>(s.positions.rows());
         for (int i = 0; i < 3; ++i) append_vertex(s, Eigen::RowVector3d::Unit(i));
         append_face(s, n, n + 1, n + 2);
         append_face(s, n + 1, n, n + 2);
       }},
      {"a corner is repeated",
       [](Surface& s) { append_face(s, s.triangles(0, 0), s.triangles(0, 0), s.triangles(0, 1)); }},
      {"a vertex has no face",
       [](Surface& s) {
         append_vertex(s, {0, 0, 0});
       }},
      {"two vertices are one",
       [](Surface& s) {
         const auto last = static_cast<std::int32_t>(s.positions.rows()) - 1;
         for (auto& corner : s.triangles.reshaped()) {
           if (corner == last) corner = 0;
         }
         s.positions.conservativeResize(last, 3);
       }},
  };
  return all;
}

TEST(Whole, WhatNeedsMendingIsNot) {
  for (const auto& entry : shapes::catalogue()) {
    const Surface made = entry.make().surface;
    for (const Defect& defect : defects()) {
      Surface surface = made;
      defect.make(surface);
      for (const int threads : {1, 2}) {
        EXPECT_FALSE(topology_if_whole(surface, threads)) << entry.name << ": " << defect.name;
      }
    }
  }
}

TEST(Whole, NothingIsNot) { EXPECT_FALSE(topology_if_whole({}, 1)); }

}  // namespace
}  // namespace curveskel::whole_laws
