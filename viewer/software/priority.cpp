#include "viewer/software/priority.hpp"

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace curveskel::viewer {

void give_way() {
#ifdef __linux__
  // On Linux, process 0 is the calling thread alone, against POSIX.
  constexpr int nicer = 3;  // half of the time where others want all of it
  setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + nicer);
#endif
}

}  // namespace curveskel::viewer
