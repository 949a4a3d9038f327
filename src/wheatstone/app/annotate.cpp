#include "wheatstone/app/annotate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/app/colour_bar_ticks_internal.h"
#include "wheatstone/display/lettering.h"
#include "wheatstone/display/typeset.h"
#include "wheatstone/error.h"
#include "wheatstone/multiview/colour_bar.h"

namespace wheatstone {
namespace {

constexpr Rgb8 ink{230, 230, 230};
constexpr Rgb8 shade{0, 0, 0};

/// Sizes that follow from a view's height, in pixels.
struct Measures {
  Measures(int height, ShownAs shown_as, int moved)
      : letters(std::max(height / (shown_as == ShownAs::film ? 24 : 36), shown_as == ShownAs::film ? 13 : 11)),
        margin(std::max(height / 30, 4)),
        side(margin + moved),
        bar(std::max(letters * 2 / 3, 3)),
        line(std::max(letters / 16, 1)) {}
  int letters, margin;
  int side;  ///< margin to the left and right, from which the views move what is drawn
  int bar, line;
};

/// How far to the right what stands at the depth lies in a view.
int moved_px(const RenderedParticles& rendered, float behind_mm, std::size_t view) {
  if (behind_mm == 0) return 0;
  const double parallax = screen_parallax_mm(rendered.viewing, behind_mm) / rendered.viewing.screen_width_mm;
  return static_cast<int>(std::lround(rendered.rig.positions[view].eye_separations() * parallax * rendered.rig.width));
}

struct Placed {
  int left, top;
  Image<std::uint8_t> cover;
  Rgb8 colour = ink;
};

/// What is drawn into each view.
struct Drawing {
  std::vector<Placed> inked;  ///< letters, lines and colours of types, which get a dark rim
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
  if (std::max(label.width(), width) > view.width() / 2 - measures.side || top < view.height() / 2) return false;
  const int above = top - label.height();
  drawing.inked.push_back({measures.side, above, std::move(label)});
  drawing.inked.push_back({measures.side, top, filled(std::max(width, 1), thick)});
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
  const int room = view.width() * 7 / 10 - measures.side;
  std::vector<Image<std::uint8_t>> titles =
      set_labels(title_of(rendered.units, bar.exponent, measures.letters, room), measures.letters);
  const int reaches_out = labels.back().width() / 2;
  const int right = view.width() - measures.side - std::max(reaches_out - measures.margin / 2, 0);
  const int left = right - across, tick = 3 * measures.line;
  const int bottom = view.height() - measures.margin - labels.front().height() - tick;
  const int title_top =
      bottom - measures.bar - 2 * measures.line - static_cast<int>(titles.size()) * titles[0].height();
  const bool wide = std::ranges::any_of(titles, [&](const auto& title) { return title.width() > room; });
  if (wide || left < measures.side || bar.ticks.size() < 2 || title_top < view.height() / 2) return false;
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
    const int at = std::max(right - std::max(title.width(), across), measures.side);
    drawing.inked.push_back({at, y, std::move(title)});
    y = below;
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const int at = left + static_cast<int>(std::lround(bar.ticks[i].place * static_cast<float>(across - 1)));
    const int beside =
        std::min(at - labels[i].width() / 2, view.width() - labels[i].width() - measures.side + measures.margin);
    drawing.inked.push_back({at - line / 2, bottom + line, filled(line, tick)});
    drawing.inked.push_back({beside, bottom + line + tick, std::move(labels[i])});
  }
  return true;
}

/// The types of particles at the lower right, each beside its colour; false where they do not fit.
bool add_types(const RenderedParticles& rendered, const Image<Rgb8>& view, const Measures& measures, Drawing& drawing) {
  std::vector<std::string> names;
  for (const TypeColour& type : rendered.types) names.push_back(type.type);
  std::vector<Image<std::uint8_t>> labels = set_labels(names, measures.letters);
  int widest = 0, height = 0;
  for (const Image<std::uint8_t>& label : labels) {
    widest = std::max(widest, label.width());
    height = std::max(height, label.height());
  }
  const int count = static_cast<int>(labels.size()), swatch = measures.letters;
  const int left = view.width() - measures.side - widest - swatch * 3 / 2;
  const int top = view.height() - measures.margin - count * height;
  if (left < view.width() / 2 || top < view.height() / 2) return false;
  for (int i = 0; i < count; ++i) {
    const auto type = static_cast<std::size_t>(i);
    const int y = top + i * height;
    drawing.inked.push_back({left, y + (height - swatch) / 2, filled(swatch, swatch), rendered.types[type].colour});
    drawing.inked.push_back({left + swatch * 3 / 2, y, std::move(labels[type])});
  }
  return true;
}

/// When a picture is: "z = 0.50" of a universe that expands, "t = 1.25" of another simulation; empty where unknown.
std::string moment_told(const RenderedParticles& rendered) {
  if (rendered.redshift) return fmt::format("z = {:.2f}", *rendered.redshift);
  if (rendered.time) return fmt::format("t = {:.4g}", *rendered.time);
  return {};
}

/// The redshift or the time at the upper left, and the title in the middle, below it where they would meet; false where
/// the title does not fit.
bool add_words(const RenderedParticles& rendered, const std::string& title, const Image<Rgb8>& view,
               const Measures& measures, Drawing& drawing) {
  int top = measures.margin, taken = 0;
  if (const std::string text = moment_told(rendered); !text.empty()) {
    Image<std::uint8_t> label = std::move(set_labels(std::span(&text, 1), measures.letters).front());
    taken = measures.side + label.width() + measures.letters;
    drawing.inked.push_back({measures.side, top, std::move(label)});
  }
  if (title.empty()) return true;
  Image<std::uint8_t> label = std::move(set_labels(std::span(&title, 1), measures.letters * 4 / 3).front());
  const int left = (view.width() - label.width()) / 2;
  if (left < taken) top += measures.letters * 4 / 3;
  if (left < measures.side || top + label.height() > view.height() / 2) return false;
  drawing.inked.push_back({left, top, std::move(label)});
  return true;
}

void draw(const Drawing& drawing, const std::vector<Placed>& rims, int moved, Image<Rgb8>& view) {
  for (const Placed& rim : rims) lay_cover(rim.cover, rim.left + moved, rim.top, shade, view);
  for (int y = 0; y < drawing.colours.height(); ++y)
    std::ranges::copy(drawing.colours.row(y), view.row(drawing.top + y).begin() + drawing.left + moved);
  for (const Placed& placed : drawing.inked)
    lay_cover(placed.cover, placed.left + moved, placed.top, placed.colour, view);
}

}  // namespace

