#include "wheatstone/app/shots_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "scenes/moving_picture.h"
#include "throws_error.h"
#include "wheatstone/app/place_shots.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::shots_file_test {

namespace fs = std::filesystem;
using testing::ElementsAre;

TEST(ShotsFile, SetsWhatAShotNamesAndLeavesTheRestAsForAll) {
  RotoscopeOptions all;
  all.style = style_by_name("impressionist");
  all.style.seed = 7;
  all.depth_budget = 0.03f;
  all.zero_parallax_px = 2;
  const std::vector<WrittenShot> shots = parse_shots(R"([[shot]]
begin = 1
[[shot]]
begin = "0:02.5"
last = 90
radii = [9, 3]
depth-budget = "5%"
[[shot]]
begin = 91
style = "mosaic"
depth-budget = "full"
zero-parallax = -4.5
)",
                                                     "s.toml", all);
  ASSERT_EQ(shots.size(), 3u);
  EXPECT_EQ(std::get<std::int64_t>(shots[0].begin), 1);
  EXPECT_EQ(shots[0].painted.style, all.style);
  EXPECT_EQ(shots[0].painted.depth_budget, 0.03f);
  EXPECT_EQ(shots[0].painted.zero_parallax_px, 2);
  EXPECT_EQ(std::get<double>(shots[1].begin), 2.5);
  EXPECT_EQ(shots[1].last, 90);
  Style radii = all.style;
  radii.radii_px = {9, 3};
  EXPECT_EQ(shots[1].painted.style, radii);
  EXPECT_EQ(shots[1].painted.depth_budget, 0.05f);
  EXPECT_EQ(shots[2].painted.style.marks, Marks::tiles);
  EXPECT_EQ(shots[2].painted.style.seed, 7u);
  EXPECT_EQ(shots[2].painted.depth_budget, std::nullopt);
  EXPECT_EQ(shots[2].painted.zero_parallax_px, -4.5f);
  EXPECT_EQ(shots[2].where, "s.toml: shot 3, line 8");
}

TEST(ShotsFile, NamesStyleFilesAsSeenFromItsFolder) {
  const TemporaryFolder folder;
  put_bytes(folder / "loose.toml", "style = \"impressionist\"\ngrid = 2.0\n");
  put_bytes(folder / "shots.toml", "[[shot]]\nbegin = 1\nstyle = \"loose.toml\"\ncurvature = 0.5\n");
  const std::vector<WrittenShot> shots = read_shots(folder / "shots.toml", {});
  EXPECT_EQ(shots.at(0).painted.style.grid, 2);
  EXPECT_EQ(shots.at(0).painted.style.curvature, 0.5);
}

TEST(ShotsFile, HasKeysOfNumbersThatMove) {
  const std::vector<WrittenShot> shots = parse_shots(R"([[shot]]
begin = 1
depth-budget = "full"
[[shot.key]]
at = 3
streaks = 4
zero-parallax = 7.5
[[shot.key]]
at = "0:01.5"
dry = 0.25
[[shot]]
begin = 91
)",
                                                     "s.toml", {});
  ASSERT_EQ(shots.at(0).keys.size(), 2u);
  EXPECT_TRUE(shots.at(1).keys.empty());
  const WrittenKey &first = shots[0].keys[0], &second = shots[0].keys[1];
  EXPECT_EQ(std::get<std::int64_t>(first.at), 3);
  EXPECT_EQ(std::get<double>(second.at), 1.5);
  ASSERT_EQ(first.values.size(), 2u);
  EXPECT_EQ(first.values[0].parameter, "streaks");
  EXPECT_EQ(first.values[0].value, 4);
  EXPECT_EQ(first.values[1].value, 7.5f);
  EXPECT_EQ(second.values.at(0).value, 0.25f);
  EXPECT_EQ(second.where, "s.toml: shot 1, key 2, line 8");
}

