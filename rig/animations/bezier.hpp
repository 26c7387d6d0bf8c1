// Curves of one number over time, between two keys. Internal to rig/.
#pragma once

namespace curveskel {

struct TimedValue {
  double seconds;
  double value;
};

/// The value of the cubic Bezier curve `from`, `leaving`, `arriving`, `to` at a time between those
/// of its ends; control points beyond their times are drawn back to them, so that the curve never
/// turns back in time. To 1e-12 of the time between the ends.
[[nodiscard]] double bezier_value(const TimedValue& from, const TimedValue& leaving,
                                  const TimedValue& arriving, const TimedValue& to, double seconds);

}  // namespace curveskel
