#include "wheatstone/marks/brush_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/marks/built_in_brushes_internal.h"

namespace wheatstone {

int brush_level(float radius_px) {
  const float level = std::log2(BrushPicture::width / (2 * radius_px));
  return std::clamp(static_cast<int>(std::lround(level)), 0, static_cast<int>(BrushPicture::sizes.size()) - 1);
}

BrushPicture brush_picture(std::string name, std::span<const std::uint8_t> cover) {
  BrushPicture picture{std::move(name), {cover.begin(), cover.end()}};
  picture.levels.resize(BrushPicture::all_bytes);
  for (std::size_t l = 1; l < BrushPicture::sizes.size(); ++l) {
    const auto& [columns, rows, first] = BrushPicture::sizes[l];
    const auto width = static_cast<std::size_t>(columns), height = static_cast<std::size_t>(rows);
    const std::uint8_t* finer = picture.levels.data() + BrushPicture::sizes[l - 1].first;
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        const std::uint8_t* at = finer + 4 * y * width + 2 * x;
        const int sum = at[0] + at[1] + at[2 * width] + at[2 * width + 1];
        picture.levels[first + y * width + x] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return picture;
}

std::span<const std::string_view> brush_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const BuiltInBrush& brush : built_in_brushes()) all.push_back(brush.name);
    return all;
  }();
  return names;
}

BrushPicture built_in_brush(std::string_view name) {
  for (const BuiltInBrush& brush : built_in_brushes())
    if (brush.name == name)
      return brush_picture(std::string(name), {brush.cover, std::size_t{BrushPicture::length} * BrushPicture::width});
  return {};
}

}  // namespace wheatstone
