#pragma once

#include <array>
#include <limits>
#include <string>

#include "wheatstone/image/image.h"
#include "wheatstone/particles/cloud_statistics.h"

namespace wheatstone {

/// What decides how large a particle's splat is.
enum class SizeRule {
  denser_smaller,    ///< thin gas is a haze, knots are points (Hassaine 2010, appendix A.1)
  denser_larger,     ///< knots stand out (appendix B.1)
  smoothing_length,  ///< twice the particle's own, as far away as it is
};

/// How a particle looks, as the user says it (Hassaine 2010, sec. 4.2). Colours are sRGB.
struct Appearance {
  float density_slope = 2;  ///< of the sigmoid, for a factor of ten in density
  float density_shift = 0;  ///< of its middle, in factors of ten above the median density
  float opacity = 0.5f;     ///< of the densest, at the middle of a splat
  float least_opacity = 0;  ///< of the thinnest, as a share of `opacity`
  SizeRule size_rule = SizeRule::denser_smaller;
  float smallest_px = 2;  ///< diameter of a splat; sizes shrink with distance and are clamped to this range
  float largest_px = 6;
  Rgb8 cold{40, 90, 255};
  Rgb8 hot{255, 120, 30};
  std::string colour_map;   ///< of OpenCV by name ("inferno"); empty: from `cold` to `hot`
  bool logarithmic = true;  ///< temperature
  float coldest = std::numeric_limits<float>::quiet_NaN();  ///< where the colours begin; NaN: 2nd percentile
  float hottest = std::numeric_limits<float>::quiet_NaN();  ///< where they end; NaN: 98th percentile
};

/// Which column the colours follow.
enum class ColourSource { temperature, density, own };

/// An appearance with everything that it leaves to the cloud filled in: what the renderers read.
struct SplatStyle {
  float log2_density_middle = 0;
  float slope = 0;  ///< of the sigmoid, for a factor of e in density: 1 / (1 + exp(−slope·(ln ρ − middle)))
  float opacity = 0, least_opacity = 0;
  SizeRule size_rule = SizeRule::denser_smaller;
  float smallest_px = 2, largest_px = 6;
  float size_depth = 1;  ///< depth at which sizes are as given, before they are clamped
  ColourSource colour_source = ColourSource::temperature;
  bool logarithmic = true;
  float palette_first = 0, palette_scale = 0;  ///< value, or its log2, at entry 0; entries a unit
  static constexpr int palette_size = 256;
  static constexpr float widest_px = 30;                   ///< a splat may be
  std::array<float, palette_size> red{}, green{}, blue{};  ///< linear light
};

/// Throws Error{wrong_usage} where a size, range or colour map makes no sense.
SplatStyle make_splat_style(const Appearance& appearance, const CloudStatistics& statistics);

}  // namespace wheatstone
