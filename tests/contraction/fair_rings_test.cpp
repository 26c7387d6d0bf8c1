// Laws of the local flow over patches of more than one ring, and by a QR per vertex.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stop_token>

#include <curveskel/clean.hpp>
#include <curveskel/contract.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include "contraction/fairing/local_flow.hpp"
#include "contraction/fairing/patch_solution.hpp"
#include "tests/contraction/faired.hpp"
#include "tests/real_surfaces.hpp"

namespace curveskel::fair_rings_laws {
namespace {

using shapes::Shape;

FairOptions with_rings(FairMethod method, int rings, int iterations,
                       bool double_precision = false) {
  FairOptions options = with(method, iterations, double_precision);
  options.rings = rings;
  options.local_solver = LocalSolver::qr;
  options.volume = VolumeRule::keep;
  return options;
}

/// Edges from `centre` to each vertex, up to `rings`; -1 beyond.
std::vector<int> distances_from(Eigen::Index centre, const Surface& surface, int rings) {
  std::vector<int> distances(static_cast<std::size_t>(surface.positions.rows()), -1);
  distances[static_cast<std::size_t>(centre)] = 0;
  for (int ring = 1; ring <= rings; ++ring) {
    const std::vector<int> before = distances;
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
      const auto corners = surface.triangles.row(f);
      const auto near = [&](int v) { return before[static_cast<std::size_t>(v)] == ring - 1; };
      if (!near(corners[0]) && !near(corners[1]) && !near(corners[2])) continue;
      for (const int v : corners) {
        int& distance = distances[static_cast<std::size_t>(v)];
        if (distance < 0) distance = ring;
      }
    }
  }
  return distances;
}

TEST(Patches, HoldWhatIsWithinTheRings) {
  const Surface surface = shapes::noisy(shapes::ellipsoid({1, 1.5, 2}, 2), 0.02, 1).surface;
  const auto corners = corners_by_vertex(surface.triangles, surface.positions.rows());
  for (const int rings : {1, 2, 3, 100}) {
    PatchFinder finder(surface.triangles, corners, rings);
    for (Eigen::Index v = 0; v < surface.positions.rows(); v += 7) {
      const Patch& patch = finder.of(static_cast<std::int32_t>(v));
      const std::vector<int> distances = distances_from(v, surface, rings);
      EXPECT_EQ(patch.vertices.front(), v);
      const std::set<int> found(patch.vertices.begin(), patch.vertices.end());
      EXPECT_EQ(found.size(), patch.vertices.size());
      for (Eigen::Index w = 0; w < surface.positions.rows(); ++w) {
        EXPECT_EQ(found.contains(static_cast<int>(w)), distances[static_cast<std::size_t>(w)] >= 0);
      }
      std::size_t faces = 0;
      for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
        const auto face = surface.triangles.row(f);
        faces += std::any_of(face.begin(), face.end(), [&](int w) {
          const int distance = distances[static_cast<std::size_t>(w)];
          return distance >= 0 && distance < rings;
        });
      }
      EXPECT_EQ(patch.triangles.size(), faces);
    }
  }
}

TEST(PatchSolution, AllWaysAgree) {
  for (const Shape& shape : noisy_and_clean_shapes()) {
    Surface surface = shape.surface;
    surface.positions /= bounding_box_diagonal(surface.positions);
    const auto corners = corners_by_vertex(surface.triangles, surface.positions.rows());
    for (const int rings : {1, 2, 3}) {
      PatchFinder finder(surface.triangles, corners, rings);
      for (Eigen::Index v = 0; v < surface.positions.rows(); v += 31) {
        const Patch& patch = finder.of(static_cast<std::int32_t>(v));
        for (const double smoothing : {0.1, 1.0, 30.0}) {
          const auto full = centre_step_by_full_qr(patch, surface.positions, smoothing);
          const auto short_qr = centre_step_by_qr(patch, surface.positions, smoothing);
          const auto lu = centre_step_by_lu(patch, surface.positions, smoothing);
          EXPECT_LT((short_qr - full).norm(), 1e-13) << shape.name << ' ' << rings << ' ' << v;
          EXPECT_LT((lu - full).norm(), 1e-13) << shape.name << ' ' << rings << ' ' << v;
        }
      }
    }
  }
}

TEST(FairRings, HostIsTheReference) {
  for (const Shape& shape : noisy_and_clean_shapes()) {
    for (const int rings : {1, 2, 3}) {
      const Surface reference = fair(shape.surface, with_rings(FairMethod::cpu, rings, 1), {});
      const Surface host = fair(shape.surface, with_rings(FairMethod::host, rings, 1), {});
      EXPECT_LT(largest_difference(host, reference), 1e-12) << shape.name << ", " << rings;
      EXPECT_GT(largest_difference(host, shape.surface), 1e-5) << shape.name << " did not move";
    }
  }
}

