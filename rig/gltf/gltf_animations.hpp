// The animations of a glTF file: numbers of nodes over time.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// One row of numbers over time, in one of the ways that glTF has between two keys.
class GltfTrack {
 public:
  enum class Between { line, step, cubic };

  GltfTrack() = default;
  /// `rows`: of each key, of cubic ones the slopes before and behind it, too. `times` ascend.
  GltfTrack(std::vector<double> times, Eigen::MatrixXd rows, Between between, bool is_rotation);

  [[nodiscard]] bool empty() const { return times_.empty(); }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] Between between() const { return between_; }
  /// Before the first key that of the first, likewise at the end. O(log keys). Precondition: there
  /// are keys.
  [[nodiscard]] Eigen::VectorXd at(double seconds) const;

 private:
  [[nodiscard]] Eigen::VectorXd key(std::size_t number) const;

  std::vector<double> times_;
  Eigen::MatrixXd rows_;
  Between between_ = Between::line;
  bool is_rotation_ = false;
};

/// The tracks of a node; empty ones leave it as it is.
struct GltfMotion {
  GltfTrack shift;
  GltfTrack turn;  ///< x y z w
  GltfTrack scale;
  GltfTrack sliders;  ///< of its mesh's shape keys
};

struct GltfAnimation {
  std::string name;
  std::map<int, GltfMotion> motions;  ///< by node
};

/// Those that move nodes; channels that move something else, by an extension, are left out. Throws
/// Error(Fault::input) where numbers are missing, are none, or times don't ascend. O(numbers).
[[nodiscard]] std::vector<GltfAnimation> read_gltf_animations(const FileBytes& file,
                                                              const tinygltf::Model& model);

}  // namespace curveskel
