// What holds of options of every command: numbers are finite and in range, none is accepted that has no effect, errors
// and results are JSON where that is asked for.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "cli/style_options.h"
#include "wheatstone/error.h"
#include "wheatstone/painting/style_parameters.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::option_test {

using Line = std::vector<std::string>;

constexpr int width = 96, height = 64, shift = 6;

/// Writes left.png, right.png, both beside each other as both.png, a film of one frame and one eye, a disparity and a
/// table of particles.
void write_inputs(const TemporaryFolder& folder) {
  const auto level = [](int x, int y) { return static_cast<std::uint8_t>((x * x * 7 + y * y * 3 + x * y * 11) % 251); };
  Image<Rgb8> left(width, height), right(width, height), both(2 * width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      left(x, y) = both(x, y) = {level(x, y), level(x + 9, y), level(x, y + 5)};
      right(x, y) = both(width + x, y) = {level(x + shift, y), level(x + shift + 9, y), level(x + shift, y + 5)};
    }
  }
  write_image(folder / "left.png", left);
  write_image(folder / "right.png", right);
  write_image(folder / "both.png", both);
  write_image(folder / "again.png", both);
  write_image(folder / "frame_0000.png", left);
  write_disparity(folder / "disparity.pfm", Image<float>(width, height, shift));
  put_bytes(folder / "points.csv", "x,y,z\n1,2,3\n4,5,6\n");
}

Line with(Line line, const Line& more) {
  line.insert(line.end(), more.begin(), more.end());
  return line;
}

const Line paint{"paint", "left.png", "right.png", "-o", "out", "--quiet"};
const Line render{"render", "points.csv", "-o", "out", "--quiet"};
const Line match{"match", "left.png", "right.png", "-o", "out", "--quiet"};

TEST(NumberOptions, RefuseWhatIsNoFiniteNumberInTheirRange) {
  struct Number {
    Line line;
    std::string option;
    std::string beyond;  ///< out of its range
  };
  const std::vector<Number> numbers{
      {paint, "--zero-parallax", "1e9"},
      {paint, "--zero-parallax-at", "1,-2"},
      {paint, "--max-size", "3"},
      {paint, "--depth-mapping", "0:-50,2:60"},
      {with(paint, {"--depth-mapping", "0:0,1:1"}), "--distance", "0"},
      {with(paint, {"--depth-mapping", "0:0,1:1"}), "--screen-width", "1e9"},
      {with(paint, {"--display", "looking-glass-go"}), "--span", "1e9"},
      {with(paint, {"--display", "looking-glass-go"}), "--views", "0"},
      {with(paint, {"--display", "looking-glass-go"}), "--size", "0x20"},
      {{"paint", "any.wst"}, "--scale", "1e9"},
      {{"share", "any.exr"}, "--max-size", "999"},
      {match, "--range", "1:1000000"},
      {match, "--block", "99"},
      {render, "--exposure", "0"},
      {render, "--coldest", "1e39"},
      {render, "--hottest", "-1e39"},
      {render, "--density-slope", "1e9"},
      {render, "--density-shift", "-1e9"},
      {render, "--opacity", "0"},
      {render, "--least-opacity", "2"},
      {render, "--zoom", "0"},
      {render, "--fov", "180"},
      {render, "--azimuth", "1e9"},
      {render, "--elevation", "91"},
      {render, "--near", "-1"},
      {render, "--far", "1e30"},
      {render, "--eye", "0"},
      {render, "--distance", "0"},
      {render, "--screen-width", "1e9"},
      {render, "--span", "-1"},
      {render, "--views", "100000"},
      {render, "--planes", "-1"},
      {render, "--splat", "2,1e9"},
      {render, "--centre", "1,2,1e39"},
      {render, "--select", "sphere:1,2,3,-4"},
      {render, "--depth-mapping", "0:-50,2:60"},
      {render, "--subsample", "0"},
      {render, "--neighbours", "1"},
      {with(render, {"--stream"}), "--chunk", "1"},
      {{"pack", "left.png", "right.png", "-o", "out.mpo"}, "--quality", "101"},
      {{"pack", "left.png", "right.png", "-o", "out.mpo"}, "--zero-parallax", "1e9"},
      {{"pack", "left.png", "right.png", "-o", "out.mpo"}, "--floating-window", "-1,2"},
      {{"pack", "left.png", "right.png", "-o", "out.gif"}, "--seconds", "0"},
      {{"pack", "left.png", "right.png", "--to", "depth", "-o", "out.pfm"}, "--depth-scale", "0"},
      {{"pack", "left.png", "right.png", "-o", "out"}, "--quilt", "0x3"},
      {{"pack", "left.png", "-o", "out"}, "--from-quilt", "3"},
      {{"depth"}, "--near", "-1"},
      {{"depth"}, "--distance", "0mm"},
      {{"depth"}, "--resolution", "0x5"},
      {{"calibrate", "."}, "--square", "-3cm"},
      {{"calibrate", "."}, "--board", "2x2"},
      {{"info", "left.png"}, "--scale", "0"},
      {{"synth", "still"}, "--view", "1e9"},
      {{"synth", "still"}, "--size", "1x1"},
      {{"synth", "still"}, "--largest-disparity", "1e9"},
      {{"synth", "still"}, "--samples", "9"},
      {{"synth", "film"}, "--noise", "256"},
      {{"synth", "universe"}, "--redshift", "-1"},
      {{"synth", "universe"}, "--box", "0"},
      {{"synth", "universe"}, "--particles", "0"},
      {{"measure", "views", "left.png", "--against", "left.png"}, "--noticeable", "256"},
      {{"depth"}, "--threads", "-1"},
      {{"depth"}, "--seed", "-1"},
  };
  const TemporaryFolder folder;
  write_inputs(folder);
  for (const Number& number : numbers)
    for (const std::string& value : {std::string("nan"), std::string("inf"), std::string("1x"), number.beyond})
      expect_refused(folder, with(number.line, {number.option, value}), 2, number.option + ": ");
}

