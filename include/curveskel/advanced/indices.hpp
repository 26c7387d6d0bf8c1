// Element numbers are signed in this project, containers' indices are not: the one cast between.
#pragma once

#include <concepts>
#include <cstddef>

namespace curveskel {

/// The index of element number `number` in a container. Precondition: number >= 0.
[[nodiscard]] constexpr std::size_t idx(std::signed_integral auto number) {
  return static_cast<std::size_t>(number);
}

}  // namespace curveskel
