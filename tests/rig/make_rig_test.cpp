// Laws of rigs where the skeleton or the surface says less than all: vertices without a node, and
// vertices of the file that the repair left out.
#include <curveskel/make_rig.hpp>

#include <gtest/gtest.h>

#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include "tests/rig/rig_subjects.hpp"

namespace curveskel::make_rig_laws {
namespace {

/// A tube bent into an S and its axis, with the node of each vertex.
RigSubject mapped_s() {
  shapes::Shape shape = shapes::tube("", shapes::s_curve(16, 6), shapes::constant(1), 16);
  CurveSkeleton axis = shape.axis;
  axis.node_of_vertex.resize(shape.surface.positions.rows());
  for (Eigen::Index vertex = 0; vertex < axis.node_of_vertex.size(); ++vertex) {
    Eigen::Index node = -1;
    (axis.nodes.rowwise() - shape.surface.positions.row(vertex))
        .rowwise()
        .squaredNorm()
        .minCoeff(&node);
    axis.node_of_vertex[vertex] = static_cast<int>(node);
  }
  return {"s", std::move(shape.surface), std::move(axis)};
}

/// Row `row` of a and row `other` of b are the same numbers.
bool same_row(const SkinWeights& a, Eigen::Index row, const SkinWeights& b, Eigen::Index other) {
  return (a.row(row) - b.row(other)).norm() == 0;
}

TEST(DenseSkeleton, RefusesNumbersOfNothing) {
  const RigSubject s = mapped_s();
  EXPECT_NO_THROW((void)dense_skeleton(s.surface, s.skeleton));
  CurveSkeleton wrong_edge = s.skeleton;
  wrong_edge.edges(0, 1) = static_cast<int>(wrong_edge.nodes.rows());
  EXPECT_THROW((void)dense_skeleton(s.surface, wrong_edge), Error);
  CurveSkeleton wrong_node = s.skeleton;
  wrong_node.node_of_vertex[3] = static_cast<int>(wrong_node.nodes.rows());
  EXPECT_THROW((void)dense_skeleton(s.surface, wrong_node), Error);
  CurveSkeleton of_another = s.skeleton;
  of_another.node_of_vertex.setZero(2 * s.surface.positions.rows());
  EXPECT_THROW((void)dense_skeleton(s.surface, of_another), Error);
  EXPECT_THROW((void)find_plan(s.surface, of_another), Error);
}

TEST(MakeRig, TakesTheNearestBallWhereAVertexHasNoNode) {
  const RigSubject s = mapped_s();
  const Rig rig = make_rig(s.surface, s.skeleton, {}, {});
  CurveSkeleton without = s.skeleton;
  without.node_of_vertex.resize(0);
  EXPECT_EQ(largest_difference(make_rig(s.surface, without, {}, {}).weights, rig.weights), 0);
  CurveSkeleton partly = s.skeleton;
  for (Eigen::Index vertex = 0; vertex < partly.node_of_vertex.size(); vertex += 3) {
    partly.node_of_vertex[vertex] = -1;
  }
  EXPECT_EQ(largest_difference(make_rig(s.surface, partly, {}, {}).weights, rig.weights), 0);
  // and not where it has one; a lid keeps the bones, beside the tube, out of sight
  const shapes::Shape lid = shapes::translated(shapes::box({30, 30, 0.2}, 4), {0, 0, 2});
  shapes::Shape tube;
  tube.surface = s.surface;
  const Surface lidded = shapes::together("", {tube, lid}).surface;
  CurveSkeleton aside = s.skeleton;
  aside.nodes.col(2).array() += 4;
  aside.node_of_vertex.conservativeResize(lidded.positions.rows());
  aside.node_of_vertex.tail(lid.surface.positions.rows()).setZero();
  CurveSkeleton wrong = aside;
  wrong.node_of_vertex.setZero();
  EXPECT_GT(largest_difference(make_rig(lidded, wrong, {}, {}).weights,
                               make_rig(lidded, aside, {}, {}).weights),
            0.5F);
}

/// The thick bar's surface is nearer to the thin bar's curve than to its own.
TEST(MakeRig, MeasuresFromTheBallNotFromItsCentre) {
  const auto bar = [](double radius) {
    return shapes::tube("", shapes::straight(12), shapes::constant(radius), 20);
  };
  const shapes::Shape thick = bar(3);
  const shapes::Shape thin = shapes::translated(bar(0.2), {0, 3.5, 0});
  const Surface surface = shapes::together("", {thick, thin}).surface;
  const CurveSkeleton curve = together(thick.axis, thin.axis);
  const Rig rig = make_rig(surface, curve, {}, {});
  const Eigen::Index vertices = thick.surface.positions.rows();
  for (Eigen::Index vertex = 0; vertex < vertices; ++vertex) {
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      EXPECT_LT(rig.joints(it.col(), 1), 1) << vertex;
    }
  }
}

TEST(MakeRig, WorksForCurvesWithoutRadii) {
  RigSubject s = mapped_s();
  s.skeleton.radii.resize(0);
  s.skeleton.node_of_vertex.resize(0);
  const Rig rig = make_rig(s.surface, s.skeleton, {}, {});
  EXPECT_TRUE(rig.joints.allFinite());
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    EXPECT_NEAR(rig.weights.row(vertex).sum(), 1, 1e-6) << vertex;
  }
}

