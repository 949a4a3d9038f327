// StrokePainting from the command line: what works on unusual pictures, and what is refused with one line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <OpenImageIO/imageio.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::paint_test {

constexpr int width = 96, height = 64, shift = 6;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// A texture that matches at one place only.
std::uint8_t level(int x, int y) {
  return static_cast<std::uint8_t>((x * x * 7 + y * y * 3 + x * y * 11 + 40 * (x % 5)) % 251);
}

/// Writes a pair with a disparity of six pixels and its map.
void write_pair(const TemporaryFolder& folder) {
  Image<Rgb8> left(width, height), right(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      left(x, y) = {level(x, y), level(x + 9, y), level(x, y + 5)};
      right(x, y) = {level(x + shift, y), level(x + shift + 9, y), level(x + shift, y + 5)};
    }
  }
  write_image(folder / "left.png", left);
  write_image(folder / "right.png", right);
  write_disparity(folder / "disparity.pfm", Image<float>(width, height, shift));
}

std::vector<std::string> paint_line(std::vector<std::string> more) {
  std::vector<std::string> line{"paint", "left.png", "right.png", "-o", "painted", "--quiet"};
  line.insert(line.end(), more.begin(), more.end());
  return line;
}

TEST(PaintCommand, WritesAPaintingAndItsReport) {
  const TemporaryFolder folder;
  write_pair(folder);
  const ProgramResult result = run_program(
      paint_line({"--disparity", "disparity.pfm", "--report", "--html", "--svg", "--json"}), {.folder = folder / ""});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto report = nlohmann::json::parse(result.output);
  EXPECT_EQ(report["width"], width);
  EXPECT_EQ(report["zero_parallax_px"], shift);
  EXPECT_LT(report["measures"]["painting"]["left_right_mean_absolute"], 10);
  EXPECT_THAT(files_in(folder / "painted"),
              testing::IsSupersetOf({"left.png", "right.png", "side_by_side.png", "anaglyph.png", "painting.wst",
                                     "left.svg", "right.svg", "disparity.png", "left_disparity.png",
                                     "left_occlusion.png", "report.json", "index.html"}));
}

TEST(PaintCommand, PaintsWithOtherMarksThanStrokes) {
  const TemporaryFolder folder;
  write_pair(folder);
  for (const std::string style : {"posterise", "mosaic", "diffusion"}) {
    const ProgramResult result = run_program(
        paint_line({"--disparity", "disparity.pfm", "--style", style, "--svg", "--json"}), {.folder = folder / ""});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto report = nlohmann::json::parse(result.output);
    EXPECT_GT(report[style == "diffusion" ? "lines" : "regions"], 1);
    EXPECT_LT(report["right_bare_share"], 0.005);
    const auto files = files_in(folder / "painted");
    EXPECT_THAT(files, testing::IsSupersetOf({"left.png", "right.png", "side_by_side.png", "anaglyph.png",
                                              "painting.wst", "left.svg", "right.svg", "report.json"}));
    ASSERT_EQ(run_program({"paint", "painted/painting.wst", "-o", "again"}, {.folder = folder / ""}).exit_code, 0);
    for (const std::string picture : {"/left.png", "/right.png"})
      EXPECT_EQ(bytes_of(folder / ("again" + picture)), bytes_of(folder / ("painted" + picture))) << style;
  }
  expect_refused(folder, paint_line({"--style", "mosaic", "--propagation", "raster"}), 2, "raster");
  expect_refused(folder, paint_line({"--style", "mosaic", "--texture"}), 2, "texture");
  expect_refused(folder, paint_line({"--style", "posterise", "--colours", "1"}), 2, "colours is 1");
}

TEST(PaintCommand, PaintsEveryKindOfMarksForADisplayAsItsPaintingIsDrawnForOne) {
  const TemporaryFolder folder;
  write_pair(folder);
  const std::vector<std::string> display{"--display", "nine-view", "--size", "66x50", "--views", "3"};
  const auto run = [&](std::vector<std::string> line, const std::vector<std::string>& more) {
    line.insert(line.end(), more.begin(), more.end());
    const ProgramResult result = run_program(line, {.folder = folder / ""});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
  };
  for (const std::string style : {"impressionist", "dual", "posterise", "mosaic", "diffusion"}) {
    const std::string texture = style == "impressionist" ? "--texture" : "--quiet";
    const std::vector<std::string> paint{"paint", "left.png", "right.png", "--style", style, texture};
    run(paint, {"-o", style + "_marks"});
    std::vector<std::string> direct = paint, again{"paint", style + "_marks/painting.wst", "-o", style + "_again"};
    direct.insert(direct.end(), {"-o", style});
    run(direct, display);
    run(again, display);
    for (const char* view : {"view_000.png", "view_001.png", "view_002.png"}) {
      const std::string picture = bytes_of(folder / (style + "/" + view));
      EXPECT_GT(picture.size(), 1000u) << style;
      EXPECT_EQ(bytes_of(folder / (style + "_again/" + view)), picture) << style << ' ' << view;
    }
  }
}