TEST(FairRings, OneRingByQrIsTheClosedForm) {
  const bool device = !devices().empty();
  for (const Shape& shape : noisy_and_clean_shapes()) {
    FairOptions options = with_rings(FairMethod::host, 1, 1);
    const Surface by_qr = fair(shape.surface, options, {});
    options.local_solver = LocalSolver::closed;
    EXPECT_LT(largest_difference(fair(shape.surface, options, {}), by_qr), 1e-12) << shape.name;
    if (!device) continue;
    options.method = FairMethod::opencl;
    options.double_precision = true;
    const Surface closed = fair(shape.surface, options, {});
    options.local_solver = LocalSolver::qr;
    EXPECT_LT(largest_difference(fair(shape.surface, options, {}), closed), 1e-12) << shape.name;
  }
}

TEST(FairRings, DeviceAgreesWithTheReferenceAfterTenIterations) {
  SKIP_WITHOUT_DEVICE();
  const std::vector<Shape> all = noisy_and_clean_shapes();
  for (const std::size_t i : {1U, 3U, 5U}) {  // a few, as the reference takes its time at K = 3
    const Shape& shape = all[i];
    for (const int rings : {1, 2, 3}) {
      const Surface reference = fair(shape.surface, with_rings(FairMethod::host, rings, 10), {});
      const Surface single = fair(shape.surface, with_rings(FairMethod::opencl, rings, 10), {});
      const Surface twice =
          fair(shape.surface, with_rings(FairMethod::opencl, rings, 10, true), {});
      EXPECT_LT(largest_difference(single, reference), 1e-4) << shape.name << ", " << rings;
      EXPECT_LT(largest_difference(twice, reference), 1e-10) << shape.name << ", " << rings;
    }
  }
}

TEST(ThoroughFairRings, PatchesOfAnySizeWillDo) {
  SKIP_WITHOUT_DEVICE();
  for (const int sides : {30, 100, 520}) {  // in private memory, in the workspace, on the host
    const Shape cone = shapes::cone(1, 2, sides);
    const Surface host = fair(cone.surface, with_rings(FairMethod::host, 2, 1), {});
    const Surface device = fair(cone.surface, with_rings(FairMethod::opencl, 2, 1, true), {});
    EXPECT_LT(largest_difference(device, host), 1e-12) << sides;
    FairOptions options = with_rings(FairMethod::opencl, 2, 1, true);
    options.threads = 1;
    EXPECT_EQ(fair(cone.surface, options, {}).positions, device.positions) << sides;
  }
}

/// The memory that the patches of all vertices take on the device, the workspace in full.
std::size_t bytes_on_device(const Surface& surface, int rings, const Device& device) {
  const auto corners = corners_by_vertex(surface.triangles, surface.positions.rows());
  PatchFinder finder(surface.triangles, corners, rings);
  std::size_t indices = 0;
  for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
    const Patch& patch = finder.of(static_cast<std::int32_t>(v));
    indices += patch.vertices.size() + 3 * patch.triangles.size() + 2;
  }
  return indices * sizeof(int) + std::min(std::size_t{1} << 28U, device.memory_bytes / 16);
}

TEST(FairRings, PatchesThatFillTheDeviceAreRefused) {
  SKIP_WITHOUT_DEVICE();
  Surface surface = shapes::ellipsoid({1, 1.5, 2}, 3).surface;
  surface.positions /= bounding_box_diagonal(surface.positions);
  const OneRings around = one_rings(surface.triangles, surface.positions.rows());
  const std::vector<Device> found = devices();
  const Device& device = found[choose_device(found, {}, "this test", "")];
  const auto placed = [&](int rings, std::size_t memory_bytes) {
    const FairOptions options = with_rings(FairMethod::opencl, rings, 1);
    (void)make_opencl_patch_flow(surface, around, options, {}, memory_bytes);
  };
  const std::size_t enough = bytes_on_device(surface, 2, device);
  EXPECT_NO_THROW(placed(1, enough));
  EXPECT_NO_THROW(placed(2, enough));
  EXPECT_THROW(placed(2, enough - 1), Error);
  try {
    placed(3, enough);
    FAIL() << "more rings were placed in the memory of fewer";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.fault(), Fault::device);
    for (const std::string& said :
         {std::string("patches of 3 rings"), device.name, std::string("use fewer rings"),
          std::string("the method host"), std::to_string(enough >> 20U)}) {
      EXPECT_NE(message.find(said), std::string::npos) << said << " is not in: " << message;
    }
  }
}

/// A token of a stop that was asked for.
std::stop_token stopped() {
  std::stop_source source;
  source.request_stop();
  return source.get_token();
}