TEST(MakeRig, RefusesASkeletonWithoutNodes) {
  try {
    (void)make_rig(mapped_s().surface, {}, {}, {});
    FAIL() << "made of nothing";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
  }
}

TEST(MakeRig, StopsWhenAskedTo) {
  const RigSubject s = mapped_s();
  std::stop_source source;
  source.request_stop();
  Monitor monitor;
  monitor.stop = source.get_token();
  EXPECT_THROW((void)make_rig(s.surface, s.skeleton, {}, monitor), Cancelled);
}

/// The file has each vertex twice, in another order, and a button before each hundredth.
TEST(RigOfGiven, MovesEachVertexAsTheOneItBecame) {
  const RigSubject s = mapped_s();
  const Rig rig = make_rig(s.surface, s.skeleton, {}, {});
  const Positions normals = vertex_normals(s.surface);
  const double size = bounding_box_diagonal(s.surface.positions);
  std::vector<int> became;
  std::vector<int> moves_as;
  std::vector<Eigen::RowVector3d> points;
  const auto count = static_cast<int>(s.surface.positions.rows());
  for (int k = 0; k < 2 * count; ++k) {
    const int vertex = (7919 * k + 3) % count;
    const Eigen::RowVector3d place = s.surface.positions.row(vertex);
    if (k % 100 == 0) {
      became.push_back(-1);
      moves_as.push_back(vertex);
      points.emplace_back(place + (k % 200 == 0 ? 1e-3 : -1e-3) * size * normals.row(vertex));
    }
    became.push_back(vertex);
    moves_as.push_back(vertex);
    points.push_back(place);
  }
  Positions given(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k)
    given.row(static_cast<Eigen::Index>(k)) = points[k];
  const Rig found = rig_of_given(
      rig, s.surface, s.skeleton,
      Eigen::Map<const Eigen::VectorXi>(became.data(), static_cast<Eigen::Index>(became.size())),
      {given, {}});
  EXPECT_EQ(found.joints, rig.joints);
  EXPECT_EQ(found.parents, rig.parents);
  EXPECT_EQ(found.names, rig.names);
  ASSERT_EQ(found.weights.rows(), given.rows());
  ASSERT_EQ(found.weights.cols(), rig.weights.cols());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    if (became[k] >= 0) {
      EXPECT_TRUE(same_row(found.weights, row, rig.weights, moves_as[k])) << k;
    } else {  // as the nearest place, which lies beside the vertex
      const Eigen::VectorXf apart =
          Eigen::VectorXf(found.weights.row(row)) - Eigen::VectorXf(rig.weights.row(moves_as[k]));
      EXPECT_LT(apart.lpNorm<1>(), 0.05) << k;
    }
  }
}

TEST(RigOfGiven, FollowersMoveWithAsManyJointsAsAreAsked) {
  const RigSubject s = mapped_s();
  const Rig rig = make_rig(s.surface, s.skeleton, {}, {});
  const Eigen::Index count = s.surface.positions.rows();
  const Eigen::VectorXi none = Eigen::VectorXi::Constant(count, -1);
  for (const int most : {1, 2}) {
    const Rig found =
        rig_of_given(rig, s.surface, s.skeleton, none, s.surface, {.most_joints = most});
    Eigen::Index largest = 0;
    for (Eigen::Index v = 0; v < count; ++v) {
      largest = std::max(largest, Eigen::Index(found.weights.row(v).nonZeros()));
    }
    EXPECT_EQ(largest, most);
  }
  EXPECT_THROW((void)rig_of_given(rig, s.surface, s.skeleton, none, s.surface, {.most_joints = 9}),
               Error);
}

