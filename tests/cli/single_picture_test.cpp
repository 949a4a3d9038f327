// One picture and its depth from the command line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "scenes/tiny_network.h"
#include "scenes/xmp_pictures.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::single_picture_test {

constexpr int width = 96, height = 64;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Writes a picture, and its depth in every form.
void write_picture_and_depth(const TemporaryFolder& folder) {
  const SyntheticView view = make_synthetic_view({.width = width, .height = height, .samples_a_side = 1}, left_eye);
  write_image(folder / "photo.png", view.picture);
  write_disparity(folder / "depth.png", view.disparity);
  write_disparity(folder / "depth.pfm", view.disparity);
  write_disparity(folder / "depth.exr", view.disparity);
  Image<float> metres = view.disparity;
  for (float& value : metres.pixels()) value = 100 / value;
  write_disparity(folder / "metres.exr", metres);
}

std::vector<std::string> paint_line(std::vector<std::string> more) {
  std::vector<std::string> line{"paint", "photo.png", "-o", "painted", "--quiet"};
  line.insert(line.end(), more.begin(), more.end());
  return line;
}

TEST(PaintSinglePicture, TakesDepthOfAnyKindAndMakesTheSamePair) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  const std::vector<std::vector<std::string>> kinds{{"--depth", "depth.pfm"},
                                                    {"--depth", "depth.exr", "--depth-is", "inverse"},
                                                    {"--depth", "depth.png", "--strength", "0.03"},
                                                    {"--depth", "metres.exr", "--depth-is", "metric"}};
  Image<float> first;
  for (const auto& kind : kinds) {
    const ProgramResult result = run_program(paint_line(kind), {.folder = folder / ""});
    ASSERT_EQ(result.exit_code, 0) << kind[1] << result.errors;
    EXPECT_EQ(read_image(folder / "painted/left_photograph.png"), read_image(folder / "photo.png"));
    const Image<float> disparity = read_disparity(folder / "painted/left_disparity.pfm");
    EXPECT_NEAR(std::ranges::max(disparity.pixels()), 0.03f * width, 1e-4);
    EXPECT_NEAR(std::ranges::min(disparity.pixels()), 0, 1e-4);
    if (first.empty()) first = disparity;
    for (std::size_t i = 0; i < first.pixels().size(); ++i)
      ASSERT_NEAR(disparity.pixels()[i], first.pixels()[i], 0.01) << kind[1];
  }
  EXPECT_THAT(files_in(folder / "painted"),
              testing::IsSupersetOf({"left.png", "right.png", "anaglyph.png", "right_photograph.png", "painting.wst"}));
}

TEST(PaintSinglePicture, MovesNearThingsByTheStrength) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  const ProgramResult result = run_program(
      paint_line({"--depth", "depth.pfm", "--strength", "10%", "--zero-parallax", "4", "--json", "--report"}),
      {.folder = folder / ""});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto report = nlohmann::json::parse(result.output);
  EXPECT_EQ(report["zero_parallax_px"], 4);
  EXPECT_LT(report["measures"]["painting"]["left_right_mean_absolute"], 10);
  EXPECT_NEAR(std::ranges::max(read_disparity(folder / "painted/left_disparity.pfm").pixels()), 9.6, 1e-3);
}

TEST(PaintSinglePicture, HasEveryStyleAndDisplay) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  for (const std::string style : {"mosaic", "diffusion", "posterise"})
    EXPECT_EQ(run_program(paint_line({"--depth", "depth.pfm", "--style", style}), {.folder = folder / ""}).exit_code, 0)
        << style;
  const ProgramResult views =
      run_program({"paint", "photo.png", "--depth", "depth.pfm", "--display", "looking-glass-portrait", "--size",
                   "36x48", "-o", "views", "--quiet", "--json"},
                  {.folder = folder / ""});
  ASSERT_EQ(views.exit_code, 0) << views.errors;
  const auto facts = nlohmann::json::parse(views.output);
  EXPECT_EQ(facts["views"], 48);
  EXPECT_NEAR(facts["depth"]["strength"], 0.03, 1e-6);
  EXPECT_EQ(read_image(folder / facts["output"].get<std::string>()).width(), 8 * 36);
}

TEST(PaintSinglePicture, ReducesThePictureAndFitsTheDepthToIt) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  const ProgramResult result =
      run_program(paint_line({"--depth", "depth.pfm", "--max-size", "48", "--json"}), {.folder = folder / ""});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto report = nlohmann::json::parse(result.output);
  EXPECT_EQ(report["width"], 48);
  EXPECT_EQ(report["reduced_from"]["width"], width);
}

