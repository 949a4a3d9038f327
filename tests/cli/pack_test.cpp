// Views into the formats of displays, from the command line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/packing.h"
#include "cli/run_program.h"
#include "needs_gpu.h"
#include "psnr.h"
#include "scenes/colour_profiles.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::pack_test {

using testing::HasSubstr;

const StereoPair& still() {
  static const StereoPair pair = make_synthetic_still({.width = 240, .height = 180, .samples_a_side = 1}).pictures;
  return pair;
}

void put_still(const TemporaryFolder& folder) {
  write_image(folder / "left.png", still().left);
  write_image(folder / "right.png", still().right);
}

ProgramResult run_in(const TemporaryFolder& folder, const std::vector<std::string>& words) {
  ProgramResult result = run_program(words, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return result;
}

double psnr(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  if (!same_size(a, b)) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Rgb8 p = a.pixels()[i], q = b.pixels()[i];
    sum += std::pow(p.r - q.r, 2) + std::pow(p.g - q.g, 2) + std::pow(p.b - q.b, 2);
  }
  return 10 * std::log10(255. * 255 * 3 * static_cast<double>(a.pixels().size()) / sum);
}

TEST(PackCommand, WhatIsPackedIsReadBack) {
  const TemporaryFolder folder;
  put_still(folder);
  for (const std::string layout : {"left-right", "right-left", "top-bottom", "bottom-top"}) {
    run_in(folder, {"pack", "left.png", "right.png", "--to", layout, "-o", "both.png"});
    run_in(folder, {"pack", "both.png", "--layout", layout, "-o", layout});
    EXPECT_EQ(read_image(folder / (layout + "/view_000.png")), still().left) << layout;
    EXPECT_EQ(read_image(folder / (layout + "/view_001.png")), still().right) << layout;
  }
  run_in(folder, {"pack", "left.png", "right.png", "-o", "views.exr"});
  run_in(folder, {"pack", "views.exr", "-o", "exr"});
  EXPECT_EQ(read_image(folder / "exr/view_001.png"), still().right);
  for (const std::string name : {"both.mpo", "both.jps"}) {
    run_in(folder, {"pack", "left.png", "right.png", "-o", name});
    const ViewsFile file = read_views(folder / name);
    ASSERT_EQ(file.views.size(), 2u);
    EXPECT_GE(psnr(file.views[0], still().left), 38) << name;
    EXPECT_GE(psnr(file.views[1], still().right), 38) << name;
    EXPECT_LT(psnr(file.views[0], still().right), 30) << name;
  }
}

TEST(PackCommand, QuiltsComeApartAndAreNamedByConvention) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"pack", "left.png", "right.png", "right.png", "left.png", "--quilt", "2x2", "-o", "four"});
  const auto facts = nlohmann::json::parse(run_in(folder, {"info", "four_qs2x2a1.3333.png", "--json"}).output);
  EXPECT_EQ(facts["quilt"], "2x2");
  run_in(folder, {"pack", "four_qs2x2a1.3333.png", "-o", "views"});
  EXPECT_EQ(read_image(folder / "views/view_000.png"), still().left);
  EXPECT_EQ(read_image(folder / "views/view_002.png"), still().right);
  std::filesystem::rename(folder / "four_qs2x2a1.3333.png", folder / "four.png");
  run_in(folder, {"pack", "four.png", "--from-quilt", "2x2", "-o", "again"});
  EXPECT_EQ(read_image(folder / "again/view_002.png"), still().right);
}

