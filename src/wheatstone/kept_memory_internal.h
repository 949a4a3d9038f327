#pragma once

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace wheatstone {

/// For programs that paint: memory that is freed serves the next picture. What goes back to the system comes again page
/// by page, each to be cleared: a tenth of the time of a painting. Only what is large goes back at once: kept, it would
/// be in the way of pictures of other sizes, and painting 12 megapixels would take a tenth more memory.
inline void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int large_bytes = 9 << 20, most_kept_bytes = 256 << 20;
  mallopt(M_MMAP_THRESHOLD, large_bytes);
  mallopt(M_TRIM_THRESHOLD, most_kept_bytes);
#endif
}

}  // namespace wheatstone
