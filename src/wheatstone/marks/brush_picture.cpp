#include "wheatstone/marks/brush_picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/marks/built_in_brushes_internal.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone {
namespace {

/// Grey values of a picture, averaged over each cell of a grid of length × width.
std::vector<std::uint8_t> averaged(const Image<Rgb8>& picture) {
  const auto cell = [](int i, int cells, int size) {
    const int begin = static_cast<int>(std::int64_t{i} * size / cells);
    return std::pair{begin, std::max(static_cast<int>(std::int64_t{i + 1} * size / cells), begin + 1)};
  };
  std::vector<std::uint8_t> cover;
  cover.reserve(std::size_t{BrushPicture::length} * BrushPicture::width);
  for (int row = 0; row < BrushPicture::width; ++row) {
    const auto [top, bottom] = cell(row, BrushPicture::width, picture.height());
    for (int column = 0; column < BrushPicture::length; ++column) {
      const auto [left, right] = cell(column, BrushPicture::length, picture.width());
      std::uint64_t sum = 0;
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) sum += picture(x, y).r + picture(x, y).g + picture(x, y).b;
      const std::uint64_t count = 3 * static_cast<std::uint64_t>(bottom - top) * static_cast<unsigned>(right - left);
      cover.push_back(static_cast<std::uint8_t>((sum + count / 2) / count));
    }
  }
  return cover;
}

}  // namespace

int brush_level(float radius_px) {
  const float level = std::log2(BrushPicture::width / (2 * radius_px));
  return std::clamp(static_cast<int>(std::lround(level)), 0, static_cast<int>(BrushPicture::sizes.size()) - 1);
}

BrushPicture brush_picture(std::string name, std::span<const std::uint8_t> cover) {
  BrushPicture picture{std::move(name), {cover.begin(), cover.end()}};
  picture.levels.resize(BrushPicture::all_bytes);
  for (std::size_t l = 1; l < BrushPicture::sizes.size(); ++l) {
    const auto& [columns, rows, first] = BrushPicture::sizes[l];
    const std::uint8_t* finer = picture.levels.data() + BrushPicture::sizes[l - 1].first;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const std::uint8_t* at = finer + (2 * y) * (2 * columns) + 2 * x;
        const int sum = at[0] + at[1] + at[2 * columns] + at[2 * columns + 1];
        picture.levels[first + static_cast<std::size_t>(y * columns + x)] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return picture;
}

std::span<const std::string_view> brush_names() { return built_in_brush_names; }

BrushPicture read_brush(const std::string& name_or_path) {
  if (name_or_path.empty() || name_or_path == "none") return {};
  const auto built_in = std::ranges::find(built_in_brush_names, name_or_path);
  if (built_in != built_in_brush_names.end()) {
    const auto number = static_cast<std::size_t>(built_in - built_in_brush_names.begin());
    return brush_picture(name_or_path,
                         {built_in_brushes[number], std::size_t{BrushPicture::length} * BrushPicture::width});
  }
  const std::filesystem::path path = name_or_path;
  if (!path.has_extension() && !path.has_parent_path())
    throw Error(ErrorKind::wrong_usage, fmt::format("brush: there is no '{}', expected none, {} or a picture file",
                                                    name_or_path, fmt::join(built_in_brush_names, ", ")));
  BrushPicture picture = brush_picture(name_or_path, averaged(read_image(path)));
  if (std::ranges::all_of(picture.cover(), [](std::uint8_t cover) { return cover == 0; }))
    throw Error(ErrorKind::bad_input, fmt::format("{}: is black, expected a brush whose paint is white", name_or_path));
  return picture;
}

}  // namespace wheatstone
