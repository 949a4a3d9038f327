#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace wheatstone {

/// What computes.
enum class Device {
  processor,
  graphics,   ///< a graphics processor, by OpenGL; also one that the processor imitates
  automatic,  ///< a graphics processor where there is a real one and the work is large enough
};

/// What the driver says of a graphics processor.
struct GpuFacts {
  std::string name;                ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;             ///< of OpenGL and of the driver
  bool imitated = false;           ///< by the processor: right, but not fast
  std::size_t largest_buffer = 0;  ///< bytes that a program may use as one buffer
  std::size_t most_texels = 0;     ///< groups of four words that a program may read of one buffer
};

/// The graphics processor that computes here: the first real one, else one that the processor imitates. Throws
/// Error{wrong_usage} that says why there is none.
GpuFacts gpu_facts();

/// Whether a real graphics processor computes here.
bool has_real_gpu();

/// Whether a graphics processor is to do some work: where it is asked for; or where either may do it, there is a real
/// one, and the work is more than handing it over.
bool chooses_gpu(Device device, bool worthwhile);

/// Does what chooses_gpu() chose. False where it fails with Error{wrong_usage} though nobody asked for a graphics
/// processor: then the processor is to do the work.
bool done_on_gpu(Device device, const std::function<void()>& work);

/// Why done_on_gpu() left work to the processor since this was asked last, the first time; empty where it did not.
std::string why_left_by_gpu();

/// Runs work on the graphics processor: within it, buffers and programs can be made and used on the calling thread. The
/// context is made on first use, without a window, and kept; callers take turns. Throws what the work throws, and
/// Error{wrong_usage} where there is no graphics processor or it fails: "graphics processor: ...".
void on_gpu(const std::function<void(const GpuFacts& facts)>& work);

/// Does work of the processor for each view, in parallel, within on_gpu(). Meanwhile no thread that does it begins
/// other work, which could wait for the turn that this one has.
void for_each_view(std::size_t views, const std::function<void(std::size_t view)>& work);

}  // namespace wheatstone
