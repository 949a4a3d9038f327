#include "wheatstone/depth/display_presets.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

// Looking Glass: layouts as its makers recommend them (https://lfdocs.lookingglassfactory.com/keyconcepts/quilts; of
// the 27 inch, which that page lacks, as VTK's vtkLookingGlassInterface has them), widths from resolution and pixels an
// inch or from the diagonal, and the 40 degrees of their software; a display's own calibration knows better. A view is
// as large as its place in the quilt. The desk and the nine views are those of Hassaine 2010, sec. 5.6, whose 60 and 36
// planes come out for 10 cm either way at just these widths and distances; the 36 views are those of sec. 2.3. The
// other displays with lenses are kinds of which several were sold; a monitor of 24 inches is assumed, seen from 700 mm,
// where neighbouring views are half an eye separation apart.
constexpr float wide = 16.f / 9, tall = 9.f / 16;
constexpr std::array<DisplayPreset, 19> presets{{
    {"looking-glass-go", 66, 372, 682, 11, 6, 4092, 4092, tall, 74.7f, 350, 40, "Looking Glass Go, 6 inch"},
    {"looking-glass-portrait", 48, 420, 560, 8, 6, 3360, 3360, 0.75f, 120.4f, 450, 40, "Looking Glass Portrait"},
    {"looking-glass-16", 49, 857, 857, 7, 7, 5999, 5999, wide, 344.7f, 700, 40, "Looking Glass 16 inch"},
    {"looking-glass-16-portrait", 66, 545, 1000, 11, 6, 5995, 6000, tall, 193.9f, 700, 40, "the same, upright"},
    {"looking-glass-16-old", 45, 819, 455, 5, 9, 4096, 4096, wide, 344.7f, 700, 40, "the same, older quilts"},
    {"looking-glass-27", 48, 960, 720, 8, 6, 7680, 4320, wide, 597.7f, 1000, 40, "Looking Glass 27 inch"},
    {"looking-glass-27-portrait", 48, 640, 1080, 12, 4, 7680, 4320, tall, 336.2f, 1000, 40, "the same, upright"},
    {"looking-glass-32", 49, 1170, 1170, 7, 7, 8190, 8190, wide, 696.7f, 1200, 40, "Looking Glass 32 inch"},
    {"looking-glass-32-portrait", 66, 744, 1364, 11, 6, 8184, 8184, tall, 391.9f, 1200, 40, "the same, upright"},
    {"looking-glass-32-old", 45, 1638, 910, 5, 9, 8192, 8192, wide, 696.7f, 1200, 40, "the same, older quilts"},
    {"looking-glass-65", 72, 1024, 910, 8, 9, 8192, 8192, wide, 1428, 2000, 40, "Looking Glass 65 inch"},
    {"desk-stereo", 2, 1280, 1024, 0, 0, 0, 0, 1.25f, 376, 750, 0, "19 inch, 1280x1024 for each eye"},
    {"nine-view", 9, 640, 360, 0, 0, 0, 0, wide, 376, 630, 26, "nine views on 1920x1080 pixels"},
    {"philips-36",
     36,
     533,
     400,
     0,
     0,
     0,
     0,
     4.f / 3,
     307,
     700,
     30,
     "36 views on 3200x2400 pixels, 15.1 inch",
     {3200, 2400, 18, 2}},
    {"barrier-2", 2, 960, 540, 0, 0, 0, 0, wide, 531, 700, 0, "two views behind upright slits", {1920, 1080, 2, 0}},
    {"step-5",
     5,
     860,
     484,
     0,
     0,
     0,
     0,
     wide,
     531,
     700,
     10.6f,
     "five views, slant of one sub-pixel a row",
     {1920, 1080, 5, 1}},
    {"step-9",
     9,
     640,
     360,
     0,
     0,
     0,
     0,
     wide,
     531,
     700,
     20.8f,
     "nine views, slant of one sub-pixel a row",
     {1920, 1080, 9, 1}},
    {"lenticular-8", 8, 680, 382, 0, 0, 0, 0, wide, 531, 700, 18.5f, "eight views, slant of 1/6", {1920, 1080, 8, 2}},
    {"philips-9",
     9,
     640,
     360,
     0,
     0,
     0,
     0,
     wide,
     531,
     700,
     20.8f,
     "nine views, 4.5 sub-pixels a lens, slant of 1/6",
     {1920, 1080, 4.5, 2}},
}};

}  // namespace

std::span<const DisplayPreset> display_presets() { return presets; }

const DisplayPreset& find_display(std::string_view name) {
  std::string names;
  for (const DisplayPreset& display : presets) {
    if (display.name == name) return display;
    names += fmt::format(" {}", display.name);
  }
  throw Error(ErrorKind::wrong_usage, fmt::format("no display '{}', expected one of:{}", name, names));
}

ViewingGeometry viewing_of(const DisplayPreset& display) {
  return {.viewing_distance_mm = display.viewing_distance_mm,
          .screen_width_mm = display.screen_width_mm,
          .width_px = display.view_width_px};
}

float span_of(const DisplayPreset& display, float eye_separation_mm) {
  if (display.view_cone_deg == 0) return 1;
  const float half = display.view_cone_deg * std::numbers::pi_v<float> / 360;
  return 2 * display.viewing_distance_mm * std::tan(half) / eye_separation_mm;
}

}  // namespace wheatstone
