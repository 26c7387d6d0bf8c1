#include "skeleton/match/vertex_pairs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"
#include "skeleton/match/branch_laying.hpp"
#include "skeleton/match/some_of.hpp"
#include "skeleton/measure/branch_curve.hpp"

namespace curveskel {

/// The faces of one branch, to find the vertex nearest to a place.
class TerritorySurface {
 public:
  TerritorySurface(const Surface& surface, const std::vector<int>& faces)
      : part_(part_of(surface, faces)) {
    if (!faces.empty()) tree_ = std::make_unique<SurfaceTree>(part_.surface, 1);
  }

  struct Nearest {
    int vertex = -1;      ///< a corner of the nearest face; -1 = the branch has no face
    double distance = 0;  ///< of the surface
  };
  [[nodiscard]] Nearest nearest(const Eigen::Vector3d& place) const {
    if (!tree_) return {};
    const SurfaceTree::Nearest found = tree_->nearest(place);
    const auto corners = part_.surface.triangles.row(found.triangle);
    Eigen::Index best = 0;
    (part_.surface.positions(corners.transpose(), Eigen::all).rowwise() - place.transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&best);
    return {part_.vertices[idx(corners[best])], found.distance};
  }

 private:
  SurfacePart part_;
  std::unique_ptr<SurfaceTree> tree_;
};

namespace {

/// The length on a branch of the point nearest to a place, from two nodes before `node` to two on.
double nearest_length(const BranchCurve& curve, Eigen::Index node, const Eigen::Vector3d& place) {
  constexpr Eigen::Index around = 2;
  double best = curve.lengths[idx(node)];
  double least = (curve.points.row(node).transpose() - place).squaredNorm();
  const Eigen::Index last = curve.points.rows() - 1;
  for (Eigen::Index step = node - around; step < node + around; ++step) {
    const Eigen::Index k = curve.closed ? (step + around * last) % last : step;
    if (k < 0 || k >= last) continue;
    const Eigen::Vector3d from = curve.points.row(k);
    const Eigen::Vector3d way = curve.points.row(k + 1).transpose() - from;
    if (!(way.squaredNorm() > 0)) continue;
    const double share = std::clamp((place - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
    const double distance = (from + share * way - place).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = curve.lengths[idx(k)] + share * way.norm();
  }
  return best;
}

/// One pair of branches, and how places around the one become places around the other.
class BranchTransfer {
 public:
  BranchTransfer(BranchCurve from, BranchCurve to, const BranchLaying& laying)
      : from_(std::move(from)), to_(std::move(to)), laying_(laying) {}

  [[nodiscard]] const BranchCurve& from() const { return from_; }

  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& place, double s,
                                           const Similarity& motion) const {
    const double t = laying_.length_on_partner(from_, to_, s);
    const Eigen::Vector3d here = motion.rotation * derivatives_at(from_, s).first;
    const Eigen::Vector3d there = (laying_.reversed ? -1 : 1) * derivatives_at(to_, t).first;
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(here, there);
    const double radius = radius_at(from_, s);
    const double scale = radius > 0 ? radius_at(to_, t) / radius : motion.scale;
    const Eigen::Vector3d out = motion.rotation * (place - point_at(from_, s));
    return point_at(to_, t) + scale * (turn * out);
  }

 private:
  BranchCurve from_;
  BranchCurve to_;
  BranchLaying laying_;
};

std::vector<std::vector<int>> faces_of_branches(const Eigen::VectorXi& branch_of_face,
                                                std::size_t count) {
  std::vector<std::vector<int>> faces(count);
  for (int face = 0; face < branch_of_face.size(); ++face) {
    if (branch_of_face[face] >= 0) faces[idx(branch_of_face[face])].push_back(face);
  }
  return faces;
}

/// The place of each node in the order of a branch's nodes.
std::map<int, Eigen::Index> places_of(const Branch& branch) {
  std::map<int, Eigen::Index> places;
  for (std::size_t k = 0; k < branch.nodes.size(); ++k) {
    places.emplace(branch.nodes[k], static_cast<Eigen::Index>(k));
  }
  return places;
}

}  // namespace

struct VertexPairing::Implementation {
  const MatchSide& a;
  const MatchSide& b;
  const BranchTerritories& territories_a;
  int threads;
  std::vector<Branch> of_a;
  std::vector<Branch> of_b;
  std::vector<std::unique_ptr<const TerritorySurface>> territories;  ///< by branch of b
};

VertexPairing::VertexPairing(const MatchSide& a, const BranchTerritories& territories_a,
                             const MatchSide& b, const BranchTerritories& territories_b,
                             int threads) {
  auto made = std::make_unique<Implementation>(
      Implementation{a, b, territories_a, threads, branches(a.skeleton), branches(b.skeleton), {}});
  const auto faces = faces_of_branches(territories_b.branch_of_face, made->of_b.size());
  made->territories.resize(faces.size());
  parallel_for(faces.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      made->territories[k] = std::make_unique<const TerritorySurface>(b.surface, faces[k]);
    }
  });
  implementation_ = std::move(made);
}
VertexPairing::~VertexPairing() = default;

VertexPairs VertexPairing::pair(const std::vector<BranchPair>& branch_pairs,
                                const NodeMotions& motions,
                                const std::vector<int>& vertices_of_a) const {
  const Implementation& made = *implementation_;
  const Surface& surface = made.a.surface;
  const Eigen::VectorXi& branch_of_vertex = made.territories_a.branch_of_vertex;
  std::vector<std::vector<int>> vertices(made.of_a.size());
  for (const int vertex : vertices_of_a) {
    if (branch_of_vertex[vertex] >= 0) vertices[idx(branch_of_vertex[vertex])].push_back(vertex);
  }
  VertexPairs result{Eigen::VectorXi::Constant(surface.positions.rows(), -1),
                     Eigen::VectorXd::Zero(surface.positions.rows())};
  parallel_for(branch_pairs.size(), 1, made.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const BranchPair& pair = branch_pairs[k];
      const Branch& one = made.of_a[idx(pair.a)];
      const Branch& other = made.of_b[idx(pair.b)];
      const BranchCurve from = branch_curve(made.a.skeleton, one);
      const BranchCurve to = branch_curve(made.b.skeleton, other);
      const BranchTransfer transfer(
          from, to, laying_of({made.a, one, from}, {made.b, other, to}, pair.reversed, motions));
      const auto places = places_of(one);
      for (const int vertex : vertices[idx(pair.a)]) {
        const Eigen::Vector3d at = surface.positions.row(vertex);
        const int node = made.a.skeleton.node_of_vertex[vertex];
        const double s = nearest_length(transfer.from(), places.at(node), at);
        const Eigen::Vector3d there = transfer(at, s, motions.of_node[idx(node)]);
        const TerritorySurface::Nearest found = made.territories[idx(pair.b)]->nearest(there);
        result.partner[vertex] = found.vertex;
        result.distance[vertex] = found.distance;
      }
    }
  });
  return result;
}

}  // namespace curveskel
