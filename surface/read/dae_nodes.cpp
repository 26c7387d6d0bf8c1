#include "surface/read/dae_nodes.hpp"

#include <cstddef>
#include <numbers>
#include <string>

namespace curveskel {
namespace {

/// x right, y up, -z ahead: what <lookat> turns towards its point of interest.
Eigen::Affine3d looking(const std::vector<double>& numbers) {
  const Eigen::Vector3d eye(numbers[0], numbers[1], numbers[2]);
  const Eigen::Vector3d interest(numbers[3], numbers[4], numbers[5]);
  const Eigen::Vector3d up(numbers[6], numbers[7], numbers[8]);
  const Eigen::Vector3d back = (eye - interest).normalized();
  const Eigen::Vector3d right = up.cross(back).normalized();
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  result.linear() << right, back.cross(right), back;
  result.translation() = eye;
  return result;
}

/// <visual_scene>, or nullptr.
const XmlElement* shown_scene(const DaeDocument& document) {
  const XmlElement* scene = document.root().child("scene");
  const XmlElement* instance = scene == nullptr ? nullptr : scene->child("instance_visual_scene");
  if (instance != nullptr) return &document.referred(*instance, "url");
  const XmlElement* library = document.root().child("library_visual_scenes");
  return library == nullptr ? nullptr : library->child("visual_scene");
}

/// The product of a node's transformations in their order.
Eigen::Affine3d transform(const DaeDocument& document, const XmlElement& node,
                          const MovedNumbers& moved) {
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  for (const XmlElement& child : node.children) {
    const auto numbers = [&](std::size_t count) {
      const auto found = moved.find(&child);
      std::vector<double> values = found == moved.end() ? document.numbers(child) : found->second;
      if (values.size() != count) {
        document.fail(child, std::to_string(values.size()) + " numbers in <" + child.name + ">",
                      std::to_string(count));
      }
      return values;
    };
    if (child.name == "matrix") {
      frame = frame * document.matrix(child, numbers(16).data());
    } else if (child.name == "translate") {
      frame.translate(Eigen::Vector3d(numbers(3).data()));
    } else if (child.name == "scale") {
      frame.scale(Eigen::Vector3d(numbers(3).data()));
    } else if (child.name == "rotate") {
      const std::vector<double> turn = numbers(4);
      const Eigen::Vector3d axis(turn.data());
      if (axis.norm() == 0) continue;
      frame.rotate(Eigen::AngleAxisd(turn[3] * std::numbers::pi / 180, axis.normalized()));
    } else if (child.name == "lookat") {
      frame = frame * looking(numbers(9));
    } else if (child.name == "skew") {
      document.fail(child, "<skew>", "a <matrix> instead");
    }
  }
  if (!frame.matrix().allFinite()) document.fail(node, "a transform of no numbers", "numbers");
  return frame;
}

}  // namespace

std::vector<DaeNode> dae_nodes(const DaeDocument& document, const Monitor& monitor,
                               const MovedNumbers& moved) {
  constexpr std::size_t most_nodes = 1000000;  // instances of nodes may refer in circles
  std::vector<DaeNode> placed;
  const XmlElement* scene = shown_scene(document);
  if (scene == nullptr) return placed;
  std::vector<DaeNode> open{{scene, Eigen::Affine3d::Identity(), -1}};
  while (!open.empty()) {
    monitor.report("read", 0.3);
    DaeNode node = open.back();
    open.pop_back();
    node.frame = node.frame * transform(document, *node.element, moved);
    const auto number = static_cast<int>(placed.size());
    placed.push_back(node);
    if (placed.size() + open.size() > most_nodes) {
      document.fail(*node.element,
                    "more than " + std::to_string(most_nodes) + " nodes in the scene",
                    "fewer, and no node in itself");
    }
    for (std::size_t i = node.element->children.size(); i-- > 0;) {
      const XmlElement& child = node.element->children[i];
      if (child.name == "node") open.push_back({&child, node.frame, number});
      if (child.name == "instance_node") {
        open.push_back({&document.referred(child, "url"), node.frame, number});
      }
    }
  }
  return placed;
}

}  // namespace curveskel
