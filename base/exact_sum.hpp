// Sums that do not depend on the order of their terms.
#pragma once

#include <cmath>
#include <cstddef>

namespace curveskel {

/// Splits each term into multiples of two fixed steps, whose sums are exact (Demmel and Nguyen,
/// Fast reproducible floating-point summation, 2013). Parts below the second step is dropped:
/// less than bound * terms^2 * 2^-102 per term.
class ExactSum {
 public:
  /// For at most `terms` terms, none larger than `bound` (> 0) in size.
  ExactSum(double bound, std::size_t terms) {
    const double room = std::exp2(std::ceil(std::log2(static_cast<double>(terms) + 1)) + 1);
    const double high_step = std::exp2(std::ceil(std::log2(bound)) - 52) * room;
    high_anchor_ = 1.5 * 0x1p52 * high_step;
    low_anchor_ = high_anchor_ * 0x1p-52 * room;
  }

  void add(double term) {
    const double high = (term + high_anchor_) - high_anchor_;
    high_ += high;
    low_ += ((term - high) + low_anchor_) - low_anchor_;
  }

  /// Adds another sum for the same terms and bound.
  void add(const ExactSum& other) {
    high_ += other.high_;
    low_ += other.low_;
  }

  [[nodiscard]] double value() const { return high_ + low_; }

 private:
  double high_anchor_;
  double low_anchor_;
  double high_ = 0;
  double low_ = 0;
};

}  // namespace curveskel
