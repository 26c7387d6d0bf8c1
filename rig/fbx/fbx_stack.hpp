// A clip of an FBX file: numbers of objects over time. Internal to rig/.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "rig/fbx/fbx_curve.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"

namespace curveskel {

/// A number's curve, or the number.
struct FbxTimedNumber {
  std::optional<FbxCurve> curve;
  double rest = 0;

  [[nodiscard]] double at(double seconds) const { return curve ? curve->at(seconds) : rest; }
};

/// How a layer goes upon those below it.
struct FbxLayerRules {
  enum class Blend { add, replace, mix };

  Blend blend = Blend::add;
  FbxTimedNumber percent{std::nullopt, 100};  ///< by how much it counts, unless it replaces
  bool joins_turns = true;                    ///< turns follow one another, else angles are summed
  bool joins_factors = true;                  ///< factors are multiplied, else summed
};

/// A property of up to three numbers that animations move.
struct FbxAnimatedProperty {
  enum class Kind { plain, angles, factors };

  std::string_view name;
  std::array<std::string_view, 3> axes;  ///< names of the curves; empty = no number
  Kind kind = Kind::plain;
  std::int64_t order = 0;  ///< of angles, as of `fbx_rotation`
};

/// The numbers of a property over time.
class FbxMotion {
 public:
  FbxMotion(const FbxAnimatedProperty& property, const Eigen::Vector3d& rest)
      : property_(property), rest_(rest) {}

  /// Upon those that are there; without rules in place of the rest.
  void add(std::optional<FbxLayerRules> rules, std::array<FbxTimedNumber, 3> numbers) {
    levels_.push_back({std::move(rules), std::move(numbers)});
  }

  [[nodiscard]] bool empty() const { return levels_.empty(); }
  /// Those of all keys, of those of weights, too.
  void add_seconds(std::vector<double>& seconds) const;
  /// True if lines between those seconds are not all that there is.
  [[nodiscard]] bool bends() const;
  [[nodiscard]] Eigen::Vector3d at(double seconds) const;

 private:
  struct Level {
    std::optional<FbxLayerRules> rules;
    std::array<FbxTimedNumber, 3> numbers;
  };

  [[nodiscard]] Eigen::Vector3d upon(const Eigen::Vector3d& below, const Eigen::Vector3d& above,
                                     const FbxLayerRules& rules, double seconds) const;

  FbxAnimatedProperty property_;
  Eigen::Vector3d rest_;
  std::vector<Level> levels_;
};

/// An "AnimationStack". Layers that are muted, or beside those that are solo, don't count.
class FbxStack {
 public:
  /// File and scene must outlive it. Throws Error(Fault::input) for curves without sense.
  FbxStack(const FileBytes& file, const FbxScene& scene, const FbxRecord& stack);

  /// Without levels where no layer moves it. Throws likewise.
  [[nodiscard]] FbxMotion motion(const FbxRecord& object, const FbxAnimatedProperty& property,
                                 const Eigen::Vector3d& rest) const;

 private:
  struct Layer {
    bool is_bottom;
    FbxLayerRules rules;
    std::unordered_set<const FbxRecord*> curve_nodes;
  };

  [[nodiscard]] FbxLayerRules rules_of(const FbxRecord& layer) const;
  [[nodiscard]] bool flag(const FbxRecord& layer, std::string_view name) const;
  [[nodiscard]] FbxTimedNumber number(const FbxRecord& curve_node, std::string_view axis,
                                      double otherwise) const;

  const FileBytes& file_;
  const FbxScene& scene_;
  std::vector<Layer> layers_;
};

}  // namespace curveskel
