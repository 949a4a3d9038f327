#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/particles/cloud_statistics.h"

namespace wheatstone {

/// What a picture shows of particles.
enum class Look {
  mass,    ///< their mass, spread over their kernels: each line of sight sums to a column density
  thesis,  ///< light whose opacity and splat size follow from the density (Hassaine 2010, sec. 4.2)
};

/// How the light of particles that lie behind each other comes together (Hassaine 2010, sec. 4.2.1).
enum class Blend {
  add,   ///< all of it adds up, in any order
  over,  ///< particles absorb what comes from behind them as they shine: the nearer ones are in front
};

/// How a particle's mass is spread.
enum class Kernel {
  gaussian,      ///< with the cubic spline's width
  cubic_spline,  ///< of SPH, which ends at its radius (Monaghan 1992): its projection on rows times that on columns
};

/// What decides how large a particle's splat is.
enum class SizeRule {
  automatic,         ///< of mass: smoothing length, else density; of the thesis: denser_smaller
  denser_smaller,    ///< thin gas is a haze, knots are points (Hassaine 2010, appendix A.1)
  denser_larger,     ///< knots stand out (appendix B.1)
  smoothing_length,  ///< the particle's own, as far away as it is
  density,           ///< of mass: the radius that holds 32 particles
};

/// How a particle looks, as the user says it (Hassaine 2010, sec. 4.2). Colours are sRGB.
struct Appearance {
  Look look = Look::mass;
  Blend blend = Blend::add;          ///< of the thesis's look
  Kernel kernel = Kernel::gaussian;  ///< of mass
  float density_slope = 2;           ///< of the sigmoid, for a factor of ten in density
  float density_shift = 0;           ///< of its middle, in factors of ten above the median density
  /// Of the densest, at the middle of a splat. Of particles that absorb, it is an optical depth: a share of
  /// exp(−opacity) comes through.
  float opacity = 0.5f;
  float least_opacity = 0;  ///< of the thinnest, as a share of `opacity`
  SizeRule size_rule = SizeRule::automatic;
  /// Diameter of a splat; sizes shrink with distance and are clamped to this range. Of mass, the largest counts only
  /// for the thesis's size rules.
  float smallest_px = 2;
  float largest_px = 6;
  std::optional<Rgb8> cold, hot;  ///< of the look's own where they are not given (usual_colours)
  std::string colour_map;         ///< of OpenCV by name ("inferno"); empty: from `cold` to `hot`
  bool logarithmic = true;        ///< temperature
  float shine = 0;  ///< light at the middle of a highlight that moves from view to view, times the particles' own
  float coldest = std::numeric_limits<float>::quiet_NaN();  ///< where the colours begin; NaN: 2nd percentile
  float hottest = std::numeric_limits<float>::quiet_NaN();  ///< where they end; NaN: 98th percentile
};

/// Which column the colours follow; of `quantity`, a number is shown in place of a colour.
enum class ColourSource { temperature, density, own, quantity };

/// An appearance with everything that it leaves to the cloud filled in: what the renderers read.
struct SplatStyle {
  Look look = Look::mass;
  Blend blend = Blend::add;
  Kernel kernel = Kernel::gaussian;
  float mean_mass = 1;       ///< of a particle: light is counted in it
  float radius_factor = 0;   ///< of mass: a kernel's radius is it times the cube root of 1 over the density
  float fixed_radius = 0;    ///< of mass: every kernel's radius, where neither density nor smoothing length is known
  float quantity_scale = 1;  ///< of mass: what a quantity is multiplied by, so that a half float holds it
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
  static constexpr float widest_px = 30;                   ///< a splat of the thesis's look may be
  std::array<float, palette_size> red{}, green{}, blue{};  ///< linear light
};

/// The colours of the coldest and of the hottest particles.
struct UsualColours {
  Rgb8 cold, hot;
};
UsualColours usual_colours(Look look);

/// 256 colours of a map of OpenCV by name. Throws Error{wrong_usage}.
std::array<Rgb8, 256> colour_map(const std::string& name);

/// Throws Error{wrong_usage} where a size, range or colour map makes no sense.
SplatStyle make_splat_style(const Appearance& appearance, const CloudStatistics& statistics);

/// The names that a colour map may have.
std::vector<std::string_view> colour_map_names();

}  // namespace wheatstone
