// Films whose shots are painted each in its own way: as each would be alone, however the film is made.

#include "wheatstone/app/film_shots.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "scenes/film_of_scenes.h"
#include "thread_ranks.h"
#include "throws_error.h"
#include "wheatstone/app/film_plan.h"
#include "wheatstone/app/paint_film_frame_internal.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::film_shots_test {

namespace fs = std::filesystem;

constexpr int film_frames = 8;

constexpr OtherScene other_scene{3, 6};

StereoPair eyes_of_frame(int frame) { return eyes_of_scenes(frame, other_scene); }

/// When a frame is shown.
double time_s(std::int64_t frame) { return static_cast<double>(frame) / 25; }

/// One ends where no cut is found; another fades in over it, goes on over a cut, and its numbers move.
std::vector<FilmShot> shots_of_film() {
  return {{0, style_by_name("impressionist"), 0.03f, {}},
          {2, style_by_name("posterise"), {}, {}},
          {3,
           style_by_name("expressionist"),
           0.01f,
           2.f,
           {{"zero-parallax", {{time_s(3), 2}, {time_s(6), -1}}}, {"opacity", {{time_s(4), 0.9f}, {time_s(7), 0.3f}}}},
           3}};
}

class FilmOfShots : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    make_film_of_scenes(file("film.mkv"), film_frames, other_scene);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static fs::path file(const std::string& name) { return *folder_ / name; }
  static StereoFilmReader source() { return open_stereo_film(file("film.mkv")); }

  static RotoscopeFilmOptions usual() {
    RotoscopeFilmOptions options;
    options.shots = shots_of_film();
    options.writing = {.preset = "ultrafast", .layout = StereoLayout::left_right};
    options.frames_between_checkpoints = 4;
    options.version = "1.2.3";
    return options;
  }

  static RotoscopedFilm paint(const fs::path& output, const RotoscopeFilmOptions& options,
                              const Progress& progress = {}) {
    StereoFilmReader film = source();
    return rotoscope_film(film, output, options, progress);
  }

  static void stop_after_five(std::string_view step, double /*share*/) {
    if (step.starts_with("painting frame 6")) throw Error(ErrorKind::interrupted, "interrupted");
  }

  static void expect_same_however_made(const RotoscopeFilmOptions& options, const fs::path& whole_film) {
    const std::string whole = bytes_of(whole_film);
    as_ranks(2, [&](const Ranks& ranks) {
      RotoscopeFilmOptions of_rank = options;
      of_rank.ranks = ranks;
      of_rank.scenes = {cuts_of(options.shots), film_frames};
      paint(file("shared.mkv"), of_rank);
    });
    EXPECT_TRUE(bytes_of(file("shared.mkv")) == whole);

    RotoscopeFilmOptions planned = options;
    planned.plan = file("a.plan");
    fs::remove_all(planned.plan);
    paint(file("joined.mkv"), planned);
    const FilmPlan plan = read_film_plan(planned.plan, options.version);
    draw_film_part(planned.plan, plan, {5, film_frames});
    draw_film_part(planned.plan, plan, {1, 4});
    join_film_parts(planned.plan, plan);
    EXPECT_TRUE(bytes_of(file("joined.mkv")) == whole);

    RotoscopeFilmOptions again = options;
    expect_error(ErrorKind::interrupted, "the first 4 frames are kept in ",
                 [&] { paint(file("stopped.mkv"), again, stop_after_five); });
    again.resume = true;
    EXPECT_EQ(paint(file("stopped.mkv"), again).resumed_frames, 4);
    EXPECT_TRUE(bytes_of(file("stopped.mkv")) == whole);
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(FilmOfShots, HasTheScenesThatTheyAreAndNoOthers) {
  RotoscopeFilmOptions options = usual();
  EXPECT_EQ(paint(file("own.mkv"), options).totals.scenes, 3);
  options.shots.resize(1);
  EXPECT_EQ(paint(file("one.mkv"), options).totals.scenes, 1);
  options.shots.clear();
  EXPECT_EQ(paint(file("found.mkv"), options).totals.scenes, 3);
}

TEST_F(FilmOfShots, PaintsEachAsAlone) {
  const std::vector<FilmShot> shots = shots_of_film();
  RotoscopeState film, alone;
  std::vector<FilmShot> this_one;
  for (int frame = 0; frame < film_frames; ++frame) {
    for (const FilmShot& shot : shots)
      if (shot.begin == frame) {
        alone = {};
        this_one = {shot};
        this_one[0].begin = 0;
      }
    const RotoscopedFrame a =
        rotoscope_frame(eyes_of_frame(frame), options_of_frame({}, shots, film.frames, time_s(frame)), film);
    const RotoscopedFrame b =
        rotoscope_frame(eyes_of_frame(frame), options_of_frame({}, this_one, alone.frames, time_s(frame)), alone);
    EXPECT_EQ(a.scene_begins, b.scene_begins) << frame;
    EXPECT_EQ(a.painting, b.painting) << frame;
    EXPECT_EQ(std::get<StereoPair>(a.pictures).left, std::get<StereoPair>(b.pictures).left) << frame;
    EXPECT_EQ(std::get<StereoPair>(a.pictures).right, std::get<StereoPair>(b.pictures).right) << frame;
  }
}

TEST_F(FilmOfShots, DissolvesFromOnePaintingOfTheFrameToTheOther) {
  RotoscopeFilmOptions options = usual(), first = usual(), second = usual();
  options.shots = {{0, style_by_name("impressionist"), {}, {}, {}}, {3, style_by_name("mosaic"), {}, {}, {}, 3}};
  first.shots.resize(1);
  first.shots[0] = options.shots[0];
  second.shots = options.shots;
  second.shots[1].dissolve_frames = 0;
  FilmState film, alone, cut;
  for (int number = 0; number < film_frames; ++number) {
    const auto picture = [&](const RotoscopeFilmOptions& of, FilmState& state) {
      StereoPair eyes = eyes_of_frame(number);
      StereoFrame frame{std::move(eyes.left), std::move(eyes.right), number, {1, 25}, 1};
      return paint_film_frame(frame, of, true, state, {}).frame.picture;
    };
    const Image<Rgb8> made = picture(options, film), from = picture(first, alone), to = picture(second, cut);
    const int share = number < 3 ? 0 : std::min(number - 2, 4);
    int farthest = 0;
    for (std::size_t i = 0; i < made.pixels().size(); ++i) {
      const Rgb8 a = from.pixels()[i], b = to.pixels()[i], is = made.pixels()[i];
      const auto off = [&](int before, int after, int now) {
        return std::abs(4 * now - (number < 3 ? 4 * after : (4 - share) * before + share * after));
      };
      farthest = std::max({farthest, off(a.r, b.r, is.r), off(a.g, b.g, is.g), off(a.b, b.b, is.b)});
    }
    EXPECT_LE(farthest, 2) << number << ": rounded to the nearest level";
    EXPECT_EQ(film.outgoing.has_value(), number >= 3 && number < 6) << number;
  }
}

TEST_F(FilmOfShots, ThatBeginWhereCutsAreFoundIsTheFilmWithoutThem) {
  RotoscopeFilmOptions options = usual();
  options.frames.depth_budget = 0.03f;
  options.shots.clear();
  paint(file("plain.mkv"), options);
  for (const std::int64_t begin : {0, 3, 6}) options.shots.push_back({begin, options.frames.style, 0.03f, {}});
  paint(file("listed.mkv"), options);
  EXPECT_TRUE(bytes_of(file("listed.mkv")) == bytes_of(file("plain.mkv")));
}

TEST_F(FilmOfShots, HasTheSameBytesByRanksAndByAPlanAndWhenItWasStopped) {
  paint(file("whole.mkv"), usual());
  expect_same_however_made(usual(), file("whole.mkv"));
}

TEST_F(FilmOfShots, IsNotGoneOnWithByOthers) {
  RotoscopeFilmOptions options = usual();
  expect_error(ErrorKind::interrupted, "the first 4 frames are kept in ",
               [&] { paint(file("begun.mkv"), options, stop_after_five); });
  options.resume = true;
  options.shots[2].moving[1].keys[1].value = 0.4f;
  expect_error(ErrorKind::wrong_usage, "begun.mkv", [&] { paint(file("begun.mkv"), options); });
  options.shots = shots_of_film();
  options.on_twos = true;
  expect_error(ErrorKind::wrong_usage, "begun.mkv", [&] { paint(file("begun.mkv"), options); });
}

TEST_F(FilmOfShots, OnTwosShowsEachPaintingTwiceAndOneAtOnceWhereAShotBegins) {
  RotoscopeFilmOptions options = usual();
  options.on_twos = true;
  options.shots[1].begin = 1;
  options.marks = file("twos_%d.wst");
  options.writing.codec = "ffv1";
  const RotoscopedFilm twos = paint(file("twos.mkv"), options);
  EXPECT_EQ(twos.frames, film_frames);
  // Shots begin with 0, 1 and 3.
  const std::vector<Frame> frames = frames_of(file("twos.mkv"));
  ASSERT_EQ(frames.size(), std::size_t{film_frames});
  for (int i = 1; i < film_frames; ++i) {
    const bool same = i == 5 || i == 7;
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(frames[at].picture == frames[at - 1].picture, same) << i;
    EXPECT_EQ(bytes_of(file(fmt::format("twos_{}.wst", i + 1))) == bytes_of(file(fmt::format("twos_{}.wst", i))), same);
    EXPECT_GT(frames[at].pts, frames[at - 1].pts);
  }
  // The paintings are those of a film of every second frame.
  RotoscopeFilmOptions half = options;
  half.on_twos = false;
  half.reading.every = 2;
  half.marks = file("half_%d.wst");
  half.shots = {{0, options.shots[2].style, options.shots[2].depth_budget, options.shots[2].zero_parallax_px}};
  StereoFilmReader every_second = open_stereo_film(file("film.mkv"), {}, {.from_s = 3.5 / 25, .every = 2});
  rotoscope_film(every_second, file("half.mkv"), half);
  options.marks = file("late_%d.wst");
  options.shots = {{0, half.shots[0].style, {}, {}}, {4, half.shots[0].style, 0.01f, 2.f}};
  paint(file("late.mkv"), options);
  EXPECT_TRUE(bytes_of(file("late_5.wst")) == bytes_of(file("half_1.wst")));
  EXPECT_TRUE(bytes_of(file("late_7.wst")) == bytes_of(file("half_2.wst")));
}

TEST_F(FilmOfShots, OnTwosPaintsAFrameAnewForWhichThereIsAMap) {
  RotoscopeFilmOptions options = usual();
  options.on_twos = true;
  options.shots.resize(1);
  write_image(file("fine.png"), Image<std::uint8_t>(4, 4, 255));
  options.shots[0].style = style_by_name("oil");
  options.shots[0].maps = {{3, {file("fine.png"), {}}}};
  options.marks = file("mapped_%d.wst");
  paint(file("mapped.mkv"), options);
  for (const auto& [frame, same] : {std::pair{1, true}, {3, false}, {5, true}})
    EXPECT_EQ(
        bytes_of(file(fmt::format("mapped_{}.wst", frame + 1))) == bytes_of(file(fmt::format("mapped_{}.wst", frame))),
        same)
        << frame;
}

TEST_F(FilmOfShots, OnTwosHasTheSameBytesByRanksAndByAPlanAndWhenItWasStopped) {
  RotoscopeFilmOptions options = usual();
  options.on_twos = true;
  paint(file("twos_whole.mkv"), options);
  expect_same_however_made(options, file("twos_whole.mkv"));
}

TEST_F(FilmOfShots, OnTwosNeedsShotsAndCheckpointsBetweenPairs) {
  RotoscopeFilmOptions options = usual();
  options.on_twos = true;
  options.frames_between_checkpoints = 3;
  expect_error(ErrorKind::wrong_usage, "checkpoint: is 3, expected an even number",
               [&] { paint(file("odd.mkv"), options); });
  options.frames_between_checkpoints = 4;
  options.shots.clear();
  expect_error(ErrorKind::wrong_usage, "on twos: has no shots", [&] { paint(file("odd.mkv"), options); });
}

/// The horizontal shift between two pictures at which they differ least: x_left − x_right.
int shift_between(const Image<Rgb8>& left, const Image<Rgb8>& right) {
  constexpr int farthest = 12;
  int best = 0;
  double least = 1e300;
  for (int shift = -farthest; shift <= farthest; ++shift) {
    double sum = 0;
    for (int y = 0; y < left.height(); ++y)
      for (int x = farthest; x < left.width() - farthest; ++x)
        sum += std::abs(left(x, y).r - right(x - shift, y).r) + std::abs(left(x, y).g - right(x - shift, y).g);
    if (sum < least) {
      least = sum;
      best = shift;
    }
  }
  return best;
}

TEST_F(FilmOfShots, PutsTheDisparityThatIsAskedForOnTheScreen) {
  // A plane at a disparity of 6 pixels.
  const StereoPair eyes{moving_picture(160, 96, 0), moving_picture(160, 96, 0, 6)};
  const auto shift_with = [&](std::optional<float> zero_parallax_px) {
    RotoscopeOptions options;
    options.style = style_by_name("impressionist");
    options.zero_parallax_px = zero_parallax_px;
    RotoscopeState state;
    const auto pictures = std::get<StereoPair>(rotoscope_frame(eyes, options, state).pictures);
    return shift_between(pictures.left, pictures.right);
  };
  EXPECT_EQ(shift_with({}), 6);
  EXPECT_EQ(shift_with(6.f), 0);
  EXPECT_EQ(shift_with(2.f), 4);
}

TEST(MovingParameters, GoLinearlyInTimeFromKeyToKey) {
  FilmShot shot{.style = style_by_name("oil")};
  shot.moving = {{"zero-parallax", {{2, 8}, {4, -2}, {4.5, 0}}}, {"dry", {{3, 0.2f}, {5, 0.6f}}}};
  const auto at = [&](double seconds) { return options_of_frame({}, std::span(&shot, 1), 1, seconds); };
  const auto zero_parallax = [&](double seconds) { return at(seconds).zero_parallax_px; };
  EXPECT_EQ(zero_parallax(0), 8) << "before the first key";
  EXPECT_EQ(zero_parallax(2), 8);
  EXPECT_EQ(zero_parallax(2.5), 5.5f);
  EXPECT_EQ(zero_parallax(4), -2);
  EXPECT_EQ(zero_parallax(4.25), -1);
  EXPECT_EQ(zero_parallax(60), 0) << "after the last key";
  EXPECT_FLOAT_EQ(at(3.5).style.brush.dry, 0.3f);
  Style other = at(3.5).style;
  other.brush.dry = shot.style.brush.dry;
  EXPECT_EQ(other, shot.style) << "nothing else moves";
}

/// Frames of a shot whose number `name` goes from `first` to `last` in eight frames of a plane at a disparity of 6.
std::vector<RotoscopedFrame> moving_frames(const std::string& name, float first, float last, Style style) {
  const StereoPair eyes{moving_picture(160, 96, 0), moving_picture(160, 96, 0, 6)};
  const std::vector<FilmShot> shots{{0, std::move(style), {}, {}, {{name, {{time_s(1), first}, {time_s(7), last}}}}}};
  RotoscopeState state;
  std::vector<RotoscopedFrame> frames;
  for (int frame = 0; frame < 8; ++frame)
    frames.push_back(rotoscope_frame(eyes, options_of_frame({}, shots, frame, time_s(frame)), state));
  return frames;
}

/// The share of the way from the first key to the last that a frame has come.
float way(std::size_t frame) { return static_cast<float>(std::max<std::size_t>(frame, 1) - 1) / 6; }

TEST(MovingParameters, TheScreenPlaneTravelsThroughTheScene) {
  const std::vector<RotoscopedFrame> frames = moving_frames("zero-parallax", -2, 4, style_by_name("expressionist"));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& eyes = std::get<StereoPair>(frames[i].pictures);
    EXPECT_EQ(shift_between(eyes.left, eyes.right), std::lround(6 - (-2 + 6 * way(i)))) << i;
    EXPECT_TRUE(frames[i].showing.backgrounds.empty()) << "where the eyes are the film's own, too: " << i;
  }
}