double round_length(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  for (const double step : {5., 2.})
    if (step * power <= most) return step * power;
  return power;
}

void check_annotation(const Annotation& annotation, const ViewingGeometry& viewing) {
  if (!(annotation.behind_mm > -viewing.viewing_distance_mm))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("annotation depth: is {} mm, expected more than {} mm, where the viewer is",
                            annotation.behind_mm, -viewing.viewing_distance_mm));
  font_for("column density [10⁻¹ M☉ kpc⁻²] 2×10");
  if (!annotation.title.empty()) font_for(annotation.title);
}

std::vector<std::string> annotate(const RenderedParticles& rendered, std::span<Image<Rgb8>> views,
                                  const Annotation& annotation) {
  if (views.empty()) return {};
  check_annotation(annotation, rendered.viewing);
  std::vector<std::string> notes;
  const Image<Rgb8>& view = views.front();
  int moved = 0;
  for (std::size_t i = 0; i < views.size(); ++i)
    moved = std::max(moved, std::abs(moved_px(rendered, annotation.behind_mm, i)));
  const Measures measures(view.height(), annotation.shown_as, moved);
  Drawing drawing;
  const auto too_small = [&](const char* what) {
    notes.push_back(
        fmt::format("no {}: views of {}x{} pixels are too small for it", what, view.width(), view.height()));
  };
  if (!add_scale(rendered, view, measures, drawing)) too_small("scale bar");
  const ToneSettings& tone = rendered.rendered.tone;
  if (!rendered.types.empty()) {
    if (!add_types(rendered, view, measures, drawing)) too_small("list of types");
  } else if (tone.look != Look::mass || tone.shown == Shown::colours) {
    notes.emplace_back("no colour bar: colours do not stand for numbers, as they do with --look mass and --quantity");
  } else if (!add_colours(rendered, view, measures, drawing)) {
    too_small("colour bar");
  }
  if (!add_words(rendered, annotation.title, view, measures, drawing)) too_small("title");
  std::vector<Placed> rims;
  for (const Placed& placed : drawing.inked) rims.push_back(rim_of(placed, std::max(measures.letters / 10, 1)));
  for (std::size_t i = 0; i < views.size(); ++i)
    draw(drawing, rims, moved_px(rendered, annotation.behind_mm, i), views[i]);
  return notes;
}

}  // namespace wheatstone
