// Numbers as the bytes of a glTF buffer, and the numbers by which glTF names their kinds.
#pragma once

#include <string>

namespace curveskel {

template <typename Value>
void put_number(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline constexpr int gltf_uint8 = 5121;
inline constexpr int gltf_uint16 = 5123;
inline constexpr int gltf_uint32 = 5125;
inline constexpr int gltf_float = 5126;
inline constexpr int gltf_vertices = 34962;  ///< targets of buffer views
inline constexpr int gltf_indices = 34963;

}  // namespace curveskel
