// Films in which slicing planes travel through a painting: what changes from frame to frame, and what is bare.

#include "wheatstone/app/slice_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "scenes/test_photographs.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/video/film_reader.h"

namespace wheatstone::slice_film_test {

/// Null where there are no data.
const Painting* painting_of(const std::string& name) {
  static std::map<std::string, std::optional<Painting>> planned;
  const auto [found, is_new] = planned.try_emplace(name);
  if (is_new) {
    const std::optional<StereoPair> pair = name == "still" ? still_for_test(320, 240) : shared_pair(name);
    if (pair) found->second = paint_photograph(*pair, {.style = style_by_name("oil")}).painted.painting;
  }
  return found->second ? &*found->second : nullptr;
}

/// In which the plane goes through the whole scene.
SliceFilmOptions through_all(int frames, SliceKeeps keeps = SliceKeeps::back) {
  const bool is_back = keeps == SliceKeeps::back;
  return {.slicing = {.keeps = keeps},
          .from = {{is_back ? 0.f : 1.f, true}},
          .to = {{is_back ? 1.f : 0.f, true}},
          .frames = frames,
          .writing = {.codec = "ffv1", .frame_rate = {24, 1}}};
}

/// The strokes of the finest layer, by their places among all.
using Strokes = std::set<std::size_t>;

Strokes strokes_left(const Painting& whole, const Painting& part) {
  const Layer &all = layers_of(whole).back(), &some = layers_of(part).back();
  Strokes left;
  std::size_t i = 0;
  for (const Stroke& stroke : some.strokes) {
    while (all.strokes[i].first_point != stroke.first_point) ++i;
    left.insert(i++);
  }
  return left;
}

/// Marks the pixels that a stroke may touch in a view: a cubic B-spline stays within boxes around four points each.
void mark_place(const Layer& layer, const Stroke& stroke, ViewPosition view, Image<std::uint8_t>& touched) {
  constexpr float soft_rim_px = 2;
  const std::span<const ControlPoint> points = layer.points_of(stroke);
  for (std::size_t first = 0; first < std::max<std::size_t>(points.size(), 3) - 2; ++first) {
    float left = std::numeric_limits<float>::infinity(), right = -left, top = left, bottom = -left;
    for (const ControlPoint& point : points.subspan(first, std::min<std::size_t>(4, points.size() - first))) {
      const float x = x_in_view(point, stroke.reference_view, view);
      left = std::min(left, x), right = std::max(right, x);
      top = std::min(top, point.y), bottom = std::max(bottom, point.y);
    }
    const float around = stroke.radius_px + soft_rim_px;
    const auto within = [](float place, int size) { return std::clamp(static_cast<int>(place), 0, size); };
    for (int y = within(top - around, touched.height()); y < within(bottom + around + 1, touched.height()); ++y)
      for (int x = within(left - around, touched.width()); x < within(right + around + 1, touched.width()); ++x)
        touched(x, y) = 1;
  }
}

/// Marks whole runs of one colour in a row where a stroke touches them: a gap takes the colour beside it.
void mark_gaps(const Image<Rgb8>& picture, Image<std::uint8_t>& touched) {
  const auto pass_on = [&](int to, int from, int y) {
    if (touched(from, y) != 0 && picture(to, y) == picture(from, y)) touched(to, y) = 1;
  };
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 1; x < picture.width(); ++x) pass_on(x, x - 1, y);
    for (int x = picture.width() - 1; x > 0; --x) pass_on(x - 1, x, y);
  }
}

struct Changes {
  int changed = 0;       ///< pixels that differ between two frames
  int elsewhere = 0;     ///< of these, where no stroke lies that only one of the frames shows
  double untouched = 0;  ///< share of the pixels where no such stroke lies
};

/// From one frame to the next in one eye, looking for the strokes where they lie in `strokes_of`.
Changes compare(const Image<Rgb8>& before, const Image<Rgb8>& after, const Painting& whole, const Strokes& gone,
                ViewPosition strokes_of) {
  Image<std::uint8_t> touched(before.width(), before.height(), 0);
  const Layer& layer = layers_of(whole).back();
  for (const std::size_t i : gone) mark_place(layer, layer.strokes[i], strokes_of, touched);
  mark_gaps(before, touched);
  Changes changes;
  int untouched = 0;
  for (std::size_t i = 0; i < before.pixels().size(); ++i) {
    const bool differs = !(before.pixels()[i] == after.pixels()[i]), is_touched = touched.pixels()[i] != 0;
    changes.changed += differs;
    changes.elsewhere += differs && !is_touched;
    untouched += !is_touched;
  }
  changes.untouched = static_cast<double>(untouched) / static_cast<double>(before.pixels().size());
  return changes;
}