TEST(PackCommand, MakesWhatScreensShow) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"pack", "left.png", "right.png", "--to", "anaglyph", "--shift", "9", "--floating-window", "4,4", "-o",
                  "anaglyph.png"});
  EXPECT_EQ(read_image(folder / "anaglyph.png").width(), 231);
  EXPECT_EQ(read_image(folder / "anaglyph.png")(1, 90).r, 0);
  expect_refused(folder,
                 {"pack", "left.png", "right.png", "--to", "anaglyph", "--floating-window", "120,120", "-o", "a.png"},
                 2, "--floating-window: is '120,120', which leaves nothing of 240 pixels");
  expect_refused(
      folder, {"pack", "left.png", "right.png", "--to", "anaglyph", "--shift", "-240", "-o", "a.png"}, 2,
      "screen disparity: is -240 px, with which the eyes' pictures share 0 of 240 px, expected a quarter at least");
  run_in(folder, {"pack", "left.png", "right.png", "--swap", "--to", "irl", "-o", "rows.png"});
  EXPECT_EQ(read_image(folder / "rows.png")(7, 0), still().right(7, 0));
  EXPECT_EQ(read_image(folder / "rows.png")(7, 1), still().left(7, 1));
  run_in(folder, {"pack", "left.png", "right.png", "--screen", "barrier-2", "-o", "screen.png"});
  run_in(folder, {"pack", "left.png", "right.png", "-o", "wiggle.gif"});
  run_in(folder, {"pack", "left.png", "right.png", "--to", "rgbd", "-o", "rgbd.png"});
  EXPECT_EQ(read_image(folder / "rgbd.png").width(), 480);
  run_in(folder, {"pack", "left.png", "right.png", "--to", "disparity", "-o", "disparity.png"});
  run_in(folder, {"pack", "left.png", "right.png", "--to", "depth", "--depth-scale", "600", "-o", "depth.exr"});
  const float disparity = read_disparity(folder / "disparity.png")(120, 90);
  EXPECT_NEAR(read_disparity(folder / "depth.exr")(120, 90), 600 / disparity, 0.01 * 600 / disparity);
}

TEST(PackCommand, PutsBordersAndCaptionsAroundTheViews) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"pack", "left.png", "right.png", "--to", "left-right", "--crop", "1:1", "--border", "10,black",
                  "--caption", "{title}, {date}", "-o", "print.png"});
  const Image<Rgb8> print = read_image(folder / "print.png");
  EXPECT_EQ(print.width(), 2 * 200);
  EXPECT_GT(print.height(), 200);
  EXPECT_EQ(print(10, 10), still().left(30, 0));
  EXPECT_EQ(print(210, 10), still().right(30, 0));
  const std::vector<std::string> pack{"pack", "left.png", "right.png", "--to", "left-right", "-o", "out.png"};
  const auto refused = [&](std::vector<std::string> more, const std::string& part) {
    more.insert(more.begin(), pack.begin(), pack.end());
    expect_refused(folder, more, 2, part);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.png"));
  };
  refused({"--crop", "300x10+0+0"}, "does not lie within the views of 240x180 pixels");
  refused({"--caption", " "}, "--caption: is empty");
  refused({"--caption", "by {author}"}, "--caption: has {author}, which stands for nothing, expected {title}, {date}");
  refused({"--caption", "\xff"}, "--caption: is not UTF-8");
  refused({"--border", "10,mauve"}, "expected a colour");
  expect_refused(folder, {"pack", "left.png", "right.png", "--to", "disparity", "--border", "3", "-o", "out.png"}, 2,
                 "it works where the views are shown");
  expect_refused(folder, {"pack", "left.png", "right.png", "--border", "3", "-o", "card.pdf"}, 2, "which has a mount");
}

TEST(PackCommand, KeepsTheProfileOfPhotographsInPrints) {
  const TemporaryFolder folder;
  const PictureNotes wide{.colour_profile = display_p3()};
  write_image(folder / "left.png", still().left, wide);
  write_image(folder / "right.png", still().right, wide);
  const auto pack = [&](const std::string& file, const std::string& to, const std::string& output) {
    std::vector<std::string> words{"pack", file, "--to", to, "-o", output};
    if (file == "left.png") words.insert(words.begin() + 2, "right.png");
    run_in(folder, words);
    return read_in_profile(folder / output);
  };
  const PictureInProfile both = pack("left.png", "left-right", "both.png");
  EXPECT_EQ(both.colour_profile, wide.colour_profile);
  EXPECT_EQ(both.picture, put_together(still().left, still().right, StereoLayout::left_right));
  EXPECT_EQ(pack("left.png", "card", "card.tif").colour_profile, wide.colour_profile);
  EXPECT_EQ(pack("left.png", "jps", "both.jps").colour_profile, wide.colour_profile);
  pack("left.png", "mpo", "both.mpo");
  for (const std::string name : {"both.png", "both.jps", "both.mpo"}) {
    std::vector<std::string> words{"pack", name, "-o", "views", "--to", "views", "--format", "tif"};
    if (name == "both.png") words.insert(words.end(), {"--layout", "left-right"});
    run_in(folder, words);
    EXPECT_EQ(read_in_profile(folder / "views/view_001.tif").colour_profile, wide.colour_profile) << name;
  }
  run_in(folder, {"rectify", "left.png", "right.png", "-o", "rows"});
  EXPECT_EQ(read_in_profile(folder / "rows/right.png").colour_profile, wide.colour_profile);
}

