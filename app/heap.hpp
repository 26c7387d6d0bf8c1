// The process' memory, laid out for speed.
#pragma once

namespace curveskel {

/// From now on memory comes from one heap in large pages, where the system has them: on some
/// machines the first touch of a small page takes longer than all that is done with what lies in
/// it. Freed memory stays with the process. For the beginning of main(), before there are threads.
/// Does nothing where the process has a limit of memory, or the system's C library is not the GNU
/// one.
void use_large_pages();

}  // namespace curveskel