TEST(ShotsFile, HasMapsAsSeenFromItsFolder) {
  const TemporaryFolder folder;
  write_image(folder / "d.png", Image<std::uint8_t>(8, 4, 200));
  const std::string shots = "[[shot]]\nbegin = 1\nstyle = \"oil\"\ndetail-map = \"d.png\"\ndisparity = \"d.png\"\n";
  put_bytes(folder / "s.toml", shots + "[[shot.key]]\nat = 5\ndetail-map = \"d.png\"\n");
  const std::vector<WrittenShot> read = read_shots(folder / "s.toml", {});
  EXPECT_EQ(read.at(0).maps.detail, folder / "d.png");
  EXPECT_EQ(read.at(0).maps.disparity, folder / "d.png");
  EXPECT_EQ(read.at(0).keys.at(0).maps.detail, folder / "d.png");
  EXPECT_TRUE(read.at(0).keys.at(0).maps.disparity.empty());
  EXPECT_TRUE(read.at(0).keys.at(0).values.empty());
  const auto refused = [&](const std::string& toml, const std::string& why) {
    put_bytes(folder / "w.toml", toml);
    expect_error(ErrorKind::bad_input, why, [&] { read_shots(folder / "w.toml", {}); });
  };
  refused("[[shot]]\nbegin = 1\nstyle = \"oil\"\ndetail-map = \"none.png\"\n", "w.toml: shot 1, line 4: ");
  refused("[[shot]]\nbegin = 1\nstyle = \"oil\"\ndetail-map = 5\n", "'detail-map' is not the name of a file");
  refused("[[shot]]\nbegin = 1\nstyle = \"mosaic\"\ndetail-map = \"d.png\"\n",
          "shot 1, line 4: style mosaic: takes no detail map");
  refused("[[shot]]\nbegin = 1\n[[shot.key]]\nat = 3\ndisparity = \"none.pfm\"\n", "w.toml: shot 1, key 1, line 5: ");
  refused(shots + "[[shot.key]]\nat = 5\n", "gives no number, expected detail-map, disparity or one of");
}

TEST(ShotsFile, ThatWasListedChangesNothing) {
  const std::vector<FoundShot> found{{0, 5, 0, 0.2, "a_001.jpg"}, {5, 4, 0.2, 0.16, "a_002.jpg"}};
  RotoscopeOptions all;
  all.style = style_by_name("pointillist");
  all.depth_budget = 0.02f;
  const std::string text = shots_file_text(found);
  const std::vector<WrittenShot> shots = parse_shots(text, "s.toml", all);
  ASSERT_EQ(shots.size(), 2u);
  EXPECT_EQ(std::get<std::int64_t>(shots[1].begin), 6);
  for (const WrittenShot& shot : shots) {
    EXPECT_EQ(shot.painted.style, all.style);
    EXPECT_EQ(shot.painted.depth_budget, all.depth_budget);
    EXPECT_EQ(shot.last, std::nullopt);
  }
  // What stands there as a comment is understood.
  std::string set = text;
  for (std::size_t at = 0; (at = set.find("\n# ", at)) != std::string::npos;)
    if (set.compare(at, 7, "\n# The ") != 0 && set.find("[[shot]]  #") < at) {
      set.replace(at, 3, "\n");
    } else {
      at += 3;
    }
  EXPECT_EQ(parse_shots(set, "s.toml", all).at(1).painted.zero_parallax_px, 0);
}

