#include "wheatstone/painting/paint.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "scenes/painted_frame.h"
#include "scenes/two_surfaces.h"
#include "spilling_share.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/stereo/central_view.h"
#include "wheatstone/strokes/stroke_measures.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::paint_test {

Style small_style(Propagation propagation = Propagation::strokes) {
  Style style;
  style.radii_px = {8, 4, 2};
  style.absolute_radii = true;
  style.propagation = propagation;
  return style;
}

const StrokePainting& strokes_of(const Painting& painting) { return std::get<StrokePainting>(painting.marks); }

PaintedPair paint_scene(const Style& style) { return paint(test_scene::photographs(), test_scene::geometry(), style); }

double difference_of(const PaintedPair& painted) {
  return measure_left_right_difference(painted.pictures, test_scene::geometry().left_disparity).mean_absolute;
}

TEST(Paint, StrokesFuseWhereIndependentEyesDoNot) {
  const double strokes = difference_of(paint_scene(small_style(Propagation::strokes)));
  const double raster = difference_of(paint_scene(small_style(Propagation::raster)));
  const double independent = difference_of(paint_scene(small_style(Propagation::independent)));
  EXPECT_LT(strokes, 0.35 * independent);
  EXPECT_LT(raster, 0.35 * independent);
}

TEST(Paint, CoversBothEyes) {
  const PaintedPair painted = paint_scene(small_style());
  EXPECT_LT(painted.left_bare_share, 0.005);
  EXPECT_LT(painted.right_bare_share, 0.005);
}

TEST(Paint, DrawsNearerEyesWithItsOwnWhereTheDepthIsOverTheBudget) {
  const StereoPair photographs = test_scene::photographs();
  const PaintedPair alone = paint(photographs, test_scene::geometry(), small_style());
  EXPECT_EQ(alone.separation, 1);
  EXPECT_TRUE(alone.nearer.left.empty());
  const PaintedPair painted = paint(photographs, test_scene::geometry(), small_style(), {}, {.depth_budget = 0.005f});
  EXPECT_EQ(painted.pictures.left, alone.pictures.left);
  EXPECT_EQ(painted.pictures.right, alone.pictures.right);
  EXPECT_EQ(painted.separation, comfortable_separation(painted.painting, 0.005f));
  ASSERT_LT(painted.separation, 1);
  EXPECT_EQ(painted.nearer.left, draw(painted.painting, ViewPosition(-painted.separation / 2)).picture);
  EXPECT_EQ(painted.nearer.right, draw(painted.painting, ViewPosition(painted.separation / 2)).picture);
}

TEST(Paint, PicturesAreWhatDrawMakesOfTheMarks) {
  const StereoPair photographs = test_scene::photographs();
  const PaintedPair painted = paint(photographs, test_scene::geometry(), small_style());
  const PreparedPainting prepared = prepare(painted.painting);
  EXPECT_EQ(draw(prepared, left_eye, photographs.left).picture, painted.pictures.left);
  EXPECT_EQ(draw(prepared, right_eye, photographs.right).picture, painted.pictures.right);
}

TEST(Paint, PaintingOfEveryKindOfMarksIsWrittenAndReadBackEqual) {
  const TemporaryFolder folder;
  for (const std::string_view name : {"impressionist", "psychedelic", "posterise", "mosaic", "diffusion"}) {
    Style style = style_by_name(name);
    style.absolute_radii = true;
    style.texture = is_of_strokes(style);
    const PaintedPair result = paint_scene(style);
    EXPECT_GT(disparities_of_marks(result.painting).size(), 0u) << name;
    EXPECT_EQ(result.painting.relief.depth_px > 0, style.texture) << name;
    write_painting(folder / "painting.wst", result.painting);
    EXPECT_EQ(read_painting(folder / "painting.wst"), result.painting) << name;
  }
}

