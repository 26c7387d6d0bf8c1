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

[[nodiscard]] inline std::string bytes_of(const Glb& glb) {
  std::string json = glb.json.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  const auto put = [&](std::size_t number) {
    const auto word = static_cast<std::uint32_t>(number);
    bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
  };
  put(2);
  put(28 + json.size() + glb.numbers.size());
  put(json.size());
  bytes += "JSON" + json;
  put(glb.numbers.size());
  return bytes + std::string("BIN\0", 4) + glb.numbers;
}

}  // namespace curveskel
