#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "wheatstone/strokes/fine_colours_internal.h"

namespace wheatstone {
namespace {

using Levels = std::array<float, 3>;  ///< 0..255, red, green and blue

/// The mean of the picture in a disc; none outside it.
std::optional<Levels> mean_around(const DeepPicture& picture, float x, float y, float radius_px) {
  const ImageView<const Rgb16> pixels = picture.left;
  x *= picture.scale, y *= picture.scale;
  const float radius = std::max(radius_px * picture.scale, 1.f);
  const int first = std::max(static_cast<int>(std::ceil(y - radius - 0.5f)), 0),
            last = std::min(static_cast<int>(std::floor(y + radius - 0.5f)), pixels.height() - 1);
  std::array<std::uint64_t, 3> sums{};
  std::uint64_t count = 0;
  for (int row = first; row <= last; ++row) {
    const float down = static_cast<float>(row) + 0.5f - y;
    const float half = std::sqrt(std::max(radius * radius - down * down, 0.f));
    const int left = std::max(static_cast<int>(std::ceil(x - half - 0.5f)), 0),
              right = std::min(static_cast<int>(std::floor(x + half - 0.5f)), pixels.width() - 1);
    for (int column = left; column <= right; ++column) {
      const Rgb16 pixel = pixels(column, row);
      sums[0] += pixel.r, sums[1] += pixel.g, sums[2] += pixel.b;
      ++count;
    }
  }
  if (count == 0) return {};
  Levels mean;
  std::ranges::transform(sums, mean.begin(), [&](std::uint64_t sum) {
    return static_cast<float>(static_cast<double>(sum) / static_cast<double>(count) / deep_level);
  });
  return mean;
}

/// What is added to a colour so that it becomes `mean`, where that is near.
std::array<std::int8_t, 3> refinement(const std::array<int, 3>& colour, const std::optional<Levels>& mean) {
  std::array<std::int8_t, 3> fine{};
  if (!mean) return fine;
  Levels differences;
  for (std::size_t c = 0; c < 3; ++c) differences[c] = (*mean)[c] - static_cast<float>(colour[c]);
  const float largest = std::ranges::max(differences, {}, [](float difference) { return std::abs(difference); });
  const float share = std::clamp(2 - std::abs(largest), 0.f, 1.f);
  for (std::size_t c = 0; c < 3; ++c)
    fine[c] = static_cast<std::int8_t>(
        std::clamp(std::lround(share * differences[c] * FineColour::steps_a_level), -127L, 127L));
  return fine;
}

}  // namespace

void refine_colours(const DeepPicture& picture, std::uint32_t last_number, Layer& layer) {
  tbb::parallel_for(std::size_t{0}, layer.strokes.size(), [&](std::size_t i) {
    Stroke& stroke = layer.strokes[i];
    if (stroke.number <= last_number) return;
    const auto refined = [&](const ControlPoint& point, const std::array<int, 3>& colour) {
      const float x = x_in_view(point, stroke.reference_view, left_eye);
      return refinement(colour, mean_around(picture, x, point.y, stroke.radius_px));
    };
    const auto points = layer.points_of(stroke);
    const std::array<int, 3> begin{stroke.colour.r, stroke.colour.g, stroke.colour.b};
    stroke.fine.begin = refined(points.front(), begin);
    stroke.fine.end = stroke.fine.begin;
    if (stroke.change != ColourChange())
      stroke.fine.end =
          refined(points.back(), {begin[0] + stroke.change.r, begin[1] + stroke.change.g, begin[2] + stroke.change.b});
  });
}

}  // namespace wheatstone