TEST(ShotsFile, ThatIsWrongIsRefusedWithItsPlace) {
  const std::array<std::array<std::string, 2>, 19> files{{
      {"", "s.toml: has no shots, expected [[shot]] tables"},
      {"[[shot]\n", "s.toml: line 1: "},
      {"[[shots]]\nbegin = 1\n", "s.toml: line 1: unknown key 'shots'"},
      {"shot = [1]\n", "s.toml: shot 1: is no table"},
      {"[[shot]]\n", "s.toml: shot 1, line 1: has no 'begin'"},
      {"[[shot]]\nbegin = 0\n", "s.toml: shot 1, line 2: 'begin' is not a frame"},
      {"[[shot]]\nbegin = 1.5\n", "'begin' is not a frame, counted from 1, or a time"},
      {"[[shot]]\nbegin = \"1:75\"\n", "'begin' is not a frame, counted from 1, or a time"},
      {"[[shot]]\nbegin = 1\nlast = \"a\"\n", "s.toml: shot 1, line 3: 'last' is not a frame"},
      {"[[shot]]\nbegin = 1\n[[shot]]\nbegin = 2\nstile = 1\n", "s.toml: shot 2, line 5: unknown key 'stile'"},
      {"[[shot]]\nbegin = 1\nstyle = \"oils\"\n", "s.toml: shot 1, line 3: style: there is no 'oils'"},
      {"[[shot]]\nbegin = 1\nstyle = \"not/there.toml\"\n", "not/there.toml: cannot be opened"},
      {"[[shot]]\nbegin = 1\ngrid = \"wide\"\n", "s.toml: shot 1: grid: is 'wide', expected a number"},
      {"[[shot]]\nbegin = 1\ngrid = { a = 1 }\n", "s.toml: shot 1: grid: is 'a table or date', expected a number"},
      {"[[shot]]\nbegin = 1\nstyle = \"mosaic\"\ngrid = 2.0\n", "line 4: 'grid' has no effect on a painting of tiles"},
      {"[[shot]]\nbegin = 1\npropagation = \"raster\"\n",
       "line 3: 'propagation' has no effect on the strokes of a film"},
      {"[[shot]]\nbegin = 1\ndepth-budget = 3\n", "line 3: 'depth-budget' is not a share of the width"},
      {"[[shot]]\nbegin = 1\ndepth-budget = \"3\"\n", "line 3: 'depth-budget' is not a share of the width"},
      {"[[shot]]\nbegin = 1\nzero-parallax = nan\n", "line 3: 'zero-parallax' is not a disparity in pixels"},
  }};
  for (const auto& [text, message] : files)
    expect_error(ErrorKind::bad_input, message, [&text = text] { parse_shots(text, "s.toml", {}); });
  const std::string first = "[[shot]]\nbegin = 1\n[[shot.key]]\nat = 1\n";
  const std::array<std::array<std::string, 2>, 12> keys{{
      {"[[shot]]\nbegin = 1\nkey = 2\n", "s.toml: shot 1, line 3: 'key' is not [[shot.key]] tables"},
      {"[[shot]]\nbegin = 1\nkey = [2]\n", "s.toml: shot 1, key 1: is no table, expected [[shot.key]]"},
      {"[[shot]]\nbegin = 1\n[[shot.key]]\ndry = 1\n", "s.toml: shot 1, key 1, line 3: has no 'at', expected a frame"},
      {first,
       "s.toml: shot 1, key 1, line 3: gives no number, expected detail-map, disparity or one of depth-budget, "
       "zero-parallax, "
       "opacity"},
      {first + "radii = [4]\n", "s.toml: shot 1, key 1, line 5: 'radii' does not move, expected at and one of depth-"},
      {first + "style = \"oil\"\n", "s.toml: shot 1, key 1, line 5: 'style' does not move"},
      {first + "strokez = 2\n", "s.toml: shot 1, key 1, line 5: unknown key 'strokez', expected at and one of depth-"},
      {first + "opacity = 2\n", "s.toml: shot 1, key 1: style: opacity is 2, expected 0.01 to 1"},
      {first + "depth-budget = \"full\"\n", "key 1, line 5: 'depth-budget' is not a share of the width, which moves"},
      {first + "zero-parallax = \"5\"\n", "key 1, line 5: 'zero-parallax' is not a disparity in pixels"},
      {"[[shot]]\nbegin = 1\nstyle = \"mosaic\"\n[[shot.key]]\nat = 2\ndry = 0.5\n",
       "s.toml: shot 1, key 1, line 6: 'dry' has no effect on a painting of tiles"},
      {"[[shot]]\nbegin = 1\ndry = 1\n[[shot.key]]\nat = 2\ndry = 0.5\n",
       "s.toml: shot 1, key 1, line 6: 'dry' is also set by the shot; leave it out there, or in its keys"},
  }};
  for (const auto& [text, message] : keys)
    expect_error(ErrorKind::bad_input, message, [&text = text] { parse_shots(text, "s.toml", {}); });
  const std::array<UnusedKey, 2> unused{{{"depth-budget", "on marks (.wst)"}, {"zero-parallax", "in a key", true}}};
  parse_shots("[[shot]]\nbegin = 1\nzero-parallax = 2\n", "s.toml", {}, unused);
  expect_error(ErrorKind::bad_input, "s.toml: shot 1, key 1, line 5: 'zero-parallax' has no effect in a key",
               [&] { parse_shots(first + "zero-parallax = 2\n", "s.toml", {}, unused); });
  expect_error(ErrorKind::bad_input, "s.toml: shot 1, line 3: 'depth-budget' has no effect on marks (.wst)",
               [&] { parse_shots("[[shot]]\nbegin = 1\ndepth-budget = \"3%\"\n", "s.toml", {}, unused); });
}