/// A pair and deep.pfm, with something near before what is far.
void write_deep_pair(const TemporaryFolder& folder, float far = 4, float near = 4 + 0.12f * width) {
  write_pair(folder);
  Image<float> disparity(width, height, far);
  for (int y = height / 4; y < height / 2; ++y)
    for (int x = width / 4; x < width / 2; ++x) disparity(x, y) = near;
  write_disparity(folder / "deep.pfm", disparity);
}

TEST(PaintCommand, IsComfortableToLookAtUnlessAllDepthIsWanted) {
  const TemporaryFolder folder;
  write_deep_pair(folder);
  const auto separation = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--disparity", "deep.pfm", "--json"});
    const ProgramResult result = run_program(paint_line(more), {.folder = folder / ""});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return nlohmann::json::parse(result.output)["presented_separation"].get<double>();
  };
  EXPECT_NEAR(separation({}), 0.25, 0.01);
  EXPECT_NEAR(separation({"--depth-budget", "6%"}), 0.5, 0.01);
  const std::string left = bytes_of(folder / "painted/left.png"), near = bytes_of(folder / "painted/anaglyph.png");
  EXPECT_EQ(separation({"--depth-budget", "full"}), 1);
  EXPECT_EQ(bytes_of(folder / "painted/left.png"), left);
  EXPECT_NE(bytes_of(folder / "painted/anaglyph.png"), near);
  expect_refused(folder, paint_line({"--depth-budget", "much"}), 2, "--depth-budget");
}

TEST(PaintCommand, TellsHowMuchDepthIsLeftAndWhatIsUnpainted) {
  const TemporaryFolder folder;
  write_deep_pair(folder);
  const auto told = [&](const std::string& budget) {
    const ProgramResult result =
        run_program(paint_line({"--disparity", "deep.pfm", "--depth-budget", budget}), {.folder = folder / ""});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return result.output;
  };
  const std::string quarter = told("3%");
  EXPECT_THAT(quarter, testing::HasSubstr("\ndepth            reduced to 25 % in side_by_side and anaglyph, to stay "
                                          "comfortable (3 % of width); --depth-budget full keeps it\n"));
  EXPECT_THAT(quarter, testing::ContainsRegex("\nunpainted        [0-9.]+ % .left., [0-9.]+ % .right.\n"));
  EXPECT_THAT(told("6%"), testing::HasSubstr("\ndepth            halved in side_by_side and anaglyph, to stay "
                                             "comfortable (6 % of width)"));
  EXPECT_THAT(told("full"), testing::Not(testing::HasSubstr("depth  ")));
}

TEST(PaintCommand, PlacesDepthWhereItsMappingHasIt) {
  const TemporaryFolder folder;
  write_deep_pair(folder, 2, 10);
  const auto run = [&](const std::vector<std::string>& line) {
    const ProgramResult result = run_program(line, {.folder = folder / ""});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
  };
  const std::vector<std::string> mapping{"--depth-mapping", "0:-40,1:60", "--distance", "600"};
  const auto with_mapping = [&](std::vector<std::string> line) {
    line.insert(line.end(), mapping.begin(), mapping.end());
    return line;
  };
  run({"paint", "left.png", "right.png", "--disparity", "deep.pfm", "-o", "plain"});
  run(with_mapping({"paint", "left.png", "right.png", "--disparity", "deep.pfm", "-o", "placed"}));
  run(with_mapping({"paint", "plain/painting.wst", "-o", "again"}));
  const ViewingGeometry viewing{.viewing_distance_mm = 600, .width_px = width};
  const DepthEnds ends = depth_ends(read_painting(folder / "placed/painting.wst").surfaces.seen.front().disparity);
  const float pitch_mm = viewing.pixel_pitch_mm(), step_px = 1 / disparity_steps;
  EXPECT_NEAR(ends.nearest_px, -screen_parallax_mm(viewing, -40) / pitch_mm, step_px);
  EXPECT_NEAR(ends.farthest_px, -screen_parallax_mm(viewing, 60) / pitch_mm, step_px);
  EXPECT_EQ(bytes_of(folder / "again/side_by_side.png"), bytes_of(folder / "placed/side_by_side.png"));
  EXPECT_NE(bytes_of(folder / "again/side_by_side.png"), bytes_of(folder / "plain/side_by_side.png"));
  expect_refused(folder, paint_line({"--depth-mapping", "0:-900,1:60"}), 2, "behind the viewer");
  expect_refused(folder, paint_line({"--depth-mapping", "0:0,1:60", "--depth-budget", "2%"}), 2, "--depth-budget");
}

