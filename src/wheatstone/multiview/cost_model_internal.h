#pragma once

#include <cstdint>
#include <string>

#include "wheatstone/multiview/render.h"

namespace wheatstone {

/// The quantities that decide how long each rendering method takes.
struct Workload {
  std::uint64_t particles = 0;
  float splat_px = 4;  ///< diameter of a splat of mean area
  bool mass = false;   ///< splats are spread over the areas of pixels
  int views = 2;
  int planes = 36;
  std::uint64_t pixels = std::uint64_t{640} * 360;  ///< of a view
  bool absorbs = false;                             ///< splats are sorted and blended front to back (Blend::over)
};

/// Estimated times of one thread in seconds. Their ratios are what matters: they were fitted to bench/multiview, whose
/// table shows how far off they are.
struct Costs {
  double exact = 0, incremental = 0, layered = 0;
};
Costs estimate_costs(const Workload& workload);

/// The fastest method, and the reason in words.
struct MethodChoice {
  Method method = Method::exact;
  std::string reason;
};
MethodChoice choose_method(const Workload& workload);

/// The same on a graphics processor, which has no exact method.
Costs estimate_gpu_costs(const Workload& workload);
MethodChoice choose_gpu_method(const Workload& workload);

}  // namespace wheatstone
