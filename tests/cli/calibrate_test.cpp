// A rig calibrated from the command line, from boards rendered by the test.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {
namespace {

using testing::HasSubstr;

/// A board of 7×5 inner corners, 20 mm apart, tilted about both axes before a camera that stands `camera_mm` to the
/// right and sees through a lens without distortion; three rays a side of every pixel.
Image<Rgb8> board_picture(double tilt_x, double tilt_y, double camera_mm) {
  constexpr int width = 400, height = 300, finer = 3;
  constexpr double focal = 420, distance_mm = 330;
  const std::array<double, 3> across{std::cos(tilt_y), 0, -std::sin(tilt_y)};
  const std::array<double, 3> down{std::sin(tilt_x) * std::sin(tilt_y), std::cos(tilt_x),
                                   std::sin(tilt_x) * std::cos(tilt_y)};
  const std::array<double, 3> normal{across[1] * down[2] - across[2] * down[1],
                                     across[2] * down[0] - across[0] * down[2],
                                     across[0] * down[1] - across[1] * down[0]};
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int ray = 0; ray < finer * finer; ++ray) {
        const double rx = (x + (ray % finer + 0.5) / finer - width / 2.0) / focal;
        const double ry = (y + (ray / finer + 0.5) / finer - height / 2.0) / focal;
        const double along =
            (-camera_mm * normal[0] + distance_mm * normal[2]) / (rx * normal[0] + ry * normal[1] + normal[2]);
        const double px = camera_mm + along * rx, py = along * ry, pz = along - distance_mm;
        const double u = (px * across[0] + py * across[1] + pz * across[2]) / 20 + 4;
        const double v = (px * down[0] + py * down[1] + pz * down[2]) / 20 + 3;
        const bool board = u > 0 && v > 0 && u < 8 && v < 6;
        sum += !board ? 230 : (static_cast<int>(u) + static_cast<int>(v)) % 2 == 0 ? 25 : 230;
      }
      const auto grey = static_cast<std::uint8_t>(std::lround(sum / (finer * finer)));
      picture(x, y) = {grey, grey, grey};
    }
  }
  return picture;
}

constexpr std::array<std::array<double, 2>, 6> tilts{
    {{0.5, 0}, {-0.5, 0.1}, {0.1, 0.5}, {0, -0.5}, {0.35, 0.35}, {-0.3, -0.4}}};

void write_pairs(const TemporaryFolder& folder) {
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    const std::string rest = std::to_string(i) + ".png";
    write_image(folder / ("left_" + rest), board_picture(tilts[i][0], tilts[i][1], -30));
    write_image(folder / ("right_" + rest), board_picture(tilts[i][0], tilts[i][1], 30));
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
  EXPECT_EQ(facts["pairs"].size(), tilts.size());

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

}  // namespace
}  // namespace wheatstone
