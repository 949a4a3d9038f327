#include "wheatstone/app/scene_rectification.h"

#include "wheatstone/error.h"

namespace wheatstone {

MeasuredScene measure_scene(const StereoPair& frame, RectifyPolicy policy, const Progress& progress) {
  MeasuredScene scene;
  try {
    const PreparedPair pair = prepare_pair(frame, {.rectify = policy, .keep_size = true, .ask_eyes = false}, progress);
    scene.rectification = {pair.rows.has_value(), pair.rectification, pair.colour};
    scene.note = pair.rectification ? rectified_note(pair) : row_warning(pair);
  } catch (const Error& error) {
    // A film may begin in the dark: a later frame tells.
    if (error.kind() != ErrorKind::bad_input) throw;
  }
  return scene;
}

StereoPair rectified(const StereoPair& frame, const SceneRectification& scene) {
  if (!scene.how) return frame;
  StereoPair pair = rectified(frame, *scene.how);
  if (scene.colour) apply_colour_transfer(*scene.colour, pair.right);
  return pair;
}

}  // namespace wheatstone
