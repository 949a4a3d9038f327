#include "wheatstone/pictures/picture_notes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "wheatstone/files/deflate.h"
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
  if (!notes.colour_profile.empty()) {
    using namespace std::string_literals;
    const std::span<const std::uint8_t> profile(reinterpret_cast<const std::uint8_t*>(notes.colour_profile.data()),
                                                notes.colour_profile.size());
    append_png_chunk("iCCP", "ICC profile\0\0"s + zlib_stream(profile), chunks);
  }
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

/// ICC.1, annex B.4: in parts that are numbered from 1.
std::string jpeg_profile(std::string_view profile) {
  constexpr std::size_t part_bytes = 65519, most_parts = 255;
  const std::size_t parts = (profile.size() + part_bytes - 1) / part_bytes;
  std::string segments;
  if (parts > most_parts) return segments;
  for (std::size_t i = 0; i < parts; ++i)
    segments +=
        jpeg_segment(0xE2, std::string("ICC_PROFILE\0", 12) + static_cast<char>(i + 1) + static_cast<char>(parts) +
                               std::string(profile.substr(i * part_bytes, part_bytes)));
  return segments;
}

/// JFIF's own segment comes first and says the density; EXIF's follows it, and the colour profile.
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
  const bool has_exif = !notes.exif.empty() && exif.size() + notes.exif.size() <= most_bytes;
  jpeg.insert(has_jfif ? start + jfif_bytes : start,
              (has_exif ? jpeg_segment(0xE1, std::string(exif) + notes.exif) : std::string()) +
                  jpeg_profile(notes.colour_profile));
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
