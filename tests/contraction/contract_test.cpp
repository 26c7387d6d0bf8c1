// Laws of the contraction, for both flows, over the catalogue and over real surfaces.
#include <curveskel/contract.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/topology.hpp>
#include "meshes/shapes.hpp"
#include "tests/real_surfaces.hpp"

namespace curveskel::contract_laws {
namespace {

// The bounds of "ends near zero", for every surface of this file.
constexpr double near_zero_area = 1e-2;
constexpr double near_zero_volume = 1e-4;

struct Case {
  std::string name;
  Surface surface;
  Positions centres;
};

/// The inscribed balls' centres; a vertex without a ball is its own.
Positions ball_centres(const Surface& surface) {
  const SurfaceTree tree(surface);
  const Positions normals = vertex_normals(surface);
  const double largest = 0.49 * bounding_box_diagonal(surface.positions);
  Positions centres = surface.positions;
  for (Eigen::Index v = 0; v < centres.rows(); ++v) {
    const auto ball = tree.inscribed_ball(surface.positions.row(v), -normals.row(v));
    if (ball.radius < largest && tree.inside(ball.centre)) centres.row(v) = ball.centre;
  }
  return centres;
}

void add_components(const std::string& name, const Surface& whole, int target_vertices,
                    std::vector<Case>& list) {
  for (auto& part : split_components(whole, topology(whole))) {
    Surface surface =
        coarsen(part.surface, {.target_vertices = target_vertices, .threads = 1}, {}).surface;
    Positions centres = ball_centres(surface);
    list.push_back({name, std::move(surface), std::move(centres)});
  }
}

/// Every 50th vertex's one-ring drawn together into a point: vertices without any area.
Surface with_collapsed_one_rings(Surface surface) {
  const Positions given = surface.positions;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      if (surface.triangles(f, k) % 50 != 0) continue;
      for (const int v : surface.triangles.row(f)) {
        surface.positions.row(v) = given.row(surface.triangles(f, k));
      }
    }
  }
  return surface;
}

const std::vector<Case>& shape_cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> list;
    for (const auto& entry : shapes::catalogue()) {
      add_components(std::string(entry.name), entry.make().surface, 2500, list);
    }
    const auto y = shapes::tube_union("", shapes::star(3, 6, 1));
    add_components("y, noisy", shapes::noisy(y, 0.1, 3).surface, 2500, list);
    add_components("y, collapsed one-rings", with_collapsed_one_rings(y.surface), 1 << 20, list);
    add_components("y, renumbered", shapes::renumbered(y, 3).surface, 2500, list);
    return list;
  }();
  return all;
}

/// The components of every closed orientable real surface.
const std::vector<Case>& real_cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> list;
    for (const auto& file : closed_real_surfaces()) {
      if (file.ends_with(".gz")) continue;  // a subdivided copy of another one
      const Surface whole = clean(read_polygons(*real_surface(file), {}), {}).surface;
      add_components(file, whole, 3000, list);
    }
    return list;
  }();
  return all;
}

const Case& named(const std::string& name) {
  for (const auto& each : shape_cases()) {
    if (each.name == name) return each;
  }
  throw std::logic_error("no shape " + name);
}

Contraction contracted(const Case& each, Flow flow = Flow::medial) {
  ContractionOptions options;
  options.flow = flow;
  return contract(each.surface, each.centres, options, {});
}

void expect_laws(const Case& each, const Contraction& result) {
  ASSERT_FALSE(result.steps.empty());
  Step before;
  before.vertices = static_cast<int>(each.surface.positions.rows());
  for (const Step& step : result.steps) {
    EXPECT_LE(step.area_ratio, before.area_ratio);
    EXPECT_LE(step.volume_ratio, before.volume_ratio);
    EXPECT_LE(step.vertices, before.vertices);
    EXPECT_LE(step.residual, 1e-4);
    EXPECT_NE(step.solver, Solver::automatic);
    before = step;
  }
  EXPECT_LE(before.area_ratio, near_zero_area);
  EXPECT_LE(before.volume_ratio, near_zero_volume);
  // The last step says what is true of the surface.
  EXPECT_EQ(before.vertices, result.surface.positions.rows());
  EXPECT_NEAR(before.area_ratio, area(result.surface) / area(each.surface), 1e-9);
  EXPECT_EQ(topology(result.surface).genus, topology(each.surface).genus);

  ASSERT_EQ(result.vertex_of_input.size(), each.surface.positions.rows());
  std::vector<int> members(static_cast<std::size_t>(result.surface.positions.rows()), 0);
  for (const int v : result.vertex_of_input) ++members.at(static_cast<std::size_t>(v));
  for (const int count : members) EXPECT_GT(count, 0);
}