/// Where shots of a film of 20 frames at 25 a second begin.
class PlacedShots : public testing::Test {
 protected:
  PlacedShots() { make_film(folder_ / "a.mkv", 20, {.preset = "ultrafast"}); }
  std::vector<FilmShot> placed(const std::string& toml, const FilmReaderOptions& reading = {}) const {
    return place_shots(parse_shots(toml, "s.toml", {}), {folder_ / "a.mkv", {}, StereoLayout::mono}, reading);
  }
  std::vector<std::int64_t> begins(const std::string& toml, const FilmReaderOptions& reading = {}) const {
    std::vector<std::int64_t> begins;
    for (const FilmShot& shot : placed(toml, reading)) begins.push_back(shot.begin);
    return begins;
  }
  void expect_refused(const std::string& toml, const std::string& message) const {
    expect_error(ErrorKind::bad_input, message, [&] { begins(toml); });
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(PlacedShots, BeginWithTheFrameThatTheyNameOrThatIsShownThen) {
  EXPECT_THAT(begins("[[shot]]\nbegin = 1\n[[shot]]\nbegin = 6\n[[shot]]\nbegin = \"0:00.48\"\n"),
              ElementsAre(0, 5, 12));
  EXPECT_THAT(begins("[[shot]]\nbegin = \"0\"\nlast = 10\n[[shot]]\nbegin = 11\nlast = 20\n"), ElementsAre(0, 10));
  EXPECT_THAT(begins("[[shot]]\nbegin = 1\n[[shot]]\nbegin = \"0.45\"\n"), ElementsAre(0, 12)) << "as --from";
}

TEST_F(PlacedShots, OfAPartOfTheFilmAreThoseThatItHasFramesOf) {
  const std::string toml = "[[shot]]\nbegin = 1\n[[shot]]\nbegin = 6\n[[shot]]\nbegin = 13\n[[shot]]\nbegin = 18\n";
  EXPECT_THAT(begins(toml, {.from_s = 0.32, .to_s = 0.6}), ElementsAre(0, 4));
  EXPECT_THAT(begins(toml, {.every = 4}), ElementsAre(0, 2, 3));
}

TEST_F(PlacedShots, HaveTheirKeysAtTheTimesOfFrames) {
  const std::string toml =
      "[[shot]]\nbegin = 1\n[[shot]]\nbegin = 6\n[[shot.key]]\nat = 6\ndry = 0.5\nzero-parallax = 2\n"
      "[[shot.key]]\nat = \"0.45\"\ndry = 0.1\n";
  for (const FilmReaderOptions& reading : {FilmReaderOptions{}, FilmReaderOptions{.from_s = 0.32}}) {
    const std::vector<MovingParameter> moving = placed(toml, reading).back().moving;
    ASSERT_EQ(moving.size(), 2u);
    EXPECT_EQ(moving[0].name, "dry");
    ASSERT_EQ(moving[0].keys.size(), 2u);
    EXPECT_NEAR(moving[0].keys[0].at_s, 0.2, 1e-3);
    EXPECT_NEAR(moving[0].keys[1].at_s, 0.48, 1e-3);
    EXPECT_EQ(moving[0].keys[1].value, 0.1f);
    ASSERT_EQ(moving[1].keys.size(), 1u);
    EXPECT_EQ(moving[1].keys[0].value, 2);
  }
}

TEST_F(PlacedShots, HaveTheirMapsAtFramesThatAreRead) {
  const TemporaryFolder folder;
  write_image(folder / "d.png", Image<std::uint8_t>(8, 4, 200));
  const std::string map = fmt::format("detail-map = \"{}\"\n", (folder / "d.png").string());
  const std::string toml = "[[shot]]\nbegin = 1\n[[shot]]\nbegin = 6\nstyle = \"oil\"\n" + map +
                           "[[shot.key]]\nat = 9\n" + map + "[[shot.key]]\nat = 17\n" + map;
  const auto frames = [&](const FilmReaderOptions& reading) {
    std::vector<std::int64_t> found;
    const std::vector<FilmShot> shots = placed(toml, reading);
    for (const MapsKey& key : shots.back().maps) found.push_back(key.frame);
    return found;
  };
  EXPECT_THAT(frames({}), ElementsAre(5, 8, 16));
  EXPECT_THAT(frames({.from_s = 0.28}), ElementsAre(1, 9)) << "from frame 8 on; what was before has moved";
  EXPECT_THAT(frames({.every = 4}), ElementsAre(2, 2, 4));
}

TEST_F(PlacedShots, DissolveForFramesOrSeconds) {
  const std::string toml =
      "[[shot]]\nbegin = 1\n[[shot]]\nbegin = 6\ndissolve = 4\n[[shot]]\nbegin = 13\ndissolve = \"0.2\"\n";
  const auto dissolves = [&](const FilmReaderOptions& reading) {
    std::vector<std::int64_t> frames;
    for (const FilmShot& shot : placed(toml, reading)) frames.push_back(shot.dissolve_frames);
    return frames;
  };
  EXPECT_THAT(dissolves({}), ElementsAre(0, 4, 5));
  EXPECT_THAT(dissolves({.every = 2}), ElementsAre(0, 2, 3));
  EXPECT_THAT(dissolves({.from_s = 0.24}), ElementsAre(0, 5)) << "the first shot is not painted";
  const std::vector<FilmShot> shots = placed(toml);
  EXPECT_THAT(cuts_of(shots), ElementsAre(0));
  EXPECT_FALSE(dissolve_at(shots, 4));
  EXPECT_EQ(dissolve_at(shots, 5)->outgoing, &shots[0]);
  EXPECT_FLOAT_EQ(dissolve_at(shots, 5)->share, 0.2f);
  EXPECT_FLOAT_EQ(dissolve_at(shots, 8)->share, 0.8f);
  EXPECT_FALSE(dissolve_at(shots, 9));
}

TEST_F(PlacedShots, WhoseDissolvesDoNotFitAreRefused) {
  const std::string first = "[[shot]]\nbegin = 1\n";
  expect_refused(first + "dissolve = 3\n",
                 "s.toml: shot 1, line 1: begins with a dissolve, but there is no shot before");
  expect_refused(first + "[[shot]]\nbegin = 6\ndissolve = 5\n[[shot]]\nbegin = 10\n",
                 "s.toml: shot 2, line 3: its dissolve goes on to frame 10, but the shot ends with frame 9");
  expect_refused(first + "[[shot]]\nbegin = 18\ndissolve = 3\n",
                 "its dissolve does not end before the film, which has 20");
  expect_refused(first + "[[shot]]\nbegin = 6\ndissolve = 0.5\n", "line 5: 'dissolve' is not a number of frames, or a");
}

TEST_F(PlacedShots, WhoseKeysDoNotFitAreRefused) {
  const std::string shots = "[[shot]]\nbegin = 1\n[[shot]]\nbegin = 6\nlast = 9\n", end = "[[shot]]\nbegin = 10\n";
  const auto key = [](const std::string& at) { return "[[shot.key]]\nat = " + at + "\ndry = 0.5\n"; };
  expect_refused(shots + key("5") + end, "s.toml: shot 2, key 1, line 6: lies at frame 5, outside its shot, which");
  expect_refused(shots + key("10") + end, "begins with frame 6 and ends with frame 9");
  expect_refused(shots + key("\"0.1\"") + end, "key 1, line 6: lies at frame 4, outside its shot");
  expect_refused(shots + key("8") + key("7") + end, "s.toml: shot 2, key 2, line 9: lies at frame 7, expected a later");
  expect_refused(shots + key("8") + key("\"0.28\"") + end,
                 "lies at frame 8, expected a later one than 8, where the key");
  expect_refused(shots + end + key("21"),
                 "s.toml: shot 3, key 1, line 8: lies beyond the end of the film, which has 20");
  expect_refused(shots + end + key("\"0:09\""), "lies beyond the end of the film, which has 20 frames");
}

TEST_F(PlacedShots, ThatDoNotFitTheFilmAreRefused) {
  const std::string first = "[[shot]]\nbegin = 1\n";
  expect_refused("[[shot]]\nbegin = 2\n", "s.toml: shot 1, line 1: begins with frame 2, expected 1");
  expect_refused(first + "[[shot]]\nbegin = 21\n", "s.toml: shot 2, line 3: begins beyond the end of the film, which");
  expect_refused(first + "[[shot]]\nbegin = \"0:09\"\n", "begins beyond the end of the film, which has 20 frames");
  expect_refused(first + "[[shot]]\nbegin = 9\n[[shot]]\nbegin = 5\n", "s.toml: shot 3, line 5: begins with frame 5");
  expect_refused(first + "[[shot]]\nbegin = 9\n[[shot]]\nbegin = \"0.1\"\n", "expected a later one than 9");
  expect_refused(first + "[[shot]]\nbegin = 1\n", "s.toml: shot 2, line 3: begins with frame 1");
  expect_refused(first + "last = 9\n[[shot]]\nbegin = 9\n", "next shot begins with frame 9: they overlap");
  expect_refused(first + "last = 7\n[[shot]]\nbegin = 9\n", "frames between them belong to no shot");
  expect_refused(first + "last = 21\n", "s.toml: shot 1, line 1: ends with frame 21, but the film has 20 frames");
  expect_refused(first + "last = 19\n", "ends with frame 19, but the film goes on");
}

}  // namespace wheatstone::shots_file_test
