// Ranks that share the rendering of particles: the same bytes as of one, whatever is shared.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "temporary_folder.h"
#include "thread_ranks.h"
#include "throws_error.h"
#include "wheatstone/app/particle_frames.h"
#include "wheatstone/app/render_film.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/random.h"
#include "wheatstone/synthetic/synthetic_universe.h"

namespace wheatstone::ranks_test {

namespace fs = std::filesystem;

RenderParticlesOptions small() {
  RenderParticlesOptions options{.width = 120, .height = 100, .views = 3, .chunk = 1500};
  options.rendering.method = Method::layered;
  return options;
}

/// What the first of so many ranks has.
RenderedParticles rendered_by(int ranks, const fs::path& file, RenderParticlesOptions options) {
  if (ranks == 1) return render_particles(file, options);
  RenderedParticles result;
  as_ranks(ranks, [&](const Ranks& shared) {
    RenderParticlesOptions of_rank = options;
    of_rank.rendering.ranks = shared;
    RenderedParticles of_this = render_particles(file, of_rank);
    if (shared.first()) result = std::move(of_this);
  });
  return result;
}

void expect_same(const RenderedParticles& a, const RenderedParticles& b) {
  EXPECT_EQ(a.rendered.views, b.rendered.views);
  ASSERT_EQ(a.values.size(), b.values.size());
  for (std::size_t v = 0; v < a.values.size(); ++v) EXPECT_EQ(a.values[v].column, b.values[v].column);
  ASSERT_EQ(a.stack.slices.size(), b.stack.slices.size());
  for (std::size_t s = 0; s < a.stack.slices.size(); ++s) {
    EXPECT_EQ(a.stack.slices[s].pixels, b.stack.slices[s].pixels);
    EXPECT_EQ(a.stack.slices[s].left, b.stack.slices[s].left);
    EXPECT_EQ(a.stack.slices[s].top, b.stack.slices[s].top);
  }
  EXPECT_EQ(a.particles, b.particles);
  EXPECT_EQ(a.dropped, b.dropped);
  EXPECT_EQ(a.outside, b.outside);
  EXPECT_EQ(fmt::format("{} to {}", a.least, a.most), fmt::format("{} to {}", b.least, b.most));
}

/// A snapshot of a universe, written once.
class RanksRender : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    write_synthetic_universe(snapshot(), {.particles = 20000});
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static fs::path snapshot() { return *folder_ / "universe.hdf5"; }
  static fs::path file(const std::string& name) { return *folder_ / name; }

