#include "wheatstone/multiview/slice_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/image/disparity_file.h"
#include "wheatstone/image/whole_file.h"

namespace wheatstone {
namespace {

SliceStack some_slices() {
  SliceStack stack{.width = 40, .height = 30, .span = 1.5f, .exposure = 0.25f, .viewing = {}, .slices = {}};
  stack.viewing.screen_width_mm = 500;
  stack.viewing.width_px = 40;
  for (int i = 0; i < 5; ++i) {
    Slice slice{.parallax_px = -3.5f + static_cast<float>(i), .left = -4 + i, .top = i, .pixels = {}};
    slice.pixels = Image<LinearRgba>(20 + i, 10, {0.5f, 0.25f, static_cast<float>(i), 0});
    stack.slices.push_back(slice);
  }
  return stack;
}

TEST(SliceFile, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const SliceStack stack = some_slices();
  write_slices(folder / "stack.exr", stack);
  const SliceStack again = read_slices(folder / "stack.exr");
  EXPECT_EQ(again.width, 40);
  EXPECT_EQ(again.height, 30);
  EXPECT_EQ(again.span, 1.5f);
  EXPECT_EQ(again.exposure, 0.25f);
  EXPECT_EQ(again.viewing.screen_width_mm, 500);
  ASSERT_EQ(again.slices.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(again.slices[i].parallax_px, stack.slices[i].parallax_px);
    EXPECT_EQ(again.slices[i].left, stack.slices[i].left);
    EXPECT_EQ(again.slices[i].top, stack.slices[i].top);
    EXPECT_EQ(again.slices[i].pixels, stack.slices[i].pixels);  // these numbers fit in half floats
  }
}

TEST(SliceFile, LimitsLightToWhatAHalfFloatHolds) {
  const TemporaryFolder folder;
  SliceStack stack = some_slices();
  stack.slices[0].pixels(0, 0).r = 1e9f;
  write_slices(folder / "stack.exr", stack);
  EXPECT_EQ(read_slices(folder / "stack.exr").slices[0].pixels(0, 0).r, 65504);
}

TEST(SliceFile, AnEmptySceneIsWritten) {
  const TemporaryFolder folder;
  write_slices(folder / "stack.exr", {.width = 8, .height = 4});
  const SliceStack again = read_slices(folder / "stack.exr");
  EXPECT_EQ(again.width, 8);
  EXPECT_TRUE(again.slices.empty());
}

TEST(SliceFile, AnotherOpenExrIsRefused) {
  const TemporaryFolder folder;
  write_disparity(folder / "plain.exr", Image<float>(8, 8, 1.f));
  expect_error(ErrorKind::bad_input, "without Wheatstone's slices", [&] { read_slices(folder / "plain.exr"); });
}

TEST(SliceFile, CutShortAnywhereIsRefused) {
  const TemporaryFolder folder;
  write_slices(folder / "stack.exr", some_slices());
  const std::string bytes = read_whole_file(folder / "stack.exr", 1 << 20);
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 40) {
    write_whole_file(folder / "cut.exr", bytes.substr(0, length));
    expect_error(ErrorKind::bad_input, "cut.exr: ", [&] { read_slices(folder / "cut.exr"); });
  }
}

TEST(SliceFile, WhatCannotBeWrittenLeavesNothing) {
  const TemporaryFolder folder;
  expect_error(ErrorKind::cannot_read_write, "nowhere",
               [&] { write_slices(folder / "nowhere" / "a.exr", some_slices()); });
  expect_error(ErrorKind::bad_input, "missing.exr", [&] { read_slices(folder / "missing.exr"); });
}

}  // namespace
}  // namespace wheatstone
