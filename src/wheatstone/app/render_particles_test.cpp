// Pictures of particle files: what must not change them, and what frames them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "psnr.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/app/annotate.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/random.h"

namespace wheatstone::render_particles_test {

/// Coordinates of 1500 points, most of them in three clumps, around the offset, as double precision has them there.
std::vector<double> cluster(double size, double offset) {
  std::vector<double> numbers;
  for (std::uint64_t i = 0; i < 4500; ++i) {
    double spread = 0;
    for (std::uint64_t k = 0; k < 4; ++k) spread += unit_float(hash_keys({i, k})) - 0.5;
    const std::uint64_t clump = i / 3 % 4;
    numbers.push_back(
        size * (clump == 0 ? spread / 4 : 0.1 * spread + 0.12 * static_cast<double>(clump + i % 3) - 0.3) + offset);
  }
  return numbers;
}

std::string as_text(const std::vector<double>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), "%.17g%c", numbers[i], i % 3 == 2 ? '\n' : ' ');
    text += digits.data();
  }
  return text;
}

std::string as_ply(const std::vector<double>& numbers) {
  std::string bytes(numbers.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(numbers.size() / 3) +
         "\nproperty double x\nproperty double y\nproperty double z\nend_header\n" + bytes;
}

/// LAS 1.2 in millimetres, with UTM's eastings and northings as offsets.
std::string as_las(const std::vector<double>& numbers, const std::array<double, 3>& offset) {
  std::string bytes(227, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(bytes.data() + at, &value, sizeof(value)); };
  std::memcpy(bytes.data(), "LASF", 4);
  put(24, std::uint8_t{1});
  put(25, std::uint8_t{2});
  put(94, std::uint16_t{227});
  put(96, std::uint32_t{227});
  put(105, std::uint16_t{20});
  put(107, static_cast<std::uint32_t>(numbers.size() / 3));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(131 + 8 * axis, 0.001);
    put(155 + 8 * axis, offset[axis]);
  }
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    bytes.resize(bytes.size() + 20);
    for (std::size_t axis = 0; axis < 3; ++axis)
      put(bytes.size() - 20 + 4 * axis, static_cast<std::int32_t>(std::lround(numbers[i + axis] * 1000)));
    put(bytes.size() - 8, static_cast<std::uint16_t>(i % 1000));
  }
  return bytes;
}

RenderedParticles rendered(const std::filesystem::path& file, RenderParticlesOptions options = {}) {
  options.width = 96;
  options.height = 54;
  options.views = 1;
  options.rendering.exposure = 0.3f;
  return render_particles(file, options);
}

Image<Rgb8> picture_of(const std::filesystem::path& file, const RenderParticlesOptions& options = {}) {
  return rendered(file, options).rendered.views.front();
}

TEST(RenderParticles, AClusterFarFromZeroLooksLikeTheSameOneAtZero) {
  const TemporaryFolder folder;
  for (const auto& [size, offset] : {std::pair{1., 1e8}, std::pair{1000., 1e12}}) {
    const std::vector<double> far = cluster(size, offset);
    std::vector<double> near = far;
    for (double& number : near) number -= offset;
    write_whole_file(folder / "near.txt", as_text(near));
    write_whole_file(folder / "far.txt", as_text(far));
    write_whole_file(folder / "far.ply", as_ply(far));
    const Image<Rgb8> wanted = picture_of(folder / "near.txt");
    EXPECT_LT(psnr_db(wanted, Image<Rgb8>(wanted.width(), wanted.height())), 30);
    EXPECT_GE(psnr_db(wanted, picture_of(folder / "far.txt")), 60);
    EXPECT_GE(psnr_db(wanted, picture_of(folder / "far.ply")), 60);
    // Nor does it matter how it is read and what of it is asked for.
    EXPECT_GE(psnr_db(wanted, picture_of(folder / "far.ply",
                                         {.selection = {.cut = Sphere{{offset, offset, offset}, size * 9}}})),
              60);
    const RenderParticlesOptions streamed{.stream = true, .chunk = 1000};
    EXPECT_GE(psnr_db(picture_of(folder / "near.txt", streamed), picture_of(folder / "far.ply", streamed)), 60);
  }
}

