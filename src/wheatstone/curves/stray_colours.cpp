#include "wheatstone/curves/stray_colours_internal.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/image/opencv_internal.h"

namespace wheatstone {
namespace {

float distance(Rgb8 a, Rgb8 b) {
  return std::hypot(static_cast<float>(a.r - b.r), static_cast<float>(a.g - b.g), static_cast<float>(a.b - b.b));
}

/// True where a picture has nearly one colour within two pixels.
bool is_plain(const Image<Rgb8>& picture, int x, int y) {
  constexpr int reach = 2;
  constexpr float alike = 30;
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, picture.height() - 1); ++row)
    for (int column = std::max(x - reach, 0); column <= std::min(x + reach, picture.width() - 1); ++column)
      if (distance(picture(column, row), picture(x, y)) > alike) return false;
  return true;
}

void add_dot(const ViewOfEdges& view, float x, float y, Rgb8 colour, DiffusionPainting& painting) {
  painting.lines.push_back({static_cast<std::uint32_t>(painting.points.size()), 1, view.position, all_views});
  // A pixel's middle, so that all of the dot is one pixel's.
  const float column = std::floor(x) + 0.5f, row = std::floor(y) + 0.5f;
  painting.points.push_back({{column, row, view.disparity(static_cast<int>(column), static_cast<int>(row))}, colour});
}

}  // namespace

void add_dots_where_colours_stray(const ViewOfEdges& view, DiffusionPainting& painting) {
  constexpr int wanted_width_px = 320, cell_px = 4, rounds = 2;
  constexpr float strays_from = 36;
  const int width = view.picture.width(), height = view.picture.height();
  const int reduction = (width + wanted_width_px - 1) / wanted_width_px;
  Image<Rgb8> wanted(std::max(width / reduction, 1), std::max(height / reduction, 1));
  cv::Mat target = as_mat(wanted);
  const cv::Rect whole_blocks(0, 0, wanted.width() * reduction, wanted.height() * reduction);
  cv::resize(as_mat(view.picture)(whole_blocks), target, target.size(), 0, 0, cv::INTER_AREA);
  const float step_px = static_cast<float>(reduction);
  Image<std::uint8_t> has_dot(wanted.width(), wanted.height());
  for (int round = 0; round < rounds; ++round) {
    const PreparedPainting small =
        prepare(Painting{.marks = painting},
                {.placement = {.width = wanted.width(), .height = wanted.height(), .scale = 1 / step_px}});
    const Image<Rgb8> drawn = draw(small, view.position).picture;
    bool any = false;
    for (int y = cell_px / 2; y < wanted.height(); y += cell_px) {
      for (int x = cell_px / 2; x < wanted.width(); x += cell_px) {
        if (has_dot(x, y) != 0 || distance(drawn(x, y), wanted(x, y)) < strays_from || !is_plain(wanted, x, y))
          continue;
        has_dot(x, y) = 1;
        any = true;
        add_dot(view, (static_cast<float>(x) + 0.5f) * step_px, (static_cast<float>(y) + 0.5f) * step_px, wanted(x, y),
                painting);
      }
    }
    if (!any) return;
  }
}

}  // namespace wheatstone