TEST(PackCommand, BringsWhatIsMixedOrGoesToADisplayToSrgb) {
  const TemporaryFolder folder;
  const PictureNotes wide{.colour_profile = display_p3()};
  write_image(folder / "left.png", still().left, wide);
  write_image(folder / "right.png", still().right, wide);
  write_image(folder / "left_srgb.png", read_image(folder / "left.png"));
  write_image(folder / "right_srgb.png", read_image(folder / "right.png"));
  const std::vector<std::vector<std::string>> outputs{
      {"left-right", "a.webp"}, {"left-right", "a.ppm"}, {"anaglyph", "a.png"}, {"rgbd", "b.png"}};
  for (const std::vector<std::string>& output : outputs) {
    run_in(folder, {"pack", "left.png", "right.png", "--to", output[0], "-o", output[1]});
    run_in(folder, {"pack", "left_srgb.png", "right_srgb.png", "--to", output[0], "-o", "srgb_" + output[1]});
    EXPECT_EQ(bytes_of(folder / output[1]), bytes_of(folder / ("srgb_" + output[1]))) << output[1];
  }
  // Of two profiles neither can be kept.
  run_in(folder, {"pack", "left.png", "right_srgb.png", "--to", "left-right", "-o", "mixed.png"});
  run_in(folder, {"pack", "left_srgb.png", "right_srgb.png", "--to", "left-right", "-o", "srgb.png"});
  EXPECT_EQ(bytes_of(folder / "mixed.png"), bytes_of(folder / "srgb.png"));
}

TEST(PackCommand, MakesStereoCards) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"pack", "left.png", "right.png", "--caption", "Grüße {title}", "-o", "card.pdf"});
  EXPECT_TRUE(bytes_of(folder / "card.pdf").starts_with("%PDF-"));
  run_in(folder,
         {"pack", "left.png", "right.png", "--to", "card", "--dpi", "150", "--framing", "fit", "-o", "card.png"});
  EXPECT_EQ(read_image(folder / "card.png").width(), 1051);
  expect_refused(folder, {"pack", "left.png", "right.png", "--to", "anaglyph", "--dpi", "150", "-o", "a.png"}, 2,
                 "it works with card");
  expect_refused(folder, {"pack", "left.png", "right.png", "right.png", "-o", "card.pdf"}, 2, "takes two views");
  expect_refused(folder, {"pack", "left.png", "right.png", "--framing", "wide", "-o", "card.pdf"}, 2,
                 "expected fit, fill");
}

TEST(PackCommand, MakesAQuiltOfAPhotographThatIsNotPainted) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"pack", "left.png", "right.png", "--to", "rgbd", "-o", "both.png"});
  run_in(folder, {"pack", "both.png", "-o", "out", "--layout", "left-right"});
  std::filesystem::rename(folder / "out/view_001.png", folder / "depth.png");
  run_in(folder, {"pack", "both.png", "--display", "looking-glass-portrait", "-o", "quilt"});
  const Image<Rgb8> quilt = read_image(folder / "quilt_qs8x6a0.75.png");
  EXPECT_EQ(quilt.width(), 3360);
  const std::vector<Image<Rgb8>> views = views_of_quilt(quilt, {8, 6});
  EXPECT_LT(psnr(views[0], views[47]), psnr(views[23], views[24]));
  for (const std::vector<std::string>& photograph :
       std::vector<std::vector<std::string>>{{"left.png", "--depth", "depth.png"}, {"left.png", "right.png"}}) {
    std::vector<std::string> words{"pack", "--quilt", "2x2", "--span", "3", "-o", "small"};
    words.insert(words.begin() + 1, photograph.begin(), photograph.end());
    run_in(folder, words);
    const std::vector<Image<Rgb8>> few = views_of_quilt(read_image(folder / "small_qs2x2a1.3333.png"), {2, 2});
    EXPECT_LT(psnr(few[0], few[3]), psnr(few[1], few[2]));
  }
  run_in(folder, {"pack", "both.png", "--to", "anaglyph", "-o", "anaglyph.png"});
  run_in(folder, {"pack", "left.png", "right.png", "--to", "views", "--views", "3", "--span", "2", "-o", "three"});
  EXPECT_EQ(files_in(folder / "three").size(), 3u);
  run_in(folder, {"pack", "left.png", "right.png", "--display", "looking-glass-go", "--framing", "fit", "-o", "fit"});
  EXPECT_EQ(read_image(folder / "fit_qs11x6a0.5625.png")(100, 20), Rgb8{});
  expect_refused(folder, {"pack", "left.png", "right.png", "--to", "anaglyph", "--span", "2", "-o", "a.png"}, 2,
                 "it works where views are made");
  expect_refused(folder, {"pack", "left.png", "right.png", "--depth", "depth.png", "-o", "a.mpo"}, 2, "one picture");
  expect_refused(folder, {"pack", "left.png", "right.png", "--framing", "fit", "-o", "a.mpo"}, 2, "without --display");
  expect_refused(folder, {"paint", "left.png", "right.png", "--framing", "fit", "-o", "a"}, 2, "without --display");
}

