// Laws of components that meet or lie in one another: those that asking each of each finds.
#include "surface/mesh/overlaps.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <stop_token>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::overlaps_laws {
namespace {

using Boxes = std::vector<Eigen::AlignedBox3d>;

/// On a lattice in this room, so that many only touch; each third one a few times as large.
Boxes boxes_within(const Eigen::Vector3d& room, int count, unsigned seed) {
  std::mt19937 draw(seed);
  Boxes boxes;
  for (int k = 0; k < count; ++k) {
    Eigen::Vector3d low;
    Eigen::Vector3d size;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = double(draw() % unsigned(room[axis]));
      size[axis] = 1 + double(draw() % (k % 3 == 0 ? 9U : 2U));
    }
    boxes.emplace_back(low, low + size);
  }
  return boxes;
}

Surface surface_of(const Boxes& boxes) {
  std::vector<shapes::Shape> parts;
  for (const Eigen::AlignedBox3d& box : boxes) {
    shapes::Shape part = shapes::box(box.sizes(), 1);
    Positions& positions = part.surface.positions;
    const Eigen::RowVector3d low = positions.colwise().minCoeff();
    positions.rowwise() += box.min().transpose() - low;
    positions = positions.array().round();
    parts.push_back(std::move(part));
  }
  return shapes::together("boxes", parts).surface;
}

bool is_within(const Eigen::AlignedBox3d& one, const Eigen::AlignedBox3d& other) {
  return (one.min().array() > other.min().array()).all() &&
         (one.max().array() < other.max().array()).all();
}

TEST(Overlaps, AreThoseThatAskingEachOfEachFinds) {
  for (const Eigen::Vector3d& room :
       {Eigen::Vector3d(16, 16, 16), Eigen::Vector3d(90, 6, 6), Eigen::Vector3d(6, 6, 90)}) {
    const Boxes boxes = boxes_within(room, 90, 5);
    const Surface surface = surface_of(boxes);
    const Overlaps found = overlaps_of(surface, topology(surface), {});
    for (std::size_t c = 0; c < boxes.size(); ++c) {
      std::vector<int> met;
      int around = -1;
      for (std::size_t other = 0; other < boxes.size(); ++other) {
        if (other == c || !boxes[c].intersects(boxes[other])) continue;
        if (is_within(boxes[other], boxes[c])) continue;
        if (!is_within(boxes[c], boxes[other])) {
          met.push_back(static_cast<int>(other));
        } else if (around < 0 || boxes[other].volume() < boxes[idx(around)].volume()) {
          around = static_cast<int>(other);
        }
      }
      EXPECT_EQ(found.met[c], met) << c << " in " << room.transpose();
      EXPECT_EQ(found.around[c], around) << c << " in " << room.transpose();
    }
  }
}

TEST(Overlaps, AreLookedForUntilAStop) {
  const Surface surface = surface_of(boxes_within({16, 16, 16}, 90, 5));
  std::stop_source stop;
  stop.request_stop();
  Monitor monitor;
  monitor.stop = stop.get_token();
  EXPECT_THROW((void)overlaps_of(surface, topology(surface), monitor), Cancelled);
}

}  // namespace
}  // namespace curveskel::overlaps_laws
