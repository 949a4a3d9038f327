// Views in one picture by the graphics processor: the bytes of the processor.

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "needs_gpu.h"
#include "throws_error.h"
#include "wheatstone/display/compose.h"
#include "wheatstone/random.h"

namespace wheatstone::compose_gpu_test {

class ComposeGpu : public NeedsGpu {};

std::vector<Image<Rgb8>> noisy_views(int count, int width, int height) {
  std::vector<Image<Rgb8>> views;
  for (int v = 0; v < count; ++v) {
    views.emplace_back(width, height);
    std::uint64_t place = 0;
    for (Rgb8& pixel : views.back().pixels()) {
      const std::uint64_t hash = hash_keys({static_cast<std::uint64_t>(v), place++});
      pixel = {static_cast<std::uint8_t>(hash), static_cast<std::uint8_t>(hash >> 8),
               static_cast<std::uint8_t>(hash >> 16)};
    }
  }
  return views;
}

void expect_equal(const std::vector<Image<Rgb8>>& views, const DisplayComposition& composition) {
  const Image<Rgb8> expected = compose(views, composition);
  ASSERT_TRUE(composes_on_gpu(composition));
  EXPECT_EQ(compose(views, composition, Device::graphics), expected);
}

TEST_F(ComposeGpu, PutsTheSameBytesUnderLenses) {
  LenticularScreen screen{.width = 101, .height = 67, .pitch = 18.3, .slope = -5.2, .center = 0.37};
  expect_equal(noisy_views(9, 101, 67), screen);
  expect_equal(noisy_views(45, 13, 11), screen);
  screen.flip = screen.blue_first = screen.first_from_left = true;
  expect_equal(noisy_views(5, 130, 90), screen);
}

TEST_F(ComposeGpu, PutsTheSameBytesUnderTheLensesOfWideScreens) {
  LenticularScreen screen = lenticular_screen_of(find_display("philips-36"));
  screen.height = 5;
  expect_equal(noisy_views(36, 64, 36), screen);
  screen.width = 7680;
  expect_equal(noisy_views(36, 64, 36), screen);
}

TEST_F(ComposeGpu, MakesTheSameQuilt) { expect_equal(noisy_views(6, 17, 13), QuiltLayout{3, 2}); }

TEST_F(ComposeGpu, MixesTheSameBytesForEveryKindOfGlasses) {
  for (const AnaglyphKind& kind : anaglyph_kinds()) {
    SCOPED_TRACE(kind.name);
    expect_equal(noisy_views(2, 251, 203), kind);
  }
}

TEST_F(ComposeGpu, WeavesTheSameBytes) {
  int woven = 0;
  for (const LayoutTraits& of : stereo_layouts()) {
    if (!composes_on_gpu(of.layout)) continue;
    SCOPED_TRACE(of.name);
    expect_equal(noisy_views(2, 31, 23), of.layout);
    ++woven;
  }
  EXPECT_EQ(woven, 6);
}

TEST_F(ComposeGpu, LeavesSqueezedEyesToTheProcessor) {
  const std::vector<Image<Rgb8>> views = noisy_views(2, 32, 24);
  EXPECT_EQ(compose(views, StereoLayout::left_right_half, Device::graphics),
            compose(views, StereoLayout::left_right_half));
}

TEST_F(ComposeGpu, RefusesWhatDoesNotFit) {
  expect_error(ErrorKind::wrong_usage, "3x2 holds 6 views, but there are 5", [] {
    compose(noisy_views(5, 8, 8), QuiltLayout{3, 2}, Device::graphics);
  });
  expect_error(ErrorKind::wrong_usage, "3 views, expected those of two eyes",
               [] { compose(noisy_views(3, 8, 8), anaglyph_kinds().front(), Device::graphics); });
  expect_error(ErrorKind::wrong_usage, "no room for a picture of 32000x32000 pixels; --device cpu", [] {
    compose(noisy_views(2, 8, 8), LenticularScreen{.width = 32000, .height = 32000}, Device::graphics);
  });
}

}  // namespace wheatstone::compose_gpu_test
