#include "surface/read/fbx_scene.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <string>

namespace curveskel {
namespace {

/// The axes that turn one after the other; spheric ones as XYZ.
const std::array<int, 3>& axes_in(std::int64_t order) {
  static constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};
  const bool known = order >= 0 && order < std::int64_t{orders.size()};
  return orders[known ? static_cast<std::size_t>(order) : 0];
}

Eigen::Affine3d affine(const Eigen::Matrix3d& linear) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  result.linear() = linear;
  return result;
}

/// By kind of objects.
std::unordered_map<std::string_view, const FbxRecord*> defaults_in(const FbxRecord& root) {
  std::unordered_map<std::string_view, const FbxRecord*> result;
  const FbxRecord* definitions = root.child("Definitions");
  if (definitions == nullptr) return result;
  for (const FbxRecord& type : definitions->children) {
    const FbxRecord* given = type.child("PropertyTemplate");
    if (type.name == "ObjectType" && given != nullptr) result.emplace(type.text(0), given);
  }
  return result;
}

}  // namespace

Eigen::Matrix3d fbx_rotation(const Eigen::Vector3d& degrees, std::int64_t order) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
  for (const int axis : axes_in(order)) {
    const double angle = degrees[axis] * std::numbers::pi / 180;
    result = Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix() * result;
  }
  return result;
}

Eigen::Vector3d fbx_angles(const Eigen::Matrix3d& rotation, std::int64_t order) {
  const std::array<int, 3>& axes = axes_in(order);
  const Eigen::Vector3d angles = rotation.eulerAngles(axes[2], axes[1], axes[0]);
  Eigen::Vector3d degrees;
  for (int k = 0; k < 3; ++k) {
    degrees[axes[static_cast<std::size_t>(k)]] = angles[2 - k] * 180 / std::numbers::pi;
  }
  return degrees;
}

const FbxRecord* fbx_property(const FbxRecord* owner, std::string_view name) {
  const FbxRecord* properties = owner == nullptr ? nullptr : owner->child("Properties70");
  if (properties == nullptr) return nullptr;
  for (const FbxRecord& record : properties->children) {
    if (record.text(0) == name) return &record;
  }
  return nullptr;
}

std::string fbx_name(const FbxRecord& object) {
  const std::string_view text = object.text(1);
  const std::size_t mark = text.find('\0');
  if (mark != std::string_view::npos) return std::string(text.substr(0, mark));
  const std::size_t kind = text.find("::");
  return std::string(kind == std::string_view::npos ? text : text.substr(kind + 2));
}

bool is_fbx_joint(const FbxRecord& model) {
  const std::string_view kind = model.text(2);
  return kind == "LimbNode" || kind == "Limb" || kind == "Root";
}

FbxScene::FbxScene(const FileBytes& file, const FbxRecord& root)
    : file_(file), objects_(root.child("Objects")), defaults_(defaults_in(root)) {
  if (objects_ == nullptr) file.fail("no \"Objects\"", "a scene", fbx_remedy);
  for (const FbxRecord& object : objects_->children) by_id_.emplace(object.integer(0, -1), &object);
  if (const FbxRecord* connections = root.child("Connections")) connect(*connections);
  place_models();
}

void FbxScene::connect(const FbxRecord& connections) {
  for (const FbxRecord& one : connections.children) {
    const bool is_of_property = one.text(0) == "OP";
    if (one.text(0) != "OO" && !is_of_property) continue;
    const auto child = by_id_.find(one.integer(1, -1));
    const auto parent = by_id_.find(one.integer(2, -1));
    if (child == by_id_.end() || parent == by_id_.end()) continue;  // the root of all, or of others
    if (is_of_property) {
      at_property_[parent->second].push_back({one.text(3), child->second});
      continue;
    }
    below_[parent->second].push_back(child->second);
    if (child->second->name == "Model" && parent->second->name == "Model") {
      parent_of_.emplace(child->second, parent->second);
    }
  }
}

void FbxScene::place_models() {
  for (const FbxRecord* model : all("Model")) {
    std::vector<const FbxRecord*> chain;
    const FbxRecord* next = model;
    while (!frame_of_.contains(next)) {
      chain.push_back(next);
      const auto parent = parent_of_.find(next);
      if (parent == parent_of_.end()) break;
      next = parent->second;
      if (chain.size() > objects_->children.size()) {
        file_.fail("models that are parts of each other", "a tree of models", fbx_remedy);
      }
    }
    std::reverse(chain.begin(), chain.end());
    for (const auto* one : chain) {
      const auto parent = parent_of_.find(one);
      const Eigen::Affine3d outer =
          parent == parent_of_.end() ? Eigen::Affine3d::Identity() : frame_of_.at(parent->second);
      frame_of_.emplace(one, outer * local(*one, move(*one)));
    }
  }
}

const FbxRecord* FbxScene::parent(const FbxRecord& model) const {
  const auto found = parent_of_.find(&model);
  return found == parent_of_.end() ? nullptr : found->second;
}

std::vector<const FbxRecord*> FbxScene::all(std::string_view kind) const {
  std::vector<const FbxRecord*> result;
  for (const FbxRecord& object : objects_->children) {
    if (object.name == kind) result.push_back(&object);
  }
  return result;
}