/// A copy of an image in memory with a gap after each row.
template <class Pixel>
struct Lent {
  static constexpr int gap = 5;
  Image<Pixel> memory;

  explicit Lent(const Image<Pixel>& image, Pixel in_gap) : memory(image.width() + gap, image.height(), in_gap) {
    for (int y = 0; y < image.height(); ++y) std::ranges::copy(image.row(y), memory.row(y).begin());
  }
  operator ImageView<const Pixel>() const {
    return {memory.pixels().data(), memory.width() - gap, memory.height(), memory.width()};
  }
};

/// CIE lightness of a level of grey.
double lightness(std::uint8_t level) {
  const double encoded = level / 255.0;
  const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  return linear <= 0.008856 ? 903.3 * linear : 116 * std::cbrt(linear) - 16;
}

TEST(PaintLong, OilShowsNoEdgesInASoftSky) {
  constexpr int width = 4000, height = 3000, apart_px = 6;
  Image<Rgb8> sky(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto level = static_cast<std::uint8_t>(90 + 130 * (0.9 * y / height + 0.1 * x / width) + 0.5);
      sky(x, y) = {level, level, level};
    }
  }
  Style style = style_by_name("oil");
  style.brush.streaks = style.brush.ridge = style.brush.dry = 0;
  const Image<float> flat(width, height);
  const PaintedPair painted = paint({sky, {}}, {.left_disparity = flat}, style);
  const auto at = [&](int x, int y) { return lightness(painted.pictures.left(x, y).r); };
  std::vector<double> steps;
  for (int y = 0; y + apart_px < height; y += 2)
    for (int x = 0; x + apart_px < width; x += 2)
      steps.push_back(std::max(std::abs(at(x, y) - at(x + apart_px, y)), std::abs(at(x, y) - at(x, y + apart_px))));
  const auto last = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 999 / 1000);
  std::ranges::nth_element(steps, last);
  RecordProperty("step", std::to_string(*last));
  EXPECT_LE(*last, 2);
}

TEST(Paint, OfLentMemoryIsThatOfPairs) {
  const StereoPair pair = test_scene::photographs();
  const StereoGeometry geometry = test_scene::geometry();
  const Lent left(pair.left, {255, 0, 255}), right(pair.right, {255, 0, 255});
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  const Lent left_disparity(geometry.left_disparity, unknown), right_disparity(geometry.right_disparity, unknown);
  const Lent<std::uint8_t> left_occlusion(geometry.left_occlusion, 255), right_occlusion(geometry.right_occlusion, 255);
  for (const std::string_view name : {"impressionist", "colorist-wash", "posterise", "mosaic", "diffusion"}) {
    Style style = style_by_name(name);
    style.absolute_radii = true;
    const PaintedPair own = paint(pair, geometry, style);
    const PaintedPair lent =
        paint({left, right}, {left_disparity, right_disparity, left_occlusion, right_occlusion}, style);
    EXPECT_EQ(lent.painting, own.painting) << name;
    EXPECT_EQ(lent.pictures.left, own.pictures.left) << name;
    EXPECT_EQ(lent.pictures.right, own.pictures.right) << name;
  }
}

/// The first frame of a film.
PaintedFrame paint_first_frame(const Style& style, const Progress& progress) {
  const StereoPair eyes = test_scene::photographs();
  const StereoGeometry geometry = test_scene::geometry();
  const CentralView centre = make_central_view(eyes, geometry);
  const std::vector<View> scene = scene_from_centre(centre, eyes, geometry);
  PaintingMemory memory;
  return paint_frame({scene, nullptr}, style, {}, memory, progress);
}

TEST(PaintFrame, PaintingIsWrittenAndReadBackEqual) {
  const TemporaryFolder folder;
  for (const std::string_view name : {"impressionist", "mosaic", "diffusion"}) {
    const Painting painting = paint_first_frame(style_by_name(name), {}).painting;
    write_painting(folder / "painting.wst", painting);
    EXPECT_EQ(read_painting(folder / "painting.wst"), painting) << name;
  }
}

