// OpenMesh's messages. Internal to surface/.
#pragma once

#include <OpenMesh/Core/System/omstream.hh>
#include <mutex>

namespace curveskel {

/// OpenMesh reports faults on streams that all threads share; errors of ours say more. From any
/// thread, and each time, as OpenMesh's own readers and writers switch them on again.
inline void silence_openmesh() {
  static std::mutex one_at_a_time;
  const std::lock_guard guard(one_at_a_time);
  omerr().disable();
  omout().disable();
  omlog().disable();
}

}  // namespace curveskel
