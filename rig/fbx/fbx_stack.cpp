#include "rig/fbx/fbx_stack.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace curveskel {
namespace {

using Eigen::Vector3d;

constexpr double all_of_a_layer = 100;  // percent

Eigen::Quaterniond turn_of(const Vector3d& degrees, std::int64_t order) {
  return Eigen::Quaterniond(fbx_rotation(degrees, order));
}

/// A share of the way from no scaling to this one; that of a mirror is without sense.
Vector3d powers(const Vector3d& factors, double share) {
  return factors.unaryExpr([&](double one) { return std::pow(std::abs(one), share); });
}

Vector3d numbers_at(const std::array<FbxTimedNumber, 3>& numbers, double seconds) {
  return {numbers[0].at(seconds), numbers[1].at(seconds), numbers[2].at(seconds)};
}

}  // namespace

void FbxMotion::add_seconds(std::vector<double>& seconds) const {
  const auto take = [&](const FbxTimedNumber& number) {
    if (!number.curve) return;
    const std::vector<double> own = number.curve->seconds();
    seconds.insert(seconds.end(), own.begin(), own.end());
  };
  for (const Level& level : levels_) {
    for (const FbxTimedNumber& number : level.numbers) take(number);
    if (level.rules) take(level.rules->percent);
  }
}

bool FbxMotion::bends() const {
  return std::ranges::any_of(levels_, [](const Level& level) {
    const bool is_faded = level.rules && level.rules->percent.curve;
    return is_faded || std::ranges::any_of(level.numbers, [](const FbxTimedNumber& number) {
             return number.curve && number.curve->bends();
           });
  });
}

Vector3d FbxMotion::at(double seconds) const {
  Vector3d value = rest_;
  for (const Level& level : levels_) {
    const Vector3d own = numbers_at(level.numbers, seconds);
    value = level.rules ? upon(value, own, *level.rules, seconds) : own;
  }
  return value;
}

Vector3d FbxMotion::upon(const Vector3d& below, const Vector3d& above, const FbxLayerRules& rules,
                         double seconds) const {
  if (rules.blend == FbxLayerRules::Blend::replace) return above;
  const bool adds = rules.blend == FbxLayerRules::Blend::add;
  const double share = std::clamp(rules.percent.at(seconds) / all_of_a_layer, 0.0, 1.0);
  if (property_.kind == FbxAnimatedProperty::Kind::angles && rules.joins_turns) {
    const Eigen::Quaterniond from = turn_of(below, property_.order);
    const Eigen::Quaterniond to = turn_of(above, property_.order);
    const Eigen::Quaterniond turn =
        adds ? from * Eigen::Quaterniond::Identity().slerp(share, to) : from.slerp(share, to);
    return fbx_angles(turn.toRotationMatrix(), property_.order);
  }
  if (property_.kind == FbxAnimatedProperty::Kind::factors && rules.joins_factors && share < 1) {
    const Vector3d part = powers(above, share);
    return adds ? below.cwiseProduct(part) : powers(below, 1 - share).cwiseProduct(part);
  }
  if (property_.kind == FbxAnimatedProperty::Kind::factors && rules.joins_factors) {
    return adds ? below.cwiseProduct(above) : above;
  }
  return adds ? Vector3d(below + share * above) : Vector3d((1 - share) * below + share * above);
}

FbxStack::FbxStack(const FileBytes& file, const FbxScene& scene, const FbxRecord& stack)
    : file_(file), scene_(scene) {
  const auto layers = scene.below(stack, "AnimationLayer");
  const bool has_solo =
      std::ranges::any_of(layers, [this](const FbxRecord* layer) { return flag(*layer, "Solo"); });
  for (const FbxRecord* layer : layers) {
    if (flag(*layer, "Mute") || (has_solo && !flag(*layer, "Solo"))) continue;
    const auto nodes = scene.below(*layer, "AnimationCurveNode");
    layers_.push_back({layer == layers.front(), rules_of(*layer), {nodes.begin(), nodes.end()}});
  }
}

FbxLayerRules FbxStack::rules_of(const FbxRecord& layer) const {
  const auto given = [&](std::string_view name) -> std::int64_t {
    const FbxRecord* property = scene_.property(layer, name);
    return property == nullptr ? 0 : property->integer(first_property_value, 0);
  };
  FbxLayerRules rules;
  if (given("BlendMode") == 1) rules.blend = FbxLayerRules::Blend::replace;
  if (given("BlendMode") == 2) rules.blend = FbxLayerRules::Blend::mix;
  rules.joins_turns = given("RotationAccumulationMode") == 0;
  rules.joins_factors = given("ScaleAccumulationMode") == 0;
  if (const FbxRecord* weight = scene_.property(layer, "Weight")) {
    rules.percent.rest = weight->number(first_property_value, all_of_a_layer);
  }
  if (const FbxRecord* node = scene_.at_property(layer, "Weight", "AnimationCurveNode")) {
    rules.percent = number(*node, "d|Weight", rules.percent.rest);
  }
  return rules;
}

bool FbxStack::flag(const FbxRecord& layer, std::string_view name) const {
  const FbxRecord* property = scene_.property(layer, name);
  return property != nullptr && property->integer(first_property_value, 0) != 0;
}

FbxTimedNumber FbxStack::number(const FbxRecord& curve_node, std::string_view axis,
                                double otherwise) const {
  FbxTimedNumber number{std::nullopt, otherwise};
  if (const FbxRecord* given = fbx_property(&curve_node, axis)) {
    number.rest = given->number(first_property_value, otherwise);
  }
  const FbxRecord* curve = scene_.at_property(curve_node, axis, "AnimationCurve");
  if (curve == nullptr) return number;
  FbxCurve read(file_, *curve);
  if (!read.empty()) number.curve = std::move(read);
  return number;
}

FbxMotion FbxStack::motion(const FbxRecord& object, const FbxAnimatedProperty& property,
                           const Vector3d& rest) const {
  FbxMotion motion(property, rest);
  const auto moving = scene_.all_at_property(object, property.name, "AnimationCurveNode");
  if (moving.empty()) return motion;
  for (const Layer& layer : layers_) {
    const auto is_in_layer = [&](const FbxRecord* one) { return layer.curve_nodes.contains(one); };
    const auto node = std::ranges::find_if(moving, is_in_layer);
    if (node == moving.end()) continue;
    const bool adds = !layer.is_bottom && layer.rules.blend == FbxLayerRules::Blend::add;
    const double none = property.kind == FbxAnimatedProperty::Kind::factors ? 1 : 0;
    std::array<FbxTimedNumber, 3> numbers;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double own = adds ? none : rest[static_cast<Eigen::Index>(axis)];
      numbers[axis].rest = own;
      if (!property.axes[axis].empty()) numbers[axis] = number(**node, property.axes[axis], own);
    }
    motion.add(layer.is_bottom ? std::nullopt : std::optional(layer.rules), std::move(numbers));
  }
  return motion;
}

}  // namespace curveskel