TEST(PaintSinglePicture, UsesTheDepthThatItsFileHas) {
  const TemporaryFolder folder;
  const SyntheticView view = make_synthetic_view({.width = width, .height = height, .samples_a_side = 1}, left_eye);
  const float nearest = std::ranges::max(view.disparity.pixels());
  Image<Rgb8> map(width, height), both(2 * width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto level = static_cast<std::uint8_t>(255 * view.disparity(x, y) / nearest);
      map(x, y) = Rgb8{static_cast<std::uint8_t>(255 - level), static_cast<std::uint8_t>(255 - level),
                       static_cast<std::uint8_t>(255 - level)};
      both(x, y) = view.picture(x, y);
      both(x + width, y) = Rgb8{level, level, level};
    }
  put_bytes(folder / "portrait.jpg", with_extended_data(encode_jpeg(view.picture, 95), "GDepth:Format=\"RangeInverse\"",
                                                        "GDepth:Data", encode_jpeg(map, 95)));
  write_image(folder / "rgbd.png", both);
  for (const std::vector<std::string>& line :
       {std::vector<std::string>{"paint", "portrait.jpg", "--strength", "5%", "-o", "painted"},
        {"paint", "rgbd.png", "--layout", "rgbd", "--strength", "5%", "-o", "painted"}}) {
    const ProgramResult result = run_program(line, {.folder = folder / ""});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.errors, testing::HasSubstr(line[1] + ": one picture, with the depth of "));
    const Image<float> disparity = read_disparity(folder / "painted/left_disparity.pfm");
    EXPECT_EQ(disparity.width(), width);
    EXPECT_NEAR(std::ranges::max(disparity.pixels()), 0.05 * width, 1e-3);
    // The flowers at the top are nearer than the wall beside them, and the table's edge nearer than both.
    EXPECT_GT(disparity(width / 2, height - 2), disparity(width - 4, 4) + 1);
  }
  expect_refused(folder, {"paint", "portrait.jpg", "--quality", "fast"}, 2, "on a picture that has its own depth");
  expect_refused(folder, {"paint", "portrait.jpg", "--depth-is", "metric"}, 2, "--depth-is");
  expect_refused(folder, {"paint", "portrait.jpg", "--layout", "rgbd"}, 3, "in colour");
}

TEST(PaintSinglePicture, FindsTheDepthWithANetwork) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  put_bytes(folder / "red.onnx", tiny_network::red_of_one_picture(48, 32));
  const ProgramResult result = run_program(paint_line({"--depth-model", "red.onnx"}), {.folder = folder / ""});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NEAR(std::ranges::max(read_disparity(folder / "painted/left_disparity.pfm").pixels()), 0.03 * width, 1e-3);
  put_bytes(folder / "text.onnx", "no network");
  expect_refused(folder, paint_line({"--depth-model", "text.onnx"}), 3, "text.onnx: is not an ONNX network");
  expect_refused(folder, paint_line({"--depth-model", "red.onnx", "--depth", "depth.png"}), 2, "--depth");
  expect_refused(folder, paint_line({"--depth-model", "red.onnx", "--depth-is", "metric"}), 2, "--depth-is");
}

TEST(PaintSinglePicture, IsFlatWhereTheDepthIsTheSameEverywhere) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  write_disparity(folder / "flat.pfm", Image<float>(width, height, 3));
  const ProgramResult result =
      run_program({"paint", "photo.png", "--depth", "flat.pfm", "-o", "painted"}, {.folder = folder / ""});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.errors, testing::HasSubstr("flat.pfm: the depth is the same everywhere"));
  EXPECT_EQ(read_image(folder / "painted/left.png"), read_image(folder / "painted/right.png"));
}

TEST(PaintSinglePicture, WithoutDepthIsPaintedFlat) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  for (const std::string style : {"impressionist", "dual", "posterise", "mosaic", "diffusion"}) {
    const ProgramResult result = run_program(
        {"paint", "photo.png", "--style", style, "--svg", "--json", "-o", "painted"}, {.folder = folder / ""});
    ASSERT_EQ(result.exit_code, 0) << style << result.errors;
    EXPECT_THAT(result.errors, testing::HasSubstr("photo.png: one picture without depth, painted flat"));
    EXPECT_THAT(files_in(folder / "painted"),
                testing::UnorderedElementsAre("painted.png", "painted.svg", "painting.wst", "report.json"));
    EXPECT_EQ(nlohmann::json::parse(result.output)["flat"], true);
    const Image<Rgb8> painted = read_image(folder / "painted/painted.png");
    EXPECT_EQ(painted.width(), width);
    EXPECT_NE(painted, read_image(folder / "photo.png"));
  }
}

