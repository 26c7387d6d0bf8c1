#include "rig/usd/usd_skeletons.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <optional>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/io/rig_formats.hpp"
#include "rig/usd/usd_names.hpp"
#include "surface/read/gltf_numbers.hpp"

namespace curveskel {
namespace {

using Eigen::Affine3d;

constexpr double single_rounding = 1e-5;  // of frames whose inverse a file has in single precision

class SkeletonFinder {
 public:
  SkeletonFinder(const FileBytes& file, const tinygltf::Model& model, const GltfScene& scene,
                 const std::set<int>& moved)
      : file_(file), model_(model), scene_(scene) {
    found_.of_skin.assign(model.skins.size(), 0);
    found_.placed.assign(model.skins.size(), Affine3d::Identity());
    mark_joints(moved);
    name_joints();
  }

  UsdSkeletons find() {
    for (const int node : scene_.nodes) {
      const tinygltf::Node& given = model_.nodes[idx(node)];
      if (given.mesh >= 0 && given.skin >= 0) take(given.skin);
    }
    if (joint_names_.empty()) return std::move(found_);
    if (bound_.empty()) bound_.emplace_back();
    UsdNames names;
    for (std::size_t k = 0; k < bound_.size(); ++k) {
      found_.all.push_back(skeleton_of(k));
      found_.all.back().name = names.free("Skeleton", "");
    }
    return std::move(found_);
  }

 private:
  using Frames = std::map<int, Affine3d>;  // by node

  [[nodiscard]] const Affine3d& frame(int node) const { return scene_.frames[idx(node)]; }

  void mark_joints(const std::set<int>& moved) {
    found_.is_joint.assign(model_.nodes.size(), false);
    std::set<int> of_skins;
    for (const tinygltf::Skin& skin : model_.skins) {
      of_skins.insert(skin.joints.begin(), skin.joints.end());
    }
    for (const int node : scene_.nodes) {
      const tinygltf::Node& given = model_.nodes[idx(node)];
      const int parent = scene_.parents[idx(node)];
      const bool hangs = parent >= 0 && found_.is_joint[idx(parent)];
      const bool only_holds =
          given.mesh >= 0 && given.children.empty() && (given.skin >= 0 || !moved.contains(node));
      found_.is_joint[idx(node)] = of_skins.contains(node) || (hangs && !only_holds);
    }
  }

  /// As `read_rig` does.
  void name_joints() {
    std::vector<std::string> names;
    for (const int node : scene_.nodes) {
      if (found_.is_joint[idx(node)]) names.push_back(model_.nodes[idx(node)].name);
    }
    name_nameless(names);
    auto name = names.begin();
    for (const int node : scene_.nodes) {
      if (!found_.is_joint[idx(node)]) continue;
      joint_names_[node] = *name++;
      reach_ = std::max(reach_, frame(node).translation().norm());
    }
  }

  [[nodiscard]] std::vector<Affine3d> inverse_binds(const tinygltf::Skin& skin) const {
    std::vector<Affine3d> frames(skin.joints.size(), Affine3d::Identity());
    if (skin.inverseBindMatrices < 0) return frames;
    const GltfNumbers numbers =
        gltf_numbers(file_, model_, skin.inverseBindMatrices, 16, "inverse bind matrices");
    for (std::size_t joint = 0; joint < std::min(frames.size(), numbers.rows()); ++joint) {
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
          frames[joint].matrix()(row, column) = numbers.at(joint, idx(4 * column + row));
        }
      }
    }
    return frames;
  }

  void take(int number) {
    if (!taken_.insert(number).second) return;
    const tinygltf::Skin& skin = gltf_element(file_, model_.skins, number, "skin");
    const std::vector<Affine3d> inverses = inverse_binds(skin);
    for (std::size_t k = 0; k <= bound_.size(); ++k) {
      if (k == bound_.size()) bound_.emplace_back();
      const auto placed = placement(skin, inverses, bound_[k]);
      if (!placed) continue;
      for (std::size_t joint = 0; joint < inverses.size(); ++joint) {
        const Affine3d bound = *placed * inverses[joint].inverse();
        const bool is_frame = bound.matrix().allFinite();
        bound_[k].try_emplace(skin.joints[joint], is_frame ? bound : frame(skin.joints[joint]));
      }
      found_.of_skin[idx(number)] = k;
      found_.placed[idx(number)] = *placed;
      return;
    }
  }

  /// Into the scene, so that all joints that are known are bound where they are known to be.
  [[nodiscard]] std::optional<Affine3d> placement(const tinygltf::Skin& skin,
                                                  const std::vector<Affine3d>& inverses,
                                                  const Frames& known) const {
    std::optional<Affine3d> placed;
    for (std::size_t joint = 0; joint < inverses.size(); ++joint) {
      const auto same = known.find(skin.joints[joint]);
      if (same == known.end()) continue;
      const Affine3d move = same->second * inverses[joint];
      if (!placed) placed = is_like(move, Affine3d::Identity()) ? Affine3d::Identity() : move;
      if (!is_like(move, *placed)) return std::nullopt;
    }
    if (placed || inverses.empty()) return placed ? placed : Affine3d::Identity();
    const Affine3d move = frame(skin.joints.front()) * inverses.front();
    return is_like(move, Affine3d::Identity()) ? Affine3d::Identity() : move;
  }

