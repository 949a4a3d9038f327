#include "wheatstone/display/quilt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

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
    put_into_quilt(views[v], static_cast<int>(v), layout, quilt);
  }
  return quilt;
}

void put_into_quilt(ImageView<const Rgb8> view, int number, const QuiltLayout& layout, ImageView<Rgb8> quilt) {
  const int width = view.width(), height = view.height();
  if (number < 0 || number >= layout.columns * layout.rows || width * layout.columns != quilt.width() ||
      height * layout.rows != quilt.height())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("view {} of {}x{} pixels has no place in a quilt of {}x{} views and {}x{} pixels", number,
                            width, height, layout.columns, layout.rows, quilt.width(), quilt.height()));
  const auto [left, top] = place_of(number, layout, width, height);
  for (int y = 0; y < height; ++y) std::ranges::copy(view.row(y), quilt.row(top + y).subspan(left, width).begin());
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

std::optional<NamedQuilt> quilt_of_name(const std::string& file_name) {
  static const std::regex ending(R"(.*_qs(\d{1,3})x(\d{1,3})a(\d{1,3}(?:\.\d{1,6})?)\.[A-Za-z0-9]+)");
  std::smatch said;
  if (!std::regex_match(file_name, said, ending)) return {};
  const NamedQuilt quilt{{std::stoi(said[1]), std::stoi(said[2])}, std::stod(said[3])};
  if (quilt.layout.columns < 1 || quilt.layout.rows < 1 || !(quilt.aspect > 0)) return {};
  return quilt;
}

}  // namespace wheatstone
