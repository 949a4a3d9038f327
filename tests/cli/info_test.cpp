#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone::info_test {

nlohmann::json facts_of(const std::filesystem::path& path) {
  const ProgramResult result = run_program({"info", path, "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return nlohmann::json::parse(result.output);
}

TEST(Info, TellsOfAPicture) {
  const TemporaryFolder folder;
  write_image(folder / "a.jpg", Image<Rgb8>(7, 5));
  const nlohmann::json facts = facts_of(folder / "a.jpg");
  EXPECT_EQ(facts["kind"], "picture");
  EXPECT_EQ(facts["format"], "jpeg");
  EXPECT_EQ(facts["width"], 7);
  EXPECT_EQ(facts["height"], 5);
  EXPECT_EQ(facts["channels"], 3);
  EXPECT_EQ(facts["bits"], 8);
  EXPECT_EQ(facts["exif_orientation"], 1);
}

TEST(Info, TellsOfADisparityFile) {
  const TemporaryFolder folder;
  Image<float> disparity(4, 2, 10.0f);
  disparity(0, 0) = std::numeric_limits<float>::quiet_NaN();
  disparity(1, 0) = -3.5f;
  write_disparity(folder / "d.pfm", disparity);
  const nlohmann::json facts = facts_of(folder / "d.pfm");
  EXPECT_EQ(facts["kind"], "disparity");
  EXPECT_EQ(facts["width"], 4);
  EXPECT_DOUBLE_EQ(facts["known_share"], 7.0 / 8.0);
  EXPECT_EQ(facts["farthest_disparity_px"], -3.5);
  EXPECT_EQ(facts["nearest_disparity_px"], 10);
}

TEST(Info, TellsOfAPainting) {
  const TemporaryFolder folder;
  StrokePainting painting{.width = 40, .height = 30};
  Layer layer{.radius_px = 4};
  layer.points = {{1, 2, 3}, {5, 6, 7}};
  layer.strokes = {{.point_count = 2, .radius_px = 4, .disparity = 7}};
  painting.layers = {layer};
  write_painting(folder / "p.wst", Painting{painting});
  const nlohmann::json facts = facts_of(folder / "p.wst");
  EXPECT_EQ(facts["kind"], "painting");
  EXPECT_EQ(facts["width"], 40);
  EXPECT_EQ(facts["strokes"], 1);
  EXPECT_EQ(facts["nearest_disparity_px"], 7);
  EXPECT_EQ(facts["layers"].size(), 1u);
}

TEST(Info, TellsOfAPaintingOfAreas) {
  const TemporaryFolder folder;
  Painting painting{RegionPainting{40, 30, {{1, 1, 3}, {9, 1, 3}, {5, 8, 4}}, {{0, 3}}, {{0, 1, {}, 4}}}};
  painting.surfaces.seen = {{ViewPosition(-2.f), KnownRuns(Image<float>(40, 30, 4))},
                            {right_eye, KnownRuns(Image<float>(40, 30, 4))}};
  write_painting(folder / "p.wst", painting);
  const nlohmann::json facts = facts_of(folder / "p.wst");
  EXPECT_EQ(facts["regions"], 1);
  EXPECT_EQ(facts["views"]["first"], -2);
  EXPECT_EQ(facts["views"]["last"], 0.5);
  EXPECT_EQ(facts["nearest_disparity_px"], 4);
}

/// A Fortran record.
std::string record(const std::string& data) {
  const auto length = static_cast<std::uint32_t>(data.size());
  const std::string marker(reinterpret_cast<const char*>(&length), sizeof length);
  return marker + data + marker;
}

TEST(Info, KnowsParticlesByTheirContent) {
  const TemporaryFolder folder;
  std::string header(256, '\0');
  header[0] = 2;  // gas particles
  const std::string snapshot = record(header) + record(std::string(24, '\0'));
  for (const std::string name : {"snap_000", "snap.gadget", "picture.png"}) {
    put_bytes(folder / name, snapshot);
    const nlohmann::json facts = facts_of(folder / name);
    EXPECT_EQ(facts["kind"], "particles") << name;
    EXPECT_EQ(facts["particles"], 2) << name;
  }
  put_bytes(folder / "stars", "x y z\n1 2 3\n");
  EXPECT_EQ(facts_of(folder / "stars")["format"], "text");
  put_bytes(folder / "letter", "Dear Sir, this is a letter and no table.\n");
  expect_refused(folder, {"info", "letter"}, 3, "letter");
}

TEST(Info, TellsOfAFilm) {
  const TemporaryFolder folder;
  FilmWriter writer(folder / "f.mkv", {.layout = StereoLayout::right_left, .frame_rate = {25, 1}});
  for (int i = 0; i < 5; ++i) writer.write({Image<Rgb8>(64, 32), i, {1, 25}, 1});
  writer.finish();
  const nlohmann::json facts = facts_of(folder / "f.mkv");
  EXPECT_EQ(facts["kind"], "film");
  EXPECT_EQ(facts["codec"], "h264");
  EXPECT_EQ(facts["width"], 64);
  EXPECT_EQ(facts["height"], 32);
  EXPECT_EQ(facts["layout"], "right-left");
  EXPECT_NEAR(facts["frames_per_second"], 25, 1e-9);
  EXPECT_NEAR(facts["duration_s"], 0.2, 1e-9);
}

TEST(Info, TellsOfNumberedPictures) {
  const TemporaryFolder folder;
  for (const char* name : {"f_1.png", "f_2.png"}) write_image(folder / name, Image<Rgb8>(7, 5));
  const nlohmann::json facts = facts_of(folder / "f_%d.png");
  EXPECT_EQ(facts["container"], "sequence");
  EXPECT_EQ(facts["frames"], 2);
  write_image(folder / "f_4.png", Image<Rgb8>(7, 5));
  const ProgramResult result = run_program({"info", folder / "f_%d.png"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, testing::HasSubstr("f_3.png is missing, the next there is f_4.png"));
}

TEST(Info, SpeaksInLinesWithoutJson) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", Image<Rgb8>(7, 5));
  EXPECT_THAT(run_program({"info", folder / "a.png"}).output, testing::HasSubstr("width: 7\nheight: 5\n"));
}

}  // namespace wheatstone::info_test
