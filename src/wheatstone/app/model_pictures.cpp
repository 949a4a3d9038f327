#include "wheatstone/app/model_pictures.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "wheatstone/painting/still_scene.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone {
namespace {

/// Views before the wall, with the disparity of every pixel. Depth is unknown on the wall.
RenderedModel render_before_wall(const ReadyModel& model, const ModelScene& scene, const Rig& rig, Method method,
                                 const Progress& progress) {
  RenderedModel rendered = render_model(model.read.model, scene, rig, {.method = method, .geometry = true}, progress);
  const float wall = -scene.mapping.points.back().parallax_px;
  for (Image<float>& disparity : rendered.disparity)
    for (float& value : disparity.pixels())
      if (std::isnan(value)) value = wall;
  return rendered;
}

/// What the eyes see of a model.
struct SeenModel {
  std::int64_t number = -1;  ///< of the frame
  ModelScene scene;
  StereoPair pictures;
  Image<float> left_disparity, right_disparity;
  Image<float> left_depth;
};

/// The place in the central view of a point at a pixel of the left eye's, and back: x there is x here − v·d, with the
/// left eye at v = −1/2.
float x_in_centre(float x, float disparity) { return x + left_eye.eye_separations() * disparity; }
float x_in_left(float x, float disparity) { return x - left_eye.eye_separations() * disparity; }

/// Where the points that the left eye sees in a frame are in its picture of another. The wall does not move; unknown
/// are points that the other camera has behind it.
Flow flow_between(const SeenModel& from, const SeenModel& to) {
  const int width = from.left_depth.width(), height = from.left_depth.height();
  Flow flow{Image<float>(width, height, 0), Image<float>(width, height, 0)};
  const Camera& camera = to.scene.camera;
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float depth = from.left_depth(x, y);
      if (std::isnan(depth)) continue;
      const float middle_x = static_cast<float>(x) + 0.5f, middle_y = static_cast<float>(y) + 0.5f;
      const std::array<float, 3> point =
          point_at(from.scene.camera, x_in_centre(middle_x, from.left_disparity(x, y)), middle_y, depth);
      float along = 0, down = 0, forward = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float offset = point[axis] - camera.position[axis];
        along += offset * camera.right[axis];
        down += offset * camera.down[axis];
        forward += offset * camera.forward[axis];
      }
      if (!(forward > camera.nearest_depth)) {
        flow.x(x, y) = flow.y(x, y) = std::numeric_limits<float>::quiet_NaN();
        continue;
      }
      const float px_a_unit = camera.focal_px * camera.nearness(forward);
      const float disparity = -parallax_px(to.scene.mapping, forward);
      flow.x(x, y) = x_in_left(camera.centre_x_px + px_a_unit * along, disparity) - middle_x;
      flow.y(x, y) = camera.centre_y_px + px_a_unit * down - middle_y;
    }
  });
  return flow;
}

/// Renders the frames of a film; the last two are kept.
class SeenFrames {
 public:
  SeenFrames(ReadyModel model, ParticleFramesOptions options)
      : model_(std::move(model)), options_(std::move(options)) {}

  const SeenModel& at(std::int64_t number) {
    SeenModel& seen = kept_[static_cast<std::size_t>(number % 2)];
    if (seen.number == number) return seen;
    const int frame = static_cast<int>(number);
    const RenderParticlesOptions options = options_of_frame(options_, frame, key_of_frame(options_, frame));
    seen = {.number = number, .scene = scene_of(model_, options)};
    RenderedModel rendered = render_before_wall(
        model_, seen.scene, {options.width, options.height, {left_eye, right_eye}}, options.rendering.method, {});
    seen.pictures = {std::move(rendered.views[0]), std::move(rendered.views[1])};
    seen.left_disparity = std::move(rendered.disparity[0]);
    seen.right_disparity = std::move(rendered.disparity[1]);
    seen.left_depth = std::move(rendered.depth[0]);
    return seen;
  }

  KnownFrame known(std::int64_t number) {
    const SeenModel& now = at(number);
    KnownFrame known{.geometry = geometry_from_both(now.left_disparity, now.right_disparity), .flow = {}};
    if (number == 0) return known;
    const SeenModel& before = at(number - 1);
    known.flow = FlowPair{flow_between(before, now), flow_between(now, before)};
    return known;
  }

 private:
  ReadyModel model_;
  ParticleFramesOptions options_;
  std::array<SeenModel, 2> kept_;
};

}  // namespace

ModelPictures model_pictures(const ReadyModel& model, const RenderParticlesOptions& options, ViewRange wanted,
                             const Progress& progress) {
  const float first = wanted.first.eye_separations(), last = wanted.last.eye_separations();
  // Both eyes, then what is beyond them, and last what lies between: each shows what those before it do not.
  const Rig rig{
      options.width,
      options.height,
      {left_eye, right_eye, wanted.first, wanted.last, ViewPosition(first / 2), ViewPosition(last / 2), central_view}};
  RenderedModel rendered = render_before_wall(model, scene_of(model, options), rig, options.rendering.method, progress);

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

ModelFilm film_of_model(ReadyModel model, ParticleFramesOptions options, Rational rate) {
  const PictureSize size{options.particles.width, options.particles.height};
  const int count = options.count;
  // A std::function can be copied; a model need not be.
  const auto frames = std::make_shared<SeenFrames>(std::move(model), std::move(options));
  return {made_film(size, count, rate, [frames](std::int64_t frame) { return frames->at(frame).pictures; }),
          [frames](std::int64_t frame, const StereoPair& /*eyes*/) { return frames->known(frame); }};
}

}  // namespace wheatstone
