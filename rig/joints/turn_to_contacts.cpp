#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/joints/contacts.hpp"
#include "rig/joints/rooted_tree.hpp"
#include "surface/mesh/triangle_area.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// By component of the skeleton: the middles of the contacts by which it hangs, or others from it.
std::vector<std::vector<Vector3d>> hinges_by_curve(const CurveSkeleton& skeleton,
                                                   const std::vector<int>& curve_of_node) {
  std::vector<std::vector<Vector3d>> hinges(
      idx(1 + *std::max_element(curve_of_node.begin(), curve_of_node.end())));
  std::map<std::pair<int, int>, std::vector<Vector3d>> middles;  // of the contacts of two curves
  for (const Contact& contact : skeleton.contacts) {
    const int one = curve_of_node[idx(contact.one.node)];
    const int other = curve_of_node[idx(contact.other.node)];
    middles[std::minmax(one, other)].push_back(contact.middle);
  }
  const RootedTree rooted = rooted_tree(skeleton, -1);
  for (std::size_t k = 0; k < rooted.roots.size(); ++k) {
    if (rooted.above[k] < 0) continue;
    const int lower = curve_of_node[idx(rooted.roots[k])];
    const int upper = curve_of_node[idx(rooted.above[k])];
    const auto found = middles.find(std::minmax(lower, upper));
    if (found == middles.end()) continue;
    for (const int curve : {lower, upper}) {
      hinges[idx(curve)].insert(hinges[idx(curve)].end(), found->second.begin(),
                                found->second.end());
    }
  }
  return hinges;
}

/// By component of the skeleton: how far its surface spreads, by area.
std::vector<Eigen::Matrix3d> spreads_by_curve(const CurveSkeleton& skeleton, const Surface& surface,
                                              const std::vector<int>& curve_of_node) {
  const auto curves = idx(1 + *std::max_element(curve_of_node.begin(), curve_of_node.end()));
  std::vector<Eigen::Matrix3d> squares(curves, Eigen::Matrix3d::Zero());
  std::vector<Vector3d> sums(curves, Vector3d::Zero());
  std::vector<double> areas(curves, 0);
  const Vector3d origin = surface.positions.colwise().mean().transpose();
  for (const auto& t : surface.triangles.rowwise()) {
    const int node = skeleton.node_of_vertex[t[0]];
    if (node < 0) continue;
    const std::size_t curve = idx(curve_of_node[idx(node)]);
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = surface.positions.row(t[k]).transpose() - origin;
    const double size = 0.5 * twice_area(corners.col(0), corners.col(1), corners.col(2));
    const Vector3d sum = corners.rowwise().sum();
    squares[curve] += size / 12 * (corners * corners.transpose() + sum * sum.transpose());
    sums[curve] += size / 3 * sum;
    areas[curve] += size;
  }
  for (std::size_t curve = 0; curve < curves; ++curve) {
    if (!(areas[curve] > 0)) continue;
    const Vector3d mean = sums[curve] / areas[curve];
    squares[curve] = squares[curve] / areas[curve] - mean * mean.transpose();
  }
  return squares;
}

/// True if it spreads no more along the direction than the most across.
bool is_without_axis(const Eigen::Matrix3d& spread, const Vector3d& along) {
  constexpr double clearly = 1.25;  // longer than wide
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along * along.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> sections(across * spread * across);
  return along.dot(spread * along) < clearly * clearly * sections.eigenvalues()[2];
}

/// A component's curve, with its two tips if it is a chain.
struct ComponentCurve {
  std::vector<int> nodes;
  std::vector<int> tips;
  Vector3d middle = Vector3d::Zero();
};

std::vector<ComponentCurve> curves_of(const CurveSkeleton& skeleton,
                                      const std::vector<int>& curve_of_node, std::size_t count) {
  std::vector<int> degree(curve_of_node.size(), 0);
  for (const int node : skeleton.edges.reshaped()) ++degree[idx(node)];
  std::vector<ComponentCurve> curves(count);
  std::vector<char> is_chain(count, 1);
  for (std::size_t n = 0; n < curve_of_node.size(); ++n) {
    ComponentCurve& curve = curves[idx(curve_of_node[n])];
    curve.nodes.push_back(static_cast<int>(n));
    if (degree[n] == 1) curve.tips.push_back(static_cast<int>(n));
    if (degree[n] > 2) is_chain[idx(curve_of_node[n])] = 0;
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (is_chain[k] == 0) curves[k].tips.clear();
    for (const int node : curves[k].nodes) {
      curves[k].middle +=
          skeleton.nodes.row(node).transpose() / static_cast<double>(curves[k].nodes.size());
    }
  }
  return curves;
}

