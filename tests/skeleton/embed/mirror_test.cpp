// Laws of mirror images: the curve of a body that is its own mirror image is its own, too.
#include "skeleton/embed/place/mirror.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/extract.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/embed/branches/mirror_branches.hpp"
#include "skeleton/embed/skeleton_graph.hpp"

namespace curveskel::mirror_laws {
namespace {

using Axes = std::vector<int>;

Axes axes_of(const Surface& surface, bool exactly = true) {
  Axes axes;
  for (const MirrorPlane& plane : mirror_planes(surface, SurfaceTree(surface),
                                                bounding_box_diagonal(surface.positions) / 400)) {
    if (plane.exact || !exactly) axes.push_back(plane.axis);
  }
  return axes;
}

TEST(MirrorAxes, AreThoseOfABox) {
  Surface box = shapes::box({1, 0.6, 0.4}, 8).surface;
  EXPECT_EQ(axes_of(box), (Axes{0, 1, 2}));
  for (const int axis : {0, 1, 2}) {
    Surface bulged = box;
    for (auto row : bulged.positions.rowwise()) {
      if (row[axis] > 0) row[axis] += 0.1 * row[axis];
    }
    Axes others{0, 1, 2};
    others.erase(others.begin() + axis);
    EXPECT_EQ(axes_of(bulged), others) << axis;
  }
}

/// A dent in one corner is no reason for one ear less.
TEST(MirrorAxes, AreNotExactWhereALittleIsElsewhere) {
  Surface box = shapes::box({1, 0.6, 0.4}, 8).surface;
  const Eigen::RowVector3d corner = box.positions.colwise().maxCoeff();
  for (auto row : box.positions.rowwise()) {
    if ((row - corner).norm() < 0.1) row *= 0.9;
  }
  EXPECT_EQ(axes_of(box), Axes{});
  EXPECT_EQ(axes_of(box, false), (Axes{0, 1, 2}));
}

TEST(MirrorAxes, AreNoneOfAHelix) {
  const Surface helix =
      shapes::tube("helix", shapes::helix(0.3, 0.4, 1.3), shapes::constant(0.1), 16).surface;
  EXPECT_EQ(axes_of(helix), Axes{});
}

CurvePoint beside(double x, double y) { return Point(x, y, 0); }

TEST(MirrorArcs, PutsACurveThatIsItsOwnImageOntoThePlane) {
  const SurfaceTree tree(
      shapes::tube("tube", shapes::straight(1), shapes::constant(0.1), 24).surface);
  SkeletonGraph graph;
  graph.nodes = {{beside(-0.4, 0.03), {0}, true, {0}}, {beside(0.4, -0.02), {0}, true, {0}}};
  graph.arcs.push_back({0, 1, {beside(-0.2, -0.04), beside(0.1, 0.05)}, {0}});
  EXPECT_EQ(mirror_arcs(graph, 1, tree, 0.8), 1);
  for (const Point& point : graph.polyline(graph.arcs.front())) EXPECT_EQ(point.y(), 0);
}

/// A fork's arms meet half-way, each the exact image of the other; its stem is in the plane.
TEST(MirrorArcs, MakesArmsEachOthersImages) {
  const Surface fork = shapes::tube_union("fork", shapes::star(3, 0.5, 0.08)).surface;
  const CurveSkeleton star = shapes::star(3, 0.5, 0.08);
  const SurfaceTree tree(fork);
  const Point stem = star.nodes.row(1);
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(stem, Point::UnitX());
  const SurfaceTree turned = tree.in_frame(turn.toRotationMatrix(), Point::Zero(), 1);
  SkeletonGraph graph;
  graph.nodes.push_back({beside(0.01, 0.02), {0}, true, {0, 1, 2}});
  for (int arm = 0; arm < 3; ++arm) {
    const Point tip = turn * Point(star.nodes.row(arm + 1).transpose());
    const Point off(0.01 * arm, 0.02, 0);
    graph.nodes.push_back({CurvePoint(Point(0.9 * tip + off)), {0}, true, {arm}});
    graph.arcs.push_back({0, arm + 1, {CurvePoint(Point(0.5 * tip - off))}, {0}});
  }
  EXPECT_EQ(mirror_arcs(graph, 1, turned, 0.8), 2);
  EXPECT_EQ(graph.place(0).y(), 0);
  EXPECT_EQ(graph.place(1).y(), 0);
  const std::vector<Point> left = graph.polyline(graph.arcs[1]);
  const std::vector<Point> right = graph.polyline(graph.arcs[2]);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(left[i].y(), -right[i].y());
    EXPECT_EQ(left[i].x(), right[i].x());
  }
}

/// Nearer to a wall than they may be, the points stay.
TEST(MirrorArcs, LeavesWhatWouldLoseItsRadius) {
  const Surface tube =
      shapes::tube("bent", shapes::arc(0.4, 3.0), shapes::constant(0.05), 24).surface;
  const SurfaceTree tree(tube);
  SkeletonGraph graph;
  const auto on_arc = [](double angle) {
    return CurvePoint(Point(0.4 * std::cos(angle), 0.4 * std::sin(angle), 0));
  };
  graph.nodes = {{on_arc(-0.1), {0}, true, {0}}, {on_arc(0.1), {0}, true, {0}}};
  graph.arcs.push_back({0, 1, {on_arc(0)}, {0}});
  const SkeletonGraph before = graph;
  mirror_arcs(graph, 0, tree, 0.8);  // the tube does not go on beyond the plane x = 0
  EXPECT_EQ(graph.place(0), before.place(0));
}

double off_axis(const CurveSkeleton& curve, const Eigen::Vector3d& along) {
  const Positions off = curve.nodes - (curve.nodes * along) * along.transpose();
  return off.rowwise().norm().maxCoeff();
}

/// In any place, turn and numbering: no diagonal from corner to corner.
TEST(Mirrored, ABoxHasTheAxisThatAPersonWouldDraw) {
  for (const Eigen::Vector3d& size : {Eigen::Vector3d(1, 0.5, 0.5), Eigen::Vector3d(1, 0.6, 0.4),
                                      Eigen::Vector3d(1, 0.3, 0.25)}) {
    for (const int cells : {1, 10}) {
      SCOPED_TRACE(testing::Message() << size.transpose() << ", cells " << cells);
      const Eigen::Vector3d about(1, 2, 3);
      const shapes::Shape box =
          shapes::renumbered(shapes::rotated(shapes::box(size, cells), about, 0.7), 5);
      const Eigen::Vector3d along =
          Eigen::AngleAxisd(0.7, about.normalized()) * Eigen::Vector3d::UnitX();
      const CurveSkeleton curve = extract(box.surface, {}, {}).skeleton;
      const double diagonal = bounding_box_diagonal(box.surface.positions);
      EXPECT_LT(off_axis(curve, along), 1e-4 * diagonal);
      EXPECT_EQ(graph_topology(curve).tips, 2);
    }
  }
}

/// The tree of a fork in the plane z = 0, one arm along x, two beside the plane y = 0.
struct Fork {
  Surface surface;
  CurveSkeleton curve;
};
Fork fork_across_y() {
  const CurveSkeleton star = shapes::star(3, 0.5, 0.08);
  const Point stem = star.nodes.row(1);
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(stem, Point::UnitX()).toRotationMatrix();
  Fork fork{shapes::tube_union("fork", star).surface, star};
  fork.surface.positions *= turn.transpose();
  fork.curve.nodes *= turn.transpose();
  return fork;
}

/// Each group of one vertex, so that every vertex may go anywhere.
PartitionGraph in_one_group(const Surface& surface) {
  PartitionGraph partition;
  partition.groups = 1;
  partition.group_of_vertex.setZero(surface.positions.rows());
  return partition;
}

int completed(SkeletonGraph& graph, const Surface& surface, int axis) {
  const SurfaceTree tree(surface);
  const InscribedBalls balls = inscribed_balls(surface, tree, 1);
  const WorkingSurface working(surface, balls);
  return mirror_branches(graph, axis, working, tree, in_one_group(surface));
}

/// One arm of two is there: the other comes, whatever place its base has on the stem.
TEST(MirrorBranches, AddTheArmThatIsMissing) {
  const Fork fork = fork_across_y();
  for (const double base : {0.0, 0.03}) {
    SkeletonGraph graph;
    const Point left = fork.curve.nodes.row(2);
    graph.nodes = {{Point(base, 0.01, 0), {0}, true, {0, 1}},
                   {Point(0.45, 0, 0), {0}, true, {0}},
                   {CurvePoint(Point(0.9 * left)), {0}, true, {1}}};
    graph.arcs = {{0, 1, {Point(0.2, 0, 0)}, {0}}, {0, 2, {CurvePoint(Point(0.5 * left))}, {0}}};
    EXPECT_EQ(completed(graph, fork.surface, 1), 1) << base;
    EXPECT_EQ(graph.living_arcs(), 3);
    const Point tip = graph.place(3);
    EXPECT_NEAR(tip.y(), -0.9 * left.y(), 1e-12);
    EXPECT_EQ(completed(graph, fork.surface, 1), 0) << "it is there now";
  }
}

TEST(MirrorBranches, AddNothingOutside) {
  const Surface tube =
      shapes::tube("bent", shapes::arc(0.4, 3.0), shapes::constant(0.05), 24).surface;
  SkeletonGraph graph;
  const auto on_arc = [](double angle) {
    return CurvePoint(Point(0.4 * std::cos(angle), 0.4 * std::sin(angle), 0));
  };
  graph.nodes = {{on_arc(-0.5), {0}, true, {0}}, {on_arc(0.5), {0}, true, {0}}};
  graph.arcs.push_back({0, 1, {on_arc(-0.2), on_arc(0.2)}, {0}});
  EXPECT_EQ(completed(graph, tube, 0), 0);
  EXPECT_EQ(graph.living_arcs(), 1);
}

TEST(Mirrored, CurvesOfFiguresAreTheirOwnImages) {
  for (const auto& [name, graph] :
       {std::pair{"H", shapes::letter_h(1, 0.6, 0.08)}, std::pair{"X", shapes::star(4, 0.5, 0.07)},
        std::pair{"ladder", shapes::ladder(2, 0.5, 0.06)}}) {
    const Surface figure = shapes::tube_union(name, graph).surface;
    const CurveSkeleton curve = extract(figure, {}, {}).skeleton;
    const double diagonal = bounding_box_diagonal(figure.positions);
    for (const int axis : axes_of(figure)) {
      CurveSkeleton image = curve;
      image.nodes.col(axis) *= -1;
      EXPECT_LT(hausdorff_distance(curve, image, diagonal / 400), 1e-3 * diagonal)
          << name << ", axis " << axis;
    }
  }
}

}  // namespace
}  // namespace curveskel::mirror_laws
