#pragma once

namespace wheatstone {

/// What computes.
enum class Device {
  processor,
  graphics,   ///< a graphics processor, by OpenGL; also one that the processor imitates
  automatic,  ///< a graphics processor where there is a real one and the work is large enough
};

}  // namespace wheatstone