TEST(NumberOptions, TakeUnitsOfLength) {
  const auto planes = [](const std::string& distance) {
    return nlohmann::json::parse(run_program({"depth", "--json", "--distance", distance}).output)["depth_planes"];
  };
  EXPECT_EQ(planes("75cm"), planes("750"));
  EXPECT_EQ(planes("0.75m"), planes("750mm"));
}

/// Options that a command knows and that have no effect on this line.
struct WithoutEffect {
  Line line;
  std::vector<Line> options;
};

std::vector<WithoutEffect> options_without_effect() {
  const Line pack_two{"pack", "left.png", "right.png"};
  const Line again{"paint", "some.wst", "-o", "out"};
  const Line display = with(paint, {"--display", "looking-glass-go"});
  return {
      {again,
       {{"--style", "dual"},
        {"--threshold", "50"},
        {"--texture"},
        {"--report"},
        {"--html"},
        {"--zero-parallax-at", "3,4"},
        {"--disparity", "disparity.pfm"},
        {"--quality", "fast"},
        {"--swap"},
        {"--layout", "sbs"},
        {"--max-size", "64"},
        {"--rectify", "always"}}},
      {paint, {{"--scale", "2"}}},
      {display, {{"--report"}, {"--html"}, {"--depth-budget", "2%"}, {"--zero-parallax", "nearest"}}},
      {with(paint, {"--disparity", "disparity.pfm"}),
       {{"--range", "0:9"}, {"--quality", "best"}, {"--block", "5"}, {"--no-left-right-check"}, {"--max-size", "32"}}},
      {{"paint", "both.png", "again.png", "--layout", "sbs", "-o", "out"},
       {{"--disparity", "disparity.pfm"}, {"--zero-parallax-at", "3,4"}}},
      {{"paint", "--print-style", "dual"}, {{"--report"}, {"--output", "x"}, {"--style", "mosaic"}}},
      {paint, {{"--colours", "9"}, {"--tile", "20"}, {"--style", "mosaic", "--grid", "2"}}},
      {{"rotoscope", "film", "-o", "out.mkv"}, {{"--propagation", "raster"}, {"--style", "mosaic", "--fade-in", "3"}}},
      {{"rotoscope", "film", "--frame-by-frame", "-o", "out.mkv"}, {{"--flow", "dis"}, {"--fade-out", "3"}}},
      {{"rotoscope", "film", "--truth", "film", "-o", "out.mkv"},
       {{"--quality", "best"}, {"--flow", "dis"}, {"--rectify", "always"}}},
      {{"rotoscope", "film", "--matcher", "dp", "-o", "out.mkv"}, {{"--block", "5"}}},
      {{"rotoscope", "frame_%04d.png", "--layout", "mono", "-o", "out.mkv"},
       {{"--range", "0:9"}, {"--quality", "fast"}, {"--central", "average"}, {"--rectify", "never"}}},
      {with(match, {"--matcher", "dp"}), {{"--block", "5"}}},
      {match, {{"--model", "net.onnx", "--matcher", "bm"}}},
      {with(pack_two, {"-o", "out.mpo"}),
       {{"--span", "2"},
        {"--seconds", "1"},
        {"--depth-scale", "2"},
        {"--rectify", "never"},
        {"--format", "jpg"},
        {"--max-size", "32"}}},
      {with(pack_two, {"-o", "out.gif"}), {{"--quality", "50"}}},
      {with(pack_two, {"--to", "anaglyph", "-o", "out.png"}), {{"--quality", "50"}, {"--quilt", "2x1"}}},
      {with(pack_two, {"--to", "quilt", "--quilt", "2x1", "-o", "out.png"}), {{"--format", "jpg"}}},
      {{"pack", "both.png", "-o", "out.mpo"}, {{"--span", "2"}, {"--strength", "2%"}}},
      {{"pack", "left.png", "right.png", "left.png", "-o", "out.mpo"}, {{"--views", "3"}, {"--span", "2"}}},
      {{"pack", "some.wst", "-o", "out"}, {{"--layout", "sbs"}}},
      {with(again, {"--display", "looking-glass-go"}),
       {{"--scale", "2"}, {"--svg"}, {"--zero-parallax", "nearest"}, {"--texture"}}},
      {{"pack", "views", "-o", "out.mpo"}, {{"--layout", "sbs"}, {"--views", "2"}}},
      {{"render", "slices.exr", "-o", "out"},
       {{"--type", "gas"},
        {"--subsample", "2"},
        {"--where", "x > 1"},
        {"--type-colours", "gas=FFB347"},
        {"--opacity", "1"},
        {"--opaque"},
        {"--size", "64x48"},
        {"--zoom", "2"},
        {"--method", "exact"},
        {"--planes", "4"},
        {"--values", "n.npy"},
        {"--focus-gain", "2"},
        {"--eye", "60"}}},
      {with(render, {"--method", "exact"}), {{"--filter", "nearest"}, {"--planes", "4"}, {"--focus", "0.5,0.5"}}},
      {render,
       {{"--opacity", "1"},
        {"--least-opacity", "0.5"},
        {"--exposure", "1"},
        {"--density-slope", "1"},
        {"--blend", "add"}}},
      {with(render, {"--blend", "over"}), {{"--look", "mass"}, {"--stretch", "log"}, {"--opaque"}, {"--shine", "1"}}},
      {with(render, {"--look", "thesis"}),
       {{"--quantity", "temperature"},
        {"--stretch", "log"},
        {"--least", "1"},
        {"--most", "1"},
        {"--values", "n.npy"},
        {"--kernel", "gaussian"}}},
      {with(render, {"--quantity", "column-density"}), {{"--coldest", "1"}, {"--linear-colours"}, {"--shine", "1"}}},
      {with(render, {"--depth-mapping", "0:0,1:1"}), {{"--near", "5"}, {"--far", "5"}}},
      {with(render, {"--opaque"}), {{"--filter", "nearest"}}},
      {with(render, {"--colours", "inferno"}), {{"--cold", "001122"}, {"--hot", "001122"}}},
      {render, {{"--type", "halo"}, {"--chunk", "5000"}, {"--smooth-depth"}}},
      {{"depth", "--display", "desk-stereo"}, {{"--resolution", "640x480"}}},
      {{"info", "left.png"}, {{"--type", "gas"}, {"--display", "desk-stereo"}}},
      {{"info", "points.csv"}, {{"--scale", "2"}, {"--layout", "sbs"}, {"--display", "desk-stereo"}}},
      {{"info", "some.wst"}, {{"--scale", "2"}, {"--layout", "sbs"}, {"--type", "gas"}}},
      {{"measure", "stereo", "left.png", "right.png", "--disparity", "disparity.pfm"}, {{"--quality", "best"}}},
  };
}

