#include "wheatstone/pictures/heif_pictures.h"

#include <gtest/gtest.h>
#include <libheif/heif.h>

#include <cstdlib>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone {
namespace {

/// Writes plain pictures of these colours into one HEIC file; false where no encoder is installed.
bool put_heic(const std::filesystem::path& path, const std::vector<Rgb8>& colours, int side = 64) {
  heif_context* context = heif_context_alloc();
  heif_encoder* encoder = nullptr;
  if (heif_context_get_encoder_for_format(context, heif_compression_HEVC, &encoder).code != heif_error_Ok) {
    heif_context_free(context);
    return false;
  }
  heif_encoder_set_lossy_quality(encoder, 95);
  for (const Rgb8 colour : colours) {
    heif_image* image = nullptr;
    heif_image_create(side, side, heif_colorspace_RGB, heif_chroma_interleaved_RGB, &image);
    heif_image_add_plane(image, heif_channel_interleaved, side, side, 8);
    int stride = 0;
    std::uint8_t* plane = heif_image_get_plane(image, heif_channel_interleaved, &stride);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        reinterpret_cast<Rgb8*>(plane + static_cast<std::ptrdiff_t>(y) * stride)[x] = colour;
    heif_image_handle* handle = nullptr;
    heif_context_encode_image(context, image, encoder, nullptr, &handle);
    heif_image_handle_release(handle);
    heif_image_release(image);
  }
  heif_encoder_release(encoder);
  heif_context_write_to_file(context, path.c_str());
  heif_context_free(context);
  return true;
}

TEST(HeifPictures, AreReadInTheOrderOfTheFile) {
  const TemporaryFolder folder;
  if (!put_heic(folder / "two.heic", {{200, 40, 30}, {30, 60, 210}})) GTEST_SKIP() << "no HEVC encoder";
  const auto pictures = read_heif_pictures(folder / "two.heic");
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_NEAR(pictures[0](5, 5).r, 200, 6);
  EXPECT_NEAR(pictures[1](5, 5).b, 210, 6);
  EXPECT_EQ(pictures[0].width(), 64);
}

TEST(HeifPictures, CutShortAreRefused) {
  const TemporaryFolder folder;
  if (!put_heic(folder / "a.heic", {{200, 40, 30}})) GTEST_SKIP() << "no HEVC encoder";
  const std::string bytes = bytes_of(folder / "a.heic");
  for (std::size_t length = 0; length < bytes.size(); length += 5) {
    put_bytes(folder / "a.heic", std::string_view(bytes).substr(0, length));
    expect_error(ErrorKind::bad_input, "a.heic", [&] { read_heif_pictures(folder / "a.heic"); });
  }
}

}  // namespace
}  // namespace wheatstone
