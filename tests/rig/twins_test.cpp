// Laws of mirror images among components: those that asking each of each finds.
#include "rig/parts/twins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stop_token>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>

namespace curveskel::twins_laws {
namespace {

using Eigen::Vector3d;

constexpr double tolerance = 1;

struct Subject {
  std::vector<Vector3d> middles;
  std::vector<double> areas;
  std::vector<int> by_area;

  [[nodiscard]] MeasuredComponents measured() const { return {middles, areas, by_area}; }
};

/// Many of one area, some about twice as large, specks whose order is by chance; half of them have
/// an image across x = 0, more or less, and the closer the room is the more others are near it.
Subject scattered(int pairs, double room, unsigned seed) {
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> place(-room, room);
  std::uniform_real_distribution<double> off(-0.7, 0.7);
  std::uniform_real_distribution<double> about(0.98, 1.0);
  Subject subject;
  for (int k = 0; k < pairs; ++k) {
    const double area = k % 5 == 0 ? 1e-9 * std::abs(place(draw)) : 1 + k % 2 * about(draw);
    const Vector3d middle(place(draw), place(draw), place(draw));
    const Vector3d image(-middle.x() + off(draw), middle.y() + off(draw), middle.z() + off(draw));
    for (const Vector3d& one : {middle, k % 3 == 0 ? Vector3d(3 * room * image) : image}) {
      subject.middles.push_back(one);
      subject.areas.push_back(area);
    }
  }
  subject.by_area.resize(subject.areas.size());
  std::iota(subject.by_area.begin(), subject.by_area.end(), 0);
  std::stable_sort(subject.by_area.begin(), subject.by_area.end(), [&](int a, int b) {
    return std::llround(1e6 * subject.areas[idx(a)]) > std::llround(1e6 * subject.areas[idx(b)]);
  });
  return subject;
}

std::vector<int> asking_each(const Subject& subject, int axis) {
  const auto& [middles, areas, by_area] = subject;
  std::vector<int> twins(middles.size(), -1);
  for (std::size_t i = 0; i < by_area.size(); ++i) {
    const std::size_t c = idx(by_area[i]);
    Vector3d image = middles[c];
    image[axis] *= -1;
    if (twins[c] >= 0 || (image - middles[c]).norm() < tolerance) continue;
    for (std::size_t j = i + 1; j < by_area.size(); ++j) {
      const std::size_t other = idx(by_area[j]);
      if (areas[other] < 0.97 * areas[c]) break;
      if (twins[other] >= 0 || (middles[other] - image).norm() > tolerance) continue;
      twins[c] = static_cast<int>(other);
      twins[other] = static_cast<int>(c);
      break;
    }
  }
  return twins;
}

TEST(Twins, AreThoseThatAskingEachOfEachFinds) {
  for (const int pairs : {0, 1, 3, 40, 400}) {
    for (const double room : {1.5, 4.0, 40.0}) {
      const Subject subject = scattered(pairs, room, unsigned(pairs));
      std::vector<int> expected(subject.areas.size(), -1);
      double most = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const std::vector<int> twins = asking_each(subject, axis);
        double paired = 0;
        for (std::size_t c = 0; c < twins.size(); ++c) {
          paired += twins[c] >= 0 ? subject.areas[c] : 0;
        }
        if (paired > most) expected = twins;
        most = std::max(most, paired);
      }
      EXPECT_EQ(mirrored_twins(subject.measured(), Vector3d::Zero(), tolerance, {}), expected)
          << pairs << " pairs within " << room;
    }
  }
}

TEST(Twins, AreLookedForUntilAStop) {
  const Subject subject = scattered(40, 4, 40);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(
      (void)mirrored_twins(subject.measured(), Vector3d::Zero(), tolerance, stop.get_token()),
      Cancelled);
}

}  // namespace
}  // namespace curveskel::twins_laws
