// Laws of the pictures: what is drawn is where it must be, and the same for everybody.
#include "skeleton/picture/picture.hpp"

#include <gtest/gtest.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/skeleton_files.hpp>
#include <curveskel/view.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/picture/rasterise.hpp"

namespace curveskel::picture_laws {
namespace {

constexpr int width = 400;
constexpr int height = 300;

std::vector<shapes::Shape> families() {
  const double quarter = std::acos(0.0);
  return {shapes::torus(2, 0.5, 16),
          shapes::rotated(shapes::torus(2, 0.5, 16), {1, 2, 3}, 1),
          shapes::ellipsoid({1, 2, 3}, 4),
          shapes::box({3, 1, 2}, 12),
          shapes::cone(1, 2, 40),
          shapes::tube("arc", shapes::arc(3, 2 * quarter), shapes::constant(0.4), 16),
          shapes::translated(
              shapes::tube("helix", shapes::helix(2, 1.5, 2), shapes::tapered(0.3, 0.1), 14),
              {1e3, -2e3, 5e2}),
          shapes::scaled(shapes::linked_rings(2, 0.4, 12), 1e-6)};
}

/// Decoded by another library than wrote it.
struct Decoded {
  explicit Decoded(const std::string& png) {
    int channels = 0;
    rgb.reset(stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()),
                                    static_cast<int>(png.size()), &columns, &rows, &channels, 3));
    if (!rgb) columns = rows = 0;
  }
  [[nodiscard]] Eigen::Vector3i at(int x, int y) const {
    const stbi_uc* pixel = rgb.get() + std::ptrdiff_t{3} * (y * columns + x);
    return {pixel[0], pixel[1], pixel[2]};
  }
  [[nodiscard]] Eigen::Vector3i at(const Eigen::Vector3d& pixel) const {
    return at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  }
  int columns = 0;
  int rows = 0;

 private:
  struct Free {
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
  };
  std::unique_ptr<stbi_uc, Free> rgb;
};

const Eigen::Vector3i white(255, 255, 255);

Decoded drawn(const CurveSkeleton& skeleton, const Surface& surface) {
  return Decoded(png_picture(skeleton, surface, {width, height, 0}));
}

struct Fragments {
  PictureWindow window;
  std::vector<Fragment> pixels;  // row by row
};

Fragments fragments_of(const Surface& surface, const View& view) {
  Fragments all;
  const auto begin = [&](const PictureWindow& window) {
    all.window = window;
    all.pixels.resize(static_cast<std::size_t>(window.width) *
                      static_cast<std::size_t>(window.height));
  };
  const auto draw = [&](const FragmentRow& row) {
    std::copy(row.pixels.begin(), row.pixels.end(),
              all.pixels.begin() + std::ptrdiff_t{row.y} * all.window.width + row.left);
  };
  rasterise(surface, vertex_normals(surface), view, {width, height}, 0, {begin, draw});
  return all;
}

TEST(Rasterise, ThicknessAddsUpToTheVolume) {
  for (const shapes::Shape& shape : families()) {
    for (const View& view : best_views(shape.surface, width, height)) {
      const Fragments fragments = fragments_of(shape.surface, view);
      double sum = 0;
      for (const Fragment& fragment : fragments.pixels) {
        EXPECT_LE(fragment.coverage, 1);
        sum += static_cast<double>(fragment.coverage * fragment.thickness);
      }
      const double expected = volume(shape.surface) * std::pow(view.pixels_per_unit, 3);
      EXPECT_NEAR(sum / expected, 1, 0.01) << shape.name;
    }
  }
}

TEST(Rasterise, LeavesNoGapBetweenTriangles) {
  const shapes::Shape box = shapes::box({3, 2, 1}, 30);
  const View view = best_views(box.surface, width, height)[0];
  const Fragments fragments = fragments_of(box.surface, view);
  const auto depth = static_cast<float>(view.pixels_per_unit);
  for (int y = 2; y < fragments.window.height - 2; ++y) {
    for (int x = 2; x < fragments.window.width - 2; ++x) {
      const auto& fragment = fragments.pixels[static_cast<std::size_t>(y) *
                                                  static_cast<std::size_t>(fragments.window.width) +
                                              static_cast<std::size_t>(x)];
      ASSERT_EQ(fragment.coverage, 1) << x << " " << y;
      ASSERT_NEAR(fragment.thickness, depth, 1e-3F * depth) << x << " " << y;
    }
  }
}

