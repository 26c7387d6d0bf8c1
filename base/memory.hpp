// Checks for room, made before memory is taken.
#pragma once

#include <string_view>

#include <curveskel/error.hpp>

namespace curveskel {

/// Bytes that this process may still take: the least of what the system can give without swapping,
/// of its control group's limit and of its own address space limit. Infinity where nothing is
/// known.
[[nodiscard]] double available_memory_bytes();

/// Throws Error(fault) if `bytes` are more than `available`; the message says what they are for,
/// both figures, and the remedy.
void require_memory(double bytes, double available, std::string_view purpose, Fault fault,
                    std::string_view remedy);

}  // namespace curveskel
