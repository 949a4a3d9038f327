#include "wheatstone/app/rotoscope.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include <array>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include "psnr.h"
#include "scenes/moving_picture.h"
#include "throws_error.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/app/rotoscope_state_file_internal.h"
#include "wheatstone/files/struct_fields.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::rotoscope_test {

namespace fs = std::filesystem;

/// Cast once.
const StereoPair& eyes_of_frame(int frame, int cut = 0, int width = 96, int height = 64) {
  static std::map<std::array<int, 4>, StereoPair> made;
  const auto [at, is_new] = made.try_emplace({frame, cut, width, height});
  if (!is_new) return at->second;
  SyntheticFilmOptions options;
  options.still.width = width;
  options.still.height = height;
  options.still.samples_a_side = 1;
  options.frames = 12;
  options.cut = cut;
  return at->second = make_synthetic_film_frame(options, frame).pictures;
}

RotoscopedFrame next_frame(int frame, RotoscopeState& state) {
  return rotoscope_frame(eyes_of_frame(frame), {}, state);
}

RotoscopeState state_after(int frames) {
  RotoscopeState state;
  for (int frame = 0; frame < frames; ++frame) next_frame(frame, state);
  return state;
}

TEST(RotoscopeStateFile, ReadBackPaintsOnExactlyAsBefore) {
  const TemporaryFolder folder;
  RotoscopeState kept = state_after(3);
  write_rotoscope_state(folder / "state", kept);
  RotoscopeState read = read_rotoscope_state(folder / "state");
  EXPECT_EQ(read.frames, 3);
  EXPECT_EQ(read.totals, kept.totals);
  EXPECT_GT(read.totals.strokes, 0);
  for (int frame = 3; frame < 6; ++frame) {
    const RotoscopedFrame a = next_frame(frame, kept), b = next_frame(frame, read);
    EXPECT_EQ(std::get<StereoPair>(a.pictures).left, std::get<StereoPair>(b.pictures).left) << frame;
    EXPECT_EQ(std::get<StereoPair>(a.pictures).right, std::get<StereoPair>(b.pictures).right) << frame;
    EXPECT_FALSE(a.scene_begins);
    EXPECT_GT(a.changes.survived, 0) << "nothing was carried: the state was not put to the test";
  }
  EXPECT_EQ(read.totals, kept.totals);
}

TEST(RotoscopeStateFile, WrittenAgainItHasTheSameBytes) {
  const TemporaryFolder folder;
  write_rotoscope_state(folder / "a", state_after(2));
  write_rotoscope_state(folder / "b", read_rotoscope_state(folder / "a"));
  EXPECT_TRUE(bytes_of(folder / "a") == bytes_of(folder / "b"));
}

// Each kind of marks remembers other things.
TEST(RotoscopeStateFile, KeepsWhatEveryKindOfMarksRemembers) {
  for (const char* style : {"impressionist", "posterise", "mosaic", "diffusion"}) {
    RotoscopeOptions options;
    options.style = style_by_name(style);
    RotoscopeState state;
    for (int frame = 0; frame < 2; ++frame) rotoscope_frame(eyes_of_frame(frame), options, state);
    const std::string bytes = encode_rotoscope_state(state);
    RotoscopeState read = decode_rotoscope_state(bytes, "state");
    EXPECT_TRUE(encode_rotoscope_state(read) == bytes) << style;
    const RotoscopedFrame a = rotoscope_frame(eyes_of_frame(2), options, state);
    EXPECT_EQ(std::get<StereoPair>(a.pictures).left,
              std::get<StereoPair>(rotoscope_frame(eyes_of_frame(2), options, read).pictures).left)
        << style;
  }
}

TEST(RotoscopeStateFile, NumbersThatDoNotFitTogetherAreRefused) {
  const auto refused = [](const auto& change) {
    RotoscopeState state;
    state.left_before = Image<Rgb8>(8, 4);
    state.layers_before = {{2, {{}, {}}, {{.first_point = 1, .point_count = 1}}}};
    EXPECT_EQ(decode_rotoscope_state(encode_rotoscope_state(state), "s").layers_before, state.layers_before);
    change(state);
    const std::string bytes = encode_rotoscope_state(state);
    expect_error(ErrorKind::bad_input, "s: is damaged", [&] { decode_rotoscope_state(bytes, "s"); });
  };
  refused([](RotoscopeState& state) { state.layers_before[0].strokes[0].point_count = 2; });
  refused([](RotoscopeState& state) { state.layers_before[0].strokes[0].first_point = 0xffffffff; });
  refused([](RotoscopeState& state) { state.central_before = Image<Rgb8>(4, 8); });
  refused([](RotoscopeState& state) { state.memory.posterised.colour_of = Image<std::uint8_t>(8, 4); });
  refused([](RotoscopeState& state) { state.memory.strokes.views = {{{state.layers_before[0], {}}}}; });
  refused([](RotoscopeState& state) { state.frames_of_scene = 1; });
}

