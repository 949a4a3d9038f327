#include "display_argument.h"

#include <fmt/format.h>

#include <filesystem>

#include "wheatstone/app/eyes_in_film.h"
#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

bool is_for_films(const DisplayPreset& display) {
  return display.quilt_columns > 0 || display.lenses.screen_width_px > 0;
}

}  // namespace

DisplayViewsOptions display_views_options(const DisplayPreset& display, const DisplayArguments& arguments) {
  DisplayViewsOptions options = views_of_display(display);
  if (arguments.views > 0) options.views = arguments.views;
  options.span = arguments.span;
  options.framing = arguments.framing;
  if (arguments.size) {
    options.width = arguments.size->width;
    options.height = arguments.size->height;
  }
  return options;
}

std::string display_names(bool (*is_listed)(const DisplayPreset&)) {
  std::string names;
  for (const DisplayPreset& preset : display_presets())
    if (is_listed(preset)) names += fmt::format(" {}", preset.name);
  return names;
}

Rows display_view_rows(DisplayArguments& a, const Reasons& unless) {
  return {row("--size", size(a.size, view_side_range), "Size of a view, WIDTHxHEIGHT; the display's own by default",
              unless, "--display"),
          row("--span", without_default(number(a.span, {0.01, view_span_range.most})),
              "Distance from the first view to the last, in eye separations; chosen from the depth by default", unless,
              "--display")};
}

Row framing_row(ViewFraming& framing, std::string_view frame, Reasons unless) {
  const auto parse = [](const std::string& option, const std::string& words) {
    return parse_view_framing(words, option);
  };
  return row(
      "--framing", parsed(framing, parse, "fit|fill|X,Y,ZOOM", "fill"),
      fmt::format(
          "Framing of pictures of another shape {}: fit shows them whole; fill cuts off two sides; X,Y,ZOOM puts the "
          "place X,Y (0 to 1, from the upper left corner) in the middle, ZOOM times as large as with fill",
          frame),
      std::move(unless));
}

Rows film_display_rows(DisplayArguments& a, const Reasons& unless_display) {
  const Rows display{row("--display", text(a.name),
                         "Paint the film for a display with many views: each frame becomes one quilt, or one picture "
                         "for the display's lenses:" +
                             display_names(is_for_films),
                         unless_display)};
  const Rows framing{
      framing_row(a.framing, "on the display", {when([&a] { return a.name.empty(); }, "without --display")})};
  return under("Display", join({display, display_view_rows(a), framing}));
}

Value depth_regions(std::vector<DepthRegion>& regions) {
  return parsed(regions,
                [](const std::string& option, const std::string& words) { return parse_depth_regions(words, option); });
}

Value depth_budget(std::optional<float>& budget) {
  const auto parse = [](const std::string& option, const std::string& words) -> std::optional<float> {
    if (words == "full") return std::nullopt;
    return parse_share(option, words, {0.1, 100});
  };
  return parsed(budget, parse, "SHARE", "3%");
}

Value quilt_layout(std::optional<QuiltLayout>& layout) {
  return parsed(layout, [](const std::string& option, const std::string& words) {
    const PictureSize size = parse_size(option, words, {1, 1000}, "COLUMNSxROWS");
    return QuiltLayout{size.width, size.height};
  });
}

std::optional<FilmDisplay> film_display_from(const DisplayArguments& arguments) {
  if (arguments.name.empty()) return {};
  const DisplayPreset& display = find_display(arguments.name);
  if (!is_for_films(display))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--display: {} takes neither quilts nor lenticular pictures; for two eyes use "
                            "--output-layout, for separate views 'paint --display' on saved marks",
                            arguments.name));
  FilmDisplay wanted{.views = display_views_options(display, arguments), .quilt = {}, .screen = {}};
  if (display.quilt_columns > 0) {
    wanted.quilt = QuiltLayout{display.quilt_columns, display.quilt_rows};
  } else {
    wanted.screen = lenticular_screen_of(display);
  }
  return wanted;
}

std::string name_of_display_film(const std::string& output, const DisplayArguments& arguments) {
  const DisplayPreset& display = find_display(arguments.name);
  std::optional<QuiltLayout> quilt;
  if (display.quilt_columns > 0) quilt = {display.quilt_columns, display.quilt_rows};
  return name_of_film(output, quilt, display.aspect);
}

std::string name_of_film(const std::string& output, const std::optional<QuiltLayout>& quilt, double aspect) {
  const fs::path path = output;
  if (path.has_extension()) return output;
  if (!quilt) return output + ".mp4";
  const std::string name = quilt_name(path.filename().string(), *quilt, aspect);
  return (path.parent_path() / fs::path(name).replace_extension(".mp4")).string();
}

std::string codec_for(const FilmDisplay& display) {
  constexpr int most_macroblocks = 36864, macroblock_px = 16;
  const auto blocks = [](int side_px) { return (side_px + macroblock_px - 1) / macroblock_px; };
  const int width = display.quilt ? display.quilt->columns * display.views.width : display.screen->width;
  const int height = display.quilt ? display.quilt->rows * display.views.height : display.screen->height;
  return blocks(width) * blocks(height) <= most_macroblocks ? "h264" : "hevc";
}

void choose_coding(const Given& given, const FilmDisplay& display, FilmWriterOptions& writing) {
  if (!given("--codec")) writing.codec = codec_for(display);
  // Neighbouring sub-pixels belong to different views.
  if (!display.quilt) keep_full_colour(writing);
}

}  // namespace wheatstone::cli
