// The OpenCL C programs, embedded from kernels/*.cl at build time.
#pragma once

#include <string_view>

namespace curveskel {

/// Steps of conjugate gradients and of the iteration that preconditions it; double precision.
extern const std::string_view conjugate_gradients_source;

/// One colour of a sweep; double precision.
extern const std::string_view gauss_seidel_source;

/// One work-item per vertex, any valence; see the file for macros and arguments.
extern const std::string_view one_ring_stream_source;
/// 16 vertices per work-item, one to a vector lane, rings of limited length, single precision.
extern const std::string_view one_ring_wide_source;

/// One work-item per patch, a QR each; see the file for macros and arguments.
extern const std::string_view patch_qr_source;

}  // namespace curveskel
