#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "wheatstone/painting/diffusion_curves.h"

namespace wheatstone {
namespace {

/// Colour with a weight: 0 is unknown, 1 known.
struct Known {
  std::array<float, 3> colour{};
  float weight = 0;
};

/// What the lines say about each pixel; the nearest surface's where they disagree, and their mean where they lie on
/// one surface.
Image<Known> draw_lines(const DiffusionPainting& painting, float view) {
  Image<Known> known(painting.width, painting.height);
  Image<float> nearest(painting.width, painting.height);
  const auto width = static_cast<float>(painting.width), height = static_cast<float>(painting.height);
  const auto put = [&](float x, float y, float disparity, const std::array<float, 3>& colour) {
    if (!(x >= 0 && y >= 0 && x < width && y < height)) return;
    const int px = static_cast<int>(x), py = static_cast<int>(y);
    Known& pixel = known(px, py);
    constexpr float same_surface_px = 1;
    if (pixel.weight > 0 && disparity < nearest(px, py) - same_surface_px) return;
    if (pixel.weight > 0 && disparity > nearest(px, py) + same_surface_px) pixel = {};
    nearest(px, py) = disparity;
    for (std::size_t c = 0; c < 3; ++c) pixel.colour[c] += colour[c];
    ++pixel.weight;
  };
  const auto channels = [](Rgb8 c) {
    return std::array{static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
  };
  for (const ColourLine& line : painting.lines) {
    if (!line.views.contains(view)) continue;
    const auto points = painting.points_of(line);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ColourPoint &a = points[i], &b = points[std::min(i + 1, points.size() - 1)];
      const float ax = x_in_view(a.at, line.reference_view, view), bx = x_in_view(b.at, line.reference_view, view);
      const auto from = channels(a.colour), to = channels(b.colour);
      constexpr float steps_a_px = 2, longest_px = 8, most_stretched = 2.5f;
      const float length = std::hypot(bx - ax, b.at.y - a.at.y);
      // A line that the view tears apart is not drawn across the tear.
      const float planned = std::hypot(b.at.x - a.at.x, b.at.y - a.at.y);
      const int steps = length > std::max(longest_px, most_stretched * planned)
                            ? 1
                            : std::max(static_cast<int>(std::ceil(length * steps_a_px)), 1);
      for (int s = 0; s < steps; ++s) {
        const float t = static_cast<float>(s) / static_cast<float>(steps);
        std::array<float, 3> colour;
        for (std::size_t c = 0; c < 3; ++c) colour[c] = from[c] + t * (to[c] - from[c]);
        put(ax + t * (bx - ax), a.at.y + t * (b.at.y - a.at.y), a.at.disparity + t * (b.at.disparity - a.at.disparity),
            colour);
      }
    }
  }
  for (Known& pixel : known.pixels()) {
    if (pixel.weight <= 0) continue;
    for (float& c : pixel.colour) c /= pixel.weight;
    pixel.weight = 1;
  }
  return known;
}

Image<Known> halved(const Image<Known>& fine) {
  Image<Known> coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2);
  tbb::parallel_for(0, coarse.height(), [&](int y) {
    for (int x = 0; x < coarse.width(); ++x) {
      Known sum;
      for (int fy = 2 * y; fy < std::min(2 * y + 2, fine.height()); ++fy) {
        for (int fx = 2 * x; fx < std::min(2 * x + 2, fine.width()); ++fx) {
          const Known& part = fine(fx, fy);
          for (std::size_t c = 0; c < 3; ++c) sum.colour[c] += part.weight * part.colour[c];
          sum.weight += part.weight;
        }
      }
      if (sum.weight > 0)
        for (float& c : sum.colour) c /= sum.weight;
      sum.weight = std::min(sum.weight, 1.f);
      coarse(x, y) = sum;
    }
  });
  return coarse;
}

/// Fills what is unknown, or not wholly known, from the coarser picture.
void fill_from(const Image<Known>& coarse, Image<Known>& fine) {
  tbb::parallel_for(0, fine.height(), [&](int y) {
    const float cy =
        std::clamp((static_cast<float>(y) + 0.5f) / 2 - 0.5f, 0.f, static_cast<float>(coarse.height() - 1));
    const int y0 = static_cast<int>(cy), y1 = std::min(y0 + 1, coarse.height() - 1);
    const float v = cy - static_cast<float>(y0);
    for (int x = 0; x < fine.width(); ++x) {
      Known& pixel = fine(x, y);
      if (pixel.weight >= 1) continue;
      const float cx =
          std::clamp((static_cast<float>(x) + 0.5f) / 2 - 0.5f, 0.f, static_cast<float>(coarse.width() - 1));
      const int x0 = static_cast<int>(cx), x1 = std::min(x0 + 1, coarse.width() - 1);
      const float u = cx - static_cast<float>(x0);
      for (std::size_t c = 0; c < 3; ++c) {
        const float there = (1 - v) * ((1 - u) * coarse(x0, y0).colour[c] + u * coarse(x1, y0).colour[c]) +
                            v * ((1 - u) * coarse(x0, y1).colour[c] + u * coarse(x1, y1).colour[c]);
        pixel.colour[c] = pixel.weight * pixel.colour[c] + (1 - pixel.weight) * there;
      }
    }
  });
}

void pull_push(Image<Known>& known) {
  std::vector<Image<Known>> levels;
  levels.push_back(known);
  while (levels.back().width() > 1 || levels.back().height() > 1) levels.push_back(halved(levels.back()));
  for (std::size_t i = levels.size() - 1; i-- > 0;) fill_from(levels[i + 1], levels[i]);
  for (std::size_t i = 0; i < known.pixels().size(); ++i) known.pixels()[i].colour = levels[0].pixels()[i].colour;
}

/// Successive over-relaxation, on the red and then the black fields of a chequerboard; known pixels stay.
void settle(Image<Known>& known) {
  constexpr int rounds = 250;
  constexpr float over_relaxation = 1.95f;
  const int width = known.width(), height = known.height();
  for (int half = 0; half < 2 * rounds; ++half) {
    tbb::parallel_for(0, height, [&](int y) {
      const auto above = known.row(std::max(y - 1, 0)), here = known.row(y),
                 below = known.row(std::min(y + 1, height - 1));
      for (int x = (y + half) % 2; x < width; x += 2) {
        Known& pixel = here[x];
        if (pixel.weight >= 1) continue;
        const Known &left = here[std::max(x - 1, 0)], &right = here[std::min(x + 1, width - 1)];
        for (std::size_t c = 0; c < 3; ++c) {
          const float mean = (above[x].colour[c] + below[x].colour[c] + left.colour[c] + right.colour[c]) / 4;
          pixel.colour[c] += over_relaxation * (mean - pixel.colour[c]);
        }
      }
    });
  }
}

}  // namespace

DrawnView draw(const DiffusionPainting& painting, float view) {
  DrawnView drawn{Image<Rgb8>(painting.width, painting.height, {128, 128, 128}), 1,
                  Image<std::uint8_t>(painting.width, painting.height, 255), Image<float>()};
  Image<Known> known = draw_lines(painting, view);
  const bool any = std::ranges::any_of(known.pixels(), [](const Known& pixel) { return pixel.weight > 0; });
  if (!any) return drawn;
  pull_push(known);
  settle(known);
  const auto level = [](float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 255.f) + 0.5f); };
  for (std::size_t i = 0; i < known.pixels().size(); ++i) {
    const auto& c = known.pixels()[i].colour;
    drawn.picture.pixels()[i] = {level(c[0]), level(c[1]), level(c[2])};
    drawn.bare.pixels()[i] = 0;
  }
  drawn.bare_share = 0;
  return drawn;
}

}  // namespace wheatstone
