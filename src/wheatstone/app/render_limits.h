#pragma once

#include "wheatstone/app/render_particles.h"
#include "wheatstone/number_range.h"

namespace wheatstone {

// What the numbers of RenderParticlesOptions may be; those of the views are beside the rig (depth/rig.h), those of the
// framing beside the camera (depth/camera.h).

inline constexpr NumberRange coordinate_range{-no_bound, no_bound};
inline constexpr NumberRange position_range{-1e18, 1e18};  ///< of a point, as of particles in files
inline constexpr NumberRange every_range{1, 1e12}, neighbours_range{2, 1000}, chunk_range{1, 1 << 30};
inline constexpr NumberRange opacity_range{1e-6, 1000}, least_opacity_range{0, 1}, density_slope_range{-100, 100},
    density_shift_range{-30, 30}, shine_range{0, 1000}, exposure_range{1e-9, 1e9};
/// 0: one plane a pixel of parallax.
inline constexpr NumberRange planes_range{0, 100'000};
inline constexpr NumberRange near_range_mm{0, 100'000}, far_range_mm{0, 1e9}, eye_range_mm{1, 1000},
    distance_range_mm{1, 1e6}, screen_width_range_mm{1, 1e6};

/// Throws Error{wrong_usage} that names the first number that is out of its range. NaN is right where it stands for
/// what is found.
void check_render_options(const RenderParticlesOptions& options);

}  // namespace wheatstone
