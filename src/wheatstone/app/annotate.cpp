#include "wheatstone/app/annotate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/app/colour_bar_ticks.h"
#include "wheatstone/display/lettering.h"
#include "wheatstone/display/typeset.h"
#include "wheatstone/multiview/colour_bar.h"

namespace wheatstone {
namespace {

constexpr Rgb8 ink{230, 230, 230};
constexpr Rgb8 shade{0, 0, 0};

/// Sizes that follow from a view's height, in pixels.
struct Measures {
  Measures(int height, ShownAs shown_as)
      : letters(std::max(height / (shown_as == ShownAs::film ? 24 : 36), shown_as == ShownAs::film ? 13 : 11)),
        margin(std::max(height / 30, 4)),
        bar(std::max(letters * 2 / 3, 3)),
        line(std::max(letters / 16, 1)) {}
  int letters, margin, bar, line;
};

struct Placed {
  int left, top;
  Image<std::uint8_t> cover;
};

/// What is drawn into each view.
struct Drawing {
  std::vector<Placed> inked;  ///< letters and lines, which get a dark rim
  int left = 0, top = 0;      ///< of the colours
  Image<Rgb8> colours;
};

Image<std::uint8_t> filled(int width, int height) {
  Image<std::uint8_t> cover(width, height);
  std::ranges::fill(cover.pixels(), 255);
  return cover;
}

/// A cover with a rim around it, so that light letters are read on light places.
Placed rim_of(const Placed& placed, int width) {
  Placed rim{placed.left - width, placed.top - width,
             Image<std::uint8_t>(placed.cover.width() + 2 * width, placed.cover.height() + 2 * width)};
  for (int y = 0; y < placed.cover.height(); ++y)
    std::ranges::copy(placed.cover.row(y), rim.cover.row(y + width).begin() + width);
  const cv::Mat picture(rim.cover.height(), rim.cover.width(), CV_8U, rim.cover.pixels().data());
  cv::dilate(picture, picture, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * width + 1, 2 * width + 1}));
  return rim;
}

/// The scale bar at the lower left; false where it does not fit.
bool add_scale(const RenderedParticles& rendered, const Image<Rgb8>& view, const Measures& measures, Drawing& drawing) {
  const double px_a_unit = rendered.scene.camera.focal_px / rendered.scene.splat_style.size_depth;
  const double length = round_length(0.25 * view.width() / px_a_unit);
  const std::string text = fmt::format("{:g} {}", length, typeset_unit(rendered.units.length));
  Image<std::uint8_t> label = std::move(set_labels(std::span(&text, 1), measures.letters).front());
  const int width = static_cast<int>(std::lround(length * px_a_unit));
  const int thick = 2 * measures.line + 1;
  const int top = view.height() - measures.margin - thick;
  if (std::max(label.width(), width) > view.width() / 2 - measures.margin || top < view.height() / 2) return false;
  const int above = top - label.height();
  drawing.inked.push_back({measures.margin, above, std::move(label)});
  drawing.inked.push_back({measures.margin, top, filled(std::max(width, 1), thick)});
  return true;
}

/// The title above the colours: in one line, or with its unit in a second one.
std::vector<std::string> title_of(const ShownUnits& units, int exponent, int letters, int width) {
  const std::string unit = "[" + typeset_unit(units.value, exponent) + "]";
  const std::string whole = units.name + " " + unit;
  return set_labels(std::span(&whole, 1), letters).front().width() <= width ? std::vector{whole}
                                                                            : std::vector{units.name, unit};
}

