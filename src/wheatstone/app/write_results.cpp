#include "wheatstone/app/write_results.h"

#include <fmt/format.h>
#include <tbb/parallel_for_each.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <mutex>
#include <span>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/display/disparity_picture.h"
#include "wheatstone/drawing/svg.h"
#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone {

namespace {

struct GalleryPicture {
  std::string_view file;  ///< without an ending: in the format of the pictures
  std::string_view caption;
};

constexpr auto gallery_pictures = std::to_array<GalleryPicture>({
    {"left_photograph", "Photograph, left eye"},
    {"right_photograph", "Photograph, right eye"},
    {"left", "Painting, left eye"},
    {"right", "Painting, right eye"},
    {"anaglyph", "Anaglyph, for red–cyan glasses"},
    {"side_by_side", "Side by side, for parallel viewing"},
    {"disparity.png", "Disparity: near is red, far is blue"},
    {"left_occlusion.png", "Seen by the left eye only"},
    {"right_occlusion.png", "Seen by the right eye only"},
});

constexpr std::string_view gallery_title = "A painting for two eyes";
constexpr std::string_view gallery_style = R"(
  body { font: 16px/1.4 sans-serif; margin: 2rem auto; max-width: 80rem; padding: 0 1rem; background: #f6f3ee; color: #222; }
  main { display: grid; grid-template-columns: repeat(auto-fit, minmax(28rem, 1fr)); gap: 1.5rem; }
  figure { margin: 0; } img { width: 100%; display: block; background: #ddd; } figcaption { padding: .4rem 0; }
  pre { background: #fff; padding: 1rem; overflow: auto; }
)";

/// A page that shows the pictures of a result folder, by their names there, and the report's numbers below them.
/// `format` is the ending of the pictures that are painted.
std::string gallery_html(std::string_view format, std::string_view report_json) {
  std::string page = html_head(gallery_title, gallery_style) + fmt::format("<h1>{}</h1>\n<main>\n", gallery_title);
  for (const GalleryPicture& picture : gallery_pictures) {
    const bool has_ending = picture.file.find('.') != std::string_view::npos;
    const std::string file = has_ending ? std::string(picture.file) : fmt::format("{}.{}", picture.file, format);
    page +=
        fmt::format("<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a><figcaption>{1}</figcaption></figure>\n",
                    file, picture.caption);
  }
  page += fmt::format("</main>\n<h2>Numbers</h2>\n<pre>{}</pre>\n</body></html>\n", html_text(report_json));
  return page;
}

/// Diffusion curves lie over the drawn view, which is embedded as PNG, so that the document looks like the painting.
void write_svg(const std::filesystem::path& path, const Painting& painting, ViewPosition view) {
  const std::string ground =
      svg_has_ground(painting) ? encode_png(present(painting, {.views = {view}}).views.front()) : "";
  write_whole_file(path, svg_of(painting, view, ground));
}

/// The results where all views are one picture.
std::vector<std::string> write_flat(OutputFolder& folder, const PaintingReport& told, const ResultOptions& options) {
  const PaintedPair& painted = told.painted.painted;
  write_image(folder.file(fmt::format("painted.{}", options.format)), painted.pictures.left, options.notes);
  write_painting(folder.file("painting.wst"), painted.painting);
  write_whole_file(folder.file("report.json"), report_json(told));
  if (options.svg) write_svg(folder.file("painted.svg"), painted.painting, central_view);
  folder.commit();
  return result_names({.flat = true, .svg = options.svg, .format = options.format});
}

/// A file of the results.
struct Output {
  std::string name;
  std::function<void(const std::filesystem::path&)> write;
  bool is_plain = false;  ///< written by one thread, because nothing is encoded
};

/// Writes all files of a result whose pictures have this size.
void write_all(std::span<const Output> outputs, OutputFolder& folder, PictureSize size, const Progress& progress) {
  std::mutex reporting;
  std::size_t written = 0;
  report(progress, "writing", 0);
  const auto write = [&](const Output& output) {
    output.write(folder.file(output.name));
    const std::scoped_lock lock(reporting);
    report(progress, "writing", static_cast<double>(++written) / static_cast<double>(outputs.size()));
  };
  if (!is_large(size)) {
    tbb::parallel_for_each(outputs, write);
    return;
  }
  // Encoders of large files use all threads: they take turns, because all of them at once would only take more memory.
  // Plain files are written meanwhile.
  const auto write_where = [&](bool is_plain) {
    for (const Output& output : outputs)
      if (output.is_plain == is_plain) write(output);
  };
  tbb::parallel_invoke([&] { write_where(true); }, [&] { write_where(false); });
}

}  // namespace

std::vector<std::string> result_names(const ResultOptions& options) {
  std::vector<std::string> names;
  const auto add_pictures = [&](std::initializer_list<const char*> pictures) {
    for (const char* picture : pictures) names.push_back(fmt::format("{}.{}", picture, options.format));
  };
  if (options.flat) {
    add_pictures({"painted"});
    names.insert(names.end(), {"painting.wst", "report.json"});
    if (options.svg) names.emplace_back("painted.svg");
    return names;
  }
  add_pictures({"left", "right", "side_by_side", "anaglyph"});
  names.insert(names.end(), {"disparity.png", "left_disparity.pfm", "left_disparity.png", "right_disparity.pfm",
                             "left_occlusion.png", "right_occlusion.png", "painting.wst", "report.json"});
  if (options.svg) names.insert(names.end(), {"left.svg", "right.svg"});
  if (options.photographs || options.html) add_pictures({"left_photograph", "right_photograph"});
  if (options.html) names.emplace_back("index.html");
  return names;
}

std::vector<std::string> write_results(OutputFolder& folder, const StereoPair& photographs, const PaintingReport& told,
                                       const ResultOptions& options, const Progress& progress) {
  using Path = std::filesystem::path;
  const PaintedPhotograph& result = told.painted;
  const StereoPair& pictures = result.painted.pictures;
  const StereoGeometry& geometry = result.geometry;
  const Painting& painting = result.painted.painting;
  if (pictures.right.empty()) return write_flat(folder, told, options);
  const float separation = result.painted.separation;
  const auto presented = [&] {
    return set_convergence(separation < 1 ? result.painted.nearer : pictures, separation * result.zero_parallax_px);
  };
  const auto picture = [&](const char* name) { return fmt::format("{}.{}", name, options.format); };
  std::vector<Output> outputs{
      {picture("left"), [&](const Path& path) { write_image(path, pictures.left, options.notes); }},
      {picture("right"), [&](const Path& path) { write_image(path, pictures.right, options.notes); }},
      {picture("side_by_side"), [&](const Path& path) { write_image(path, side_by_side(presented()), options.notes); }},
      {picture("anaglyph"), [&](const Path& path) { write_image(path, anaglyph(presented()), options.notes); }},
      {"disparity.png", [&](const Path& path) { write_image(path, disparity_picture(geometry.left_disparity)); }},
      {"left_disparity.pfm", [&](const Path& path) { write_disparity(path, geometry.left_disparity); }, true},
      {"left_disparity.png", [&](const Path& path) { write_disparity(path, geometry.left_disparity); }},
      {"right_disparity.pfm", [&](const Path& path) { write_disparity(path, geometry.right_disparity); }, true},
      {"left_occlusion.png", [&](const Path& path) { write_image(path, geometry.left_occlusion); }},
      {"right_occlusion.png", [&](const Path& path) { write_image(path, geometry.right_occlusion); }},
      {"painting.wst", [&](const Path& path) { write_painting(path, painting); }},
      {"report.json", [&](const Path& path) { write_whole_file(path, report_json(told)); }, true},
  };
  if (options.svg) {
    outputs.push_back({"left.svg", [&](const Path& path) { write_svg(path, painting, left_eye); }});
    outputs.push_back({"right.svg", [&](const Path& path) { write_svg(path, painting, right_eye); }});
  }
  if (options.photographs || options.html) {
    outputs.push_back(
        {picture("left_photograph"), [&](const Path& path) { write_image(path, photographs.left, options.notes); }});
    outputs.push_back(
        {picture("right_photograph"), [&](const Path& path) { write_image(path, photographs.right, options.notes); }});
  }
  if (options.html) {
    outputs.push_back(
        {"index.html",
         [&](const Path& path) { write_whole_file(path, gallery_html(options.format, report_json(told))); }, true});
  }

  write_all(outputs, folder, {pictures.left.width(), pictures.left.height()}, progress);
  folder.commit();
  std::vector<std::string> names;
  for (const Output& output : outputs) names.push_back(output.name);
  return names;
}

Painting scaled(const Painting& painting, double scale) {
  constexpr double largest_side_px = 65535;
  const double width = std::round(width_of(painting) * scale), height = std::round(height_of(painting) * scale);
  if (!(width >= 1 && height >= 1 && width <= largest_side_px && height <= largest_side_px))
    throw Error(ErrorKind::wrong_usage, fmt::format("a scale of {} makes {}x{} pixels, expected 1 to {} a side", scale,
                                                    width, height, largest_side_px));
  return placed(painting, {.scale = scale});
}

namespace {

/// Whether all marks lie at disparity 0: all views show the same picture.
bool is_flat(const Painting& painting) {
  const std::vector<float> disparities = disparities_of_marks(painting);
  return !disparities.empty() && std::ranges::all_of(disparities, [](float disparity) { return disparity == 0; });
}

void draw_flat_again(const Painting& painting, OutputFolder& folder, const RedrawOptions& options) {
  const Presented shown = present(painting, {.views = {central_view}, .device = options.device});
  write_image(folder.file(fmt::format("painted.{}", options.format)), shown.views.front());
  if (options.svg) write_svg(folder.file("painted.svg"), painting, central_view);
  folder.commit();
}

}  // namespace

void draw_again(const Painting& painting, OutputFolder& folder, const RedrawOptions& options,
                const Progress& progress) {
  Painting sized = scaled(painting, options.scale);
  if (options.zero_parallax_px) shared_width(width_of(sized), *options.zero_parallax_px);
  const int width = width_of(sized);
  sized = place_depth(std::move(sized), options.depth, width);
  const bool is_placed = !options.depth.regions.empty();
  if (!is_placed && is_flat(sized)) return draw_flat_again(sized, folder, options);
  report(progress, "drawing", 0);
  const float separation = is_placed ? 1 : comfortable_separation(sized, options.depth_budget);
  Presentation presentation = for_own_and_nearer_eyes(separation);
  presentation.device = options.device;
  const std::vector<Image<Rgb8>> views = present(sized, presentation).views;
  const float zero_parallax_px = is_placed ? 0 : options.zero_parallax_px.value_or(nearest_disparity(sized));
  const StereoPairView presented =
      set_convergence({views[views.size() - 2], views[views.size() - 1]}, separation * zero_parallax_px);
  report(progress, "writing", 0);
  const auto picture = [&](const char* name) { return folder.file(fmt::format("{}.{}", name, options.format)); };
  write_image(picture("left"), views[0]);
  write_image(picture("right"), views[1]);
  write_image(picture("side_by_side"), side_by_side(presented));
  write_image(picture("anaglyph"), anaglyph(presented));
  if (options.svg) {
    write_svg(folder.file("left.svg"), sized, left_eye);
    write_svg(folder.file("right.svg"), sized, right_eye);
  }
  folder.commit();
}

}  // namespace wheatstone
