#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "wheatstone/drawing/prepared_painting_internal.h"

namespace wheatstone {
namespace {

/// A colour, and how firmly a pixel is held at it: 0 is unknown, 1 known.
struct Known {
  std::array<float, 3> colour{};
  float weight = 0;
};

/// A place of a line, as the view sees it.
struct LinePlace {
  float x, y, disparity;
  std::array<float, 3> colour;
  float length_px;  ///< length of line that the place stands for
  ViewPosition planned_in;
  std::array<float, 2> overhangs_px;  ///< of the points at both ends, see PreparedLines
};

/// Calls `use(place)` along every line that the view shows, some places to a pixel.
template <class Use>
void walk_lines(const PreparedLines& prepared, ViewPosition view, Use use) {
  const DiffusionPainting& painting = prepared.painting;
  const auto channels = [](Rgb8 c) {
    return std::array{static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
  };
  for (const ColourLine& line : painting.lines) {
    if (!line.views.contains(view)) continue;
    const auto points = painting.points_of(line);
    for (std::size_t i = 0; i < std::max<std::size_t>(points.size() - 1, 1); ++i) {
      const std::size_t next = std::min(i + 1, points.size() - 1);
      const ColourPoint &a = points[i], &b = points[next];
      const std::array overhangs_px{prepared.overhang_px(line.first_point + i),
                                    prepared.overhang_px(line.first_point + next)};
      const float ax = x_in_view(a.at, line.reference_view, view), bx = x_in_view(b.at, line.reference_view, view);
      const auto from = channels(a.colour), to = channels(b.colour);
      constexpr float steps_a_px = 2, longest_px = 8, most_stretched = 2.5f;
      const float length = std::hypot(bx - ax, b.at.y - a.at.y);
      // A line that the view tears apart is not drawn across the tear; a point alone is a dot.
      const float planned = std::hypot(b.at.x - a.at.x, b.at.y - a.at.y);
      const bool torn = length > std::max(longest_px, most_stretched * planned);
      const int steps = torn ? 1 : std::max(static_cast<int>(std::ceil(length * steps_a_px)), 1);
      const float step_px = torn || points.size() == 1 ? 1 : length / static_cast<float>(steps);
      for (int s = 0; s < steps; ++s) {
        const float t = torn ? 0 : (static_cast<float>(s) + 0.5f) / static_cast<float>(steps);
        std::array<float, 3> colour;
        for (std::size_t c = 0; c < 3; ++c) colour[c] = from[c] + t * (to[c] - from[c]);
        use(LinePlace{ax + t * (bx - ax), a.at.y + t * (b.at.y - a.at.y),
                      a.at.disparity + t * (b.at.disparity - a.at.disparity), colour, step_px, line.reference_view,
                      overhangs_px});
      }
    }
  }
}

/// Calls `use(x, y, share)` for the four pixels about a place, with their shares of it.
template <class Use>
void spread(const LinePlace& place, int width, int height, Use use) {
  const float left = place.x - 0.5f, top = place.y - 0.5f;
  if (!(left > -1 && top > -1 && left < static_cast<float>(width) && top < static_cast<float>(height))) return;
  const int x0 = static_cast<int>(std::floor(left)), y0 = static_cast<int>(std::floor(top));
  const float u = left - static_cast<float>(x0), v = top - static_cast<float>(y0);
  for (const auto& [x, y, share] : {std::tuple(x0, y0, (1 - u) * (1 - v)), std::tuple(x0 + 1, y0, u * (1 - v)),
                                    std::tuple(x0, y0 + 1, (1 - u) * v), std::tuple(x0 + 1, y0 + 1, u * v)})
    if (share > 0 && x >= 0 && y >= 0 && x < width && y < height) use(x, y, share);
}

/// Whether surfaces hide a place of a line. A surface that reaches over the place even in the view where the line was
/// planned does not count. Every view has its own lines beside the surfaces that hide something; in photographed views,
/// lines of views without a photograph give way.
bool is_hidden(const LinePlace& place, ViewPosition view, const Hiding& hiding) {
  const bool gives_way = hiding.photographed_views.contains(view) && hiding.is_continued(place.planned_in);
  const ViewPosition planned_in = gives_way ? place.planned_in : hiding.reference_view;
  const auto hidden_at = [&](float x) { return is_hidden(x, place.y, place.disparity, planned_in, hiding); };
  constexpr float half_px = 0.5f;  // precision to which surfaces are known
  return hidden_at(place.x - half_px) && hidden_at(place.x + half_px) &&
         std::ranges::all_of(place.overhangs_px,
                             [&](float overhang_px) { return overhang_px == 0 || hidden_at(place.x + overhang_px); });
}

/// The colour that lines give to each pixel, and its weight. A line has full weight in a pixel through whose middle it
/// runs, and less weight in pixels up to one pixel away, so that an edge between two lines keeps its place within a
/// pixel. Where lines lie on several surfaces, those of the nearest surface count; lines on one surface are averaged.
/// The picture has a margin on both sides.
Image<Known> draw_lines(const PreparedLines& lines, ViewPosition view, const Hiding& hiding) {
  constexpr float same_surface_px = 1;
  const int margin = diffusion_margin_px(lines.painting.width);
  const int width = lines.painting.width + 2 * margin, height = lines.painting.height;
  Image<float> nearest(width, height, -std::numeric_limits<float>::infinity());
  walk_lines(lines, view, [&](LinePlace place) {
    if (is_hidden(place, view, hiding)) return;
    place.x += static_cast<float>(margin);
    spread(place, width, height, [&](int x, int y, float share) {
      constexpr float least_share = 0.25f;
      if (share >= least_share) nearest(x, y) = std::max(nearest(x, y), place.disparity);
    });
  });
  Image<Known> known(width, height);
  walk_lines(lines, view, [&](LinePlace place) {
    if (is_hidden(place, view, hiding)) return;
    place.x += static_cast<float>(margin);
    spread(place, width, height, [&](int x, int y, float share) {
      if (place.disparity < nearest(x, y) - same_surface_px) return;
      Known& pixel = known(x, y);
      const float weight = share * place.length_px;
      for (std::size_t c = 0; c < 3; ++c) pixel.colour[c] += weight * place.colour[c];
      pixel.weight += weight;
    });
  });
  for (Known& pixel : known.pixels()) {
    if (pixel.weight <= 0) continue;
    for (float& c : pixel.colour) c /= pixel.weight;
    pixel.weight = std::min(pixel.weight, 1.f);
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

/// Fills pixels that are unknown or only partly known from the coarser picture.
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

/// Successive over-relaxation, on the red and then the black fields of a chequerboard; each pixel is held at the colour
/// of its lines by their weight.
void settle(const Image<Known>& lines, int rounds, Image<Known>& colours) {
  constexpr float over_relaxation = 1.8f;
  const int width = colours.width(), height = colours.height();
  for (int half = 0; half < 2 * rounds; ++half) {
    tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](const tbb::blocked_range<int>& rows) {
      for (int y = rows.begin(); y < rows.end(); ++y) {
        const auto above = colours.row(std::max(y - 1, 0)), here = colours.row(y),
                   below = colours.row(std::min(y + 1, height - 1));
        const auto held = lines.row(y);
        for (int x = (y + half) % 2; x < width; x += 2) {
          const Known& line = held[x];
          if (line.weight >= 1) continue;
          // All four numbers of a pixel are treated alike, so that they fit in one vector; the weight in `colours` is
          // never read.
          const auto numbers = [](const Known& known) { return std::bit_cast<std::array<float, 4>>(known); };
          const auto left = numbers(here[std::max(x - 1, 0)]), right = numbers(here[std::min(x + 1, width - 1)]);
          const auto over = numbers(above[x]), under = numbers(below[x]), own = numbers(line);
          auto pixel = numbers(here[x]);
          for (std::size_t c = 0; c < 4; ++c) {
            const float mean = (over[c] + under[c] + left[c] + right[c]) / 4;
            const float wanted = mean + line.weight * (own[c] - mean);
            pixel[c] += over_relaxation * (wanted - pixel[c]);
          }
          here[x] = std::bit_cast<Known>(pixel);
        }
      }
    });
  }
}

/// From the coarsest picture to the finest, each begun with what the coarser one settled to.
void spread_colours(Image<Known>& known) {
  constexpr int rounds = 40;
  std::vector<Image<Known>> levels;
  levels.push_back(known);
  while (levels.back().width() > 1 || levels.back().height() > 1) levels.push_back(halved(levels.back()));
  Image<Known> coarser = levels.back();
  for (std::size_t i = levels.size() - 1; i-- > 0;) {
    Image<Known> colours = levels[i];
    fill_from(coarser, colours);
    settle(levels[i], rounds, colours);
    coarser = std::move(colours);
  }
  known = std::move(coarser);
}

DrawnView draw_view(const PreparedLines& lines, ViewPosition view, const Hiding& hiding) {
  const DiffusionPainting& painting = lines.painting;
  DrawnView drawn{Image<Rgb8>(painting.width, painting.height, {128, 128, 128}), 1,
                  Image<std::uint8_t>(painting.width, painting.height, 255)};
  Image<Known> known = draw_lines(lines, view, hiding);
  const bool any = std::ranges::any_of(known.pixels(), [](const Known& pixel) { return pixel.weight > 0; });
  if (!any) return drawn;
  spread_colours(known);
  const auto level = [](float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 255.f) + 0.5f); };
  const int margin = diffusion_margin_px(painting.width);
  for (int y = 0; y < painting.height; ++y) {
    for (int x = 0; x < painting.width; ++x) {
      const auto& c = known(x + margin, y).colour;
      drawn.picture(x, y) = {level(c[0]), level(c[1]), level(c[2])};
    }
  }
  std::ranges::fill(drawn.bare.pixels(), std::uint8_t{0});
  drawn.bare_share = 0;
  return drawn;
}

}  // namespace

void draw_marks(const PreparedLines& lines, const Surfaces& surfaces, std::span<const ViewToDraw> views) {
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    const SeenSurfaces seen =
        seen_surfaces(surfaces, views[i].position, {lines.painting.width, 0, lines.painting.height});
    views[i].drawn = draw_view(lines, views[i].position, seen.hiding);
  });
}

}  // namespace wheatstone
