#include "skeleton/pipeline/copies.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include "surface/mesh/mean_values.hpp"

namespace curveskel {
namespace {

/// From the first one's frame to the copy's.
Eigen::Affine3d motion_between(const Positions& first, const Positions& copy) {
  return Eigen::Affine3d(
      Eigen::umeyama(Eigen::Matrix3Xd(first.transpose()), Eigen::Matrix3Xd(copy.transpose())));
}

Positions moved(const Positions& places, const Eigen::Affine3d& motion) {
  const Eigen::Matrix3Xd there = motion * Eigen::Matrix3Xd(places.transpose());
  return there.transpose();
}

/// A part, and how far its vertices are from its mean.
struct Sized {
  std::size_t number;
  Eigen::VectorXd from_middle;
  double size = 0;  ///< the farthest of them

  Sized(std::size_t part, const Positions& positions) : number(part) {
    const Eigen::RowVector3d mean = positions.colwise().mean();
    from_middle = (positions.rowwise() - mean).rowwise().norm();
    size = from_middle.maxCoeff();
  }
};

/// Of its kinds so far.
class KindsOfParts {
 public:
  explicit KindsOfParts(const std::vector<Part>& parts) : parts_(parts) {}

  /// The first that the part is a copy of, which may be itself.
  std::size_t first_of(std::size_t number) {
    constexpr int most_compared = 64;
    const Surface& surface = parts_[number].component.surface;
    const Sized own(number, surface.positions);
    if (!(own.size > 0)) return number;
    const double tolerance = tolerance_of(own);
    auto& alike = by_triangles_[faces_of(surface)];  // by how far the first vertex is
    const double place = own.from_middle[0] / own.size;
    const double window = 2 * tolerance / own.size;
    int compared = 0;
    for (auto at = alike.lower_bound(place - window);
         at != alike.end() && at->first <= place + window && compared < most_compared; ++at) {
      ++compared;
      if (is_copy(at->second, own, tolerance)) return at->second.number;
    }
    alike.emplace(place, own);
    return number;
  }

 private:
  static std::vector<int> faces_of(const Surface& surface) {
    const auto corners = surface.triangles.reshaped<Eigen::RowMajor>();
    return {corners.begin(), corners.end()};
  }

  [[nodiscard]] double tolerance_of(const Sized& own) const {
    constexpr double of_whole = 1e-4;
    constexpr double of_own = 1e-2;
    return own.size * std::min(of_whole / parts_[own.number].extent, of_own);
  }

  [[nodiscard]] bool is_copy(const Sized& first, const Sized& own, double tolerance) const {
    constexpr double most_scaled = 1.25;
    const double scale = own.size / first.size;
    if (scale > most_scaled || scale * most_scaled < 1) return false;
    const double farthest = (scale * first.from_middle - own.from_middle).cwiseAbs().maxCoeff();
    if (farthest > 2 * tolerance) return false;
    const Positions& its = parts_[first.number].component.surface.positions;
    const Positions& copy = parts_[own.number].component.surface.positions;
    const Positions there = moved(its, motion_between(its, copy));
    return (there - copy).rowwise().norm().maxCoeff() <= tolerance;
  }

  const std::vector<Part>& parts_;
  std::map<std::vector<int>, std::multimap<double, Sized>> by_triangles_;
};

/// Each place as it lies among the vertices, in which the digits of a file leave no two leaves
/// alike: a leaf is thinner than they are apart.
Positions carried_over(const Positions& places, const Surface& first, const Surface& copy) {
  Positions there(places.rows(), 3);
  for (Eigen::Index k = 0; k < places.rows(); ++k) {
    there.row(k) =
        mean_value_coordinates(first, places.row(k).transpose()).transpose() * copy.positions;
  }
  return there;
}

/// By the nodes and the middles of the edges.
bool lies_inside(const CurveSkeleton& skeleton, const SurfaceTree& tree) {
  const auto is_inside = [&](const Eigen::Vector3d& place) { return tree.inside(place); };
  for (const auto& node : skeleton.nodes.rowwise()) {
    if (!is_inside(node.transpose())) return false;
  }
  for (const auto& edge : skeleton.edges.rowwise()) {
    const Eigen::RowVector3d middle =
        0.5 * (skeleton.nodes.row(edge[0]) + skeleton.nodes.row(edge[1]));
    if (!is_inside(middle.transpose())) return false;
  }
  return true;
}

}  // namespace

std::vector<std::size_t> firsts_of_kind(const std::vector<Part>& parts,
                                        const std::vector<std::size_t>& asked) {
  KindsOfParts kinds(parts);
  std::vector<std::size_t> firsts;
  firsts.reserve(asked.size());
  for (const std::size_t number : asked) firsts.push_back(kinds.first_of(number));
  return firsts;
}

std::optional<ComponentResult> result_of_copy(const Part& first, const ComponentResult& result,
                                              const Part& copy) {
  const Surface& its = first.component.surface;
  const Surface& surface = copy.component.surface;
  const SurfaceTree tree(surface);
  CurveSkeleton skeleton = *result.skeleton;
  skeleton.nodes = moved(result.skeleton->nodes, motion_between(its.positions, surface.positions));
  if (!lies_inside(skeleton, tree)) {
    skeleton.nodes = carried_over(result.skeleton->nodes, its, surface);
    if (!lies_inside(skeleton, tree)) return std::nullopt;
  }
  for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) {
    skeleton.radii[node] = tree.inscribed_radius(skeleton.nodes.row(node).transpose());
  }
  return ComponentResult{std::make_shared<const CurveSkeleton>(std::move(skeleton)),
                         nullptr,
                         result.record,
                         {},
                         {},
                         {},
                         result.has_all_vertices};
}

}  // namespace curveskel
