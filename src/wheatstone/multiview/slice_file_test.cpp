#include "wheatstone/multiview/slice_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <random>
#include <string_view>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/disparity_file.h"

namespace wheatstone::slice_file_test {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Slices of light that half floats hold exactly, beyond the view's sides and within.
SliceStack some_slices(int count = 5) {
  SliceStack stack{.width = 40, .height = 30, .span = 1.5f, .tone = {.exposure = 0.25f}, .viewing = {}, .slices = {}};
  stack.viewing = {.eye_separation_mm = 60, .viewing_distance_mm = 800, .screen_width_mm = 500, .width_px = 40};
  for (int i = 0; i < count; ++i) {
    Slice slice{.parallax_px = -3.5f + static_cast<float>(i), .left = -4 + i, .top = i, .pixels = {}};
    slice.pixels = Image<LinearRgba>(20 + i, 10, {0.5f, 0.25f, static_cast<float>(i), 0});
    slice.pixels(i, 3) = {1000, 0, 0, 0.5f};
    stack.slices.push_back(slice);
  }
  return stack;
}

std::string bytes_of(const TemporaryFolder& folder, const SliceStack& stack) {
  write_slices(folder / "whole.exr", stack);
  return read_whole_file(folder / "whole.exr", 1 << 20);
}

void expect_refused(const TemporaryFolder& folder, std::string_view bytes, const std::string& part) {
  write_whole_file(folder / "bad.exr", bytes);
  expect_error(ErrorKind::bad_input, part, [&] { read_slices(folder / "bad.exr"); });
  expect_error(ErrorKind::bad_input, "bad.exr: ", [&] { read_slices(folder / "bad.exr"); });
}

/// Overwrites numbers of the first attribute of this name and type.
template <class Number>
std::string with_attribute(std::string bytes, const std::string& name, const std::string& type,
                           const std::vector<Number>& numbers) {
  const std::string head = name + '\0' + type + '\0';
  const std::size_t at = bytes.find(head);
  EXPECT_NE(at, std::string::npos) << name;
  std::memcpy(bytes.data() + at + head.size() + 4, numbers.data(), numbers.size() * sizeof(Number));
  return bytes;
}

TEST(SliceFile, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const SliceStack stack = some_slices();
  write_slices(folder / "stack.exr", stack);
  const SliceStack again = read_slices(folder / "stack.exr");
  EXPECT_EQ(again.width, 40);
  EXPECT_EQ(again.height, 30);
  EXPECT_EQ(again.span, 1.5f);
  EXPECT_EQ(again.tone.exposure, 0.25f);
  EXPECT_EQ(again.viewing.eye_separation_mm, 60);
  EXPECT_EQ(again.viewing.viewing_distance_mm, 800);
  EXPECT_EQ(again.viewing.screen_width_mm, 500);
  EXPECT_EQ(again.viewing.width_px, 40);
  ASSERT_EQ(again.slices.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(again.slices[i].parallax_px, stack.slices[i].parallax_px);
    EXPECT_EQ(again.slices[i].left, stack.slices[i].left);
    EXPECT_EQ(again.slices[i].top, stack.slices[i].top);
    EXPECT_EQ(again.slices[i].pixels, stack.slices[i].pixels);
  }
}

TEST(SliceFile, IsAnOrdinaryOpenExrToOthers) {
  const TemporaryFolder folder;
  const SliceStack stack = some_slices();
  write_slices(folder / "stack.exr", stack);
  const auto input = OIIO::ImageInput::open((folder / "stack.exr").string());
  ASSERT_TRUE(input);
  for (int part = 0; part < 5; ++part) {
    ASSERT_TRUE(input->seek_subimage(part, 0));
    const OIIO::ImageSpec& spec = input->spec();
    EXPECT_EQ(spec.get_string_attribute("oiio:subimagename"), "slice_00" + std::to_string(part));
    EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
    EXPECT_EQ(spec.format, OIIO::TypeDesc::HALF);
    EXPECT_EQ(spec.full_width, 40);
    EXPECT_EQ(spec.full_height, 30);
    EXPECT_EQ(spec.x, stack.slices[part].left);
    EXPECT_EQ(spec.width, stack.slices[part].pixels.width());
  }
  EXPECT_FALSE(input->seek_subimage(5, 0));
}

TEST(SliceFile, LimitsLightToWhatAHalfFloatHolds) {
  const TemporaryFolder folder;
  SliceStack stack = some_slices();
  stack.slices[0].pixels(0, 0) = {1e9f, infinity, 0, 0};
  write_slices(folder / "stack.exr", stack);
  EXPECT_EQ(read_slices(folder / "stack.exr").slices[0].pixels(0, 0), (LinearRgba{65504, 65504, 0, 0}));
}

TEST(SliceFile, TakesNegativeLightAsNone) {
  const TemporaryFolder folder;
  SliceStack stack = some_slices();
  stack.slices[0].pixels(0, 0) = {-1, -infinity, 2, 3};
  write_slices(folder / "stack.exr", stack);
  EXPECT_EQ(read_slices(folder / "stack.exr").slices[0].pixels(0, 0), (LinearRgba{0, 0, 2, 1}));
}

TEST(SliceFile, AnEmptySceneIsWritten) {
  const TemporaryFolder folder;
  write_slices(folder / "stack.exr", {.width = 8, .height = 4});
  const SliceStack again = read_slices(folder / "stack.exr");
  EXPECT_EQ(again.width, 8);
  EXPECT_TRUE(again.slices.empty());
}

TEST(SliceFile, SlicesComeNearestFirst) {
  const TemporaryFolder folder;
  SliceStack stack = some_slices();
  std::ranges::reverse(stack.slices);
  write_slices(folder / "stack.exr", stack);
  const SliceStack again = read_slices(folder / "stack.exr");
  ASSERT_EQ(again.slices.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(again.slices[i].parallax_px, stack.slices[4 - i].parallax_px);
    EXPECT_EQ(again.slices[i].pixels, stack.slices[4 - i].pixels);
  }
}

TEST(SliceFile, AnotherPictureIsRefused) {
  const TemporaryFolder folder;
  write_disparity(folder / "plain.exr", Image<float>(8, 8, 1.f));
  expect_error(ErrorKind::bad_input, "plain.exr: is an OpenEXR picture without Wheatstone's slices",
               [&] { read_slices(folder / "plain.exr"); });
  expect_refused(folder, "", "is empty, expected slices");
  expect_refused(folder, "\x89PNG\r\n\x1a\n and so on", "is no OpenEXR file");
  expect_error(ErrorKind::bad_input, "is a folder", [&] { read_slices(folder / "."); });
  expect_error(ErrorKind::bad_input, "missing.exr: no such file", [&] { read_slices(folder / "missing.exr"); });
}

TEST(SliceFile, NumbersThatAreNoneAreRefused) {
  const TemporaryFolder folder;
  const std::string whole = bytes_of(folder, some_slices());
  const auto refused = [&](const std::string& name, float number, const std::string& part) {
    expect_refused(folder, with_attribute<float>(whole, "wheatstone:" + name, "float", {number}), part);
  };
  for (const float number : {nan, infinity, -1.f}) {
    refused("span", number, "wheatstone:span is ");
    refused("exposure", number, "wheatstone:exposure is ");
    refused("screen_width_mm", number, "wheatstone:screen_width_mm is ");
  }
  refused("exposure", 0, "wheatstone:exposure is 0");
  refused("parallax_px", nan, "wheatstone:parallax_px is nan");
  refused("parallax_px", 1e6f, "wheatstone:parallax_px is 1000000, expected -160 to 160");
  expect_refused(folder, with_attribute<std::int32_t>(whole, "wheatstone:version", "int", {2}),
                 "of version 2, expected 1");
  expect_refused(folder, with_attribute<std::int32_t>(whole, "wheatstone:slices", "int", {6}),
                 "it has 5 parts, but wheatstone:slices is 6");
}

TEST(SliceFile, SizesThatCannotBeAreRefusedBeforeMemoryIsTaken) {
  const TemporaryFolder folder;
  const std::string whole = bytes_of(folder, some_slices(1));
  const auto refused = [&](const std::string& window, const std::vector<std::int32_t>& corners,
                           const std::string& part) {
    expect_refused(folder, with_attribute(whole, window, "box2i", corners), part);
  };
  refused("dataWindow", {0, 0, 1 << 21, 9}, "a slice of 2097153x10 pixels");
  refused("dataWindow", {0, 0, 999'999, 9}, "its slices have 10000000 pixels");
  refused("displayWindow", {0, 0, 99'999, 9}, "views of 100000x10 pixels");
}

TEST(SliceFile, OtherChannelsAreRefused) {
  const TemporaryFolder folder;
  std::string bytes = bytes_of(folder, some_slices(1));
  // Channels stand in the order of their names: A, B, G, R.
  const std::string head = std::string("channels") + '\0' + "chlist" + '\0';
  const std::size_t at = bytes.find(head);
  ASSERT_NE(at, std::string::npos);
  bytes[at + head.size() + 4 + 3 * 18] = 'Z';
  expect_refused(folder, bytes, "a slice has channels other than R, G, B and A");
}

void expect_cut_refused(std::size_t step) {
  const TemporaryFolder folder;
  SliceStack stack = some_slices(2);
  for (Slice& slice : stack.slices) slice.pixels = Image<LinearRgba>(3, 2, {1, 2, 3, 0});
  const std::string whole = bytes_of(folder, stack);
  for (std::size_t length = 0; length < whole.size(); length += step)
    expect_refused(folder, std::string_view(whole).substr(0, length), "bad.exr: ");
}

TEST(SliceFile, CutShortAnywhereIsRefused) { expect_cut_refused(5); }
TEST(SliceFileLong, CutShortAtAnyByteIsRefused) { expect_cut_refused(1); }

TEST(SliceFile, DamageIsRefusedOrHarmless) {
  const TemporaryFolder folder;
  const std::string whole = bytes_of(folder, some_slices());
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 150; ++i) {
    std::string bytes = whole;
    bytes[random() % bytes.size()] = static_cast<char>(random());
    write_whole_file(folder / "damaged.exr", bytes);
    try {
      const SliceStack stack = read_slices(folder / "damaged.exr");
      EXPECT_EQ(stack.slices.size(), 5u) << "a slice is lost";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
      ++refused;
    }
  }
  EXPECT_GT(refused, 30);
}

TEST(SliceFile, WhatCannotBeWrittenLeavesNothing) {
  const TemporaryFolder folder;
  expect_error(ErrorKind::cannot_read_write, "cannot write", [&] { write_slices("/dev/null/a.exr", some_slices()); });
}

TEST(SliceFile, AFullDiskIsNoticedAtAnyByte) {
  const TemporaryFolder folder;
  const std::size_t length = bytes_of(folder, some_slices()).size();
  // A limit on the size of files stands in for the end of the disk.
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  const auto usual_action = std::signal(SIGXFSZ, SIG_IGN);
  for (std::size_t most = 0; most < length; most += 37) {
    const rlimit tight{.rlim_cur = most, .rlim_max = usual.rlim_max};
    setrlimit(RLIMIT_FSIZE, &tight);
    expect_error(ErrorKind::cannot_read_write,
                 "stack.exr: cannot write: ", [&] { write_slices(folder / "stack.exr", some_slices()); });
  }
  setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, usual_action);
  std::filesystem::remove(folder / "whole.exr");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "."));
  write_slices(folder / "stack.exr", some_slices());
  EXPECT_EQ(std::filesystem::file_size(folder / "stack.exr"), length);
}

#ifndef NDEBUG
TEST(SliceFileDeathTest, LightThatIsNoNumberIsABrokenPromise) {
  const TemporaryFolder folder;
  SliceStack stack = some_slices();
  stack.slices[0].pixels(0, 0).g = nan;
  EXPECT_DEATH(write_slices(folder / "stack.exr", stack), "isnan");
}
#endif

// The sanitizers need more addresses than the limit leaves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(SliceFile, LackOfMemoryIsNoFaultOfTheFile) {
  const TemporaryFolder folder;
  SliceStack stack = some_slices(1);
  stack.slices.front().pixels = Image<LinearRgba>(4000, 1000, {1, 1, 1, 1});
  write_slices(folder / "wide.exr", stack);
  EXPECT_EQ(read_slices(folder / "wide.exr").slices.size(), 1u);
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  // Less than the 64 MB of the slice.
  const rlimit little{pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + (std::size_t{1} << 25),
                      before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &little), 0);
  EXPECT_THROW(read_slices(folder / "wide.exr"), std::bad_alloc);
  EXPECT_THROW(write_slices(folder / "again.exr", stack), std::bad_alloc);
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "again.exr"));
}
#endif

}  // namespace wheatstone::slice_file_test
