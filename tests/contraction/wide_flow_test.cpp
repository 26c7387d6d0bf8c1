// Laws of the local flow in vector lanes: its slices, and its agreement with the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include <curveskel/advanced/device.hpp>
#include <curveskel/fair.hpp>
#include "contraction/fairing/wide_slices.hpp"
#include "meshes/shapes.hpp"
#include "tests/contraction/faired.hpp"

namespace curveskel::wide_flow_laws {
namespace {

using shapes::Shape;

/// The last faces taken away, so that there is a boundary.
Shape opened(Shape shape, Eigen::Index faces) {
  shape.name += ", open";
  shape.surface.triangles.conservativeResize(shape.surface.triangles.rows() - faces, 3);
  return shape;
}

std::vector<Shape> families() {
  const auto tube = shapes::tube("tube", shapes::s_curve(6, 2), shapes::wavy(0.5, 0.1, 3), 14);
  const auto ball = shapes::ellipsoid({1, 1.5, 2}, 3);
  const auto torus = shapes::renumbered(shapes::torus(2, 0.6, 12), 3);
  return {tube,
          shapes::noisy(tube, 0.02, 1),
          ball,
          shapes::noisy(ball, 0.02, 2),
          shapes::box({1, 2, 3}, 8),
          torus,
          opened(shapes::noisy(torus, 0.01, 9), 7),
          shapes::linked_rings(2, 0.4, 10),
          shapes::tube_union("Y", shapes::star(3, 4, 0.5)),  // valences 4 to 8
          shapes::cone(1, 2, 20),
          shapes::cone(1, 2, 40)};
}

WideSlices slices_of(const Surface& surface, int threads = 0) {
  return wide_slices(surface.positions, one_rings(surface.triangles, surface.positions.rows()),
                     threads);
}

Surface faired(const Surface& surface, FairMethod method, int iterations) {
  FairOptions options;
  options.method = method;
  options.iterations = iterations;
  return fair(surface, options, {});
}

/// In single precision on a processor: what a device of another kind does is no matter here.
bool no_processor() {
  const auto found = devices();
  return found.empty() || found[choose_device(found, {}, "this test", "")].gpu;
}

#define SKIP_WITHOUT_PROCESSOR() \
  if (no_processor()) GTEST_SKIP() << "no processor is an OpenCL device on this machine"

TEST(LocalKernel, IsWideForUsualRingsInSinglePrecisionOnAProcessor) {
  for (const std::size_t valence : {3U, 6U, 32U}) {
    EXPECT_EQ(local_kernel(false, false, valence), LocalKernel::wide);
    EXPECT_EQ(local_kernel(true, false, valence), LocalKernel::stream);
    EXPECT_EQ(local_kernel(false, true, valence), LocalKernel::stream);
  }
  EXPECT_EQ(local_kernel(false, false, 33), LocalKernel::stream);
  EXPECT_EQ(local_kernel(false, false, 5000), LocalKernel::stream);
  for (const bool gpu : {false, true}) EXPECT_EQ(local_kernel(gpu, gpu, 0), LocalKernel::none);
}

TEST(WideSlices, HoldEveryVertexWhereItsKernelLooksForIt) {
  for (const Shape& shape : families()) {
    const OneRings rings = one_rings(shape.surface.triangles, shape.surface.positions.rows());
    const WideSlices slices = wide_slices(shape.surface.positions, rings, 0);
    const std::size_t in_slices = slice_lanes * slices.slices();
    std::set<std::int32_t> seen;
    for (std::size_t place = 0; place < slices.vertex_at.size(); ++place) {
      const std::int32_t v = slices.vertex_at[place];
      const LocalKernel kernel =
          local_kernel(false, false, rings.of(static_cast<std::size_t>(v)).size());
      EXPECT_EQ(kernel, place < in_slices                    ? LocalKernel::wide
                        : place < in_slices + slices.large() ? LocalKernel::stream
                                                             : LocalKernel::none);
      const bool repeated = place % slice_lanes > 0 && slices.vertex_at[place - 1] == v;
      EXPECT_TRUE(seen.insert(v).second ||
                  (repeated && place + slice_lanes > in_slices && place < in_slices))
          << shape.name << ", vertex " << v;
    }
    EXPECT_EQ(static_cast<Eigen::Index>(seen.size()), shape.surface.positions.rows());
  }
}

TEST(WideSlices, RingsAreWholeAndPaddedAtTheFront) {
  std::size_t padded = 0;
  for (const Shape& shape : families()) {
    const OneRings rings = one_rings(shape.surface.triangles, shape.surface.positions.rows());
    const WideSlices slices = wide_slices(shape.surface.positions, rings, 0);
    for (std::size_t place = 0; place < slice_lanes * slices.slices(); ++place) {
      const std::size_t slice = place / slice_lanes;
      std::vector<std::int32_t> ring;
      for (int row = slices.first_row[slice]; row < slices.first_row[slice + 1]; ++row) {
        const std::size_t entry = slice_lanes * static_cast<std::size_t>(row) + place % slice_lanes;
        ring.push_back(slices.vertex_at[static_cast<std::size_t>(slices.ring[entry])]);
      }
      const auto expected = rings.of(static_cast<std::size_t>(slices.vertex_at[place]));
      ASSERT_GE(ring.size(), expected.size());
      const std::size_t padding = ring.size() - expected.size();
      for (std::size_t i = 0; i < padding; ++i) EXPECT_EQ(ring[i], expected[0]);
      EXPECT_TRUE(std::equal(expected.begin(), expected.end(),
                             ring.begin() + static_cast<std::ptrdiff_t>(padding)));
      padded += padding;
    }
  }
  EXPECT_GT(padded, 0U);
}

TEST(WideSlices, LittleIsPaddedAndThreadsDoNotMatter) {
  const Shape shape = shapes::subdivided(shapes::noisy(shapes::ellipsoid({1, 1.5, 2}, 4), 0.02, 6));
  const WideSlices one = slices_of(shape.surface, 1);
  const WideSlices two = slices_of(shape.surface, 2);
  EXPECT_EQ(one.vertex_at, two.vertex_at);
  EXPECT_EQ(one.ring, two.ring);
  EXPECT_LT(static_cast<double>(one.ring.size()),
            1.05 * static_cast<double>(3 * shape.surface.triangles.rows()));
}

TEST(WideSlices, NothingIsSlicedIntoNothing) {
  const WideSlices slices = slices_of(Surface{});
  EXPECT_EQ(slices.slices() + slices.large() + slices.vertex_at.size(), 0U);
}

TEST(WideFlow, AgreesWithTheReferenceAfterTenIterations) {
  SKIP_WITHOUT_PROCESSOR();
  bool incomplete_slice = false;
  for (const Shape& shape : families()) {
    const Surface reference = faired(shape.surface, FairMethod::cpu, 10);
    const Surface wide = faired(shape.surface, FairMethod::opencl, 10);
    EXPECT_LT(largest_difference(wide, reference), 1e-4) << shape.name;
    EXPECT_GT(largest_difference(wide, shape.surface), 1e-4) << shape.name << " did not move";
    incomplete_slice |= shape.surface.positions.rows() % 16 != 0;
  }
  EXPECT_TRUE(incomplete_slice);
}

TEST(WideFlow, PaddedRingsMoveAsIfTheyWereAlone) {
  SKIP_WITHOUT_PROCESSOR();
  // The vertices of each part have two valences, so that slices mix them.
  for (const double smoothing : {0.1, 1.0, 30.0}) {
    const Shape shape = shapes::noisy(shapes::ellipsoid({1, 1.5, 2}, 1), 0.05, 4);
    FairOptions options;
    options.smoothing = smoothing;
    options.iterations = 1;
    options.volume = VolumeRule::keep;
    options.method = FairMethod::cpu;
    const Surface reference = fair(shape.surface, options, {});
    options.method = FairMethod::opencl;
    EXPECT_LT(largest_difference(fair(shape.surface, options, {}), reference), 1e-6) << smoothing;
  }
}

TEST(WideFlow, ApexWithFiveThousandNeighboursGoesBesideTheSlices) {
  SKIP_WITHOUT_PROCESSOR();
  const Shape cone = shapes::cone(1, 2, 5000);
  EXPECT_GE(slices_of(cone.surface).large(), 1U);
  EXPECT_LT(largest_difference(faired(cone.surface, FairMethod::opencl, 10),
                               faired(cone.surface, FairMethod::host, 10)),
            1e-4);
}

TEST(WideFlow, HeldVerticesStay) {
  SKIP_WITHOUT_PROCESSOR();
  const Shape open = opened(shapes::noisy(shapes::torus(2, 0.6, 12), 0.02, 9), 7);
  const OneRings rings = one_rings(open.surface.triangles, open.surface.positions.rows());
  const Surface wide = faired(open.surface, FairMethod::opencl, 3);
  int held = 0;
  for (Eigen::Index v = 0; v < wide.positions.rows(); ++v) {
    const bool stays = rings.of(static_cast<std::size_t>(v)).empty();
    EXPECT_EQ(wide.positions.row(v) == open.surface.positions.row(v), stays) << v;
    held += stays ? 1 : 0;
  }
  EXPECT_GT(held, 0);
}

/// Faces that single precision cannot tell from faces without area have none in double, too.
TEST(WideFlow, MovesDegenerateFacesAsTheHostDoes) {
  SKIP_WITHOUT_PROCESSOR();
  Shape ball = shapes::ellipsoid({1, 1, 1}, 2);
  for (const double distance : {0.0, 1e-20, 1e-9, 1e-6}) {
    // One corner beside another, and a corner on the opposite side.
    for (int f = 0; f < 40; f += 10) {
      ball.surface.positions.row(ball.surface.triangles(f, 1)) =
          ball.surface.positions.row(ball.surface.triangles(f, 0));
      ball.surface.positions(ball.surface.triangles(f, 1), 0) += distance;
    }
    for (int f = 105; f < 160; f += 10) {
      const auto corner = ball.surface.triangles.row(f);
      ball.surface.positions.row(corner[0]) =
          (ball.surface.positions.row(corner[1]) + 2 * ball.surface.positions.row(corner[2])) / 3;
      ball.surface.positions(corner[0], 1) += distance / 100;
    }
    for (const double smoothing : {1.0, 1e6}) {
      FairOptions options;
      options.method = FairMethod::opencl;
      options.smoothing = smoothing;
      options.volume = VolumeRule::keep;
      const Surface wide = fair(ball.surface, options, {});
      options.method = FairMethod::host;
      EXPECT_LT(largest_difference(wide, fair(ball.surface, options, {})), 1e-5)
          << distance << ", mu " << smoothing;
    }
  }
}

TEST(WideFlow, SameBytesTwice) {
  SKIP_WITHOUT_PROCESSOR();
  const Shape shape = shapes::noisy(shapes::ellipsoid({1, 1.5, 2}, 5), 0.02, 6);
  EXPECT_EQ(faired(shape.surface, FairMethod::opencl, 10).positions,
            faired(shape.surface, FairMethod::opencl, 10).positions);
}

}  // namespace
}  // namespace curveskel::wide_flow_laws
