#include "wheatstone/particles/appearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/image/colour.h"

namespace wheatstone {
namespace {

constexpr std::pair<const char*, int> colour_maps[] = {
    {"inferno", cv::COLORMAP_INFERNO},   {"magma", cv::COLORMAP_MAGMA},     {"plasma", cv::COLORMAP_PLASMA},
    {"viridis", cv::COLORMAP_VIRIDIS},   {"cividis", cv::COLORMAP_CIVIDIS}, {"turbo", cv::COLORMAP_TURBO},
    {"twilight", cv::COLORMAP_TWILIGHT}, {"hot", cv::COLORMAP_HOT},         {"jet", cv::COLORMAP_JET},
    {"bone", cv::COLORMAP_BONE}};

void set_entry(SplatStyle& splat_style, int entry, Rgb8 colour) {
  splat_style.red[entry] = linear_from_srgb(colour.r);
  splat_style.green[entry] = linear_from_srgb(colour.g);
  splat_style.blue[entry] = linear_from_srgb(colour.b);
}

void fill_between(SplatStyle& splat_style, Rgb8 cold, Rgb8 hot) {
  const auto mixed = [](std::uint8_t from, std::uint8_t to, float share) {
    return linear_from_srgb(from) * (1 - share) + linear_from_srgb(to) * share;
  };
  for (int i = 0; i < SplatStyle::palette_size; ++i) {
    const float share = static_cast<float>(i) / (SplatStyle::palette_size - 1);
    splat_style.red[i] = mixed(cold.r, hot.r, share);
    splat_style.green[i] = mixed(cold.g, hot.g, share);
    splat_style.blue[i] = mixed(cold.b, hot.b, share);
  }
}

void fill_by_name(SplatStyle& splat_style, const std::string& name) {
  const std::array<Rgb8, 256> colours = colour_map(name);
  for (int i = 0; i < SplatStyle::palette_size; ++i) set_entry(splat_style, i, colours[static_cast<std::size_t>(i)]);
}

/// Spreads the palette over the values of the column that the colours follow.
void spread_palette(SplatStyle& splat_style, const Appearance& appearance, const LogHistogram& values) {
  const auto given_or = [](float given, float found) { return std::isnan(given) ? found : given; };
  float first = given_or(appearance.coldest, values.percentile(0.02));
  float last = given_or(appearance.hottest, values.percentile(0.98));
  if (splat_style.logarithmic) {
    if (!(first > 0 || values.total() == 0))
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("the coldest temperature is {}, expected above 0 on a logarithmic scale", first));
    first = std::log2(std::max(first, 1e-37f));
    last = std::log2(std::max(last, 1e-37f));
  }
  if (!(last >= first))
    throw Error(ErrorKind::wrong_usage, "the hottest temperature is below the coldest, expected an ascending range");
  splat_style.palette_first = first;
  // Where all have one value, they get the first colour.
  splat_style.palette_scale = last > first ? (SplatStyle::palette_size - 1) / (last - first) : 0.f;
}

/// What decides the sizes of mass: the radius of a kernel that holds as many particles as is usual, from the density
/// or, where none is known, from how much room there is.
void set_radii(SplatStyle& splat_style, const CloudStatistics& statistics) {
  constexpr double particles_a_kernel = 32;
  constexpr double ball = 4 * std::numbers::pi / 3;
  const auto count = static_cast<double>(std::max<std::uint64_t>(statistics.count, 1));
  const FramedRegion room =
      statistics.framed.value_or(FramedRegion{.lower = statistics.lower, .upper = statistics.upper});
  double volume = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
    volume *= std::max(static_cast<double>(room.upper[axis]) - room.lower[axis],
                       1e-3 * static_cast<double>(statistics.radius()));
  splat_style.fixed_radius = static_cast<float>(std::cbrt(particles_a_kernel * volume / (ball * count)));
  // Points with colours of their own lie on surfaces, closer together than their number in the room tells.
  if (statistics.has_colour) splat_style.fixed_radius = std::min(splat_style.fixed_radius, statistics.radius() / 100);
  if (statistics.density.total() == 0) return;
  // Without masses, the particle's is the one with which their volumes fill the room.
  const double mass = statistics.has_mass ? statistics.mass / count : volume / statistics.density.sum_of_inverses();
  splat_style.radius_factor = static_cast<float>(std::cbrt(particles_a_kernel * mass / ball));
}

SizeRule size_rule_of(const Appearance& appearance, const CloudStatistics& statistics) {
  if (appearance.size_rule != SizeRule::automatic) return appearance.size_rule;
  if (appearance.look == Look::thesis) return SizeRule::denser_smaller;
  return statistics.has_smoothing_length ? SizeRule::smoothing_length : SizeRule::density;
}

}  // namespace

