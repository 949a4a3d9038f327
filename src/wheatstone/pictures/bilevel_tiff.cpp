#include "wheatstone/pictures/bilevel_tiff_internal.h"

#include <tiffio.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/pictures/open_picture.h"

namespace wheatstone {
namespace {

class BilevelTiff : public PictureReader {
 public:
  BilevelTiff(StoredPicture picture, std::vector<std::uint8_t> levels)
      : picture_(std::move(picture)), levels_(std::move(levels)) {}

  std::string format() const override { return "tiff"; }
  const StoredPicture& picture() const override { return picture_; }
  bool go_to(int picture) override { return picture == 0; }
  bool read(std::uint8_t* to) override {
    std::ranges::copy(levels_, to);
    return true;
  }
  bool read(int first_row, int rows, int /*channels*/, float* to) override {
    const auto width = static_cast<std::size_t>(picture_.width);
    const auto from =
        std::span(levels_).subspan(width * static_cast<std::size_t>(first_row), width * static_cast<std::size_t>(rows));
    std::ranges::transform(from, to, [](std::uint8_t level) { return level == 0 ? 0.f : 1.f; });
    return true;
  }
  std::string complaint() override { return {}; }

 private:
  StoredPicture picture_;
  std::vector<std::uint8_t> levels_;
};

}  // namespace

std::unique_ptr<PictureReader> bilevel_tiff_reader(const std::filesystem::path& path, StoredPicture picture) {
  if (picture.channels != 1 || picture.kind != bytes_kind) return nullptr;
  const std::unique_ptr<TIFF, decltype(&TIFFClose)> tiff(TIFFOpen(path.c_str(), "r"), TIFFClose);
  std::uint16_t bits = 0;
  if (!tiff || TIFFGetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, &bits) != 0) return nullptr;
  // As it is stored: who reads the picture turns it.
  std::uint16_t orientation = ORIENTATION_TOPLEFT;
  TIFFGetField(tiff.get(), TIFFTAG_ORIENTATION, &orientation);
  std::vector<std::uint32_t> colours(static_cast<std::size_t>(picture.width) *
                                     static_cast<std::size_t>(picture.height));
  if (TIFFReadRGBAImageOriented(tiff.get(), static_cast<std::uint32_t>(picture.width),
                                static_cast<std::uint32_t>(picture.height), colours.data(), orientation, 1) == 0)
    refuse_damaged(path, "its pixels cannot be read");
  std::vector<std::uint8_t> levels(colours.size());
  std::ranges::transform(colours, levels.begin(),
                         [](std::uint32_t colour) { return static_cast<std::uint8_t>(TIFFGetR(colour)); });
  picture.put("oiio:BitsPerSample", 1);
  return std::make_unique<BilevelTiff>(std::move(picture), std::move(levels));
}

}  // namespace wheatstone
