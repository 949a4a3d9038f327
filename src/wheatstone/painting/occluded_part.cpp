#include "wheatstone/painting/occluded_part_internal.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "wheatstone/painting/easel_internal.h"
#include "wheatstone/painting/resize_strokes.h"
#include "wheatstone/stereo/occlusion.h"

namespace wheatstone {
namespace {

constexpr int reduction = 2;

/// What the view sees, at half size; an odd last row or column is left to its neighbours' strokes.
struct HalfView {
  explicit HalfView(int width, int height)
      : photograph(width / reduction, height / reduction),
        disparity(width / reduction, height / reduction),
        seeds(width / reduction, height / reduction) {}
  Image<Rgb8> photograph;
  Image<float> disparity;
  Image<std::uint8_t> seeds;
};

Rgb8 mean(Rgb8 a, Rgb8 b, Rgb8 c, Rgb8 d) {
  const auto channel = [&](std::uint8_t Rgb8::*m) {
    return static_cast<std::uint8_t>((a.*m + b.*m + c.*m + d.*m + 2) / 4);
  };
  return {channel(&Rgb8::r), channel(&Rgb8::g), channel(&Rgb8::b)};
}

HalfView halved(const Image<Rgb8>& photograph, const Image<float>& disparity, const Image<std::uint8_t>& seeds) {
  HalfView half(photograph.width(), photograph.height());
  tbb::parallel_for(0, half.photograph.height(), [&](int y) {
    const auto upper = photograph.row(2 * y), lower = photograph.row(2 * y + 1);
    const auto upper_seeds = seeds.row(2 * y), lower_seeds = seeds.row(2 * y + 1);
    const auto near = disparity.row(2 * y);
    for (int x = 0; x < half.photograph.width(); ++x) {
      const int left = 2 * x, right = left + 1;
      half.photograph(x, y) = mean(upper[left], upper[right], lower[left], lower[right]);
      half.disparity(x, y) = near[left] / reduction;
      half.seeds(x, y) = upper_seeds[left] | upper_seeds[right] | lower_seeds[left] | lower_seeds[right];
    }
  });
  return half;
}

}  // namespace

Painting plan_occluded_part(const Image<Rgb8>& photograph, const Image<float>& disparity,
                            const Image<std::uint8_t>& occlusion, float view, const Style& style) {
  const int width = photograph.width(), height = photograph.height();
  const float largest_radius_px = ScaledStyle(style, width).radii_px.front();
  const Image<std::uint8_t> seeds =
      dilate_occlusion(occlusion, static_cast<int>(std::lround(style.occlusion_dilation * largest_radius_px)));
  const HalfView half = halved(photograph, disparity, seeds);
  Painting part{width, height, style.canvas_colour, std::vector<Layer>(style.radii_px.size())};
  if (half.photograph.empty()) return part;

  Easel easel(half.photograph, half.disparity, view, style);
  easel.avoid_mixed_colours = false;  // no other eye sees them
  part.layers = plan_alone(easel, style, ScaledStyle(style, width, reduction), half.seeds).layers;
  for (Layer& layer : part.layers) resize_strokes(layer, reduction);
  return part;
}

}  // namespace wheatstone
