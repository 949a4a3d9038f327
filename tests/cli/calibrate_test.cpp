// A rig calibrated from the command line, from boards rendered by the test.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "scenes/checkerboard_picture.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::calibrate_test {

using testing::HasSubstr;

/// Pairs of a board of 7×5 inner corners, 20 mm apart, by cameras 60 mm apart.
void write_pairs(const TemporaryFolder& folder) {
  for (std::size_t i = 0; i < checkerboard_tilts.size(); ++i) {
    const std::string rest = std::to_string(i) + ".png";
    CheckerboardView view{.tilt_x = checkerboard_tilts[i][0], .tilt_y = checkerboard_tilts[i][1], .camera_mm = -30};
    write_image(folder / ("left_" + rest), checkerboard_picture(view));
    view.camera_mm = 30;
    write_image(folder / ("right_" + rest), checkerboard_picture(view));
  }
}

TEST(CalibrateCommand, MeasuresTheRigAndRectifiesWithIt) {
  const TemporaryFolder folder;
  write_pairs(folder);
  const ProgramRun here = {.folder = folder / ""};
  const ProgramResult result =
      run_program({"calibrate", ".", "--board", "7x5", "--square", "2cm", "-o", "rig.yml", "--json", "--quiet"}, here);
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const nlohmann::json facts = nlohmann::json::parse(result.output);
  EXPECT_LT(facts["reprojection_error_px"], 0.2);
  EXPECT_LT(facts["row_difference_px"], 0.1);
  EXPECT_NEAR(facts["baseline_mm"], 60, 1);
  EXPECT_FALSE(facts["eyes_swapped"]);
  EXPECT_EQ(facts["pairs"].size(), checkerboard_tilts.size());

  const ProgramResult turned = run_program(
      {"rectify", "left_0.png", "right_0.png", "--calibration", "rig.yml", "-o", "rectified", "--quiet"}, here);
  EXPECT_EQ(turned.exit_code, 0) << turned.errors;
  EXPECT_EQ(files_in(folder / "rectified").size(), 2U);
  write_image(folder / "small.png", Image<Rgb8>(64, 48));
  expect_refused(folder, {"rectify", "small.png", "small.png", "--calibration", "rig.yml", "-o", "none", "--quiet"}, 3,
                 "expected the calibration's 400x300");
}

TEST(CalibrateCommand, NamesThePairsThatItLeavesOut) {
  const TemporaryFolder folder;
  write_pairs(folder);
  write_image(folder / "right_3.png", Image<Rgb8>(400, 300, {90, 90, 90}));
  const ProgramResult result =
      run_program({"calibrate", ".", "--board", "7x5", "--square", "20mm", "--quiet"}, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("right_3.png: left out: no board found in the right picture"));
  EXPECT_TRUE(std::filesystem::exists(folder / "calibration.yml"));
}

TEST(CalibrateCommand, RefusesWhatItCannotUse) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "empty");
  expect_refused(folder, {"calibrate", "empty"}, 3, "empty: holds no pairs of pictures");
  expect_refused(folder, {"calibrate", "missing"}, 3, "missing: cannot be read");
  expect_refused(folder, {"calibrate"}, 2, "needs a folder");
  expect_refused(folder, {"calibrate", "empty", "--board", "11by7"}, 2, "--board");
  expect_refused(folder, {"calibrate", "empty", "--square", "3 feet"}, 2, "--square");
  expect_refused(folder, {"calibrate", "--left", "a.png", "b.png", "--right", "c.png"}, 2, "expected as many");
  std::filesystem::create_directory(folder / "blank");
  for (const char* name : {"blank/left_1.png", "blank/right_1.png"}) write_image(folder / name, Image<Rgb8>(64, 48));
  expect_refused(folder, {"calibrate", "blank", "--quiet"}, 3,
                 "no checkerboard of 11x7 inner corners found in any of 1");
  std::filesystem::remove(folder / "blank/right_1.png");
  expect_refused(folder, {"calibrate", "blank", "--quiet"}, 3, "left_1.png: has no partner");
}

}  // namespace wheatstone::calibrate_test