TEST(RotoscopeStateFile, OfAnotherVersionItIsRefusedWithAHint) {
  std::string bytes = encode_rotoscope_state({});
  bytes[12] = static_cast<char>(bytes[12] + 1);  // the layout
  const auto checksum = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data() + 12), bytes.size() - 12));  // NOLINT: zlib's own type
  std::memcpy(bytes.data() + 8, &checksum, sizeof(checksum));
  expect_error(ErrorKind::bad_input, "s: was written by another version", [&] { decode_rotoscope_state(bytes, "s"); });
}

// Seeds of an older layout are refused at once, and test nothing.
TEST(RotoscopeStateFile, SeedsOfTheFuzzerAreRead) {
  for (const fs::directory_entry& seed : fs::directory_iterator(fs::path(WHEATSTONE_FUZZ_CORPUS) / "rotoscope_state"))
    EXPECT_NO_THROW(decode_rotoscope_state(rotoscope_state_with_checksum(bytes_of(seed.path())), "a seed"))
        << seed.path() << ": make it anew, as encode_rotoscope_state without its 16 bytes of head";
}

TEST(RotoscopeStateFile, TheEmptyStateIsReadBack) {
  const TemporaryFolder folder;
  write_rotoscope_state(folder / "a", {});
  const RotoscopeState read = read_rotoscope_state(folder / "a");
  EXPECT_EQ(read.frames, 0);
  EXPECT_TRUE(read.left_before.empty());
  EXPECT_FALSE(read.range.has_value());
}

TEST(RotoscopeStateFile, DamagedInAnyPlaceItIsRefused) {
  const TemporaryFolder folder;
  RotoscopeState state = state_after(1);
  write_rotoscope_state(folder / "state", state);
  const std::string whole = bytes_of(folder / "state");
  const auto refused = [&](const std::string& bytes) {
    put_bytes(folder / "state", bytes);
    expect_error(ErrorKind::bad_input, "state: is damaged", [&] { read_rotoscope_state(folder / "state"); });
  };
  for (std::size_t size = 0; size < 200; ++size) refused(whole.substr(0, size));
  for (std::size_t part = 1; part < 40; ++part) refused(whole.substr(0, whole.size() * part / 40));
  refused(whole.substr(0, whole.size() - 1));
  refused(whole + "x");
  std::mt19937 random(7);
  for (int flip = 0; flip < 200; ++flip) {
    // Half of them in front, where the lengths are.
    const std::size_t last = flip % 2 == 0 ? 99 : whole.size() - 1;
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, last)(random);
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (flip % 8)));
    refused(bytes);
  }
}

TEST(Rotoscope, ASceneBeginsAtACut) {
  RotoscopeState state;
  std::vector<bool> begins;
  for (int frame = 0; frame < 6; ++frame)
    begins.push_back(rotoscope_frame(eyes_of_frame(frame, 3, 160, 96), {}, state).scene_begins);
  EXPECT_THAT(begins, testing::ElementsAre(true, false, false, true, false, false));
  EXPECT_EQ(state.totals.scenes, 2);
  EXPECT_EQ(state.frames_of_scene, 3);
}

StereoPair eyes_of_still(int frame, float noise) {
  SyntheticFilmOptions options;
  options.still.width = 192;
  options.still.height = 108;
  options.still.samples_a_side = 1;
  options.frames = 16;
  options.scene = FilmScene::still;
  options.noise = noise;
  return make_synthetic_film_frame(options, frame).pictures;
}

