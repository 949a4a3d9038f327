#pragma once

#include <vector>

#include "wheatstone/app/render_model_file.h"
#include "wheatstone/marks/view_range.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// The input of a painting of a model: the pictures of two eyes, their exact disparities, and views that show the parts
/// hidden from the left eye, as plan_painting takes them. Behind the model is a wall at the depth mapping's far end.
struct ModelPictures {
  StereoPair pictures;
  Image<float> left_disparity, right_disparity;
  std::vector<View> known;
};

/// Renders a model for a painting that is to be seen from all `wanted` views. Of the options, those of the views'
/// number and place have no effect. Throws as render_ready.
ModelPictures model_pictures(const ReadyModel& model, const RenderParticlesOptions& options, ViewRange wanted,
                             const Progress& progress = {});

}  // namespace wheatstone
