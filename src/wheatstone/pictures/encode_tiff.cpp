#include <fmt/format.h>
#include <tiffio.h>

#include <tiffio.hxx>

#include <cstdint>
#include <cstring>
#include <memory>
#include <sstream>
#include <vector>

#include "wheatstone/pictures/encoders_internal.h"

namespace wheatstone {
namespace {

void put_notes(TIFF* tiff, const StoredPicture& picture) {
  const auto put_text = [&](std::uint32_t tag, std::string_view name) {
    if (const auto* text = picture.find<std::string>(name)) TIFFSetField(tiff, tag, text->c_str());
  };
  put_text(TIFFTAG_IMAGEDESCRIPTION, "ImageDescription");
  put_text(TIFFTAG_DATETIME, "DateTime");
  if (const auto* profile = picture.find<std::vector<std::uint8_t>>("ICCProfile"))
    TIFFSetField(tiff, TIFFTAG_ICCPROFILE, static_cast<std::uint32_t>(profile->size()), profile->data());
  const float pixels_an_inch = picture.value_of("XResolution", 0.f);
  if (pixels_an_inch <= 0) return;
  TIFFSetField(tiff, TIFFTAG_XRESOLUTION, pixels_an_inch);
  TIFFSetField(tiff, TIFFTAG_YRESOLUTION, pixels_an_inch);
  TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
}

bool put_rows(TIFF* tiff, const PixelRows& rows) {
  // The predictor changes rows in their place.
  std::string row(static_cast<std::size_t>(TIFFScanlineSize(tiff)), '\0');
  for (int y = 0; y < rows.rows; ++y) {
    std::memcpy(row.data(), static_cast<const char*>(rows.first) + y * rows.row_bytes, row.size());
    if (TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(y)) < 0) return false;
  }
  return true;
}

}  // namespace

EncodedPicture encode_tiff(const StoredPicture& picture, const PixelRows& rows) {
  constexpr int strip_rows = 32;
  std::ostringstream file;
  const std::unique_ptr<TIFF, decltype(&TIFFClose)> tiff(TIFFStreamOpen("picture", &file), TIFFClose);
  if (!tiff) return {{}, "libtiff does not begin a file"};
  TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, picture.width);
  TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, picture.height);
  TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, picture.channels);
  TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, rows.kind.bits);
  TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, picture.channels == 1 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff.get(), TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff.get(), TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
  TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, strip_rows);
  put_notes(tiff.get(), picture);
  if (!put_rows(tiff.get(), rows) || TIFFFlush(tiff.get()) == 0)
    return {{}, fmt::format("libtiff does not write {}x{} pixels", picture.width, picture.height)};
  return {std::move(file).str(), {}};
}

}  // namespace wheatstone