TEST(PaintCommand, SaysTheSameForTheSameSeedOnAnyNumberOfThreads) {
  const TemporaryFolder folder;
  write_pair(folder);
  std::string first;
  for (const std::string threads : {"1", "3"}) {
    ASSERT_EQ(run_program(paint_line({"--seed", "7", "--threads", threads}), {.folder = folder / ""}).exit_code, 0);
    const std::string bytes = bytes_of(folder / "painted/painting.wst");
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first);
  }
}

TEST(PaintCommand, TakesItsStyleFromAFileThatItPrinted) {
  const TemporaryFolder folder;
  write_pair(folder);
  const ProgramResult printed = run_program({"paint", "--print-style", "pointillist"}, {.folder = folder / ""});
  ASSERT_EQ(printed.exit_code, 0);
  put_bytes(folder / "mine.toml", printed.output);
  EXPECT_EQ(run_program(paint_line({"--style", "mine.toml"}), {.folder = folder / ""}).exit_code, 0);
  EXPECT_EQ(layers_of(read_painting(folder / "painted/painting.wst")).size(), 2u);
}

TEST(PaintCommand, DrawsAPaintingAgain) {
  const TemporaryFolder folder;
  write_pair(folder);
  ASSERT_EQ(run_program(paint_line({}), {.folder = folder / ""}).exit_code, 0);
  const ProgramResult again =
      run_program({"paint", "painted/painting.wst", "--scale", "2", "-o", "again"}, {.folder = folder / ""});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_THAT(files_in(folder / "again"), testing::Contains("anaglyph.png"));
}

/// Writes a grey ramp as a picture of any layout of channels and type.
void write_plain(const std::string& path, int channels, OIIO::TypeDesc type, int orientation = 1) {
  OIIO::ImageSpec spec(width, height, channels, type);
  if (channels == 4) spec.alpha_channel = 3;
  spec["Orientation"] = orientation;
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) pixels.push_back(c == 3 ? 1.f : static_cast<float>(level(x, y)) / 255);
  const auto output = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(output->open(path, spec)) << path;
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data())) << path;
  ASSERT_TRUE(output->close());
}

TEST(PaintCommand, TakesGreyDeepTransparentAndTurnedPictures) {
  const TemporaryFolder folder;
  write_plain(folder / "grey.png", 1, OIIO::TypeDesc::UINT8);
  write_plain(folder / "deep.png", 3, OIIO::TypeDesc::UINT16);
  write_plain(folder / "transparent.png", 4, OIIO::TypeDesc::UINT8);
  write_plain(folder / "turned.jpg", 3, OIIO::TypeDesc::UINT8, 6);
  for (const std::string name : {"grey.png", "deep.png", "transparent.png", "turned.jpg"}) {
    const ProgramResult result =
        run_program({"paint", name, name, "-o", "painted", "--quiet", "--range", "-4:8"}, {.folder = folder / ""});
    EXPECT_EQ(result.exit_code, 0) << name << ": " << result.errors;
  }
}