/// Away from the contact, or from one to the other; 0 where there are more or none.
Vector3d wanted_axis(const std::vector<Vector3d>& hinges, const Vector3d& middle) {
  if (hinges.size() == 1) return (middle - hinges[0]).stableNormalized();
  if (hinges.size() == 2) return (hinges[1] - hinges[0]).stableNormalized();
  return Vector3d::Zero();
}

int nearest_of(const CurveSkeleton& skeleton, const std::vector<int>& nodes, const Vector3d& to) {
  return *std::min_element(nodes.begin(), nodes.end(), [&](int a, int b) {
    return (skeleton.nodes.row(a).transpose() - to).squaredNorm() <
           (skeleton.nodes.row(b).transpose() - to).squaredNorm();
  });
}

/// True for a chain whose balls all reach the line through its tips: what bends farther has a
/// course of its own, as trousers and coils have.
bool is_straight(const CurveSkeleton& skeleton, const Eigen::VectorXd& radii,
                 const ComponentCurve& curve, const Vector3d& axis) {
  const Vector3d tip = skeleton.nodes.row(curve.tips[0]).transpose();
  return std::all_of(curve.nodes.begin(), curve.nodes.end(), [&](int node) {
    const Vector3d off = skeleton.nodes.row(node).transpose() - tip;
    return (off - off.dot(axis) * axis).norm() <= radii[node];
  });
}

/// True if the curve was turned.
bool turn(CurveSkeleton& skeleton, const Eigen::VectorXd& radii, const ComponentCurve& curve,
          const std::vector<Vector3d>& hinges, const Eigen::Matrix3d& spread) {
  if (curve.tips.size() != 2) return false;
  const Vector3d along =
      (skeleton.nodes.row(curve.tips[1]) - skeleton.nodes.row(curve.tips[0])).transpose();
  const Vector3d axis = along.stableNormalized();
  if (!is_straight(skeleton, radii, curve, axis)) return false;
  const Vector3d wanted = wanted_axis(hinges, curve.middle);
  if (wanted.isZero() || !is_without_axis(spread, axis)) return false;
  for (const int node : curve.nodes) {
    const double way = axis.dot(skeleton.nodes.row(node).transpose() - curve.middle);
    skeleton.nodes.row(node) = (curve.middle + way * wanted).transpose();
  }
  return true;
}

}  // namespace

void turn_to_contacts(CurveSkeleton& skeleton, const Surface& surface) {
  if (skeleton.contacts.empty()) return;
  const std::vector<int> curve_of_node = component_of_node(skeleton);
  const std::vector<std::vector<Vector3d>> hinges = hinges_by_curve(skeleton, curve_of_node);
  const std::vector<Eigen::Matrix3d> spreads = spreads_by_curve(skeleton, surface, curve_of_node);
  const std::vector<ComponentCurve> curves = curves_of(skeleton, curve_of_node, hinges.size());
  const Eigen::VectorXd radii = usable_radii(skeleton);
  std::vector<char> is_turned(curves.size(), 0);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    is_turned[k] = turn(skeleton, radii, curves[k], hinges[k], spreads[k]) ? 1 : 0;
  }
  for (Contact& contact : skeleton.contacts) {
    for (ContactSide* const side : {&contact.one, &contact.other}) {
      const auto k = idx(curve_of_node[idx(side->node)]);
      if (is_turned[k] == 0) continue;
      side->node = nearest_of(skeleton, curves[k].nodes, contact.middle);
      side->tips = {nearest_of(skeleton, curves[k].tips, contact.middle)};
    }
  }
  for (Eigen::Index v = 0; v < skeleton.node_of_vertex.size(); ++v) {
    int& node = skeleton.node_of_vertex[v];
    if (node < 0 || is_turned[idx(curve_of_node[idx(node)])] == 0) continue;
    const ComponentCurve& own = curves[idx(curve_of_node[idx(node)])];
    node = nearest_of(skeleton, own.nodes, surface.positions.row(v).transpose());
  }
}

}  // namespace curveskel