TEST(OptionsWithoutEffect, AreRefused) {
  const TemporaryFolder folder;
  write_inputs(folder);
  put_bytes(folder / "some.wst", "");
  std::filesystem::create_directory(folder / "views");
  for (const char* view : {"views/view_000.png", "views/view_001.png", "views/view_002.png"})
    std::filesystem::copy_file(folder / "left.png", folder / view);
  for (const WithoutEffect& known : options_without_effect()) {
    for (const Line& option : known.options) {
      const std::set<std::string> before = files_in(folder / "");
      const ProgramResult result = run_program(with(known.line, option), {.folder = folder / ""});
      std::string line;
      for (const std::string& word : with(known.line, option)) line += " " + word;
      EXPECT_EQ(result.exit_code, 2) << line << "\n" << result.errors;
      EXPECT_EQ(std::ranges::count(result.errors, '\n'), 1) << line << "\n" << result.errors;
      EXPECT_EQ(files_in(folder / ""), before) << line;
    }
  }
}

/// The program's own help and that of every command and of every kind below one.
std::vector<Line> all_with_help() {
  std::vector<Line> all{{}};
  for (const std::string& command : commands()) all.push_back({command});
  for (const char* kind : {"still", "film", "universe"}) all.push_back({"synth", kind});
  for (const char* kind : {"stereo", "film", "views"}) all.push_back({"measure", kind});
  return all;
}

