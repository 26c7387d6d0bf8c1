// An animation of a glTF document, as it is written. Internal to rig/.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "rig/gltf/gltf_document.hpp"

namespace curveskel {

/// Rows of numbers over time, for one node.
struct GltfRows {
  const char* path;  ///< "rotation", ...
  const char* type;  ///< of a row, "VEC4"; "SCALAR" = as many as there are
  std::vector<Eigen::VectorXd> rows;

  /// True if no number is further from the rest than rounding to single precision makes of `size`.
  [[nodiscard]] bool stays_at(const Eigen::VectorXd& rest, double size) const;
};

class GltfClip {
 public:
  /// The second that becomes 0.
  GltfClip(GltfDocument& document, double start) : document_(document), start_(start) {}

  /// Those seconds that glTF can tell from the one before, by their numbers.
  [[nodiscard]] std::vector<std::size_t> distinct(const std::vector<double>& seconds) const;
  /// Of moments that are distinct; returns their accessor.
  std::size_t add_times(const std::vector<double>& seconds);
  void add_channel(std::size_t node, const GltfRows& rows, std::size_t times);
  /// Appends the animation, unless it is without channels. The name may be empty.
  void write(const std::string& name);

 private:
  [[nodiscard]] float time_of(double seconds) const;

  GltfDocument& document_;
  double start_;
  OrderedJson samplers_ = OrderedJson::array();
  OrderedJson channels_ = OrderedJson::array();
};

}  // namespace curveskel
