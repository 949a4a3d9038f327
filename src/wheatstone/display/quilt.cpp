#include "wheatstone/display/quilt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

/// Upper left pixel of a view's place.
std::pair<int, int> place_of(int view, const QuiltLayout& layout, int width, int height) {
  return {view % layout.columns * width, (layout.rows - 1 - view / layout.columns) * height};
}

}  // namespace

Image<Rgb8> make_quilt(std::span<const Image<Rgb8>> views, const QuiltLayout& layout) {
  if (layout.columns < 1 || layout.rows < 1 ||
      views.size() != static_cast<std::size_t>(layout.columns) * static_cast<std::size_t>(layout.rows))
    throw Error(ErrorKind::wrong_usage, fmt::format("a quilt of {}x{} holds {} views, but there are {}", layout.columns,
                                                    layout.rows, layout.columns * layout.rows, views.size()));
  const int width = views.front().width();
  const int height = views.front().height();
  Image<Rgb8> quilt(width * layout.columns, height * layout.rows);
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!same_size(views[v], views.front()))
      throw Error(ErrorKind::wrong_usage, "the views of a quilt must be of one size");
    const auto [left, top] = place_of(static_cast<int>(v), layout, width, height);
    for (int y = 0; y < height; ++y)
      std::ranges::copy(views[v].row(y), quilt.row(top + y).subspan(left, width).begin());
  }
  return quilt;
}

std::vector<Image<Rgb8>> views_of_quilt(ImageView<const Rgb8> quilt, const QuiltLayout& layout) {
  if (layout.columns < 1 || layout.rows < 1 || quilt.width() % layout.columns != 0 || quilt.height() % layout.rows != 0)
    throw Error(ErrorKind::wrong_usage, fmt::format("{}x{} pixels cannot be divided into a quilt of {}x{} views",
                                                    quilt.width(), quilt.height(), layout.columns, layout.rows));
  const int width = quilt.width() / layout.columns;
  const int height = quilt.height() / layout.rows;
  std::vector<Image<Rgb8>> views;
  for (int v = 0; v < layout.columns * layout.rows; ++v) {
    const auto [left, top] = place_of(v, layout, width, height);
    views.emplace_back(width, height);
    for (int y = 0; y < height; ++y)
      std::ranges::copy(quilt.row(top + y).subspan(left, width), views.back().row(y).begin());
  }
  return views;
}

std::string quilt_name(const std::string& stem, const QuiltLayout& layout, double aspect) {
  // As few digits as tell it: 0.75, 1.7778.
  return fmt::format("{}_qs{}x{}a{:.5g}.png", stem, layout.columns, layout.rows, aspect);
}

}  // namespace wheatstone