TEST(PaintFrame, EndsWhereverItsProgressThrows) {
  for (const std::string_view name : {"impressionist", "posterise", "mosaic", "diffusion"}) {
    const Style style = style_by_name(name);
    int reports = 0;
    paint_first_frame(style, [&](std::string_view, double) { ++reports; });
    // Of strokes each layer in each view; in any style before it is planned and before it is drawn.
    EXPECT_GE(reports, is_of_strokes(style) ? static_cast<int>(3 * style.radii_px.size()) + 1 : 2) << name;
    for (int last = 1; last <= reports; ++last) {
      int told = 0;
      const Progress stop = [&](std::string_view, double) {
        if (++told >= last) throw Error(ErrorKind::interrupted, "stopped");
      };
      expect_error(ErrorKind::interrupted, "stopped", [&] { paint_first_frame(style, stop); });
    }
  }
}

TEST(Paint, EndsWhereverItsProgressThrows) {
  for (const Propagation propagation : {Propagation::strokes, Propagation::raster, Propagation::independent}) {
    for (int last = 1; last <= 3; ++last) {
      int told = 0;
      const Progress stop = [&](std::string_view, double) {
        if (++told >= last) throw Error(ErrorKind::interrupted, "stopped");
      };
      expect_error(ErrorKind::interrupted, "stopped",
                   [&] { paint(test_scene::photographs(), test_scene::geometry(), small_style(propagation), stop); });
      // Each of the scene's views, which are planned at once, is told of its end by one more report.
      constexpr int views = 7;
      EXPECT_LT(told, last + views);
    }
  }
}

TEST(Paint, GivesTheSameBytesOnAnyNumberOfThreads) {
  Painting first;
  for (const std::size_t threads : {1u, 2u, 4u}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const PaintedPair painted = paint_scene(small_style());
    if (strokes_of(first).layers.empty()) first = painted.painting;
    EXPECT_EQ(painted.painting, first);
  }
}

TEST(Paint, DrawsFarStrokesBeforeNearOnesInEveryLayer) {
  const PaintedPair painted = paint_scene(small_style());
  for (const Layer& layer : strokes_of(painted.painting).layers) {
    float last = -INFINITY;
    for (const Stroke& stroke : layer.strokes) {
      EXPECT_GE(std::round(stroke.disparity), std::round(last));
      last = stroke.disparity;
    }
  }
}

TEST(Paint, PairsEveryStrokeThatBothEyesCanSee) {
  const StereoGeometry geometry = test_scene::geometry();
  const StrokeMeasures strokes = measure_strokes(strokes_of(paint_scene(small_style()).painting).layers, geometry);
  EXPECT_DOUBLE_EQ(strokes.paired_share, 1);
  EXPECT_LT(strokes.shape_differs_share, 0.01);
  const StrokeMeasures independent =
      measure_strokes(strokes_of(paint_scene(small_style(Propagation::independent)).painting).layers, geometry);
  EXPECT_DOUBLE_EQ(independent.paired_share, 0);
}

TEST(Paint, FinestStrokesDoNotSpillOverDepthEdgesUnlessTheTestIsOff) {
  const StereoGeometry geometry = test_scene::geometry();
  Style style = small_style();
  EXPECT_DOUBLE_EQ(spilling_share(strokes_of(paint_scene(style).painting).layers.back(), geometry, 2), 0);
  style.depth_test = false;
  EXPECT_GT(spilling_share(strokes_of(paint_scene(style).painting).layers.back(), geometry, 2), 0.002);
}

