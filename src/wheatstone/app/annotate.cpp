#include "wheatstone/app/annotate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/multiview/colour_bar.h"

namespace wheatstone {
namespace {

constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
const cv::Scalar ink(230, 230, 230);

/// Sizes that follow from a view's height, in pixels.
struct Measures {
  explicit Measures(const Image<Rgb8>& view)
      : margin(std::max(view.height() / 30, 4)),
        bar(std::max(view.height() / 45, 3)),
        line(std::max(view.height() / 360, 1)),
        letters(std::max(static_cast<double>(view.height()) / 900, 0.3)) {}
  int margin, bar, line;
  double letters;  ///< scale of the font
};

cv::Mat picture_of(Image<Rgb8>& view) { return {view.height(), view.width(), CV_8UC3, view.pixels().data()}; }

cv::Size size_of(const std::string& text, const Measures& measures) {
  int below = 0;
  cv::Size size = cv::getTextSize(text, font, measures.letters, measures.line, &below);
  size.height += below;
  return size;
}

/// Draws a text whose upper left corner, with the part below the line, is here.
void put_text(const cv::Mat& picture, const std::string& text, cv::Point corner, const Measures& measures) {
  int below = 0;
  const cv::Size size = cv::getTextSize(text, font, measures.letters, measures.line, &below);
  cv::putText(picture, text, {corner.x, corner.y + size.height}, font, measures.letters, ink, measures.line,
              cv::LINE_AA);
}

void put_scale(const cv::Mat& picture, const RenderedParticles& rendered, const Measures& measures) {
  const double px_a_unit = rendered.scene.camera.focal_px / rendered.scene.splat_style.size_depth;
  const double length = round_length(0.25 * picture.cols / px_a_unit);
  const std::string text = fmt::format("{:g} {}", length, rendered.units.length);
  const cv::Size size = size_of(text, measures);
  const int width = static_cast<int>(std::lround(length * px_a_unit));
  if (std::max(size.width, width) > picture.cols / 2) return;
  const int y = picture.rows - measures.margin;
  cv::rectangle(picture, {measures.margin, y - 2 * measures.line}, {measures.margin + width, y}, ink, cv::FILLED);
  put_text(picture, text, {measures.margin, y - 4 * measures.line - size.height}, measures);
}

void put_colours(const cv::Mat& picture, const RenderedParticles& rendered, const Measures& measures) {
  const ToneSettings& tone = rendered.rendered.tone;
  if (tone.look != Look::mass || tone.shown == Shown::colours) return;
  const int width = picture.cols * 3 / 10;
  const float unit = tone.most != 0 ? rendered.most / tone.most : 1;
  const std::vector<std::string> limits{fmt::format("{:.2g}", rendered.least),
                                        fmt::format("{:.2g}", value_at(tone, 0.5f) * unit),
                                        fmt::format("{:.2g}", rendered.most)};
  const std::string title = fmt::format("{} [{}]", rendered.units.name, rendered.units.value);
  const cv::Size size = size_of(title, measures);
  int widths = 2 * measures.margin;
  for (const std::string& limit : limits) widths += size_of(limit, measures).width;
  if (size.width > picture.cols - 2 * measures.margin || widths > width) return;
  const int left = picture.cols - measures.margin - width;
  const int bottom = picture.rows - measures.margin - size.height - 2 * measures.line;
  Image<Rgb8> bar = colour_bar(tone, width, measures.bar);
  picture_of(bar).copyTo(picture(cv::Rect(left, bottom - bar.height(), width, bar.height())));
  cv::rectangle(picture, {left - 1, bottom - bar.height() - 1}, {left + width, bottom}, ink, measures.line);
  put_text(picture, title,
           {std::max(picture.cols - measures.margin - std::max(size.width, width), 0),
            bottom - bar.height() - 3 * measures.line - size.height},
           measures);
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const int text_width = size_of(limits[i], measures).width;
    const int at = left + static_cast<int>(i) * (width - text_width) / 2;
    put_text(picture, limits[i], {at, bottom + 2 * measures.line}, measures);
  }
}

}  // namespace

double round_length(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  for (const double step : {5., 2.})
    if (step * power <= most) return step * power;
  return power;
}

void annotate(const RenderedParticles& rendered, std::span<Image<Rgb8>> views) {
  for (Image<Rgb8>& view : views) {
    const Measures measures(view);
    const cv::Mat picture = picture_of(view);
    put_scale(picture, rendered, measures);
    put_colours(picture, rendered, measures);
    if (rendered.redshift)
      put_text(picture, fmt::format("z = {:.2f}", *rendered.redshift), {measures.margin, measures.margin}, measures);
  }
}

}  // namespace wheatstone
