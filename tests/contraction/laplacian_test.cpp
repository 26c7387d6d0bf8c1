// Laws of the Laplacians, over every shape of the catalogue and over what contraction makes of it.
#include <curveskel/advanced/laplacian.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::laplacian_laws {
namespace {

using shapes::Shape;

struct Case {
  std::string name;
  Surface surface;
};

Shape flattened(Shape shape, double factor) {
  shape.surface.positions.col(2) *= factor;
  return shape;
}

/// Every family as it is, and as late iterations see it: squashed, crumpled, scaled.
const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> made;
    for (const auto& entry : shapes::catalogue()) {
      made.push_back({std::string(entry.name), entry.make().surface});
    }
    const Shape y = shapes::tube_union("", shapes::star(3, 6, 1));
    made.push_back({"y, squashed to 1e-3", flattened(y, 1e-3).surface});
    made.push_back({"y, flat", flattened(y, 0).surface});
    made.push_back({"y, crumpled", shapes::noisy(y, 0.3, 7).surface});
    made.push_back({"y, 1e-8 times", shapes::scaled(y, 1e-8).surface});
    made.push_back({"y, 1e8 times", shapes::scaled(y, 1e8).surface});
    return made;
  }();
  return all;
}

struct Operator {
  const char* name;
  std::function<SparseMatrix(const Surface&)> make;
};

const std::vector<Operator>& operators() {
  static const std::vector<Operator> both = {
      {"cotangent", [](const Surface& s) { return cotangent_laplacian(s); }},
      {"intrinsic Delaunay", [](const Surface& s) { return intrinsic_delaunay_laplacian(s); }},
  };
  return both;
}

double scale(const SparseMatrix& laplacian) { return (-laplacian.diagonal()).maxCoeff(); }

struct Made {
  std::string name;
  SparseMatrix laplacian;
};

/// Every operator of every case, made once.
const std::vector<Made>& made() {
  static const std::vector<Made> all = [] {
    std::vector<Made> list;
    for (const auto& op : operators()) {
      for (const auto& each : cases()) {
        list.push_back({op.name + (", " + each.name), op.make(each.surface)});
      }
    }
    return list;
  }();
  return all;
}

/// Some function on the vertices that is neither smooth nor symmetric.
Eigen::VectorXd wild(Eigen::Index vertices) {
  Eigen::VectorXd x(vertices);
  for (Eigen::Index i = 0; i < vertices; ++i)
    x[i] = std::sin(1.0 + 12.9898 * static_cast<double>(i));
  return x;
}

double energy(const SparseMatrix& laplacian, const Eigen::VectorXd& x) {
  return -x.dot(laplacian * x);
}

TEST(Laplacian, MapsConstantsToZero) {
  for (const auto& each : made()) {
    const SparseMatrix& l = each.laplacian;
    const Eigen::VectorXd sum = l * Eigen::VectorXd::Ones(l.cols());
    EXPECT_LE(sum.cwiseAbs().maxCoeff(), 1e-12 * scale(l)) << each.name;
  }
}

TEST(Laplacian, IsSymmetric) {
  for (const auto& each : made()) {
    const SparseMatrix& l = each.laplacian;
    const SparseMatrix difference = l - SparseMatrix(l.transpose());
    EXPECT_LE(difference.norm(), 1e-13 * l.norm()) << each.name;
  }
}

TEST(Laplacian, IsNegativeSemiDefinite) {
  for (const auto& each : made()) {
    const SparseMatrix& l = each.laplacian;
    const Eigen::VectorXd x = wild(l.cols());
    EXPECT_GE(energy(l, x), 0) << each.name;
  }
}

TEST(Laplacian, IsUnitFree) {
  const Surface y = shapes::tube_union("", shapes::star(3, 6, 1)).surface;
  for (const auto& op : operators()) {
    const SparseMatrix l = op.make(y);
    for (const double factor : {1e-8, 1e8}) {
      Surface other = y;
      other.positions *= factor;
      const SparseMatrix difference = op.make(other) - l;
      EXPECT_LE(difference.norm(), 1e-9 * l.norm()) << op.name << ", " << factor;
    }
  }
}

TEST(Laplacian, VanishesOnLinearFunctionsWhereTheSurfaceIsFlat) {
  const Surface box = shapes::box({3, 2, 1}, 15).surface;
  const double margin = 0.45;  // two rings of cells of 0.2
  for (const auto& op : operators()) {
    const SparseMatrix l = op.make(box);
    const Positions image = l * box.positions;
    int flat = 0;
    for (Eigen::Index v = 0; v < box.positions.rows(); ++v) {
      const auto p = box.positions.row(v);
      const auto away = [&](int axis, double half) { return std::abs(p[axis]) < half - margin; };
      if (std::abs(p[2]) < 0.5 - 1e-9 || !away(0, 1.5) || !away(1, 1)) continue;
      ++flat;
      EXPECT_LE(image.row(v).norm(), 1e-12 * scale(l)) << op.name << ", vertex " << v;
    }
    EXPECT_GT(flat, 20);
  }
}

