#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "scenes/test_photographs.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::measure_painting_test {

using testing::HasSubstr;

/// A photograph, and a painting of it that is one flat colour.
void write_pictures(const TemporaryFolder& folder) {
  write_image(folder / "photograph.png", still_for_test(96, 72).left);
  write_image(folder / "flat.png", Image<Rgb8>(288, 216, {90, 120, 60}));
}

TEST(MeasurePaintingCommand, TellsHowMuchAPaintingKeeps) {
  const TemporaryFolder folder;
  write_pictures(folder);
  const auto facts_of = [&](const std::string& painting) {
    const ProgramResult result =
        run_program({"measure", "painting", "photograph.png", painting, "--json"}, {.folder = folder / "."});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return nlohmann::json::parse(result.output);
  };
  const auto same = facts_of("photograph.png"), flat = facts_of("flat.png");
  EXPECT_EQ(same["gms"], 1);
  EXPECT_EQ(same["lab"], 0);
  EXPECT_LT(flat["gms_detail"], 0.8);
  EXPECT_GT(flat["lab"], 10);
  EXPECT_NEAR(flat["grain"].get<double>(), 0, 1e-4);
  EXPECT_TRUE(flat.contains("faces"));
}

TEST(MeasurePaintingCommand, PrintsATable) {
  const TemporaryFolder folder;
  write_pictures(folder);
  const ProgramResult result =
      run_program({"measure", "painting", "photograph.png", "photograph.png"}, {.folder = folder / "."});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("gradient similarity (1: equal)        1.000\n"));
  EXPECT_THAT(result.output, HasSubstr("  in faces                            "));
}

TEST(MeasurePaintingCommand, RefusesAPaintingOfAnotherShape) {
  const TemporaryFolder folder;
  write_pictures(folder);
  write_image(folder / "square.png", Image<Rgb8>(72, 72));
  expect_refused(folder, {"measure", "painting", "photograph.png", "square.png"}, 3,
                 "square.png: the painting is 72x72 pixels, expected the shape of the photograph's 96x72");
  expect_refused(folder, {"measure", "painting", "photograph.png"}, 2, "PAINTING is required");
}

}  // namespace wheatstone::measure_painting_test