TEST(PaintSinglePicture, WithoutDepthIsPaintedAsAFrameOfAFilmOfOneEye) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  for (const char* frame : {"frame_000.png", "frame_001.png"})
    std::filesystem::copy(folder / "photo.png", folder / frame);
  ASSERT_EQ(run_program(paint_line({}), {.folder = folder / ""}).exit_code, 0);
  const ProgramResult film =
      run_program({"rotoscope", "frame_%03d.png", "-o", "film_%03d.png", "--quiet"}, {.folder = folder / ""});
  ASSERT_EQ(film.exit_code, 0) << film.errors;
  EXPECT_EQ(read_image(folder / "painted/painted.png"), read_image(folder / "film_001.png"));
}

TEST(PaintSinglePicture, ThatIsFlatIsDrawnAgainPackedSharedAndTold) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  ASSERT_EQ(run_program(paint_line({}), {.folder = folder / ""}).exit_code, 0);
  const auto run = [&](const std::vector<std::string>& line) {
    const ProgramResult result = run_program(line, {.folder = folder / ""});
    EXPECT_EQ(result.exit_code, 0) << line[0] << ": " << result.errors;
    return result.output;
  };
  run({"paint", "painted/painting.wst", "--scale", "2", "-o", "large", "--quiet"});
  EXPECT_EQ(read_image(folder / "large/painted.png").width(), 2 * width);
  EXPECT_THAT(files_in(folder / "large"), testing::ElementsAre("painted.png"));
  run({"pack", "painted/painting.wst", "--to", "sbs", "-o", "packed.png", "--quiet"});
  EXPECT_EQ(read_image(folder / "packed.png").width(), 2 * width);
  run({"share", "painted/painting.wst", "-o", "page.html", "--quiet"});
  EXPECT_THAT(run({"info", "painted/painting.wst"}), testing::HasSubstr("strokes"));
  run({"paint", "painted/painting.wst", "--display", "looking-glass-portrait", "--size", "36x48", "-o", "views",
       "--quiet"});
}

TEST(PaintSinglePicture, WithoutDepthRefusesWhatNeedsTwoViews) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  for (const std::vector<std::string>& option :
       std::vector<std::vector<std::string>>{{"--report"},
                                             {"--html"},
                                             {"--rectify", "always"},
                                             {"--zero-parallax", "3"},
                                             {"--zero-parallax-at", "3,3"},
                                             {"--depth-mapping", "0:0,1:40"},
                                             {"--display", "looking-glass-portrait"}})
    expect_refused(folder, paint_line(option), 2,
                   option[0] + (option[0] == "--rectify" ? " always" : "") +
                       ": has no effect on photo.png, one picture without depth");
  expect_refused(folder, paint_line({"--swap"}), 3, "photo.png: holds one view");
  write_image(folder / "tiny.png", Image<Rgb8>(8, 8));
  expect_refused(folder, {"paint", "tiny.png", "-o", "painted", "--quiet"}, 3, "tiny.png: is 8x8 pixels");
  EXPECT_FALSE(std::filesystem::exists(folder / "painted"));
}

TEST(PaintSinglePicture, RefusesDepthThatDoesNotFitOrIsUnknown) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  write_disparity(folder / "square.pfm", Image<float>(64, 64, 3));
  write_disparity(folder / "nothing.pfm", Image<float>(width, height, unknown));
  expect_refused(folder, paint_line({"--depth", "square.pfm"}), 3, "square.pfm: the depth is 64x64 pixels");
  expect_refused(folder, paint_line({"--depth", "nothing.pfm"}), 3, "nothing.pfm: the depth is unknown everywhere");
  expect_refused(folder, paint_line({"--depth", "none.png"}), 3, "none.png: no such file");
  expect_refused(folder, paint_line({"--depth", "photo.png"}), 3, "photo.png: is in colour");
  EXPECT_FALSE(std::filesystem::exists(folder / "painted"));
}

TEST(PaintSinglePicture, RefusesOptionsThatHaveNoEffect) {
  const TemporaryFolder folder;
  write_picture_and_depth(folder);
  expect_refused(folder, {"paint", "photo.png", "photo.png", "--depth", "depth.png"}, 2, "--disparity");
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--disparity", "depth.pfm"}, {"--layout", "left-right"}, {"--swap"}, {"--quality", "fast"}}) {
    std::vector<std::string> line = paint_line({"--depth", "depth.png"});
    line.insert(line.end(), more.begin(), more.end());
    expect_refused(folder, line, 2, more[0] + ": has no effect with --depth");
  }
  expect_refused(folder, paint_line({"--strength", "2%"}), 2, "--strength: has no effect without --depth");
  expect_refused(folder, paint_line({"--depth-is", "metric"}), 2, "--depth-is: has no effect without --depth");
  for (const std::string strength : {"0", "90%", "nan", "3x"})
    expect_refused(folder, paint_line({"--depth", "depth.png", "--strength", strength}), 2, "--strength");
  expect_refused(folder, paint_line({"--depth", "depth.png", "--depth-is", "near"}), 2, "inverse|metric");
}

}  // namespace wheatstone::single_picture_test
