#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::measure_views_test {

using testing::HasSubstr;

/// A black picture with a spot of 3×3 pixels around (40, 30).
Image<Rgb8> spot_at(int x) {
  Image<Rgb8> picture(80, 60);
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) picture(x + dx, 30 + dy) = {200, 180, 160};
  return picture;
}

/// Two views and their references: the first equal, the second with its spot moved by two pixels.
void write_views(const TemporaryFolder& folder) {
  std::filesystem::create_directories(folder / "made");
  std::filesystem::create_directories(folder / "truth");
  write_image(folder / "made/view_000.png", spot_at(40));
  write_image(folder / "made/view_001.png", spot_at(42));
  write_image(folder / "truth/view_000.png", spot_at(40));
  write_image(folder / "truth/view_001.png", spot_at(40));
}

ProgramResult run_in(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  ProgramResult result = run_program(arguments, {.folder = folder / "."});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return result;
}

TEST(MeasureViewsCommand, MeasuresEachViewAndTellsTheWorst) {
  const TemporaryFolder folder;
  write_views(folder);
  const auto facts =
      nlohmann::json::parse(run_in(folder, {"measure", "views", "made", "--against", "truth", "--json"}).output);
  ASSERT_EQ(facts["views"].size(), 2u);
  EXPECT_EQ(facts["views"][0]["view"], "view_000.png");
  EXPECT_EQ(facts["views"][0]["equal"], true);
  EXPECT_FALSE(facts["views"][0].contains("psnr_db"));
  EXPECT_EQ(facts["views"][1]["equal"], false);
  EXPECT_EQ(facts["views"][1]["isolated_splats"], 1);
  EXPECT_EQ(facts["views"][1]["differing_pixels"], 12);
  EXPECT_NEAR(facts["views"][1]["largest_position_error_px"].get<double>(), 2, 0.01);
  EXPECT_EQ(facts["worst"]["psnr_db"], facts["views"][1]["psnr_db"]);
  EXPECT_EQ(facts["worst"]["differing_pixels"], 12);
  EXPECT_EQ(facts["worst"]["equal"], false);
}

TEST(MeasureViewsCommand, TakesFilesAsWellAsFolders) {
  const TemporaryFolder folder;
  write_views(folder);
  const ProgramResult files = run_in(folder, {"measure", "views", "made/view_000.png", "made/view_001.png", "--against",
                                              "truth/view_000.png", "truth/view_001.png"});
  EXPECT_EQ(files.output, run_in(folder, {"measure", "views", "made", "--against", "truth"}).output);
  EXPECT_THAT(files.output, HasSubstr("equal"));
  EXPECT_THAT(files.output, HasSubstr("\nworst "));
  EXPECT_THAT(files.output, HasSubstr("2.00\n"));
}

TEST(MeasureViewsCommand, CountsWhatIsNoticeable) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", Image<Rgb8>(8, 8, {100, 100, 100}));
  write_image(folder / "b.png", Image<Rgb8>(8, 8, {100, 103, 100}));
  const auto differing = [&](const std::string& noticeable) {
    const ProgramResult result =
        run_in(folder, {"measure", "views", "a.png", "--against", "b.png", "--noticeable", noticeable, "--json"});
    return nlohmann::json::parse(result.output)["worst"]["differing_pixels"];
  };
  EXPECT_EQ(differing("3"), 0);
  EXPECT_EQ(differing("2"), 64);
}

TEST(MeasureViewsCommand, RefusesWhatDoesNotBelongTogether) {
  const TemporaryFolder folder;
  write_views(folder);
  std::filesystem::create_directories(folder / "empty");
  write_image(folder / "small.png", Image<Rgb8>(8, 8));
  expect_refused(folder, {"measure", "views", "made/view_000.png", "--against", "truth"}, 2,
                 "1 views against 2, expected as many");
  expect_refused(folder, {"measure", "views", "small.png", "--quiet", "--against", "truth/view_000.png"}, 3,
                 "small.png: is 8x8 pixels, expected 80x60 as truth/view_000.png");
  expect_refused(folder, {"measure", "views", "made", "--against", "empty"}, 3, "empty: has no pictures");
  expect_refused(folder, {"measure", "views", "nowhere.png", "--quiet", "--against", "small.png"}, 3,
                 "nowhere.png: no such file");
  expect_refused(folder, {"measure", "views", "made"}, 2, "--against is required");
  expect_refused(folder, {"measure", "views", "made", "--against", "truth", "--noticeable", "256"}, 2, "256");
}

}  // namespace wheatstone::measure_views_test
