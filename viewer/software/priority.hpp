// The order of threads that want the same core.
#pragma once

namespace curveskel::viewer {

/// The calling thread, and those that it starts, give way to the ones that draw and answer. Where
/// the system has no priorities of threads, nothing happens.
void give_way();

}  // namespace curveskel::viewer
