// Surfaces that are no closed manifold are refused where they enter, by every function that needs
// one.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <curveskel.hpp>
#include <curveskel/advanced/closed_manifold.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::doors_laws {
namespace {

struct Door {
  std::string name;
  bool needs_closed;
  std::function<void(const Surface&)> enter;
};

const Surface& torus() {
  static const Surface surface = shapes::torus(3, 1, 8).surface;
  return surface;
}

/// Two tetrahedra on one edge, or on one vertex.
Surface two_tetrahedra(int shared) {
  Surface surface;
  surface.positions.resize(8 - shared, 3);
  surface.positions.topRows(4) << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  Positions other(4, 3);
  other << 0, 0, 0, 1, 0, 0, 0, -1, 0, 0, 0, -1;
  surface.positions.bottomRows(4 - shared) = other.bottomRows(4 - shared);
  Triangles tetrahedron(4, 3);
  tetrahedron << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  surface.triangles.resize(8, 3);
  surface.triangles << tetrahedron,
      tetrahedron.unaryExpr([shared](int v) { return v < shared ? v : v + 4 - shared; });
  return surface;
}

const CurveSkeleton& a_skeleton() {
  static const CurveSkeleton skeleton = shapes::torus(3, 1, 8).axis;
  return skeleton;
}

const SurfaceTree& a_tree() {
  static const SurfaceTree tree(torus());
  return tree;
}

RepairedSurface as_if_repaired(const Surface& surface) {
  RepairedSurface repaired;
  repaired.surface = surface;
  return repaired;
}

std::vector<Door> doors() {
  ContractionOptions paper;
  paper.flow = Flow::paper;
  return {
      {"extract", true, [](const Surface& s) { (void)extract(s); }},
      {"extract", true,
       [](const Surface& s) {
         ExtractionCache cache;
         (void)extract(s, {}, {}, cache);
       }},
      {"extract", true, [](const Surface& s) { (void)extract_repaired(as_if_repaired(s)); }},
      {"evaluate", true, [](const Surface& s) { (void)evaluate(s, a_skeleton()); }},
      {"evaluate_repaired", true,
       [](const Surface& s) { (void)evaluate_repaired(as_if_repaired(s), {}, a_skeleton()); }},
      {"make_rig", true, [](const Surface& s) { (void)make_rig(s, a_skeleton()); }},
      {"skin_weights", true,
       [](const Surface& s) { (void)skin_weights(s, a_skeleton(), {}, {}, 1); }},
      {"coarsen", true, [](const Surface& s) { (void)coarsen(s); }},
      {"contract", true, [paper](const Surface& s) { (void)contract(s, {}, paper); }},
      {"surgery", true,
       [](const Surface& s) {
         (void)surgery(s, Contraction{torus(), {}, {}});
       }},
      {"embed", true,
       [](const Surface& s) {
         (void)embed({s, a_tree(), []() -> const SurfaceTree& { return a_tree(); }, {}, {}}, {}, 1,
                     {});
       }},
      {"fair", false, [](const Surface& s) { (void)fair(s); }},
      {"inscribed_balls", false, [](const Surface& s) { (void)inscribed_balls(s, a_tree(), 1); }},
      {"SurfaceTree", false, [](const Surface& s) { (void)SurfaceTree(s); }},
      {"cotangent_laplacian", false, [](const Surface& s) { (void)cotangent_laplacian(s); }},
      {"intrinsic_delaunay_laplacian", false,
       [](const Surface& s) { (void)intrinsic_delaunay_laplacian(s); }},
      {"vertex_areas", false, [](const Surface& s) { (void)vertex_areas(s); }},
  };
}

/// The message, if the door refuses it as input; else what happened instead.
std::string refusal(const Door& door, const Surface& surface) {
  try {
    door.enter(surface);
  } catch (const Error& error) {
    if (error.fault() != Fault::input) return "another fault";
    return error.what();
  }
  return "no error";
}

struct Flaw {
  std::string words;
  bool is_of_topology;
  Surface surface;
};

std::vector<Flaw> flaws() {
  Surface open = torus();
  open.triangles.conservativeResize(open.triangles.rows() - 1, 3);
  Surface flipped = torus();
  std::swap(flipped.triangles(5, 0), flipped.triangles(5, 1));
  Surface lone = torus();
  lone.positions.conservativeResize(lone.positions.rows() + 1, 3);
  lone.positions.bottomRows(1).setZero();
  Surface repeated = torus();
  repeated.triangles(3, 1) = repeated.triangles(3, 0);
  Surface doubled;
  doubled.positions = torus().positions.topRows(3);
  doubled.triangles.resize(2, 3);
  doubled.triangles << 0, 1, 2, 2, 1, 0;
  Surface beyond = torus();
  beyond.triangles(7, 2) = static_cast<int>(beyond.positions.rows());
  Surface below = torus();
  below.triangles(7, 2) = -1;
  Surface not_finite = torus();
  not_finite.positions(4, 1) = std::numeric_limits<double>::quiet_NaN();
  Surface endless = torus();
  endless.positions(4, 1) = std::numeric_limits<double>::infinity();
  Surface without_faces = torus();
  without_faces.triangles.resize(0, 3);
  const std::string corner = "a face (number 7) with corner ";
  return {
      {"3 open edges (the first: from vertex ", true, open},
      {"1 non-manifold edge (from vertex 0 to 1)", true, two_tetrahedra(2)},
      {"1 non-manifold vertex (vertex 0)", true, two_tetrahedra(1)},
      {"3 edges whose faces are turned opposite ways", true, flipped},
      {"1 vertex without a face (vertex " + std::to_string(torus().positions.rows()), true, lone},
      {"1 face with a repeated corner (face 3)", true, repeated},
      {"1 face that another one repeats (vertices 0, 1, 2)", true, doubled},
      {corner + std::to_string(torus().positions.rows()), false, beyond},
      {corner + "-1", false, below},
      {"a coordinate that is no finite number (vertex 4)", false, not_finite},
      {"a coordinate that is no finite number (vertex 4)", false, endless},
      {"0 vertices without faces", false, {}},
      {" vertices without faces", false, without_faces}};
}

TEST(Doors, RefuseWhatIsNoClosedManifoldAndSayWhere) {
  for (const Door& door : doors()) {
    for (const Flaw& flaw : flaws()) {
      if (flaw.is_of_topology && !door.needs_closed) continue;
      if (door.name == "fair" && flaw.surface.triangles.rows() == 0) continue;  // nothing to fair
      const std::string message = refusal(door, flaw.surface);
      EXPECT_TRUE(message.starts_with(door.name + ": ")) << door.name << ": " << message;
      EXPECT_NE(message.find(flaw.words), std::string::npos)
          << door.name << " should find " << flaw.words << ", says " << message;
      const bool says_remedy = message.find("repair()") != std::string::npos;
      EXPECT_EQ(says_remedy, flaw.is_of_topology) << message;
    }
  }
}

TEST(Doors, RefuseSizesWhoseSquaresAreNoNumbers) {
  for (const double scale : {1e-310, 1e-170, 1e160, 1e200}) {
    Surface scaled = torus();
    scaled.positions *= scale;
    for (const Door& door : doors()) {
      if (!door.needs_closed) continue;
      const std::string message = refusal(door, scaled);
      EXPECT_TRUE(message.starts_with(door.name + ": ")) << door.name << ": " << message;
      EXPECT_NE(message.find("scale the surface"), std::string::npos) << message;
    }
  }
}

TEST(Doors, LetInAnOpenSurfaceWhereOneIsNotNeededClosed) {
  const Surface open = flaws().front().surface;
  for (const Door& door : doors()) {
    if (door.needs_closed) continue;
    EXPECT_EQ(refusal(door, open), "no error") << door.name;
  }
}

TEST(Doors, LetInEveryShape) {
  for (const auto& entry : shapes::catalogue()) {
    EXPECT_NO_THROW(require_closed_manifold(entry.make().surface, "shape")) << entry.name;
  }
}

TEST(Doors, RefuseAContractionOrBallsOfAnotherSurface) {
  EXPECT_THROW((void)surgery(torus(), Contraction{torus(), {}, {}}), Error);
  EXPECT_THROW(
      (void)embed({torus(), a_tree(), []() -> const SurfaceTree& { return a_tree(); }, {}, {}}, {},
                  1, {}),
      Error);
}

TEST(Doors, RefuseASkeletonWithNumbersOfNoNode) {
  const int nodes = static_cast<int>(a_skeleton().nodes.rows());
  CurveSkeleton edge_beyond = a_skeleton();
  edge_beyond.edges(0, 1) = nodes;
  CurveSkeleton few_radii = a_skeleton();
  few_radii.radii.setOnes(nodes - 1);
  CurveSkeleton vertex_beyond = a_skeleton();
  vertex_beyond.node_of_vertex.setConstant(torus().positions.rows(), nodes);
  CurveSkeleton few_vertices = a_skeleton();
  few_vertices.node_of_vertex.setZero(3);
  for (const CurveSkeleton& spoilt : {edge_beyond, few_radii, vertex_beyond}) {
    EXPECT_THROW((void)evaluate(torus(), spoilt), Error);
    EXPECT_THROW((void)findings(a_tree(), 1, spoilt, {}, {}), Error);
    EXPECT_THROW((void)place_joints(spoilt), Error);
    EXPECT_THROW((void)make_rig(torus(), spoilt), Error);
  }
  EXPECT_THROW((void)make_rig(torus(), few_vertices), Error);
  EXPECT_THROW((void)skin_weights(torus(), few_vertices, Eigen::VectorXi::Zero(nodes), {}, 1),
               Error);
}

}  // namespace
}  // namespace curveskel::doors_laws