TEST(Help, HasNoMarksOfTheParserInIt) {
  for (const Line& line : all_with_help()) {
    const ProgramResult help = run_program(with(line, {"--help"}));
    ASSERT_EQ(help.exit_code, 0);
    std::string text = help.output;  // without what is meant to be typed so
    for (const std::string typed : {"{title}", "{date}", "{stem}", "{name}", "{style}", "{to}"})
      for (std::size_t at = text.find(typed); at != text.npos; at = text.find(typed)) text.erase(at, typed.size());
    for (const char* mark : {"{", "}", "ENUM", "TEXT:", "INT:", " INT", "UINT", "FLOAT", "NUMBER:", " in [", "->"})
      EXPECT_THAT(text, testing::Not(testing::HasSubstr(mark))) << testing::PrintToString(line);
  }
}

TEST(StyleParameters, AreRefusedWhereTheKindOfMarksDoesNotReadThem) {
  for (const char* style : {"impressionist", "posterise", "mosaic", "diffusion"}) {
    const Marks marks = style_by_name(style).marks;
    for (const StyleParameter& parameter : style_parameters()) {
      std::string value = parameter.toml_value(style_by_name(style));
      std::erase_if(value,
                    [](char letter) { return std::string_view("\"[] ").find(letter) != std::string_view::npos; });
      const cli::StyleArguments arguments{style, {{std::string(parameter.name), value}}};
      std::string said;
      try {
        cli::style_from(arguments, 1);
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::wrong_usage);
        said = error.what();
      }
      const auto refusal = testing::StartsWith(
          fmt::format("--{}: has no effect on a painting of {}; it works with ", parameter.name, name_of(marks)));
      if (is_read_by(parameter, marks)) {
        EXPECT_EQ(said, "") << style;
      } else {
        EXPECT_THAT(said, refusal) << style;
      }
    }
  }
}

