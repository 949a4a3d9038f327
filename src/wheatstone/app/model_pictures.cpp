#include "wheatstone/app/model_pictures.h"

#include <cmath>
#include <utility>

#include "wheatstone/painting/still_scene.h"

namespace wheatstone {
ModelPictures model_pictures(const ReadyModel& model, const RenderParticlesOptions& options, ViewRange wanted,
                             const Progress& progress) {
  const float first = wanted.first.eye_separations(), last = wanted.last.eye_separations();
  // Both eyes, then what is beyond them, and last what lies between: each shows what those before it do not.
  const Rig rig{
      options.width,
      options.height,
      {left_eye, right_eye, wanted.first, wanted.last, ViewPosition(first / 2), ViewPosition(last / 2), central_view}};
  const ModelScene scene = scene_of(model, options);
  RenderedModel rendered =
      render_model(model.read.model, scene, rig, {.method = options.rendering.method, .geometry = true}, progress);
  const float wall = -scene.mapping.points.back().parallax_px;
  for (Image<float>& disparity : rendered.disparity)
    for (float& value : disparity.pixels())
      if (std::isnan(value)) value = wall;

  ModelPictures made;
  std::vector<View> views;
  for (std::size_t v = 0; v < rig.positions.size(); ++v)
    views.push_back({rendered.views[v], rendered.disparity[v], {}, rig.positions[v]});
  want_what_others_do_not_show(views);
  made.pictures = {rendered.views[0], rendered.views[1]};
  made.left_disparity = rendered.disparity[0];
  made.right_disparity = rendered.disparity[1];
  for (std::size_t v = 1; v < views.size(); ++v) {
    View& view = made.known.emplace_back(std::move(views[v]));
    view.colour = std::move(rendered.views[v]);
    view.disparity = std::move(rendered.disparity[v]);
  }
  return made;
}

}  // namespace wheatstone
