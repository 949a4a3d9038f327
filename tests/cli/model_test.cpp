// A model of triangles in, views out, as a user types it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::model_test {

const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n";

class ModelCommandTest : public testing::Test {
 protected:
  ModelCommandTest() {
    put_bytes(folder_ / "model.obj", tetrahedron);
    put_bytes(folder_ / "faces.ply", ply);
  }
  nlohmann::json run(std::vector<std::string> words) const {
    words.emplace_back("--json");
    const ProgramResult result = run_program(words, {.folder = folder_ / "."});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return nlohmann::json::parse(result.output);
  }
  TemporaryFolder folder_;
};

TEST_F(ModelCommandTest, InfoTellsCountsSizeAndMaterials) {
  const nlohmann::json facts = run({"info", "model.obj"});
  EXPECT_EQ(facts["kind"], "model");
  EXPECT_EQ(facts["format"], "OBJ");
  EXPECT_EQ(facts["triangles"], 4);
  EXPECT_EQ(facts["size"], "1 x 1 x 1");
  EXPECT_EQ(facts["materials"].size(), 1u);
  EXPECT_EQ(run({"info", "faces.ply"})["kind"], "model");
}

TEST_F(ModelCommandTest, RendersViewsQuiltsAndLenticularPictures) {
  const nlohmann::json facts = run({"render", "model.obj", "--views", "3", "--size", "64x48", "-o", "views"});
  EXPECT_EQ(facts["triangles"], 4);
  EXPECT_EQ(facts["method"], "incremental");
  EXPECT_EQ(files_in(folder_ / "views"), (std::set<std::string>{"view_000.png", "view_001.png", "view_002.png"}));
  run({"render", "model.obj", "--views", "3", "--size", "64x48", "--method", "exact", "-o", "exact"});
  for (const char* const name : {"view_000.png", "view_001.png", "view_002.png"})
    EXPECT_EQ(read_image(folder_ / "views" / name), read_image(folder_ / "exact" / name));
  run({"render", "model.obj", "--views", "4", "--quilt", "2x2", "--size", "64x48", "-o", "quilt.png"});
  EXPECT_EQ(read_image(folder_ / "quilt.png").width(), 128);
}

TEST_F(ModelCommandTest, BackgroundAndDepthAreAsTold) {
  run({"render", "model.obj", "--views", "1", "--size", "64x48", "--background", "#102030", "--values", "depth.exr",
       "-o", "views"});
  const Image<Rgb8> view = read_image(folder_ / "views/view_000.png");
  EXPECT_EQ(view(0, 0), (Rgb8{0x10, 0x20, 0x30}));
  EXPECT_NE(view(32, 24), view(0, 0));
  const Image<float> depth = read_disparity(folder_ / "depth.exr");
  EXPECT_TRUE(std::isnan(depth(0, 0)));
  EXPECT_GT(depth(32, 24), 0);
}

TEST_F(ModelCommandTest, AnOrbitIsAFilm) {
  const nlohmann::json facts = run({"render", "model.obj", "--frames", "3", "--orbit", "120", "--views", "2", "--size",
                                    "64x48", "-o", "frame_%02d.png"});
  EXPECT_EQ(facts["frames"], 3);
  EXPECT_NE(read_image(folder_ / "frame_01.png"), read_image(folder_ / "frame_02.png"));
  EXPECT_EQ(read_image(folder_ / "frame_01.png").width(), 128);
}

TEST_F(ModelCommandTest, FacesOfAPlyFileAreDrawnUnlessPointsAreWanted) {
  EXPECT_EQ(run({"render", "faces.ply", "--size", "64x48", "-o", "a"})["triangles"], 1);
  EXPECT_EQ(run({"render", "faces.ply", "--size", "64x48", "--points", "-o", "b"})["particles"], 3);
}

TEST_F(ModelCommandTest, IsPaintedWithItsOwnDisparity) {
  const nlohmann::json facts =
      run({"paint", "model.obj", "--picture-size", "96x72", "--azimuth", "60", "-o", "painted"});
  EXPECT_TRUE(std::filesystem::exists(folder_ / "painted/left_photograph.png"));
  EXPECT_EQ(read_image(folder_ / "painted/left.png").width(), 96);
  const Image<float> disparity = read_disparity(folder_ / "painted/left_disparity.pfm");
  EXPECT_GT(disparity(48, 36), disparity(0, 0));
  run({"paint", "painted/painting.wst", "--display", "looking-glass-portrait", "--size", "48x64", "-o", "quilt"});
  expect_refused(folder_, {"paint", "model.obj", "--disparity", "d.pfm", "-o", "out"}, 2, "on a model of triangles");
  expect_refused(folder_, {"paint", "model.obj", "--rectify", "always", "-o", "out"}, 2, "on a model of triangles");
  expect_refused(folder_, {"paint", "model.obj", "--depth", "d.png", "-o", "out"}, 2, "on a model of triangles");
}

