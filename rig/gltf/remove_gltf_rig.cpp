#include "rig/gltf/remove_gltf_rig.hpp"

#include <algorithm>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/gltf/gltf_node_numbers.hpp"

namespace curveskel {
namespace {

/// Which nodes may go.
class DeadNodes {
 public:
  DeadNodes(const OrderedJson& file, const std::vector<bool>& kept_skins)
      : file_(file),
        count_(file.at("nodes").size()),
        parents_(count_, -1),
        is_joint_(count_, false),
        holds_(count_, false),
        seen_(count_, false),
        dead_(count_, false) {
    for (std::size_t node = 0; node < count_; ++node) {
      for (const std::size_t child : children_of(node)) {
        parents_.at(child) = static_cast<int>(node);
      }
    }
    find_joints(kept_skins);
    for (std::size_t node = 0; node < count_; ++node) {
      const OrderedJson& one = file.at("nodes")[node];
      if (one.contains("mesh") || one.contains("camera") || one.contains("extensions")) hold(node);
    }
    for (std::size_t node = 0; node < count_; ++node) {
      if (is_joint_[node]) kill_below(node);
    }
    kill_emptied();
  }

  [[nodiscard]] bool operator[](std::size_t node) const { return dead_[node]; }

  /// The one node that stays and had children that go; -1: there is none, or several.
  [[nodiscard]] int holder() const {
    int found = -1;
    for (std::size_t node = 0; node < count_; ++node) {
      const int parent = parents_[node];
      if (!dead_[node] || (parent >= 0 && dead_[idx(parent)])) continue;
      if (parent < 0 || (found >= 0 && found != parent)) return -1;
      found = parent;
    }
    return found;
  }

  [[nodiscard]] int joints() const {
    int count = 0;
    for (std::size_t node = 0; node < count_; ++node) count += dead_[node] && is_joint_[node];
    return count;
  }

 private:
  [[nodiscard]] std::vector<std::size_t> children_of(std::size_t node) const {
    return file_.at("nodes")[node].value("children", std::vector<std::size_t>{});
  }

  void find_joints(const std::vector<bool>& kept_skins) {
    for (std::size_t skin = 0; skin < kept_skins.size(); ++skin) {
      for (const OrderedJson& joint : file_.at("skins")[skin].at("joints")) {
        const auto node = joint.get<std::size_t>();
        if (kept_skins[skin]) {
          hold(node);
        } else {
          is_joint_.at(node) = true;
        }
      }
    }
  }

  /// The node and all above it stay.
  void hold(std::size_t node) {
    for (int n = static_cast<int>(node); n >= 0 && !holds_.at(idx(n)); n = parents_[idx(n)]) {
      holds_[idx(n)] = true;
    }
  }

  void kill_below(std::size_t node) {
    std::vector<std::size_t> open{node};
    while (!open.empty()) {
      const std::size_t next = open.back();
      open.pop_back();
      if (seen_.at(next)) continue;
      seen_[next] = true;
      if (!holds_[next]) dead_[next] = true;
      for (const std::size_t child : children_of(next)) open.push_back(child);
    }
  }

  /// Nodes all of whose children are gone.
  void kill_emptied() {
    for (std::size_t node = 0; node < count_; ++node) {
      if (!dead_[node]) continue;
      for (int n = parents_[node]; n >= 0 && !dead_[idx(n)] && !holds_[idx(n)];
           n = parents_[idx(n)]) {
        const std::vector<std::size_t> children = children_of(idx(n));
        const bool is_empty = std::all_of(children.begin(), children.end(),
                                          [&](std::size_t child) { return dead_[child]; });
        if (!is_empty) break;
        dead_[idx(n)] = true;
      }
    }
  }

  const OrderedJson& file_;
  std::size_t count_;
  std::vector<int> parents_;
  std::vector<bool> is_joint_;  // of a skin that goes
  std::vector<bool> holds_;     // something that stays
  std::vector<bool> seen_;      // at or below a joint
  std::vector<bool> dead_;
};

/// Those of meshes in other scenes.
std::vector<bool> kept_skins(const OrderedJson& file, const std::vector<bool>& shown) {
  std::vector<bool> kept(file.value("skins", OrderedJson::array()).size(), false);
  for (std::size_t node = 0; node < shown.size(); ++node) {
    const OrderedJson& one = file.at("nodes")[node];
    if (one.contains("skin") && !shown[node]) kept.at(one["skin"].get<std::size_t>()) = true;
  }
  return kept;
}

void remove_skins(OrderedJson& file, const std::vector<bool>& shown,
                  const std::vector<bool>& kept) {
  std::vector<int> new_skin;
  OrderedJson skins = OrderedJson::array();
  for (std::size_t skin = 0; skin < kept.size(); ++skin) {
    new_skin.push_back(kept[skin] ? static_cast<int>(skins.size()) : -1);
    if (kept[skin]) skins.push_back(std::move(file["skins"][skin]));
  }
  file["skins"] = std::move(skins);
  if (file["skins"].empty()) file.erase("skins");
  for (std::size_t node = 0; node < shown.size(); ++node) {
    OrderedJson& one = file["nodes"][node];
    if (!one.contains("skin")) continue;
    if (shown[node]) {
      one.erase("skin");
    } else {
      one["skin"] = new_skin.at(one["skin"].get<std::size_t>());
    }
  }
}

}  // namespace

RemovedRig remove_gltf_rig(GltfDocument& document, const std::vector<bool>& shown,
                           const FileBytes& file) {
  RemovedRig removed;
  const std::vector<bool> kept = kept_skins(document.json, shown);
  if (kept.empty()) {
    for (std::size_t node = 0; node < shown.size(); ++node) {
      removed.new_node.push_back(static_cast<int>(node));
    }
    return removed;
  }
  const DeadNodes dead(document.json, kept);
  int stay = 0;
  for (std::size_t node = 0; node < shown.size(); ++node) {
    removed.new_node.push_back(dead[node] ? -1 : stay);
    stay += dead[node] ? 0 : 1;
  }
  removed.joints = dead.joints();
  removed.holder = dead.holder();
  if (idx(stay) < shown.size()) refuse_node_numbers_in_extensions(document, file);
  remove_skins(document.json, shown, kept);
  removed.channels = renumber_nodes(document, removed.new_node);
  return removed;
}

}  // namespace curveskel