TEST(PaintCommand, CountsADualStrokeOnceInSummaryReportAndInfo) {
  const TemporaryFolder folder;
  write_pair(folder);
  const ProgramResult painted = run_program(paint_line({"--style", "dual", "--report"}), {.folder = folder / ""});
  ASSERT_EQ(painted.exit_code, 0) << painted.errors;
  const auto report = nlohmann::json::parse(std::ifstream(folder / "painted/report.json"));
  const auto info = nlohmann::json::parse(run_program({"info", folder / "painted/painting.wst", "--json"}).output);
  const auto count = report["strokes"].get<std::size_t>();
  EXPECT_THAT(painted.output, testing::HasSubstr(std::to_string(count) + " strokes in"));
  EXPECT_EQ(info["strokes"], count);
  EXPECT_EQ(report["measures"]["strokes"]["strokes"], count);
  std::size_t in_layers = 0, parts_and_strokes = 0;
  for (std::size_t i = 0; i < report["layers"].size(); ++i) {
    EXPECT_EQ(report["layers"][i]["strokes"], info["layers"][i]["strokes"]);
    in_layers += report["layers"][i]["strokes"].get<std::size_t>();
  }
  EXPECT_EQ(in_layers, count);
  const Painting painting = read_painting(folder / "painted/painting.wst");
  for (const Layer& layer : layers_of(painting)) parts_and_strokes += layer.strokes.size();
  EXPECT_GT(parts_and_strokes, count * 5 / 4);
}

TEST(PaintCommand, RefusesDisparityThatCannotBePaintedFrom) {
  const TemporaryFolder folder;
  write_pair(folder);
  write_disparity(folder / "small.pfm", Image<float>(10, 10, 3));
  write_disparity(folder / "nothing.pfm", Image<float>(width, height, unknown));
  expect_refused(folder, paint_line({"--disparity", "small.pfm"}), 3, "10x10");
  expect_refused(folder, paint_line({"--disparity", "nothing.pfm"}), 3,
                 "nothing.pfm: the disparity is unknown everywhere");
  expect_refused(folder, paint_line({"--disparity", "disparity.pfm", "--right-disparity", "small.pfm"}), 3, "10x10");
}

TEST(PaintCommand, TakesDisparityWithUnknownAndInfinitePixels) {
  const TemporaryFolder folder;
  write_pair(folder);
  Image<float> disparity(width, height, shift);
  for (int x = 10; x < 60; ++x) disparity(x, 20) = unknown;
  for (int x = 10; x < 60; ++x) disparity(x, 21) = std::numeric_limits<float>::infinity();
  write_disparity(folder / "holes.pfm", disparity);
  EXPECT_EQ(run_program(paint_line({"--disparity", "holes.pfm"}), {.folder = folder / ""}).exit_code, 0);
}

TEST(PaintCommand, RefusesParametersThatMakeNoSense) {
  const TemporaryFolder folder;
  write_pair(folder);
  expect_refused(folder, paint_line({"--radii", "-3"}), 2, "radius is -3");
  expect_refused(folder, paint_line({"--style", "impressionist", "--threshold", "0"}), 2, "threshold is 0");
  expect_refused(folder, paint_line({"--style", "cubist"}), 2, "impressionist");
  expect_refused(folder, paint_line({"--disparity", "disparity.pfm", "--range", "0:10"}), 2,
                 "--range: has no effect with --disparity");
  expect_refused(folder, paint_line({"--right-disparity", "disparity.pfm"}), 2, "--disparity");
  expect_refused(folder, paint_line({"--zero-parallax", "3", "--zero-parallax-at", "3,4"}), 2, "excludes");
  expect_refused(folder, paint_line({"--zero-parallax-at", "3000,4"}), 2, "3000,4");
  expect_refused(folder, paint_line({"--range", "30:10"}), 2, "30:10");
  expect_refused(folder, {"paint"}, 2, "no photographs");
}

TEST(PaintCommand, RefusesADamagedPainting) {
  const TemporaryFolder folder;
  write_pair(folder);
  ASSERT_EQ(run_program(paint_line({}), {.folder = folder / ""}).exit_code, 0);
  const std::string bytes = bytes_of(folder / "painted/painting.wst");
  put_bytes(folder / "cut.wst", bytes.substr(0, bytes.size() / 2));
  std::string flipped = bytes;
  flipped[bytes.size() / 2] = static_cast<char>(flipped[bytes.size() / 2] ^ 0x40);
  put_bytes(folder / "flipped.wst", flipped);
  for (const std::string name : {"cut.wst", "flipped.wst"})
    expect_refused(folder, {"paint", name, "-o", "again"}, 3, name + ": ");
}

TEST(PaintCommand, LeavesNothingOnAFullDisk) {
  const TemporaryFolder folder;
  write_pair(folder);
  const auto before = files_in(folder / "");
  const ProgramResult result = run_program(paint_line({}), {.folder = folder / "", .largest_file = 4000});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_EQ(files_in(folder / ""), before);
}

}  // namespace wheatstone::paint_test