// The depth is looked at again at the eighth frame.
TEST(Rotoscope, WhereNothingMovesFramesAreEqualOnceTheFadesHaveEnded) {
  const StereoPair eyes = eyes_of_still(0, 0);
  ASSERT_EQ(eyes.left, eyes_of_still(5, 0).left) << "the film moves";
  constexpr int fades_end = 6, frames = 9;
  RotoscopeState state;
  StereoPair last;
  for (int frame = 0; frame < frames; ++frame) {
    RotoscopedFrame painted = rotoscope_frame(eyes, {}, state);
    if (frame > fades_end) {
      EXPECT_EQ(std::get<StereoPair>(painted.pictures).left, last.left) << frame;
      EXPECT_EQ(std::get<StereoPair>(painted.pictures).right, last.right) << frame;
      EXPECT_EQ(painted.counts.begun, 0) << frame;
    }
    last = std::get<StereoPair>(std::move(painted.pictures));
  }
}

/// Sum of the squared differences of two frames' levels.
double squared_change(ImageView<const Rgb8> before, ImageView<const Rgb8> now) {
  double sum = 0;
  for (int y = 0; y < now.height(); ++y) {
    for (int x = 0; x < now.width(); ++x) {
      const Rgb8 a = before(x, y), b = now(x, y);
      const double red = a.r - b.r, green = a.g - b.g, blue = a.b - b.b;
      sum += red * red + green * green + blue * blue;
    }
  }
  return sum;
}

TEST(Rotoscope, NoiseAloneMovesThePaintingLittleMoreThanTheFilm) {
  constexpr float noise = 3;
  constexpr int frames = 5;
  RotoscopeState state;
  StereoPair last_eyes, last;
  double of_film = 0, of_painting = 0;
  for (int frame = 0; frame < frames; ++frame) {
    StereoPair eyes = eyes_of_still(frame, noise);
    StereoPair painted = std::get<StereoPair>(rotoscope_frame(eyes, {}, state).pictures);
    if (frame > 0) {
      of_film += squared_change(last_eyes.left, eyes.left) + squared_change(last_eyes.right, eyes.right);
      of_painting += squared_change(last.left, painted.left) + squared_change(last.right, painted.right);
    }
    last_eyes = std::move(eyes);
    last = std::move(painted);
  }
  EXPECT_GT(of_film, 0);
  EXPECT_LE(of_painting, 1.5 * of_film);
}

TEST(Rotoscope, OneEyeGivesOneEye) {
  RotoscopeState state;
  for (int frame = 0; frame < 3; ++frame) {
    const RotoscopedFrame painted = rotoscope_frame({moving_picture(96, 64, frame), {}}, {}, state);
    ASSERT_TRUE(std::holds_alternative<Image<Rgb8>>(painted.pictures));
    const auto& picture = std::get<Image<Rgb8>>(painted.pictures);
    EXPECT_EQ(picture.width(), 96);
    EXPECT_EQ(painted.scene_begins, frame == 0);
    EXPECT_GT(psnr_db(picture, moving_picture(96, 64, frame)), psnr_db(picture, moving_picture(96, 64, frame + 20)));
  }
}

TEST(Rotoscope, ADetailMapMovesWithTheFilm) {
  constexpr int width = 240, height = 120, step_px = 6, frames = 4;
  const TemporaryFolder folder;
  Image<std::uint8_t> map(width, height, 40);
  for (int y = 0; y < height; ++y)
    for (int x = 60; x < 120; ++x) map(x, y) = 255;
  write_image(folder / "detail.png", map);
  const auto fine_strokes = [&](bool with_map) {
    RotoscopeOptions options;
    options.style = style_by_name("oil");
    RotoscopeState state;
    std::vector<int> fine;  // that begin where the bright part of the map is now
    for (int i = 0; i < frames; ++i) {
      options.maps.detail = with_map && i == 0 ? folder / "detail.png" : fs::path();
      // A picture that moves to the right; both eyes see the same.
      const Image<Rgb8> picture = moving_picture(width, height, 0, -step_px * i);
      const Image<float> flat(width, height), ahead(width, height, step_px), back(width, height, -step_px);
      KnownFrame known{geometry_from_both(flat, flat), {}};
      if (i > 0) known.flow = FlowPair{{ahead, flat}, {back, flat}};
      const RotoscopedFrame frame = rotoscope_frame({picture, picture}, options, state, &known);
      EXPECT_EQ(state.detail.empty(), !with_map);
      const int from = 60 + step_px * i, to = 120 + step_px * i;
      if (with_map) {
        EXPECT_EQ(state.detail(from + 2, 60), 255) << i;
        EXPECT_EQ(state.detail(to - 3, 60), 255) << i;
        EXPECT_EQ(state.detail(from - 3, 60), 40) << i;
        EXPECT_EQ(state.detail(to + 2, 60), 40) << i;
        EXPECT_EQ(i == 0 ? even_detail : state.detail(0, 60), even_detail) << "nothing is known of what came in";
      }
      int count = 0;
      for (const Layer& layer : layers_of(frame.painting))
        for (const Stroke& stroke : layer.strokes) {
          const float x = layer.points_of(stroke).front().x;
          count += x >= static_cast<float>(from) && x < static_cast<float>(to) ? 1 : 0;
        }
      fine.push_back(count);
    }
    return fine;
  };
  const std::vector<int> with_map = fine_strokes(true), without = fine_strokes(false);
  for (std::size_t i = 0; i < frames; ++i) EXPECT_GT(with_map[i], 1.2 * without[i]) << i;
}

