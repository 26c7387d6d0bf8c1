// A torus with a skeleton, both whole, for laws about what is spoilt; and what an Error must say.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <curveskel.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::misuse {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

inline const Surface& torus() {
  static const Surface surface = shapes::torus(3, 1, 8).surface;
  return surface;
}

inline int vertices() { return static_cast<int>(torus().positions.rows()); }

/// The axis of the torus, with a tail, a radius and a life at each node; every vertex belongs to
/// the nearest node.
inline const CurveSkeleton& a_skeleton() {
  static const CurveSkeleton skeleton = [] {
    CurveSkeleton one = shapes::torus(3, 1, 8).axis;
    one.radii.setOnes(one.nodes.rows());
    one.lives.setOnes(one.nodes.rows());
    one.node_of_vertex.resize(vertices());
    for (Eigen::Index v = 0; v < vertices(); ++v) {
      (one.nodes.rowwise() - torus().positions.row(v))
          .rowwise()
          .squaredNorm()
          .minCoeff(&one.node_of_vertex[v]);
    }
    return add_node(one, 0, {5, 0, 0});
  }();
  return skeleton;
}

inline RepairedSurface as_if_repaired() {
  RepairedSurface repaired;
  repaired.surface = torus();
  repaired.vertex_of_input = Eigen::VectorXi::LinSpaced(vertices(), 0, vertices() - 1);
  return repaired;
}

/// The fault and the message of the Error that the call throws; nothing where it throws none.
inline std::optional<std::pair<Fault, std::string>> error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return std::pair{error.fault(), std::string(error.what())};
  }
  return std::nullopt;
}

inline void expect_error(Fault fault, const std::string& words, const std::function<void()>& call) {
  const auto error = error_of(call);
  if (!error) {
    ADD_FAILURE() << "no error that says " << words;
    return;
  }
  EXPECT_EQ(error->first, fault) << error->second;
  EXPECT_NE(error->second.find(words), std::string::npos) << error->second;
  EXPECT_NE(error->second.find("needed"), std::string::npos) << error->second;
}

}  // namespace curveskel::misuse
