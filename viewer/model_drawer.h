#pragma once

#include <memory>
#include <vector>

#include "particle_scene.h"
#include "view_state.h"
#include "wheatstone/app/render_model_file.h"
#include "wheatstone/depth/rig.h"

namespace wheatstone::viewer {

struct DrawnModel {
  std::vector<Image<Rgb8>> views;
  double scale = 1;  ///< of their pixels: less than 1 where they were drawn quickly
  /// Of each view, in scene units; NaN beside the model. Of what was drawn quickly: none.
  std::shared_ptr<const std::vector<Image<float>>> depth;
};

/// Draws views of a model, as `wheatstone render` does with the options of the state; what is wanted quickly has fewer
/// pixels. Keeps how long they take. Of one thread.
class ModelDrawer {
 public:
  /// Throws Error{wrong_usage} where the options make no sense.
  DrawnModel draw(const ReadyModel& model, const ViewState& state, Rig rig, Effort effort);

 private:
  double seconds_a_pixel_ = 1e-7;
};

}  // namespace wheatstone::viewer
