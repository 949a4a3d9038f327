#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "commands.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

struct DepthCommandArguments {
  Given given;
  std::string display = "376x301,mm";
  PictureSize resolution{1280, 1024};
  ViewingGeometry viewing{.viewing_distance_mm = 750};
  float near_mm = 100, far_mm = 100;
};

/// Width in mm of "376x301,mm", "14.8x11.9,in" or "37.6x30.1,cm".
float screen_width(const std::string& text) {
  const std::size_t comma = text.find(',');
  const std::string unit = comma == std::string::npos ? "mm" : text.substr(comma + 1);
  const double scale = unit == "mm" ? 1 : unit == "cm" ? 10 : unit == "in" ? 25.4 : 0;
  if (!(scale > 0))
    throw Error(ErrorKind::wrong_usage, fmt::format("--display: is '{}', expected WIDTHxHEIGHT,mm", text));
  const auto size =
      parse_numbers("--display", text.substr(0, comma), {'x', 2, {0.001, 1e6}, "a name or WIDTHxHEIGHT,mm"});
  return static_cast<float>(scale * size[0]);
}

bool is_named(const DepthCommandArguments& arguments) {
  return std::isalpha(static_cast<unsigned char>(arguments.display.c_str()[0]));
}

/// The screen by its sizes, or by its name.
ViewingGeometry viewing_from(const DepthCommandArguments& arguments) {
  ViewingGeometry viewing = arguments.viewing;
  if (is_named(arguments)) {
    const ViewingGeometry preset = viewing_of(find_display(arguments.display));
    viewing.screen_width_mm = preset.screen_width_mm;
    viewing.width_px = preset.width_px;
    if (!arguments.given("--distance")) viewing.viewing_distance_mm = preset.viewing_distance_mm;
    return viewing;
  }
  viewing.screen_width_mm = screen_width(arguments.display);
  viewing.width_px = arguments.resolution.width;
  return viewing;
}

Report run_depth(const DepthCommandArguments& arguments, const Session& /*session*/) {
  const ViewingGeometry viewing = viewing_from(arguments);
  if (arguments.near_mm >= viewing.viewing_distance_mm)
    throw Error(ErrorKind::wrong_usage, fmt::format("--near: {} mm is behind the viewer, who is {} mm away",
                                                    arguments.near_mm, viewing.viewing_distance_mm));
  const float pitch = viewing.pixel_pitch_mm();
  const float before = screen_parallax_mm(viewing, -arguments.near_mm);
  const float behind = screen_parallax_mm(viewing, arguments.far_mm);
  const float planes = stereoscopic_resolution(viewing, arguments.near_mm, arguments.far_mm);
  const float percent = total_parallax_percent(viewing, arguments.near_mm, arguments.far_mm);
  const auto warnings = discomforts(viewing, arguments.near_mm, arguments.far_mm);
  const float one_before = -perceived_depth_mm(viewing, -pitch), one_behind = perceived_depth_mm(viewing, pitch);
  const auto parallax = [&](float depth_mm, const char* where, float parallax_mm, float signed_depth_mm) {
    return fmt::format("{:.0f} mm {} the screen: parallax {:.2f} mm, {:.1f} pixels, {:.2f} degrees", depth_mm, where,
                       parallax_mm, parallax_mm / pitch, angular_disparity_deg(viewing, signed_depth_mm));
  };
  return {
      {{"pixel_pitch_mm", pitch,
        fmt::format(
            "screen: {:.0f} mm wide, {} pixels a view, {:.4f} mm a pixel; seen from {:.0f} mm, eyes {:.0f} mm apart",
            viewing.screen_width_mm, viewing.width_px, pitch, viewing.viewing_distance_mm, viewing.eye_separation_mm)},
       {"nearest_parallax_px", before / pitch, parallax(arguments.near_mm, "in front of", before, -arguments.near_mm)},
       {"farthest_parallax_px", behind / pitch, parallax(arguments.far_mm, "behind", behind, arguments.far_mm)},
       {"depth_planes", planes, fmt::format("depth planes: {:.1f}", planes)},
       {"pixel_in_front_mm", one_before,
        fmt::format("one pixel of parallax: {:.1f} mm in front of the screen, {:.1f} mm behind it", one_before,
                    one_behind)},
       {"pixel_behind_mm", one_behind},
       {"total_parallax_percent", percent, fmt::format("total parallax: {:.1f} % of the width", percent)},
       {"warnings", warnings, lines("comfort: ", warnings)}}};
}

Rows depth_command_rows(DepthCommandArguments& a) {
  ViewingGeometry& viewing = a.viewing;
  return {
      row("--display", text(a.display), "Size of the screen, WIDTHxHEIGHT,mm (or cm, in), or the name of a display"),
      row("--resolution", size(a.resolution, {1, 1e6}), "Size of one view in pixels: WIDTHxHEIGHT",
          {when([&a] { return is_named(a); }, "with a display's name; the display has its own")}),
      row("--distance", length(viewing.viewing_distance_mm, {1, 1e6}), "Viewing distance, in mm"),
      row("--eye", length(viewing.eye_separation_mm, {1, 1000}),
          "Eye separation, or the width of a viewing window, in mm"),
      row("--near", length(a.near_mm, {0, 1e6}), "Depth in front of the screen, in mm"),
      row("--far", length(a.far_mm, {0, 1e9}), "Depth behind the screen, in mm")};
}

}  // namespace

Command depth_command() {
  return make_command("depth", "Compute how much depth a display shows, and in how many planes", depth_command_rows,
                      run_depth,
                      R"(Examples; the first display has 60 planes, the second 36:
  wheatstone depth --display 376x301,mm --resolution 1280x1024 --distance 750
  wheatstone depth --display 376x212,mm --resolution 640x360 --distance 630)");
}

}  // namespace wheatstone::cli
