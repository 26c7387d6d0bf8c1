#include <curveskel/advanced/skin_weights.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/laplacian.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/topology.hpp>
#include "base/option_ranges.hpp"
#include "base/parallel.hpp"
#include "contraction/solvers/cholesky_factor.hpp"
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {
namespace {

constexpr std::size_t room = 8;  // joints a vertex

/// The joints with the largest shares in a vertex, largest first; of equal ones the first added.
class TopShares {
 public:
  void add(int joint, double weight, std::size_t most) {
    std::size_t place = count_;
    while (place > 0 && weights_[place - 1] < weight) --place;
    if (place >= most) return;
    count_ = std::min(count_ + 1, most);
    for (std::size_t k = count_ - 1; k > place; --k) {
      joints_[k] = joints_[k - 1];
      weights_[k] = weights_[k - 1];
    }
    joints_[place] = joint;
    weights_[place] = weight;
  }

  /// As a row of sum 1, joints ascending, without those whose share in it is less than `least`; at
  /// least the largest stays, as it has an eighth or more.
  [[nodiscard]] std::vector<std::pair<int, double>> row(double least) const {
    const double all = std::accumulate(weights_.begin(),
                                       weights_.begin() + static_cast<std::ptrdiff_t>(count_), 0.0);
    double sum = 0;
    std::vector<std::pair<int, double>> result;
    for (std::size_t k = 0; k < count_ && weights_[k] >= least * all; ++k) {
      result.emplace_back(joints_[k], weights_[k]);
      sum += weights_[k];
    }
    for (auto& [joint, weight] : result) weight /= sum;
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  std::array<int, room> joints_{};
  std::array<double, room> weights_{};
  std::size_t count_ = 0;
};

/// Start values of vertices of the whole surface.
struct SkinBeginning {
  Eigen::VectorXi joint;     ///< that moves the vertex' node
  Eigen::VectorXd distance;  ///< to that node, in model units; > 0
};

SkinBeginning beginning_of(const Surface& surface, const CurveSkeleton& skeleton,
                           const Eigen::VectorXi& joint_of_node) {
  const Eigen::Index count = surface.positions.rows();
  const double least_distance = 1e-3 * bounding_box_diagonal(surface.positions);
  SkinBeginning beginning{Eigen::VectorXi(count), Eigen::VectorXd(count)};
  for (Eigen::Index v = 0; v < count; ++v) {
    const int node = skeleton.node_of_vertex[v];
    beginning.joint[v] = joint_of_node[node];
    beginning.distance[v] =
        std::max((surface.positions.row(v) - skeleton.nodes.row(node)).norm(), least_distance);
  }
  return beginning;
}

/// The sources of heat, and their rates.
struct HeatSources {
  Eigen::VectorXi joint;     ///< by vertex
  Eigen::VectorXd strength;  ///< by vertex: area / (softness d)^2
  std::vector<int> joints;   ///< that occur, ascending
};

/// Solves for one component.
class SkinHeat {
 public:
  SkinHeat(const Component& part, const SkinBeginning& beginning, const SkinOptions& options)
      : part_(part), options_(options) {
    const Eigen::Index count = part.surface.positions.rows();
    sources_.joint.resize(count);
    sources_.strength = vertex_areas(part.surface);
    for (Eigen::Index v = 0; v < count; ++v) {
      const int whole = part.vertex_in_whole[idx(v)];
      sources_.joint[v] = beginning.joint[whole];
      const double way = options.softness * beginning.distance[whole];
      sources_.strength[v] /= way * way;
    }
    sources_.joints.assign(sources_.joint.begin(), sources_.joint.end());
    std::sort(sources_.joints.begin(), sources_.joints.end());
    sources_.joints.erase(std::unique(sources_.joints.begin(), sources_.joints.end()),
                          sources_.joints.end());
  }

  /// report(share done) is called from this thread.
  template <typename Report>
  void solve(std::vector<TopShares>& shares, int threads, const Report& report) {
    const std::vector<int>& joints = sources_.joints;
    if (joints.size() == 1) {
      for (const int vertex : part_.vertex_in_whole) {
        shares[idx(vertex)].add(joints.front(), 1, 1);
      }
      return;
    }
    SparseMatrix heat = -intrinsic_delaunay_laplacian(part_.surface);
    heat.diagonal() += sources_.strength;
    factor_.factorize(heat);
    const std::size_t workers = std::min(thread_count(threads), most_workers);
    while (workspaces_.size() < workers) {
      workspaces_.push_back(std::make_unique<CholeskyFactor::Workspace>());
    }
    for (std::size_t first = 0; first < joints.size(); first += workers * block) {
      report(static_cast<double>(first) / static_cast<double>(joints.size()));
      solve_blocks(first, workers, threads, shares);
    }
  }

 private:
  static constexpr std::size_t block = 4;  // right-hand sides at once
  static constexpr std::size_t most_workers = 8;
  static constexpr double negligible = 1e-9;

  void solve_blocks(std::size_t first, std::size_t workers, int threads,
                    std::vector<TopShares>& shares) {
    const std::vector<int>& joints = sources_.joints;
    const std::size_t blocks = std::min(workers, (joints.size() - first + block - 1) / block);
    std::vector<const double*> results(blocks);
    parallel_for(blocks, 1, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t from = first + k * block;
        const std::size_t to = std::min(from + block, joints.size());
        results[k] = factor_.solve(right_hand_sides(from, to), *workspaces_[k]).data();
      }
    });
    const auto count = part_.vertex_in_whole.size();
    parallel_for(count, 4096, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        TopShares& top = shares[idx(part_.vertex_in_whole[v])];
        for (std::size_t k = first; k < std::min(first + blocks * block, joints.size()); ++k) {
          const double weight = results[(k - first) / block][(k - first) % block * count + v];
          if (weight > negligible) top.add(joints[k], weight, idx(options_.most_joints));
        }
      }
    });
  }

  [[nodiscard]] Eigen::MatrixXd right_hand_sides(std::size_t from, std::size_t to) const {
    Eigen::MatrixXd right =
        Eigen::MatrixXd::Zero(sources_.joint.size(), static_cast<Eigen::Index>(to - from));
    for (Eigen::Index v = 0; v < sources_.joint.size(); ++v) {
      const auto place =
          std::lower_bound(sources_.joints.begin(), sources_.joints.end(), sources_.joint[v]) -
          sources_.joints.begin();
      if (idx(place) >= from && idx(place) < to) {
        right(v, place - static_cast<Eigen::Index>(from)) = sources_.strength[v];
      }
    }
    return right;
  }

  const Component& part_;
  const SkinOptions& options_;
  HeatSources sources_;
  CholeskyFactor factor_;
  std::vector<std::unique_ptr<CholeskyFactor::Workspace>> workspaces_;
};

