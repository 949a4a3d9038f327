#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "wheatstone/motion/flow_file.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::synth_film_test {

TEST(SynthFilmCommand, WritesFramesWithTheirTruth) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"synth", "film", "-o", "film", "--size", "96x54", "--frames", "4", "--cut",
                                            "3", "--samples", "1", "--noise", "2", "--motion", "pan", "--json"},
                                           {.folder = folder / "."});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(nlohmann::json::parse(result.output)["cut"], 3);
  EXPECT_EQ(files_in(folder / "film").size(), 40u);
  EXPECT_EQ(read_image(folder / "film/right_0003.png").width(), 96);
  EXPECT_GT(read_disparity(folder / "film/left_disparity_0001.pfm")(48, 50), 0);
  EXPECT_FALSE(std::isnan(read_flow(folder / "film/flow_forward_0001.flo").x(48, 27)));
  EXPECT_TRUE(std::isnan(read_flow(folder / "film/flow_forward_0002.flo").x(48, 27)));
  EXPECT_TRUE(std::isnan(read_flow(folder / "film/flow_backward_0003.flo").x(48, 27)));
  EXPECT_EQ(read_image(folder / "film/flow_forward_occlusion_0002.png")(48, 27), (Rgb8{255, 255, 255}));
}

TEST(SynthFilmCommand, MakesScenesByName) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"synth", "film", "-o", "film", "--size", "64x36", "--frames", "2",
                                            "--samples", "1", "--scene", "still", "--noise", "0", "--json"},
                                           {.folder = folder / "."});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto facts = nlohmann::json::parse(result.output);
  EXPECT_EQ(facts["scene"], "still");
  EXPECT_EQ(facts["cut"], 0);
  EXPECT_EQ(read_image(folder / "film/left_0000.png"), read_image(folder / "film/left_0001.png"));
}

TEST(SynthFilmCommand, RefusesNonsenseAndLeavesNothing) {
  const TemporaryFolder folder;
  expect_refused(folder, {"synth", "film", "-o", "film", "--frames", "4", "--cut", "4"}, 2, "cut at frame 4");
  expect_refused(folder, {"synth", "film", "-o", "film", "--size", "96"}, 2, "--size: is '96', expected WIDTHxHEIGHT");
  expect_refused(folder, {"synth", "film", "-o", "film", "--motion", "run"}, 2, "run");
  expect_refused(folder, {"synth", "film", "-o", "film", "--frames", "0"}, 2, "0");
  expect_refused(folder, {"synth", "film", "-o", "film", "--scene", "beach"}, 2, "still-life|beams|still|crowd");
  expect_refused(folder, {"synth", "film", "-o", "film", "--scene", "crowd", "--motion", "pan"}, 2,
                 "--motion: has no effect on the scene 'crowd'; it is the motion of the still life");
}

}  // namespace wheatstone::synth_film_test