/// Both eyes change where the strokes lie that the plane passes, and nowhere else; in the other eye's places they would
/// be missed.
void expect_still_elsewhere(const Painting& whole, SliceKeeps keeps) {
  const SliceFilmOptions options = through_all(9, keeps);
  Strokes before = strokes_left(whole, sliced(whole, slicing_of_frame(options, 0)));
  std::vector<Image<Rgb8>> eyes_before = present(whole, for_two_eyes()).views;
  EXPECT_EQ(before.size(), layers_of(whole).back().strokes.size());
  int changed = 0, missed = 0;
  double largest_untouched = 0;
  for (int frame = 1; frame < options.frames; ++frame) {
    const Painting part = sliced(whole, slicing_of_frame(options, frame));
    const Strokes after = strokes_left(whole, part);
    Strokes gone;
    std::ranges::set_difference(before, after, std::inserter(gone, gone.end()));
    EXPECT_TRUE(std::ranges::includes(before, after)) << "frame " << frame << " shows again what was hidden";
    std::vector<Image<Rgb8>> eyes = present(part, for_two_eyes()).views;
    for (const std::size_t eye : {0u, 1u}) {
      const std::array<ViewPosition, 2> views{left_eye, right_eye};
      const Changes found = compare(eyes_before[eye], eyes[eye], whole, gone, views[eye]);
      EXPECT_EQ(found.elsewhere, 0) << "frame " << frame << " eye " << eye;
      changed += found.changed;
      missed += compare(eyes_before[eye], eyes[eye], whole, gone, views[1 - eye]).elsewhere;
      largest_untouched = std::max(largest_untouched, found.untouched);
    }
    before = after;
    eyes_before = std::move(eyes);
  }
  EXPECT_GT(changed, 0);
  EXPECT_GT(missed, 0);
  EXPECT_GT(largest_untouched, 0.5);
}

/// The most of a view that no stroke covers, wherever the plane is.
double worst_bare_share(const Painting& whole) {
  double worst = 0;
  const SliceFilmOptions options = through_all(21);
  for (int frame = 0; frame < options.frames; ++frame) {
    const Presented shown = present(sliced(whole, slicing_of_frame(options, frame)), for_two_eyes());
    worst = std::max(worst, shown.worst_bare_share);
  }
  return worst;
}

class SlicedScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, SlicedScene, testing::Values("still", "teddy"),
                         [](const auto& scene) { return scene.param; });

TEST_P(SlicedScene, ChangesOnlyWhereThePlanePassesAndAlikeInBothEyes) {
  const Painting* const painting = painting_of(GetParam());
  if (painting == nullptr) GTEST_SKIP() << "no shared data: " << GetParam();
  expect_still_elsewhere(*painting, SliceKeeps::back);
  expect_still_elsewhere(*painting, SliceKeeps::front);
}

TEST_P(SlicedScene, IsCoveredWhereverThePlaneIs) {
  const Painting* const painting = painting_of(GetParam());
  if (painting == nullptr) GTEST_SKIP() << "no shared data: " << GetParam();
  const double bare = worst_bare_share(*painting);
  RecordProperty("bare_percent", std::to_string(100 * bare));
  EXPECT_LE(bare, 0.002);
}

TEST(SlicedSceneLong, OfALargePictureChangesOnlyWhereThePlanePassesAndIsCovered) {
  const Painting* const painting = painting_of("motorcycle");
  if (painting == nullptr) GTEST_SKIP() << "no shared data: motorcycle";
  expect_still_elsewhere(*painting, SliceKeeps::back);
  expect_still_elsewhere(*painting, SliceKeeps::front);
  EXPECT_LE(worst_bare_share(*painting), 0.002);
}

TEST(SliceFilm, BeginsAndEndsWithThePlanesThatAreTyped) {
  const Painting& painting = *painting_of("still");
  const TemporaryFolder folder;
  const auto picture = [](const Painting& part) {
    const Presented eyes = present(part, for_two_eyes());
    return put_together(eyes.views.front(), eyes.views.back(), StereoLayout::left_right);
  };
  SliceFilmOptions options = through_all(3);
  options.writing.pixel_format = "bgr0";
  options.writing.layout = StereoLayout::left_right;
  write_slice_film(painting, picture, folder / "film.mkv", options);
  FilmReader film = open_film(folder / "film.mkv");
  for (const char* depth : {"0%", "50%", "100%"}) {
    Frame frame;
    ASSERT_TRUE(film.read(frame)) << depth;
    EXPECT_EQ(frame.picture, picture(sliced(painting, {.depths = parse_slice_depths(depth, "depth")}))) << depth;
  }
  Frame none;
  EXPECT_FALSE(film.read(none));
}

TEST(SliceFilm, PlanesTravelInOneUnit) {
  const std::vector<SliceDepth> from = parse_slice_depths("0%,10px", "from"), to = parse_slice_depths("80%,20px", "to");
  EXPECT_EQ(slice_depths_text(planes_between(from, to, 0.25f, "to")), "20%,12.5px");
  expect_error(ErrorKind::wrong_usage, "--slice-to: is '20%', expected as many depths as '0%,10px', in the same units",
               [&] { planes_between(from, parse_slice_depths("20%", "to"), 0, "--slice-to"); });
  expect_error(ErrorKind::wrong_usage, "--slice-to: is '20%,5%', expected",
               [&] { planes_between(from, parse_slice_depths("20%,5%", "to"), 0, "--slice-to"); });
}

TEST(SliceFilm, OfOtherMarksIsRefused) {
  const TemporaryFolder folder;
  const Painting regions{.marks = RegionPainting{}, .surfaces = {}, .relief = {}};
  expect_error(ErrorKind::bad_input, "the painting has no layers of strokes", [&] {
    write_slice_film(
        regions, [](const Painting&) { return Image<Rgb8>(); }, folder / "film.mp4", through_all(2));
  });
  EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4"));
}

}  // namespace wheatstone::slice_film_test
