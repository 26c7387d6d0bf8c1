// One number of an FBX file over time. Internal to rig/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/read/fbx_tree.hpp"

namespace curveskel {

/// An "AnimationCurve".
class FbxCurve {
 public:
  /// Throws Error(Fault::input) where numbers are missing, are none, or times descend.
  FbxCurve(const FileBytes& file, const FbxRecord& curve);

  [[nodiscard]] bool empty() const { return keys_.empty(); }
  /// Those of its keys, and for each step one just before it.
  [[nodiscard]] std::vector<double> seconds() const;
  /// True if lines between those are not all that there is.
  [[nodiscard]] bool bends() const;
  /// Before the first key that of the first, likewise at the end. O(log keys). Precondition: there
  /// are keys.
  [[nodiscard]] double at(double seconds) const;

 private:
  enum class Between { step, next, line, cubic };  // next: the value of the key behind it

  struct Key {
    double seconds;
    double value;
    Between between = Between::line;
    double leaving = 0;  ///< slopes, a second
    double arriving = 0;
    double leaving_share = 1.0 / 3;  ///< of the time to the next key, up to the control point
    double arriving_share = 1.0 / 3;
  };

  /// The numbers of a key, or of several that are alike.
  struct Attributes {
    std::uint64_t flags;
    const double* numbers;
  };

  void read_between(const FileBytes& file, const FbxRecord& curve);
  void set(std::size_t number, const Attributes& given);
  [[nodiscard]] double own_slope(std::size_t key) const;

  std::vector<Key> keys_;
};

}  // namespace curveskel
