// Questions that the tests of reading ask of a polygon soup, and of a refusal.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include "tests/surface/encodings.hpp"

namespace curveskel {

/// The message of the Error(Fault::input) that reading throws; fails the test if there is none.
template <typename Read>
std::string refusal_of(const Read& read) {
  try {
    const PolygonSoup soup = read();
    ADD_FAILURE() << soup.file << " was read: " << soup.positions.rows() << " vertices, "
                  << soup.offsets.size() - 1 << " polygons";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "";
}

inline std::string refusal(const std::filesystem::path& file) {
  return refusal_of([&] { return read_polygons(file, {}); });
}

/// Each polygon as the positions of its corners, which no numbering of vertices changes.
using Outlines = std::vector<std::vector<std::array<double, 3>>>;

inline Outlines outlines(const PolygonSoup& soup) {
  Outlines result;
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    result.emplace_back();
    for (auto i = soup.offsets[p]; i < soup.offsets[p + 1]; ++i) {
      const auto position = soup.positions.row(soup.corners[static_cast<std::size_t>(i)]);
      result.back().push_back({position.x(), position.y(), position.z()});
    }
  }
  return result;
}

inline Outlines outlines_of_the_box(bool as_quads) {
  Outlines result;
  const auto add = [&](const auto& polygon) {
    result.emplace_back();
    for (const int v : polygon) {
      const auto& p = encodings::corners[static_cast<std::size_t>(v)];
      result.back().push_back(
          {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    }
  };
  if (as_quads) {
    for (const auto& quad : encodings::quads) add(quad);
  } else {
    for (const auto& triangle : encodings::triangles()) add(triangle);
  }
  return result;
}

}  // namespace curveskel
