// Curves of one number over time, between two keys. Internal to rig/.
#pragma once

namespace curveskel {

struct CurvePoint {
  double seconds;
  double value;
};

/// The value of the cubic Bezier curve `from`, `leaving`, `arriving`, `to` at a time between those
/// of its ends; control points beyond their times are drawn back to them, so that the curve never
/// turns back in time. To 1e-12 of the time between the ends.
[[nodiscard]] double bezier_value(const CurvePoint& from, const CurvePoint& leaving,
                                  const CurvePoint& arriving, const CurvePoint& to, double seconds);

}  // namespace curveskel
