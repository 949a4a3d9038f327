// Particles that move in the window: a series of snapshots, and a camera on its path.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <thread>

#include "command_line.h"
#include "command_table.h"
#include "particle_film.h"
#include "particle_scene.h"
#include "psnr.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "viewer.h"
#include "wheatstone/app/particle_frames.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/synthetic/synthetic_universe.h"

namespace wheatstone::viewer::particle_film_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A viewer of a universe at three scale factors, written once.
class ParticlesInTime : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    for (const int number : {0, 1, 2})
      write_synthetic_universe(
          snapshot(number),
          {.particles = 2000, .redshift = 1 / (0.4 + 0.1 * number) - 1, .box_mpc_h = 100, .motion = true});
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static fs::path snapshot(int number) { return in_folder(fmt::format("snap_{:03}.hdf5", number)); }
  static fs::path in_folder(const std::string& name) { return *folder_ / name; }
  static fs::path pattern() { return in_folder("snap_%03d.hdf5"); }

  ParticlesInTime() { viewer.set_viewport({192, 72}); }
  void open(const std::vector<fs::path>& files) {
    viewer.open_all(files);
    viewer.wait();
    run("mode left-right");
  }
  void run(const std::string& line) {
    run_line(viewer, line);
    viewer.wait();
  }
  /// The left eye's picture as the film's frame has it that `wheatstone render --frames` makes.
  Image<Rgb8> frame_of_film(int number, int count, const std::optional<CameraPath>& path = {}) {
    ParticleFramesOptions options{.particles = render_options(state(), eyes_of(viewer)), .count = count, .path = path};
    ParticleFrames frames(viewer.session().items[viewer.session().item].front().string(), options);
    return std::move(frames.frame(number).rendered.views.front());
  }
  Image<Rgb8> left() const {
    const Image<Rgb8>& both = viewer.frame()->picture;
    Image<Rgb8> left(both.width() / 2, both.height());
    for (int y = 0; y < left.height(); ++y)
      std::ranges::copy(both.row(y).subspan(0, left.row(y).size()), left.row(y).begin());
    return left;
  }
  ViewState& state() { return viewer.session().state; }
  const FilmStatus& film() { return *viewer.session().film; }

  Viewer viewer;

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(ParticlesInTime, AreWhereTheFramesOfAFilmHaveThem) {
  open({pattern()});
  ASSERT_TRUE(viewer.session().film);
  EXPECT_EQ(film().moment, "z = 1.500");
  const Image<Rgb8> first = left();
  EXPECT_GT(psnr_db(first, frame_of_film(0, 5)), 50);
  run(fmt::format("seek-to {}", film().duration_s / 4));
  EXPECT_EQ(film().moment, "z = 1.222");
  EXPECT_GT(psnr_db(left(), frame_of_film(1, 5)), 50) << "between the snapshots";
  EXPECT_LT(psnr_db(left(), first), 40);
  run("frame-step");
  EXPECT_NEAR(film().seconds, film().duration_s / 4 + 0.04, 1e-9);
  EXPECT_THAT(command_line_of(viewer.session()), HasSubstr("snap_%03d.hdf5 "));
  EXPECT_THAT(command_line_of(viewer.session()), HasSubstr("--frames 101"));
}

TEST_F(ParticlesInTime, PlayAndPause) {
  open({pattern()});
  run_line(viewer, "play");
  for (int i = 0; i < 400 && (film().seconds < 0.1 || open_particles(viewer)->time == 0.4); ++i) {
    viewer.collect();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_GT(film().seconds, 0.05);
  EXPECT_GT(open_particles(viewer)->time, 0.4);
  run("pause");
  const double stands_at = film().seconds;
  viewer.wait();
  EXPECT_EQ(film().seconds, stands_at);
  EXPECT_EQ(open_particles(viewer)->time, series_time(viewer.session()));
  run("seek-to 100");
  run_line(viewer, "play");
  EXPECT_EQ(film().seconds, 0) << "after its end it begins anew";
}

TEST_F(ParticlesInTime, AreASeriesWhereAllItsFilesAreOpened) {
  open({snapshot(0), snapshot(1), snapshot(2)});
  EXPECT_EQ(viewer.session().items.size(), 1U);
  EXPECT_TRUE(viewer.session().film);
  Viewer other;
  other.open_all({snapshot(1)});
  other.wait();
  EXPECT_FALSE(other.session().film);
  EXPECT_THAT(other.session().message, HasSubstr("open-series"));
  run_line(other, "open-series");
  other.wait();
  EXPECT_TRUE(other.session().film);
}

TEST_F(ParticlesInTime, NameTheSnapshotThatIsMissing) {
  for (const int number : {0, 1, 3}) fs::copy_file(snapshot(0), in_folder(fmt::format("hole_{}.hdf5", number)));
  open({in_folder("hole_%d.hdf5")});
  EXPECT_TRUE(viewer.session().message_is_error);
  EXPECT_THAT(viewer.session().message, HasSubstr("hole_2.hdf5"));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(viewer.session().opened.content));
}

TEST_F(ParticlesInTime, AreSeenAlongThePathThatWasMade) {
  open({pattern()});
  run("add-key");
  run(fmt::format("seek-to {}", film().duration_s));
  run("orbit 70 15");
  run("magnify 2");
  run("add-key");
  const fs::path file = in_folder("path.toml");
  run("save-camera " + file.string());
  const CameraPath saved = read_camera_path(file);
  EXPECT_EQ(saved, viewer.session().camera_path);
  ASSERT_EQ(saved.keys.size(), 2U);
  EXPECT_FLOAT_EQ(static_cast<float>(*saved.keys[1].zoom), 2);
  run(fmt::format("seek-to {}", film().duration_s / 4));
  EXPECT_GT(psnr_db(left(), frame_of_film(1, 5, saved)), 50);
  EXPECT_THAT(command_line_of(viewer.session()), HasSubstr("--camera " + file.string()));
  run("remove-key");
  EXPECT_EQ(viewer.session().camera_path.keys.size(), 1U);
  EXPECT_EQ(viewer.session().camera_path.keys[0], saved.keys[1]) << "the nearest was removed";
}

TEST_F(ParticlesInTime, GoRoundOneSnapshotOnAPathFromAFile) {
  open({snapshot(0)});
  ASSERT_FALSE(viewer.session().film);
  write_whole_file(in_folder("round.toml"), "[[key]]\nat = 0\nazimuth = 0\n\n[[key]]\nat = 1\nazimuth = 90\n");
  run_line(viewer, "camera " + in_folder("round.toml").string());
  ASSERT_TRUE(viewer.session().film);
  EXPECT_TRUE(film().plays);
  run_line(viewer, "pause");
  run("seek-to 5");
  EXPECT_NEAR(state().orbit.azimuth_deg, 45, 1e-3);
  EXPECT_GT(psnr_db(left(), frame_of_film(1, 3, viewer.session().camera_path)), 50);
  write_whole_file(in_folder("odd.toml"), "[[key]]\nat = 0\nazimut = 0\n");
  expect_error(ErrorKind::bad_input, "azimut", [&] { run_line(viewer, "camera " + in_folder("odd.toml").string()); });
  run("clear-camera");
  EXPECT_FALSE(viewer.session().film);
}

}  // namespace wheatstone::viewer::particle_film_test
