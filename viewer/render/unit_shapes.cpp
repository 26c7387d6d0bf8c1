#include "viewer/render/unit_shapes.hpp"

#include <cmath>
#include <numbers>

namespace curveskel::viewer {
namespace {

constexpr std::uint32_t sides_round = 16;
constexpr std::uint32_t rings = 12;  // of the ball, poles included

float turn(std::uint32_t part, std::uint32_t parts, float whole) {
  return whole * static_cast<float>(part) / static_cast<float>(parts);
}

}  // namespace

UnitShape unit_tube() {
  UnitShape shape;
  shape.points.reserve(std::size_t{2} * sides_round);
  shape.corners.reserve(std::size_t{6} * sides_round);
  for (std::uint32_t side = 0; side < sides_round; ++side) {
    const float angle = turn(side, sides_round, 2 * std::numbers::pi_v<float>);
    shape.points.emplace_back(std::cos(angle), std::sin(angle), 0, 0);
    shape.points.emplace_back(std::cos(angle), std::sin(angle), 0, 1);
    const std::uint32_t next = (side + 1) % sides_round;
    for (const std::uint32_t corner :
         {2 * side, 2 * next, 2 * side + 1, 2 * next, 2 * next + 1, 2 * side + 1}) {
      shape.corners.push_back(corner);
    }
  }
  return shape;
}

UnitShape unit_ball() {
  UnitShape shape;
  shape.points.reserve(std::size_t{rings} * sides_round);
  shape.corners.reserve(std::size_t{6} * rings * sides_round);
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const float down = turn(ring, rings - 1, std::numbers::pi_v<float>);
    for (std::uint32_t side = 0; side < sides_round; ++side) {
      const float angle = turn(side, sides_round, 2 * std::numbers::pi_v<float>);
      shape.points.emplace_back(std::sin(down) * std::cos(angle), std::sin(down) * std::sin(angle),
                                std::cos(down), 0);
      if (ring + 1 == rings) continue;
      const std::uint32_t next = (side + 1) % sides_round;
      const std::uint32_t here = ring * sides_round;
      const std::uint32_t below = here + sides_round;
      for (const std::uint32_t corner :
           {here + side, below + side, here + next, here + next, below + side, below + next}) {
        shape.corners.push_back(corner);
      }
    }
  }
  return shape;
}

}  // namespace curveskel::viewer
