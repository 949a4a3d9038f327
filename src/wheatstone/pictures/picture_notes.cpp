#include "wheatstone/pictures/picture_notes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/png_chunks.h"

namespace wheatstone {
namespace {

std::string two_bytes(std::size_t number) {
  return {static_cast<char>(number >> 8 & 0xff), static_cast<char>(number & 0xff)};
}

/// PNG 1.2, sec. 4.2: all stand between the header and the pixels; eXIf as in its extensions of 2017.
std::string png_notes(const PictureNotes& notes) {
  std::string chunks;
  if (notes.pixels_an_inch > 0) {
    constexpr double inches_a_metre = 1 / 0.0254;
    const auto a_metre = static_cast<std::size_t>(std::lround(notes.pixels_an_inch * inches_a_metre));
    std::string density;
    append_png_number(a_metre, density);
    append_png_number(a_metre, density);
    append_png_chunk("pHYs", density + '\1', chunks);
  }
  if (!notes.exif.empty()) append_png_chunk("eXIf", notes.exif, chunks);
  if (!notes.title.empty()) {
    using namespace std::string_literals;
    append_png_chunk("iTXt", "Title\0\0\0\0\0"s + notes.title, chunks);
  }
  return chunks;
}

/// JFIF's own segment comes first and says the density; EXIF's follows it.
void put_jpeg_notes(std::string& jpeg, const PictureNotes& notes) {
  constexpr std::string_view jfif("\xFF\xE0\0\x10JFIF\0", 9);
  constexpr std::size_t start = 2, unit_at = start + 11, jfif_bytes = 18;
  const bool has_jfif = std::string_view(jpeg).substr(start).starts_with(jfif);
  if (has_jfif && notes.pixels_an_inch > 0) {
    const std::string density =
        two_bytes(static_cast<std::size_t>(std::lround(std::min(notes.pixels_an_inch, 65535.))));
    jpeg.replace(unit_at, 5, '\1' + density + density);
  }
  constexpr std::string_view exif("Exif\0\0", 6);
  constexpr std::size_t most_bytes = 65533;
  if (notes.exif.empty() || exif.size() + notes.exif.size() > most_bytes) return;
  jpeg.insert(has_jfif ? start + jfif_bytes : start,
              "\xFF\xE1" + two_bytes(2 + exif.size() + notes.exif.size()) + std::string(exif) + notes.exif);
}

}  // namespace

std::string with_notes(std::string picture, const PictureNotes& notes) {
  if (is_jpeg(picture)) {
    put_jpeg_notes(picture, notes);
  } else if (picture.starts_with("\x89PNG")) {
    constexpr std::size_t header_end = png_signature_size + 12 + 13;
    picture.insert(header_end, png_notes(notes));
  }
  return picture;
}

}  // namespace wheatstone
