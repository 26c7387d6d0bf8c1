#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <curveskel/error.hpp>
#include "surface/read/formats.hpp"
#include "surface/write/write_om.hpp"
#include "tests/surface/reading.hpp"

namespace curveskel::read_om_laws {
namespace {

PolygonSoup read(const std::string& bytes) { return read_content({"box.om", bytes}, {}); }

std::string refusal_of_bytes(const std::string& bytes) {
  return refusal_of([&] { return read(bytes); });
}

template <typename Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A chunk's header: whose data, of which type, in how many dimensions, of 2^bits bytes each, four
/// times as many where they are floating-point numbers.
std::uint16_t chunk(unsigned entity, unsigned type, bool is_float, unsigned dimensions,
                    unsigned bits) {
  return static_cast<std::uint16_t>(entity << 2U | type << 5U | (is_float ? 1U : 0U) << 10U |
                                    (dimensions - 1) << 11U | bits << 14U);
}

constexpr unsigned of_vertex = 0;
constexpr unsigned of_face = 2;
constexpr unsigned position = 0;
constexpr unsigned custom = 6;
constexpr unsigned topology = 7;

std::string header(char kind, char version, std::uint32_t vertices, std::uint32_t faces,
                   std::uint32_t edges) {
  std::string bytes = "OM";
  bytes += kind;
  bytes += version;
  for (const std::uint32_t count : {vertices, faces, edges}) append(bytes, count);
  return bytes;
}

/// As OpenMesh wrote before version 2: faces by their vertices.
std::string box_of_quads() {
  std::string bytes = header('P', 0x22, 8, 6, 12);
  append(bytes, chunk(of_vertex, position, true, 3, 0));
  for (const auto& corner : encodings::corners) {
    for (const auto coordinate : corner) append(bytes, static_cast<float>(coordinate));
  }
  append(bytes, chunk(of_face, topology, false, 1, 0));
  for (const auto& quad : encodings::quads) {
    append(bytes, std::uint16_t{4});
    for (const auto vertex : quad) bytes += static_cast<char>(vertex);
  }
  return bytes;
}

Surface box() {
  Surface surface;
  surface.positions.resize(8, 3);
  for (int v = 0; v < 8; ++v) {
    for (int k = 0; k < 3; ++k) {
      surface.positions(v, k) =
          static_cast<double>(encodings::corners[static_cast<std::size_t>(v)][std::size_t(k)]) / 3;
    }
  }
  const auto triangles = encodings::triangles();
  surface.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      surface.triangles(static_cast<Eigen::Index>(f), k) =
          static_cast<std::int32_t>(triangles[f][std::size_t(k)]);
    }
  }
  return surface;
}

TEST(ReadOm, PolygonsOfOlderFilesComeAsTheyAre) {
  const PolygonSoup soup = read(box_of_quads());
  EXPECT_EQ(soup.format, SurfaceFormat::om);
  EXPECT_EQ(outlines(soup), outlines_of_the_box(true));
}

TEST(ReadOm, WhatIsWrittenComesBackToTheLastBit) {
  const Surface surface = box();
  const PolygonSoup soup = read(format_om(surface));
  EXPECT_TRUE((soup.positions.array() == surface.positions.array()).all());
  EXPECT_TRUE(std::equal(soup.corners.begin(), soup.corners.end(), surface.triangles.data(),
                         surface.triangles.data() + surface.triangles.size()));
  EXPECT_EQ(soup.offsets.size(), 13U);
}

TEST(ReadOm, OpenSurfacesAndVerticesWithoutFacesComeBack) {
  Surface surface = box();
  surface.triangles.conservativeResize(5, 3);
  const PolygonSoup soup = read(format_om(surface));
  EXPECT_EQ(soup.positions.rows(), 8);
  EXPECT_TRUE(std::equal(soup.corners.begin(), soup.corners.end(), surface.triangles.data(),
                         surface.triangles.data() + surface.triangles.size()));
}

TEST(ReadOm, PropertiesArePassedOver) {
  // Read as a list of numbers, this one would claim to have 2^32 - 1 of them.
  std::string property;
  append(property, static_cast<std::uint16_t>(chunk(of_vertex, custom, false, 1, 0) | 2U));
  property += "\x05v:bad";
  append(property, std::uint32_t{8});
  property += "\xff\xff\xff\xff\xff\xff\xff\xff";
  std::string bytes = box_of_quads();
  bytes.insert(16, property);
  EXPECT_EQ(outlines(read(bytes)), outlines_of_the_box(true));
}

