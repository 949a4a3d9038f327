#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "wheatstone/marks/spline.h"
#include "wheatstone/strokes/layer_plan.h"

namespace wheatstone {

/// A colour in the planes in which strokes are fitted: luminance and two opponent colours of sRGB, scaled to steps of
/// about CIE Lab's. They are linear in sRGB, as paint is.
struct FitColour {
  float luminance = 0, red = 0, blue = 0;
  friend bool operator==(const FitColour&, const FitColour&) = default;

  // Steps of the planes for one level of sRGB: a level of grey is 0.39 of L*.
  static constexpr float luminance_step = 0.39f, red_step = 0.30f, blue_step = 0.24f;
  static constexpr float red_share = 0.299f, green_share = 0.587f, blue_share = 0.114f;  // Rec. 601

  /// Converts a colour in sRGB, 0..255.
  static FitColour of(float r, float g, float b) {
    const float y = red_share * r + green_share * g + blue_share * b;
    return {luminance_step * y, red_step * (r - y), blue_step * (b - y)};
  }
  /// The colour in sRGB, 0..255, not rounded.
  std::array<float, 3> rgb() const {
    const float y = luminance / luminance_step, r = y + red / red_step, b = y + blue / blue_step;
    return {r, (y - red_share * r - blue_share * b) / green_share, b};
  }
};

inline float squared(const FitColour& a) { return a.luminance * a.luminance + a.red * a.red + a.blue * a.blue; }
inline FitColour operator-(const FitColour& a, const FitColour& b) {
  return {a.luminance - b.luminance, a.red - b.red, a.blue - b.blue};
}

/// How much a difference counts at each pixel of a layer: by the local contrast of the wanted luminance relative to its
/// brightness, so that dark detail counts as well, by View::detail, and beside depth edges. A weight depends on the
/// picture within 3 pixels.
Image<float> difference_weights(const LayerPlan& plan);

/// The error of a bare pixel, in squared steps.
inline constexpr float squared_error_of_bare = 900;

/// A pixel of a canvas while a layer is fitted: as Canvas, in half the memory.
struct PaintedPixel {
  static constexpr float steps = 256, coverage_steps = 65535;  ///< a level of 0..255 and the coverage are divided into
  std::uint16_t red, green, blue, covered;
  friend bool operator==(const PaintedPixel&, const PaintedPixel&) = default;

  static PaintedPixel of(const FitColour& colour, float coverage) {
    const auto [r, g, b] = colour.rgb();
    return of(r, g, b, coverage);
  }
  static PaintedPixel of(float r, float g, float b, float coverage) {
    const auto in_steps = [](float level) {
      return static_cast<std::uint16_t>(std::clamp(level, 0.f, 255.f) * steps + 0.5f);
    };
    return {in_steps(r), in_steps(g), in_steps(b), static_cast<std::uint16_t>(coverage * coverage_steps + 0.5f)};
  }
  FitColour colour() const { return FitColour::of(red / steps, green / steps, blue / steps); }
  float coverage() const { return covered / coverage_steps; }
};
using PaintedPicture = Image<PaintedPixel>;

/// Colours by pixel, a plane for each of their parts.
class FitColours {
 public:
  explicit FitColours(std::size_t count) : luminance_(count), red_(count), blue_(count) {}
  std::size_t size() const { return luminance_.size(); }
  FitColour operator[](std::size_t pixel) const { return {luminance_[pixel], red_[pixel], blue_[pixel]}; }
  void set(std::size_t pixel, const FitColour& colour) {
    luminance_[pixel] = colour.luminance;
    red_[pixel] = colour.red;
    blue_[pixel] = colour.blue;
  }

 private:
  std::vector<float> luminance_, red_, blue_;
};

/// A part of a layer's pictures, around a block of cells whose strokes are planned one after the other: `x`, `y` are
/// counted from the picture's first pixel, everything else from the tile's.
struct FitTile {
  FitTile(const LayerPlan& plan, const PaintedPicture& canvas, int left, int top, int right, int bottom);

  int left, top, width, height;
  /// By pixel: what is wanted, what is painted, and how much a difference counts there.
  FitColours wanted, painted;
  std::vector<float> weight;
  /// The weighted error of each pixel, in squared steps; larger where nothing is painted.
  std::vector<float> error;
  std::vector<float> coverage;   ///< as the canvas's
  std::vector<float> disparity;  ///< pixels

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  bool contains(float x, float y) const {
    return x >= 0 && y >= 0 && x < static_cast<float>(width) && y < static_cast<float>(height);
  }
  /// Computes the error of a pixel from its wanted and painted colours.
  void find_error(std::size_t pixel) {
    error[pixel] = is_bare(pixel) ? squared_error_of_bare : weight[pixel] * squared(wanted[pixel] - painted[pixel]);
  }
  bool is_bare(std::size_t pixel) const { return coverage[pixel] < 0.5f; }
};

/// A stroke that is fitted to a tile, in the tile's pixels.
struct FittedStroke {
  std::vector<PlanePoint> points;  ///< of its spline
  float radius_px = 0;
  FitColour begin, end;  ///< its colour along it
  float disparity = 0;   ///< of the surface in its middle
  friend bool operator==(const FittedStroke&, const FittedStroke&) = default;
};

/// How far a stroke of a layer reaches from where it is begun, in pixels.
float fitted_reach_px(float radius_px);

/// The stroke through a pixel of the tile that lowers the error most: it runs along the picture's lines both ways as
/// long as its colour fits better than what is painted, and its length, width and colour are those that fit best (after
/// Shiraishi & Yamaguchi 2000, who take length, width and angle from moments, and Hertzmann 1998, sec. 2.2). None where
/// it gains less than the plan asks for. `random` varies its colour.
std::optional<FittedStroke> fit_stroke(const FitTile& tile, const LayerPlan& plan, int x, int y, std::uint64_t random);

/// Paints a fitted stroke in the tile, and on the canvas that contains the tile.
void paint_stroke(const FittedStroke& stroke, const LayerPlan& plan, FitTile& tile, PaintedPicture& canvas);

/// Plans the strokes of one layer by fitting each to the picture, on a canvas that holds those before it. A stroke is
/// kept if it lowers the squared difference between picture and canvas enough. Cells of 1.3 R are visited in two
/// passes; in each, the pixel that is most wrong begins a stroke. The picture is divided into blocks, which are planned
/// in four waves, so that the result does not depend on threads. In drawing order; a stroke's number is that of its
/// cell, from 1 to fitted_places, whatever other strokes there are.
Layer fit_layer(const LayerPlan& plan);
std::uint32_t fitted_places(const LayerPlan& plan);

}  // namespace wheatstone
