#include "model_drawer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace wheatstone::viewer {
namespace {

constexpr double least_scale = 0.25;

double pixels_of(const Rig& rig) {
  return static_cast<double>(rig.width) * rig.height * static_cast<double>(rig.positions.size());
}

}  // namespace

DrawnModel ModelDrawer::draw(const ReadyModel& model, const ViewState& state, Rig rig, Effort effort) {
  DrawnModel drawn;
  while (effort == Effort::quick && drawn.scale > least_scale && pixels_of(rig) * seconds_a_pixel_ > quick_s) {
    drawn.scale /= 2;
    rig.width = std::max((rig.width + 1) / 2, 1);
    rig.height = std::max((rig.height + 1) / 2, 1);
  }
  RenderParticlesOptions options = render_options(state, rig);
  options.values = drawn.scale == 1;
  const auto start = std::chrono::steady_clock::now();
  RenderedParticles rendered = render_ready(model, options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  seconds_a_pixel_ += 0.5 * (seconds / pixels_of(rig) - seconds_a_pixel_);
  drawn.views = std::move(rendered.rendered.views);
  if (!options.values) return drawn;
  auto depth = std::make_shared<std::vector<Image<float>>>();
  for (auto& values : rendered.values) depth->push_back(std::move(values.mean));
  drawn.depth = std::move(depth);
  return drawn;
}

}  // namespace wheatstone::viewer
