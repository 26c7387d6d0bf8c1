// The number of threads that may be asked for.
#pragma once

namespace curveskel {

/// `threads` in options: 0, which is one per core, up to this many. No result depends on it.
inline constexpr int most_threads = 4096;

}  // namespace curveskel
