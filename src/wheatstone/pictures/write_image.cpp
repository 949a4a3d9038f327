#include "wheatstone/pictures/write_image.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

const std::string colour_space = "oiio:ColorSpace";

StoredPicture described(int width, int height, int channels) {
  StoredPicture picture{width, height, channels};
  picture.put(colour_space, "sRGB");
  return picture;
}

/// The notes that a TIFF takes.
void put_tiff_notes(StoredPicture& picture, const PictureNotes& notes) {
  if (!notes.title.empty()) picture.put("ImageDescription", notes.title);
  if (!notes.taken.empty()) picture.put("DateTime", notes.taken);
  if (notes.pixels_an_inch > 0) picture.put("XResolution", static_cast<float>(notes.pixels_an_inch));
  const std::string& profile = notes.colour_profile;
  if (!profile.empty()) picture.put("ICCProfile", std::vector<std::uint8_t>(profile.begin(), profile.end()));
}

template <class Pixel>
void write_encoded(const fs::path& path, ImageView<const Pixel> image, const PictureNotes& notes) {
  if (!is_picture_name(path))
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: unknown picture format, expected a name that ends in {}",
                                                    path.string(), fmt::join(picture_endings(), ", ")));
  const PixelRows rows = rows_of(image);
  StoredPicture picture =
      described(image.width(), image.height(), static_cast<int>(8 * sizeof(Pixel)) / rows.kind.bits);
  picture.kind = rows.kind;
  if (!notes.colour_profile.empty()) picture.attributes.erase(colour_space);
  if (is_tiff_name(path)) put_tiff_notes(picture, notes);
  write_whole_file(path, with_notes(encode_picture(path, picture, rows), notes));
}

}  // namespace

std::span<const std::string_view> picture_endings() {
  static constexpr std::array<std::string_view, 8> endings{".png",  ".jpg",  ".jpeg", ".tif",
                                                           ".tiff", ".webp", ".ppm",  ".bmp"};
  return endings;
}

bool is_picture_name(const fs::path& path) {
  return std::ranges::find(picture_endings(), ending_of(path)) != picture_endings().end();
}

std::string encode_jpeg(ImageView<const Rgb8> image, int quality) {
  StoredPicture picture = described(image.width(), image.height(), 3);
  picture.put("jpeg:quality", std::clamp(quality, 1, 100));
  return encode_picture("picture.jpg", picture, rows_of(image));
}

std::string encode_png(ImageView<const Rgb8> image) {
  return encode_picture("picture.png", described(image.width(), image.height(), 3), rows_of(image));
}

void write_image(const fs::path& path, ImageView<const Rgb8> image, const PictureNotes& notes) {
  write_encoded(path, image, notes);
}

void write_image(const fs::path& path, ImageView<const std::uint8_t> image) { write_encoded(path, image, {}); }

void write_image(const fs::path& path, ImageView<const Rgb16> image) {
  if (!takes_sixteen_bits(path))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: expected a PNG or a TIFF, which keep 16 bits a channel", path.string()));
  write_encoded(path, image, {});
}

bool takes_profile(const fs::path& path) {
  const std::string ending = ending_of(path);
  return takes_sixteen_bits(path) || ending == ".jpg" || ending == ".jpeg";
}

bool takes_sixteen_bits(const fs::path& path) { return ending_of(path) == ".png" || is_tiff_name(path); }

}  // namespace wheatstone