/// All components, with the progress of all.
class SkinRun {
 public:
  SkinRun(Eigen::Index vertices, const SkinBeginning& beginning, const SkinOptions& options,
          const Monitor& monitor)
      : beginning_(beginning), options_(options), monitor_(monitor), shares_(idx(vertices)) {}

  /// Large ones use all cores one after the other, small ones a core each.
  const std::vector<TopShares>& solve(const std::vector<Component>& parts) {
    constexpr std::size_t large = 10000;  // vertices
    std::vector<const Component*> small_ones;
    for (const Component& part : parts) {
      if (part.vertex_in_whole.size() < large) {
        small_ones.push_back(&part);
      } else {
        solve_large(part);
      }
    }
    constexpr std::size_t at_once = 64;
    for (std::size_t first = 0; first < small_ones.size(); first += at_once) {
      solve_small(
          std::span(small_ones).subspan(first, std::min(at_once, small_ones.size() - first)));
    }
    return shares_;
  }

 private:
  void solve_large(const Component& part) {
    const std::size_t size = part.vertex_in_whole.size();
    SkinHeat(part, beginning_, options_).solve(shares_, options_.threads, [&](double fraction) {
      report(fraction * static_cast<double>(size));
    });
    done_ += size;
  }

  void solve_small(std::span<const Component* const> parts) {
    report(0);
    parallel_for(parts.size(), 1, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (const Component* part : parts.subspan(begin, end - begin)) {
        SkinHeat(*part, beginning_, options_).solve(shares_, 1, [](double /*fraction*/) {});
      }
    });
    for (const Component* part : parts) done_ += part->vertex_in_whole.size();
  }

  void report(double more) const {
    monitor_.report("weights",
                    (static_cast<double>(done_) + more) / static_cast<double>(shares_.size()));
  }

  const SkinBeginning& beginning_;
  const SkinOptions& options_;
  const Monitor& monitor_;
  std::vector<TopShares> shares_;
  std::size_t done_ = 0;  // vertices
};

SkinWeights matrix_of(const std::vector<TopShares>& shares, int joints, double least) {
  SkinWeights weights(static_cast<Eigen::Index>(shares.size()), joints);
  weights.reserve(Eigen::VectorXi::Constant(weights.rows(), 4));
  for (std::size_t v = 0; v < shares.size(); ++v) {
    for (const auto& [joint, weight] : shares[v].row(least)) {
      weights.insert(static_cast<Eigen::Index>(v), joint) = static_cast<float>(weight);
    }
  }
  weights.makeCompressed();
  return weights;
}

void require_joints(const Surface& surface, const CurveSkeleton& skeleton,
                    const Eigen::VectorXi& joint_of_node, int joints) {
  const bool every_vertex_has_a_node = skeleton.node_of_vertex.size() == surface.positions.rows() &&
                                       (skeleton.node_of_vertex.array() >= 0).all();
  const bool every_node_has_a_joint =
      joint_of_node.size() == skeleton.nodes.rows() &&
      (joint_of_node.array() >= 0 && joint_of_node.array() < joints).all();
  if (every_vertex_has_a_node && every_node_has_a_joint) return;
  throw Error(Fault::input,
              std::string("skin_weights: found a ") +
                  (every_vertex_has_a_node ? "node without a joint" : "vertex without a node") +
                  ", needed a node for each vertex and one of " + std::to_string(joints) +
                  " joints for each node; see make_rig");
}

}  // namespace

void require_valid(const SkinOptions& options) {
  constexpr OptionRange softness{0.001, 1000};
  constexpr OptionRange joints{1, static_cast<double>(room)};
  constexpr OptionRange weight{0, 0.1};
  const OptionCheck check("SkinOptions");
  check.number("softness", options.softness, softness);
  check.number("most_joints", options.most_joints, joints);
  check.number("least_weight", options.least_weight, weight);
  check.number("threads", options.threads, thread_range);
}

SkinWeights skin_weights(const Surface& surface, const CurveSkeleton& skeleton,
                         const Eigen::VectorXi& joint_of_node, int joints,
                         const SkinOptions& options, const Monitor& monitor) {
  require_valid(options);
  require_closed_manifold(surface, "skin_weights", options.threads);
  require_sound(skeleton, "skin_weights");
  require_joints(surface, skeleton, joint_of_node, joints);
  const SkinBeginning beginning = beginning_of(surface, skeleton, joint_of_node);
  const std::vector<Component> parts = split_components(surface, topology(surface));
  SkinRun run(surface.positions.rows(), beginning, options, monitor);
  return matrix_of(run.solve(parts), joints, options.least_weight);
}

}  // namespace curveskel
