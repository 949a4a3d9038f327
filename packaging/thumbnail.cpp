// Draws a painting (.wst) as a file manager shows it, as the freedesktop thumbnailers do.
//
//   wheatstone-thumbnail PAINTING PICTURE SIZE

#include <algorithm>
#include <charconv>
#include <exception>
#include <iostream>
#include <string_view>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/pictures/write_image.h"

namespace {

using namespace wheatstone;

/// 0 where the text is no size.
int size_of(std::string_view text) {
  int size = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), size);
  constexpr int largest = 4096;
  return error == std::errc{} && stop == text.data() + text.size() && size > 0 && size <= largest ? size : 0;
}

void draw_thumbnail(const char* from, const char* to, int size) {
  const Painting painting = read_painting(from);
  const int width = width_of(painting), height = height_of(painting);
  const double scale = std::min(1., static_cast<double>(size) / std::max(width, height));
  const Placement smaller{.width = std::max(1, static_cast<int>(width * scale)),
                          .height = std::max(1, static_cast<int>(height * scale)),
                          .scale = scale};
  write_image(to, draw(prepare(painting, {.placement = smaller}), left_eye).picture);
}

}  // namespace

int main(int count, char** words) {
  const int size = count == 4 ? size_of(words[3]) : 0;
  if (size == 0) {
    std::cerr << "usage: wheatstone-thumbnail PAINTING PICTURE SIZE, with a size of at most 4096 pixels\n";
    return 2;
  }
  try {
    draw_thumbnail(words[1], words[2], size);
  } catch (const std::exception& error) {
    std::cerr << "wheatstone-thumbnail: " << error.what() << '\n';
    return 3;
  }
  return 0;
}
