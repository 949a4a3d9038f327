#include "wheatstone/study/simulated_display.h"

#include <cmath>

namespace wheatstone {
namespace {

/// The nearest of views that are `spacing_mm` apart, one of which is in the middle.
float nearest_view(float x_mm, float spacing_mm) { return std::round(x_mm / spacing_mm) * spacing_mm; }

}  // namespace

ViewingGeometry StudyScreen::viewing() const {
  return {.eye_separation_mm = eye_separation_mm,
          .viewing_distance_mm = viewing_distance_mm,
          .screen_width_mm = width_mm,
          .width_px = width_px};
}

std::array<SimulatedView, 2> shown_views(const SimulatedDisplay& display, const StudyScreen& screen,
                                         const HeadPlace& head) {
  const bool fixed = display.views_per_10cm <= 0;
  const float spacing = fixed ? screen.eye_separation_mm : 100 / display.views_per_10cm;
  const float distance = fixed || !display.tracks_distance ? screen.viewing_distance_mm : head.distance_mm;
  const auto view_of = [&](float side) {
    const float offset = side * screen.eye_separation_mm;
    if (fixed) return offset;
    return display.quantised == Quantised::head ? nearest_view(head.x_mm, spacing) + offset
                                                : nearest_view(head.x_mm + offset, spacing);
  };
  const auto shown = [&](float x) {
    return SimulatedView{{x, distance}, {EyePlace{x - spacing, distance}, EyePlace{x + spacing, distance}}};
  };
  const float left = view_of(-0.5f);
  return {shown(left), shown(display.monoscopic ? left : view_of(0.5f))};
}

std::array<float, 2> on_screen_px(const StudyScreen& screen, const EyePlace& eye, const PlaceMm& place) {
  const float along = eye.distance_mm / (eye.distance_mm + place[2]);
  const float x_mm = eye.x_mm + along * (place[0] - eye.x_mm);
  const float y_mm = along * place[1];
  const float pitch = screen.pixel_pitch_mm();
  return {static_cast<float>(screen.width_px) / 2 + x_mm / pitch,
          static_cast<float>(screen.height_px) / 2 + y_mm / pitch};
}

PlaceMm perceived_place(const StudyScreen& screen, const std::array<EyePlace, 2>& eyes,
                        const std::array<std::array<float, 2>, 2>& shown_px) {
  const float pitch = screen.pixel_pitch_mm();
  const auto x_mm = [&](std::size_t eye) {
    return (shown_px[eye][0] - static_cast<float>(screen.width_px) / 2) * pitch;
  };
  const float y_mm = ((shown_px[0][1] + shown_px[1][1]) / 2 - static_cast<float>(screen.height_px) / 2) * pitch;
  // Both lines: x = x_eye + along · (x_screen − x_eye), with the eyes equally far from the screen.
  const float apart = eyes[1].x_mm - eyes[0].x_mm;
  const float along = apart / (apart - (x_mm(1) - x_mm(0)));
  const float distance = (eyes[0].distance_mm + eyes[1].distance_mm) / 2;
  return {eyes[0].x_mm + along * (x_mm(0) - eyes[0].x_mm), along * y_mm, distance * (along - 1)};
}

}  // namespace wheatstone
