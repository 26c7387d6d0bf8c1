// Laws of what is shown: its colours agree with the skeleton, its coordinates keep their digits,
// and it does not matter in which order it came to be.
#include "viewer/render/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <curveskel/extract.hpp>
#include "meshes/shapes.hpp"
#include "tests/viewer/extracted_shapes.hpp"
#include "viewer/headless/headless.hpp"
#include "viewer/headless/screenshot.hpp"

namespace curveskel::viewer::scene_laws {
namespace {

using namespace extracted_shapes;

/// Of 125,000 vertices, so that it has simpler forms.
Surface large_surface() { return shapes::torus(3, 1, 210).surface; }

// A large file could not be stopped from being opened, once it was read.
TEST(Opening, StopsWhereverItIs) {
  const Document large = document_of(large_surface());
  std::vector<double> told;
  Monitor monitor;
  monitor.progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "prepare");
    told.push_back(fraction);
  };
  const Scene scene(large, monitor);
  ASSERT_GT(told.size(), 5U);
  EXPECT_EQ(told.front(), 0);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1);
  for (std::size_t reports = 0; reports + 1 < told.size(); ++reports) {
    std::stop_source stop;
    std::size_t seen = 0;
    Monitor stopped;
    stopped.stop = stop.get_token();
    stopped.progress = [&](std::string_view, double) {
      if (seen++ == reports) stop.request_stop();
    };
    EXPECT_THROW(Scene(large, stopped), Cancelled) << reports;
    EXPECT_EQ(seen, reports + 1) << "nothing more was begun";
  }
}

TEST(Opening, ALargeSurfaceIsSeenFromTheSameSideAsASmallOne) {
  for (const auto& made : {shapes::torus(3, 1, 20), shapes::cone(1, 4, 16)}) {
    shapes::Shape large = made;
    while (large.surface.positions.rows() < 110000) large = shapes::subdivided(large);
    const Scene small(document_of(made.surface));
    const Scene scene(document_of(large.surface));
    for (int row = 0; row < 3; ++row) {
      EXPECT_GT(glm::dot(scene.best_axes()[row], small.best_axes()[row]), 0.99F) << made.name;
    }
  }
}

TEST(ComponentsOf, ASurfaceAreNumberedByTheirFirstVertices) {
  const Surface rings = family()[1].surface;
  const Eigen::Index count = rings.positions.rows();
  Surface surface;  // a vertex without a face before, between and behind
  surface.positions.setZero(count + 2, 3);
  surface.positions.middleRows(1, count) = rings.positions;
  surface.triangles = rings.triangles.array() + 1;
  const std::vector<int> number = components_of(surface);
  EXPECT_EQ(number.front(), -1);
  EXPECT_EQ(number.back(), -1);
  EXPECT_EQ(number[1], 0);
  EXPECT_EQ(*std::max_element(number.begin(), number.end()), 1);
  for (const auto& triangle : surface.triangles.rowwise()) {
    for (int corner = 0; corner < 3; ++corner) {
      EXPECT_EQ(number[static_cast<std::size_t>(triangle[corner])],
                number[static_cast<std::size_t>(triangle[0])]);
    }
  }
}

TEST(ShownSkeleton, IsWhereTheSkeletonIs) {
  for (const Extracted& one : family()) {
    for (const auto& style : skeleton_styles) {
      Look look;
      look.skeleton = style.value;
      look.joints = false;
      const ShownSkeleton shown = shown_skeleton(one.skeleton, {}, 10, look, {});
      ASSERT_EQ(shown.edges.size(), static_cast<std::size_t>(one.skeleton.edges.rows()));
      for (std::size_t e = 0; e < shown.edges.size(); ++e) {
        const auto row = static_cast<Eigen::Index>(e);
        for (const bool second : {false, true}) {
          const Eigen::Index node = one.skeleton.edges(row, second ? 1 : 0);
          const glm::vec4 end = second ? shown.edges[e].to : shown.edges[e].from;
          for (int axis = 0; axis < 3; ++axis) {
            EXPECT_FLOAT_EQ(end[axis], static_cast<float>(one.skeleton.nodes(node, axis)));
          }
          if (style.value == SkeletonStyle::balls) {
            EXPECT_FLOAT_EQ(end.w, static_cast<float>(one.skeleton.radii[node]));
          }
        }
      }
    }
  }
}

