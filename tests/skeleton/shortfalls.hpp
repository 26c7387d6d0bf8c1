// The shortfalls of the program, said by name and figure in the tests themselves.
#pragma once

#include <gtest/gtest.h>

#include <iostream>
#include <span>
#include <string>
#include <string_view>

namespace curveskel {

/// `figure` is what is measured now where the law asks for less (see expect_at_most).
struct Shortfall {
  std::string_view subject;   ///< shape or mesh
  std::string_view property;  ///< "spurs", "outside", ...
  double figure;
};

/// Requires found <= wanted. For a listed shortfall it requires wanted < found <= figure instead
/// and prints it, so that it stays in sight: one that is overcome fails until it is struck off the
/// list.
inline void expect_at_most(std::span<const Shortfall> known, std::string_view subject,
                           std::string_view property, double found, double wanted) {
  for (const Shortfall& shortfall : known) {
    if (shortfall.subject != subject || shortfall.property != property) continue;
    std::cout << "[  KNOWN   ] " << subject << ": " << property << " " << found << ", wanted "
              << wanted << '\n';
    EXPECT_GT(found, wanted) << subject << ": " << property
                             << " is overcome, strike it off the list of known shortfalls";
    EXPECT_LE(found, shortfall.figure) << subject << ": " << property << " got worse";
    return;
  }
  EXPECT_LE(found, wanted) << subject << ": " << property;
}

}  // namespace curveskel
