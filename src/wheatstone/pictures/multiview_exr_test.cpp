#include "wheatstone/pictures/multiview_exr.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "temporary_folder.h"

namespace wheatstone::multiview_exr_test {

/// The same picture in tiles, of numbers of the type given.
void put_in_tiles(const std::filesystem::path& from, const std::filesystem::path& to, OIIO::TypeDesc type) {
  const auto input = OIIO::ImageInput::open(from.string());
  ASSERT_TRUE(input);
  OIIO::ImageSpec spec = input->spec();
  std::vector<float> numbers(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  ASSERT_TRUE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, numbers.data()));
  spec.set_format(type);
  spec.tile_width = spec.tile_height = 48;
  const auto output = OIIO::ImageOutput::create(to.string());
  ASSERT_TRUE(output && output->open(to.string(), spec));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, numbers.data()) && output->close());
}

TEST(MultiviewExr, InTilesIsReadAsInRows) {
  const TemporaryFolder folder;
  std::array<Image<Rgb8>, 2> views{Image<Rgb8>(100, 150), Image<Rgb8>(100, 150)};
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 100; ++x) {
      views[0](x, y) = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), 7};
      views[1](x, y) = {static_cast<std::uint8_t>(y), 90, static_cast<std::uint8_t>(2 * x)};
    }
  write_multiview_exr(folder / "rows.exr", std::span<const Image<Rgb8>>(views));
  const auto in_rows = read_multiview_exr(folder / "rows.exr");
  ASSERT_EQ(in_rows.size(), 2u);
  EXPECT_EQ(in_rows[1], views[1]);
  for (const OIIO::TypeDesc type : {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT}) {
    put_in_tiles(folder / "rows.exr", folder / "tiles.exr", type);
    EXPECT_EQ(read_multiview_exr(folder / "tiles.exr"), in_rows) << type.c_str();
  }
}

}  // namespace wheatstone::multiview_exr_test
