// How quickly the window's pictures follow what the user does: medians of what the drawing thread takes for a picture,
// without a window. Beside each figure stands how many that makes a second, and the aim.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "stopwatch.h"
#include "viewer/painting.h"
#include "viewer/stage.h"
#include "viewer/viewer.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/particles/framed_region.h"
#include "wheatstone/stopwatch.h"
#include "wheatstone/synthetic/synthetic_still.h"
#include "wheatstone/synthetic/synthetic_universe.h"

using namespace wheatstone;
using namespace wheatstone::viewer;

namespace {

using bench::median;
using bench::seconds_of;

/// The median of what `step` takes, called with 1, 2, … after once with 0.
double median_of(int steps, const std::function<void(int)>& step) {
  step(0);
  std::vector<double> seconds;
  for (int i = 1; i <= steps; ++i) seconds.push_back(seconds_of([&] { step(i); }));
  return median(std::move(seconds));
}

void print_rate(std::string_view what, double seconds, double aim) {
  fmt::print("{:<58} {:8.1f} ms {:8.1f} a second (aim {:.0f})\n", what, 1000 * seconds, 1 / seconds, aim);
}

void print_time(std::string_view what, double seconds, double aim_s) {
  fmt::print("{:<58} {:8.1f} ms {:>22}\n", what, 1000 * seconds, fmt::format("(aim {:.0f} ms)", 1000 * aim_s));
}

void measure_painting(const SyntheticStill& still) {
  const PaintedContent content{std::make_shared<const Painting>(plan_painting(still.pictures, still.geometry, {})), {}};
  const Viewport viewport{640, 480};
  Stage stage;
  ViewState state;
  print_rate("painting 640x480, both eyes, the head moves",
             median_of(15,
                       [&](int i) {
                         state.head = 0.02f * static_cast<float>(i);
                         stage.draw(content, state, viewport);
                       }),
             10);
  print_rate("painting 640x480, zero parallax moves",
             median_of(31,
                       [&](int i) {
                         state.adjustment.zero_parallax_px = static_cast<float>(i);
                         stage.draw(content, state, viewport);
                       }),
             30);
  print_rate("painting 640x480, more depth follows the gaze",
             median_of(15,
                       [&](int i) {
                         state.depth_around = DepthAround{.x = 300 + static_cast<float>(i),
                                                          .y = 240,
                                                          .disparity_px = 20,
                                                          .gain_there = 1.5f,
                                                          .gain_elsewhere = 0.5f,
                                                          .radius_px = 128};
                         stage.draw(content, state, viewport);
                       }),
             10);
}

void measure_style(const SyntheticStill& still) {
  auto photograph = std::make_shared<Photograph>();
  photograph->pictures = still.pictures;
  photograph->geometry = still.geometry;
  std::vector<double> delivered;
  double planning = 0;
  for (int run = 0; run < 3; ++run) {
    delivered.clear();
    double passed = 0;
    auto watch = std::make_unique<Stopwatch>(passed);
    StrokeFits nothing_kept;
    paint_in_steps({{}, photograph}, {}, {}, nothing_kept, {}, [&](const PaintedContent&) {
      watch.reset();
      delivered.push_back(passed);
      watch = std::make_unique<Stopwatch>(passed);
    });
    planning = seconds_of([&] { plan_painting(still.pictures, still.geometry, {}); });
  }
  print_time("style changed, 640x480: coarse", delivered.front(), 0.2);
  fmt::print("{:<58} {:8.1f} ms {:8.2f} x planning alone\n", "style changed, 640x480: fine", 1000 * delivered.back(),
             delivered.back() / planning);
}

/// From a touch by hand to a drawn picture in which it shows, and until all is planned again, in the whole viewer.
void measure_touches() {
  const SyntheticStill still = make_synthetic_still({.width = 1920, .height = 1080, .samples_a_side = 1});
  auto photograph = std::make_shared<Photograph>();
  photograph->pictures = still.pictures;
  photograph->geometry = still.geometry;
  photograph->detail.emplace();
  Viewer viewer;
  viewer.set_viewport({1920, 1080});
  Session& session = viewer.session();
  session.state.style = style_by_name("oil");
  session.state.mode = "left-right";
  session.opened.content.emplace<PaintedContent>().photograph = photograph;
  session.opened.is_ready = true;
  viewer.paint();
  viewer.wait();
  const auto shown_after = [&](const Touch& touch) {
    const auto pixels = viewer.frame()->picture.pixels();
    const std::vector<Rgb8> before(pixels.begin(), pixels.end());
    const auto is_as_before = [&] { return std::ranges::equal(viewer.frame()->picture.pixels(), before); };
    return seconds_of([&] {
      viewer.touch(touch);
      for (auto seen = viewer.frames_drawn(); viewer.is_busy() && (viewer.frames_drawn() == seen || is_as_before());) {
        seen = viewer.frames_drawn();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        viewer.collect();
      }
    });
  };
  for (const auto& [kind, what, amount] :
       {std::tuple{Retouch::shift, "depth", 4.f}, {Retouch::detail, "detail", 60.f}, {Retouch::paint, "paint", 0.f}}) {
    std::vector<double> shown, planned;
    for (int i = 0; i <= 9; ++i) {
      const Touch touch{
          .kind = kind, .x = 200 + 160 * static_cast<float>(i), .y = 500, .radius_px = 20, .amount = amount};
      const double first = shown_after(touch);
      const double rest = seconds_of([&] { viewer.wait(); });
      if (i == 0) continue;
      shown.push_back(first);
      planned.push_back(first + rest);
    }
    print_time(fmt::format("touch of {}, 1920x1080, both eyes: it shows", what), median(shown), 0.2);
    fmt::print("{:<58} {:8.1f} ms\n", "  planned again for all views, and drawn", 1000 * median(planned));
  }
}

void measure_first_picture() {
  auto photograph = std::make_shared<Photograph>();
  photograph->pictures = {Image<Rgb8>(4000, 3000, {90, 120, 60}), Image<Rgb8>(4000, 3000, {90, 120, 60})};
  const PaintedContent content{{}, photograph};
  const double seconds = seconds_of([&] { Stage().draw(content, {}, {960, 640}); });
  print_time("photograph 4000x3000, first picture", seconds, 0.5);
}

void measure_particles() {
  auto particles = std::make_shared<Particles>();
  particles->cloud = make_synthetic_universe({.particles = 1'000'000});
  particles->statistics.add(particles->cloud);
  particles->statistics.framed = framed_region(particles->statistics, {});
  const ParticlesContent content{particles};
  const Viewport viewport{1280, 360};
  for (const auto& [effort, what, aim] :
       {std::tuple{Effort::quick, "quick", 5.}, std::tuple{Effort::whole, "all", 5.}}) {
    Stage stage;
    ViewState state;
    state.mode = "left-right";
    print_rate(fmt::format("1 M particles, two eyes 640x360, orbit: {}", what),
               median_of(9,
                         [&, used = effort](int i) {
                           state.orbit.azimuth_deg = 30 + static_cast<float>(i);
                           stage.draw(content, state, viewport, used);
                         }),
               aim);
  }
}

}  // namespace

int main() {
  const SyntheticStill still = make_synthetic_still({.width = 640, .height = 480, .samples_a_side = 1});
  measure_painting(still);
  measure_style(still);
  measure_touches();
  measure_first_picture();
  measure_particles();
}
