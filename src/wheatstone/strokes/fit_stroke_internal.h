#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wheatstone/image/colour.h"
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

  /// Converts a colour in sRGB, 0..255.
  static FitColour of(float r, float g, float b) {
    const float y = luma_of(r, g, b);
    return {luminance_step * y, red_step * (r - y), blue_step * (b - y)};
  }
  /// The colour in sRGB, 0..255, not rounded.
  std::array<float, 3> rgb() const {
    const float y = luminance / luminance_step, r = y + red / red_step, b = y + blue / blue_step;
    return {r, (y - luma_shares[0] * r - luma_shares[2] * b) / luma_shares[1], b};
  }
};

inline float squared(const FitColour& a) { return a.luminance * a.luminance + a.red * a.red + a.blue * a.blue; }
inline FitColour operator-(const FitColour& a, const FitColour& b) {
  return {a.luminance - b.luminance, a.red - b.red, a.blue - b.blue};
}

/// Columns [left, right) and rows [top, bottom) of a picture.
struct PixelArea {
  int left, top, right, bottom;
};

/// How much a difference counts at each pixel of an area, row by row: by the local contrast of the wanted luminance
/// relative to its brightness, so that dark detail counts as well, by View::detail, and beside depth edges. A weight
/// depends on the reference within `weight_reach_px`.
std::vector<float> difference_weights(const LayerPlan& plan, const PixelArea& area);
inline constexpr int weight_reach_px = 3;
/// Whether the weights depend on the depth edges.
bool weighs_outlines(const LayerPlan& plan);

/// The error of a pixel, in squared steps, from the difference between what is wanted and what is painted.
inline float error_of(const FitColour& difference, bool is_bare, float weight) {
  constexpr float of_bare = 900;  // more than paint of another colour costs, at any weight
  const float painted = weight * squared(difference);
  return is_bare ? of_bare * std::max(weight, 1.f) : painted;
}

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
  bool is_bare() const { return coverage() < 0.5f; }
};
using PaintedPicture = Image<PaintedPixel>;
void take_painted_row(const Canvas& canvas, int y, std::span<PaintedPixel> to);
PaintedPicture painted_picture(const BegunCanvas& begun);

/// The weighted errors of a row's pixels from `left` on, in squared steps; larger where nothing is painted.
void errors_of_row(const LayerPlan& plan, const PaintedPicture& canvas, int left, int y, std::span<const float> weights,
                   std::span<float> errors);

/// A part of a layer's pictures, around a block of cells whose strokes are planned one after the other. `left` and
/// `top` are counted from the picture's first pixel, everything else from the tile's. Borrows what it is made from.
class FitTile {
 public:
  FitTile(const LayerPlan& plan, PaintedPicture& canvas, int left, int top, int right, int bottom);

  const int left, top, width, height;

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  bool contains(float x, float y) const {
    return x >= 0 && y >= 0 && x < static_cast<float>(width) && y < static_cast<float>(height);
  }
  FitColour wanted(int x, int y) const {
    const ReferencePicture& reference = *plan_.reference;
    return FitColour::of(reference.red(left + x, top + y), reference.green(left + x, top + y),
                         reference.blue(left + x, top + y));
  }
  FitColour painted(int x, int y) const { return canvas_(left + x, top + y).colour(); }
  bool is_bare(int x, int y) const { return canvas_(left + x, top + y).is_bare(); }
  float disparity(int x, int y) const { return plan_.view.disparity(left + x, top + y); }
  /// How much a difference counts.
  float weight(int x, int y) const { return weights_[at(x, y)]; }
  /// The weighted error of a pixel, in squared steps; larger where nothing is painted.
  float error(int x, int y) const { return error_[at(x, y)]; }
  /// Paints a pixel of the canvas; `cover`: 0..1.
  void paint(int x, int y, const FitColour& colour, float cover);

 private:
  const LayerPlan& plan_;
  PaintedPicture& canvas_;
  std::vector<float> weights_, error_;
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

/// Paints a fitted stroke on the canvas of its tile.
void paint_stroke(const FittedStroke& stroke, const LayerPlan& plan, FitTile& tile);

/// Plans the strokes of one layer by fitting each to the picture, on a canvas that holds those before it. A stroke is
/// kept if it lowers the squared difference between picture and canvas enough. Cells of 1.3 R are visited in two
/// passes; in each, the pixel that is most wrong begins a stroke. The picture is divided into blocks, which are planned
/// in four waves, so that the result does not depend on threads. In drawing order; a stroke's number is that of its
/// cell, from 1 to fitted_places, whatever other strokes there are.
Layer fit_layer(const LayerPlan& plan, PaintedPicture canvas = {});
std::uint32_t fitted_places(const LayerPlan& plan);

}  // namespace wheatstone