std::vector<const FbxRecord*> FbxScene::below(const FbxRecord& object, std::string_view kind,
                                              std::string_view subclass) const {
  std::vector<const FbxRecord*> result;
  const auto found = below_.find(&object);
  if (found == below_.end()) return result;
  for (const FbxRecord* child : found->second) {
    if (child->name == kind && (subclass.empty() || child->text(2) == subclass)) {
      result.push_back(child);
    }
  }
  return result;
}

const FbxRecord* FbxScene::at_property(const FbxRecord& object, std::string_view property,
                                       std::string_view kind) const {
  const std::vector<const FbxRecord*> all = all_at_property(object, property, kind);
  return all.empty() ? nullptr : all.front();
}

std::vector<const FbxRecord*> FbxScene::all_at_property(const FbxRecord& object,
                                                        std::string_view property,
                                                        std::string_view kind) const {
  std::vector<const FbxRecord*> all;
  const auto found = at_property_.find(&object);
  if (found == at_property_.end()) return all;
  for (const AtProperty& one : found->second) {
    if (one.property == property && one.object->name == kind) all.push_back(one.object);
  }
  return all;
}

const FbxRecord* FbxScene::property(const FbxRecord& object, std::string_view name) const {
  if (const FbxRecord* own = fbx_property(&object, name)) return own;
  const auto defaults = defaults_.find(object.name);
  return defaults == defaults_.end() ? nullptr : fbx_property(defaults->second, name);
}

Eigen::Vector3d FbxScene::vector(const FbxRecord& model, std::string_view name,
                                 double otherwise) const {
  Eigen::Vector3d result = Eigen::Vector3d::Constant(otherwise);
  const FbxRecord* found = property(model, name);
  if (found == nullptr) return result;
  for (int k = 0; k < 3; ++k) {
    result[k] = found->number(first_property_value + static_cast<std::size_t>(k), otherwise);
  }
  return result;
}

FbxMove FbxScene::move(const FbxRecord& model) const {
  return {vector(model, "Lcl Translation"), vector(model, "Lcl Rotation"),
          vector(model, "Lcl Scaling", 1)};
}

bool FbxScene::has_active_rotation(const FbxRecord& model) const {
  const FbxRecord* active = property(model, "RotationActive");
  return active != nullptr && active->integer(first_property_value, 0) != 0;
}

std::int64_t FbxScene::rotation_order(const FbxRecord& model) const {
  const FbxRecord* order = has_active_rotation(model) ? property(model, "RotationOrder") : nullptr;
  return order == nullptr ? 0 : order->integer(first_property_value, 0);
}

/// T Roff Rp Rpre R Rpost^-1 Rp^-1 Soff Sp S Sp^-1. Rotations before and after count, and another
/// order than XYZ, only where RotationActive says so.
Eigen::Affine3d FbxScene::local(const FbxRecord& model, const FbxMove& move) const {
  Eigen::Matrix3d rotation = fbx_rotation(move.angles, rotation_order(model));
  if (has_active_rotation(model)) {
    rotation = fbx_rotation(vector(model, "PreRotation")) * rotation *
               fbx_rotation(vector(model, "PostRotation")).transpose();
  }
  const Eigen::Translation3d pivot(vector(model, "RotationPivot"));
  const Eigen::Translation3d scaling_pivot(vector(model, "ScalingPivot"));
  Eigen::Affine3d result = Eigen::Translation3d(move.shift + vector(model, "RotationOffset")) *
                           (pivot * affine(rotation) * pivot.inverse()) *
                           Eigen::Translation3d(vector(model, "ScalingOffset")) *
                           (scaling_pivot * Eigen::Scaling(move.scale) * scaling_pivot.inverse());
  if (!result.matrix().allFinite()) {
    file_.fail("a transform of no numbers in the model at byte " + std::to_string(model.position),
               "numbers", fbx_remedy);
  }
  return result;
}

Eigen::Affine3d FbxScene::geometric(const FbxRecord& model) const {
  return Eigen::Translation3d(vector(model, "GeometricTranslation")) *
         affine(fbx_rotation(vector(model, "GeometricRotation"))) *
         Eigen::Scaling(vector(model, "GeometricScaling", 1));
}

Eigen::Affine3d FbxScene::matrix(const FbxRecord& record) const {
  constexpr double negligible = 1e-6;  // that exporters leave in the last row
  const std::vector<double> numbers = fbx_numbers(file_, record);
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  if (numbers.size() == 16) result.matrix() = Eigen::Map<const Eigen::Matrix4d>(numbers.data());
  const bool is_affine =
      (result.matrix().row(3) - Eigen::RowVector4d::UnitW()).norm() <= negligible;
  if (numbers.size() != 16 || !is_affine || !result.matrix().allFinite()) {
    file_.fail("a matrix \"" + std::string(record.name) + "\" at byte " +
                   std::to_string(record.position) + " that is not affine",
               "sixteen finite numbers, the last of each four being 0 0 0 1", fbx_remedy);
  }
  result.makeAffine();
  return result;
}

}  // namespace curveskel
