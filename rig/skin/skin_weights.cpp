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
#include "rig/skin/skin_sources.hpp"
#include "rig/skin/weight_pieces.hpp"
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

/// Solves for one component.
class SkinHeat {
 public:
  SkinHeat(const Component& part, const SkinSources& sources, const SkinOptions& options)
      : part_(part), options_(options), strength_(vertex_areas(part.surface)) {
    std::vector<Eigen::Triplet<double>> rates;
    rates.reserve(part.vertex_in_whole.size());
    joints_.reserve(part.vertex_in_whole.size());
    for (Eigen::Index v = 0; v < strength_.size(); ++v) {
      const int whole = part.vertex_in_whole[idx(v)];
      const double way = options.softness * sources.distances[whole];
      const double strength = strength_[v] / (way * way);
      strength_[v] = 0;
      for (SkinSources::Shares::InnerIterator it(sources.shares, whole); it; ++it) {
        rates.emplace_back(static_cast<int>(v), static_cast<int>(it.col()), strength * it.value());
        strength_[v] = strength;
        joints_.push_back(static_cast<int>(it.col()));
      }
    }
    std::sort(joints_.begin(), joints_.end());
    joints_.erase(std::unique(joints_.begin(), joints_.end()), joints_.end());
    rates_.resize(strength_.size(), sources.shares.cols());
    rates_.setFromTriplets(rates.begin(), rates.end());
  }

  /// report(share done) is called from this thread. Throws Cancelled on a stop.
  template <typename Report>
  void solve(std::vector<TopShares>& shares, int threads, const std::stop_token& stop,
             const Report& report) {
    const std::vector<int>& joints = joints_;
    if (joints.size() == 1) {
      for (const int vertex : part_.vertex_in_whole) {
        shares[idx(vertex)].add(joints.front(), 1, 1);
      }
      return;
    }
    SparseMatrix heat = -intrinsic_delaunay_laplacian(part_.surface);
    heat.diagonal() += strength_;
    factor_.factorize(heat, stop);
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
    const std::vector<int>& joints = joints_;
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
        Eigen::MatrixXd::Zero(strength_.size(), static_cast<Eigen::Index>(to - from));
    for (std::size_t k = from; k < to; ++k) {
      right.col(static_cast<Eigen::Index>(k - from)) = rates_.col(joints_[k]);
    }
    return right;
  }

  const Component& part_;
  const SkinOptions& options_;
  Eigen::VectorXd strength_;           // by vertex: area / (softness d)^2, 0 without a source
  Eigen::SparseMatrix<double> rates_;  // by vertex and joint, their rows of sum `strength_`
  std::vector<int> joints_;            // that occur, ascending
  CholeskyFactor factor_;
  std::vector<std::unique_ptr<CholeskyFactor::Workspace>> workspaces_;
};

/// All components, with the progress of all.
class SkinRun {
 public:
  SkinRun(Eigen::Index vertices, const SkinSources& sources, const SkinOptions& options,
          const Monitor& monitor)
      : sources_(sources), options_(options), monitor_(monitor), shares_(idx(vertices)) {}

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
    SkinHeat(part, sources_, options_)
        .solve(shares_, options_.threads, monitor_.stop,
               [&](double fraction) { report(fraction * static_cast<double>(size)); });
    done_ += size;
  }

  void solve_small(std::span<const Component* const> parts) {
    report(0);
    parallel_for(parts.size(), 1, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (const Component* part : parts.subspan(begin, end - begin)) {
        SkinHeat(*part, sources_, options_).solve(shares_, 1, monitor_.stop, [](double) {});
      }
    });
    for (const Component* part : parts) done_ += part->vertex_in_whole.size();
  }

  void report(double more) const {
    monitor_.report("weights",
                    (static_cast<double>(done_) + more) / static_cast<double>(shares_.size()));
  }

  const SkinSources& sources_;
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
                    const Eigen::VectorXi& joint_of_node, const std::vector<Bone>& bones,
                    int joints) {
  const auto is_joint = [&](int joint) { return joint >= 0 && joint < joints; };
  const auto refuse = [&](const std::string& found) {
    throw Error(Fault::input,
                "skin_weights: found " + found + ", needed a node for each vertex and one of " +
                    std::to_string(joints) + " joints for each node and each bone; see make_rig");
  };
  if (skeleton.node_of_vertex.size() != surface.positions.rows() ||
      !(skeleton.node_of_vertex.array() >= 0).all()) {
    refuse("a vertex without a node");
  }
  if (joint_of_node.size() != skeleton.nodes.rows() ||
      !std::all_of(joint_of_node.begin(), joint_of_node.end(), is_joint)) {
    refuse("a node without a joint");
  }
  if (!std::all_of(bones.begin(), bones.end(),
                   [&](const Bone& bone) { return is_joint(bone.joint); })) {
    refuse("a bone without a joint");
  }
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
                         const Eigen::VectorXi& joint_of_node, const std::vector<Bone>& bones,
                         int joints, const SkinOptions& options, const Monitor& monitor) {
  require_valid(options);
  require_closed_manifold(surface, "skin_weights", options.threads);
  require_sound(skeleton, "skin_weights");
  require_joints(surface, skeleton, joint_of_node, bones, joints);
  const std::vector<Component> parts = split_components(surface, topology(surface));
  SkinSources sources = sources_of_curve(surface, skeleton, joint_of_node, joints);
  if (!bones.empty()) {
    monitor.report("weights", 0);
    sources =
        sources_of_bones(surface, skeleton, parts, bones, sources, options.threads, monitor.stop);
  }
  SkinRun run(surface.positions.rows(), sources, options, monitor);
  return without_islands(surface, matrix_of(run.solve(parts), joints, options.least_weight),
                         idx(options.most_joints), options.least_weight);
}

}  // namespace curveskel
