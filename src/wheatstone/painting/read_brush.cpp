#include "wheatstone/painting/read_brush.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/image/image.h"
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

BrushPicture read_brush(const std::string& name_or_path) {
  if (name_or_path.empty() || name_or_path == "none") return {};
  if (BrushPicture built_in = built_in_brush(name_or_path); !built_in.empty()) return built_in;
  const std::filesystem::path path = name_or_path;
  if (!path.has_extension() && !path.has_parent_path())
    throw Error(ErrorKind::wrong_usage, fmt::format("brush: there is no '{}', expected none, {} or a picture file",
                                                    name_or_path, fmt::join(brush_names(), ", ")));
  BrushPicture picture = brush_picture(name_or_path, averaged(read_image(path)));
  if (std::ranges::all_of(picture.cover(), [](std::uint8_t cover) { return cover == 0; }))
    throw Error(ErrorKind::bad_input, fmt::format("{}: is black, expected a brush whose paint is white", name_or_path));
  return picture;
}

}  // namespace wheatstone
