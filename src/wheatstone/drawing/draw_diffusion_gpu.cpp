#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "add_lines_source.h"
#include "fill_known_source.h"
#include "finish_diffusion_source.h"
#include "halve_known_source.h"
#include "know_lines_source.h"
#include "settle_colours_source.h"
#include "wheatstone/drawing/painting_gpu_internal.h"

namespace wheatstone {
namespace {

/// Parameters of add_lines.comp: numbers of four bytes, without gaps.
struct LineWork {
  std::int32_t width = 0, height = 0, margin = 0, pieces = 0;
  std::int32_t adds = 0, has_surfaces = 0;
  float first_photographed = 0, last_photographed = 0, tolerance_px = 0;
  std::array<float, most_gpu_views> view{};
};

/// A piece of a line, from one point to the next, as add_lines.comp reads it.
struct CurvePiece {
  struct Place {
    float x, y, disparity;
  };
  struct Colour {
    float red, green, blue;
  };
  Place a, b;
  Colour a_colour, b_colour;
  float reference_view, first_view, last_view;
  float a_overhang_px, b_overhang_px;
  std::int32_t is_continued, is_dot;
};

/// Parameters of the programs for a picture of one size.
struct LevelWork {
  std::int32_t width = 0, height = 0, coarse_width = 0, coarse_height = 0;
  std::int32_t odd = 0;
  std::int32_t margin = 0;  ///< columns on both sides that the view does not show
};

std::vector<CurvePiece> pieces_of(const PreparedLines& lines, const Surfaces& surfaces) {
  const auto place = [](const ColourPoint& point) {
    return CurvePiece::Place{point.at.x, point.at.y, point.at.disparity};
  };
  const auto colour = [](Rgb8 c) {
    return CurvePiece::Colour{static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
  };
  std::vector<CurvePiece> pieces;
  for (const ColourLine& line : lines.painting.lines) {
    const auto points = lines.painting.points_of(line);
    const std::int32_t is_continued = kind_of(line.reference_view, surfaces) == PlannedIn::other_view ? 1 : 0;
    for (std::size_t i = 0; i < std::max<std::size_t>(points.size() - 1, 1); ++i) {
      const std::size_t next = std::min(i + 1, points.size() - 1);
      const ColourPoint &a = points[i], &b = points[next];
      pieces.push_back({place(a), place(b), colour(a.colour), colour(b.colour), line.reference_view - central_view,
                        line.views.first - central_view, line.views.last - central_view,
                        lines.overhang_px(line.first_point + i), lines.overhang_px(line.first_point + next),
                        is_continued, points.size() == 1 ? 1 : 0});
    }
  }
  return pieces;
}

/// Each picture half the size of the one before, down to a pixel.
std::vector<LevelWork> levels_of(int width, int height) {
  std::vector<LevelWork> levels;
  while (true) {
    levels.push_back({width, height, (width + 1) / 2, (height + 1) / 2});
    if (width == 1 && height == 1) return levels;
    width = levels.back().coarse_width;
    height = levels.back().coarse_height;
  }
}

GpuBuffer buffer_of(const LevelWork& work) { return GpuBuffer(std::span<const LevelWork>(&work, 1)); }

}  // namespace

GpuDiffusion::GpuDiffusion(const PreparedLines& lines, const Surfaces& surfaces)
    : painting_(lines.painting),
      photographed_(photographed_views(surfaces)),
      add_lines_(add_lines_source),
      know_lines_(know_lines_source),
      halve_known_(halve_known_source),
      fill_known_(fill_known_source),
      settle_colours_(settle_colours_source),
      finish_diffusion_(finish_diffusion_source) {
  const std::vector<CurvePiece> pieces = pieces_of(lines, surfaces);
  piece_count_ = pieces.size();
  pieces_.emplace(std::span<const CurvePiece>(pieces));
}

GpuBuffer GpuDiffusion::lines(const GpuSurfaces& surfaces, const GpuBuffer& planes, const ViewsOnGpu& views) const {
  const int margin = diffusion_margin_px(painting_.width);
  const std::size_t pixels = static_cast<std::size_t>(painting_.width + 2 * margin) *
                             static_cast<std::size_t>(painting_.height) * views.positions.size();
  const GpuBuffer nearest(pixels * sizeof(std::uint32_t)), sums(4 * pixels * sizeof(std::uint32_t));
  LineWork work{.width = painting_.width,
                .height = painting_.height,
                .margin = margin,
                .pieces = static_cast<std::int32_t>(piece_count_),
                .has_surfaces = surfaces.empty() ? 0 : 1,
                .first_photographed = photographed_.first - central_view,
                .last_photographed = photographed_.last - central_view,
                .tolerance_px = surfaces.tolerance_px(),
                .view = gpu_views(views.positions)};
  for (work.adds = 0; work.adds < 2; ++work.adds) {
    const GpuBuffer of_work(std::span<const LineWork>(&work, 1));
    add_lines_.run({groups_of(piece_count_, 64), static_cast<std::uint32_t>(views.positions.size())},
                   {&of_work, &*pieces_, &planes, &nearest, &sums});
  }
  GpuBuffer known(4 * pixels * sizeof(float));
  constexpr std::size_t groups_a_row = 1024;
  know_lines_.run({groups_a_row, groups_of(pixels, 64 * groups_a_row)}, {&sums, &known});
  return known;
}

GpuBuffer GpuDiffusion::draw(const GpuSurfaces& surfaces, const GpuBuffer& planes, const ViewsOnGpu& views) const {
  constexpr int rounds = 40;
  const int margin = diffusion_margin_px(painting_.width);
  const auto count = static_cast<std::uint32_t>(views.positions.size());
  const std::vector<LevelWork> levels = levels_of(painting_.width + 2 * margin, painting_.height);
  const auto pixels_of = [count](const LevelWork& level) {
    return static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height) * count;
  };
  std::vector<GpuBuffer> known;
  known.push_back(lines(surfaces, planes, views));
  for (std::size_t i = 1; i < levels.size(); ++i) {
    GpuBuffer coarse(pixels_of(levels[i]) * 4 * sizeof(float));
    const GpuBuffer work = buffer_of(levels[i - 1]);
    halve_known_.run({groups_of(levels[i].width, 64), static_cast<std::uint32_t>(levels[i].height), count},
                     {&work, &known.back(), &coarse});
    known.push_back(std::move(coarse));
  }
  const GpuBuffer* settled = &known.back();
  std::optional<GpuBuffer> colours, finer;
  for (std::size_t i = levels.size() - 1; i-- > 0;) {
    finer.emplace(pixels_of(levels[i]) * 4 * sizeof(float));
    LevelWork level = levels[i];
    const GpuBuffer even = buffer_of(level);
    level.odd = 1;
    const GpuBuffer odd = buffer_of(level);
    const auto rows = static_cast<std::uint32_t>(level.height);
    fill_known_.run({groups_of(level.width, 64), rows, count}, {&even, &known[i], settled, &*finer});
    for (int half = 0; half < 2 * rounds; ++half)
      settle_colours_.run({groups_of((level.width + 1) / 2, 64), rows, count},
                          {half % 2 == 0 ? &even : &odd, &known[i], &*finer});
    colours.emplace(std::move(*finer));
    settled = &*colours;
  }
  GpuBuffer pixels(static_cast<std::size_t>(painting_.width) * static_cast<std::size_t>(painting_.height) * count *
                   sizeof(std::uint32_t));
  LevelWork finest = levels[0];
  finest.margin = margin;
  const GpuBuffer work = buffer_of(finest);
  finish_diffusion_.run({groups_of(painting_.width, 64), static_cast<std::uint32_t>(painting_.height), count},
                        {&work, settled, &known.back(), &pixels});
  return pixels;
}

}  // namespace wheatstone
