#pragma once

#include <string>

#include "options.h"
#include "wheatstone/app/particle_frames.h"

namespace wheatstone::cli {

/// How the camera of a film moves, as it is typed.
struct CameraMotion {
  int frames = 0;       ///< 0: as many as the input has
  float orbit_deg = 0;  ///< in all frames
  std::string path;     ///< a file of keyframes; empty: none
};

/// --frames, --orbit and --camera, refused where one of `unless` holds. The help of the first is `frames_help`.
Rows motion_rows(CameraMotion& motion, std::string frames_help, const Reasons& unless);

/// The frames of a film whose camera moves so. Throws as read_camera_path.
ParticleFramesOptions moved(const CameraMotion& motion, const RenderParticlesOptions& seen);

}  // namespace wheatstone::cli
