// Soups to repair, and what repairs leave of them.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include <curveskel/error.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/topology.hpp>
#include "meshes/shapes.hpp"
#include "tests/soups.hpp"

namespace curveskel {

/// The polygons for which the predicate holds; vertices stay.
inline PolygonSoup with_polygons(const PolygonSoup& soup,
                                 const std::function<bool(std::size_t)>& stays) {
  PolygonSoup result = soup;
  result.corners.clear();
  result.offsets = {0};
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    if (!stays(p)) continue;
    result.corners.insert(result.corners.end(), soup.corners.begin() + soup.offsets[p],
                          soup.corners.begin() + soup.offsets[p + 1]);
    result.offsets.push_back(static_cast<std::int64_t>(result.corners.size()));
  }
  return result;
}

inline Eigen::RowVector3d middle_of(const PolygonSoup& soup, std::size_t polygon) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (auto i = soup.offsets[polygon]; i < soup.offsets[polygon + 1]; ++i) {
    sum += soup.positions.row(soup.corners[static_cast<std::size_t>(i)]);
  }
  return sum / double(soup.offsets[polygon + 1] - soup.offsets[polygon]);
}

/// Every triangle by itself, shrunk towards its middle: no two share a position.
inline PolygonSoup shrunk_apart(const Surface& surface, double share) {
  PolygonSoup soup = torn(soup_of(surface));
  const Positions given = soup.positions;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const Eigen::RowVector3d middle = given.middleRows(3 * f, 3).colwise().mean();
    for (Eigen::Index i = 3 * f; i < 3 * f + 3; ++i) {
      soup.positions.row(i) = middle + (1 - share) * (given.row(i) - middle);
    }
  }
  return soup;
}

inline int genus_of(const Surface& surface) { return topology(surface).total_genus(); }

/// Vertices of the file that belong to no vertex of the surface, although a polygon uses them.
inline int used_but_dropped(const PolygonSoup& soup, const RepairedSurface& result) {
  int count = 0;
  for (const std::int32_t v : soup.corners) count += result.vertex_of_input[v] < 0 ? 1 : 0;
  return count;
}

inline PolygonSoup open_tube() {
  const shapes::Shape tube = shapes::tube("tube", shapes::straight(6), shapes::constant(0.5), 24);
  const PolygonSoup soup = soup_of(tube.surface);
  return with_polygons(soup, [&](std::size_t p) { return std::abs(middle_of(soup, p).x()) < 2.5; });
}

/// The message with which the soup is refused, as it must be.
inline std::string refusal_of(const PolygonSoup& soup) {
  try {
    (void)repair(soup, {}, {});
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "";
}

}  // namespace curveskel