TEST(Rotoscope, SizesThatChangeAreRefused) {
  RotoscopeState state = state_after(1);
  expect_error(ErrorKind::bad_input, "the frame is 80x64 pixels, expected 96x64 as before",
               [&] { rotoscope_frame(eyes_of_frame(1, 0, 80, 64), {}, state); });
  expect_error(ErrorKind::bad_input, "the right eye's picture is 80x64 pixels", [&] {
    rotoscope_frame({eyes_of_frame(1).left, eyes_of_frame(1, 0, 80, 64).right}, {}, state);
  });
}

/// Changes the `place`-th value in a record of options, through all structs in it; false where there are fewer.
template <class Value>
bool change_value(Value& value, int& place) {
  if constexpr (std::is_same_v<Value, std::string> || std::is_same_v<Value, std::filesystem::path>) {
    if (place-- == 0) value += "x";
  } else if constexpr (std::is_same_v<Value, bool>) {
    if (place-- == 0) value = !value;
  } else if constexpr (std::is_enum_v<Value>) {
    if (place-- == 0) value = static_cast<Value>(static_cast<int>(value) + 1);
  } else if constexpr (std::is_arithmetic_v<Value>) {
    if (place-- == 0) value = static_cast<Value>(value + 1);
  } else if constexpr (requires { value.emplace(); }) {
    if (place-- == 0) value.emplace();
  } else if constexpr (requires { value.emplace_back(); }) {
    if (place-- == 0) value.emplace_back();
  } else {
    for_each_field(value, [&](auto& field) {
      if (place >= 0) change_value(field, place);
    });
  }
  return place < 0;
}

// Whatever changes a byte keeps a run from going on with another's rest.
TEST(RotoscopeRecipe, TellsEveryOptionOfAFrameFromItsDefault) {
  const std::string usual = recipe_of({});
  int same = 0, changed = 0;
  for (int place = 0;; ++place) {
    RotoscopeFilmOptions options;
    int left = place;
    if (!change_value(options.frames, left)) break;
    ++changed;
    same += recipe_of(options) == usual ? 1 : 0;
  }
  EXPECT_GE(changed, 50);
  EXPECT_EQ(same, 2) << "only the networks' names, whose content is compared, may be missing";
  RotoscopeFilmOptions options;
  options.frames.matching.model_values = NetworkValues::imagenet;
  EXPECT_NE(recipe_of(options), usual);
  options = {};
  options.frames.widest_matched_px = 640;
  EXPECT_NE(recipe_of(options), usual);
  options = {};
  options.frames.matching.wls_lambda = 8000;
  EXPECT_NE(recipe_of(options), usual);
  options = {};
  options.reading.every = 2;
  EXPECT_NE(recipe_of(options), usual);
  options = {};
  options.marks = "m_%d.wst";
  EXPECT_NE(recipe_of(options), usual);
  options = {};
  options.resume = options.keep_going = true;
  options.reading.threads = 2;
  options.expected_frames = 9;
  EXPECT_EQ(recipe_of(options), usual);
}

/// A film of one eye, painted into "o.mp4".
RotoscopedFilm paint_film(const TemporaryFolder& folder, const RotoscopeFilmOptions& options,
                          const std::string& name = "o.mp4", const Progress& progress = {}) {
  StereoFilmReader source = open_stereo_film(folder / "a.mp4", StereoLayout::mono);
  return rotoscope_film(source, folder / name, options, progress);
}

