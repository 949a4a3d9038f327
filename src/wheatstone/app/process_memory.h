#pragma once

namespace wheatstone {

/// For programs that paint: memory that is freed serves the next picture. What goes back to the system comes again page
/// by page, each to be cleared: a tenth of the time of a painting. Only what is large goes back at once: kept, it would
/// be in the way of pictures of other sizes, and painting 12 megapixels would take a tenth more memory.
void keep_freed_memory();

/// For programs and modules: large blocks that `new` and OpenCV allocate from now on lie in huge pages, where the
/// system gives them on request (Linux). Touching ordinary pages for the first time, and finding where they lie, is up
/// to half of the time of a large painting. Whatever calls a function of this header gets an `operator new` of ours;
/// blocks with an alignment of their own are left as they are.
void use_huge_pages();

}  // namespace wheatstone