TEST(Paint, RightOnlyStrokesBeginOnTheGrownOcclusion) {
  const StereoGeometry geometry = test_scene::geometry();
  Style style = small_style();
  style.occlusion_dilation = 0;
  const PaintedPair painted = paint_scene(style);
  int begun = 0;
  for (const Layer& layer : strokes_of(painted.painting).layers) {
    for (const Stroke& stroke : layer.strokes) {
      if (stroke.reference_view != right_eye) continue;
      ++begun;
      const ControlPoint& begin = layer.points[stroke.first_point];
      EXPECT_NE(geometry.right_occlusion(static_cast<int>(begin.x), static_cast<int>(begin.y)), 0);
    }
  }
  EXPECT_GT(begun, 0);
}

/// The share of the pixels of the right eye's view behind a depth edge, at most `reach_px` from it on its row, whose
/// colour the photograph has nowhere near.
double ghost_share(const Image<Rgb8>& painted, const StereoPair& photographs, ImageView<const float> right_disparity) {
  constexpr int reach_px = 16;
  constexpr float least_step_px = 2;
  const Image<std::uint8_t> wrong = wrong_pixels(painted, photographs.right);
  int asked = 0, ghosts = 0;
  for (int y = 0; y < painted.height(); ++y) {
    for (int x = 0; x < painted.width(); ++x) {
      bool behind_edge = false;
      for (int other = std::max(x - reach_px, 0); other <= std::min(x + reach_px, painted.width() - 1); ++other)
        behind_edge = behind_edge || right_disparity(other, y) > right_disparity(x, y) + least_step_px;
      asked += behind_edge ? 1 : 0;
      ghosts += behind_edge && wrong(x, y) != 0 ? 1 : 0;
    }
  }
  return static_cast<double>(ghosts) / asked;
}

TEST(PaintRaster, LeavesNoOutlinesOfNearThingsOnWhatIsBehindThem) {
  const SyntheticStill still = make_synthetic_still({.width = 640, .height = 480});
  const StereoGeometry& geometry = still.geometry;
  const auto ghosts = [&](Propagation propagation, float dilation) {
    Style style = style_by_name("impressionist");
    style.propagation = propagation;
    style.occlusion_dilation = dilation;
    return ghost_share(paint(still.pictures, geometry, style).pictures.right, still.pictures, geometry.right_disparity);
  };
  constexpr float as_preset = 0.125f;
  const double left = ghosts(Propagation::raster, as_preset);
  EXPECT_LT(left, 0.002);
  EXPECT_LT(left, 2 * ghosts(Propagation::strokes, as_preset));
  // It is the grown mask that takes them away.
  EXPECT_GT(ghosts(Propagation::raster, 0), 0.01);
}

TEST(Paint, WorksWithDisparitiesOfBothSigns) {
  const StereoPair photographs = test_scene::photographs();
  constexpr float convergence = 10;
  StereoGeometry geometry = test_scene::geometry();
  StereoPair converged = photographs;
  // The right camera is turned: everything moves by ten pixels there.
  for (int y = 0; y < test_scene::height; ++y)
    for (int x = 0; x < test_scene::width; ++x)
      converged.right(x, y) = photographs.right(std::max(x - static_cast<int>(convergence), 0), y);
  for (float& d : geometry.left_disparity.pixels()) d -= convergence;
  const StereoGeometry turned = geometry_from_left(geometry.left_disparity);
  const PaintedPair painted = paint(converged, turned, small_style());
  EXPECT_LT(measure_left_right_difference(painted.pictures, turned.left_disparity).mean_absolute, 3);
}

TEST(Paint, RefusesWhatDoesNotFitTogether) {
  const StereoPair photographs = test_scene::photographs();
  StereoGeometry geometry = test_scene::geometry();
  geometry.left_disparity(3, 3) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(paint(photographs, geometry, small_style()), Error);
  geometry.left_disparity = Image<float>(3, 3);
  EXPECT_THROW(paint(photographs, geometry, small_style()), Error);
  Style style = small_style();
  style.threshold = 0;
  EXPECT_THROW(paint(photographs, test_scene::geometry(), style), Error);
}

}  // namespace wheatstone::paint_test
