#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cctype>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "number_arguments.h"
#include "option_use.h"
#include "print_facts.h"
#include "typed_options.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

struct DepthCommandArguments {
  std::string display = "376x301,mm";
  std::string resolution = "1280x1024";
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

/// The screen by its sizes, or by its name.
ViewingGeometry viewing_from(const DepthCommandArguments& arguments, const CLI::App& command) {
  ViewingGeometry viewing = arguments.viewing;
  if (std::isalpha(static_cast<unsigned char>(arguments.display.c_str()[0]))) {
    refuse_options(command, {"--resolution"}, "with a display's name", "the display has its own");
    const ViewingGeometry preset = viewing_of(find_display(arguments.display));
    viewing.screen_width_mm = preset.screen_width_mm;
    viewing.width_px = preset.width_px;
    if (command.count("--distance") == 0) viewing.viewing_distance_mm = preset.viewing_distance_mm;
    return viewing;
  }
  viewing.screen_width_mm = screen_width(arguments.display);
  viewing.width_px = parse_size("--resolution", arguments.resolution, {1, 1e6}).width;
  return viewing;
}

void run_depth(const DepthCommandArguments& arguments, const CLI::App& command, const Session& session) {
  const ViewingGeometry viewing = viewing_from(arguments, command);
  if (arguments.near_mm >= viewing.viewing_distance_mm)
    throw Error(ErrorKind::wrong_usage, fmt::format("--near: {} mm is behind the viewer, who is {} mm away",
                                                    arguments.near_mm, viewing.viewing_distance_mm));
  const float pitch = viewing.pixel_pitch_mm();
  const float before = screen_parallax_mm(viewing, -arguments.near_mm);
  const float behind = screen_parallax_mm(viewing, arguments.far_mm);
  const float planes = stereoscopic_resolution(viewing, arguments.near_mm, arguments.far_mm);
  const float percent = total_parallax_percent(viewing, arguments.near_mm, arguments.far_mm);
  const auto warnings = discomforts(viewing, arguments.near_mm, arguments.far_mm);
  if (session.json) {
    const nlohmann::ordered_json facts{{"pixel_pitch_mm", pitch},
                                       {"nearest_parallax_px", before / pitch},
                                       {"farthest_parallax_px", behind / pitch},
                                       {"depth_planes", planes},
                                       {"total_parallax_percent", percent},
                                       {"pixel_in_front_mm", -perceived_depth_mm(viewing, -pitch)},
                                       {"pixel_behind_mm", perceived_depth_mm(viewing, pitch)},
                                       {"warnings", warnings}};
    print_facts(facts, session);
    return;
  }
  fmt::print(session.output,
             "screen: {:.0f} mm wide, {} pixels a view, {:.4f} mm a pixel; seen from {:.0f} mm, eyes {:.0f} mm apart\n",
             viewing.screen_width_mm, viewing.width_px, pitch, viewing.viewing_distance_mm, viewing.eye_separation_mm);
  fmt::print(session.output, "{:.0f} mm in front of the screen: parallax {:.2f} mm, {:.1f} pixels, {:.2f} degrees\n",
             arguments.near_mm, before, before / pitch, angular_disparity_deg(viewing, -arguments.near_mm));
  fmt::print(session.output, "{:.0f} mm behind the screen: parallax {:.2f} mm, {:.1f} pixels, {:.2f} degrees\n",
             arguments.far_mm, behind, behind / pitch, angular_disparity_deg(viewing, arguments.far_mm));
  fmt::print(session.output, "depth planes: {:.1f}\n", planes);
  fmt::print(session.output, "one pixel of parallax: {:.1f} mm in front of the screen, {:.1f} mm behind it\n",
             -perceived_depth_mm(viewing, -pitch), perceived_depth_mm(viewing, pitch));
  fmt::print(session.output, "total parallax: {:.1f} % of the width\n", percent);
  for (const std::string& warning : warnings) fmt::print(session.output, "comfort: {}\n", warning);
}

}  // namespace

void add_depth_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<DepthCommandArguments>();
  CLI::App* command = program.add_subcommand("depth", "Compute how much depth a display shows, and in how many planes");
  command
      ->add_option("--display", arguments->display,
                   "Size of the screen, WIDTHxHEIGHT,mm (or cm, in), or the name of a display")
      ->capture_default_str();
  command->add_option("--resolution", arguments->resolution, "Size of one view in pixels: WIDTHxHEIGHT")
      ->capture_default_str();
  ViewingGeometry& viewing = arguments->viewing;
  add_length(*command, "--distance", viewing.viewing_distance_mm, {1, 1e6}, "Viewing distance, in mm");
  add_length(*command, "--eye", viewing.eye_separation_mm, {1, 1000},
             "Eye separation, or the width of a viewing window, in mm");
  add_length(*command, "--near", arguments->near_mm, {0, 1e6}, "Depth in front of the screen, in mm");
  add_length(*command, "--far", arguments->far_mm, {0, 1e9}, "Depth behind the screen, in mm");
  command->footer(
      "Examples; the first display has 60 planes, the second 36:\n"
      "  wheatstone depth --display 376x301,mm --resolution 1280x1024 --distance 750\n"
      "  wheatstone depth --display 376x212,mm --resolution 640x360 --distance 630");
  command->callback([arguments, command, &session] { run_depth(*arguments, *command, session); });
}

}  // namespace wheatstone::cli