TEST_F(ModelCommandTest, IsPaintedAsAFilmInWhichTheCameraMoves) {
  const std::vector<std::string> words{"rotoscope",    "model.obj", "--picture-size", "96x72",        "--frames", "6",
                                       "--checkpoint", "2",         "--style",        "impressionist"};
  const auto painted = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return run(more);
  };
  const nlohmann::json facts = painted({"-o", "frame_%02d.png", "--orbit", "30"});
  EXPECT_EQ(facts["frames"], 6);
  EXPECT_EQ(facts["scenes"], 1);
  EXPECT_GT(facts["survival"], 0.8);
  const Image<Rgb8> first = read_image(folder_ / "frame_01.png");
  EXPECT_EQ(first.width(), 192);
  EXPECT_NE(read_image(folder_ / "frame_06.png"), first);
  put_bytes(folder_ / "path.toml", "[[key]]\nat = 0\nazimuth = 90\n[[key]]\nat = 1\nazimuth = 95\n");
  painted({"-o", "other_%02d.png", "--orbit", "0", "--camera", "path.toml"});
  EXPECT_NE(read_image(folder_ / "other_01.png"), first);
  painted({"-o", "quilt_%02d.png", "--display", "looking-glass-portrait", "--size", "48x64"});
}

TEST_F(ModelCommandTest, AFilmOfItRefusesWhatBelongsToFilms) {
  const auto refused = [&](const std::vector<std::string>& more, const std::string& part) {
    std::vector<std::string> words{"rotoscope", "model.obj", "-o", "out.mp4"};
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(folder_, words, 2, part);
  };
  refused({"--matcher", "sgbm"}, "--matcher: has no effect on a model of triangles");
  refused({"--flow", "farneback"}, "--flow: has no effect on a model of triangles");
  refused({"--from", "1"}, "--from: has no effect on a model of triangles; it works on films");
  refused({"--preview", "s.png"}, "--preview: has no effect on a model of triangles");
  refused({"--depth", "d.mp4"}, "--depth: has no effect on a model of triangles");
  expect_refused(folder_, {"rotoscope", "film.mp4", "--orbit", "90"}, 2,
                 "--orbit: has no effect on a film; it works on models");
  put_bytes(folder_ / "cut.glb", "glTF");
  expect_refused(folder_, {"rotoscope", "cut.glb", "-o", "out.mp4"}, 3, "cut.glb");
}

TEST_F(ModelCommandTest, WhatDoesNotApplyIsRefused) {
  const auto refused = [&](std::vector<std::string> words, int code, const std::string& part) {
    words.insert(words.begin(), {"render"});
    words.insert(words.end(), {"-o", "out"});
    expect_refused(folder_, words, code, part);
  };
  refused({"model.obj", "--quantity", "density"}, 2, "on a model of triangles; it works on particles");
  refused({"model.obj", "--fit", "all"}, 2, "on a model of triangles");
  refused({"model.obj", "--save-slices", "s.exr"}, 2, "on a model of triangles");
  refused({"model.obj", "--device", "gpu"}, 2, "on a model");
  refused({"model.obj", "--method", "layered"}, 2, "expected exact or incremental");
  refused({"model.obj", "--texture", "missing.png"}, 2, "has no places in a texture");
  put_bytes(folder_ / "points.csv", "x,y,z\n1,2,3\n2,3,4\n");
  refused({"points.csv", "--crease", "30"}, 2, "it works on models of triangles");
  put_bytes(folder_ / "empty.obj", "");
  refused({"empty.obj"}, 3, "empty.obj");
  put_bytes(folder_ / "cut.glb", "glTF");
  refused({"cut.glb"}, 3, "cut.glb");
}

TEST_F(ModelCommandTest, SharesAPageOfWhatTheRendererSees) {
  const auto page_of = [&](const char* azimuth) {
    run({"share", "model.obj", "--picture-size", "96x72", "--azimuth", azimuth, "-o", "page.html"});
    return bytes_of(folder_ / "page.html");
  };
  const std::string page = page_of("60");
  EXPECT_NE(page.find("layered"), std::string::npos);
  EXPECT_NE(page, page_of("240"));
  expect_refused(folder_, {"share", "model.obj", "--depth", "d.png", "-o", "out.html"}, 2, "on a model of triangles");
  expect_refused(folder_, {"share", "photo.png", "--azimuth", "60", "-o", "out.html"}, 2, "on a stereo photograph");
  put_bytes(folder_ / "damaged.obj", "v 1 2 3\nf 1 2 9\n");
  expect_refused(folder_, {"share", "damaged.obj", "-o", "out.html"}, 3, "damaged.obj");
}

}  // namespace wheatstone::model_test