TEST(ShownSkeleton, FitsSeamlesslyOrHasABall) {
  for (const Extracted& one : family()) {
    Look look;
    look.joints = false;
    const ShownSkeleton shown = shown_skeleton(one.skeleton, {}, 10, look, {});
    const auto has_ball = [&](Eigen::Index node) {
      return std::any_of(shown.nodes.begin(), shown.nodes.end(), [&](const TubeInstance& ball) {
        return glm::vec3(ball.from) == shown_point(one.skeleton.nodes.row(node), DrawnSpace{});
      });
    };
    std::map<Eigen::Index, std::vector<glm::vec3>> mitres;
    for (std::size_t e = 0; e < shown.edges.size(); ++e) {
      const auto row = static_cast<Eigen::Index>(e);
      const TubeInstance& edge = shown.edges[e];
      const glm::vec3 along = glm::vec3(edge.to) - glm::vec3(edge.from);
      mitres[one.skeleton.edges(row, 0)].push_back(edge.from_mitre);
      mitres[one.skeleton.edges(row, 1)].push_back(edge.to_mitre);
      for (const glm::vec3& mitre : {edge.from_mitre, edge.to_mitre}) {
        EXPECT_GE(glm::dot(mitre, along), 0);
      }
    }
    for (const auto& [node, planes] : mitres) {
      if (has_ball(node)) continue;
      ASSERT_EQ(planes.size(), 2U);
      EXPECT_NEAR(std::abs(glm::dot(planes[0], planes[1])), 1, 1e-5);
    }
  }
}

TEST(Scene, FarFromTheOriginKeepsItsDigits) {
  const Extracted& one = family()[2];
  const Scene near(document_of(one.surface, &one.skeleton));
  for (const double offset : {1e4, 1e6, 1e8}) {
    const Eigen::RowVector3d moved_by(offset, -offset / 3, 2 * offset);
    Surface surface = one.surface;
    CurveSkeleton skeleton = one.skeleton;
    surface.positions.rowwise() += moved_by;
    skeleton.nodes.rowwise() += moved_by;
    const Scene far(document_of(surface, &skeleton));
    // The step of double precision there, and of single precision for a shape this large.
    const float step =
        shown_length(8 * offset * std::numeric_limits<double>::epsilon(), near.document.space) +
        1e-6F * near.bounds().diagonal();
    ASSERT_EQ(far.points().size(), near.points().size());
    for (std::size_t i = 0; i < near.points().size(); ++i) {
      EXPECT_LT(glm::distance(far.points()[i], near.points()[i]), step);
    }
    const auto shown = [&](const Scene& scene) {
      return shown_skeleton(*scene.skeleton(), scene.document.space, 10, {}, {}).nodes;
    };
    const auto nodes_near = shown(near);
    const auto nodes_far = shown(far);
    for (std::size_t n = 0; n < nodes_near.size(); ++n) {
      EXPECT_LT(glm::distance(nodes_far[n].from, nodes_near[n].from), step);
    }
  }
}

TEST(Scene, LooksTheSameInAnyUnit) {
  const HeadlessContext context;
  constexpr int width = 160;
  constexpr int height = 120;
  const auto drawn = [&](double scale, SkeletonStyle style) {
    Surface surface = family()[2].surface;
    CurveSkeleton skeleton = family()[2].skeleton;
    surface.positions *= scale;
    skeleton.nodes *= scale;
    skeleton.radii *= scale;
    Scene scene(document_of(surface, &skeleton));
    scene.look.skeleton = style;
    look_from(scene.camera, Side::front, glm::mat3(1));
    fit(scene.camera, scene.points(), float(width) / height);
    Renderer renderer;
    scene.upload(renderer);
    renderer.draw(scene.camera, scene.look, {width, height, {}, scene.bounds(), {}});
    return renderer.read().bytes;
  };
  for (const SkeletonStyle style : {SkeletonStyle::tubes, SkeletonStyle::balls}) {
    const auto usual = drawn(1, style);
    for (const int exponent : {-100, -40, 40, 100}) {
      EXPECT_EQ(drawn(std::exp2(exponent), style), usual) << "2^" << exponent;
    }
  }
}