  static void expect_same_of_any_number(const fs::path& file, const RenderParticlesOptions& options,
                                        std::initializer_list<int> numbers) {
    const RenderedParticles alone = render_particles(file, options);
    ASSERT_FALSE(alone.rendered.views.empty());
    for (const int ranks : numbers) {
      SCOPED_TRACE(ranks);
      expect_same(alone, rendered_by(ranks, file, options));
    }
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(RanksRender, GivesTheSameBytesInDepthPlanes) {
  RenderParticlesOptions options = small();
  expect_same_of_any_number(snapshot(), options, {2, 3, 4});
  options.rendering.filter = SliceFilter::centroid;
  expect_same_of_any_number(snapshot(), options, {2});
  // So many that their light takes less memory than they do.
  options.rendering.planes = 3;
  expect_same_of_any_number(snapshot(), options, {3});
}

TEST_F(RanksRender, GivesTheSameBytesByEveryOtherMethod) {
  for (const Method method : {Method::exact, Method::incremental}) {
    RenderParticlesOptions options = small();
    options.rendering.method = method;
    expect_same_of_any_number(snapshot(), options, {2, 3});
    options.rendering.opaque = true;
    expect_same_of_any_number(snapshot(), options, {2});
  }
  RenderParticlesOptions opaque = small();
  opaque.rendering.opaque = true;
  expect_same_of_any_number(snapshot(), opaque, {3});
  RenderParticlesOptions thesis = small();
  thesis.appearance.look = Look::thesis;
  expect_same_of_any_number(snapshot(), thesis, {2});
  thesis.appearance.blend = Blend::over;
  expect_same_of_any_number(snapshot(), thesis, {2});
}

TEST_F(RanksRender, GivesTheSameNumbersAndSlices) {
  RenderParticlesOptions options = small();
  options.values = true;
  options.framing.orthographic = true;
  expect_same_of_any_number(snapshot(), options, {2, 4});
  options.slices = true;
  options.quantity = "temperature";
  expect_same_of_any_number(snapshot(), options, {3});
}

TEST_F(RanksRender, GivesTheSameBytesOfAPartOfTheParticles) {
  RenderParticlesOptions options = small();
  options.selection.every = 3;
  const double side = 0.6 * open_cloud(snapshot()).box_size;
  options.selection.cut = Box{{0, 0, 0}, {side, side, side}};
  options.stream = true;
  expect_same_of_any_number(snapshot(), options, {2, 3});
}

TEST_F(RanksRender, GivesTheSameBytesWhereNeighboursTellTheDensity) {
  std::string text = "x y z\n";
  for (std::uint64_t i = 0; i < 4000; ++i)
    text += fmt::format("{} {} {}\n", i == 77 ? "nan" : fmt::format("{}", 7e5 + unit_float(hash_keys({i, 1}))),
                        unit_float(hash_keys({i, 2})) * unit_float(hash_keys({i, 4})), unit_float(hash_keys({i, 3})));
  write_whole_file(file("points.txt"), text);
  expect_same_of_any_number(file("points.txt"), small(), {2, 3});
}

TEST_F(RanksRender, GivesTheSameBytesWhereAGridTellsTheDensity) {
  std::string text = "x y z\n";
  // The cells grow while chunks come: the cloud becomes wider, and a few lie far out.
  for (std::uint64_t i = 0; i < 6000; ++i) {
    const double wide = i % 2000 == 1999 ? 900 : 1 + static_cast<double>(i) / 500;
    text += fmt::format("{} {} {}\n", 7e5 + wide * unit_float(hash_keys({i, 1})), wide * unit_float(hash_keys({i, 2})),
                        unit_float(hash_keys({i, 3})));
  }
  write_whole_file(file("cloud.txt"), text);
  RenderParticlesOptions options = small();
  options.stream = true;
  options.chunk = 500;
  expect_same_of_any_number(file("cloud.txt"), options, {2});
  options.chunk = 5000;  // the last rank has nothing
  const RenderedParticles by_three = rendered_by(3, file("cloud.txt"), options);
  EXPECT_EQ(by_three.density, DensitySource::grid);
  expect_same(render_particles(file("cloud.txt"), options), by_three);
}

TEST_F(RanksRender, GivesTheSameHighlights) {
  RenderParticlesOptions options = small();
  const RenderedParticles dull = render_particles(snapshot(), options);
  options.appearance.shine = 20;
  options.slices = true;
  EXPECT_NE(render_particles(snapshot(), options).rendered.views, dull.rendered.views);
  expect_same_of_any_number(snapshot(), options, {3});
  options.slices = false;
  for (const Method method : {Method::exact, Method::incremental}) {
    options.rendering.method = method;
    expect_same_of_any_number(snapshot(), options, {2});
  }
}

TEST_F(RanksRender, EndsWithOneErrorOfADamagedFile) {
  std::string text = "1 2 3\n";
  for (int i = 0; i < 4000; ++i) text += "1 2 3\n";
  write_whole_file(file("damaged.txt"), text + "1 2 here\n");
  expect_error(ErrorKind::bad_input, "damaged.txt", [] { rendered_by(3, file("damaged.txt"), small()); });
}

TEST_F(RanksRender, GivesTheSameFramesOfAFilmSharedEitherWay) {
  const auto film_by = [&](int count, bool whole_frames) {
    const fs::path pattern = file(fmt::format("frame_{}_{}_%d.png", count, whole_frames));
    as_ranks(count, [&](const Ranks& ranks) {
      ParticleFramesOptions wanted{.particles = small(), .count = 3, .orbit_deg = 90};
      wanted.particles.views = 2;
      if (!whole_frames) wanted.particles.rendering.ranks = ranks;
      ParticleFrames frames(snapshot().string(), wanted);
      RenderFilmOptions options{.frames = 3, .ranks = ranks, .whole_frames = whole_frames};
      options.writing.layout = StereoLayout::left_right;
      render_film([&](int frame, const Progress& progress) { return frames.frame(frame, progress); }, pattern, options);
    });
    std::vector<Image<Rgb8>> pictures;
    for (int frame = 1; frame <= 3; ++frame)
      pictures.push_back(read_image(file(fmt::format("frame_{}_{}_{}.png", count, whole_frames, frame))));
    return pictures;
  };
  const std::vector<Image<Rgb8>> alone = film_by(1, false);
  EXPECT_NE(alone[0], alone[2]);
  EXPECT_EQ(film_by(2, false), alone);
  EXPECT_EQ(film_by(2, true), alone);
}

}  // namespace wheatstone::ranks_test
