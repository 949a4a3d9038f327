// A pair rectified from the command line, and painted from there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::rectify_test {

/// The picture turned by a few degrees around its corner and moved down, as a hand-held second shot is.
Image<Rgb8> spoiled(const Image<Rgb8>& picture) {
  constexpr double slope = 0.03, down_px = 6;
  Image<Rgb8> result(picture.width(), picture.height());
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const double from_x = x + slope * y, from_y = y - slope * x - down_px;
      result(x, y) = picture(std::clamp(static_cast<int>(std::lround(from_x)), 0, picture.width() - 1),
                             std::clamp(static_cast<int>(std::lround(from_y)), 0, picture.height() - 1));
    }
  }
  return result;
}

void write_spoiled_pair(const TemporaryFolder& folder) {
  static const StereoPair still = make_synthetic_still({.width = 400, .height = 300, .samples_a_side = 1}).pictures;
  write_image(folder / "left.png", still.left);
  write_image(folder / "right.png", spoiled(still.right));
}

TEST(RectifyCommand, MakesAPairThatCanBePainted) {
  const TemporaryFolder folder;
  write_spoiled_pair(folder);
  const ProgramRun here = {.folder = folder / ""};
  const ProgramResult result =
      run_program({"rectify", "left.png", "right.png", "-o", "rectified", "--json", "--quiet"}, here);
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const nlohmann::json facts = nlohmann::json::parse(result.output);
  EXPECT_GT(facts["vertical_disparity_before"]["median_px"], 5);
  EXPECT_LT(facts["vertical_disparity_after"]["median_px"], 0.7);
  EXPECT_LT(facts["vertical_disparity_after"]["percentile_95_px"], 2);
  EXPECT_GE(facts["measured_matches"], 20);
  EXPECT_TRUE(facts["colour"].is_object());
  EXPECT_EQ(files_in(folder / "rectified"), (std::set<std::string>{"left.png", "right.png"}));

  const ProgramResult painted =
      run_program({"paint", "rectified/left.png", "rectified/right.png", "-o", "painted", "--quiet"}, here);
  EXPECT_EQ(painted.exit_code, 0) << painted.errors;
}

TEST(RectifyCommand, WritesTheFormatThatIsAskedFor) {
  const TemporaryFolder folder;
  write_spoiled_pair(folder);
  const ProgramRun here = {.folder = folder / ""};
  for (const std::string format : {"jpg", "tif", "webp"}) {
    const ProgramResult result =
        run_program({"rectify", "left.png", "right.png", "--format", format, "-o", format, "--quiet"}, here);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(files_in(folder / format), (std::set<std::string>{"left." + format, "right." + format}));
    EXPECT_EQ(describe_image(folder / (format + "/left." + format)).format, format == "jpg"   ? "jpeg"
                                                                            : format == "tif" ? "tiff"
                                                                                              : format);
  }
  expect_refused(folder, {"rectify", "left.png", "right.png", "--format", "bmp"}, 2, "png|jpg|tif|webp");
}

TEST(RectifyCommand, TakesOneFileWithBothViews) {
  const TemporaryFolder folder;
  write_spoiled_pair(folder);
  const ProgramRun here = {.folder = folder / ""};
  ASSERT_EQ(run_program({"pack", "left.png", "right.png", "--to", "sbs", "-o", "both_sbs.png"}, here).exit_code, 0);
  for (const std::vector<std::string>& line :
       {std::vector<std::string>{"rectify", "both_sbs.png", "-o", "one", "--json"},
        {"rectify", "both_sbs.png", "--layout", "sbs", "--json", "-o", "one"}}) {
    const ProgramResult result = run_program(line, here);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_LT(nlohmann::json::parse(result.output)["vertical_disparity_after"]["median_px"], 0.7);
  }
  expect_refused(folder, {"rectify", "left.png", "--quiet"}, 3, "left.png: holds one view");
}

TEST(RectifyCommand, LeavesColoursAloneWhenAsked) {
  const TemporaryFolder folder;
  write_spoiled_pair(folder);
  const ProgramResult result =
      run_program({"rectify", "left.png", "right.png", "--no-match-colour", "--quiet"}, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, testing::Not(testing::HasSubstr("colour")));
}

TEST(RectifyCommand, RefusesWhatIsNoPair) {
  const TemporaryFolder folder;
  write_spoiled_pair(folder);
  write_image(folder / "blank.png", Image<Rgb8>(400, 300, {120, 130, 140}));
  expect_refused(folder, {"rectify", "left.png", "blank.png", "--quiet"}, 3,
                 "left.png, blank.png: the right picture has only 0 distinct points");
  expect_refused(folder, {"rectify", "left.png", "left.png", "--quiet"}, 3, "taken from the same position");
  put_bytes(folder / "letter.yml", "Dear Sir, this is a letter.\n");
  for (const std::string name : {"letter.yml", "missing.yml"})
    expect_refused(folder, {"rectify", "left.png", "right.png", "--calibration", name, "--quiet"}, 3, name + ": ");
}

}  // namespace wheatstone::rectify_test
