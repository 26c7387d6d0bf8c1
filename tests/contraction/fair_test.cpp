// Laws of the local flow, over shapes with and without noise.
#include <curveskel/fair.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stop_token>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/fair_polygons.hpp>
#include <curveskel/topology.hpp>
#include "tests/contraction/faired.hpp"
#include "tests/soups.hpp"

namespace curveskel::fair_laws {
namespace {

using shapes::Shape;

double mean_normal_error_degrees(const Surface& surface, const Surface& clean) {
  double sum = 0;
  double weight = 0;
  for (Eigen::Index f = 0; f < clean.triangles.rows(); ++f) {
    const auto normal = [&](const Surface& s) -> Eigen::Vector3d {
      const Eigen::Vector3d a = s.positions.row(s.triangles(f, 0));
      const Eigen::Vector3d b = s.positions.row(s.triangles(f, 1));
      const Eigen::Vector3d c = s.positions.row(s.triangles(f, 2));
      return (b - a).cross(c - a);
    };
    const Eigen::Vector3d found = normal(surface);
    const Eigen::Vector3d wanted = normal(clean);
    sum += wanted.norm() * std::atan2(found.cross(wanted).norm(), found.dot(wanted));
    weight += wanted.norm();
  }
  return sum / weight * 180 / std::numbers::pi;
}

TEST(Fair, HostClosedFormIsTheQrSolution) {
  for (const Shape& shape : noisy_and_clean_shapes()) {
    for (const double smoothing : {0.1, 1.0, 30.0}) {
      FairOptions options = with(FairMethod::cpu, 1);
      options.smoothing = smoothing;
      options.volume = VolumeRule::keep;
      const Surface by_qr = fair(shape.surface, options, {});
      options.method = FairMethod::host;
      const Surface closed = fair(shape.surface, options, {});
      EXPECT_LT(largest_difference(closed, by_qr), 1e-12) << shape.name << ", mu " << smoothing;
      EXPECT_GT(largest_difference(closed, shape.surface), 1e-5) << shape.name << " did not move";
    }
  }
}

TEST(Fair, DeviceAgreesWithTheReferenceAfterTenIterations) {
  SKIP_WITHOUT_DEVICE();
  for (const Shape& shape : noisy_and_clean_shapes()) {
    const Surface reference = fair(shape.surface, with(FairMethod::cpu, 10), {});
    const Surface single = fair(shape.surface, with(FairMethod::opencl, 10), {});
    const Surface twice = fair(shape.surface, with(FairMethod::opencl, 10, true), {});
    EXPECT_LT(largest_difference(single, reference), 1e-4) << shape.name;
    EXPECT_LT(largest_difference(twice, reference), 1e-10) << shape.name;
  }
}

TEST(Fair, AnyValenceWillDo) {
  const Shape cone = shapes::cone(1, 2, 5000);
  const Surface reference = fair(cone.surface, with(FairMethod::cpu, 1), {});
  const Surface host = fair(cone.surface, with(FairMethod::host, 1), {});
  EXPECT_LT(largest_difference(host, reference), 1e-10);
  SKIP_WITHOUT_DEVICE();
  EXPECT_LT(largest_difference(fair(cone.surface, with(FairMethod::opencl, 1), {}), reference),
            1e-4);
  EXPECT_LT(
      largest_difference(fair(cone.surface, with(FairMethod::opencl, 1, true), {}), reference),
      1e-10);
}

TEST(Fair, ChangesNoTriangleAndMovesWithTheSurface) {
  const Shape shape = shapes::noisy(shapes::torus(2, 0.6, 12), 0.02, 5);
  const Surface faired = fair(shape.surface, with(FairMethod::host, 5), {});
  EXPECT_EQ(faired.triangles, shape.surface.triangles);
  for (const double factor : {1e-300, 1e-170, 1e-9, 1e-3, 1e3, 1e9, 1e160, 1e300}) {
    Surface expected = faired;
    expected.positions *= factor;
    Monitor monitor;
    monitor.frame = [](const Frame& frame) {
      EXPECT_NEAR(frame.area_ratio, 0.98, 0.03);
      EXPECT_NEAR(frame.volume_ratio, 1, 1e-9);
    };
    const Surface scaled =
        fair(shapes::scaled(shape, factor).surface, with(FairMethod::host, 5), monitor);
    ASSERT_TRUE(scaled.positions.allFinite()) << factor;
    EXPECT_LT(largest_difference(scaled, expected), 1e-12) << factor;
  }
  Surface expected = faired;
  expected.positions.rowwise() += Eigen::RowVector3d(100, -200, 300);
  const Surface moved =
      fair(shapes::translated(shape, {100, -200, 300}).surface, with(FairMethod::host, 5), {});
  EXPECT_LT(largest_difference(moved, expected), 1e-11);
}

TEST(Fair, RefusesASurfaceTooLargeForNumbers) {
  const Surface huge = shapes::scaled(shapes::torus(2, 0.6, 12), 5e307).surface;
  try {
    (void)fair(huge, {}, {});
    FAIL() << "it was faired";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_NE(std::string(error.what()).find("scale the surface down"), std::string::npos);
  }
}

TEST(Fair, SameBytesForAnyNumberOfThreads) {
  const Shape shape = shapes::noisy(shapes::ellipsoid({1, 1.5, 2}, 4), 0.02, 6);
  FairOptions options;
  options.threads = 1;
  const Surface one = fair(shape.surface, options, {});
  for (const int threads : {0, 2, 3}) {
    options.threads = threads;
    EXPECT_EQ(fair(shape.surface, options, {}).positions, one.positions) << threads;
  }
  options.method = choose_fair_method(FairMethod::automatic);
  EXPECT_EQ(fair(shape.surface, options, {}).positions, one.positions);
}

TEST(Fair, EveryComponentGetsItsVolumeBack) {
  Shape ball = shapes::ellipsoid({0.3, 0.3, 0.5}, 3);
  Shape inward = shapes::translated(shapes::torus(2, 0.6, 12), {0, 0, 5});
  inward.surface.triangles.col(1).swap(inward.surface.triangles.col(2));
  const Shape both = shapes::together("both", {shapes::noisy(ball, 0.01, 7), inward});
  const Topology parts = topology(both.surface);
  ASSERT_EQ(parts.components(), 2);
  const auto before = split_components(both.surface, parts);
  for (const VolumeRule rule : {VolumeRule::offset, VolumeRule::scale}) {
    FairOptions options = with(FairMethod::host, 10);
    options.volume = rule;
    const auto after = split_components(fair(both.surface, options, {}), parts);
    for (std::size_t i = 0; i < 2; ++i) {
      const double wanted = volume(before[i].surface);
      EXPECT_NEAR(volume(after[i].surface) / wanted, 1, 1e-9) << name_of(volume_rules, rule);
    }
  }
  FairOptions options = with(FairMethod::host, 10);
  options.volume = VolumeRule::keep;
  EXPECT_LT(volume(fair(ball.surface, options, {})), 0.99 * volume(ball.surface));
}

/// A cube of eight vertices: one iteration takes nine tenths of its volume.
Shape coarse_cube() { return shapes::box({0.2, 0.2, 0.2}, 1); }

TEST(Fair, ComponentsTooCoarseForTheFlowStayAsTheyWere) {
  const Shape cube = coarse_cube();
  const Shape ball = shapes::noisy(shapes::ellipsoid({1, 1.5, 2}, 3), 0.02, 2);
  const Shape both = shapes::together("both", {cube, shapes::translated(ball, {5, 0, 0})});
  const Eigen::Index corners = cube.surface.positions.rows();
  for (const VolumeRule rule : {VolumeRule::offset, VolumeRule::scale}) {
    FairOptions options = with(FairMethod::host, 3);
    options.volume = rule;
    std::string notes;
    Monitor monitor;
    monitor.note = [&](std::string_view line) { notes += line; };
    const Surface faired = fair(both.surface, options, monitor);
    EXPECT_EQ(faired.positions.topRows(corners), both.surface.positions.topRows(corners));
    EXPECT_NE(
        notes.find("1 of 2 components is too coarse to be faired, which would cost its shape: "
                   "left as it was"),
        std::string::npos)
        << notes;
    notes.clear();
    const Shape more = shapes::together("more", {both, shapes::translated(cube, {9, 0, 0})});
    static_cast<void>(fair(more.surface, options, monitor));
    EXPECT_NE(notes.find("2 of 3 components are too coarse to be faired, which would cost their "
                         "shape: left as they were"),
              std::string::npos)
        << notes;
    Surface rest = fair(ball.surface, options, {});
    rest.positions.rowwise() += Eigen::RowVector3d(5, 0, 0);
    EXPECT_LT((faired.positions.bottomRows(rest.positions.rows()) - rest.positions).norm(), 1e-12);
  }
  EXPECT_EQ(fair(cube.surface, with(FairMethod::host, 1), {}).positions, cube.surface.positions);
}

/// A square sheet of two sides, the inner vertices of one moved within it: its volume is rounding.
Surface flat_sheet() {
  Surface sheet = shapes::box({1, 1, 1}, 8).surface;
  for (Eigen::Index v = 0; v < sheet.positions.rows(); ++v) {
    const Eigen::RowVector3d p = sheet.positions.row(v);
    const double shift = 0.01 * std::sin(37 * p.z());
    sheet.positions.row(v) << p.x() + shift, p.y(), 0;
  }
  return sheet;
}

TEST(Fair, ASheetWithoutVolumeIsNotBlownUp) {
  const Surface sheet = flat_sheet();
  for (int turn = 0; turn < 8; ++turn) {
    const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.3 + 0.41 * turn, axis).matrix();
    Surface turned = sheet;
    turned.positions = sheet.positions * rotation.transpose();
    for (const VolumeRule rule : {VolumeRule::offset, VolumeRule::scale}) {
      FairOptions options = with(FairMethod::host, 3);
      options.volume = rule;
      EXPECT_LT(largest_difference(fair(turned, options, {}), turned), 0.2) << turn;
    }
  }
}

TEST(Fair, NoComponentLosesDigitsToALargerOne) {
  const Shape ball = shapes::noisy(shapes::ellipsoid({1, 1.5, 2}, 3), 0.02, 2);
  const Shape small = shapes::translated(shapes::scaled(ball, 1e-7), {10, 0, 0});
  const Shape both = shapes::together("both", {ball, small});
  const Eigen::Index vertices = ball.surface.positions.rows();
  std::vector<FairMethod> methods{FairMethod::host};
  if (!devices().empty()) methods.push_back(FairMethod::opencl);
  for (const FairMethod method : methods) {
    const Surface alone = fair(small.surface, with(FairMethod::host, 3), {});
    const Surface faired = fair(both.surface, with(method, 3), {});
    const Surface part{faired.positions.bottomRows(vertices), ball.surface.triangles};
    EXPECT_LT(largest_difference(part, alone), 1e-4) << name_of(fair_methods, method);
  }
}

TEST(Fair, AVertexWithoutFacesFarOffIsNoMatter) {
  Surface open = shapes::noisy(shapes::torus(2, 0.6, 12), 0.02, 9).surface;
  open.triangles.conservativeResize(open.triangles.rows() - 7, 3);
  Surface with_far_vertex = open;
  with_far_vertex.positions.conservativeResize(open.positions.rows() + 1, 3);
  with_far_vertex.positions.bottomRows(1) << 1e9, 0, 0;
  std::vector<FairMethod> methods{FairMethod::cpu, FairMethod::host};
  if (!devices().empty()) methods.push_back(FairMethod::opencl);
  for (const FairMethod method : methods) {
    const Positions faired = fair(with_far_vertex, with(method, 3), {}).positions;
    const Surface alone = fair(open, with(method, 3), {});
    EXPECT_EQ(faired.topRows(open.positions.rows()), alone.positions);
    EXPECT_EQ(faired.bottomRows(1), with_far_vertex.positions.bottomRows(1));
  }
}

TEST(Fair, NormalErrorOfANoisySurfaceHalves) {
  for (const Shape& clean : {shapes::tube("tube", shapes::s_curve(6, 2), shapes::constant(0.5), 24),
                             shapes::ellipsoid({1, 1.5, 2}, 4), shapes::torus(2, 0.6, 24)}) {
    const double noise = 0.002 * bounding_box_diagonal(clean.surface.positions);
    const Shape noisy = shapes::noisy(clean, noise, 8);
    const Surface faired = fair(noisy.surface, {}, {});
    EXPECT_LT(mean_normal_error_degrees(faired, clean.surface),
              mean_normal_error_degrees(noisy.surface, clean.surface) / 2)
        << clean.name;
  }
}

TEST(Fair, BoundaryVerticesStayWhereTheyAre) {
  Shape open = shapes::noisy(shapes::torus(2, 0.6, 12), 0.02, 9);
  const Eigen::Index faces = open.surface.triangles.rows();
  open.surface.triangles.conservativeResize(faces - 7, 3);  // holes
  std::vector<bool> on_boundary(static_cast<std::size_t>(open.surface.positions.rows()));
  const Triangles lost = shapes::noisy(shapes::torus(2, 0.6, 12), 0.02, 9).surface.triangles;
  for (Eigen::Index f = faces - 7; f < faces; ++f) {
    for (int k = 0; k < 3; ++k) on_boundary[static_cast<std::size_t>(lost(f, k))] = true;
  }
  const Surface faired = fair(open.surface, with(FairMethod::host, 3), {});
  int moved = 0;
  for (Eigen::Index v = 0; v < faired.positions.rows(); ++v) {
    const bool same = faired.positions.row(v) == open.surface.positions.row(v);
    if (on_boundary[static_cast<std::size_t>(v)]) {
      EXPECT_TRUE(same) << v;
    }
    moved += same ? 0 : 1;
  }
  EXPECT_GT(moved, 0.9 * static_cast<double>(faired.positions.rows()));
}

TEST(Fair, OfPolygonsSeamsMoveWhetherOrNotTheSurfaceIsClosed) {
  for (const Shape& shape : noisy_and_clean_shapes()) {
    for (const Eigen::Index missing : {0, 2}) {
      Surface surface = shape.surface;
      surface.triangles.conservativeResize(surface.triangles.rows() - missing, 3);
      const Surface whole = fair(surface);
      const Surface in_pieces = fair_polygons(torn(soup_of(surface)));
      for (Eigen::Index corner = 0; corner < surface.triangles.size(); ++corner) {
        const std::int32_t v = surface.triangles.data()[corner];
        const double apart = (in_pieces.positions.row(corner) - whole.positions.row(v)).norm();
        EXPECT_LE(apart, 1e-9 * bounding_box_diagonal(surface.positions)) << shape.name;
      }
    }
  }
}

TEST(Fair, DegenerateFacesAndNothingAtAllAreNoTrouble) {
  EXPECT_EQ(fair(Surface{}, {}, {}).positions.rows(), 0);
  Shape ball = shapes::ellipsoid({1, 1, 1}, 2);
  ball.surface.positions.row(ball.surface.triangles(0, 1)) =
      ball.surface.positions.row(ball.surface.triangles(0, 0));
  for (const FairMethod method : {FairMethod::cpu, FairMethod::host}) {
    EXPECT_TRUE(fair(ball.surface, with(method, 3), {}).positions.allFinite());
  }
  ball.surface.positions.setOnes();
  EXPECT_EQ(fair(ball.surface, {}, {}).positions, ball.surface.positions);
}

TEST(Fair, ShowsWhatFewerIterationsWouldHaveGiven) {
  const Shape shape = noisy_and_clean_shapes().front();
  for (const FairMethod method : {FairMethod::cpu, FairMethod::host}) {
    FairOptions options = with(method, 3);
    for (const VolumeRule volume_rule : {VolumeRule::offset, VolumeRule::keep}) {
      options.volume = volume_rule;
      int shown = 0;
      Monitor monitor;
      monitor.frame = [&](const Frame& frame) {
        EXPECT_EQ(frame.stage, "fair");
        EXPECT_EQ(frame.component, 0);
        EXPECT_EQ(frame.iteration, shown++);
        FairOptions fewer = options;
        fewer.iterations = frame.iteration;
        EXPECT_EQ(frame.surface.positions, fair(shape.surface, fewer, {}).positions);
        EXPECT_NEAR(frame.area_ratio, area(frame.surface) / area(shape.surface), 1e-12);
        EXPECT_NEAR(frame.volume_ratio, volume(frame.surface) / volume(shape.surface), 1e-12);
      };
      const Surface watched = fair(shape.surface, options, monitor);
      EXPECT_EQ(shown, options.iterations + 1);
      EXPECT_EQ(watched.positions, fair(shape.surface, options, {}).positions);
    }
  }
}

TEST(Fair, StopsWhenAskedTo) {
  std::stop_source source;
  Monitor monitor;
  monitor.stop = source.get_token();
  source.request_stop();
  EXPECT_THROW((void)fair(shapes::ellipsoid({1, 1, 1}, 2).surface, {}, monitor), Cancelled);
}

}  // namespace
}  // namespace curveskel::fair_laws
