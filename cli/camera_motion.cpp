#include "camera_motion.h"

#include <utility>

namespace wheatstone::cli {
namespace {

/// Its default is shown where it moves the camera.
template <class Number>
Value motion_number(Number& value, NumberRange range) {
  return value == 0 ? without_default(number(value, range)) : number(value, range);
}

}  // namespace

Rows motion_rows(CameraMotion& motion, std::string frames_help, const Reasons& unless) {
  return under({},
               {row("--frames", motion_number(motion.frames, {1, 10'000'000}), std::move(frames_help)),
                row("--orbit", motion_number(motion.orbit_deg, {-36'000, 36'000}),
                    "Degrees that the camera turns around the middle of the views during the film"),
                row("--camera", text(motion.path), "Keyframes of the camera and of time: FILE.toml")},
               unless);
}

ParticleFramesOptions moved(const CameraMotion& motion, const RenderParticlesOptions& seen) {
  ParticleFramesOptions frames{.particles = seen, .count = motion.frames, .orbit_deg = motion.orbit_deg};
  if (!motion.path.empty()) frames.path = read_camera_path(motion.path);
  return frames;
}

}  // namespace wheatstone::cli
