#include "wheatstone/app/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <vector>

#include "wheatstone/display/lettering.h"
#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone {
namespace {

constexpr int caption_height = 26, gap = 12;

/// The end of a caption, as names of one folder begin alike, in UTF-8.
std::string shortened(std::string_view caption) {
  constexpr std::size_t most_characters = 44;
  std::vector<std::string_view> characters;
  while (!caption.empty()) {
    const std::size_t bytes = utf8_character_bytes(caption);
    characters.push_back(bytes == 0 ? "?" : caption.substr(0, bytes));
    caption.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  std::string text;
  const std::size_t left_out = characters.size() > most_characters ? characters.size() - most_characters : 0;
  if (left_out > 0) text = "…";
  for (std::size_t i = left_out; i < characters.size(); ++i) text += characters[i];
  return text;
}

/// A caption below a tile; letters that no font of the machine has are question marks.
void put_caption(const std::string& caption, int tile_width, cv::Point corner, Image<Rgb8>& sheet) {
  constexpr int letter_px = 14;
  std::string text = shortened(caption);
  for (const bool is_last : {false, true}) {
    try {
      const Lettering set = set_text(text, letter_px, tile_width);
      return lay_cover(set.cover, corner.x, corner.y + (caption_height - set.cover.height() / set.lines) / 2,
                       {40, 40, 40}, sheet);
    } catch (const Error&) {
      if (is_last) return;  // no font at all
      for (char& letter : text)
        if (static_cast<unsigned char>(letter) > 126) letter = '?';
    }
  }
}

void put_picture(const Image<Rgb8>& picture, const SheetLayout& layout, cv::Mat sheet, cv::Point corner) {
  const int tile_width = layout.tile_width, tile_height = layout.tile_height;
  const double scale = std::min(
      {static_cast<double>(tile_width) / picture.width(), static_cast<double>(tile_height) / picture.height(), 1.});
  const cv::Size size(std::max(static_cast<int>(std::lround(scale * picture.width())), 1),
                      std::max(static_cast<int>(std::lround(scale * picture.height())), 1));
  const cv::Rect place(corner.x + (tile_width - size.width) / 2, corner.y + tile_height - size.height, size.width,
                       size.height);
  cv::resize(as_mat(picture), sheet(place), size, 0, 0, cv::INTER_AREA);
}

}  // namespace

Image<Rgb8> contact_sheet(std::span<const SheetEntry> entries, const SheetLayout& layout) {
  const int count = static_cast<int>(entries.size());
  const int columns = layout.columns > 0 ? layout.columns : std::max(static_cast<int>(std::ceil(std::sqrt(count))), 1);
  const int rows = std::max((count + columns - 1) / columns, 1);
  const int across = layout.tile_width + gap, down = layout.tile_height + caption_height + gap;
  Image<Rgb8> sheet(columns * across + gap, rows * down + gap, {255, 255, 255});
  for (int i = 0; i < count; ++i) {
    const cv::Point corner(gap + i % columns * across, gap + i / columns * down);
    if (entries[i].picture.empty()) continue;
    put_picture(read_image(entries[i].picture), layout, as_mat(sheet), corner);
    put_caption(entries[i].caption, layout.tile_width, {corner.x, corner.y + layout.tile_height}, sheet);
  }
  return sheet;
}

}  // namespace wheatstone
