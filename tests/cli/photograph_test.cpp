// Stereo photographs in one file, from the command line: what is understood, what is said of it, what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/run_program.h"
#include "scenes/stereograph_card.h"
#include "scenes/test_photographs.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::photograph_test {

using testing::HasSubstr;

const StereoPair& still() {
  static const StereoPair pair = make_synthetic_still({.width = 320, .height = 240, .samples_a_side = 1}).pictures;
  return pair;
}

Image<Rgb8> side_by_side(const Image<Rgb8>& first, const Image<Rgb8>& second) {
  Image<Rgb8> both(2 * first.width(), first.height());
  for (int y = 0; y < first.height(); ++y)
    for (int x = 0; x < first.width(); ++x) both(x, y) = first(x, y), both(x + first.width(), y) = second(x, y);
  return both;
}

void put_mpo(const std::filesystem::path& path, const Image<Rgb8>& left, const Image<Rgb8>& right) {
  const ImageView<const Rgb8> views[] = {left, right};
  write_mpo(path, views);
}

ProgramResult match_one(const TemporaryFolder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), "match");
  words.insert(words.end(), {"-o", "matched"});
  return run_program(words, {.folder = folder / ""});
}

TEST(Photograph, OfOneFileIsMatchedAsTwoFilesAre) {
  const TemporaryFolder folder;
  write_image(folder / "left.png", still().left);
  write_image(folder / "right.png", still().right);
  write_image(folder / "both_sbs.png", side_by_side(still().left, still().right));
  ProgramResult result = match_one(folder, {"left.png", "right.png"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.errors, testing::Not(HasSubstr(".png:")));
  const std::string two = bytes_of(folder / "matched/left_disparity.pfm");
  result = match_one(folder, {"both_sbs.png"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.errors, testing::StartsWith("both_sbs.png: side by side, left eye left (from its name)\n"));
  EXPECT_EQ(bytes_of(folder / "matched/left_disparity.pfm"), two);
  EXPECT_EQ(match_one(folder, {"both_sbs.png", "--quiet"}).errors, "");
}

TEST(Photograph, OfEachKindSaysHowItWasUnderstood) {
  const TemporaryFolder folder;
  put_mpo(folder / "a.mpo", still().left, still().right);
  write_jps(folder / "a.jps", still().left, still().right);
  write_image(folder / "a.png", side_by_side(still().left, still().right));
  const std::pair<std::string, std::string> cases[] = {
      {"a.mpo", "a.mpo: MPO, 2 pictures (from its metadata)\n"},
      {"a.jps", "a.jps: side by side, right eye left (from its metadata)\n"},
      {"a.png", "a.png: side by side, left eye left (from comparing its halves)\n"}};
  for (const auto& [file, line] : cases) {
    const ProgramResult result = match_one(folder, {file, "--quality", "fast"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.errors, HasSubstr(line));  // progress may come before it
    EXPECT_THAT(result.errors, testing::Not(HasSubstr("swapped")));
  }
}

TEST(Photograph, OfAScanSaysWhatItIs) {
  const TemporaryFolder folder;
  const ProgramRun here{.folder = folder / ""};
  write_image(folder / "left.png", still().left);
  write_image(folder / "right.png", still().right);
  write_image(folder / "card.png", make_card(still(), {.width = 800, .turn_deg = 0.6}).picture);
  for (const char* output : {"glasses.png", "two.gif", "two.webp"}) {
    const bool is_anaglyph = std::string(output) == "glasses.png";
    const ProgramResult packed = run_program(
        {"pack", "left.png", "right.png", "--to", is_anaglyph ? "colour" : "wiggle", "-o", output, "--quiet"}, here);
    ASSERT_EQ(packed.exit_code, 0) << packed.errors;
  }
  using Words = std::vector<std::string>;
  const std::pair<Words, std::string> cases[] = {
      {{"card.png", "--layout", "card"}, "card.png: two photographs on a mount (given); windows of 33"},
      {{"glasses.png", "--layout", "anaglyph-red-cyan"}, "both are grey"},
      {{"two.gif"}, "two.gif: GIF, 2 pictures (from its metadata); the first frame is used for the left eye"},
      {{"two.webp"}, "two.webp: WEBP, 2 pictures"}};
  for (const auto& [words, line] : cases) {
    Words pack{"pack"};
    pack.insert(pack.end(), words.begin(), words.end());
    pack.insert(pack.end(), {"--to", "left-right", "-o", "packed.bmp", "--quiet"});
    EXPECT_EQ(run_program(pack, here).exit_code, 0);
    Words match = words;
    match.insert(match.end(), {"--quality", "fast"});
    const ProgramResult result = match_one(folder, match);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr(line));
  }
}

TEST(Photograph, IsPaintedFromOneFile) {
  const TemporaryFolder folder;
  put_mpo(folder / "a.mpo", still().left, still().right);
  const ProgramResult result = run_program({"paint", "a.mpo", "-o", "painted"}, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(files_in(folder / "painted"), testing::IsSupersetOf({"left.png", "right.png", "painting.wst"}));
}

TEST(Photograph, WithSwappedEyesIsNoticedAndPutRight) {
  const TemporaryFolder folder;
  put_mpo(folder / "a.mpo", still().right, still().left);
  EXPECT_THAT(match_one(folder, {"a.mpo"}).errors, HasSubstr("the eyes look swapped; add --swap"));
  EXPECT_THAT(match_one(folder, {"a.mpo", "--swap"}).errors, testing::Not(HasSubstr("look swapped")));
  write_image(folder / "left.png", still().left);
  write_image(folder / "right.png", still().right);
  EXPECT_THAT(match_one(folder, {"right.png", "left.png"}).errors, HasSubstr("right.png: the eyes look swapped"));
  EXPECT_THAT(match_one(folder, {"right.png", "left.png", "--swap"}).errors, testing::Not(HasSubstr("swapped")));
}

TEST(Photograph, TellsTheOrderOfTheEyesOrThatItIsUndecided) {
  const TemporaryFolder folder;
  const auto painted = [&](const StereoPair& pair) {
    write_image(folder / "left.png", pair.left);
    write_image(folder / "right.png", pair.right);
    return run_program({"paint", "left.png", "right.png", "-o", "painted"}, {.folder = folder / ""});
  };
  const auto told = [&] {
    return nlohmann::json::parse(std::ifstream(folder / "painted/report.json"))["pair"]["eyes_look_swapped"];
  };
  const StereoPair small = still_for_test(160, 120);
  const ProgramResult right = painted(small);
  EXPECT_EQ(told(), false);
  EXPECT_THAT(right.output, testing::Not(HasSubstr("left from right")));
  const ProgramResult wrong = painted({small.right, small.left});
  EXPECT_EQ(told(), true);
  EXPECT_THAT(wrong.errors, HasSubstr("the eyes look swapped"));
  const ProgramResult undecided = painted(still_for_test(64, 48));
  EXPECT_EQ(told(), nullptr);
  EXPECT_THAT(undecided.output, HasSubstr("the pictures do not tell left from right"));
}

TEST(Photograph, ThatIsNoPairIsRefused) {
  const TemporaryFolder folder;
  const StereoPair other = make_synthetic_still({.width = 320, .height = 240, .seed = 9, .samples_a_side = 1}).pictures;
  Image<Rgb8> turned(320, 240);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) turned(x, y) = other.right((3 * x) % 320, 239 - y);
  write_image(folder / "left.png", still().left);
  write_image(folder / "other.png", turned);
  write_image(folder / "mixed_sbs.png", side_by_side(still().left, turned));
  expect_refused(folder, {"match", "left.png", "-o", "results"}, 3, "left.png: holds one view");
  for (const std::string command : {"match", "paint"}) {
    expect_refused(folder, {command, "left.png", "other.png", "-o", "results"}, 3,
                   "left.png, other.png: the pictures show different scenes");
    expect_refused(folder, {command, "mixed_sbs.png", "-o", "results"}, 3,
                   "mixed_sbs.png (side by side, left eye left (from its name)): the pictures show different scenes");
    expect_refused(folder, {command, "left.png", "--layout", "anaglyph", "-o", "results"}, 2, "anaglyph-red-cyan");
    expect_refused(folder, {command, "left.png", "--layout", "card", "-o", "results"}, 3, "no two windows");
    expect_refused(folder, {command, "left.png", "--layout", "woven", "-o", "results"}, 2, "left-right-half");
    // With a layout, each file that `paint` takes is a photograph of its own.
    expect_refused(folder, {command, "left.png", "left.png", "--layout", "tb", "-o", "results"}, 2,
                   command == "paint" ? "the same folder" : "--layout");
  }
}

/// Writes the still with its right eye turned by a small angle.
void put_unrectified(const TemporaryFolder& folder) {
  StereoPair pair = still();
  constexpr float slope = 0.05f;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const int from = y + static_cast<int>(slope * static_cast<float>(x - 160)) + 12;
      pair.right(x, y) = still().right(x, std::clamp(from, 0, 239));
    }
  write_image(folder / "left.png", pair.left);
  write_image(folder / "low.png", pair.right);
}

TEST(Photograph, ThatIsNotRectifiedIsMatchedWithAWarning) {
  const TemporaryFolder folder;
  put_unrectified(folder);
  const ProgramResult result = match_one(folder, {"left.png", "low.png", "--rectify", "never", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.errors,
              HasSubstr("warning: left.png, low.png: the pictures are not rectified: their rows differ"));
  EXPECT_THAT(result.errors, HasSubstr("'wheatstone rectify'"));
  const auto pair = nlohmann::json::parse(result.output)["pair"];
  EXPECT_NEAR(pair["row_difference"]["median_px"], 12, 4);
  EXPECT_THAT(pair["warning"], HasSubstr("wheatstone rectify"));
}

TEST(Photograph, ThatIsNotRectifiedIsRectifiedByItself) {
  const TemporaryFolder folder;
  put_unrectified(folder);
  const ProgramResult matched = match_one(folder, {"left.png", "low.png", "--json"});
  ASSERT_EQ(matched.exit_code, 0) << matched.errors;
  EXPECT_THAT(matched.errors, HasSubstr("left.png, low.png: the pair was rectified: its rows differed by"));
  const auto pair = nlohmann::json::parse(matched.output)["pair"];
  EXPECT_EQ(pair["rectified"], true);
  EXPECT_NEAR(pair["photographs_row_difference"]["median_px"], 12, 4);
  EXPECT_LT(pair["row_difference"]["median_px"], 1);
  EXPECT_EQ(pair["rectification"]["right"]["homography"].size(), 9U);
  const ProgramResult packed =
      run_program({"pack", "left.png", "low.png", "--to", "rgbd", "-o", "a.png"}, {.folder = folder / ""});
  EXPECT_EQ(packed.exit_code, 0);
  EXPECT_THAT(packed.errors, HasSubstr("the pair was rectified"));
  EXPECT_LT(read_image(folder / "a.png").width(), 640) << "a rectified picture is cropped";
}

TEST(Photograph, ThatMatchesPoorlyHasOneWarningWithItsReason) {
  const TemporaryFolder folder;
  const StereoPair& pair = still();
  Image<Rgb8> blurred(pair.right.width(), pair.right.height());
  cv::Mat target = as_mat(blurred);
  cv::GaussianBlur(as_mat(pair.right), target, {}, 4);
  write_image(folder / "left.png", pair.left);
  write_image(folder / "blurred.png", blurred);
  for (const auto& [right, reason] : {std::pair{"blurred.png", "blurred"}, {"left.png", "one place"}}) {
    const ProgramResult result = match_one(folder, {"left.png", right, "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr(reason));
    EXPECT_EQ(result.errors.find("warning:"), result.errors.rfind("warning:")) << result.errors;
    EXPECT_THAT(nlohmann::json::parse(result.output)["confidence"]["warning"], HasSubstr(reason));
  }
}

TEST(Photograph, ThatIsNotRectifiedIsPaintedRectified) {
  const TemporaryFolder folder;
  put_unrectified(folder);
  std::vector<std::string> line{"paint", "left.png", "low.png", "-o", "painted", "--json", "--rectify", "auto"};
  ProgramResult result = run_program(line, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.errors, testing::Not(HasSubstr("after rectification")));
  const auto pair = nlohmann::json::parse(result.output)["pair"];
  EXPECT_EQ(pair["rectified"], true);
  // The right picture lies so low that a tenth of the rows has no partner.
  EXPECT_NEAR(pair["kept_area"], 0.89, 0.02);
  EXPECT_THAT(result.errors, HasSubstr("warning: left.png, low.png: rectifying cuts off 11 %"));
  EXPECT_TRUE(pair["warning"].is_null());
  EXPECT_LT(pair["row_difference"]["median_px"], 1);
  // What was painted stands beside the painting.
  EXPECT_TRUE(same_size(read_image(folder / "painted/left_photograph.png"), read_image(folder / "painted/left.png")));
  line.back() = "never";
  result = run_program(line, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(nlohmann::json::parse(result.output)["pair"]["warning"], HasSubstr("rows differ"));
  line.back() = "perhaps";
  expect_refused(folder, line, 2, "expected auto|never|always");
}

// The address sanitizer keeps what was freed.
#ifndef __SANITIZE_ADDRESS__
TEST(PhotographLong, OfTwelveMegapixelsFitsIntoAGigabyte) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"synth", "still", "--camera", "phone", "--size", "4000x3000", "--samples", "1", "-o", "phone",
                         "--quiet"},
                        {.folder = folder / ""})
                .exit_code,
            0);
  const ProgramResult result = run_program({"paint", "phone/left.jpg", "phone/right.jpg", "-o", "painted", "--json"},
                                           {.folder = folder / "", .own_process = true});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(nlohmann::json::parse(result.output)["pair"]["rectified"], true);
  RecordProperty("megabytes", std::to_string(result.peak_bytes / 1'000'000));
  EXPECT_LT(result.peak_bytes, 1'000'000'000u);
}
#endif

TEST(Photograph, ThatIsUpsideDownMirroredOrBlackIsRefused) {
  const TemporaryFolder folder;
  Image<Rgb8> down(320, 240), mirrored(320, 240);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      down(x, y) = still().right(319 - x, 239 - y);
      mirrored(x, y) = still().right(319 - x, y);
    }
  write_image(folder / "left.png", still().left);
  write_image(folder / "down.png", down);
  write_image(folder / "mirrored.png", mirrored);
  write_image(folder / "black.png", Image<Rgb8>(320, 240));
  expect_refused(folder, {"paint", "left.png", "down.png", "-o", "results"}, 3,
                 "left.png, down.png: the right picture is upside down");
  expect_refused(folder, {"match", "left.png", "mirrored.png", "-o", "results"}, 3, "mirrored");
  expect_refused(folder, {"paint", "left.png", "black.png", "-o", "results"}, 3, "blank");
  expect_refused(folder, {"pack", "left.png", "down.png", "--to", "depth", "-o", "a.pfm"}, 3, "upside down");
}

TEST(Photograph, IsToldOfByInfo) {
  const TemporaryFolder folder;
  write_jps(folder / "a.jps", still().left, still().right, StereoLayout::top_bottom);
  ProgramResult result = run_program({"info", folder / "a.jps", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  nlohmann::json facts = nlohmann::json::parse(result.output);
  EXPECT_EQ(facts["layout"], "top-bottom");
  EXPECT_EQ(facts["layout_known"], "from its metadata");
  EXPECT_EQ(facts["views"], 2);
  EXPECT_EQ(facts["view_width"], 320);
  EXPECT_EQ(facts["view_height"], 240);
  EXPECT_EQ(facts["same_scene"], true);
  EXPECT_EQ(facts["eyes_look_swapped"], false);
  put_mpo(folder / "a.mpo", still().right, still().left);
  facts = nlohmann::json::parse(run_program({"info", folder / "a.mpo", "--json"}).output);
  EXPECT_EQ(facts["layout"], "MPO");
  EXPECT_EQ(facts["eyes_look_swapped"], true);
  write_jps(folder / "same.jps", still().left, still().left, StereoLayout::top_bottom);
  facts = nlohmann::json::parse(run_program({"info", folder / "same.jps", "--json"}).output);
  EXPECT_EQ(facts["eyes_look_swapped"], nullptr);
  EXPECT_THAT(run_program({"info", folder / "same.jps"}).output, HasSubstr("eyes look swapped: not known"));
  write_image(folder / "mono.png", still().left);
  facts = nlohmann::json::parse(run_program({"info", folder / "mono.png", "--json"}).output);
  EXPECT_FALSE(facts.contains("stereo"));
}

}  // namespace wheatstone::photograph_test
