#pragma once

// What cameras write into their files (EXIF), by hand.

#include <cstddef>
#include <string>
#include <vector>

namespace wheatstone {

inline std::string little(std::size_t number, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(number >> (8 * i) & 0xff);
  return text;
}

struct ExifEntry {
  int tag, type;  // 2: ASCII, 3: short, 4: long, 7: bytes
  std::string value;
};

/// A directory at this place of a TIFF, with its values behind it.
inline std::string exif_directory(std::size_t at, const std::vector<ExifEntry>& entries) {
  std::string head = little(entries.size(), 2), values;
  const std::size_t values_at = at + 2 + 12 * entries.size() + 4;
  for (const ExifEntry& entry : entries) {
    const std::size_t unit = entry.type == 3 ? 2 : entry.type == 4 ? 4 : 1;
    head += little(entry.tag, 2) + little(entry.type, 2) + little(entry.value.size() / unit, 4);
    if (entry.value.size() <= 4) {
      head += entry.value + std::string(4 - entry.value.size(), '\0');
    } else {
      head += little(values_at + values.size(), 4);
      values += entry.value + std::string(entry.value.size() % 2, '\0');
    }
  }
  return head + little(0, 4) + values;
}

/// EXIF data with a title, a time, an orientation and a place.
inline std::string exif_data(const std::string& title, const std::string& taken = "2019:07:18 14:03:22") {
  constexpr std::size_t first = 8, exif_at = 400, place_at = 600;
  std::string tiff = "II*" + std::string(1, '\0') + little(first, 4);
  tiff += exif_directory(first, {{0x10e, 2, title + '\0'},
                                 {0x10f, 2, std::string("Maker\0", 6)},
                                 {0x112, 3, little(1, 2)},
                                 {0x8769, 4, little(exif_at, 4)},
                                 {0x8825, 4, little(place_at, 4)}});
  tiff.resize(exif_at);
  tiff += exif_directory(exif_at, {{0x9003, 2, taken + '\0'}, {0x927c, 7, std::string(40, 'm')}});
  tiff.resize(place_at);
  return tiff + exif_directory(place_at, {{1, 2, std::string("N\0", 2)}, {0x1d, 2, std::string("2019:07:18\0", 11)}});
}

}  // namespace wheatstone