TEST(Scene, FitsWhatItHas) {
  for (const Extracted& one : family()) {
    const Scene with_surface(document_of(one.surface));
    Document alone;
    alone.skeleton = one.skeleton;
    const Scene skeleton_alone(alone);
    for (const Scene* scene : {&with_surface, &skeleton_alone}) {
      EXPECT_FALSE(scene->points().empty());
      EXPECT_GT(scene->bounds().diagonal(), 0);
      const glm::mat3& axes = scene->best_axes();
      EXPECT_NEAR(glm::determinant(axes), 1, 1e-5F);
    }
  }
}

TEST(Scene, HasRoomForASkeletonBesideItsSurface) {
  for (const Extracted& one : family()) {
    CurveSkeleton skeleton = one.skeleton;
    skeleton.nodes.rowwise() += Eigen::RowVector3d(40, 0, 0);
    const Scene scene(document_of(one.surface, &skeleton));
    for (const auto& node : skeleton.nodes.rowwise()) {
      const glm::vec3 at = shown_point(node, scene.document.space);
      EXPECT_TRUE(glm::all(glm::lessThanEqual(scene.bounds().low, at)));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(at, scene.bounds().high)));
    }
  }
}

TEST(Scene, PartsOfAPictureAreThoseOfTheWhole) {
  const HeadlessContext context;
  constexpr int width = 160;
  constexpr int height = 120;
  for (const SurfaceStyle style : {SurfaceStyle::transparent, SurfaceStyle::opaque}) {
    Scene scene(document_of(family()[2].surface, &family()[2].skeleton));
    fit(scene.camera, scene.points(), float(width) / height);
    scene.look.surface = style;
    Renderer renderer;
    scene.upload(renderer);
    Renderer::Frame frame{width, height, {}, scene.bounds(), {}};
    renderer.draw(scene.camera, scene.look, frame);
    const PixelRows whole = renderer.read();
    for (const Renderer::Part& part :
         {Renderer::Part{0, 0, 64, height}, Renderer::Part{64, 0, 96, height},
          Renderer::Part{30, 50, 60, 40}}) {
      frame.part = part;
      renderer.draw(scene.camera, scene.look, frame);
      const PixelRows rows = renderer.read();
      ASSERT_EQ(rows.width, part.width);
      ASSERT_EQ(rows.height, part.height);
      const auto byte = [](const PixelRows& of, int x, int y, int channel) {
        const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(of.width);
        return of
            .bytes[4 * (row + static_cast<std::size_t>(x)) + static_cast<std::size_t>(channel)];
      };
      int different = 0;
      for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x) {
          for (int channel = 0; channel < 4; ++channel) {
            different +=
                byte(rows, x, y, channel) == byte(whole, part.x + x, part.y + y, channel) ? 0 : 1;
          }
        }
      }
      // Rounding may put an edge on the other side of a sample.
      EXPECT_LT(different, 4 * part.width * part.height / 500);
    }
  }
}

TEST(Scene, DrawnCoarselyLooksMuchTheSame) {
  const HeadlessContext context;
  constexpr int width = 200;
  constexpr int height = 150;
  Scene scene(document_of(shapes::torus(3, 1, 100).surface));
  ASSERT_LT(scene.sizes()[3], scene.sizes()[0] / 2);
  fit(scene.camera, scene.points(), float(width) / height);
  scene.look.transparent_background = true;
  Renderer renderer;
  scene.upload(renderer);
  for (const SurfaceStyle style : {SurfaceStyle::transparent, SurfaceStyle::opaque}) {
    scene.look.surface = style;
    const auto drawn = [&](const Fineness& fineness) {
      renderer.draw(scene.camera, scene.look, {width, height, fineness, scene.bounds()});
      return renderer.read().bytes;
    };
    const auto coarse = drawn({3, 1, 1});  // first: a finer picture would be kept
    const auto whole = drawn({0, 1, 1});
    EXPECT_NE(whole, coarse);
    double sum = 0;
    int uncovered = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      sum += std::abs(static_cast<int>(whole[i]) - static_cast<int>(coarse[i]));
      if (i % 4 == 3) uncovered += (whole[i] > 0) == (coarse[i] > 0) ? 0 : 1;
    }
    EXPECT_LT(sum / static_cast<double>(whole.size()), 4) << "of 255";
    EXPECT_LT(uncovered, width * height / 100);
  }
}