TEST(PackCommand, ChoosesAFloatingWindow) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"pack", "left.png", "right.png", "--to", "views", "--floating-window", "auto", "-o", "window"});
  const Image<Rgb8> left = read_image(folder / "window/view_000.png");
  int strip = 0;
  while (left(strip, 90) == Rgb8{}) ++strip;
  EXPECT_GT(strip, 1);
  EXPECT_LT(strip, 30);
  run_in(folder, {"pack", "left.png", "right.png", "--to", "views", "--shift", "30", "--floating-window", "auto", "-o",
                  "deep"});
  EXPECT_NE(read_image(folder / "deep/view_000.png")(0, 90), Rgb8{});
}

/// An output of the format, and what it needs besides the views.
std::vector<std::string> pack_words(const cli::PackingFormat& format, std::string_view name) {
  std::vector<std::string> words{"pack", "left.png", "right.png", "--to", std::string(name), "-o"};
  // Depths of far things do not fit a PNG.
  const std::string_view ending = format.name == "depth" ? ".exr" : format.ending.empty() ? ".png" : format.ending;
  words.push_back("out" + std::string(ending));
  if (format.name == "quilt") words.insert(words.end(), {"--quilt", "2x1"});
  if (format.name == "lenticular") words.insert(words.end(), {"--screen", "barrier-2"});
  return words;
}

TEST(PackCommand, EveryFormatOfTheTableIsListedAndWrittenByEachOfItsNames) {
  const TemporaryFolder folder;
  put_still(folder);
  const std::string help = run_in(folder, {"pack", "--help"}).output;
  for (const cli::PackingFormat& format : cli::packing_formats()) {
    EXPECT_THAT(help, HasSubstr(std::string(format.name)));
    if (format.name == "views" || !format.write) continue;  // a folder, and slices of a painting: tested below
    for (const std::string_view name : {format.name, format.alias}) {
      if (name.empty()) continue;
      const std::vector<std::string> words = pack_words(format, name);
      run_in(folder, words);
      EXPECT_TRUE(std::filesystem::remove(folder / words[6])) << name;
    }
  }
}

TEST(PackCommand, EveryLayoutOfTheTableComesApartAgain) {
  const TemporaryFolder folder;
  put_still(folder);
  for (const LayoutTraits& traits : stereo_layouts()) {
    if (!is_packed(traits.layout)) continue;
    run_in(folder, {"pack", "left.png", "right.png", "--to", std::string(traits.name), "-o", "both.png"});
    const StereoPair back = cut_apart(read_image(folder / "both.png"), traits.layout, "both.png");
    // Where half of an eye's pixels are kept, the others are interpolated: 24.4 dB in rows.
    EXPECT_GE(psnr(back.left, still().left), 24) << traits.name;
    EXPECT_GE(psnr(back.right, still().right), 24) << traits.name;
    EXPECT_LT(psnr(back.left, still().right), 20) << traits.name;
  }
}

