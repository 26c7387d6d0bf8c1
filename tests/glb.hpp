// The two chunks of a GLB file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace curveskel {

struct Glb {
  nlohmann::json json;
  std::string numbers;

  template <typename Value>
  [[nodiscard]] std::vector<Value> of_view(std::size_t number) const {
    const nlohmann::json& view = json["bufferViews"][number];
    std::vector<Value> result(view["byteLength"].get<std::size_t>() / sizeof(Value));
    std::memcpy(result.data(), &numbers.at(view["byteOffset"].get<std::size_t>()),
                result.size() * sizeof(Value));
    return result;
  }

  /// The whole view of an accessor.
  template <typename Value>
  [[nodiscard]] std::vector<Value> values(std::size_t accessor) const {
    return of_view<Value>(json["accessors"][accessor]["bufferView"].get<std::size_t>());
  }
};

[[nodiscard]] inline Glb glb_of(const std::string& bytes) {
  std::uint32_t length = 0;
  std::memcpy(&length, &bytes.at(12), sizeof length);
  return {nlohmann::json::parse(bytes.substr(20, length)), bytes.substr(28 + std::size_t{length})};
}

}  // namespace curveskel
