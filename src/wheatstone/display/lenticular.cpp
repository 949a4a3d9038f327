#include "wheatstone/display/lenticular.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/image/whole_file.h"

namespace wheatstone {
namespace {

/// Where a sub-pixel is under its lens, as a sum of steps along the row, of which only the fraction counts.
struct Phase {
  double begin;  // of the row's first sub-pixel
  double a_subpixel;
};

Phase phase_of_row(const LenticularScreen& screen, int y) {
  const double width = screen.width;
  const double lenses = screen.pitch * width / screen.dpi * std::cos(std::atan(1 / screen.slope));
  const double tilt = screen.height / (width * screen.slope) * (screen.flip ? -1 : 1);
  const double up = 1 - (y + 0.5) / screen.height;
  return {(0.5 / width + up * tilt) * lenses - screen.center, lenses / (3 * width)};
}

int view_at(double phase, int views) {
  const double within = phase - std::floor(phase);
  return std::min(static_cast<int>((1 - within) * views), views - 1);
}

struct NamedScreen {
  const char* name;
  LenticularScreen screen;
};

/// A lens every `period` sub-pixels, that leans by one sub-pixel in `rows` rows (0: upright).
LenticularScreen by_period(int width, int height, double period, double rows) {
  constexpr double dpi = 100;
  const double slope = rows > 0 ? 3 * rows : 1e9;  // rows a pixel of three sub-pixels
  // A sub-pixel's middle, not its edge, decides: half a sub-pixel off.
  // As many lenses along a row as periods fit; the formula's cosine is for pitch across the lenses.
  const double pitch = 3 / period * dpi / std::cos(std::atan(1 / slope));
  return {.width = width, .height = height, .pitch = pitch, .slope = slope, .center = 0.5 / period, .dpi = dpi};
}

const std::vector<NamedScreen>& named_screens() {
  static const std::vector<NamedScreen> screens{
      {"barrier-2", by_period(1920, 1080, 2, 0)},   {"step-5", by_period(1920, 1080, 5, 1)},
      {"step-9", by_period(1920, 1080, 9, 1)},      {"lenticular-8", by_period(1920, 1080, 8, 2)},
      {"philips-9", by_period(1920, 1080, 4.5, 2)}, {"philips-36", by_period(3840, 2160, 36. / 7, 2)},
  };
  return screens;
}

double number_in(const nlohmann::json& json, const char* key, const std::string& file) {
  const auto found = json.find(key);
  if (found == json.end()) throw Error(ErrorKind::bad_input, fmt::format("{}: has no '{}'", file, key));
  // Looking Glass wraps each number: {"value": 47.6}.
  const nlohmann::json& value = found->is_object() && found->contains("value") ? (*found)["value"] : *found;
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw Error(ErrorKind::bad_input, fmt::format("{}: '{}' is no number", file, key));
  return value.get<double>();
}

void check(std::span<const Image<Rgb8>> views) {
  if (views.empty()) throw Error(ErrorKind::wrong_usage, "no views to interleave");
  for (const Image<Rgb8>& view : views)
    if (!same_size(view, views.front()) || view.empty())
      throw Error(ErrorKind::wrong_usage, "the views to interleave must be of one size");
}

}  // namespace

int view_of_subpixel(const LenticularScreen& screen, int views, int x, int y, int channel) {
  const Phase phase = phase_of_row(screen, y);
  const int place = screen.blue_first ? 2 - channel : channel;
  return view_at(phase.begin + (3 * x + place) * phase.a_subpixel, views);
}

void views_of_row(const LenticularScreen& screen, int views, int y, std::span<std::uint16_t> three_per_pixel) {
  const Phase phase = phase_of_row(screen, y);
  const int last = screen.blue_first ? 2 : 0;
  for (std::size_t i = 0; i < three_per_pixel.size(); ++i) {
    const std::size_t from_left = last == 0 ? i : i - i % 3 + 2 - i % 3;
    three_per_pixel[i] =
        static_cast<std::uint16_t>(view_at(phase.begin + static_cast<double>(from_left) * phase.a_subpixel, views));
  }
}

Image<Rgb8> interleave(std::span<const Image<Rgb8>> views, const LenticularScreen& screen) {
  check(views);
  const int width = views.front().width();
  const int height = views.front().height();
  std::vector<int> column(screen.width);
  for (int x = 0; x < screen.width; ++x)
    column[x] = static_cast<int>(static_cast<std::int64_t>(2 * x + 1) * width / (2 * screen.width));
  Image<Rgb8> picture(screen.width, screen.height);
  tbb::parallel_for(0, screen.height, [&](int y) {
    const int row = static_cast<int>(static_cast<std::int64_t>(2 * y + 1) * height / (2 * screen.height));
    std::vector<const Rgb8*> rows;
    for (const Image<Rgb8>& view : views) rows.push_back(view.row(row).data());
    std::vector<std::uint16_t> shown(3 * static_cast<std::size_t>(screen.width));
    views_of_row(screen, static_cast<int>(views.size()), y, shown);
    const std::span<Rgb8> to = picture.row(y);
    for (int x = 0; x < screen.width; ++x) {
      const std::uint16_t* const view = shown.data() + 3 * static_cast<std::size_t>(x);
      to[x] = {rows[view[0]][column[x]].r, rows[view[1]][column[x]].g, rows[view[2]][column[x]].b};
    }
  });
  return picture;
}

LenticularScreen find_lenticular(const std::string& name) {
  if (name.ends_with(".json")) return read_calibration(name);
  std::string names;
  for (const NamedScreen& known : named_screens()) {
    if (name == known.name) return known.screen;
    names += fmt::format(" {}", known.name);
  }
  throw Error(ErrorKind::wrong_usage,
              fmt::format("no lenticular screen '{}', expected a calibration file (.json) or one of:{}", name, names));
}

LenticularScreen read_calibration(const std::filesystem::path& path) {
  constexpr std::size_t most_bytes = 1 << 20;
  const std::string file = path.string();
  const nlohmann::json json = nlohmann::json::parse(read_whole_file(path, most_bytes), nullptr, false);
  if (!json.is_object())
    throw Error(ErrorKind::bad_input, fmt::format("{}: is no JSON object, expected a display's calibration", file));
  LenticularScreen screen;
  screen.width = static_cast<int>(std::clamp(number_in(json, "screenW", file), 0., 1e6));
  screen.height = static_cast<int>(std::clamp(number_in(json, "screenH", file), 0., 1e6));
  screen.pitch = number_in(json, "pitch", file);
  screen.slope = number_in(json, "slope", file);
  screen.center = number_in(json, "center", file);
  screen.dpi = number_in(json, "DPI", file);
  screen.flip = json.contains("flipImageX") && number_in(json, "flipImageX", file) != 0;
  constexpr int most_pixels = 32768;
  if (screen.width < 1 || screen.height < 1 || screen.width > most_pixels || screen.height > most_pixels ||
      screen.slope == 0 || !(screen.dpi > 0))
    throw Error(ErrorKind::bad_input, fmt::format("{}: describes no screen: {}x{} pixels, slope {}, {} DPI", file,
                                                  screen.width, screen.height, screen.slope, screen.dpi));
  return screen;
}

}  // namespace wheatstone