class EveryFlow : public testing::TestWithParam<Flow> {};

TEST_P(EveryFlow, NeverGrowsAndEndsNearZeroOnEveryShape) {
  for (const auto& each : shape_cases()) {
    SCOPED_TRACE(each.name);
    expect_laws(each, contracted(each, GetParam()));
  }
}

TEST_P(EveryFlow, NeverGrowsAndEndsNearZeroOnRealSurfaces) {
  EXPECT_GE(real_cases().size(), collection_folder() ? 30U : 5U);
  for (const auto& each : real_cases()) {
    SCOPED_TRACE(each.name);
    expect_laws(each, contracted(each, GetParam()));
  }
}

TEST_P(EveryFlow, GivesTheSameBytesTwice) {
  const Case& each = named("double-torus");
  const Contraction first = contracted(each, GetParam());
  const Contraction second = contracted(each, GetParam());
  EXPECT_EQ(first.surface.positions, second.surface.positions);
  EXPECT_EQ(first.surface.triangles, second.surface.triangles);
  EXPECT_EQ(first.vertex_of_input, second.vertex_of_input);
}

// A power of two changes no digit, so not even the rounding may differ.
TEST_P(EveryFlow, DoesNotKnowTheUnit) {
  const Case& each = named("y");
  const Contraction reference = contracted(each, GetParam());
  for (const double factor : {std::ldexp(1.0, -60), std::ldexp(1.0, 60)}) {
    Case other = each;
    other.surface.positions *= factor;
    other.centres *= factor;
    const Contraction result = contracted(other, GetParam());
    EXPECT_EQ(result.surface.triangles, reference.surface.triangles) << factor;
    EXPECT_EQ(result.surface.positions, Positions(reference.surface.positions * factor)) << factor;
  }
}

TEST_P(EveryFlow, GivesTheSameWithEitherSolver) {
  const Case& each = named("torus");
  ContractionOptions options;
  options.flow = GetParam();
  options.max_iterations = 1;
  options.collapse_length = 0;  // the order of equally short edges would hang on the last digit
  std::vector<Positions> ends;
  for (const Solver solver : {Solver::cholesky, Solver::sparse_qr}) {
    options.solver = solver;
    const Contraction result = contract(each.surface, each.centres, options, {});
    EXPECT_EQ(result.steps.front().solver, solver);
    ends.push_back(result.surface.positions);
  }
  ASSERT_EQ(ends[0].rows(), ends[1].rows());
  EXPECT_LE((ends[0] - ends[1]).cwiseAbs().maxCoeff(),
            1e-7 * bounding_box_diagonal(each.surface.positions));
}

TEST_P(EveryFlow, StopsAfterTheIterationsAskedFor) {
  const Case& each = named("tube");
  for (const int iterations : {0, 1, 2}) {
    ContractionOptions options;
    options.flow = GetParam();
    options.max_iterations = iterations;
    const Contraction result = contract(each.surface, each.centres, options, {});
    EXPECT_EQ(result.steps.size(), static_cast<std::size_t>(iterations));
    EXPECT_EQ(result.stop, Stop::iterations);
  }
}

