#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "temporary_folder.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/app/write_results.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::app_test {

namespace fs = std::filesystem;

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still({.width = 240, .height = 180, .samples_a_side = 1});
  return made;
}

TEST(PaintPhotograph, WritesEverythingThatItPromises) {
  const TemporaryFolder folder;
  PaintPhotographOptions options;
  options.left_disparity = still().geometry.left_disparity;
  const PaintedPhotograph result = paint_photograph(still().pictures, options);
  const PaintingMeasures measures = measure_painting(still().pictures, result, still().geometry.left_disparity);
  OutputFolder output(folder / "out");
  const auto names =
      write_results(output, still().pictures, {result, options.style, nullptr, &measures}, {.html = true});
  EXPECT_EQ(names, result_names({.html = true}));
  for (const std::string& name : names) EXPECT_TRUE(fs::exists(folder / ("out/" + name))) << name;
  EXPECT_EQ(read_image(folder / "out/left.png"), result.painted.pictures.left);
  EXPECT_EQ(read_painting(folder / "out/painting.wst"), result.painted.painting);
  const auto report = nlohmann::json::parse(read_whole_file(folder / "out/report.json", 1 << 20));
  EXPECT_EQ(report["width"], 240);
  EXPECT_LT(report["measures"]["painting"]["left_right_rmse"], 0.1);
  const std::string page = read_whole_file(folder / "out/index.html", 1 << 20);
  EXPECT_THAT(page, testing::HasSubstr("anaglyph.png"));
  EXPECT_THAT(page, testing::Not(testing::HasSubstr("src=\".png\"")));
}

TEST(PaintPhotograph, PutsTheChosenPointOnTheScreen) {
  PaintPhotographOptions options;
  options.left_disparity = still().geometry.left_disparity;
  options.zero_parallax.disparity_px = 7.5f;
  EXPECT_EQ(paint_photograph(still().pictures, options).zero_parallax_px, 7.5f);
  options.zero_parallax = {.disparity_px = {}, .at = std::pair{100, 90}};
  EXPECT_EQ(paint_photograph(still().pictures, options).zero_parallax_px, still().geometry.left_disparity(100, 90));
  options.zero_parallax.at = std::pair{1000, 90};
  EXPECT_THROW(paint_photograph(still().pictures, options), Error);
}

TEST(PaintPhotograph, RefusesDisparityThatDoesNotFit) {
  PaintPhotographOptions options;
  options.left_disparity = Image<float>(10, 10, 1);
  EXPECT_THROW(paint_photograph(still().pictures, options), Error);
  options.left_disparity = Image<float>(240, 180, std::numeric_limits<float>::quiet_NaN());
  EXPECT_THROW(paint_photograph(still().pictures, options), Error);
}

TEST(Redraw, KeepsThePaintingWhenItIsMadeLarger) {
  PaintPhotographOptions options;
  options.left_disparity = still().geometry.left_disparity;
  options.style.background = Background::colour;
  const PaintedPhotograph result = paint_photograph(still().pictures, options);
  const Painting large = scaled(result.painted.painting, 2);
  const Image<Rgb8> small_picture = result.painted.pictures.right, large_picture = draw(large, right_eye).picture;
  ASSERT_EQ(large_picture.width(), 480);
  double difference = 0;
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 240; ++x) difference += std::abs(small_picture(x, y).g - large_picture(2 * x, 2 * y).g);
  EXPECT_LT(difference / (240 * 180), 8);
  EXPECT_THROW(scaled(result.painted.painting, 1000), Error);
}

TEST(Redraw, MakesTheSamePicturesOfAPaintingFileInEveryStyle) {
  const TemporaryFolder folder;
  const SyntheticStill small = make_synthetic_still({.width = 80, .height = 60, .samples_a_side = 1});
  PaintPhotographOptions options;
  options.left_disparity = small.geometry.left_disparity;
  for (const std::string_view name : style_names()) {
    options.style = style_by_name(name);
    options.style.background = Background::colour;
    options.style.texture = is_of_strokes(options.style);
    const PaintedPhotograph result = paint_photograph(small.pictures, options);
    OutputFolder output(folder / "out");
    write_results(output, small.pictures, {result, options.style}, {.svg = true});
    OutputFolder again(folder / "again");
    draw_again(read_painting(folder / "out/painting.wst"), again, {.svg = true});
    for (const std::string file : {"left.png", "right.png", "left.svg"})
      EXPECT_EQ(bytes_of(folder / ("again/" + file)), bytes_of(folder / ("out/" + file))) << name << " " << file;
  }
}

TEST(Redraw, WritesBothEyes) {
  const TemporaryFolder folder;
  PaintPhotographOptions options;
  options.left_disparity = still().geometry.left_disparity;
  OutputFolder again(folder / "again");
  draw_again(paint_photograph(still().pictures, options).painted.painting, again, {.scale = 0.5});
  EXPECT_EQ(read_image(folder / "again/left.png").width(), 120);
  EXPECT_TRUE(fs::exists(folder / "again/anaglyph.png"));
  EXPECT_FALSE(fs::exists(folder / "again/left.svg")) << "only where it is asked for";
}

}  // namespace wheatstone::app_test
