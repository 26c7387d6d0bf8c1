// The objects of an FBX file and the frames of its models. Internal to surface/ and
// rig/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "surface/read/fbx_tree.hpp"

namespace curveskel {

/// "P: "Lcl Scaling", "Lcl Scaling", "", "A", 1, 1, 1" among an object's properties, or nullptr.
[[nodiscard]] const FbxRecord* fbx_property(const FbxRecord* owner, std::string_view name);

/// "hips" of "hips", a mark and "Model", as binary files have it, and of "Model::hips".
[[nodiscard]] std::string fbx_name(const FbxRecord& object);

/// True if it says so of itself.
[[nodiscard]] bool is_fbx_joint(const FbxRecord& model);

/// Of a property's values, which stand behind name, two types and flags, the first.
inline constexpr std::size_t first_property_value = 4;

/// The numbers of a model that animations move.
struct FbxMove {
  Eigen::Vector3d shift;
  Eigen::Vector3d angles;  ///< in degrees about x, y and z, in the model's order: mostly x first
  Eigen::Vector3d scale;
};

/// Angles in degrees about x, y and z, of which the first in `order` (0 = XYZ, as "RotationOrder")
/// turns first.
[[nodiscard]] Eigen::Matrix3d fbx_rotation(const Eigen::Vector3d& degrees, std::int64_t order = 0);
/// The angles of a rotation.
[[nodiscard]] Eigen::Vector3d fbx_angles(const Eigen::Matrix3d& rotation, std::int64_t order = 0);

class FbxScene {
 public:
  /// Both must outlive the scene. Throws Error(Fault::input) for a file without objects, and for
  /// models that stand in circles.
  FbxScene(const FileBytes& file, const FbxRecord& root);

  /// The objects of that kind ("Model", "Geometry", "Deformer") in the file's order.
  [[nodiscard]] std::vector<const FbxRecord*> all(std::string_view kind) const;
  /// Those of a kind and a subclass ("Deformer", "Skin") that are connected below `object`.
  [[nodiscard]] std::vector<const FbxRecord*> below(const FbxRecord& object, std::string_view kind,
                                                    std::string_view subclass = {}) const;

  /// The first of a kind that is connected with a property of `object`, or nullptr.
  [[nodiscard]] const FbxRecord* at_property(const FbxRecord& object, std::string_view property,
                                             std::string_view kind) const;
  /// All of them, in the file's order.
  [[nodiscard]] std::vector<const FbxRecord*> all_at_property(const FbxRecord& object,
                                                              std::string_view property,
                                                              std::string_view kind) const;

  /// The property of an object, of its own or as the file defines it for all of the kind
  /// ("Model", "Material"), or nullptr.
  [[nodiscard]] const FbxRecord* property(const FbxRecord& object, std::string_view name) const;

  /// The model that a model hangs from, or nullptr.
  [[nodiscard]] const FbxRecord* parent(const FbxRecord& model) const;

  /// From a model's coordinates to the world's, as the model's own numbers place it.
  [[nodiscard]] const Eigen::Affine3d& frame(const FbxRecord& model) const {
    return frame_of_.at(&model);
  }
  /// In which a model's own angles turn it, as of `fbx_rotation`.
  [[nodiscard]] std::int64_t rotation_order(const FbxRecord& model) const;
  /// As the scene shows it.
  [[nodiscard]] FbxMove move(const FbxRecord& model) const;
  /// From a model's coordinates to those of its parent, with these numbers for its own. Throws
  /// Error(Fault::input) where it is not finite.
  [[nodiscard]] Eigen::Affine3d local(const FbxRecord& model, const FbxMove& move) const;
  /// From the coordinates of a model's mesh to the model's: what only the mesh feels.
  [[nodiscard]] Eigen::Affine3d geometric(const FbxRecord& model) const;

  /// The record's sixteen numbers by columns. Throws Error(Fault::input) unless they are affine.
  [[nodiscard]] Eigen::Affine3d matrix(const FbxRecord& record) const;

 private:
  [[nodiscard]] Eigen::Vector3d vector(const FbxRecord& model, std::string_view name,
                                       double otherwise = 0) const;
  [[nodiscard]] bool has_active_rotation(const FbxRecord& model) const;
  void connect(const FbxRecord& connections);
  void place_models();

  const FileBytes& file_;
  const FbxRecord* objects_ = nullptr;
  std::unordered_map<std::string_view, const FbxRecord*> defaults_;  // by kind
  std::unordered_map<std::int64_t, const FbxRecord*> by_id_;
  std::unordered_map<const FbxRecord*, std::vector<const FbxRecord*>> below_;
  struct AtProperty {
    std::string_view property;
    const FbxRecord* object;
  };
  std::unordered_map<const FbxRecord*, std::vector<AtProperty>> at_property_;
  std::unordered_map<const FbxRecord*, const FbxRecord*> parent_of_;  // of models
  std::unordered_map<const FbxRecord*, Eigen::Affine3d> frame_of_;
};

}  // namespace curveskel