TEST(FairRings, PlacingPatchesOnADeviceStopsWhenAsked) {
  SKIP_WITHOUT_DEVICE();
  Surface surface = shapes::ellipsoid({1, 1.5, 2}, 3).surface;
  surface.positions /= bounding_box_diagonal(surface.positions);
  const OneRings around = one_rings(surface.triangles, surface.positions.rows());
  const FairOptions options = with_rings(FairMethod::opencl, 2, 1);
  EXPECT_THROW((void)make_opencl_patch_flow(surface, around, options, stopped()), Cancelled);
}

TEST(FairRings, TheReferenceStopsBetweenTwoVertices) {
  const Surface few = shapes::ellipsoid({1, 1, 1}, 1).surface;  // than are reported together
  const OneRings around = one_rings(few.triangles, few.positions.rows());
  const FairOptions options = with_rings(FairMethod::cpu, 2, 1);
  std::stop_source source;
  Monitor monitor;
  monitor.stop = source.get_token();
  int reports = 0;
  monitor.progress = [&](std::string_view, double) {
    ++reports;
    source.request_stop();
  };
  EXPECT_THROW(make_cpu_flow(few, around, options)->advance(1, monitor), Cancelled);
  EXPECT_EQ(reports, 1);
}

TEST(FairRings, AnyValenceWillDoByEveryMethodAndLocalSolver) {
  const Shape cone = shapes::cone(1, 2, 5000);
  const Surface reference = fair(cone.surface, with_rings(FairMethod::cpu, 1, 1), {});
  for (const LocalSolver solver : {LocalSolver::closed, LocalSolver::qr}) {
    FairOptions options = with_rings(FairMethod::host, 1, 1);
    options.local_solver = solver;
    EXPECT_LT(largest_difference(fair(cone.surface, options, {}), reference), 1e-10);
    if (devices().empty()) continue;
    for (const FairMethod method : {FairMethod::opencl, FairMethod::opencl_transfer}) {
      options.method = method;
      for (const bool double_precision : {false, true}) {
        options.double_precision = double_precision;
        EXPECT_LT(largest_difference(fair(cone.surface, options, {}), reference),
                  double_precision ? 1e-10 : 1e-4)
            << name_of(fair_methods, method) << ", " << name_of(local_solvers, solver);
      }
    }
  }
}

bool shares_with_opengl() {
  const std::vector<Device> found = devices();
  return std::any_of(found.begin(), found.end(), [](const Device& d) { return d.gl_sharing; });
}

/// The positions after each way of keeping them on the device, beside those that stay there.
void expect_the_bytes_of_resident_positions(FairMethod method) {
  const Shape shape = shapes::noisy(shapes::torus(2, 0.6, 12), 0.02, 5);
  for (const int rings : {1, 2}) {
    for (const LocalSolver solver : {LocalSolver::closed, LocalSolver::qr}) {
      for (const bool double_precision : {false, true}) {
        FairOptions options = with_rings(FairMethod::opencl, rings, 5, double_precision);
        options.local_solver = solver;
        const Surface resident = fair(shape.surface, options, {});
        options.method = method;
        EXPECT_EQ(fair(shape.surface, options, {}).positions, resident.positions) << rings;
      }
    }
  }
}

TEST(FairRings, TransferringGivesTheSameBytes) {
  SKIP_WITHOUT_DEVICE();
  expect_the_bytes_of_resident_positions(FairMethod::opencl_transfer);
}

TEST(FairRings, SharingWithOpenGLGivesTheSameBytes) {
  if (!shares_with_opengl()) GTEST_SKIP() << "no device here shares with OpenGL";
  expect_the_bytes_of_resident_positions(FairMethod::opencl_interop);
}

TEST(FairRings, InteropIsRefusedWithWhatIsMissingAndWhatWorks) {
  if (shares_with_opengl()) GTEST_SKIP() << "a device here shares with OpenGL";
  try {
    (void)fair(shapes::torus(2, 0.6, 12).surface, with(FairMethod::opencl_interop, 1), {});
    FAIL() << "it ran";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.fault(), Fault::device);
    EXPECT_NE(message.find("opencl-interop"), std::string::npos) << message;
    EXPECT_NE(message.find("use the method opencl"), std::string::npos) << message;
    EXPECT_TRUE(devices().empty() || message.find("cl_khr_gl_sharing") != std::string::npos);
  }
}

TEST(FairRings, SameBytesForAnyNumberOfThreads) {
  const Shape shape = shapes::noisy(shapes::ellipsoid({1, 1.5, 2}, 4), 0.02, 6);
  FairOptions options = with_rings(FairMethod::host, 2, 1);
  options.threads = 1;
  const Surface one = fair(shape.surface, options, {});
  for (const int threads : {0, 2, 3}) {
    options.threads = threads;
    EXPECT_EQ(fair(shape.surface, options, {}).positions, one.positions) << threads;
  }
}

