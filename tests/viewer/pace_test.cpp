// Laws of how finely is drawn: machines of all speeds, whose time for a picture is a multiple of
// what there is to draw.
#include "viewer/software/pace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace curveskel::viewer::pace_laws {
namespace {

constexpr Fineness finest{};
constexpr double frame_milliseconds = 1000.0 / 60;

Pace::Load large() { return {{400000, 120000, 34000, 9000}, 870000}; }

/// A machine that takes so long for the whole of this load.
class Machine {
 public:
  explicit Machine(double milliseconds_for_all) {
    Pace unit;
    unit.measured(finest, large(), 1);
    unit_ = unit;
    factor_ = milliseconds_for_all;
  }
  [[nodiscard]] double milliseconds(const Fineness& fineness, const Pace::Load& load) const {
    return factor_ * unit_.predicted(fineness, load);
  }

 private:
  Pace unit_;
  double factor_ = 1;
};

Fineness after(Pace& pace, const Machine& machine, int frames) {
  Fineness last;
  for (int i = 0; i < frames; ++i) {
    last = pace.while_moving(large());
    pace.measured(last, large(), machine.milliseconds(last, large()));
    pace.measured_rest(1);
  }
  return last;
}

TEST(Pace, AFastMachineNeverDrawsCoarsely) {
  for (const double all : {0.01, 1.0, 8.0, 14.0}) {
    const Machine machine(all);
    Pace pace;
    for (int i = 0; i < 1000; ++i) {
      const Fineness chosen = pace.while_moving(large());
      ASSERT_EQ(chosen, finest) << all << " ms, frame " << i;
      // Now and then something else takes the machine's time.
      const double hiccup = i % 4 == 3 ? 200 : 0;
      pace.measured(chosen, large(), machine.milliseconds(chosen, large()) + hiccup);
    }
    EXPECT_EQ(pace.at_rest(large()), finest);
  }
}

TEST(Pace, ASlowMachineDrawsInTime) {
  for (const double all : {30.0, 100.0, 300.0, 600.0}) {
    const Machine machine(all);
    Pace pace;
    const Fineness chosen = after(pace, machine, 20);
    EXPECT_TRUE(finer(finest, chosen)) << all;
    EXPECT_LE(machine.milliseconds(chosen, large()), frame_milliseconds) << all;
  }
}

TEST(Pace, ASteadyMachineKeepsToItsChoice) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(0.9, 1.1);
  for (double all = 5; all < 1000; all *= 1.07) {
    const Machine machine(all);
    Pace pace;
    Fineness last = after(pace, machine, 20);
    int changes = 0;
    for (int i = 0; i < 300; ++i) {
      const Fineness now = pace.while_moving(large());
      pace.measured(now, large(), noise(random) * machine.milliseconds(now, large()));
      changes += now == last ? 0 : 1;
      last = now;
    }
    EXPECT_LE(changes, 3) << all;
  }
}

TEST(Pace, IsFineAgainOnceThereIsTime) {
  Pace pace;
  EXPECT_TRUE(finer(finest, after(pace, Machine(300), 20)));
  EXPECT_EQ(after(pace, Machine(5), 20), finest);
}

TEST(Pace, TakesTheRestOfAFrameIntoAccount) {
  const Machine machine(14);
  Pace pace;
  EXPECT_EQ(after(pace, machine, 20), finest);
  for (int i = 0; i < 20; ++i) pace.measured_rest(8);
  EXPECT_TRUE(finer(finest, pace.while_moving(large())));
}

TEST(Pace, AtRestIsFinerThanWhileMoving) {
  for (double all = 1; all < 20000; all *= 1.5) {
    Pace pace;
    const Fineness moving = after(pace, Machine(all), 20);
    EXPECT_FALSE(finer(moving, pace.at_rest(large()))) << all;
  }
}

}  // namespace
}  // namespace curveskel::viewer::pace_laws