std::vector<std::string_view> colour_map_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, map] : colour_maps) names.emplace_back(name);
  return names;
}

UsualColours usual_colours(Look look) {
  if (look == Look::thesis) return {{40, 90, 255}, {255, 120, 30}};
  return {{38, 98, 255}, {255, 186, 84}};
}

std::array<Rgb8, 256> colour_map(const std::string& name) {
  const auto* const found = std::ranges::find(colour_maps, name, [](const auto& entry) { return entry.first; });
  if (found == std::end(colour_maps)) {
    std::string names;
    for (const auto& [known, code] : colour_maps) names += fmt::format(" {}", known);
    throw Error(ErrorKind::wrong_usage, fmt::format("there is no colour map '{}', expected one of:{}", name, names));
  }
  std::array<Rgb8, 256> map{};
  cv::Mat values(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i) values.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::Mat colours;
  cv::applyColorMap(values, colours, found->second);
  for (int i = 0; i < 256; ++i) {
    const cv::Vec3b bgr = colours.at<cv::Vec3b>(0, i);
    map[static_cast<std::size_t>(i)] = {bgr[2], bgr[1], bgr[0]};
  }
  return map;
}

SplatStyle make_splat_style(const Appearance& appearance, const CloudStatistics& statistics) {
  const bool sizes_are_right = appearance.smallest_px > 0 && appearance.largest_px >= appearance.smallest_px &&
                               appearance.largest_px <= SplatStyle::widest_px;
  if (!sizes_are_right)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("splat diameters are {} to {} pixels, expected a range within 0 to {}",
                            appearance.smallest_px, appearance.largest_px, SplatStyle::widest_px));
  if (!(appearance.opacity > 0) || !std::isfinite(appearance.opacity))
    throw Error(ErrorKind::wrong_usage, fmt::format("the opacity is {}, expected above 0", appearance.opacity));
  SplatStyle splat_style;
  splat_style.log2_density_middle = statistics.density.total() > 0 ? std::log2(statistics.density.percentile(0.5)) +
                                                                         appearance.density_shift * std::log2(10.f)
                                                                   : 0.f;
  splat_style.slope = statistics.density.total() > 0 ? appearance.density_slope * std::log10(std::exp(1.f)) : 0.f;
  splat_style.opacity = appearance.opacity;
  splat_style.least_opacity = appearance.least_opacity * appearance.opacity;
  splat_style.look = appearance.look;
  if (appearance.look == Look::thesis) splat_style.blend = appearance.blend;
  splat_style.kernel = appearance.kernel;
  splat_style.size_rule = size_rule_of(appearance, statistics);
  set_radii(splat_style, statistics);
  if (statistics.count > 0 && statistics.mass > 0)
    splat_style.mean_mass = static_cast<float>(statistics.mass / static_cast<double>(statistics.count));
  splat_style.smallest_px = appearance.smallest_px;
  splat_style.largest_px = appearance.largest_px;
  splat_style.colour_source = statistics.has_colour        ? ColourSource::own
                              : statistics.has_temperature ? ColourSource::temperature
                                                           : ColourSource::density;
  splat_style.logarithmic = appearance.logarithmic || splat_style.colour_source == ColourSource::density;
  if (appearance.colour_map.empty()) {
    const UsualColours usual = usual_colours(appearance.look);
    fill_between(splat_style, appearance.cold.value_or(usual.cold), appearance.hot.value_or(usual.hot));
  } else {
    fill_by_name(splat_style, appearance.colour_map);
  }
  spread_palette(splat_style, appearance,
                 splat_style.colour_source == ColourSource::temperature ? statistics.temperature : statistics.density);
  return splat_style;
}

}  // namespace wheatstone