TEST(RenderParticles, LasInUtmCoordinatesLooksLikeTheSamePointsAtZero) {
  const TemporaryFolder folder;
  const std::vector<double> points = cluster(20, 0);
  write_whole_file(folder / "near.las", as_las(points, {0, 0, 0}));
  write_whole_file(folder / "far.las", as_las(points, {500'000, 5'400'000, 300}));
  EXPECT_GE(psnr_db(picture_of(folder / "near.las"), picture_of(folder / "far.las")), 60);
}

TEST(RenderParticles, ShowTheSameColumnDensityWithColoursOfTheirOwnAsWithout) {
  const TemporaryFolder folder;
  std::string plain, coloured;
  const std::vector<double> points = cluster(20, 0);
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const std::string place =
        as_text({points.begin() + static_cast<long>(i), points.begin() + static_cast<long>(i) + 3});
    plain += place.substr(0, place.size() - 1) + " 0.5\n";
    coloured += place.substr(0, place.size() - 1) + (i % 2 == 0 ? " 0.5 255 0 0\n" : " 0.5 0 255 0\n");
  }
  write_whole_file(folder / "plain.txt", "x y z smoothing_length\n" + plain);
  write_whole_file(folder / "coloured.txt", "x y z smoothing_length red green blue\n" + coloured);
  const RenderParticlesOptions column{.quantity = "column-density"};
  EXPECT_EQ(picture_of(folder / "coloured.txt", column), picture_of(folder / "plain.txt", column));
  EXPECT_NE(picture_of(folder / "coloured.txt"), picture_of(folder / "plain.txt"));
}

TEST(RenderParticles, OneFarOutlierDoesNotShrinkEverythingElse) {
  const TemporaryFolder folder;
  const std::vector<double> points = cluster(1, 0);
  std::string text = as_text(points);
  write_whole_file(folder / "near.txt", text);
  write_whole_file(folder / "far.txt", text + "-5e6 2e7 1e6\n");
  const Image<Rgb8> wanted = picture_of(folder / "near.txt");
  for (const bool stream : {false, true})
    for (const Method method : {Method::exact, Method::layered}) {
      if (stream && method == Method::exact) continue;
      RenderParticlesOptions options{.stream = stream};
      options.rendering.method = method;
      const Image<Rgb8> whole = picture_of(folder / "near.txt", options);
      const RenderedParticles result = rendered(folder / "far.txt", options);
      EXPECT_GE(psnr_db(whole, result.rendered.views.front()), 40);
      EXPECT_EQ(result.outside, 1u);
      options.fit = FitAll{};
      EXPECT_LT(psnr_db(wanted, picture_of(folder / "far.txt", options)), 25);
    }
}

TEST(RenderParticles, AreFramedByABoxOrSphereOfTheFile) {
  const TemporaryFolder folder;
  const std::vector<double> points = cluster(1, 1e6);
  write_whole_file(folder / "a.txt", as_text(points));
  const Image<Rgb8> all = picture_of(folder / "a.txt");
  const Sphere around{{1e6, 1e6, 1e6}, 0.25};
  const RenderedParticles sphere = rendered(folder / "a.txt", {.fit = around});
  const RenderedParticles box = rendered(
      folder / "a.txt", {.fit = Box{{1e6 - 0.25, 1e6 - 0.25, 1e6 - 0.25}, {1e6 + 0.25, 1e6 + 0.25, 1e6 + 0.25}}});
  EXPECT_GT(sphere.outside, 100u);
  EXPECT_LT(box.outside, sphere.outside);
  EXPECT_EQ(rendered(folder / "a.txt", {.fit = around, .stream = true}).outside, sphere.outside);
  EXPECT_LT(psnr_db(all, sphere.rendered.views.front()), 30);
  EXPECT_EQ(sphere.particles, 1500u);
}

TEST(RenderParticles, OfAStreamHaveNearlyTheSizesThatNeighboursTell) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.txt", as_text(cluster(1, 0)));
  const RenderedParticles whole = rendered(folder / "a.txt");
  const RenderedParticles stream = rendered(folder / "a.txt", {.stream = true, .chunk = 100});
  EXPECT_EQ(whole.density, DensitySource::neighbours);
  EXPECT_EQ(stream.density, DensitySource::grid);
  EXPECT_GT(psnr_db(stream.rendered.views[0], whole.rendered.views[0]), 27);
}

TEST(RenderParticles, AreKeptByTheMemoryOfThoseThatAreChosenInWhateverOrder) {
  const TemporaryFolder folder;
  constexpr double away = 1000;
  std::vector<double> points = cluster(1, 0);
  const std::size_t numbers = points.size();
  for (std::size_t i = 0; i < 3 * numbers; ++i) points.push_back(points[i % numbers] + away);
  write_whole_file(folder / "first.ply", as_ply(points));
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(numbers), points.end());
  write_whole_file(folder / "last.ply", as_ply(points));
  const std::size_t bytes = numbers * sizeof(float);
  for (const char* name : {"first.ply", "last.ply"}) {
    RenderParticlesOptions options{.most_bytes_kept = bytes, .chunk = 100};
    options.selection.cut = Sphere{{0, 0, 0}, away / 2};
    EXPECT_EQ(rendered(folder / name, options).density, DensitySource::neighbours) << name;
    options.most_bytes_kept = bytes - 1;
    EXPECT_EQ(rendered(folder / name, options).density, DensitySource::grid) << name;
    options.selection = {};
    options.most_bytes_kept = 4 * bytes;
    EXPECT_EQ(rendered(folder / name, options).density, DensitySource::neighbours) << name;
    options.most_bytes_kept = 4 * bytes - 1;
    EXPECT_EQ(rendered(folder / name, options).density, DensitySource::grid) << name;
  }
}

