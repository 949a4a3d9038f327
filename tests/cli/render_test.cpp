// Particles in, views out, as a user types it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>

#include "cli/run_program.h"
#include "shared_data.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::render_test {

ProgramResult run_in(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  ProgramResult result = run_program(arguments, {.folder = folder / "."});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return result;
}

/// A small universe, made once for all tests.
const std::filesystem::path& universe() {
  static const TemporaryFolder folder;
  static const std::filesystem::path path = [] {
    const ProgramResult result =
        run_program({"synth", "universe", "--particles", "20000", "-o", folder / "universe.hdf5"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return folder / "universe.hdf5";
  }();
  return path;
}

int brightest(const std::filesystem::path& picture) {
  int most = 0;
  const Image<Rgb8> image = read_image(picture);
  for (const Rgb8 pixel : image.pixels()) most = std::max({most, +pixel.r, +pixel.g, +pixel.b});
  return most;
}

TEST(SynthUniverseCommand, IsToldByInfoAndRepeatsItself) {
  const TemporaryFolder folder;
  run_in(folder, {"synth", "universe", "--particles", "3001", "--redshift", "2", "--seed", "7", "-o", "a.hdf5"});
  run_in(folder, {"synth", "universe", "--particles", "3001", "--redshift", "2", "--seed", "7", "-o", "b.hdf5",
                  "--threads", "1"});
  const auto facts = nlohmann::json::parse(run_in(folder, {"info", "a.hdf5", "--json"}).output);
  EXPECT_EQ(facts["format"], "GADGET HDF5");
  EXPECT_EQ(facts["particles"], 3001);
  EXPECT_EQ(facts["redshift"], 2);
  const auto rendered = [&](const std::string& file) {
    run_in(folder, {"render", file, "--views", "1", "--size", "64x36", "-o", file + ".views"});
    return read_image(folder / (file + ".views/view_000.png"));
  };
  EXPECT_EQ(rendered("a.hdf5"), rendered("b.hdf5"));
}

TEST(RenderCommand, WritesTheViewsAndSaysWhy) {
  const TemporaryFolder folder;
  const auto facts = nlohmann::json::parse(
      run_in(folder, {"render", universe(), "--views", "3", "--size", "160x90", "-o", "views", "--json"}).output);
  EXPECT_EQ(files_in(folder / "views"), (std::set<std::string>{"view_000.png", "view_001.png", "view_002.png"}));
  EXPECT_GT(brightest(folder / "views/view_001.png"), 100);
  EXPECT_EQ(facts["particles"], 20000);
  EXPECT_EQ(facts["device"], "cpu");
  EXPECT_FALSE(facts["reason"].get<std::string>().empty());
}

TEST(RenderCommand, MethodsAgreeByMeasureViews) {
  const TemporaryFolder folder;
  for (const std::string method : {"exact", "incremental", "layered"})
    run_in(folder, {"render", universe(), "--views", "3", "--size", "320x180", "--method", method, "-o", method});
  const auto measured = [&](const std::string& method) {
    return nlohmann::json::parse(
        run_in(folder, {"measure", "views", method, "--against", "exact", "--json"}).output)["views"];
  };
  for (const auto& view : measured("incremental")) EXPECT_TRUE(view["equal"]);
  for (const auto& view : measured("layered")) EXPECT_GE(view["psnr_db"], 45);
  expect_refused(folder, {"measure", "views", "exact/view_000.png", "--against", "exact"}, 2, "1 views against 3");
}

TEST(RenderCommand, StreamsWhatItRendersWhole) {
  const TemporaryFolder folder;
  for (const std::string out : {"stream", "whole"}) {
    std::vector<std::string> line{"render",  universe(), "--views", "2",  "--size",
                                  "320x180", "--method", "layered", "-o", out};
    if (out == "stream") line.insert(line.end(), {"--stream", "--chunk", "3000"});
    run_in(folder, line);
  }
  const auto views = nlohmann::json::parse(
      run_in(folder, {"measure", "views", "stream", "--against", "whole", "--json"}).output)["views"];
  for (const auto& view : views) EXPECT_TRUE(view["equal"].get<bool>() || view["psnr_db"].get<double>() > 55);
}

TEST(RenderCommand, KeepsWhatAConditionHoldsForAndInfoCountsIt) {
  const TemporaryFolder folder;
  const std::string where = "Temperature > 1e5 and not (x < 50000 or Density >= 2e-7)";
  const auto chosen = nlohmann::json::parse(run_in(folder, {"info", universe(), "--where", where, "--json"}).output);
  const auto count = chosen["chosen"].get<int>();
  EXPECT_GT(count, 100);
  EXPECT_LT(count, 10000);
  const auto render = [&](std::vector<std::string> line) {
    line.insert(line.begin(), {"render", universe(), "--views", "1", "--size", "160x90", "--json"});
    return nlohmann::json::parse(run_in(folder, line).output);
  };
  for (const std::string stream : {"", "--stream"}) {
    std::vector<std::string> line{"--where", where, "-o", "views" + stream};
    if (!stream.empty()) line.insert(line.end(), {stream, "--chunk", "1000"});
    const auto facts = render(line);
    EXPECT_EQ(facts["particles"], count);
    EXPECT_EQ(facts["unchosen"], 20000 - count);
  }
  EXPECT_EQ(read_image(folder / "views/view_000.png"), read_image(folder / "views--stream/view_000.png"));
  // A condition that is a box chooses what the box does.
  const auto half = render({"--where", "x >= 50000 and X <= 100000", "-o", "a"});
  EXPECT_EQ(half["particles"], render({"--select", "box:50000,-1,-1,100000,100001,100001", "-o", "b"})["particles"]);
  const auto measured = run_in(folder, {"measure", "views", "a", "--against", "b", "--json"});
  EXPECT_GT(nlohmann::json::parse(measured.output)["views"][0]["psnr_db"], 50);
  expect_refused(folder, {"render", universe(), "--where", "Metallicity > 1", "-o", "c"}, 3,
                 "has no quantity 'Metallicity', but Coordinates, Density, InternalEnergy");
  expect_refused(folder, {"render", universe(), "--where", "Density > 1e30", "-o", "c"}, 3,
                 "no particles to draw, the condition (where) holds for none");
  expect_refused(folder, {"info", universe(), "--where", "Density >"}, 2,
                 "--where: expected a number or a quantity at the end of 'Density >'");
  run_in(folder, {"synth", "universe", "--particles", "4000", "--times", "0.6,0.8", "-o", "snap_%03d.hdf5"});
  run_in(folder, {"render", "snap_%03d.hdf5", "--where", where, "--frames", "3", "--size", "64x36", "-o", "film.mp4"});
  expect_refused(folder, {"render", "snap_%03d.hdf5", "--where", "Density > 1e30", "--frames", "2", "-o", "no.mp4"}, 3,
                 "the condition (where) holds for none");
}

TEST(RenderCommand, DrawsTypesInTheirColours) {
  const std::filesystem::path snapshot = shared_data() / "particles/gadget4_lcdm_gas_z0.hdf5";
  if (!std::filesystem::exists(snapshot)) GTEST_SKIP() << "no " << snapshot;
  const TemporaryFolder folder;
  const auto render = [&](std::vector<std::string> line, const std::string& out) {
    line.insert(line.begin(), {"render", snapshot, "--views", "1", "--size", "160x90", "--json", "-o", out});
    return nlohmann::json::parse(run_in(folder, line).output);
  };
  const auto light = [&](const std::string& out) {
    std::array<double, 3> sum{};
    const Image<Rgb8> view = read_image(folder / (out + "/view_000.png"));
    for (const Rgb8 pixel : view.pixels()) sum = {sum[0] + pixel.r, sum[1] + pixel.g, sum[2] + pixel.b};
    return sum;
  };
  EXPECT_EQ(render({"--type-colours", "gas=FF0000,halo=00FF00"}, "both")["particles"], 65536);
  const auto [gas, halo, none] = light("both");
  EXPECT_GT(gas, 1e4);
  EXPECT_GT(halo, gas);  // dark matter is heavier
  EXPECT_EQ(none, 0);
  render({"--type-colours", "gas=FF0000:30,halo=00FF00"}, "bright");
  EXPECT_GT(light("bright")[0], light("bright")[1]);
  render({"--type-colours", "halo=00FF00,gas=FF0000", "--stream", "--chunk", "5000"}, "stream");
  EXPECT_GT(light("stream")[1], light("stream")[0]);
  const auto mass_of = [&](const std::vector<std::string>& options) {
    std::vector<std::string> line{"--values",     "v.npy", "--projection",
                                  "orthographic", "--fit", "box:0,0,0,50000,50000,50000"};
    line.insert(line.end(), options.begin(), options.end());
    render(line, "v");
    const std::string npy = bytes_of(folder / "v.npy");
    std::vector<float> values(160 * 90);
    const std::size_t bytes = values.size() * sizeof(float);
    std::memcpy(values.data(), npy.data() + npy.size() - bytes, bytes);
    return std::accumulate(values.begin(), values.end(), 0.);
  };
  const double all = mass_of({"--type-colours", "gas=FF0000,halo=00FF00"});
  EXPECT_NEAR(mass_of({"--type", "gas"}) + mass_of({"--type", "halo"}), all, all * 1e-3);
  const auto refused = [&](const std::string& colours, const std::string& words, int code = 2) {
    expect_refused(folder, {"render", snapshot, "--type-colours", colours, "-o", "no"}, code, words);
  };
  refused("gas", "--type-colours: is 'gas', expected TYPE=COLOUR,...");
  refused("gas=red", "--type-colours: is 'red', expected a colour");
  refused("a:b=c", "expected a colour");
  refused("gas=FF0000:0", "--type-colours: is '0', expected a number from 0.001");
  refused("moon=FF0000", "the particle type is 'moon', expected gas");
  refused("gas=FF0000,stars=00FF00", "has no particles of type 'stars'; by type it has 0: 32768, 1: 32768", 3);
  expect_refused(folder, {"render", snapshot, "--type-colours", "gas=FF0000", "--cold", "FFFFFF", "-o", "no"}, 2,
                 "--cold: has no effect with --type-colours");
}

TEST(RenderCommand, SlicesServeAnyRigLater) {
  const TemporaryFolder folder;
  run_in(folder, {"render", universe(), "--views", "2", "--size", "160x90", "--save-slices", "s.exr", "-o", "a"});
  EXPECT_EQ(nlohmann::json::parse(run_in(folder, {"info", "s.exr", "--json"}).output)["kind"], "slices");
  run_in(folder, {"render", "s.exr", "--views", "2", "-o", "b"});
  run_in(folder, {"render", "s.exr", "--views", "2", "--depth-mapping", "0:-40,0.3:0,1:0", "-o", "d"});
  EXPECT_NE(read_image(folder / "d/view_000.png"), read_image(folder / "b/view_000.png"));
  // Everything on the screen looks the same to both eyes.
  run_in(folder, {"render", "s.exr", "--views", "2", "--depth-mapping", "0:0,1:0", "-o", "e"});
  EXPECT_EQ(read_image(folder / "e/view_000.png"), read_image(folder / "e/view_001.png"));
  run_in(folder, {"render", "s.exr", "--views", "5", "--near", "10", "--far", "10", "-o", "c"});
  EXPECT_EQ(read_image(folder / "a/view_000.png"), read_image(folder / "b/view_000.png"));
  EXPECT_EQ(files_in(folder / "c").size(), 5u);
}

TEST(RenderCommand, WritesQuiltsAndInterleavedPictures) {
  const TemporaryFolder folder;
  run_in(folder, {"render", universe(), "--views", "6", "--size", "60x80", "--quilt", "3x2", "-o", "gas"});
  EXPECT_EQ(read_image(folder / "gas_qs3x2a0.75.png").width(), 180);
  put_bytes(folder / "screen.json", R"({"pitch":50,"slope":-5.4,"center":0.1,"DPI":300,"screenW":192,"screenH":108})");
  run_in(folder,
         {"render", universe(), "--views", "9", "--size", "192x108", "--interleave", "screen.json", "-o", "step.png"});
  EXPECT_EQ(read_image(folder / "step.png").width(), 192);
  EXPECT_GT(brightest(folder / "step.png"), 100);
  expect_refused(folder, {"render", universe(), "--views", "5", "--quilt", "3x2", "-o", "q"}, 2, "--quilt");
  expect_refused(folder, {"render", universe(), "--views", "9", "--interleave", "step-9", "-o", "s.png"}, 2, "--size");
  expect_refused(folder, {"render", universe(), "--interleave", "moon", "-o", "s.png"}, 2, "moon");
}

TEST(RenderCommand, AsADisplayWantsIt) {
  const TemporaryFolder folder;
  run_in(folder, {"render", universe(), "--display", "looking-glass-portrait", "-o", "universe"});
  const Image<Rgb8> quilt = read_image(folder / "universe_qs8x6a0.75.png");
  EXPECT_EQ(quilt.width(), 3360);
  EXPECT_EQ(quilt.height(), 3360);
  // What is typed beside it counts for more.
  run_in(folder, {"render", universe(), "--display", "nine-view", "--views", "3", "--depth-mapping", "0:-50,0.3:0,1:60",
                  "--smooth-depth", "-o", "three"});
  EXPECT_TRUE(std::filesystem::exists(folder / "three" / "view_002.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "three" / "view_003.png"));
}

TEST(RenderCommand, WritesNumbersWithTheirUnits) {
  const TemporaryFolder folder;
  put_bytes(folder / "gas.csv", "x [kpc],y [kpc],z [kpc],mass,age,hsml\n0,0,0,3,10,1\n5,0,0,1,30,1\n0,0,5,1,50,1\n");
  const auto facts = nlohmann::json::parse(
      run_in(folder, {"render", "gas.csv", "--views", "1", "--size", "64x48", "--projection", "orthographic",
                      "--quantity", "column-density", "--values", "n.fits", "-o", "a", "--json"})
          .output);
  EXPECT_EQ(facts["unit"], "code_mass/kpc**2");
  EXPECT_TRUE(facts["warnings"].empty());
  const std::string fits = bytes_of(folder / "n.fits");
  for (const char* keyword : {"CDELT1", "CUNIT1  = 'kpc", "BUNIT   = 'code_mass/kpc**2'"})
    EXPECT_THAT(fits, testing::HasSubstr(keyword));
  run_in(folder, {"render", "gas.csv", "--views", "2", "--size", "64x48", "--quantity", "mean:age", "--values", "n.npy",
                  "-o", "b"});
  EXPECT_EQ(bytes_of(folder / "n_001.npy").size(), 128 + 4u * 64 * 48);
  run_in(folder, {"render", "gas.csv", "--views", "1", "--size", "64x48", "--values", "n.exr", "-o", "c"});
  EXPECT_EQ(read_disparity(folder / "n.exr").width(), 64);
}

TEST(RenderCommand, AnnotatesFilmsAndSaysWhatIsTooSmall) {
  const TemporaryFolder folder;
  const auto with = [&](const char* size, std::initializer_list<const char*> more) {
    std::vector<std::string> words{"render", universe(), "--views", "1", "--frames", "2", "--size", size, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return nlohmann::json::parse(run_in(folder, words).output);
  };
  with("320x180", {"-o", "plain_%d.png"});
  EXPECT_TRUE(with("320x180", {"--annotate", "-o", "told_%d.png"})["notes"].empty());
  const Image<Rgb8> plain = read_image(folder / "plain_2.png"), told = read_image(folder / "told_2.png");
  const auto differ_in = [&](int left, int top, int width, int height) {
    int changed = 0;
    for (int y = top; y < top + height; ++y)
      for (int x = left; x < left + width; ++x) changed += plain(x, y) != told(x, y);
    return changed;
  };
  EXPECT_GT(differ_in(0, 0, 80, 30), 50);        // the redshift
  EXPECT_GT(differ_in(0, 130, 100, 50), 100);    // the scale bar
  EXPECT_GT(differ_in(160, 120, 160, 60), 500);  // the colours
  EXPECT_EQ(differ_in(100, 50, 60, 50), 0);
  EXPECT_EQ(with("64x48", {"--annotate", "-o", "small_%d.png"})["notes"].size(), 2);
}

TEST(RenderCommand, RefusesNumbersThatThereAreNot) {
  const TemporaryFolder folder;
  put_bytes(folder / "gas.csv", "x,y,z,mass,age\n0,0,0,3,10\n5,0,0,1,30\n0,0,5,1,50\n");
  put_bytes(folder / "nan.csv", "x,y,z,mass\n0,0,0,nan\n5,0,0,nan\n");
  const auto refused = [&](const std::vector<std::string>& more, int code, const std::string& part) {
    std::vector<std::string> line{"render", "gas.csv", "-o", "out"};
    line.insert(line.end(), more.begin(), more.end());
    expect_refused(folder, line, code, part);
  };
  refused({"--quantity", "spin"}, 3, "no column 'spin', but x, y, z, mass, age");
  refused({"--quantity", "temperature"}, 3, "no temperature");
  refused({"--least", "5", "--most", "2"}, 2, "least: is 5, expected below the most, 2");
  refused({"--least", "0", "--stretch", "log"}, 2, "least: is 0");
  refused({"--values", "n.txt"}, 2, "--values: is 'n.txt', expected a name ending in .fits, .exr or .npy");
  refused({"--exposure", "2"}, 2, "--look thesis");
  refused({"--look", "thesis", "--values", "n.npy"}, 2, "--look mass");
  expect_refused(folder, {"render", "nan.csv", "-o", "out"}, 3, "2 have no mass");
}

TEST(RenderCommand, LooksAtAPoint) {
  const TemporaryFolder folder;
  put_bytes(folder / "three.csv", "x,y,z\n1,2,3\n5,2,3\n1,9,-4\n");
  const auto rendered = [&](const std::vector<std::string>& options) {
    std::vector<std::string> line{"render", "three.csv", "--views", "1", "--size", "65x49", "-o", "views"};
    line.insert(line.end(), options.begin(), options.end());
    run_in(folder, line);
    return read_image(folder / "views/view_000.png");
  };
  for (const char* azimuth : {"10", "130"}) {
    const Image<Rgb8> seen = rendered({"--look-at", "5,2,3", "--azimuth", azimuth});
    EXPECT_GT(std::max({seen(32, 24).r, seen(32, 24).g, seen(32, 24).b}), 50) << azimuth;
  }
  EXPECT_EQ(rendered({"--look-at", "3,5.5,-0.5"}), rendered({})) << "the middle of all";
  expect_refused(folder, {"render", "three.csv", "--look-at", "1,2", "-o", "n"}, 2, "--look-at");
}

TEST(RenderCommand, DrawsOneParticleAndAllInOnePlace) {
  const TemporaryFolder folder;
  put_bytes(folder / "one.csv", "x,y,z\n1,2,3\n");
  put_bytes(folder / "same.csv", "x,y,z\n1,2,3\n1,2,3\n1,2,3\n");
  put_bytes(folder / "some.csv", "x,y,z,rho\n1,2,3,1\nnan,1,1,1\n2,2,2,-5\ninf,0,0,1\n0,0,0,0\n");
  for (const std::string name : {"one", "same"}) {
    run_in(folder, {"render", name + ".csv", "--size", "64x48", "-o", name});
    EXPECT_GT(brightest(folder / (name + "/view_000.png")), 50) << name;
  }
  const ProgramResult some = run_in(folder, {"render", "some.csv", "--size", "64x48", "-o", "some"});
  EXPECT_THAT(some.output, testing::HasSubstr("2 particles without a finite position"));
  EXPECT_THAT(some.output, testing::HasSubstr("2 densities"));
}

TEST(RenderCommand, RefusesBadFilesAndLeavesNothing) {
  const TemporaryFolder folder;
  put_bytes(folder / "none.csv", "x,y,z\n");
  put_bytes(folder / "nan.csv", "x,y,z\nnan,nan,nan\n");
  put_bytes(folder / "letter.csv", "Dear Sir, this is a letter\nwith no numbers, at all\n");
  put_bytes(folder / "cut.hdf5", bytes_of(universe()).substr(0, 5000));
  put_bytes(folder / "cut.exr", "v/1\x01 not the rest");
  write_disparity(folder / "plain.exr", Image<float>(8, 8, 1.f));
  for (const std::string name :
       {"none.csv", "nan.csv", "letter.csv", "cut.hdf5", "cut.exr", "plain.exr", "missing.hdf5"})
    expect_refused(folder, {"render", name, "-o", "out"}, 3, name);
  expect_refused(folder, {"render", "none.csv", "-o", "out"}, 3, "none.csv: no particles to draw, the file has none");
  put_bytes(folder / "good.csv", "x,y,z\n1,2,3\n4,5,6\n");
  expect_refused(folder, {"render", "good.csv", "--select", "sphere:100,0,0,1", "-o", "out"}, 3,
                 "no particle is inside the selected region");
  expect_refused(folder, {"render", "good.csv", "--density", "mass", "-o", "out"}, 3, "but x, y, z");
  expect_refused(folder,
                 {"render", "good.csv", "--quiet", "--planes", "100000", "--size", "4000x4000", "--save-slices",
                  "s.exr", "-o", "out"},
                 3, "GB");
}

TEST(RenderCommand, RefusesPositionsThatAreTooFarAway) {
  const TemporaryFolder folder;
  put_bytes(folder / "far.csv", "x,y,z\n0,0,0\n1e38,1e38,1e38\n-1e38,1,2\n");
  put_bytes(folder / "endless.csv", "x,y,z\ninf,0,0\n0,nan,0\n");
  for (const std::string stream : {"", "--stream"}) {
    std::vector<std::string> line{"render", "far.csv", "--views", "1", "--size", "32x32", "-o", "out"};
    if (!stream.empty()) line.push_back(stream);
    expect_refused(folder, line, 3, "far.csv: has a particle at 1e+38, expected positions of at most 1e+18");
    line[1] = "endless.csv";
    expect_refused(folder, line, 3, "endless.csv: no particles to draw, 2 have no finite position");
  }
}

TEST(RenderCommand, RefusesWhatMakesNoSense) {
  const TemporaryFolder folder;
  put_bytes(folder / "good.csv", "x,y,z\n1,2,3\n4,5,6\n");
  const auto refused = [&](const std::vector<std::string>& more, const std::string& part) {
    std::vector<std::string> line{"render", "good.csv", "-o", "out"};
    line.insert(line.end(), more.begin(), more.end());
    expect_refused(folder, line, 2, part);
  };
  refused({"--fit", "most"}, "--fit: is 'most', expected auto, all, 99.9%, sphere:X,Y,Z,R or box:");
  refused({"--fit", "200%"}, "--fit");
  refused({"--fit", "sphere:0,0,0,-1"}, "--fit: is 'sphere:0,0,0,-1', expected auto");
  refused({"--views", "0"}, "--views");
  refused({"--device", "tpu"}, "--device");
  refused({"--device", "gpu", "--blend", "over"}, "--device gpu does not render --blend over");
  refused({"--device", "gpu", "--method", "exact"}, "expected auto, incremental or layered");
  refused({"--device", "gpu", "--save-slices", "s.exr"}, "--device");
  refused({"--size", "0x5"}, "--size");
  refused({"--size", "wide"}, "--size");
  refused({"--splat", "5,2"}, "--s");
  refused({"--select", "moon"}, "--select");
  refused({"--colours", "mauve"}, "inferno");
  refused({"--cold", "blue"}, "--cold");
  refused({"--depth-mapping", "0:5,1:-5"}, "--depth-mapping");
  refused({"--method", "magic"}, "--method");
}

TEST(DepthCommand, ReproducesTheThesis) {
  const auto planes = [](const std::vector<std::string>& more) {
    std::vector<std::string> line{"depth", "--json"};
    line.insert(line.end(), more.begin(), more.end());
    return nlohmann::json::parse(run_program(line).output)["depth_planes"].get<double>();
  };
  // Hassaine 2010, sec. 5.6: about 60 planes for ±10 cm on 2×1280×1024, about 36 for nine views of 640×360.
  EXPECT_NEAR(planes({"--display", "376x301,mm", "--resolution", "1280x1024", "--distance", "750"}), 60, 0.5);
  EXPECT_NEAR(planes({"--display", "376x212,mm", "--resolution", "640x360", "--distance", "630"}), 36, 0.5);
  const TemporaryFolder folder;
  expect_refused(folder, {"depth", "--near", "800"}, 2, "behind the viewer");
  expect_refused(folder, {"depth", "--display", "376"}, 2, "--display");
  const ProgramResult deep = run_program({"depth", "--near", "300", "--far", "5000"});
  EXPECT_THAT(deep.output, testing::HasSubstr("comfort:"));
}

}  // namespace wheatstone::render_test
