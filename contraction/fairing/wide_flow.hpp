// The local flow in single precision on processors.
#pragma once

#include <cstddef>
#include <memory>

#include "contraction/fairing/local_flow.hpp"

namespace curveskel {

/// `device` is an index into devices(), of one that is no graphics processor. Positions as for
/// make_opencl_flow; each run gives the same bytes, with any number of the driver's threads.
/// Vertices with large rings are done in double precision where the device has it.
/// Throws Error(Fault::device).
[[nodiscard]] std::unique_ptr<LocalFlow> make_wide_flow(const Surface& surface,
                                                        const OneRings& rings,
                                                        const FairOptions& options,
                                                        std::size_t device);

}  // namespace curveskel