TEST(Views, AreRightHandedRotationsAtOneScaleThatShowEverything) {
  for (const shapes::Shape& shape : families()) {
    const auto views = best_views(shape.surface, width, height);
    EXPECT_EQ(views[0].pixels_per_unit, views[1].pixels_per_unit);
    EXPECT_NEAR(std::abs(views[0].axes.row(2).dot(views[1].axes.row(2))), 0, 1e-12);
    for (const View& view : views) {
      EXPECT_TRUE((view.axes * view.axes.transpose()).isIdentity(1e-12)) << shape.name;
      EXPECT_GT(view.axes.determinant(), 0) << shape.name;
      for (const auto& position : shape.surface.positions.rowwise()) {
        const Eigen::Vector3d pixel = view.project(position);
        EXPECT_TRUE(pixel.x() > 0 && pixel.x() < width && pixel.y() > 0 && pixel.y() < height)
            << shape.name;
      }
    }
  }
}

/// Whatever the shape would stand on more broadly.
TEST(Views, KeepUpWhatTheFileSaysIsUp) {
  for (const shapes::Shape& shape : families()) {
    for (const int axis : {1, 2}) {
      const Eigen::Vector3d up = Eigen::Vector3d::Unit(axis);
      for (const View& view : best_views(shape.surface, width, height, up)) {
        const bool is_upright = (view.axes.row(1).transpose() - up).norm() < 1e-12;
        const bool is_seen_from_above = (view.axes.row(2).transpose() - up).norm() < 1e-12;
        EXPECT_TRUE(is_upright || is_seen_from_above) << shape.name << axis << '\n' << view.axes;
      }
    }
  }
}

TEST(Views, HaveUpWhatOtherProgramsShowUp) {
  const Eigen::Matrix3d z_up = (Eigen::Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
  EXPECT_EQ(customary_up(SurfaceFormat::fbx, 0.01 * z_up), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(customary_up(SurfaceFormat::glb, Eigen::Matrix3d::Identity()),
            Eigen::Vector3d::UnitY());
  EXPECT_EQ(customary_up(SurfaceFormat::obj, Eigen::Matrix3d::Identity()),
            Eigen::Vector3d::UnitY());
  EXPECT_EQ(customary_up(SurfaceFormat::stl, Eigen::Matrix3d::Identity()), Eigen::Vector3d::Zero());
}

TEST(Views, LookAlongTheLeastExtent) {
  for (const Eigen::Vector3d& size :
       {Eigen::Vector3d(3, 2, 1), Eigen::Vector3d(1, 3, 2), Eigen::Vector3d(2, 1, 3)}) {
    Eigen::Index least = 0;
    size.minCoeff(&least);
    const auto views = best_views(shapes::box(size, 6).surface, width, height);
    EXPECT_NEAR(std::abs(views[0].axes(2, least)), 1, 1e-12);
    const shapes::Shape turned = shapes::rotated(shapes::box(size, 6), {1, 1, 0.5}, 0.6);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 1, 0.5).normalized()).toRotationMatrix();
    const auto again = best_views(turned.surface, width, height);
    EXPECT_NEAR(std::abs(again[0].axes.row(2).dot(turn.col(least))), 1, 1e-6);
  }
}

TEST(Views, OfASkeletonLookAlongItsLeastExtent) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 1, 0.5).normalized();
  for (const double angle : {0.0, 0.6, 2.0}) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    CurveSkeleton cross;
    cross.nodes.resize(5, 3);
    cross.nodes << 0, 0, 0, 3, 0, 0.1, 0, 1.2, 0, -3, 0, 0.1, 0, -1, 0;
    cross.nodes *= turn.transpose();
    cross.edges.resize(4, 2);
    cross.edges << 0, 1, 0, 2, 0, 3, 0, 4;
    const auto views = best_views(cross, width, height);
    EXPECT_NEAR(std::abs(views[0].axes.row(2).dot(turn.col(2))), 1, 1e-3) << angle;
    EXPECT_GT(views[0].axes.determinant(), 0.99);
    for (const View& view : views) {
      for (const auto& node : cross.nodes.rowwise()) {
        const Eigen::Vector3d pixel = view.project(node);
        EXPECT_TRUE(pixel.x() > 0 && pixel.x() < width && pixel.y() > 0 && pixel.y() < height);
      }
    }
  }
}

TEST(Views, OfALineAndOfAPointAreRotations) {
  for (const double length : {0.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      CurveSkeleton line;
      line.nodes.setConstant(2, 3, 1);
      line.nodes(1, axis) += length;
      line.edges.resize(1, 2);
      line.edges << 0, 1;
      for (const View& view : best_views(line, width, height)) {
        EXPECT_TRUE((view.axes * view.axes.transpose()).isIdentity(1e-12));
        EXPECT_NEAR(view.axes.determinant(), 1, 1e-12);
      }
    }
  }
}

