#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A TrueType font of this machine that has all letters of the text, upright and of usual weight: DejaVu Sans, Noto
/// Sans or Liberation Sans where they have them, else the first by name. Throws Error: wrong_usage where the text is
/// not UTF-8, cannot_read_write where no font has its letters.
std::filesystem::path font_for(std::string_view text);

/// Texts of one font and size, each as a line that is as wide as its letters: 0 is bare, 255 is covered. The base of
/// all letters is equally far below the upper edge. Throws as font_for, which is asked for all letters of the texts.
std::vector<Image<std::uint8_t>> set_labels(std::span<const std::string> texts, int size_px);

/// Lines of text, set one below the other and each in the middle: 0 is bare, 255 is covered.
struct Lettering {
  Image<std::uint8_t> cover;
  int lines = 0;
};

/// Sets a text in lines that are at most `width_px` wide, broken between words where they are longer; a single word
/// that is longer is set smaller. `size_px` is the height from one line to the next, without the space between them.
/// Letters stand one behind the other, from left to right, as the font's table of pairs spaces them: scripts whose
/// letters join or change places are not set right. Throws as font_for.
Lettering set_text(std::string_view text, int size_px, int width_px);

/// The words of a text on lines none of which `fits` refuses; a word alone is always taken. Line breaks are kept, other
/// control characters are spaces.
template <class Fits>
std::vector<std::string> broken_lines(std::string_view text, Fits fits) {
  std::vector<std::string> lines(1);
  std::string word;
  const auto put_word = [&] {
    if (word.empty()) return;
    std::string longer = lines.back().empty() ? word : lines.back() + ' ' + word;
    if (lines.back().empty() || fits(longer))
      lines.back() = std::move(longer);
    else
      lines.push_back(word);
    word.clear();
  };
  for (const char letter : text) {
    if (static_cast<unsigned char>(letter) > ' ' && letter != 0x7f) {
      word += letter;
      continue;
    }
    put_word();
    if (letter == '\n') lines.emplace_back();
  }
  put_word();
  return lines;
}

/// Draws a covering colour over a picture, with the cover's upper left corner at (left, top); what lies outside the
/// picture is left out.
void lay_cover(ImageView<const std::uint8_t> cover, int left, int top, Rgb8 colour, ImageView<Rgb8> picture);

}  // namespace wheatstone
