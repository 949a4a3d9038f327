#include "wheatstone/particles/appearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/image/srgb.h"

namespace wheatstone {
namespace {

constexpr std::pair<const char*, int> colour_maps[] = {
    {"inferno", cv::COLORMAP_INFERNO},   {"magma", cv::COLORMAP_MAGMA},     {"plasma", cv::COLORMAP_PLASMA},
    {"viridis", cv::COLORMAP_VIRIDIS},   {"cividis", cv::COLORMAP_CIVIDIS}, {"turbo", cv::COLORMAP_TURBO},
    {"twilight", cv::COLORMAP_TWILIGHT}, {"hot", cv::COLORMAP_HOT},         {"jet", cv::COLORMAP_JET},
    {"bone", cv::COLORMAP_BONE}};

void set_entry(Look& look, int entry, Rgb8 colour) {
  look.red[entry] = linear_from_srgb(colour.r);
  look.green[entry] = linear_from_srgb(colour.g);
  look.blue[entry] = linear_from_srgb(colour.b);
}

void fill_between(Look& look, Rgb8 cold, Rgb8 hot) {
  const auto mixed = [](std::uint8_t from, std::uint8_t to, float share) {
    return linear_from_srgb(from) * (1 - share) + linear_from_srgb(to) * share;
  };
  for (int i = 0; i < Look::palette_size; ++i) {
    const float share = static_cast<float>(i) / (Look::palette_size - 1);
    look.red[i] = mixed(cold.r, hot.r, share);
    look.green[i] = mixed(cold.g, hot.g, share);
    look.blue[i] = mixed(cold.b, hot.b, share);
  }
}

void fill_by_name(Look& look, const std::string& name) {
  const auto* const found = std::ranges::find(colour_maps, name, [](const auto& entry) { return entry.first; });
  if (found == std::end(colour_maps)) {
    std::string names;
    for (const auto& [known, code] : colour_maps) names += fmt::format(" {}", known);
    throw Error(ErrorKind::wrong_usage, fmt::format("--colours: no colour map '{}', expected one of:{}", name, names));
  }
  cv::Mat values(1, Look::palette_size, CV_8UC1);
  for (int i = 0; i < Look::palette_size; ++i) values.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::Mat colours;
  cv::applyColorMap(values, colours, found->second);
  for (int i = 0; i < Look::palette_size; ++i) {
    const cv::Vec3b bgr = colours.at<cv::Vec3b>(0, i);
    set_entry(look, i, {bgr[2], bgr[1], bgr[0]});
  }
}

/// Spreads the palette over the values of the column that the colours follow.
void spread_palette(Look& look, const Appearance& appearance, const LogHistogram& values) {
  const auto given_or = [](float given, float found) { return std::isnan(given) ? found : given; };
  float first = given_or(appearance.coldest, values.percentile(0.02));
  float last = given_or(appearance.hottest, values.percentile(0.98));
  if (look.logarithmic) {
    if (!(first > 0 || values.total() == 0))
      throw Error(ErrorKind::wrong_usage, "--coldest: must be above 0 on a logarithmic scale");
    first = std::log2(std::max(first, 1e-37f));
    last = std::log2(std::max(last, 1e-37f));
  }
  if (last < first) throw Error(ErrorKind::wrong_usage, "--hottest: must not be below --coldest");
  look.palette_first = first;
  // Where all have one value, they get the first colour.
  look.palette_scale = last > first ? (Look::palette_size - 1) / (last - first) : 0.f;
}

}  // namespace

Look make_look(const Appearance& appearance, const Survey& survey) {
  const bool sizes_are_right = appearance.smallest_px > 0 && appearance.largest_px >= appearance.smallest_px &&
                               appearance.largest_px <= Look::widest_px;
  if (!sizes_are_right)
    throw Error(ErrorKind::wrong_usage, fmt::format("--splat: {} to {} pixels, expected a range within 0 to {}",
                                                    appearance.smallest_px, appearance.largest_px, Look::widest_px));
  if (!(appearance.opacity > 0) || !std::isfinite(appearance.opacity))
    throw Error(ErrorKind::wrong_usage, "--opacity: must be above 0");
  Look look;
  look.log2_density_middle = survey.density.total() > 0 ? std::log2(survey.density.percentile(0.5)) +
                                                              appearance.density_shift * std::log2(10.f)
                                                        : 0.f;
  look.slope = survey.density.total() > 0 ? appearance.density_slope * std::log10(std::exp(1.f)) : 0.f;
  look.opacity = appearance.opacity;
  look.least_opacity = appearance.least_opacity * appearance.opacity;
  look.size_rule = appearance.size_rule;
  look.smallest_px = appearance.smallest_px;
  look.largest_px = appearance.largest_px;
  look.colour_source = survey.has_colour        ? ColourSource::own
                       : survey.has_temperature ? ColourSource::temperature
                                                : ColourSource::density;
  look.logarithmic = appearance.logarithmic || look.colour_source == ColourSource::density;
  if (appearance.colour_map.empty()) {
    fill_between(look, appearance.cold, appearance.hot);
  } else {
    fill_by_name(look, appearance.colour_map);
  }
  spread_palette(look, appearance,
                 look.colour_source == ColourSource::temperature ? survey.temperature : survey.density);
  return look;
}

}  // namespace wheatstone
