#include "wheatstone/app/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone {
namespace {

constexpr int tile_width = 320, tile_height = 240, caption_height = 26, gap = 12;
constexpr int caption_font = cv::FONT_HERSHEY_SIMPLEX;
constexpr double caption_letters = 0.45;

/// The end of a caption that fits a tile: names of one folder begin alike. OpenCV's letters are those of ASCII.
std::string fitting(std::string caption) {
  for (char& letter : caption)
    if (static_cast<unsigned char>(letter) > 126) letter = '?';
  const auto width = [](const std::string& text) {
    int below = 0;
    return cv::getTextSize(text, caption_font, caption_letters, 1, &below).width;
  };
  if (width(caption) <= tile_width) return caption;
  while (!caption.empty() && width("..." + caption) > tile_width) caption.erase(0, 1);
  return "..." + caption;
}

void put_picture(const Image<Rgb8>& picture, cv::Mat sheet, cv::Point corner) {
  const double scale = std::min(
      {static_cast<double>(tile_width) / picture.width(), static_cast<double>(tile_height) / picture.height(), 1.});
  const cv::Size size(std::max(static_cast<int>(std::lround(scale * picture.width())), 1),
                      std::max(static_cast<int>(std::lround(scale * picture.height())), 1));
  const cv::Rect place(corner.x + (tile_width - size.width) / 2, corner.y + tile_height - size.height, size.width,
                       size.height);
  cv::resize(as_mat(picture), sheet(place), size, 0, 0, cv::INTER_AREA);
}

}  // namespace

Image<Rgb8> contact_sheet(std::span<const SheetEntry> entries) {
  const int count = static_cast<int>(entries.size());
  const int columns = std::max(static_cast<int>(std::ceil(std::sqrt(count))), 1);
  const int rows = std::max((count + columns - 1) / columns, 1);
  constexpr int across = tile_width + gap, down = tile_height + caption_height + gap;
  Image<Rgb8> sheet(columns * across + gap, rows * down + gap, {255, 255, 255});
  for (int i = 0; i < count; ++i) {
    const cv::Point corner(gap + i % columns * across, gap + i / columns * down);
    put_picture(read_image(entries[i].picture), as_mat(sheet), corner);
    cv::putText(as_mat(sheet), fitting(entries[i].caption), {corner.x, corner.y + tile_height + 18}, caption_font,
                caption_letters, {40, 40, 40}, 1, cv::LINE_AA);
  }
  return sheet;
}

}  // namespace wheatstone
