// The repairs, in words.
#pragma once

#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>

namespace curveskel {

/// Adds a line for each thing that was done, and says it.
void describe_repairs(Repairs& repairs, const Monitor& monitor);

/// Adds the line of components that were wrapped, `faces` of the faces given, and says it. The
/// wrap's lengths are those of `repairs`.
void describe_wrapped_components(Repairs& repairs, std::int64_t faces, const Monitor& monitor);

/// Adds the line of handles that were cut, as asked or since a certificate failed, and says it.
void describe_cut_handles(Repairs& repairs, bool certificate_failed, const Monitor& monitor);

}  // namespace curveskel