TEST(RotoscopeFilm, StoppedWhileItJoinsItJoinsAgain) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 6, {.preset = "ultrafast"});
  // The last interval is not full: 4 + 2, and one that never closes by itself.
  for (const int between : {4, 48}) {
    RotoscopeFilmOptions options;
    options.frames_between_checkpoints = between;
    const RotoscopedFilm whole = paint_film(folder, options, "whole.mp4");
    const Progress stop = [](std::string_view step, double) {
      if (step == "join") throw Error(ErrorKind::interrupted, "interrupted");
    };
    expect_error(ErrorKind::interrupted, "the first 6 frames are kept in ",
                 [&] { paint_film(folder, options, "o.mp4", stop); });
    EXPECT_FALSE(fs::exists(folder / "o.mp4"));
    options.resume = true;
    const RotoscopedFilm resumed = paint_film(folder, options);
    EXPECT_EQ(resumed.frames, 6);
    EXPECT_EQ(resumed.resumed_frames, 6);
    EXPECT_EQ(resumed.totals, whole.totals);
    EXPECT_TRUE(bytes_of(folder / "o.mp4") == bytes_of(folder / "whole.mp4"));
    EXPECT_FALSE(fs::exists(folder / "o.mp4.part"));
    fs::remove(folder / "o.mp4");
  }
}

// A run may be killed when the film of one eye has closed a segment and that of the other has not yet.
TEST(RotoscopeFilm, AFilmForEachEyeGoesOnWhereTheShorterOneEnds) {
  const TemporaryFolder folder;
  {
    FilmWriter writer(folder / "a.mp4", {.preset = "ultrafast", .layout = StereoLayout::left_right});
    for (int i = 0; i < 6; ++i)
      writer.write({put_together(moving_picture(64, 48, i), moving_picture(64, 48, i, 3), StereoLayout::left_right),
                    i,
                    {1, 25},
                    1});
    writer.finish();
  }
  RotoscopeFilmOptions options;
  options.frames_between_checkpoints = 2;
  const auto paint = [&](const std::string& name, const Progress& progress = {}) {
    options.right_film = folder / (name + "_right.mp4");
    StereoFilmReader source = open_stereo_film(folder / "a.mp4", StereoLayout::left_right);
    return rotoscope_film(source, folder / (name + "_left.mp4"), options, progress);
  };
  paint("whole");
  const Progress stop = [](std::string_view step, double) {
    if (step.starts_with("painting frame 5")) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "the first 4 frames are kept", [&] { paint("o", stop); });
  for (const char* file : {"seg_000001.mkv", "seg_000001.json"})
    ASSERT_TRUE(fs::remove(folder / "o_right.mp4.part" / file)) << file;
  // The state of the frames before, which is there until both films have closed the segment.
  options.resume = true;
  {
    RotoscopeFilmOptions before = options;
    before.resume = false;
    before.right_film = folder / "b_right.mp4";
    StereoFilmReader source = open_stereo_film(folder / "a.mp4", StereoLayout::left_right);
    const Progress earlier = [](std::string_view step, double) {
      if (step.starts_with("painting frame 3")) throw Error(ErrorKind::interrupted, "interrupted");
    };
    expect_error(ErrorKind::interrupted, "the first 2 frames are kept",
                 [&] { rotoscope_film(source, folder / "b_left.mp4", before, earlier); });
    fs::copy_file(folder / "b_left.mp4.part/state_000000002", folder / "o_left.mp4.part/state_000000002",
                  fs::copy_options::overwrite_existing);
  }
  EXPECT_EQ(paint("o").resumed_frames, 2);
  for (const char* eye : {"left", "right"})
    EXPECT_TRUE(bytes_of(folder / (std::string("o_") + eye + ".mp4")) ==
                bytes_of(folder / (std::string("whole_") + eye + ".mp4")))
        << eye;
  EXPECT_FALSE(fs::exists(folder / "o_left.mp4.part"));
  EXPECT_FALSE(fs::exists(folder / "o_right.mp4.part"));
}