  [[nodiscard]] bool is_like(const Affine3d& one, const Affine3d& other) const {
    return (one.linear() - other.linear()).norm() <= single_rounding * other.linear().norm() &&
           (one.translation() - other.translation()).norm() <= single_rounding * reach_;
  }

  /// The first has all joints, each further one those of its skins and what these hang from.
  [[nodiscard]] std::set<int> joints_of(std::size_t number) const {
    std::set<int> joints;
    if (number == 0) {
      for (const auto& [node, name] : joint_names_) joints.insert(node);
      return joints;
    }
    for (const auto& [joint, bound] : bound_[number]) {
      for (int node = joint; node >= 0; node = scene_.parents[idx(node)]) {
        if (joint_names_.contains(node)) joints.insert(node);
      }
    }
    return joints;
  }

  [[nodiscard]] UsdSkeleton skeleton_of(std::size_t number) const {
    const std::set<int> joints = joints_of(number);
    UsdSkeleton made;
    UsdNames names;
    for (const int node : scene_.nodes) {
      if (!joints.contains(node)) continue;
      std::vector<int> chain{node};
      int above = scene_.parents[idx(node)];
      for (; above >= 0 && !joints.contains(above); above = scene_.parents[idx(above)]) {
        chain.push_back(above);
      }
      std::ranges::reverse(chain);
      const int parent = above < 0 ? -1 : static_cast<int>(made.number_of_node.at(above));
      Affine3d rest = Affine3d::Identity();
      for (const int part : chain) rest = rest * frame_of(model_.nodes[idx(part)]);
      const std::string& name = joint_names_.at(node);
      const std::string path = names.free(name, "joint");
      const auto bound = bound_[number].find(node);
      made.number_of_node[node] = made.joints.size();
      made.joints.push_back(node);
      made.above.push_back(parent);
      made.paths.push_back(parent < 0 ? path : made.paths[idx(parent)] + "/" + path);
      made.names.push_back(name);
      made.bound.push_back(bound != bound_[number].end() ? bound->second
                           : parent < 0                  ? rest
                                                         : made.bound[idx(parent)] * rest);
      made.rest.push_back(rest);
      made.chains.push_back(std::move(chain));
    }
    return made;
  }

  const FileBytes& file_;
  const tinygltf::Model& model_;
  const GltfScene& scene_;
  std::map<int, std::string> joint_names_;  // by node
  double reach_ = 0;                        // of joints from the origin
  std::set<int> taken_;                     // skins
  std::vector<Frames> bound_;               // by skeleton
  UsdSkeletons found_;
};

}  // namespace

Affine3d frame_of(const tinygltf::Node& node) {
  Affine3d frame = Affine3d::Identity();
  if (node.matrix.size() == 16) {
    frame.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    return frame;
  }
  if (node.translation.size() == 3) frame.translate(Eigen::Vector3d(node.translation.data()));
  if (node.rotation.size() == 4) {
    const Eigen::Vector4d turn(node.rotation.data());
    if (turn.norm() > 0) frame.rotate(Eigen::Quaterniond(turn).normalized());
  }
  if (node.scale.size() == 3) frame.scale(Eigen::Vector3d(node.scale.data()));
  return frame;
}

UsdSkeletons usd_skeletons(const FileBytes& file, const tinygltf::Model& model,
                           const GltfScene& scene, const std::set<int>& moved) {
  return SkeletonFinder(file, model, scene, moved).find();
}

void write_usd_skeleton(UsdText& text, const UsdSkeleton& skeleton) {
  text.words("uniform token[] joints", skeleton.paths);
  text.words("uniform token[] jointNames", skeleton.names);
  text.matrices("uniform matrix4d[] bindTransforms", skeleton.bound);
  text.matrices("uniform matrix4d[] restTransforms", skeleton.rest);
}

UsdWeights usd_weights(const WholeMesh& mesh, const std::vector<int>& numbers) {
  using Row = std::vector<std::pair<double, std::int32_t>>;
  std::vector<Row> rows(mesh.places.size() / 3);
  for (std::size_t joint = 0; joint < mesh.moved.size(); ++joint) {
    if (numbers[joint] < 0) continue;
    for (const auto& [vertex, weight] : mesh.moved[joint]) {
      Row& row = rows[idx(vertex)];
      const auto same = std::ranges::find(row, numbers[joint], &Row::value_type::second);
      if (same != row.end()) {
        same->first += weight;
      } else {
        row.emplace_back(weight, numbers[joint]);
      }
    }
  }
  UsdWeights made;
  const auto first = std::ranges::find_if(numbers, [](int number) { return number >= 0; });
  for (std::size_t vertex = 0; vertex < rows.size(); ++vertex) {
    Row& row = rows[vertex];
    if (row.empty()) {
      const int named = mesh.first_joint.empty() ? -1 : mesh.first_joint[vertex];
      const int number = named >= 0 && numbers[idx(named)] >= 0 ? numbers[idx(named)]
                         : first != numbers.end()               ? *first
                                                                : 0;
      row.emplace_back(1.0, number);
    }
    std::ranges::stable_sort(row, std::ranges::greater(), &Row::value_type::first);
    made.width = std::max(made.width, row.size());
  }
  for (const Row& row : rows) {
    double sum = 0;
    for (const auto& [weight, joint] : row) sum += weight;
    for (std::size_t k = 0; k < made.width; ++k) {
      made.joints.push_back(k < row.size() ? row[k].second : 0);
      made.weights.push_back(k < row.size() ? row[k].first / sum : 0);
    }
  }
  return made;
}

}  // namespace curveskel
