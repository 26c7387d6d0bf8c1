// Any bytes as a rigged glTF file: an error about the input, no rig, or one that holds together and
// fits the surface of the same file.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <curveskel/error.hpp>
#include "rig/io/rig_formats.hpp"
#include "surface/read/formats.hpp"

namespace {

using namespace curveskel;

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const Rig& rig) {
  require(rig.joints.rows() > 0 && rig.joints.allFinite());
  require(rig.parents.size() == rig.joints.rows());
  require(static_cast<Eigen::Index>(rig.names.size()) == rig.joints.rows());
  for (Eigen::Index joint = 0; joint < rig.parents.size(); ++joint) {
    require(-1 <= rig.parents[joint] && rig.parents[joint] < joint);
  }
  require(rig.weights.cols() == rig.joints.rows());
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    double sum = 0;
    bool moved = false;
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      require(it.value() >= 0);
      sum += static_cast<double>(it.value());
      moved = true;
    }
    require(!moved || std::abs(sum - 1) < 1e-4);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const FileBytes file{"/nonexistent/fuzzed",
                       std::string(reinterpret_cast<const char*>(data), size)};
  try {
    const auto rig = read_gltf_rig(file, {});
    if (!rig) return 0;
    check(*rig);
    require(rig->weights.rows() == read_gltf(file, {}).positions.rows());
  } catch (const Error& error) {
    require(error.fault() == Fault::input);
  }
  return 0;
}