TEST(Scene, ContractedShowsThroughAnOpaqueSurface) {
  Scene scene(document_of(family()[0].surface));
  scene.look.surface = SurfaceStyle::opaque;
  EXPECT_EQ(scene.look_now().surface, SurfaceStyle::opaque);
  Moment contracted;
  contracted.stage = "contract";
  scene.recording.add(contracted);
  scene.moment = 1;
  EXPECT_EQ(scene.look_now().surface, SurfaceStyle::transparent);
  for (const SurfaceStyle style : {SurfaceStyle::wireframe, SurfaceStyle::hidden}) {
    scene.look.surface = style;
    EXPECT_EQ(scene.look_now().surface, style);
  }
}

/// Surfaces that shrink towards the middle, as a contraction does.
Recording random_recording(const Surface& surface, const CurveSkeleton& skeleton,
                           const DrawnSpace& space, std::mt19937& random) {
  Recording recording;
  const double shrinking = std::uniform_real_distribution<double>(0.3, 0.9)(random);
  double scale = 1;
  for (const char* stage : {"fair", "contract"}) {
    for (int iteration = 0; iteration < 2; ++iteration) {
      scale *= shrinking;
      Surface now = surface;
      now.positions =
          ((surface.positions.rowwise() - space.origin) * scale).rowwise() + space.origin;
      recording.add(moment_of({stage, 0, iteration, 1, 1, 0, now}, space, 0));
    }
  }
  Moment last;
  last.stage = "skeleton";
  last.skeleton = std::make_shared<const CurveSkeleton>(skeleton);
  recording.add(last);
  return recording;
}

void change(Scene& scene, const Extracted& one, std::mt19937& random) {
  const auto pick = [&random](const auto& table) { return table[random() % table.size()].value; };
  switch (random() % 9) {
    case 0:
      scene.look.surface = pick(surface_styles);
      break;
    case 1:
      scene.look.skeleton = pick(skeleton_styles);
      break;
    case 2:
      scene.look.surface_colour = pick(colourings);
      break;
    case 3:
      scene.look.skeleton_colour = pick(colourings);
      break;
    case 4:
      scene.look.theme = pick(themes);
      break;
    case 5:
      scene.look.map = pick(colour_maps);
      break;
    case 6:
      scene.highlights.nodes.assign(random() % 2, static_cast<int>(random() % 5));
      break;
    case 7:  // another run with other options
      scene.recording = random_recording(one.surface, one.skeleton, scene.document.space, random);
      break;
    default:
      scene.moment = random() % scene.recording.moments().size();
  }
}

TEST(Scene, DrawnChangeByChangeIsDrawnAtOnce) {
  const HeadlessContext context;
  Renderer kept;
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    const Extracted& one = family()[seed % family().size()];
    Scene scene(document_of(one.surface));
    scene.recording = random_recording(one.surface, one.skeleton, scene.document.space, random);
    fit(scene.camera, scene.points(), 1.5F);
    for (int i = 0; i < 40; ++i) {
      change(scene, one, random);
      const std::string picture = screenshot(scene, kept, 60, 40);
      Scene fresh(document_of(one.surface));
      fresh.recording = scene.recording;
      fresh.moment = scene.moment;
      fresh.look = scene.look;
      fresh.highlights = scene.highlights;
      fresh.camera = scene.camera;
      Renderer other;
      // Whole PNG files: too long to print where they differ.
      ASSERT_TRUE(picture == screenshot(fresh, other, 60, 40))
          << one.name << ", seed " << seed << ", change " << i;
    }
  }
}

}  // namespace
}  // namespace curveskel::viewer::scene_laws
