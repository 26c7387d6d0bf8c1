// Laws of colours: those of surface and skeleton agree, whatever they show.
#include "viewer/render/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "tests/viewer/extracted_shapes.hpp"

namespace curveskel::viewer::scene_colours_laws {
namespace {

using namespace extracted_shapes;

Look look_by(ColourBy by) {
  Look look;
  look.surface_colour = look.skeleton_colour = by;
  look.skeleton = SkeletonStyle::balls;  // a ball for every node, in their order
  return look;
}

/// Branches that have this node.
std::set<Rgba> branch_colours_at(const CurveSkeleton& skeleton, int node) {
  std::set<Rgba> colours;
  const std::vector<Branch> all = branches(skeleton);
  for (std::size_t b = 0; b < all.size(); ++b) {
    const auto& nodes = all[b].nodes;
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) {
      colours.insert(rgba(category(b)));
    }
  }
  return colours;
}

TEST(SurfaceColours, AreThoseOfTheirNodes) {
  for (const Extracted& one : family()) {
    SCOPED_TRACE(one.name);
    for (const ColourBy by : {ColourBy::component, ColourBy::node, ColourBy::radius}) {
      SCOPED_TRACE(name_of(colourings, by));
      const Look look = look_by(by);
      const ShownSkeleton shown = shown_skeleton(one.skeleton, {}, 10, look, {});
      ASSERT_EQ(shown.nodes.size(), static_cast<std::size_t>(one.skeleton.nodes.rows()));
      const std::vector<Rgba> colours = surface_colours(one.surface, {&one.skeleton}, look, {});
      ASSERT_EQ(colours.size(), static_cast<std::size_t>(one.surface.positions.rows()));
      for (std::size_t v = 0; v < colours.size(); ++v) {
        const int node = one.skeleton.node_of_vertex[static_cast<Eigen::Index>(v)];
        EXPECT_EQ(colours[v], shown.nodes[static_cast<std::size_t>(node)].from_colour);
      }
    }
  }
}

TEST(SurfaceColours, ByBranchAreThoseOfABranchOfTheirNodes) {
  for (const Extracted& one : family()) {
    SCOPED_TRACE(one.name);
    const std::vector<Rgba> colours =
        surface_colours(one.surface, {&one.skeleton}, look_by(ColourBy::branch), {});
    ASSERT_EQ(colours.size(), static_cast<std::size_t>(one.surface.positions.rows()));
    for (std::size_t v = 0; v < colours.size(); ++v) {
      const int node = one.skeleton.node_of_vertex[static_cast<Eigen::Index>(v)];
      EXPECT_TRUE(branch_colours_at(one.skeleton, node).contains(colours[v]));
    }
  }
}

TEST(SkeletonColours, OfAnEdgeByBranchAreThoseOfItsBranch) {
  for (const Extracted& one : family()) {
    SCOPED_TRACE(one.name);
    const ShownSkeleton shown = shown_skeleton(one.skeleton, {}, 10, look_by(ColourBy::branch), {});
    const std::vector<Branch> all = branches(one.skeleton);
    std::set<std::pair<std::pair<int, int>, Rgba>> expected;
    for (std::size_t b = 0; b < all.size(); ++b) {
      for (std::size_t i = 1; i < all[b].nodes.size(); ++i) {
        expected.insert({std::minmax(all[b].nodes[i - 1], all[b].nodes[i]), rgba(category(b))});
      }
    }
    std::set<std::pair<std::pair<int, int>, Rgba>> found;
    for (std::size_t e = 0; e < shown.edges.size(); ++e) {
      const auto row = static_cast<Eigen::Index>(e);
      EXPECT_EQ(shown.edges[e].from_colour, shown.edges[e].to_colour);
      found.insert(
          {{one.skeleton.edges(row, 0), one.skeleton.edges(row, 1)}, shown.edges[e].from_colour});
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(SkeletonColours, OfAnEdgeAreThoseOfItsEnds) {
  for (const Extracted& one : family()) {
    for (const ColourBy by : {ColourBy::component, ColourBy::node, ColourBy::radius}) {
      const ShownSkeleton shown = shown_skeleton(one.skeleton, {}, 10, look_by(by), {});
      for (std::size_t e = 0; e < shown.edges.size(); ++e) {
        const auto row = static_cast<Eigen::Index>(e);
        const auto node = [&](int end) {
          return shown.nodes[static_cast<std::size_t>(one.skeleton.edges(row, end))];
        };
        EXPECT_EQ(shown.edges[e].from_colour, node(0).from_colour);
        EXPECT_EQ(shown.edges[e].to_colour, node(1).from_colour);
      }
    }
  }
}

TEST(SkeletonColours, ByRadiusSpanTheMap) {
  for (const Extracted& one : family()) {
    const Look look = look_by(ColourBy::radius);
    const ShownSkeleton shown = shown_skeleton(one.skeleton, {}, 10, look, {});
    Eigen::Index thinnest = 0;
    Eigen::Index thickest = 0;
    one.skeleton.radii.minCoeff(&thinnest);
    one.skeleton.radii.maxCoeff(&thickest);
    // A tenth of the thickest is the least that spans the whole map.
    const double range = 1 - one.skeleton.radii.minCoeff() / one.skeleton.radii.maxCoeff();
    const auto lowest = static_cast<float>(std::max(0.0, 1 - range / 0.1));
    const Rgba expected = rgba(mapped(look.map, lowest));
    const Rgba found = shown.nodes[static_cast<std::size_t>(thinnest)].from_colour;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(found[channel], expected[channel], 1);
    }
    EXPECT_EQ(shown.nodes[static_cast<std::size_t>(thickest)].from_colour,
              rgba(mapped(look.map, 1)));
  }
}

TEST(SurfaceColours, OfHighlightedNodesAreLitUpAndNoOther) {
  for (const Extracted& one : family()) {
    const int count = static_cast<int>(one.skeleton.nodes.rows());
    for (const auto& colouring : colourings) {
      SCOPED_TRACE(one.name + " by " + std::string(colouring.name));
      const Look look = look_by(colouring.value);
      Highlights lit;
      lit.nodes = {count - 1, count / 2, 0};
      std::vector<Rgba> before = surface_colours(one.surface, {&one.skeleton}, look, {});
      if (before.empty()) {
        before.assign(static_cast<std::size_t>(one.surface.positions.rows()),
                      rgba(palette_of(look.theme).surface));
      }
      const std::vector<Rgba> after = surface_colours(one.surface, {&one.skeleton}, look, lit);
      const ShownSkeleton shown = shown_skeleton(one.skeleton, {}, 10, look, lit);
      ASSERT_EQ(after.size(), before.size());
      std::set<Rgba> of_lit;
      for (std::size_t v = 0; v < after.size(); ++v) {
        const int node = one.skeleton.node_of_vertex[static_cast<Eigen::Index>(v)];
        if (std::find(lit.nodes.begin(), lit.nodes.end(), node) == lit.nodes.end()) {
          EXPECT_EQ(after[v], before[v]);
        } else {
          of_lit.insert(after[v]);
        }
      }
      EXPECT_LE(of_lit.size(), 1U);
      for (const Rgba& colour : of_lit) {
        EXPECT_TRUE(std::any_of(shown.nodes.begin(), shown.nodes.end(),
                                [&](const auto& node) { return node.from_colour == colour; }));
      }
    }
  }
}

TEST(SkeletonColours, OfHighlightedEdgesDifferFromAllOthers) {
  for (const Extracted& one : family()) {
    Highlights lit;
    lit.edges = {1, 0};
    lit.failed_edges = {2};
    const ShownSkeleton before = shown_skeleton(one.skeleton, {}, 10, {}, {});
    const ShownSkeleton after = shown_skeleton(one.skeleton, {}, 10, {}, lit);
    EXPECT_EQ(after.edges[0].from_colour, after.edges[1].to_colour);
    EXPECT_NE(after.edges[0].from_colour, before.edges[0].from_colour);
    EXPECT_NE(after.edges[2].from_colour, before.edges[2].from_colour);
    EXPECT_NE(after.edges[2].from_colour, after.edges[0].from_colour);
    for (std::size_t e = 3; e < after.edges.size(); ++e) {
      EXPECT_EQ(after.edges[e].from_colour, before.edges[e].from_colour);
    }
  }
}

TEST(SurfaceColours, ArePlainWithoutAMapOfThisSurface) {
  const Extracted& one = family().front();
  CurveSkeleton of_another = one.skeleton;
  of_another.node_of_vertex.conservativeResize(of_another.node_of_vertex.size() - 1);
  for (const ColourBy by : {ColourBy::node, ColourBy::branch, ColourBy::radius}) {
    EXPECT_TRUE(surface_colours(one.surface, {}, look_by(by), {}).empty());
    EXPECT_TRUE(surface_colours(one.surface, {&of_another}, look_by(by), {}).empty());
  }
  EXPECT_TRUE(surface_colours(one.surface, {&one.skeleton}, look_by(ColourBy::plain), {}).empty());
}

}  // namespace
}  // namespace curveskel::viewer::scene_colours_laws
