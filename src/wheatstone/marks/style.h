#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/marks/brush.h"

namespace wheatstone {

/// How the second eye gets its strokes.
enum class Propagation {
  strokes,      ///< control points are warped to the other eye and back (Stavrakis & Gelautz 2005)
  raster,       ///< the painted left picture is warped over right-only paint (Stavrakis & Gelautz 2004)
  independent,  ///< each eye painted alone: the naive method, here to be measured against
};

/// Where a stroke's direction comes from.
enum class Orientation {
  smooth,    ///< the gradient where it is strong, a field interpolated from strong gradients where it vanishes
  gradient,  ///< the gradient alone; a stroke ends where it vanishes (Stavrakis & Gelautz 2004, criterion (c))
};

/// How the photograph is blurred before a layer is planned from it.
enum class ReferenceFilter { median, gaussian };

/// What lies behind all layers.
enum class Background { photograph, colour };

/// Uniform changes of a stroke's colour by ± half of each, as fractions of the channel's full range.
struct ColourJitter {
  float hue = 0, saturation = 0, value = 0;
  float red = 0, green = 0, blue = 0;
  friend bool operator==(const ColourJitter&, const ColourJitter&) = default;
};

/// What a painting is made of.
enum class Marks {
  strokes,         ///< of a brush, as in the papers
  fitted_strokes,  ///< of a brush, each fitted to the photograph; `radii_px` are the broadest and the finest
  regions,         ///< of few colours: posterisation
  tiles,           ///< of a mosaic
  curves,          ///< along edges, whose colours spread between them: diffusion curves
};

/// Every parameter of a painting. The symbols are Hertzmann's (1998) and Stavrakis & Gelautz's (2004).
struct Style {
  std::string name = "impressionist";
  std::vector<float> radii_px{8, 4, 2};  ///< R, coarse to fine, for a picture 640 pixels wide
  bool absolute_radii = false;           ///< take radii and the depth threshold as they are, whatever the width
  float threshold = 100;                 ///< T: RGB distance, 0..441, above which a grid cell gets a stroke
  float grid = 1;                        ///< f_g: grid cell size as a multiple of R
  float blur = 0.5f;                     ///< f_σ: the reference's filter is 2·f_σ·R + 1 pixels wide
  float curvature = 1;                   ///< f_c: 1 follows the gradient at once, less remembers the last direction
  float opacity = 1;                     ///< α
  int min_length = 4;                    ///< control points before a stroke may end by the colour criterion
  int max_length = 16;                   ///< control points at most; 0 paints dots
  ColourJitter jitter;
  bool texture = false;          ///< the finished strokes' paint stands up from the canvas, lit from one side
  bool dual = false;             ///< strokes of two colours, side by side
  float fineness = 0.5f;         ///< of fitted strokes, 0..1: how small a difference is worth a stroke
  int strokes = 0;               ///< at most so many fitted strokes, spent where they gain most; 0: as fineness says
  Brush brush{.bristle_px = 1};  ///< in a picture 640 pixels wide; at least a pixel in narrower ones

  Marks marks = Marks::strokes;
  int colours = 18;    ///< k: of a posterised picture
  float tile_px = 14;  ///< width of a mosaic's tiles, for a picture 640 pixels wide

  bool depth_test = true;             ///< end strokes at depth discontinuities
  float depth_threshold_px = 2;       ///< T_depth, as a difference in disparity, for a picture 640 pixels wide
  bool follow_depth_edges = true;     ///< strokes of the finest layer that begin beside an edge run along it, not dots
  float occlusion_dilation = 0.125f;  ///< growth of the occlusion masks, as a multiple of the largest radius

  Propagation propagation = Propagation::strokes;
  Orientation orientation = Orientation::smooth;
  ReferenceFilter reference_filter = ReferenceFilter::median;
  Background background = Background::photograph;
  Rgb8 canvas_colour{255, 255, 255};
  std::uint64_t seed = 1;
  friend bool operator==(const Style&, const Style&) = default;
};

/// The names of the presets: Hertzmann's (1998, sec. 3.2), then those of Bukenberger et al. (2015, sec. 4).
std::span<const std::string_view> style_names();

/// A preset by name. Throws Error{wrong_usage} that lists the names where there is none such.
Style style_by_name(std::string_view name);

/// Throws Error{wrong_usage}, naming the parameter, where a style cannot be painted with.
void check_style(const Style& style);

/// Pixels of a picture `width` wide for one pixel of a 640-pixel-wide one; 1 with absolute radii.
float style_scale(const Style& style, int width);

/// The brush for a picture `width` pixels wide; without bristles for marks that are not strokes, and for even paint.
Brush brush_for(const Style& style, int width);

/// Whether the style paints with strokes, however they are planned.
inline bool is_of_strokes(const Style& style) {
  return style.marks == Marks::strokes || style.marks == Marks::fitted_strokes;
}

std::string_view name_of(Marks marks);
std::string_view name_of(Propagation propagation);
std::string_view name_of(Orientation orientation);
std::string_view name_of(ReferenceFilter filter);
std::string_view name_of(Background background);
std::optional<Marks> marks_by_name(std::string_view name);
std::optional<Propagation> propagation_by_name(std::string_view name);
std::optional<Orientation> orientation_by_name(std::string_view name);
std::optional<ReferenceFilter> reference_filter_by_name(std::string_view name);
std::optional<Background> background_by_name(std::string_view name);

}  // namespace wheatstone