TEST(PackCommand, ADisplayWithLensesGetsOnePictureUnderThem) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"pack", "left.png", "right.png", "--display", "barrier-2", "-o", "display.png"});
  run_in(folder, {"pack", "left.png", "right.png", "--screen", "barrier-2", "-o", "screen.png"});
  EXPECT_EQ(read_image(folder / "display.png"), read_image(folder / "screen.png"));
  expect_refused(folder, {"pack", "left.png", "right.png", "--display", "desk-stereo", "-o", "out.png"}, 2, "--to");
  expect_refused(folder, {"pack", "left.png", "right.png", "--screen", "desk-stereo", "-o", "out.png"}, 2, "step-9");
}

TEST(PackCommand, APaintingHasAsManyViewsAsAreWanted) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"paint", "left.png", "right.png", "-o", "painted"});
  run_in(folder, {"pack", "painted/painting.wst", "-o", "two"});
  EXPECT_TRUE(std::filesystem::exists(folder / "two/view_001.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "two/view_002.png"));
  run_in(folder, {"pack", "painted/painting.wst", "--to", "anaglyph", "-o", "anaglyph.png"});
  run_in(folder, {"pack", "painted/painting.wst", "--to", "views", "--views", "5", "--span", "3", "-o", "five"});
  EXPECT_EQ(files_in(folder / "five").size(), 5u);
  EXPECT_NE(read_image(folder / "five/view_000.png"), read_image(folder / "five/view_004.png"));
  run_in(folder, {"pack", "painted/painting.wst", "--to", "quilt", "--quilt", "8x6", "-o", "quilt"});
}

TEST(PackCommand, ASlicedPaintingIsDrawnInEveryFormat) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"paint", "left.png", "right.png", "-o", "painted"});
  run_in(folder, {"paint", "painted/painting.wst", "--slice-depth", "40%", "--slice-layer", "2", "-o", "again"});
  run_in(folder, {"pack", "painted/painting.wst", "--slice-depth", "40%", "--slice-layer", "2", "-o", "two"});
  EXPECT_EQ(read_image(folder / "two/view_000.png"), read_image(folder / "again/left.png"));
  EXPECT_EQ(read_image(folder / "two/view_001.png"), read_image(folder / "again/right.png"));
  run_in(folder, {"pack", "painted/painting.wst", "--quilt", "2x2", "--slice-depth", "40%", "-o", "sliced.png"});
  run_in(folder, {"pack", "painted/painting.wst", "--quilt", "2x2", "-o", "whole.png"});
  EXPECT_NE(read_image(folder / "sliced.png"), read_image(folder / "whole.png"));
  run_in(folder, {"share", "painted/painting.wst", "-o", "whole.html"});
  run_in(folder, {"share", "painted/painting.wst", "--slice-depth", "100%", "-o", "sliced.html"});
  EXPECT_LT(bytes_of(folder / "sliced.html").size(), bytes_of(folder / "whole.html").size());
  expect_refused(folder, {"pack", "left.png", "right.png", "--slice-depth", "40%", "-o", "out.mpo"}, 2,
                 "--slice-depth: has no effect on several files; it works on a painting (.wst)");
  expect_refused(folder, {"share", "left.png", "right.png", "--slice-layer", "1", "-o", "out.html"}, 2,
                 "--slice-layer: has no effect on a stereo photograph");
  expect_refused(folder, {"pack", "painted/painting.wst", "--slice-keep", "front", "-o", "out.mpo"}, 2,
                 "--slice-keep: has no effect without a plane");
}

