// Laws of boxes that meet: the sweep finds what each of each finds, once.
#include "surface/mesh/meeting_boxes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace curveskel::meeting_boxes_laws {
namespace {

using Boxes = std::vector<Eigen::AlignedBox3d>;
using Pairs = std::vector<std::pair<int, int>>;

Pairs swept(const Boxes& boxes) {
  Pairs pairs;
  for_meeting_boxes(boxes, [&](int a, int b) { pairs.emplace_back(std::minmax(a, b)); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs each_with_each(const Boxes& boxes) {
  Pairs pairs;
  for (int a = 0; a < static_cast<int>(boxes.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(boxes.size()); ++b) {
      const bool both = !boxes[std::size_t(a)].isEmpty() && !boxes[std::size_t(b)].isEmpty();
      if (both && boxes[std::size_t(a)].intersects(boxes[std::size_t(b)])) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

/// Of places on a coarse lattice, so that many boxes only touch; every tenth is empty.
Boxes boxes_at_random(int count, const Eigen::Vector3d& room, unsigned seed) {
  std::mt19937 draw(seed);
  Boxes boxes;
  for (int k = 0; k < count; ++k) {
    boxes.emplace_back();
    if (k % 10 == 9) continue;
    Eigen::Vector3d from;
    for (int axis = 0; axis < 3; ++axis) from[axis] = double(draw() % unsigned(room[axis]));
    boxes.back().extend(from);
    boxes.back().extend(from + Eigen::Vector3d(draw() % 3, draw() % 3, draw() % 3));
  }
  return boxes;
}

TEST(MeetingBoxes, AreThoseThatEachWithEachFinds) {
  for (const int count : {0, 1, 2, 50, 300}) {
    for (const Eigen::Vector3d& room :
         {Eigen::Vector3d(8, 8, 8), Eigen::Vector3d(60, 3, 3), Eigen::Vector3d(2, 2, 90)}) {
      const Boxes boxes = boxes_at_random(count, room, unsigned(count));
      EXPECT_EQ(swept(boxes), each_with_each(boxes)) << count << " in " << room.transpose();
    }
  }
}

}  // namespace
}  // namespace curveskel::meeting_boxes_laws
