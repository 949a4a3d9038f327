#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/image.h"
#include "wheatstone/pictures/embedded_profile_internal.h"
#include "wheatstone/pictures/jpeg_end_internal.h"
#include "wheatstone/pictures/open_picture_internal.h"
#include "wheatstone/pictures/plain_png_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), what));
}

void check_readable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) refuse(path, "no such file, expected a picture");
  if (fs::is_directory(status)) refuse(path, "is a folder, expected a picture");
  if (::access(path.c_str(), R_OK) != 0) {
    const std::string reason = std::generic_category().message(errno);
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot read: {}", path.string(), reason));
  }
  if (fs::is_regular_file(status) && fs::file_size(path, error) == 0) refuse(path, "is empty, expected a picture");
}

// OpenImageIO also opens films, medical scans and text: named, so that only pictures come in.
bool is_picture_format(std::string_view name) {
  constexpr std::string_view formats[] = {"png", "jpeg", "tiff", "bmp", "pnm",      "webp",  "openexr", "heif",
                                          "raw", "gif",  "psd",  "sgi", "jpeg2000", "targa", "hdr"};
  return std::find(std::begin(formats), std::end(formats), name) != std::end(formats);
}

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

void check_size(const fs::path& path, const OIIO::ImageSpec& spec) {
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.depth > 1) {
    refuse(path, fmt::format("{}x{} pixels, expected a two-dimensional picture", spec.width, spec.height));
  }
  const std::uint64_t bytes = static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height) *
                              std::max<std::uint64_t>(sizeof(Rgb8), static_cast<std::uint64_t>(spec.pixel_bytes()));
  if (bytes > most_picture_bytes)
    refuse(path, fmt::format("{}x{} pixels, expected at most 2 GiB", spec.width, spec.height));
}

/// A BMP is at best run-length encoded: two bytes stand for up to 255 pixels. Its decoder believes any header.
void check_bmp_length(const fs::path& path, const OIIO::ImageInput& decoder) {
  if (decoder.format_name() != std::string_view("bmp")) return;
  const auto pixels =
      static_cast<std::uint64_t>(decoder.spec().width) * static_cast<std::uint64_t>(decoder.spec().height);
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (!error && pixels / 128 > bytes)
    refuse(path, fmt::format("damaged or truncated picture: its header says {}x{} pixels, but the file has {} bytes",
                             decoder.spec().width, decoder.spec().height, bytes));
}

// We composite over white ourselves, in sRGB, as viewers do.
OIIO::ImageSpec colour_as_it_stands() {
  OIIO::ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);
  return wish;
}

void open_in_memory(const fs::path& path, const std::string& format, OpenPicture& open) {
  open.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(open.bytes.data(), open.bytes.size());
  open.decoder = OIIO::ImageInput::create(format);
  OIIO::ImageSpec found;
  if (open.decoder &&
      !(open.decoder->set_ioproxy(open.memory.get()) && open.decoder->open("", found, colour_as_it_stands()))) {
    refuse_damaged(path, open.decoder->geterror());
  }
}

void check_opened(const fs::path& path, OpenPicture& open) {
  OIIO::geterror();  // what is not asked for is printed when the program ends
  if (!open.decoder || !is_picture_format(open.decoder->format_name())) {
    refuse(path, "not a picture, or a damaged one; expected PNG, JPEG, TIFF, WebP, HEIC, EXR, PPM or BMP");
  }
  check_size(path, open.decoder->spec());
  check_bmp_length(path, *open.decoder);
  if (!open.colour_profile.empty()) return;
  const OIIO::ParamValue* profile = open.decoder->spec().find_attribute("ICCProfile");
  if (profile != nullptr) open.colour_profile.assign(static_cast<const char*>(profile->data()), profile->datasize());
}

}  // namespace

void refuse_damaged(const fs::path& path, std::string reason) {
  while (!reason.empty() && (reason.back() == '\n' || reason.back() == '.')) reason.pop_back();
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  refuse(path, reason.empty() ? "damaged or truncated picture" : "damaged or truncated picture: " + reason);
}

std::string read_picture_bytes(const fs::path& path) {
  check_readable(path);
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
    open_in_memory(path, "png", open);
  } else {
    open.bytes = {};
    const OIIO::ImageSpec wish = colour_as_it_stands();
    try {
      open.decoder = OIIO::ImageInput::open(path.string(), &wish);
    } catch (const std::bad_alloc&) {  // a decoder that believes a damaged header
      refuse_damaged(path, "its header asks for more memory than there is");
    } catch (const std::length_error&) {
      refuse_damaged(path, "its header asks for more memory than can be");
    }
  }
  check_opened(path, open);
  return open;
}

OpenPicture open_png(std::string_view bytes, std::string_view colour_profile, const fs::path& path) {
  OpenPicture open;
  open.bytes = bytes;
  open.colour_profile = colour_profile;
  open_in_memory(path, "png", open);
  check_opened(path, open);
  return open;
}

OpenPicture open_jpeg(std::string_view bytes, const fs::path& path) {
  if (!bytes.starts_with("\xFF\xD8") || !jpeg_is_whole(bytes))
    refuse_damaged(path, "one of its pictures is no whole JPEG");
  OpenPicture open;
  open.bytes = bytes;
  open_in_memory(path, "jpeg", open);
  check_opened(path, open);
  return open;
}

}  // namespace wheatstone