TEST(FairRings, TheSameVerticesAreHeldForAnyNumberOfRings) {
  Surface open = shapes::noisy(shapes::torus(2, 0.6, 12), 0.02, 9).surface;
  open.triangles.conservativeResize(open.triangles.rows() - 7, 3);  // holes
  const auto moved = [&](const FairOptions& options) {
    const Positions after = fair(open, options, {}).positions;
    EXPECT_TRUE(after.allFinite());
    std::vector<bool> rows;
    for (Eigen::Index v = 0; v < after.rows(); ++v) {
      rows.push_back(after.row(v) != open.positions.row(v));
    }
    return rows;
  };
  const std::vector<bool> by_one = moved(with_rings(FairMethod::host, 1, 2));
  EXPECT_TRUE(std::count(by_one.begin(), by_one.end(), false) > 3);
  for (const int rings : {2, 3}) {
    EXPECT_EQ(moved(with_rings(FairMethod::host, rings, 2)), by_one) << rings;
    EXPECT_EQ(moved(with_rings(FairMethod::cpu, rings, 2)), by_one) << rings;
  }
}

TEST(FairRings, NothingIsLostWhereAllIsHeld) {
  Surface open = shapes::torus(2, 0.6, 12).surface;
  open.triangles.conservativeResize(1, 3);
  for (const FairMethod method : {FairMethod::cpu, FairMethod::host, FairMethod::opencl}) {
    if (method == FairMethod::opencl && devices().empty()) continue;
    EXPECT_EQ(fair(open, with_rings(method, 2, 2), {}).positions, open.positions);
    EXPECT_EQ(fair(open, with(method, 2), {}).positions, open.positions);
  }
}

TEST(FairRings, NeedsARing) {
  EXPECT_THROW(
      (void)fair(shapes::torus(2, 0.6, 12).surface, with_rings(FairMethod::host, 0, 1), {}), Error);
}

/// Models as artists make them, of parts that are mostly coarse.
std::vector<std::filesystem::path> models() {
  std::vector<std::filesystem::path> files;
  for (const auto& folder : real_surface_folders()) {
    for (const char* of : {"real", "characters", "rigs"}) {
      if (!std::filesystem::exists(folder / of)) continue;
      for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / of)) {
        if (entry.path().extension() == ".glb") files.push_back(entry.path());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(RealModels, AreFairedHoweverCoarseTheirParts) {
  const std::vector<std::filesystem::path> files = models();
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    const Surface surface = repair(read_polygons(file, {}), {}, {}).surface;
    for (const VolumeRule rule : {VolumeRule::offset, VolumeRule::scale}) {
      FairOptions options = with(FairMethod::host, 3);
      options.volume = rule;
      const Surface faired = fair(surface, options, {});
      const bool offset = rule == VolumeRule::offset;
      EXPECT_LT(largest_difference(faired, surface), offset ? 0.25 : 0.5) << file;
      EXPECT_LT(area(faired), (offset ? 1.2 : 1.5) * area(surface)) << file;
    }
  }
}

/// The negative result of the paper: the local flow does not contract to zero volume.
void expect_only_the_global_flow_contracts(const std::string& name, const Surface& surface) {
  const double before = volume(surface);
  double larger = 1;
  for (const int rings : {1, 2, 3}) {
    const Surface after = fair(surface, with_rings(FairMethod::host, rings, 30), {});
    const double ratio = volume(after) / before;
    EXPECT_LT(ratio, larger) << name << ", " << rings;
    EXPECT_GT(ratio, 0.01) << name << ", " << rings;
    larger = ratio;
  }
  ContractionOptions options;
  options.flow = Flow::paper;
  options.max_iterations = 6;
  const Contraction contraction = contract(surface, {}, options, {});
  ASSERT_FALSE(contraction.steps.empty());
  EXPECT_LT(contraction.steps.back().volume_ratio, 0.01) << name;
}

TEST(LocalAgainstGlobal, OnlyTheGlobalFlowContractsAShape) {
  const Shape tube = shapes::tube("tube", shapes::s_curve(4, 1), shapes::wavy(0.8, 0.1, 2), 36);
  expect_only_the_global_flow_contracts(tube.name, tube.surface);
}

TEST(ThoroughLocalAgainstGlobal, OnlyTheGlobalFlowContractsARealSurface) {
  const auto path = real_surface("spot-3k.obj");
  ASSERT_TRUE(path);
  expect_only_the_global_flow_contracts("spot", clean(read_polygons(*path, {}), {}).surface);
}

}  // namespace
}  // namespace curveskel::fair_rings_laws