// The Dirichlet energy of the three coordinate functions is twice the area.
TEST(CotangentLaplacian, EnergyOfTheCoordinatesIsTwiceTheArea) {
  for (const auto& each : cases()) {
    const SparseMatrix l = cotangent_laplacian(each.surface);
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += energy(l, each.surface.positions.col(k));
    const double twice = 2 * area(each.surface);
    EXPECT_NEAR(sum, twice, 1e-9 * twice) << each.name;
  }
}

TEST(IntrinsicDelaunayLaplacian, HasNoNegativeWeight) {
  for (const auto& each : cases()) {
    const SparseMatrix l = intrinsic_delaunay_laplacian(each.surface);
    for (Eigen::Index j = 0; j < l.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator entry(l, j); entry; ++entry) {
        ASSERT_TRUE(std::isfinite(entry.value())) << each.name;
        if (entry.row() != entry.col()) {
          ASSERT_GE(entry.value(), 0) << each.name;
        }
      }
    }
  }
}

TEST(IntrinsicDelaunayLaplacian, IsTheCotangentLaplacianOfADelaunaySurface) {
  const Surface sphere = shapes::ellipsoid({1, 1, 1}, 4).surface;
  const SparseMatrix l = cotangent_laplacian(sphere);
  const SparseMatrix difference = intrinsic_delaunay_laplacian(sphere) - l;
  EXPECT_LE(difference.norm(), 1e-12 * l.norm());
}

// Rippa 1990, Bobenko and Springborn 2007: of all intrinsic triangulations Delaunay's has the least
// energy, for every function on the vertices.
TEST(IntrinsicDelaunayLaplacian, HasTheLeastEnergy) {
  const double no_limit = std::numeric_limits<double>::infinity();
  int flipped = 0;
  for (const auto& [name, surface] : cases()) {
    const SparseMatrix delaunay = intrinsic_delaunay_laplacian(surface, 0, no_limit);
    const SparseMatrix cotangent = cotangent_laplacian(surface);
    flipped += (delaunay - cotangent).norm() > 1e-6 * cotangent.norm() ? 1 : 0;
    for (const Eigen::VectorXd& x :
         {wild(surface.positions.rows()), Eigen::VectorXd(surface.positions.col(0))}) {
      const double energy_as_given = energy(cotangent, x);
      EXPECT_LE(energy(delaunay, x), energy_as_given * (1 + 1e-10)) << name;
    }
  }
  EXPECT_GT(flipped, 3) << "no shape that needs flips";
}

TEST(IntrinsicDelaunayLaplacian, SurvivesEveryDegeneration) {
  const Surface ring = shapes::torus(3, 1, 12).surface;
  std::vector<Case> worst;
  worst.push_back({"one point", ring});
  worst.back().surface.positions.setConstant(0.7);
  worst.push_back({"one line", ring});
  worst.back().surface.positions.rightCols(2).setZero();
  worst.push_back({"vertices in pairs", ring});
  for (Eigen::Index v = 1; v < ring.positions.rows(); v += 2) {
    worst.back().surface.positions.row(v) = worst.back().surface.positions.row(v - 1);
  }
  worst.push_back({"one far spike", ring});
  worst.back().surface.positions.row(5) *= 1e6;
  worst.push_back({"needles", ring});
  worst.back().surface.positions.col(0) *= 1e9;
  for (const auto& each : worst) {
    const SparseMatrix l = intrinsic_delaunay_laplacian(each.surface);
    EXPECT_TRUE(Eigen::VectorXd(l.diagonal()).allFinite()) << each.name;
    EXPECT_LE((l * Eigen::VectorXd::Ones(l.cols())).cwiseAbs().maxCoeff(), 1e-12 * scale(l))
        << each.name;
    EXPECT_GT(scale(l), 0) << each.name;
    // No weight above the limit: a row of k parallel edges adds up to k limits at most.
    EXPECT_LE(scale(l), 1e3 * static_cast<double>(l.nonZeros())) << each.name;
    for (Eigen::Index j = 0; j < l.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator entry(l, j); entry; ++entry) {
        if (entry.row() != entry.col()) {
          EXPECT_GE(entry.value(), 0) << each.name;
        }
      }
    }
  }
}

TEST(IntrinsicDelaunayLaplacian, RefusesWhatIsNoSurface) {
  Surface fan;
  fan.positions = Positions::Random(5, 3);
  fan.triangles.resize(3, 3);
  fan.triangles << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  try {
    (void)intrinsic_delaunay_laplacian(fan);
    FAIL() << "three faces at one edge went through";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_NE(std::string(error.what()).find("edge (0, 1)"), std::string::npos) << error.what();
  }
}

TEST(VertexAreas, SumUpToTheArea) {
  for (const auto& each : cases()) {
    const double whole = area(each.surface);
    EXPECT_NEAR(vertex_areas(each.surface).sum(), whole, 1e-12 * whole) << each.name;
  }
}

}  // namespace
}  // namespace curveskel::laplacian_laws
