// The keyword that begins an OFF file: [ST][C][N][4][n]OFF.
#pragma once

#include <optional>
#include <string_view>

namespace curveskel {

struct OffKeyword {
  bool texture = false;
  bool colours = false;
  bool normals = false;
  bool four_dimensional = false;
  bool any_dimensional = false;
};

[[nodiscard]] inline std::optional<OffKeyword> parse_off_keyword(std::string_view word) {
  OffKeyword keyword;
  const auto take = [&](std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
  };
  keyword.texture = take("ST");
  keyword.colours = take("C");
  keyword.normals = take("N");
  keyword.four_dimensional = take("4");
  keyword.any_dimensional = take("n");
  if (word != "OFF") return std::nullopt;
  return keyword;
}

}  // namespace curveskel
