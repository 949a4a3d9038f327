#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "wheatstone/app/particle_frames.h"
#include "wheatstone/app/render_model_file.h"
#include "wheatstone/app/rotoscope.h"
#include "wheatstone/depth/view_position.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/stereo/view.h"
#include "wheatstone/video/stereo_film.h"

namespace wheatstone {

// What is painted of a model of triangles. Behind the model is a wall at the depth mapping's far end.

/// The input of a painting of a model: the pictures of two eyes, their exact disparities, and views that show the parts
/// hidden from the left eye, as plan_painting takes them.
struct ModelPictures {
  StereoPair pictures;
  Image<float> left_disparity, right_disparity;
  std::vector<View> known;
};

/// Renders a model for a painting that is to be seen from all `wanted` views. Of the options, those of the views'
/// number and place have no effect. Throws as render_ready.
ModelPictures model_pictures(const ReadyModel& model, const RenderParticlesOptions& options, ViewRange wanted,
                             const Progress& progress = {});

/// A film of a model for two eyes, around which the camera moves, and the exact geometry of its frames with the flow
/// from the frame before. Only the camera moves: the wall stands still in the pictures. A point has the flow of its
/// surface also where the other frame hides it.
struct ModelFilm {
  StereoFilmReader source;
  KnownFrames known;
};

/// CarryOptions::length_tolerance for such a film: on surfaces that turn towards the eyes strokes grow, to twice their
/// length, and on others they shrink.
inline constexpr float length_tolerance_on_models = 1;

/// Renders frames when they are read. Of the options, those of the views' number and place have no effect. Throws as
/// render_ready.
ModelFilm film_of_model(ReadyModel model, ParticleFramesOptions options, Rational rate);

}  // namespace wheatstone