/// The colours at the lower right; false where they do not fit.
bool add_colours(const RenderedParticles& rendered, const Image<Rgb8>& view, const Measures& measures,
                 Drawing& drawing) {
  ToneSettings shown = rendered.rendered.tone;
  shown.least = rendered.least;
  shown.most = rendered.most;
  const auto widths_of = [&](const std::vector<std::string>& labels) {
    std::vector<int> widths;
    if (labels.empty()) return widths;
    for (const Image<std::uint8_t>& label : set_labels(labels, measures.letters)) widths.push_back(label.width());
    return widths;
  };
  const int across = view.width() * 2 / 5;
  const ColourBarTicks bar = colour_bar_ticks(shown, across, measures.letters * 2 / 3, widths_of);
  std::vector<std::string> texts;
  for (const Tick& tick : bar.ticks) texts.push_back(tick.label);
  std::vector<Image<std::uint8_t>> labels = set_labels(texts, measures.letters);
  const int room = view.width() * 7 / 10 - measures.margin;
  std::vector<Image<std::uint8_t>> titles =
      set_labels(title_of(rendered.units, bar.exponent, measures.letters, room), measures.letters);
  const int reaches_out = labels.back().width() / 2;
  const int right = view.width() - measures.margin - std::max(reaches_out - measures.margin / 2, 0);
  const int left = right - across, tick = 3 * measures.line;
  const int bottom = view.height() - measures.margin - labels.front().height() - tick;
  const int title_top =
      bottom - measures.bar - 2 * measures.line - static_cast<int>(titles.size()) * titles[0].height();
  const bool wide = std::ranges::any_of(titles, [&](const auto& title) { return title.width() > room; });
  if (wide || bar.ticks.size() < 2 || title_top < view.height() / 2) return false;
  drawing.colours = colour_bar(rendered.rendered.tone, across, measures.bar);
  drawing.left = left;
  drawing.top = bottom - measures.bar;
  const int line = measures.line;
  for (const int y : {drawing.top - line, bottom})
    drawing.inked.push_back({left - line, y, filled(across + 2 * line, line)});
  for (const int x : {left - line, right})
    drawing.inked.push_back({x, drawing.top - line, filled(line, measures.bar + 2 * line)});
  int y = title_top;
  for (Image<std::uint8_t>& title : titles) {
    const int below = y + title.height();
    const int at = std::max(right - std::max(title.width(), across), 0);
    drawing.inked.push_back({at, y, std::move(title)});
    y = below;
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const int at = left + static_cast<int>(std::lround(bar.ticks[i].place * static_cast<float>(across - 1)));
    const int beside = std::min(at - labels[i].width() / 2, view.width() - labels[i].width());
    drawing.inked.push_back({at - line / 2, bottom + line, filled(line, tick)});
    drawing.inked.push_back({beside, bottom + line + tick, std::move(labels[i])});
  }
  return true;
}

void draw(const Drawing& drawing, const std::vector<Placed>& rims, Image<Rgb8>& view) {
  for (const Placed& rim : rims) lay_cover(rim.cover, rim.left, rim.top, shade, view);
  for (int y = 0; y < drawing.colours.height(); ++y)
    std::ranges::copy(drawing.colours.row(y), view.row(drawing.top + y).begin() + drawing.left);
  for (const Placed& placed : drawing.inked) lay_cover(placed.cover, placed.left, placed.top, ink, view);
}

}  // namespace

double round_length(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  for (const double step : {5., 2.})
    if (step * power <= most) return step * power;
  return power;
}

void check_annotation_font() { font_for("column density [10⁻¹ M☉ kpc⁻²] 2×10"); }

std::vector<std::string> annotate(const RenderedParticles& rendered, std::span<Image<Rgb8>> views, ShownAs shown_as) {
  if (views.empty()) return {};
  std::vector<std::string> notes;
  const Image<Rgb8>& view = views.front();
  const Measures measures(view.height(), shown_as);
  Drawing drawing;
  const auto too_small = [&](const char* what) {
    notes.push_back(
        fmt::format("no {}: views of {}x{} pixels are too small for it", what, view.width(), view.height()));
  };
  if (!add_scale(rendered, view, measures, drawing)) too_small("scale bar");
  const ToneSettings& tone = rendered.rendered.tone;
  if (tone.look != Look::mass || tone.shown == Shown::colours)
    notes.emplace_back("no colour bar: colours do not stand for numbers, as they do with --look mass and --quantity");
  else if (!add_colours(rendered, view, measures, drawing))
    too_small("colour bar");
  if (rendered.redshift) {
    const std::string text = fmt::format("z = {:.2f}", *rendered.redshift);
    drawing.inked.push_back(
        {measures.margin, measures.margin, std::move(set_labels(std::span(&text, 1), measures.letters).front())});
  }
  std::vector<Placed> rims;
  for (const Placed& placed : drawing.inked) rims.push_back(rim_of(placed, std::max(measures.letters / 10, 1)));
  for (Image<Rgb8>& one : views) draw(drawing, rims, one);
  return notes;
}

}  // namespace wheatstone
