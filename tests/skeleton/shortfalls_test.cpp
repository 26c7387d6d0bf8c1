// The list of known shortfalls is kept true: what is on it and should not be is a failure.
#include "tests/skeleton/shortfalls.hpp"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <array>

namespace curveskel::shortfalls_laws {
namespace {

constexpr std::array known{Shortfall{"horse", "spurs", 3}};

TEST(Shortfalls, PassAtTheirFigure) {
  expect_at_most(known, "horse", "spurs", 3, 0);
  expect_at_most(known, "horse", "spurs", 1, 0);
}

TEST(Shortfalls, FailWhenTheyGrow) {
  EXPECT_NONFATAL_FAILURE(expect_at_most(known, "horse", "spurs", 4, 0), "got worse");
}

TEST(Shortfalls, FailWhenTheyAreOvercome) {
  EXPECT_NONFATAL_FAILURE(expect_at_most(known, "horse", "spurs", 0, 0), "strike it off");
}

TEST(Shortfalls, OfOthersExcuseNothing) {
  EXPECT_NONFATAL_FAILURE(expect_at_most(known, "cow", "spurs", 3, 0), "cow");
  EXPECT_NONFATAL_FAILURE(expect_at_most(known, "horse", "tips", 3, 0), "tips");
}

}  // namespace
}  // namespace curveskel::shortfalls_laws