TEST(ReadOm, PropertiesThatGoBeyondTheFileAreRefused) {
  std::string bytes = box_of_quads();
  append(bytes, static_cast<std::uint16_t>(chunk(of_vertex, custom, false, 1, 0) | 2U));
  bytes += "\x05v:bad";
  append(bytes, std::uint32_t{0xfffffff0});
  EXPECT_NE(refusal_of_bytes(bytes).find("a chunk of 4294967280 bytes"), std::string::npos);
}

TEST(ReadOm, EveryTruncationIsRefused) {
  constexpr std::size_t sentinel = 2;
  for (const std::string& whole : {box_of_quads() + "xx", format_om(box())}) {
    for (std::size_t bytes = 16; bytes < whole.size() - sentinel; ++bytes) {
      const std::string refusal = refusal_of_bytes(whole.substr(0, bytes));
      EXPECT_NE(refusal.find("box.om: found "), std::string::npos) << bytes;
    }
  }
}

TEST(ReadOm, CountsAreHeldAgainstTheFile) {
  for (const std::size_t count : {4U, 8U, 12U}) {
    for (const std::uint32_t announced : {0x7fffffffU, 0xffffffffU, 0x3fffffffU}) {
      std::string bytes = format_om(box());
      std::memcpy(bytes.data() + count, &announced, sizeof announced);
      EXPECT_NE(refusal_of_bytes(bytes).find("found"), std::string::npos);
    }
  }
}

/// Any byte of a small file replaced by some others: polygons that hold together, or a refusal.
TEST(ReadOm, GarbageIsReadOrRefused) {
  int refused = 0;
  for (const std::string& sound : {box_of_quads(), format_om(box())}) {
    for (std::size_t place = 0; place < sound.size(); ++place) {
      for (const int value : {0, 1, 7, 63, 127, 128, 254, 255}) {
        std::string bytes = sound;
        bytes[place] = static_cast<char>(value);
        try {
          const PolygonSoup soup = read(bytes);
          EXPECT_TRUE(soup.positions.allFinite());
          EXPECT_EQ(soup.offsets.back(), static_cast<std::int64_t>(soup.corners.size()));
          for (const std::int32_t corner : soup.corners) {
            ASSERT_GE(corner, 0);
            ASSERT_LT(corner, soup.positions.rows());
          }
        } catch (const Error& error) {
          EXPECT_EQ(error.fault(), Fault::input);
          ++refused;
        }
      }
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(ReadOm, NewerVersionsAreNamed) {
  std::string bytes = box_of_quads();
  bytes[3] = 0x63;
  EXPECT_NE(refusal_of_bytes(bytes).find("OM of version 3.3"), std::string::npos);
}

TEST(ReadOm, AVertexWithoutAPlaceLosesItsFaces) {
  std::string bytes = box_of_quads();
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(bytes.data() + 18, &infinite, sizeof infinite);
  const PolygonSoup soup = read(bytes);
  EXPECT_EQ(soup.unplaced_vertices, 1);
  EXPECT_EQ(soup.unplaced_polygons, 3);
  EXPECT_EQ(soup.offsets.size(), 4);
}

std::string refusal_to_write(const Surface& surface) {
  try {
    (void)format_om(surface);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::output);
    return error.what();
  }
  return "";
}

TEST(WriteOm, RefusesWhatHalfEdgesCannotHold) {
  Surface surface = box();
  surface.triangles.row(7) << 0, 0, 1;
  EXPECT_NE(refusal_to_write(surface).find("number 7 counted from 0, that has a corner twice"),
            std::string::npos);
  surface = box();
  surface.triangles.row(11) = surface.triangles.row(0);
  EXPECT_NE(refusal_to_write(surface).find("number 11"), std::string::npos);
}

TEST(ReadOm, NothingIsPrinted) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  Surface twice = box();
  twice.triangles.row(11) = twice.triangles.row(0);
  (void)refusal_to_write(twice);
  std::string bytes = format_om(box());
  bytes[bytes.size() / 2] = '\x7f';
  try {
    (void)read(bytes);
  } catch (const Error&) {  // as it may be
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace curveskel::read_om_laws
