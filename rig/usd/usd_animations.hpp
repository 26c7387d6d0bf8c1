// The animations of a glTF file as USD has them. Internal to rig/.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "rig/gltf/gltf_animations.hpp"
#include "rig/usd/usd_skeletons.hpp"
#include "rig/usd/usd_text.hpp"

namespace tinygltf {
class Model;
class Node;
}  // namespace tinygltf

namespace curveskel {

inline constexpr double usd_codes_a_second = 30;

/// A shape key of a node's mesh, and the weight that it has at rest.
struct UsdSlider {
  std::string token;
  int node = 0;
  std::size_t shape = 0;
  double rest = 0;
};

struct UsdSliders {
  std::vector<UsdSlider> all;
  std::map<std::string, std::size_t> number_of_token;
};

/// The tokens of a mesh's shapes, which are appended to `sliders`: one whose name another mesh has,
/// too, shares its token if it moves as that one in all animations.
[[nodiscard]] std::vector<std::string> usd_shape_tokens(
    const std::vector<UsdSlider>& shapes, const std::string& mesh,
    const std::vector<GltfAnimation>& animations, UsdSliders& sliders);

/// The first and the last time code.
struct UsdSpan {
  double first = 0;
  double last = 0;
  bool is_there = false;

  void take(const std::vector<double>& codes);
};

/// Joints and shapes that a SkelAnimation moves.
struct UsdMoved {
  const tinygltf::Model& model;
  const UsdSkeleton& skeleton;
  const std::vector<UsdSlider>& sliders;  ///< of meshes on it
};

/// A SkelAnimation `name` of all joints and shapes; false, and nothing is written, where the
/// animation moves none of them. `span` takes its time codes. O(joints times moments).
[[nodiscard]] bool write_usd_animation(UsdText& text, const std::string& name,
                                       const GltfAnimation& animation, const UsdMoved& moved,
                                       UsdSpan& span);

/// The same without times: shapes as they are at rest.
void write_usd_rest_shapes(UsdText& text, const std::string& name,
                           const std::vector<UsdSlider>& sliders);

/// The transform of a node that is no joint, over time where `motion` moves it; no lines where it
/// stays in its parent's frame.
[[nodiscard]] std::string usd_place(const tinygltf::Node& node, const GltfMotion* motion,
                                    std::size_t depth, UsdSpan& span);

}  // namespace curveskel
