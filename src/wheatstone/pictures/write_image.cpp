#include "wheatstone/pictures/write_image.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

StoredPicture described(const std::string& ending, int width, int height, int channels) {
  StoredPicture picture{width, height, channels};
  picture.put("oiio:ColorSpace", "sRGB");
  if (ending == ".tif" || ending == ".tiff") {
    // Otherwise the time of writing: the same picture is to be the same bytes.
    picture.put("DateTime", "1970:01:01 00:00:00");
    // In memory the EXIF directory would be written over the picture's own (OpenImageIO 2.4.7).
    picture.put("tiff:write_exif", 0);
  }
  return picture;
}

template <class Pixel>
void write_encoded(const fs::path& path, ImageView<const Pixel> image) {
  if (!is_picture_name(path))
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: unknown picture format, expected a name that ends in {}",
                                                    path.string(), fmt::join(picture_endings(), ", ")));
  const StoredPicture picture = described(ending_of(path), image.width(), image.height(), sizeof(Pixel));
  write_whole_file(path, encode_picture(path, picture, rows_of(image)));
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
  StoredPicture picture = described(".jpg", image.width(), image.height(), 3);
  picture.put("jpeg:quality", std::clamp(quality, 1, 100));
  return encode_picture("picture.jpg", picture, rows_of(image));
}

std::string encode_png(ImageView<const Rgb8> image) {
  return encode_picture("picture.png", described(".png", image.width(), image.height(), 3), rows_of(image));
}

void write_image(const fs::path& path, ImageView<const Rgb8> image) { write_encoded(path, image); }

void write_image(const fs::path& path, ImageView<const std::uint8_t> image) { write_encoded(path, image); }

}  // namespace wheatstone