TEST(MovingParameters, EyesComeNearerAsTheDepthBudgetFalls) {
  RotoscopeState state;
  const std::vector<FilmShot> shots{
      {0, style_by_name("posterise"), {}, {}, {{"depth-budget", {{time_s(0), 0.04f}, {time_s(7), 0.02f}}}}}};
  double last = 1;
  for (int frame = 0; frame < 8; ++frame) {
    const RotoscopeOptions options = options_of_frame({}, shots, frame, time_s(frame));
    const PlannedFilmFrame planned = plan_film_frame(eyes_of_scenes(0, {}), options, state);
    const float budget = 0.04f - 0.02f * static_cast<float>(frame) / 7;
    EXPECT_EQ(planned.eyes.separation, comfortable_eyes({96, 64}, state.depth.ends, budget).separation) << frame;
    EXPECT_LT(planned.eyes.separation, last) << frame;
    last = planned.eyes.separation;
  }
}

TEST(MovingParameters, AllStrokesTakeTheOpacityAndTheBrushAndNonePops) {
  const std::vector<RotoscopedFrame> thin = moving_frames("opacity", 1, 0.4f, style_by_name("impressionist"));
  const std::vector<RotoscopedFrame> dry = moving_frames("dry", 0, 0.6f, style_by_name("dual"));
  for (std::size_t i = 0; i < thin.size(); ++i) {
    std::int64_t strokes = 0, as_opaque = 0;
    for (const Layer& layer : layers_of(thin[i].painting))
      for (const Stroke& stroke : layer.strokes) {
        ++strokes;
        as_opaque += std::abs(stroke.opacity - (1 - 0.6f * way(i))) < 1e-5f ? 1 : 0;
      }
    EXPECT_GT(as_opaque, strokes * 9 / 10) << i;  // the others fade in or out
    EXPECT_NEAR(std::get<StrokePainting>(dry[i].painting.marks).brush.dry, 0.6f * way(i), 1e-6f);
    for (const RotoscopedFrame* frame : {&thin[i], &dry[i]}) {
      EXPECT_EQ(frame->changes.popped, 0) << i;
      EXPECT_GE(frame->changes.survived, frame->changes.whole * 9 / 10) << i;
    }
  }
}

}  // namespace wheatstone::film_shots_test
