// Polygon soups for the tests of cleaning and repair, and what must come of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

inline PolygonSoup soup_of(const Positions& positions,
                           std::initializer_list<std::vector<std::int32_t>> polygons) {
  PolygonSoup soup;
  soup.positions = positions;
  soup.offsets.push_back(0);
  for (const auto& polygon : polygons) {
    soup.corners.insert(soup.corners.end(), polygon.begin(), polygon.end());
    soup.offsets.push_back(static_cast<std::int64_t>(soup.corners.size()));
  }
  return soup;
}

/// Every corner gets a vertex of its own, as in STL.
inline PolygonSoup torn(const PolygonSoup& soup) {
  PolygonSoup result = soup;
  result.positions.resize(static_cast<Eigen::Index>(soup.corners.size()), 3);
  for (std::size_t i = 0; i < soup.corners.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    result.positions.row(row) = soup.positions.row(soup.corners[i]);
    result.corners[i] = static_cast<std::int32_t>(i);
  }
  return result;
}

inline void turn(PolygonSoup& soup, std::int64_t polygon) {
  std::reverse(soup.corners.begin() + soup.offsets[static_cast<std::size_t>(polygon)],
               soup.corners.begin() + soup.offsets[static_cast<std::size_t>(polygon) + 1]);
}

inline void append(PolygonSoup& soup, const std::vector<std::int32_t>& polygon) {
  soup.corners.insert(soup.corners.end(), polygon.begin(), polygon.end());
  soup.offsets.push_back(static_cast<std::int64_t>(soup.corners.size()));
}

inline PolygonSoup cube() {
  Positions positions(8, 3);
  positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1;
  return soup_of(
      positions,
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// Both in one soup, the second moved.
inline PolygonSoup together(const PolygonSoup& first, PolygonSoup second,
                            const Eigen::RowVector3d& offset) {
  PolygonSoup result = first;
  const auto vertices = static_cast<std::int32_t>(first.positions.rows());
  result.positions.resize(first.positions.rows() + second.positions.rows(), 3);
  result.positions << first.positions, second.positions.rowwise() + offset;
  for (auto& corner : second.corners) corner += vertices;
  result.corners.insert(result.corners.end(), second.corners.begin(), second.corners.end());
  for (std::size_t p = 1; p < second.offsets.size(); ++p) {
    result.offsets.push_back(first.offsets.back() + second.offsets[p]);
  }
  return result;
}

inline void expect_said(const std::string& message, std::initializer_list<std::string> parts) {
  for (const auto& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
  }
}

/// The message of the Error(Fault::input) that cleaning throws; fails the test if there is none.
inline std::string refusal(const PolygonSoup& soup) {
  try {
    (void)clean(soup, {});
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "";
}

/// The promises of every cleaned surface.
inline void expect_closed_outward_manifold(const Surface& surface) {
  std::map<std::pair<int, int>, int> half_edges;
  std::vector<int> faces_at(static_cast<std::size_t>(surface.positions.rows()), 0);
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      ++half_edges[{t(k), t((k + 1) % 3)}];
      ++faces_at[static_cast<std::size_t>(t(k))];
    }
  }
  for (const auto& [half_edge, count] : half_edges) {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(half_edges.count({half_edge.second, half_edge.first}), 1U);
  }
  // One umbrella per vertex: going round from edge to edge takes as many steps as there are faces.
  std::map<std::pair<int, int>, int> third;
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) third[{t(k), t((k + 1) % 3)}] = t((k + 2) % 3);
  }
  for (int v = 0; v < surface.positions.rows(); ++v) {
    const int faces = faces_at[static_cast<std::size_t>(v)];
    ASSERT_GT(faces, 0) << "isolated vertex " << v;
    const int first = third.lower_bound({v, 0})->first.second;
    int steps = 0;
    for (int at = first; steps == 0 || at != first; ++steps) at = third.at({v, at});
    ASSERT_EQ(steps, faces) << "vertex " << v;
  }
  for (const Component& part : split_components(surface, topology(surface))) {
    ASSERT_GT(volume(part.surface), 0);
  }
}

}  // namespace curveskel
