#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/module.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/image.h"
#include "wheatstone/pictures/bilevel_tiff_internal.h"
#include "wheatstone/pictures/colour_profile_internal.h"
#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/open_picture.h"
#include "wheatstone/pictures/picture_module_internal.h"
#include "wheatstone/pictures/png_reader_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_picture(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), what));
}

// OpenImageIO also opens films, medical scans and text: named, so that only pictures come in.
bool is_picture_format(std::string_view name) {
  constexpr std::string_view formats[] = {"png", "jpeg", "tiff", "bmp", "pnm",      "webp",  "openexr", "heif",
                                          "raw", "gif",  "psd",  "sgi", "jpeg2000", "targa", "hdr"};
  return std::find(std::begin(formats), std::end(formats), name) != std::end(formats);
}

void check_size(const fs::path& path, const StoredPicture& picture) {
  const auto [width, height] = std::pair(picture.width, picture.height);
  if (width <= 0 || height <= 0 || picture.channels <= 0 || picture.depth > 1)
    refuse_picture(path, fmt::format("{}x{} pixels, expected a two-dimensional picture", width, height));
  const auto pixel_bytes = static_cast<std::uint64_t>(picture.channels * picture.kind.bits / 8);
  const std::uint64_t bytes = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
                              std::max<std::uint64_t>(sizeof(Rgb8), pixel_bytes);
  if (bytes > most_picture_bytes)
    refuse_picture(path, fmt::format("{}x{} pixels, expected at most 2 GiB", width, height));
}

/// A BMP is at best run-length encoded: two bytes stand for up to 255 pixels. Its decoder believes any header.
void check_bmp_length(const fs::path& path, const PictureReader& reader) {
  if (reader.format() != "bmp") return;
  const auto [width, height] = std::pair(reader.picture().width, reader.picture().height);
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (!error && pixels / 128 > bytes)
    refuse_picture(path,
                   fmt::format("damaged or truncated picture: its header says {}x{} pixels, but the file has {} bytes",
                               width, height, bytes));
}

// We composite over white ourselves, in sRGB, as viewers do.
constexpr StoredAlpha kept_alpha = StoredAlpha::kept_apart;

void take(const fs::path& path, OpenedPicture opened, OpenPicture& open) {
  if (!opened.reader) refuse_damaged(path, std::move(opened.complaint));
  open.reader = std::move(opened.reader);
}

void check_opened(const fs::path& path, OpenPicture& open) {
  if (!open.reader || !is_picture_format(open.reader->format()))
    refuse_picture(path, "not a picture, or a damaged one; expected PNG, JPEG, TIFF, WebP, HEIC, EXR, PPM or BMP");
  const StoredPicture& picture = open.reader->picture();
  check_size(path, picture);
  check_bmp_length(path, *open.reader);
  if (!open.colour_profile.empty()) return;
  if (const auto* const profile = picture.find<std::vector<std::uint8_t>>("ICCProfile"))
    open.colour_profile.assign(profile->begin(), profile->end());
}

/// A file that its decoder reads itself; it may believe a damaged header.
std::unique_ptr<PictureReader> opened_file(const fs::path& path) {
  try {
    return open_picture_file(path, kept_alpha).reader;
  } catch (const std::bad_alloc&) {
    // Where there is not even what every picture takes, the header is not at fault.
    require_address_space(picture_module_bytes);
    refuse_damaged(path, "its header asks for more memory than there is");
  } catch (const std::length_error&) {
    refuse_damaged(path, "its header asks for more memory than can be");
  }
}

}  // namespace

void refuse_damaged(const fs::path& path, std::string reason) {
  while (!reason.empty() && (reason.back() == '\n' || reason.back() == '.')) reason.pop_back();
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  refuse_picture(path, reason.empty() ? "damaged or truncated picture" : "damaged or truncated picture: " + reason);
}

std::string read_picture_bytes(const fs::path& path) {
  check_plain_file(path, "a picture", Pipes::accepted);
  return read_whole_file(path, most_picture_bytes);
}

OpenPicture open_picture(const fs::path& path) {
  OpenPicture open;
  open.bytes = read_picture_bytes(path);
  if (!jpeg_is_whole(open.bytes)) refuse_damaged(path, "it ends too early");
  open.colour_profile = embedded_profile(open.bytes);
  if (is_png(open.bytes)) {
    std::optional<std::string> plain = plain_png(open.bytes);
    if (!plain) refuse_damaged(path, "it ends too early, or its checksums are wrong");
    open.bytes = std::move(*plain);
    take(path, open_png_bytes(open.bytes, kept_alpha), open);
  } else if (is_jpeg(open.bytes)) {
    take(path, open_jpeg_bytes(open.bytes), open);
  } else {
    open.bytes = {};
    open.reader = opened_file(path);
  }
  check_opened(path, open);
  if (open.reader->format() == "tiff")
    if (std::unique_ptr<PictureReader> bilevel = bilevel_tiff_reader(path, open.reader->picture()))
      open.reader = std::move(bilevel);
  return open;
}

OpenPicture open_png(std::string_view bytes, std::string_view colour_profile, const fs::path& path) {
  OpenPicture open;
  open.bytes = bytes;
  open.colour_profile = colour_profile;
  take(path, open_png_bytes(open.bytes, kept_alpha), open);
  check_opened(path, open);
  return open;
}

OpenPicture open_jpeg(std::string_view bytes, const fs::path& path, int least_side) {
  if (!is_jpeg(bytes) || !jpeg_is_whole(bytes)) refuse_damaged(path, "one of its pictures is no whole JPEG");
  OpenPicture open;
  open.bytes = bytes;
  take(path, open_jpeg_bytes(open.bytes, least_side), open);
  check_opened(path, open);
  return open;
}

}  // namespace wheatstone
