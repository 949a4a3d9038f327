#include "wheatstone/pictures/picture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/module.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/encoders_internal.h"
#include "wheatstone/pictures/exr_header_internal.h"
#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/picture_module_internal.h"

namespace wheatstone {
namespace {

const PictureModule& module() {
  static const PictureModule* const loaded = reinterpret_cast<GivePictureModule*>(
      function_of_module(picture_module_name, give_picture_module_name, picture_module_bytes))();
  return *loaded;
}

std::unique_ptr<PictureWriter> writer_of(const std::string& ending, const std::filesystem::path& path,
                                         std::vector<unsigned char>* bytes) {
  std::unique_ptr<PictureWriter> writer = module().writer(ending, path, bytes);
  if (!writer)
    throw Error(ErrorKind::cannot_read_write, fmt::format("the installed OpenImageIO cannot write {} files", ending));
  return writer;
}

[[noreturn]] void fail_to_encode(const std::filesystem::path& path, std::string reason) {
  std::ranges::replace(reason, '\n', ' ');
  throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot write the picture: {}", path.string(), reason));
}

std::string whole(const std::filesystem::path& path, EncodedPicture picture) {
  if (!picture.complaint.empty()) fail_to_encode(path, std::move(picture.complaint));
  return std::move(picture.bytes);
}

template <class Pixel>
PixelRows all_rows(ImageView<const Pixel> image, NumberKind kind) {
  return {image.data(), kind, 0, image.height(), image.stride() * static_cast<std::ptrdiff_t>(sizeof(Pixel))};
}

}  // namespace

void StoredPicture::put(const std::string& name, PictureAttribute attribute) {
  attributes.insert_or_assign(name, std::move(attribute));
}

OpenedPicture open_picture_file(const std::filesystem::path& path, StoredAlpha alpha) {
  check_plain_file(path, "a picture");
  std::ifstream file(path, std::ios::binary);
  if (std::string complaint = exr_header_complaint(file); !complaint.empty()) return {nullptr, std::move(complaint)};
  return module().open_file(path, alpha);
}

std::unique_ptr<PictureWriter> picture_writer(const std::string& ending, const std::filesystem::path& path) {
  return writer_of(ending, path, nullptr);
}

std::unique_ptr<PictureWriter> picture_writer(const std::string& ending, std::vector<unsigned char>& bytes) {
  return writer_of(ending, {}, &bytes);
}

std::string encode_picture(const std::filesystem::path& path, const StoredPicture& picture, const PixelRows& rows) {
  if (picture.width < 1 || picture.height < 1) fail_to_encode(path, "it has no pixels");
  const std::string ending = ending_of(path);
  if (ending == ".png") return encode_png(picture, rows);
  if (ending == ".jpg" || ending == ".jpeg") {
    constexpr int usual_quality = 95;
    return whole(path, encode_jpeg(picture, rows, picture.value_of("jpeg:quality", usual_quality)));
  }
  if (!rows.kind.is_float && is_tiff_name(path)) return whole(path, encode_tiff(picture, rows));
  if (rows.kind == bytes_kind && picture.channels == 3 && ending == ".webp")
    return whole(path, encode_webp(picture, rows));
  std::vector<unsigned char> bytes;
  const std::unique_ptr<PictureWriter> writer = picture_writer(ending, bytes);
  if (!writer->begin({&picture, 1}) || !writer->write(rows) || !writer->end())
    fail_to_encode(path, writer->complaint());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

PixelRows rows_of(ImageView<const Rgb8> image) { return all_rows(image, bytes_kind); }
PixelRows rows_of(ImageView<const Rgb16> image) { return all_rows(image, words_kind); }
PixelRows rows_of(ImageView<const std::uint8_t> image) { return all_rows(image, bytes_kind); }
PixelRows rows_of(ImageView<const float> image) { return all_rows(image, floats_kind); }

std::string ending_of(const std::filesystem::path& path) { return lower_case(path.extension().string()); }

bool is_tiff_name(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".tif" || ending == ".tiff";
}

}  // namespace wheatstone
