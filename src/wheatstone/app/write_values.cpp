#include "wheatstone/app/write_values.h"

#include <fitsio.h>
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/temporary_file.h"
#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {
namespace {

[[noreturn]] void refuse_to_write(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot write: {}", path.string(), why));
}

/// The axes by FITS's keywords: the camera's axis meets pixel CRPIX, whose coordinates are 0, and rows count from the
/// bottom.
struct Keywords {
  std::array<std::pair<const char*, double>, 6> numbers;
  std::array<std::pair<const char*, std::string>, 6> words;
};

Keywords keywords_of(const ValueAxes& axes, int height) {
  const double step = axes.depth / axes.camera.focal_px;
  return {{{{"CRPIX1", axes.camera.centre_x_px + 0.5},
            {"CRPIX2", static_cast<double>(height) - axes.camera.centre_y_px + 0.5},
            {"CRVAL1", 0.},
            {"CRVAL2", 0.},
            {"CDELT1", step},
            {"CDELT2", step}}},
          {{{"CTYPE1", "X"},
            {"CTYPE2", "Y"},
            {"CUNIT1", axes.length_unit},
            {"CUNIT2", axes.length_unit},
            {"BUNIT", axes.unit},
            {"BTYPE", axes.name}}}};
}

/// Rows from the bottom to the top.
std::vector<float> upwards(ImageView<const float> values) {
  std::vector<float> numbers;
  for (int y = values.height() - 1; y >= 0; --y)
    numbers.insert(numbers.end(), values.row(y).begin(), values.row(y).end());
  return numbers;
}

void write_fits(const TemporaryFile& file, ImageView<const float> values, const ValueAxes& axes) {
  int status = 0;
  fitsfile* opened = nullptr;
  std::filesystem::remove(file.path());  // the library makes its files itself
  fits_create_diskfile(&opened, file.path().c_str(), &status);
  std::array<long, 2> size{values.width(), values.height()};
  fits_create_img(opened, FLOAT_IMG, 2, size.data(), &status);
  const Keywords keywords = keywords_of(axes, values.height());
  for (const auto& [name, number] : keywords.numbers) fits_write_key_dbl(opened, name, number, 15, nullptr, &status);
  for (const auto& [name, word] : keywords.words)
    if (!word.empty()) fits_write_key_str(opened, name, word.c_str(), nullptr, &status);
  std::vector<float> numbers = upwards(values);
  fits_write_img(opened, TFLOAT, 1, static_cast<LONGLONG>(numbers.size()), numbers.data(), &status);
  int closing = 0;
  if (opened != nullptr) fits_close_file(opened, &closing);
  if (status == 0 && closing == 0) return;
  std::array<char, FLEN_STATUS> why{};
  fits_get_errstatus(status != 0 ? status : closing, why.data());
  refuse_to_write(file.name(), why.data());
}

void write_exr(const TemporaryFile& file, ImageView<const float> values, const ValueAxes& axes) {
  StoredPicture picture{values.width(), values.height(), 1};
  picture.kind = floats_kind;
  picture.channel_names = {"Y"};
  // Replaces the time of writing, so that the same numbers give the same bytes.
  picture.put("DateTime", "1970:01:01 00:00:00");
  const Keywords keywords = keywords_of(axes, values.height());
  for (const auto& [name, number] : keywords.numbers) picture.put(name, static_cast<float>(number));
  for (const auto& [name, word] : keywords.words) picture.put(name, word);
  const std::unique_ptr<PictureWriter> writer = picture_writer(".exr", file.path());
  if (!writer->begin({&picture, 1}) || !writer->write(rows_of(values)) || !writer->end())
    refuse_to_write(file.name(), writer->complaint());
}

void write_npy(const TemporaryFile& file, ImageView<const float> values) {
  static_assert(std::endian::native == std::endian::little);
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}", values.height(), values.width());
  // With what stands before it, a multiple of 64 bytes.
  header.resize((10 + header.size() + 1 + 63) / 64 * 64 - 10 - 1, ' ');
  header += '\n';
  std::ofstream stream(file.path(), std::ios::binary);
  const auto length = static_cast<std::uint16_t>(header.size());
  stream.write("\x93NUMPY\x01\x00", 8);
  stream.put(static_cast<char>(length & 255)).put(static_cast<char>(length >> 8));
  stream << header;
  for (int y = 0; y < values.height(); ++y)
    stream.write(reinterpret_cast<const char*>(values.row(y).data()),
                 static_cast<std::streamsize>(values.row(y).size_bytes()));
  stream.close();
  if (!stream) refuse_to_write(file.name(), "the disk may be full");
}

}  // namespace

void write_values(const std::filesystem::path& path, ImageView<const float> values, const ValueAxes& axes) {
  check_values_ending(path.string(), path);
  TemporaryFile file(path);
  if (path.extension() == ".fits") {
    write_fits(file, values, axes);
  } else if (path.extension() == ".exr") {
    write_exr(file, values, axes);
  } else {
    write_npy(file, values);
  }
  file.commit();
}

void check_values_ending(const std::string& option, const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending != ".fits" && ending != ".exr" && ending != ".npy")
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: is '{}', expected a name ending in .fits, .exr or .npy", option, path.string()));
}

}  // namespace wheatstone