TEST(RotoscopeFilm, OtherMatchingOrAnotherNetworkIsNotGoneOnWith) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 6, {.preset = "ultrafast"});
  put_bytes(folder / "network.onnx", "one");
  RotoscopeFilmOptions options;
  options.frames_between_checkpoints = 2;
  options.frames.matching.model = folder / "network.onnx";  // of one eye nothing is matched
  const Progress stop = [](std::string_view step, double) {
    if (step.starts_with("painting frame 5")) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "the first 4 frames are kept",
               [&] { paint_film(folder, options, "o.mp4", stop); });
  options.resume = true;
  const auto refused = [&](const RotoscopeFilmOptions& other) {
    expect_error(ErrorKind::wrong_usage, "left by a run with other options", [&] { paint_film(folder, other); });
  };
  RotoscopeFilmOptions other = options;
  other.frames.matching.wls_sigma = 2;
  refused(other);
  other = options;
  other.frames.widest_flow_px = 480;
  refused(other);
  other = options;
  other.writing.copy_audio = false;
  refused(other);
  put_bytes(folder / "network.onnx", "two");
  refused(options);
  put_bytes(folder / "network.onnx", "one");
  EXPECT_EQ(paint_film(folder, options).resumed_frames, 4);
}

TEST(RotoscopeFilm, ASecondRunIsToldOfTheFirst) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 4, {.preset = "ultrafast"});
  RotoscopeFilmOptions options;
  options.frames_between_checkpoints = 1;
  bool tried = false;
  const Progress second = [&](std::string_view step, double) {
    if (tried || !step.starts_with("painting frame 2")) return;
    tried = true;
    expect_error(ErrorKind::wrong_usage, "o.mp4: another run is painting it", [&] { paint_film(folder, options); });
  };
  EXPECT_EQ(paint_film(folder, options, "o.mp4", second).frames, 4);
  EXPECT_TRUE(tried);
}

TEST(RotoscopeFilm, MarksGetTheirNamesWhenTheFilmIsWhole) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 4, {.preset = "ultrafast"});
  const auto found = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder / "")) names.insert(entry.path().filename());
    return names;
  };
  const Progress stop = [](std::string_view step, double) {
    if (step.starts_with("painting frame 3")) throw Error(ErrorKind::interrupted, "interrupted");
  };
  // Marks alone cannot be gone on with, and a film not before its first checkpoint.
  expect_error(ErrorKind::interrupted, "interrupted", [&] { paint_film(folder, {}, "m_%04d.wst", stop); });
  EXPECT_EQ(found(), std::set<std::string>{"a.mp4"});
  RotoscopeFilmOptions options;
  options.marks = folder / "m_%04d.wst";
  expect_error(ErrorKind::interrupted, "interrupted", [&] { paint_film(folder, options, "o.mp4", stop); });
  EXPECT_EQ(found(), std::set<std::string>{"a.mp4"});

  options.frames_between_checkpoints = 2;
  expect_error(ErrorKind::interrupted, "m_%04d.wst.part", [&] { paint_film(folder, options, "o.mp4", stop); });
  EXPECT_EQ(found(), (std::set<std::string>{"a.mp4", "m_%04d.wst.part", "o.mp4.part"}));
  options.resume = true;
  EXPECT_EQ(paint_film(folder, options).resumed_frames, 2);
  EXPECT_EQ(found(), (std::set<std::string>{"a.mp4", "m_0001.wst", "m_0002.wst", "m_0003.wst", "m_0004.wst", "o.mp4"}));
  fs::remove(folder / "o.mp4");
  options.resume = false;
  expect_error(ErrorKind::wrong_usage, "m_0001.wst exists already", [&] { paint_film(folder, options); });
}

TEST(RotoscopeFilm, ADamagedRestIsNamedAndNotRemoved) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 6, {.preset = "ultrafast"});
  RotoscopeFilmOptions options;
  options.frames_between_checkpoints = 2;
  const Progress stop = [](std::string_view step, double) {
    if (step.starts_with("painting frame 5")) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "the first 4 frames are kept",
               [&] { paint_film(folder, options, "o.mp4", stop); });
  const fs::path state = folder / "o.mp4.part/state_000000004";
  ASSERT_TRUE(fs::exists(state));
  EXPECT_FALSE(fs::exists(folder / "o.mp4.part/state_000000002")) << "only the last state is kept";
  const std::string whole = bytes_of(state);
  put_bytes(state, whole.substr(0, 100));
  options.resume = true;
  expect_error(ErrorKind::bad_input, "state_000000004: is damaged", [&] { paint_film(folder, options); });
  put_bytes(state, whole);
  EXPECT_EQ(paint_film(folder, options).resumed_frames, 4);
}

}  // namespace wheatstone::rotoscope_test
