#include "rig/animations/bezier.hpp"

#include <algorithm>

namespace curveskel {
namespace {

double bernstein(double a, double b, double c, double d, double t) {
  const double s = 1 - t;
  return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
}

}  // namespace

double bezier_value(const TimedValue& from, const TimedValue& leaving, const TimedValue& arriving,
                    const TimedValue& to, double seconds) {
  const double length = to.seconds - from.seconds;
  if (!(length > 0)) return to.value;
  const auto share = [&](const TimedValue& point) {
    return std::clamp((point.seconds - from.seconds) / length, 0.0, 1.0);
  };
  const double wanted = std::clamp((seconds - from.seconds) / length, 0.0, 1.0);
  double low = 0;
  double high = 1;
  constexpr int halvings = 40;  // to 1e-12
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (bernstein(0, share(leaving), share(arriving), 1, middle) < wanted ? low : high) = middle;
  }
  return bernstein(from.value, leaving.value, arriving.value, to.value, 0.5 * (low + high));
}

}  // namespace curveskel