TEST(RigOfGiven, MovesWhatIsFarAwayToo) {
  const RigSubject s = mapped_s();
  const Rig rig = make_rig(s.surface, s.skeleton, {}, {});
  const Eigen::Index last = s.skeleton.nodes.rows() - 1;
  const Eigen::RowVector3d first_tip = s.skeleton.nodes.row(0);
  const Eigen::RowVector3d last_tip = s.skeleton.nodes.row(last);
  Positions given(2, 3);
  given << 20 * first_tip, 20 * last_tip;
  const Rig found = rig_of_given(rig, s.surface, s.skeleton, Eigen::Vector2i(-1, -1), {given, {}});
  for (const Eigen::Index vertex : {0, 1}) {
    for (SkinWeights::InnerIterator it(found.weights, vertex); it; ++it) {
      const double to_first = (rig.joints.row(it.col()) - first_tip).norm();
      const double to_last = (rig.joints.row(it.col()) - last_tip).norm();
      EXPECT_EQ(to_first < to_last, vertex == 0);
    }
    EXPECT_NEAR(found.weights.row(vertex).sum(), 1, 1e-6);
  }
}

/// The file's surface: the subject's, and beside it a box of `size`, whose faces are of no one
/// else.
Surface with_box(const RigSubject& s, const Eigen::RowVector3d& middle, double size) {
  const Surface box = shapes::box({size, size, size}, 2).surface;
  Surface given = s.surface;
  const Eigen::Index first = given.positions.rows();
  const Eigen::Index faces = given.triangles.rows();
  given.positions.conservativeResize(first + box.positions.rows(), 3);
  given.triangles.conservativeResize(faces + box.triangles.rows(), 3);
  given.positions.bottomRows(box.positions.rows()) = box.positions.rowwise() + middle;
  given.triangles.bottomRows(box.triangles.rows()) =
      box.triangles.array() + static_cast<std::int32_t>(first);
  return given;
}

Eigen::VectorXi own_then_none(Eigen::Index own, Eigen::Index all) {
  Eigen::VectorXi vertex_of_input = Eigen::VectorXi::Constant(all, -1);
  vertex_of_input.head(own).setLinSpaced(static_cast<int>(own), 0, static_cast<int>(own) - 1);
  return vertex_of_input;
}

TEST(RigOfGiven, MovesSmallFollowersRigidly) {
  const RigSubject s = mapped_s();
  const Rig rig = make_rig(s.surface, s.skeleton, {}, {});
  const Eigen::Index own = s.surface.positions.rows();
  const double radius = s.skeleton.radii.maxCoeff();
  for (const int vertex : {0, 57, 200, 391}) {
    const Surface given = with_box(s, s.surface.positions.row(vertex % own), 0.7 * radius);
    const Eigen::Index all = given.positions.rows();
    const Rig found = rig_of_given(rig, s.surface, s.skeleton, own_then_none(own, all), given);
    for (Eigen::Index v = own; v < all; ++v) {
      EXPECT_TRUE(same_row(found.weights, v, found.weights, own)) << vertex;
      EXPECT_NEAR(found.weights.row(v).sum(), 1, 1e-6);
    }
    for (Eigen::Index v = 0; v < own; ++v) {
      ASSERT_TRUE(same_row(found.weights, v, rig.weights, v)) << vertex;
    }
  }
}

TEST(RigOfGiven, MovesClothesWithTheLimbsUnderThem) {
  const RigSubject s = mapped_s();
  const Rig rig = make_rig(s.surface, s.skeleton, {}, {});
  const Eigen::Index own = s.surface.positions.rows();
  const Positions normals = vertex_normals(s.surface);
  Surface given = s.surface;  // and the same once more, a little larger
  given.positions.conservativeResize(2 * own, 3);
  given.positions.bottomRows(own) =
      s.surface.positions + 0.05 * s.skeleton.radii.minCoeff() * normals;
  const Eigen::Index faces = s.surface.triangles.rows();
  given.triangles.conservativeResize(2 * faces, 3);
  given.triangles.bottomRows(faces) = s.surface.triangles.array() + static_cast<std::int32_t>(own);
  const Rig found = rig_of_given(rig, s.surface, s.skeleton, own_then_none(own, 2 * own), given);
  double most = 0;
  for (Eigen::Index v = 0; v < own; ++v) {
    const Eigen::VectorXf apart =
        Eigen::VectorXf(found.weights.row(own + v)) - Eigen::VectorXf(rig.weights.row(v));
    most = std::max(most, static_cast<double>(apart.lpNorm<1>()));
  }
  EXPECT_LT(most, 0.1);
}

}  // namespace
}  // namespace curveskel::make_rig_laws
