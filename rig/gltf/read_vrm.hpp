// VRM, in: which joint is which bone of a human, in 1.0 and 0.x.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace tinygltf {
class Model;
}

namespace curveskel {

inline constexpr std::string_view vrm_extension = "VRMC_vrm";
inline constexpr std::string_view vrm_0_extension = "VRM";  ///< of VRM 0.x

/// The role of each node that the file names as a human's bone, in VRM 1.0's words.
[[nodiscard]] std::map<int, std::string> vrm_roles(const tinygltf::Model& model);

}  // namespace curveskel
