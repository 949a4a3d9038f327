// Painted films whose frames a graphics processor draws.

#include <gtest/gtest.h>

#include <array>

#include "needs_gpu.h"
#include "psnr.h"
#include "scenes/moving_picture.h"
#include "throws_error.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::film_device_test {

class FilmOnGpu : public NeedsGpu {};

StereoPair eyes_of_frame(int frame) {
  SyntheticFilmOptions options;
  options.still.width = 96;
  options.still.height = 64;
  options.still.samples_a_side = 1;
  options.frames = 12;
  return make_synthetic_film_frame(options, frame).pictures;
}

/// A film painted twice, by either device.
void expect_alike(RotoscopeOptions options) {
  RotoscopeState by_gpu, by_processor;
  for (int i = 0; i < 2; ++i) {
    options.device = Device::graphics;
    const FramePictures found = rotoscope_frame(eyes_of_frame(i), options, by_gpu).pictures;
    options.device = Device::processor;
    const FramePictures expected = rotoscope_frame(eyes_of_frame(i), options, by_processor).pictures;
    ASSERT_EQ(found.index(), expected.index());
    if (const auto* const eyes = std::get_if<StereoPair>(&expected)) {
      EXPECT_GT(psnr_db(std::get<StereoPair>(found).left, eyes->left), 45) << "frame " << i;
      EXPECT_GT(psnr_db(std::get<StereoPair>(found).right, eyes->right), 45) << "frame " << i;
    } else {
      EXPECT_GT(psnr_db(std::get<Image<Rgb8>>(found), std::get<Image<Rgb8>>(expected)), 45) << "frame " << i;
    }
  }
}

TEST_F(FilmOnGpu, HasTheFramesOfTheProcessor) {
  RotoscopeOptions options;
  expect_alike(options);
  options.style.texture = true;
  options.depth_budget = 0.02f;
  expect_alike(options);
}

TEST_F(FilmOnGpu, HasTheFramesOfTheProcessorForADisplay) {
  RotoscopeOptions options;
  options.display = FilmDisplay{
      .views = {.views = 6, .width = 60, .height = 60, .span = 3}, .quilt = QuiltLayout{3, 2}, .screen = {}};
  expect_alike(options);
  options.display->quilt.reset();
  options.display->screen = LenticularScreen{.width = 60, .height = 60, .pitch = 30, .slope = -5};
  expect_alike(options);
}

/// A film of one eye, painted into "o.mp4".
RotoscopedFilm paint_film(const TemporaryFolder& folder, const RotoscopeFilmOptions& options, const char* name,
                          const Progress& progress = {}) {
  StereoFilmReader source = open_stereo_film(folder / "a.mp4", StereoLayout::mono);
  return rotoscope_film(source, folder / name, options, progress);
}

TEST_F(FilmOnGpu, GoesOnWithTheSameBytesOnTheSameDeviceOnly) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 5, {.preset = "ultrafast"});
  RotoscopeFilmOptions options;
  options.frames.device = Device::graphics;
  options.frames_between_checkpoints = 2;
  paint_film(folder, options, "whole.mp4");
  const Progress stop = [](std::string_view step, double) {
    if (step.starts_with("painting frame 3")) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "the first 2 frames are kept",
               [&] { paint_film(folder, options, "o.mp4", stop); });
  options.resume = true;
  for (const Device other : {Device::processor, Device::automatic}) {
    RotoscopeFilmOptions by_other = options;
    by_other.frames.device = other;
    expect_error(ErrorKind::wrong_usage, "with other options", [&] { paint_film(folder, by_other, "o.mp4"); });
  }
  EXPECT_EQ(paint_film(folder, options, "o.mp4").resumed_frames, 2);
  EXPECT_TRUE(bytes_of(folder / "o.mp4") == bytes_of(folder / "whole.mp4"));
}

}  // namespace wheatstone::film_device_test
