// The sources of rigs in tests: surfaces with their extracted skeletons, and curves drawn by hand.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/extract.hpp>
#include <curveskel/rig.hpp>
#include "meshes/shapes.hpp"

namespace curveskel {

struct RigSubject {
  std::string name;
  Surface surface;
  CurveSkeleton skeleton;
};

inline CurveSkeleton quickly_extracted(const Surface& surface) {
  ExtractOptions options;
  options.resolution = 1000;
  options.least_resolution = 500;
  return extract(surface, options, {}).skeleton;
}

/// Three bodies of different sizes, apart from each other.
inline shapes::Shape three_bodies() {
  const shapes::Shape y = shapes::tube_union("", shapes::star(3, 4, 1), {0.25, 2});
  const shapes::Shape bar = shapes::tube("", shapes::straight(8), shapes::constant(0.7), 12);
  const shapes::Shape ring = shapes::torus(2, 0.6, 10);
  return shapes::together("three-bodies", {shapes::translated(bar, {0, 8, 0}), y,
                                           shapes::translated(ring, {0, -9, 0})});
}

/// Chains, rings, junctions, a ball, and several components.
inline const std::vector<RigSubject>& rig_subjects() {
  static const std::vector<RigSubject> all = [] {
    std::vector<RigSubject> made;
    const auto add = [&](std::string_view name, Surface surface) {
      CurveSkeleton skeleton = quickly_extracted(surface);
      made.push_back({std::string(name), std::move(surface), std::move(skeleton)});
    };
    for (const std::string_view name : {"tube", "taper", "s", "torus", "linked-rings", "box",
                                        "sphere", "double-torus", "y", "star", "h", "tree"}) {
      for (const auto& entry : shapes::catalogue()) {
        if (entry.name == name) add(name, entry.make().surface);
      }
    }
    add("three bodies", three_bodies().surface);
    return made;
  }();
  return all;
}

/// The nodes and edges of both, those of the first before.
inline CurveSkeleton together(const CurveSkeleton& a, const CurveSkeleton& b) {
  CurveSkeleton both;
  both.nodes.resize(a.nodes.rows() + b.nodes.rows(), 3);
  both.nodes << a.nodes, b.nodes;
  both.radii.resize(both.nodes.rows());
  both.radii << a.radii, b.radii;
  both.edges.resize(a.edges.rows() + b.edges.rows(), 2);
  both.edges << a.edges, b.edges.array() + static_cast<int>(a.nodes.rows());
  return both;
}

/// A chain of nodes at most `step` apart through the corners.
inline CurveSkeleton chain_through(const std::vector<Eigen::RowVector3d>& corners, double radius,
                                   double step) {
  std::vector<Eigen::RowVector3d> points{corners.front()};
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Eigen::RowVector3d way = corners[k] - corners[k - 1];
    const int pieces = std::max(1, static_cast<int>(std::ceil(way.norm() / step - 1e-9)));
    for (int piece = 1; piece <= pieces; ++piece) {
      points.emplace_back(corners[k - 1] + way * piece / pieces);
    }
  }
  CurveSkeleton chain;
  const auto count = static_cast<Eigen::Index>(points.size());
  chain.nodes.resize(count, 3);
  chain.edges.resize(count - 1, 2);
  for (Eigen::Index k = 0; k < count; ++k) {
    chain.nodes.row(k) = points[static_cast<std::size_t>(k)];
    if (k > 0) chain.edges.row(k - 1) << static_cast<int>(k) - 1, static_cast<int>(k);
  }
  chain.radii.setConstant(count, radius);
  return chain;
}

/// All curves in one skeleton, no edges between them.
inline CurveSkeleton curves_together(const std::vector<CurveSkeleton>& curves) {
  CurveSkeleton all;
  for (const CurveSkeleton& curve : curves) {
    const Eigen::Index nodes = all.nodes.rows();
    const Eigen::Index edges = all.edges.rows();
    all.nodes.conservativeResize(nodes + curve.nodes.rows(), 3);
    all.nodes.bottomRows(curve.nodes.rows()) = curve.nodes;
    all.radii.conservativeResize(all.nodes.rows());
    all.radii.tail(curve.nodes.rows()) = curve.radii;
    all.edges.conservativeResize(edges + curve.edges.rows(), 2);
    all.edges.bottomRows(curve.edges.rows()) = curve.edges.array() + static_cast<int>(nodes);
  }
  return all;
}

inline double distance_to_segment(const Eigen::RowVector3d& point, const Eigen::RowVector3d& from,
                                  const Eigen::RowVector3d& to) {
  const Eigen::RowVector3d way = to - from;
  const double squared = std::max(way.squaredNorm(), std::numeric_limits<double>::min());
  const double share = std::clamp((point - from).dot(way) / squared, 0.0, 1.0);
  return (point - from - share * way).norm();
}

inline float largest_difference(const SkinWeights& a, const SkinWeights& b) {
  return Eigen::MatrixXf(a - b).cwiseAbs().maxCoeff();
}

/// About the origin.
inline CurveSkeleton scaled_curve(CurveSkeleton skeleton, double factor) {
  skeleton.nodes *= factor;
  skeleton.radii *= factor;
  return skeleton;
}

}  // namespace curveskel