TEST_P(EveryFlow, ShowsEachIterationAndCanBeStoppedInAny) {
  const Case& each = named("tube");
  ContractionOptions options;
  options.flow = GetParam();
  std::vector<double> areas;
  Monitor monitor;
  monitor.frame = [&](const Frame& frame) {
    EXPECT_EQ(frame.stage, "contract");
    EXPECT_EQ(static_cast<std::size_t>(frame.iteration), areas.size());
    areas.push_back(area(frame.surface));
    EXPECT_NEAR(areas.back() / areas.front(), frame.area_ratio, 1e-9);
  };
  double last = 0;
  monitor.progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "contract");
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
  };
  const Contraction whole = contract(each.surface, each.centres, options, monitor);
  EXPECT_EQ(last, 1);
  ASSERT_EQ(areas.size(), whole.steps.size() + 1);
  for (std::size_t k = 0; k < whole.steps.size(); ++k) {
    EXPECT_NEAR(areas[k + 1] / areas[0], whole.steps[k].area_ratio, 1e-9);
  }
  for (std::size_t at = 0; at + 1 < areas.size(); ++at) {
    std::stop_source source;
    Monitor stopping;
    stopping.stop = source.get_token();
    stopping.frame = [&](const Frame& frame) {
      EXPECT_LE(static_cast<std::size_t>(frame.iteration), at);
      if (static_cast<std::size_t>(frame.iteration) == at) source.request_stop();
    };
    EXPECT_THROW((void)contract(each.surface, each.centres, options, stopping), Cancelled);
  }
}

TEST_P(EveryFlow, LeavesATetrahedronATetrahedron) {
  Case solid;
  solid.surface.positions.resize(4, 3);
  solid.surface.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  solid.surface.triangles.resize(4, 3);
  solid.surface.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  solid.centres = Eigen::RowVector3d(0.2, 0.2, 0.2).replicate(4, 1);
  const Contraction result = contracted(solid, GetParam());
  EXPECT_EQ(result.surface.triangles, solid.surface.triangles);
  EXPECT_LE(result.steps.back().volume_ratio, near_zero_volume);
}

INSTANTIATE_TEST_SUITE_P(Contract, EveryFlow, testing::Values(Flow::medial, Flow::paper),
                         [](const auto& each) { return std::string(name_of(flows, each.param)); });

// The rest of the program hands over good centres; if they were nonsense, the law still stands.
TEST(MedialFlow, NeverGrowsWhateverTheCentresAre) {
  const Case& each = named("y");
  const double diagonal = bounding_box_diagonal(each.surface.positions);
  Case odd = each;
  for (const int kind : {0, 1, 2}) {
    SCOPED_TRACE(kind);
    if (kind == 0) odd.centres = each.surface.positions;
    if (kind == 1) odd.centres = each.centres.colwise().reverse();
    if (kind == 2) odd.centres = each.centres.array() + 10 * diagonal;
    const Contraction result = contracted(odd);
    Step before;
    for (const Step& step : result.steps) {
      EXPECT_LE(step.area_ratio, before.area_ratio);
      EXPECT_LE(step.volume_ratio, before.volume_ratio);
      before = step;
    }
    EXPECT_TRUE(result.surface.positions.allFinite());
    EXPECT_EQ(topology(result.surface).genus, std::vector<int>{0});
  }
}

TEST(MedialFlow, TakesATubeToItsAxis) {
  const Case& tube = named("tube");
  const Contraction result = contracted(tube);
  const double away = result.surface.positions.rightCols(2).rowwise().norm().maxCoeff();
  EXPECT_LE(away, 0.05);  // of the radius
  // The tube's axis is 10 long, and the balls' centres fill it.
  EXPECT_GE(result.surface.positions.col(0).maxCoeff(), 4.0);
  EXPECT_LE(result.surface.positions.col(0).minCoeff(), -4.0);
}

TEST(Contract, RefusesWhatCannotBeContracted) {
  const Case& good = named("tube");
  const auto refused = [&](const Surface& surface, const Positions& centres,
                           const std::string& said) {
    try {
      (void)contract(surface, centres, {}, {});
      FAIL() << "no error: " << said;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  };
  refused({}, {}, "without faces");
  refused(good.surface, Positions(3, 3), "one ball centre per vertex");
  Case broken = good;
  broken.centres(7, 1) = std::numeric_limits<double>::quiet_NaN();
  refused(broken.surface, broken.centres, "finite");
  broken = good;
  broken.surface.positions.col(2).setZero();
  refused(broken.surface, broken.centres, "no volume");
}

}  // namespace
}  // namespace curveskel::contract_laws
