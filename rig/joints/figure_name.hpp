// The names and roles of a scene's figures: those of the second begin with "figure2_", and so on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <curveskel/rig.hpp>

namespace curveskel {

/// Of figure 0, the first, nothing.
[[nodiscard]] inline std::string figure_prefix(std::size_t figure) {
  return figure == 0 ? "" : "figure" + std::to_string(figure + 1) + "_";
}

/// "figure2_hips" taken apart.
struct FigureName {
  std::size_t figure = 0;  ///< from 0
  std::string_view own;    ///< as if the figure were alone
};

[[nodiscard]] inline FigureName of_figure(std::string_view name) {
  constexpr std::string_view word = "figure";
  if (!name.starts_with(word)) return {0, name};
  std::size_t number = 0;
  std::size_t at = word.size();
  for (; at < name.size() && name[at] >= '0' && name[at] <= '9'; ++at) {
    number = 10 * number + static_cast<std::size_t>(name[at] - '0');
  }
  if (number < 2 || at == name.size() || name[at] != '_') return {0, name};
  return {number - 1, name.substr(at + 1)};
}

/// The number of the first joint of a figure, which is the first of the figure's plan; the number
/// of joints where there is none.
[[nodiscard]] inline std::size_t first_joint_of(const Rig& rig, std::size_t figure) {
  const auto is_its = [&](const std::string& name) { return of_figure(name).figure == figure; };
  return static_cast<std::size_t>(std::find_if(rig.names.begin(), rig.names.end(), is_its) -
                                  rig.names.begin());
}

}  // namespace curveskel
