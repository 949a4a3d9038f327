#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "wheatstone/display/lenticular.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

/// The screen under a sheet of lenses, by the terms of a calibration.
LenticularScreen screen_under(const LensSheet& lenses) {
  constexpr double dpi = 100;
  const double period = lenses.period_subpixels, rows = lenses.rows_a_subpixel;
  const double slope = rows > 0 ? 3 * rows : 1e9;  // rows a pixel of three sub-pixels
  // As many lenses along a row as periods fit; the formula's cosine is for pitch across the lenses.
  const double pitch = 3 / period * dpi / std::cos(std::atan(1 / slope));
  // The middles of pixels and rows fall on borders between views of slanted lenses; half a sub-pixel puts the middles
  // of sub-pixels into the middles of views.
  const double center = rows > 0 ? 0.5 / period : 0;
  return {.width = lenses.screen_width_px,
          .height = lenses.screen_height_px,
          .pitch = pitch,
          .slope = slope,
          .center = center,
          .dpi = dpi};
}

double number_in(const nlohmann::json& json, const char* key, const std::string& file) {
  const auto found = json.find(key);
  if (found == json.end()) throw Error(ErrorKind::bad_input, fmt::format("{}: has no '{}'", file, key));
  // Looking Glass wraps each number: {"value": 47.6}.
  const nlohmann::json& value = found->is_object() && found->contains("value") ? (*found)["value"] : *found;
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw Error(ErrorKind::bad_input, fmt::format("{}: '{}' is not a number", file, key));
  return value.get<double>();
}

bool switch_in(const nlohmann::json& json, const char* key, bool otherwise, const std::string& file) {
  return json.contains(key) ? number_in(json, key, file) != 0 : otherwise;
}

}  // namespace

LenticularScreen lenticular_screen_of(const DisplayPreset& display) {
  if (display.lenses.screen_width_px == 0)
    throw Error(ErrorKind::wrong_usage, fmt::format("display '{}' has no lenses that are known", display.name));
  return screen_under(display.lenses);
}

LenticularScreen find_lenticular(const std::string& name) {
  if (name.ends_with(".json")) return read_calibration(name);
  std::string names;
  for (const DisplayPreset& display : display_presets()) {
    if (display.lenses.screen_width_px == 0) continue;
    if (name == display.name) return lenticular_screen_of(display);
    names += fmt::format(" {}", display.name);
  }
  throw Error(ErrorKind::wrong_usage,
              fmt::format("no lenticular screen '{}', expected a calibration file (.json) or one of:{}", name, names));
}

LenticularScreen read_calibration(const std::filesystem::path& path) {
  constexpr std::size_t most_bytes = 1 << 20;
  const std::string file = path.string();
  const nlohmann::json json = nlohmann::json::parse(read_whole_file(path, most_bytes), nullptr, false);
  if (!json.is_object())
    throw Error(ErrorKind::bad_input, fmt::format("{}: is not a JSON object, expected a display's calibration", file));
  LenticularScreen screen;
  screen.width = static_cast<int>(std::clamp(number_in(json, "screenW", file), 0., 1e6));
  screen.height = static_cast<int>(std::clamp(number_in(json, "screenH", file), 0., 1e6));
  screen.pitch = number_in(json, "pitch", file);
  screen.slope = number_in(json, "slope", file);
  screen.center = number_in(json, "center", file);
  screen.dpi = number_in(json, "DPI", file);
  screen.flip = switch_in(json, "flipImageX", false, file);
  screen.blue_first = switch_in(json, "flipSubp", false, file);
  screen.first_from_left = !switch_in(json, "invView", true, file);
  constexpr int most_pixels = 32768;
  // Beyond these a lens is narrower than any sub-pixel, or the row is lost to rounding.
  constexpr double most_lenses = 1e6;
  const bool known = screen.width >= 1 && screen.height >= 1 && screen.width <= most_pixels &&
                     screen.height <= most_pixels && screen.slope != 0 && screen.dpi > 0 &&
                     std::abs(screen.pitch * screen.width / screen.dpi) < most_lenses &&
                     std::abs(screen.height / screen.slope) < most_lenses && std::abs(screen.center) < most_lenses;
  if (!known)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: does not describe a valid screen: {}x{} pixels, slope {}, {} DPI, pitch {}, center {}",
                            file, screen.width, screen.height, screen.slope, screen.dpi, screen.pitch, screen.center));
  return screen;
}

}  // namespace wheatstone
