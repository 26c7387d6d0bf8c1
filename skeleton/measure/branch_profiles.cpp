#include <curveskel/branch_profiles.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/branch_territories.hpp>
#include <curveskel/error.hpp>
#include "base/decimal.hpp"
#include "base/parallel.hpp"
#include "skeleton/graph/sound_skeleton.hpp"
#include "skeleton/measure/branch_curve.hpp"
#include "skeleton/measure/plane_section.hpp"
#include "surface/mesh/lids.hpp"

namespace curveskel {
namespace {

constexpr double no_section = std::numeric_limits<double>::quiet_NaN();
constexpr double most_sections = 1e7;

std::vector<double> places_on(const BranchCurve& curve, double spacing) {
  if (spacing == 0) return curve.lengths;
  const double steps = std::max(1.0, std::ceil(curve.length() / spacing - 1e-9));
  if (!(steps < most_sections)) {
    std::string message = "a branch of length ";
    append_decimal(message, curve.length());
    message += " has too many sections at a spacing of ";
    append_decimal(message, spacing);
    throw Error(Fault::usage, message + "; needed 10^7 at most: give a wider spacing");
  }
  std::vector<double> places;
  for (int k = 0; k <= static_cast<int>(steps); ++k) places.push_back(curve.length() * k / steps);
  return places;
}

/// Everything that sections are cut from.
struct Cutting {
  const Surface& surface;
  const SurfaceTree& tree;
  const SurfaceTree* open_tree;  ///< of the surface without what closes holes; null = none are
  const CurveSkeleton& skeleton;
  std::vector<Branch> all_branches;
  std::vector<BranchCurve> curves;
  std::vector<int> degree;
  std::vector<int> branch_of_edge;
  Eigen::VectorXi branch_of_face;  ///< empty without a vertex map
};

Cutting prepare(const Surface& surface, const SurfaceTree& tree, const SurfaceTree* open_tree,
                const CurveSkeleton& skeleton) {
  Cutting cutting{surface, tree, open_tree, skeleton, branches(skeleton), {}, {}, {}, {}};
  cutting.degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  cutting.branch_of_edge = branch_of_edges(skeleton);
  cutting.curves.reserve(cutting.all_branches.size());
  for (const Branch& branch : cutting.all_branches) {
    cutting.curves.push_back(branch_curve(skeleton, branch));
  }
  if (skeleton.node_of_vertex.size() == surface.positions.rows()) {
    cutting.branch_of_face = branch_territories(surface, skeleton).branch_of_face;
  }
  return cutting;
}

double inscribed_radius(const Cutting& cutting, const Eigen::Vector3d& place) {
  const double closed = cutting.tree.inscribed_radius(place);
  if (closed <= 0 || cutting.open_tree == nullptr) return closed;
  return cutting.open_tree->nearest(place).distance;
}

bool in_ball_of_junction(const Cutting& cutting, const BranchSection& section) {
  const Branch& branch = cutting.all_branches[idx(section.branch)];
  for (const int node : {branch.nodes.front(), branch.nodes.back()}) {
    if (cutting.degree[idx(node)] < 3) continue;
    const Eigen::Vector3d centre = cutting.skeleton.nodes.row(node);
    if ((section.position - centre).norm() <= inscribed_radius(cutting, centre)) return true;
  }
  return false;
}

bool meets_other_branch(const Cutting& cutting, const BranchSection& section,
                        const PlaneSection& plane) {
  const Positions& nodes = cutting.skeleton.nodes;
  for (Eigen::Index edge = 0; edge < cutting.skeleton.edges.rows(); ++edge) {
    if (cutting.branch_of_edge[idx(edge)] == section.branch) continue;
    const Eigen::Vector3d a = nodes.row(cutting.skeleton.edges(edge, 0));
    const Eigen::Vector3d b = nodes.row(cutting.skeleton.edges(edge, 1));
    const double height_a = (a - section.position).dot(section.tangent);
    const double height_b = (b - section.position).dot(section.tangent);
    if ((height_a >= 0) == (height_b >= 0)) continue;
    const double share = height_a / (height_a - height_b);
    if (contains(plane, (1 - share) * a + share * b)) return true;
  }
  return false;
}

/// The border between two branches is ragged by a triangle or two, hence a tenth of the boundary.
bool runs_into_other_branches(const Cutting& cutting, const BranchSection& section,
                              const PlaneSection& plane) {
  if (cutting.branch_of_face.size() == 0) return false;
  double elsewhere = 0;
  for (const SectionLoop& loop : plane.boundary) {
    const Eigen::Index corners = loop.corners.cols();
    for (Eigen::Index k = 0; k < corners; ++k) {
      const int branch = cutting.branch_of_face[loop.triangles[idx(k)]];
      if (branch < 0 || branch == section.branch) continue;
      elsewhere += (loop.corners.col((k + 1) % corners) - loop.corners.col(k)).norm();
    }
  }
  return elsewhere > 0.1 * section.perimeter;
}

void cut(const Cutting& cutting, BranchSection& section) {
  const BranchCurve& curve = cutting.curves[idx(section.branch)];
  section.position = point_at(curve, section.s);
  section.tangent = derivatives_at(curve, section.s).first.normalized();
  section.inscribed_radius = inscribed_radius(cutting, section.position);
  section.area = section.perimeter = section.equivalent_diameter = section.ellipticity = no_section;
  section.near_junction = in_ball_of_junction(cutting, section);
  if (section.tangent.isZero()) return;
  const auto plane =
      section_around(cutting.surface, cutting.tree, section.position, section.tangent);
  if (!plane) return;
  const SectionMeasures measures = measure(*plane);
  section.area = measures.area;
  section.perimeter = measures.perimeter;
  section.equivalent_diameter = 2 * std::sqrt(measures.area / std::numbers::pi);
  const Eigen::Vector2d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(
                                      measures.second_moments, Eigen::EigenvaluesOnly)
                                      .eigenvalues();
  section.ellipticity = 1 - std::sqrt(std::max(0.0, moments[0]) / moments[1]);
  section.near_junction = section.near_junction || meets_other_branch(cutting, section, *plane) ||
                          runs_into_other_branches(cutting, section, *plane);
}

}  // namespace

std::vector<BranchSection> branch_profiles(const Surface& surface, const CurveSkeleton& skeleton,
                                           const ProfileOptions& options, const Monitor& monitor) {
  if (!(options.spacing >= 0)) {
    std::string message = "the spacing of sections is ";
    append_decimal(message, options.spacing);
    throw Error(Fault::usage, message + ", needed 0 (at the nodes) or more");
  }
  require_sound(skeleton, "branch_profiles");
  if (skeleton.node_of_vertex.size() > 0) {
    require_vertices_of(skeleton, surface, "branch_profiles");
  }
  const SurfaceTree tree(surface, options.threads);
  const Surface open = without_lids(surface, options.rims);
  std::optional<SurfaceTree> open_tree;
  if (open.triangles.rows() > 0) open_tree.emplace(open, options.threads);
  const Cutting cutting = prepare(surface, tree, open_tree ? &*open_tree : nullptr, skeleton);
  std::vector<BranchSection> sections;
  for (std::size_t b = 0; b < cutting.curves.size(); ++b) {
    for (const double s : places_on(cutting.curves[b], options.spacing)) {
      BranchSection section;
      section.branch = static_cast<int>(b);
      section.s = s;
      sections.push_back(section);
    }
  }
  constexpr std::size_t block = 256;
  for (std::size_t first = 0; first < sections.size(); first += block) {
    monitor.report("sections", static_cast<double>(first) / static_cast<double>(sections.size()));
    parallel_for(std::min(block, sections.size() - first), 8, options.threads,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t k = begin; k < end; ++k) cut(cutting, sections[first + k]);
                 });
  }
  return sections;
}

}  // namespace curveskel
