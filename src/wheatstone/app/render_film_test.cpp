// Films of particles: a series of snapshots, a camera that moves, and runs that are stopped.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "psnr.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/app/particle_frames.h"
#include "wheatstone/app/render_film.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/synthetic/synthetic_universe.h"
#include "wheatstone/video/segmented_film.h"
#include "wheatstone/video/stereo_film.h"

namespace wheatstone::render_film_test {

namespace fs = std::filesystem;
using testing::ElementsAre;

void write_universe(const fs::path& file, double scale, double box_mpc_h = 100) {
  write_synthetic_universe(file,
                           {.particles = 3000, .redshift = 1 / scale - 1, .box_mpc_h = box_mpc_h, .motion = true});
}

/// Three snapshots of a universe, written once.
class RenderFilm : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    write_universe(*folder_ / "snap_0.hdf5", 0.4);
    write_universe(*folder_ / "snap_1.hdf5", 0.5);
    write_universe(*folder_ / "snap_2.hdf5", 0.6);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::string series() { return (*folder_ / "snap_%d.hdf5").string(); }
  static fs::path snapshot(int number) { return *folder_ / ("snap_" + std::to_string(number) + ".hdf5"); }
  static ParticleFramesOptions frames_options(int count) {
    ParticleFramesOptions options{.count = count};
    options.particles.width = 96;
    options.particles.height = 54;
    return options;
  }
  static FrameSource source(const ParticleFramesOptions& options, const std::string& input = series()) {
    const auto frames = std::make_shared<ParticleFrames>(input, options);
    return [frames](int frame, const Progress& progress) { return frames->frame(frame, progress); };
  }
  static RenderFilmOptions film_options(int frames) {
    RenderFilmOptions options{.frames = frames, .frames_between_checkpoints = 2, .made_by = "test"};
    options.writing = {.codec = "ffv1", .layout = StereoLayout::left_right, .frame_rate = {24, 1}};
    return options;
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(RenderFilm, FollowsTheParticlesFromSnapshotToSnapshot) {
  ParticleFrames frames(series(), frames_options(5));
  ASSERT_EQ(frames.count(), 5);
  const auto left = [&](int number) { return frames.frame(number).rendered.views.front(); };
  const Image<Rgb8> middle = left(2);
  EXPECT_GT(psnr_db(middle, left(1)), psnr_db(middle, left(0)));
  EXPECT_GT(psnr_db(middle, left(3)), psnr_db(middle, left(4)));
  EXPECT_NEAR(frames.frame(0).most / frames.frame(4).most, 1, 1e-5);
}

TEST_F(RenderFilm, OrbitsASnapshotAndFollowsAPath) {
  ParticleFramesOptions orbit = frames_options(4);
  orbit.orbit_deg = 360;
  ParticleFrames around(snapshot(2), orbit);
  RenderParticlesOptions turned = orbit.particles;
  turned.framing.azimuth_deg += 90;
  turned.least = around.frame(1).least;
  turned.most = around.frame(1).most;
  EXPECT_GT(psnr_db(around.frame(1).rendered.views[0], render_particles(snapshot(2), turned).rendered.views[0]), 60);

  ParticleFramesOptions travel = frames_options(3);
  travel.path = parse_camera_path("[[key]]\nat = 0\nzoom = 1.2\n[[key]]\nat = 1\nzoom = 2\nazimuth = 120", "path");
  ParticleFrames along(snapshot(2), travel);
  RenderParticlesOptions arrived = travel.particles;
  arrived.framing = {.azimuth_deg = 120, .zoom = 2};
  arrived.least = along.frame(2).least;
  arrived.most = along.frame(2).most;
  EXPECT_GT(psnr_db(along.frame(2).rendered.views[0], render_particles(snapshot(2), arrived).rendered.views[0]), 60);
}

TEST_F(RenderFilm, SlicesServeADisplayWithAnotherDepthAndMoreViews) {
  ParticleFramesOptions made = frames_options(2);
  made.particles.slices = true;
  RenderedParticles wide = ParticleFrames(series(), made).frame(1);
  ParticleFramesOptions wanted = frames_options(2);
  wanted.particles.views = 5;
  wanted.particles.depth.near_mm = wanted.particles.depth.far_mm = 60;
  wanted.particles.rendering.method = Method::exact;
  const RenderedParticles truth = ParticleFrames(series(), wanted).frame(1);

  const DepthMapping mapping = mapping_for(wanted.particles.depth, wide.stack.width, 1, 2);
  map_depth(wide.stack, mapping.points.front().parallax_px, mapping.points.back().parallax_px);
  const std::vector<Image<Rgb8>> views = render_slices(wide.stack, truth.rig);
  for (std::size_t view = 0; view < views.size(); ++view)
    EXPECT_GE(psnr_db(views[view], truth.rendered.views[view]), 45) << "view " << view;
  EXPECT_LT(psnr_db(views.front(), views.back()), 35) << "the views do not differ";
}

TEST_F(RenderFilm, GivesTheSameBytesWhenItIsStoppedAndResumed) {
  const TemporaryFolder folder;
  const FrameSource frames = source(frames_options(5));
  const fs::path whole = folder / "whole.mkv", stopped = folder / "stopped.mkv";
  RenderFilmOptions options = film_options(5);
  render_film(frames, whole, options);
  const FrameSource stops = [&](int frame, const Progress& progress) {
    if (frame == 3) throw Error(ErrorKind::interrupted, "stop");
    return frames(frame, progress);
  };
  EXPECT_THROW(render_film(stops, stopped, options), UnfinishedFilm);
  EXPECT_FALSE(fs::exists(stopped));
  EXPECT_THROW(render_film(frames, stopped, options), UnfinishedFilm) << "the rest is to be asked for";
  options.resume = true;
  EXPECT_EQ(render_film(frames, stopped, options).resumed_frames, 2);
  EXPECT_EQ(bytes_of(stopped), bytes_of(whole));
  EXPECT_EQ(open_stereo_film(whole).layout(), StereoLayout::left_right);
}

TEST_F(RenderFilm, MakesTheNumberedPicturesThatAreAskedFor) {
  const TemporaryFolder folder;
  const fs::path pictures = folder / "frame_%02d.png";
  RenderFilmOptions options = film_options(4);
  options.only = parse_frame_range("1-9x2", 4, "--frame-range");
  const FrameSource frames = source(frames_options(4));
  EXPECT_EQ(render_film(frames, pictures, options).frames, 2);
  EXPECT_FALSE(fs::exists(folder / "frame_02.png"));
  const std::string third = bytes_of(folder / "frame_03.png");
  put_bytes(folder / "frame_03.png", "kept");
  options.only.clear();
  options.skip_existing = true;
  EXPECT_EQ(render_film(frames, pictures, options).skipped_frames, 2);
  EXPECT_EQ(bytes_of(folder / "frame_03.png"), "kept");
  options.only = {3};
  options.skip_existing = false;
  render_film(frames, pictures, options);
  EXPECT_EQ(bytes_of(folder / "frame_03.png"), third) << "a frame depends on the frames before it";
}

TEST(FrameRange, IsReadAsRenderFarmsWriteIt) {
  const auto range = [](const std::string& text) { return parse_frame_range(text, 10, "--frame-range"); };
  EXPECT_THAT(range("1-7x3,9"), ElementsAre(1, 4, 7, 9));
  EXPECT_THAT(range("9-2000000000"), ElementsAre(9, 10));
  EXPECT_THAT(range("3,3,1-3"), ElementsAre(1, 2, 3));
  for (const char* wrong : {"", "0", "5-2", "1-", "1-5x0", "1,", "a", "1-5y2", "99999999999", "11", "11-20"})
    expect_error(ErrorKind::wrong_usage, "--frame-range", [&] { range(wrong); });
}

TEST(SnapshotSeries, NamesWhatIsWrongWithIt) {
  const TemporaryFolder folder;
  const std::string pattern = (folder / "s_%d.hdf5").string();
  const auto refused = [&](const std::string& message) {
    expect_error(ErrorKind::bad_input, message, [&] { ParticleFrames(pattern, {}); });
  };
  refused("s_%d.hdf5: 0 files have such names, expected at least 2");
  write_universe(folder / "s_1.hdf5", 0.4);
  write_universe(folder / "s_3.hdf5", 0.6);
  refused("s_2.hdf5 is missing, the next there is s_3.hdf5");
  write_universe(folder / "s_2.hdf5", 0.3);
  refused("s_2.hdf5: its time is 0.3, expected one after 0.4");
  write_universe(folder / "s_2.hdf5", 0.5, 50);
  refused("s_2.hdf5: its box has a side of 50000, expected 100000");
}

}  // namespace wheatstone::render_film_test