TEST(RenderParticles, AreKeptWhereFewerThanExpectedAreLeft) {
  const TemporaryFolder folder;
  std::vector<double> points = cluster(1, 0);
  const std::size_t bytes = points.size() * sizeof(float);
  points.resize(4 * points.size(), std::numeric_limits<double>::quiet_NaN());
  write_whole_file(folder / "a.ply", as_ply(points));
  const RenderedParticles made = rendered(folder / "a.ply", {.most_bytes_kept = bytes, .chunk = 100});
  EXPECT_EQ(made.density, DensitySource::neighbours);
  EXPECT_EQ(made.particles, bytes / (3 * sizeof(float)));
  EXPECT_EQ(made.dropped, bytes / sizeof(float));
}

TEST(RenderParticles, OfWhichEveryThirdIsKeptHaveTheMassOfAll) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.txt", as_text(cluster(1, 0)));
  const auto mass_of = [&](std::uint64_t every) {
    RenderParticlesOptions options{.values = true};
    options.selection.every = every;
    options.framing.orthographic = true;
    double sum = 0;
    const RenderedParticles result = rendered(folder / "a.txt", options);
    for (const float column : result.values[0].column.pixels()) sum += column;
    return sum * std::pow(result.scene.camera.orthographic_depth / result.scene.camera.focal_px, 2);
  };
  EXPECT_NEAR(mass_of(1), 1500, 40);
  EXPECT_NEAR(mass_of(3), 1500, 40);
}

TEST(Annotate, TellsTheTimeWhereTheUniverseDoesNotExpand) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.txt", as_text(cluster(1, 0)));
  RenderedParticles result = render_particles(folder / "a.txt", {.width = 640, .height = 360, .views = 1});
  const auto corner = [&] {
    std::vector<Image<Rgb8>> views = result.rendered.views;
    annotate(result, views);
    int drawn = 0;
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 160; ++x) drawn += views[0](x, y) != result.rendered.views[0](x, y);
    return drawn;
  };
  EXPECT_EQ(corner(), 0);
  result.time = 1.25;
  const int with_time = corner();
  EXPECT_GT(with_time, 100);
  result.redshift = 0.5;
  EXPECT_NE(corner(), with_time);
}

TEST(Annotate, StandsInTheSamePlaceOfEveryView) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.txt", as_text(cluster(1, 0)));
  RenderedParticles result = render_particles(folder / "a.txt", {.width = 640, .height = 360, .views = 2});
  result.redshift = 0.5;
  std::vector<Image<Rgb8>> views = result.rendered.views;
  annotate(result, views);
  int drawn = 0;
  for (int y = 0; y < 360; ++y)
    for (int x = 0; x < 640; ++x) {
      const bool in_left = views[0](x, y) != result.rendered.views[0](x, y);
      const bool in_right = views[1](x, y) != result.rendered.views[1](x, y);
      drawn += in_left;
      if (y < 60) {
        EXPECT_EQ(in_left, in_right) << x << ", " << y;
      }
    }
  EXPECT_GT(drawn, 1000);
  // The bar at the bottom is as long as it says.
  int length = 0;
  for (int x = 0; x < 320; ++x) length += views[0](x, 360 - 360 / 30 - 1) == Rgb8{230, 230, 230};
  const double units = round_length(160 * result.scene.splat_style.size_depth / result.scene.camera.focal_px);
  EXPECT_NEAR(length, units * result.scene.camera.focal_px / result.scene.splat_style.size_depth, 2);
}

TEST(Annotate, LengthsAreRound) {
  EXPECT_DOUBLE_EQ(round_length(7.3), 5);
  EXPECT_DOUBLE_EQ(round_length(0.0021), 0.002);
  EXPECT_DOUBLE_EQ(round_length(1.9e6), 1e6);
}

}  // namespace wheatstone::render_particles_test