TEST(Help, ListsChoicesByTheirNames) {
  EXPECT_THAT(run_program({"render", "--help"}).output, testing::HasSubstr("auto|exact|incremental|layered"));
}

TEST(PictureEndings, ThatNoFormatHasAreWrongUsage) {
  const TemporaryFolder folder;
  write_inputs(folder);
  expect_refused(folder, {"pack", "left.png", "right.png", "-o", "out.xyz"}, 2, ".mpo, .jps, ");
  expect_refused(folder, {"pack", "left.png", "right.png", "--to", "anaglyph", "-o", "out.xyz"}, 2, ".png, .jpg");
  expect_refused(folder, with(render, {"--quilt", "2x1", "-o", "out.xyz"}), 2, "");
}

TEST(Json, IsValidWhateverTheNamesAre) {
  const TemporaryFolder folder;
  write_inputs(folder);
  const ProgramRun here{.folder = folder / ""};
  const Line line{"paint", "left.png", "right.png", "--disparity", "disparity.pfm", "-o", "first", "--quiet"};
  ASSERT_EQ(run_program(line, here).exit_code, 0);
  const ProgramResult result = run_program({"paint", "first/painting.wst", "-o", "a\"b", "--json", "--quiet"}, here);
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(nlohmann::json::parse(result.output)["folder"], "a\"b");
}

TEST(Json, ReplacesWhatIsNoUtf8InFileNames) {
  const TemporaryFolder folder;
  write_inputs(folder);
  const ProgramRun here{.folder = folder / ""};
  const std::string name = "caf\xE9", replaced = "caf\xEF\xBF\xBD";
  const auto facts_of = [&](const Line& line) {
    const ProgramResult result = run_program(with(line, {"--json", "--quiet"}), here);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return nlohmann::json::parse(result.output, nullptr, false);
  };
  EXPECT_EQ(facts_of({"pack", "left.png", "right.png", "-o", name + ".jps"})["output"], replaced + ".jps");
  EXPECT_EQ(facts_of({"synth", "still", "--size", "32x24", "-o", name})["folder"], replaced);
  EXPECT_EQ(facts_of({"match", "left.png", "right.png", "--range", "0:8", "-o", name + "_m"})["folder"],
            replaced + "_m");
  EXPECT_EQ(facts_of({"paint", "both.png", "--layout", "sbs", "--range", "0:8", "-o", name + "_p"})["width"], width);
  EXPECT_EQ(facts_of({"paint", name + "_p/painting.wst", "-o", name + "_again"})["folder"], replaced + "_again");
  // The run's own notes, which --resume compares, hold the name of the marks.
  EXPECT_EQ(facts_of({"rotoscope", "frame_%04d.png", "--layout", "mono", "--save-marks", name + "_%04d.wst", "-o",
                      "f.mkv"})["frames"],
            1);
  const ProgramResult missing = run_program({"info", name + ".png", "--json"}, here);
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_EQ(nlohmann::json::parse(missing.output, nullptr, false)["exit_code"], 3);
}

TEST(Json, TellsErrorsToo) {
  for (const Line& line : {Line{"info", "miss\"ing.png", "--json"}, Line{"--json", "depth", "--near", "nan"},
                           Line{"depth", "--json", "--no-such-option"}}) {
    const ProgramResult result = run_program(line);
    const nlohmann::json facts = nlohmann::json::parse(result.output);
    EXPECT_EQ(facts["exit_code"], result.exit_code);
    EXPECT_EQ("wheatstone: " + facts["error"].get<std::string>() + "\n", result.errors);
  }
}