TEST(PackCommand, PlanesTravelThroughAPaintingInAFilm) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"paint", "left.png", "right.png", "-o", "painted"});
  const auto film = [&](std::vector<std::string> more) {
    std::vector<std::string> words{
        "pack", "painted/painting.wst", "--slice-from", "0%", "--slice-to", "100%", "--frames", "3"};
    words.insert(words.end(), more.begin(), more.end());
    return run_in(folder, words).output;
  };
  film({"--to", "top-bottom", "-o", "frame_%04d.png"});
  run_in(folder, {"pack", "painted/painting.wst", "--slice-depth", "50%", "--to", "top-bottom", "-o", "middle.png"});
  EXPECT_EQ(read_image(folder / "frame_0002.png"), read_image(folder / "middle.png"));
  film({"-o", "two.mp4", "--rate", "12"});
  const auto two = nlohmann::json::parse(run_in(folder, {"info", "two.mp4", "--json"}).output);
  EXPECT_EQ(two["layout"], "left-right");
  EXPECT_EQ(two["frames"], 3);
  EXPECT_EQ(two["width"], 480);
  film({"--to", "anaglyph", "-o", "anaglyph.mkv"});
  const auto anaglyph = nlohmann::json::parse(run_in(folder, {"info", "anaglyph.mkv", "--json"}).output);
  EXPECT_EQ(anaglyph["pixel_format"], "yuv444p");
  film({"--quilt", "2x2", "-o", "quilt"});
  EXPECT_TRUE(std::filesystem::exists(folder / "quilt_qs2x2a1.3333.mp4"));
  const auto refused = [&](std::vector<std::string> words, const char* why) {
    words.insert(words.begin(), {"pack", "painted/painting.wst"});
    expect_refused(folder, words, 2, why);
  };
  refused({"--slice-from", "0%", "--slice-to", "9px", "-o", "o.mp4"}, "expected as many depths as '0%', in the same");
  refused({"--slice-from", "0%", "--slice-to", "9%", "--to", "mpo", "-o", "o.mp4"}, "--to mpo: is no format of a film");
  refused({"--slice-from", "0%", "--slice-to", "9%", "--floating-window", "auto", "-o", "o.mp4"},
          "as 'auto' on a film");
  refused({"--frames", "3", "-o", "o.mpo"}, "--frames: has no effect on a picture");
  EXPECT_FALSE(std::filesystem::exists(folder / "o.mp4"));
}

TEST(PackCommand, MakesSlicesOfAPaintingWhoseDepthIsChosenWhenTheyAreShown) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"paint", "left.png", "right.png", "-o", "painted"});
  const auto slices_of = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"--json", "pack", "painted/painting.wst", "--to", "slices"};
    words.insert(words.end(), more.begin(), more.end());
    return nlohmann::json::parse(run_in(folder, words).output);
  };
  EXPECT_GT(slices_of({"-o", "slices.exr"})["slices"], 8);
  run_in(folder, {"render", "slices.exr", "--near", "20", "--far", "40", "-o", "views"});
  run_in(folder, {"share", "slices.exr", "-o", "page.html"});
  EXPECT_TRUE(std::filesystem::exists(folder / "page.html"));
  // A plane that cuts the finest layer leaves other strokes to see.
  slices_of({"--slice-depth", "50%", "-o", "cut.exr"});
  run_in(folder, {"render", "cut.exr", "--near", "20", "--far", "40", "-o", "cut"});
  EXPECT_NE(read_image(folder / "views/view_000.png"), read_image(folder / "cut/view_000.png"));

  const auto refused = [&](std::vector<std::string> words, int code, const char* why) {
    words.insert(words.begin(), "pack");
    words.insert(words.end(), {"--to", "slices"});
    expect_refused(folder, words, code, why);
  };
  EXPECT_EQ(slices_of({"--max-size", "160", "-o", "small.exr"})["width"], 160);
  // A photograph has slices, too, of its own depth or matched.
  run_in(folder, {"pack", "left.png", "right.png", "--to", "slices", "--max-size", "160", "-o", "pair.exr"});
  EXPECT_EQ(nlohmann::json::parse(run_in(folder, {"info", "pair.exr", "--json"}).output)["width"], 160);
  refused({"views", "-o", "o.exr"}, 2, "--to slices: works on a painting (.wst) or a photograph, not on views");
  refused({"painted/painting.wst", "--swap", "-o", "o.exr"}, 2, "--swap: has no effect on a painting's slices");
  refused({"painted/painting.wst", "-o", "o.png"}, 2, "expected a name that ends with .exr");
  refused({"painted/painting.wst", "--views", "5", "-o", "o.exr"}, 2, "--views: has no effect with --to slices");
  refused({"none.wst", "-o", "o.exr"}, 3, "none.wst: cannot be opened");
}

using PackOnGpu = NeedsGpu;

TEST_F(PackOnGpu, DrawsTheSameViews) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"paint", "left.png", "right.png", "--style", "posterise", "-o", "painted"});
  for (const std::string device : {"cpu", "gpu"})
    run_in(folder, {"pack", "painted/painting.wst", "--to", "views", "--views", "3", "--device", device, "-o", device});
  for (const std::string view : {"view_000.png", "view_001.png", "view_002.png"})
    EXPECT_GT(psnr_db(read_image(folder / "cpu" / view), read_image(folder / "gpu" / view)), 45) << view;
  expect_refused(folder, {"pack", "left.png", "right.png", "--device", "gpu", "-o", "out.mpo"}, 2, "--device: has no");
}

