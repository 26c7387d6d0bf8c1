#include "rig/skin/skin_sources.hpp"

#include <algorithm>
#include <limits>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/monitor.hpp>
#include "base/parallel.hpp"
#include "rig/skin/skin_bones.hpp"

namespace curveskel {
namespace {

/// A distance of nothing would be heat without end.
double least_distance(const Surface& surface) {
  return 1e-3 * bounding_box_diagonal(surface.positions);
}

/// 2 d / (1 + cos a). Straight above a vertex rounding may take 1 + cos a below nothing.
double counted(double length, double cosine) {
  constexpr double least = 1e-6;
  return 2 * length / std::max(1 + cosine, least);
}

/// That hold one vertex.
struct Holders {
  std::vector<int> joints;  ///< ascending
  double distance = 0;      ///< as it is counted
};

/// From the vertices to the bones.
class Sight {
 public:
  Sight(const Surface& surface, int threads)
      : surface_(surface), normals_(vertex_normals(surface)), tree_(surface, threads) {}

  /// `distances` is room for those of the bones.
  [[nodiscard]] Holders holders_of(int vertex, const std::vector<Bone>& bones,
                                   std::vector<double>& distances) const {
    constexpr double as_near = 1e-4;
    const Eigen::RowVector3d place = surface_.positions.row(vertex);
    const Eigen::RowVector3d normal = normals_.row(vertex).normalized();
    double least = std::numeric_limits<double>::infinity();
    distances.resize(bones.size());
    for (std::size_t k = 0; k < bones.size(); ++k) {
      const Eigen::RowVector3d way = place - nearest_on(bones[k], place);
      const double length = way.norm();
      distances[k] = length > 0 ? counted(length, way.dot(normal) / length) : 0;
      least = std::min(least, distances[k]);
    }
    Holders holders{{}, least};
    for (std::size_t k = 0; k < bones.size(); ++k) {
      if (!(distances[k] <= (1 + as_near) * least) || !sees(place, bones[k])) continue;
      holders.joints.push_back(bones[k].joint);
    }
    std::sort(holders.joints.begin(), holders.joints.end());
    holders.joints.erase(std::unique(holders.joints.begin(), holders.joints.end()),
                         holders.joints.end());
    return holders;
  }

 private:
  [[nodiscard]] bool sees(const Eigen::RowVector3d& place, const Bone& bone) const {
    constexpr double up_to = 1 - 1e-3;  // of the way: the faces at its end are the vertex' own
    const Eigen::RowVector3d from = nearest_on(bone, place);
    const Eigen::RowVector3d way = place - from;
    const double length = way.norm();
    if (!(length > 0)) return true;
    return tree_.ray(from.transpose(), way.transpose() / length, up_to * length).triangle < 0;
  }

  const Surface& surface_;
  Positions normals_;
  SurfaceTree tree_;
};

/// Bones by the component of the curve that they are of; some are of all.
class BonesByCurve {
 public:
  BonesByCurve(const std::vector<Bone>& bones, const std::vector<int>& curve_of_node) {
    int curves = 0;
    for (const int curve : curve_of_node) curves = std::max(curves, curve + 1);
    of_curve_.resize(idx(curves));
    for (const Bone& bone : bones) {
      if (bone.part < 0) of_all_.push_back(bone);
      if (bone.part >= 0 && bone.part < curves) of_curve_[idx(bone.part)].push_back(bone);
    }
  }

  [[nodiscard]] std::vector<Bone> of(int curve) const {
    std::vector<Bone> bones = of_all_;
    bones.insert(bones.end(), of_curve_[idx(curve)].begin(), of_curve_[idx(curve)].end());
    return bones;
  }

 private:
  std::vector<Bone> of_all_;
  std::vector<std::vector<Bone>> of_curve_;
};

/// In the order of the vertices; empty where hardly any is held.
std::vector<Holders> holders_of(const std::vector<int>& vertices, const std::vector<Bone>& bones,
                                const Sight& sight, int threads, const std::stop_token& stop) {
  constexpr double least_held = 0.1;  // few that see a bone by chance do not decide for all
  if (bones.empty()) return {};
  std::vector<Holders> holders(vertices.size());
  parallel_for(holders.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<double> distances;
    for (std::size_t v = begin; v < end; ++v) {
      throw_if_stopped(stop);
      holders[v] = sight.holders_of(vertices[v], bones, distances);
    }
  });
  const auto held = std::count_if(holders.begin(), holders.end(),
                                  [](const Holders& one) { return !one.joints.empty(); });
  if (static_cast<double>(held) < least_held * static_cast<double>(holders.size())) holders.clear();
  return holders;
}

}  // namespace

SkinSources sources_of_curve(const Surface& surface, const CurveSkeleton& skeleton,
                             const Eigen::VectorXi& joint_of_node, int joints) {
  const Eigen::Index count = surface.positions.rows();
  const double least = least_distance(surface);
  SkinSources sources{SkinSources::Shares(count, joints), Eigen::VectorXd(count)};
  sources.shares.reserve(Eigen::VectorXi::Ones(count));
  for (Eigen::Index v = 0; v < count; ++v) {
    const int node = skeleton.node_of_vertex[v];
    sources.shares.insert(v, joint_of_node[node]) = 1;
    sources.distances[v] =
        std::max((surface.positions.row(v) - skeleton.nodes.row(node)).norm(), least);
  }
  return sources;
}

SkinSources sources_of_bones(const Surface& surface, const CurveSkeleton& skeleton,
                             const std::vector<Component>& parts, const std::vector<Bone>& bones,
                             const SkinSources& otherwise, int threads,
                             const std::stop_token& stop) {
  const double least = least_distance(surface);
  const Sight sight(surface, threads);
  const std::vector<int> curves = connected_components(skeleton.nodes.rows(), skeleton.edges);
  const BonesByCurve by_curve(bones, curves);
  SkinSources sources{SkinSources::Shares(otherwise.shares.rows(), otherwise.shares.cols()),
                      otherwise.distances};
  std::vector<Eigen::Triplet<double>> shares;
  shares.reserve(idx(otherwise.shares.nonZeros()));
  for (const Component& part : parts) {
    throw_if_stopped(stop);
    const std::vector<int>& vertices = part.vertex_in_whole;
    const int curve = curves[idx(skeleton.node_of_vertex[vertices.front()])];
    const std::vector<Holders> holders =
        holders_of(vertices, by_curve.of(curve), sight, threads, stop);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const int vertex = vertices[v];
      if (holders.empty()) {
        for (SkinSources::Shares::InnerIterator it(otherwise.shares, vertex); it; ++it) {
          shares.emplace_back(vertex, static_cast<int>(it.col()), it.value());
        }
        continue;
      }
      sources.distances[vertex] = std::max(holders[v].distance, least);
      for (const int joint : holders[v].joints) {
        shares.emplace_back(vertex, joint, 1 / static_cast<double>(holders[v].joints.size()));
      }
    }
  }
  sources.shares.setFromTriplets(shares.begin(), shares.end());
  return sources;
}

}  // namespace curveskel