TEST(Views, KeepUpWhatStandsOnFeet) {
  // A table: a broad board on four legs, its height between its other extents.
  for (const int up : {1, 2}) {
    const auto part = [&](double w, double h, double d, double x, double y, double z) {
      const Eigen::Vector3d size = up == 1 ? Eigen::Vector3d(w, h, d) : Eigen::Vector3d(d, w, h);
      const Eigen::Vector3d at = up == 1 ? Eigen::Vector3d(x, y, z) : Eigen::Vector3d(z, x, y);
      return shapes::translated(shapes::box(size, 8), at);
    };
    const shapes::Shape table = shapes::together(
        "table", {part(4, 0.2, 1.5, 0, 2, 0), part(0.2, 1.8, 0.2, 1.8, 0.95, 0.6),
                  part(0.2, 1.8, 0.2, -1.8, 0.95, 0.6), part(0.2, 1.8, 0.2, 1.8, 0.95, -0.6),
                  part(0.2, 1.8, 0.2, -1.8, 0.95, -0.6)});
    const auto views = best_views(table.surface, width, height);
    EXPECT_NEAR(views[0].axes(1, up), 1, 1e-12) << "up is axis " << up;
    // The other view is from the side, or from above.
    EXPECT_NEAR(std::max(views[1].axes(1, up), views[1].axes(2, up)), 1, 1e-12);
  }
}

TEST(Picture, ShowsEveryNodeWhereItIs) {
  const CurveSkeleton graph = shapes::star(5, 4, 0.5);
  const shapes::Shape shape = shapes::tube_union("star", graph);
  const Decoded without = drawn({}, shape.surface);
  const Decoded with = drawn(graph, shape.surface);
  ASSERT_EQ(with.columns, width);
  ASSERT_EQ(with.rows, height);
  EXPECT_EQ(with.at(1, 1), white);
  for (const View& view : best_views(shape.surface, width, height)) {
    for (const auto& edge : graph.edges.rowwise()) {
      for (const double t : {0.0, 0.4, 0.7, 1.0}) {
        const Eigen::Vector3d pixel =
            view.project((1 - t) * graph.nodes.row(edge(0)) + t * graph.nodes.row(edge(1)));
        EXPECT_NE(without.at(pixel), white);
        EXPECT_GT((with.at(pixel) - without.at(pixel)).cwiseAbs().maxCoeff(), 30);
      }
    }
  }
}

TEST(Picture, IsTheSameForAnyNumberOfThreads) {
  const shapes::Shape shape = shapes::torus(2, 0.5, 16);
  const std::string one = png_picture(shape.axis, shape.surface, {width, height, 1});
  EXPECT_EQ(one, png_picture(shape.axis, shape.surface, {width, height, 2}));
  EXPECT_EQ(one, png_picture(shape.axis, shape.surface, {width, height, 7}));
}

TEST(Picture, IsTheSameAtAnyScale) {
  const shapes::Shape shape = shapes::torus(2, 0.5, 16);
  const std::string usual = png_picture(shape.axis, shape.surface, {width, height, 0});
  for (const double factor : {0x1p-20, 0x1p20}) {
    const shapes::Shape other = shapes::scaled(shape, factor);
    EXPECT_EQ(usual, png_picture(other.axis, other.surface, {width, height, 0}));
  }
}

TEST(Picture, SurvivesSurfacesWithoutExtent) {
  Surface flat;
  flat.positions = Positions::Zero(3, 3);
  flat.triangles.resize(1, 3);
  flat.triangles << 0, 1, 2;
  const Decoded point = drawn({}, flat);
  EXPECT_EQ(point.columns, width);
  flat.positions.row(1) << 1, 0, 0;
  flat.positions.row(2) << 2, 0, 0;
  EXPECT_EQ(drawn({}, flat).columns, width);
}

TEST(Picture, OfSvgHasTwoLinesPerEdgeAndView) {
  const shapes::Shape shape = shapes::torus(2, 0.5, 16);
  const std::string svg = svg_picture(shape.axis, shape.surface, {width, height, 0});
  std::ptrdiff_t lines = 0;
  for (std::size_t at = svg.find("<line"); at != std::string::npos;
       at = svg.find("<line", at + 1)) {
    ++lines;
  }
  EXPECT_EQ(lines, 4 * shape.axis.edges.rows());
}

TEST(Picture, NeedsTheSurface) {
  for (const SkeletonFormat format : {SkeletonFormat::png, SkeletonFormat::svg}) {
    EXPECT_THROW((void)format_skeleton({}, format, {}), Error);
  }
}

}  // namespace
}  // namespace curveskel::picture_laws