TEST(PackCommand, APaintingOfTwoEyesHasTwoViewsAndNoMore) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"paint", "left.png", "right.png", "--propagation", "independent", "-o", "painted"});
  const std::string painting = "painted/painting.wst";
  run_in(folder, {"pack", painting, "--to", "anaglyph", "-o", "anaglyph.png"});
  expect_refused(folder, {"pack", painting, "--views", "5", "-o", "out"}, 3, "painting.wst: has no surfaces");
  expect_refused(folder, {"paint", painting, "--display", "nine-view", "-o", "out"}, 3, "paint its photographs again");
}

TEST(PackCommand, RefusesWhatDoesNotFit) {
  const TemporaryFolder folder;
  put_still(folder);
  write_image(folder / "small.png", Image<Rgb8>(20, 20));
  expect_refused(folder, {"pack", "left.png", "right.png", "-o", "out.png"}, 2, "choose one with --to");
  expect_refused(folder, {"pack", "left.png", "right.png", "--to", "smellovision", "-o", "out.png"}, 2, "checkerboard");
  expect_refused(folder, {"pack", "left.png", "right.png", "left.png", "--to", "anaglyph", "-o", "out.png"}, 2,
                 "takes two views, but there are 3");
  expect_refused(folder, {"pack", "left.png", "right.png", "--to", "quilt", "-o", "out.png"}, 2, "--quilt");
  expect_refused(folder, {"pack", "left.png", "right.png", "--to", "lenticular", "-o", "out.png"}, 2, "--screen");
  expect_refused(folder, {"pack", "left.png", "small.png", "--to", "anaglyph", "-o", "out.png", "--quiet"}, 3,
                 "small.png: is 20x20");
  expect_refused(folder, {"pack", "left.png", "--to", "anaglyph", "-o", "out.png", "--quiet"}, 3, "left.png");
  write_whole_file(folder / "visual.json", R"({"screenW": 100})");
  expect_refused(folder, {"pack", "left.png", "right.png", "--screen", "visual.json", "-o", "out.png", "--quiet"}, 3,
                 "visual.json");
}

TEST(PaintCommand, OnePhotographForEveryViewOfADisplay) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"pack", "left.png", "right.png", "-o", "photo.mpo"});
  const auto facts = nlohmann::json::parse(run_in(folder, {"paint", "photo.mpo", "--display", "looking-glass-portrait",
                                                           "--format", "jpg", "-o", "photo", "--json"})
                                               .output);
  EXPECT_EQ(facts["views"], 48);
  EXPECT_LT(facts["worst_bare_share"].get<double>(), 0.01);
  const Image<Rgb8> quilt = read_image(folder / "photo_qs8x6a0.75.jpg");
  EXPECT_EQ(quilt.width(), 3360);
  EXPECT_EQ(quilt.height(), 3360);
  run_in(folder, {"paint", "photo.mpo", "--display", "nine-view", "--views", "3", "--size", "160x90", "-o", "three"});
  EXPECT_TRUE(std::filesystem::exists(folder / "three/view_002.png"));
  run_in(folder, {"paint", "photo.mpo", "--display", "step-5", "--size", "160x90", "-o", "under_lenses"});
  EXPECT_EQ(read_image(folder / "under_lenses.png").width(), 1920);
  EXPECT_FALSE(std::filesystem::exists(folder / "under_lenses"));
  expect_refused(folder, {"paint", "photo.mpo", "--display", "crystal-ball", "-o", "out"}, 2, "looking-glass-go");
}

TEST(InfoCommand, TellsHowDeepAPhotographIsOnADisplay) {
  const TemporaryFolder folder;
  put_still(folder);
  run_in(folder, {"pack", "left.png", "right.png", "-o", "photo.mpo"});
  const auto facts =
      nlohmann::json::parse(run_in(folder, {"info", "photo.mpo", "--display", "desk-stereo", "--json"}).output);
  EXPECT_GT(facts["nearest_disparity_px"], facts["farthest_disparity_px"]);
  EXPECT_GT(facts["before_screen_mm"].get<double>(), 0);
  EXPECT_TRUE(facts.contains("comfort"));
}

}  // namespace wheatstone::pack_test