TEST(SeveralPhotographs, ArePaintedIntoFoldersOfTheirNames) {
  const TemporaryFolder folder;
  write_inputs(folder);
  const ProgramRun here{.folder = folder / ""};
  const ProgramResult result = run_program({"paint", "both.png", "missing.png", "again.png", "--layout", "sbs",
                                            "--range", "0:12", "--format", "jpg", "-o", "out", "--json", "--quiet"},
                                           here);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, testing::StartsWith("wheatstone: missing.png: "));
  EXPECT_EQ(std::ranges::count(result.errors, '\n'), 1) << result.errors;
  const nlohmann::json facts = nlohmann::json::parse(result.output);
  EXPECT_EQ(facts["painted"], 2);
  EXPECT_EQ(facts["failed"], 1);
  EXPECT_EQ(facts["photographs"][1]["exit_code"], 3);
  for (const std::string name : {"both", "again"}) {
    EXPECT_EQ(read_image(folder / ("out/" + name + "/left.jpg")).width(), width);
    EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + name + "/left_occlusion.png")));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out/missing"));
}

TEST(SeveralPhotographs, WhatCouldBeLeftAndRightIsNotGuessed) {
  const TemporaryFolder folder;
  write_inputs(folder);
  expect_refused(folder, {"paint", "photo.mpo", "left.png", "-o", "out"}, 2, "expected LEFT and RIGHT");
  expect_refused(folder, {"paint", "both.png", "both.png", "both.png", "-o", "out"}, 2, "the same folder");
  expect_refused(folder, {"paint", "a.mpo", "b.mpo", "c.mpo", "-o", "left.png/such"}, 4, "left.png/such");
}

TEST(Progress, NamesEveryStage) {
  const TemporaryFolder folder;
  write_inputs(folder);
  const auto stages_of = [&](const Line& line) {
    const ProgramResult result = run_program(line, {.folder = folder / "", .every_step = true});
    EXPECT_EQ(result.exit_code, 0);
    return result.errors;
  };
  EXPECT_THAT(stages_of({"paint", "left.png", "right.png", "--range", "0:8", "--report", "-o", "out"}),
              testing::AllOf(testing::HasSubstr("reading\ncomparing the views\nmatching\npainting\ndrawing\n"),
                             testing::HasSubstr("measuring\nwriting\n")));
  EXPECT_THAT(stages_of({"match", "left.png", "right.png", "--range", "0:8", "-o", "m"}),
              testing::HasSubstr("reading\ncomparing the views\nmatching\n"));
  EXPECT_THAT(stages_of({"pack", "left.png", "right.png", "--to", "disparity", "-o", "d.pfm"}),
              testing::AllOf(testing::StartsWith("reading\npacking\n"), testing::HasSubstr("matching\n")));
}

TEST(LargestSize, IsThatOfTheReducedCopy) {
  const TemporaryFolder folder;
  write_inputs(folder);
  const ProgramRun here{.folder = folder / ""};
  const ProgramResult painted = run_program(with(paint, {"--max-size", "48", "--range", "0:8", "--json"}), here);
  ASSERT_EQ(painted.exit_code, 0) << painted.errors;
  const nlohmann::json report = nlohmann::json::parse(painted.output);
  EXPECT_EQ(report["width"], 48);
  EXPECT_EQ(report["reduced_from"]["width"], width);
  EXPECT_EQ(read_image(folder / "out/left.png").width(), 48);
  ASSERT_EQ(
      run_program({"match", "left.png", "right.png", "--max-size", "48", "--range", "0:8", "-o", "m"}, here).exit_code,
      0);
  EXPECT_EQ(read_disparity(folder / "m/left_disparity.pfm").width(), 48);
  ASSERT_EQ(
      run_program({"pack", "left.png", "right.png", "--to", "rgbd", "--max-size", "48", "-o", "d.png"}, here).exit_code,
      0);
  EXPECT_EQ(read_image(folder / "d.png").width(), 96);
}

}  // namespace wheatstone::option_test
