// Strokes of films: they are carried, nothing is left bare, nothing pops, and both eyes still show the same strokes.

#include "wheatstone/strokes/strokes_in_time.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "scenes/painted_frame.h"
#include "scenes/short_film.h"
#include "throws_error.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/measures/film_measures.h"
#include "wheatstone/measures/view_measures.h"
#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/random.h"
#include "wheatstone/strokes/carry_strokes_internal.h"
#include "wheatstone/strokes/misplaced_strokes_internal.h"
#include "wheatstone/strokes/missing_strokes_internal.h"
#include "wheatstone/strokes/strokes_between_frames.h"

namespace wheatstone::strokes_in_time_test {

/// A film of a camera that walks and fruit that hops, with the true flow of its central views.
const ShortFilm& film() {
  static const ShortFilm made = [] {
    SyntheticFilmOptions options;
    options.still = {.width = 320, .height = 180, .samples_a_side = 2};
    options.cut = 0;
    return film_with_true_flow(options, 5);
  }();
  return made;
}

/// The film painted, with or without what is carried.
std::vector<PaintedFrame> painted(const Style& style, bool anew) {
  std::vector<PaintedFrame> frames;
  PaintingMemory memory;
  for (std::size_t i = 0; i < film().frames.size(); ++i) {
    const std::vector<View> scene = film().scene(i);
    if (anew) memory = {};
    frames.push_back(paint_frame({scene, anew ? nullptr : film().flow_to(i)}, style, {}, memory));
  }
  return frames;
}

const std::vector<PaintedFrame>& carried() {
  static const std::vector<PaintedFrame> made = painted({}, false);
  return made;
}

const std::vector<PaintedFrame>& frame_by_frame() {
  static const std::vector<PaintedFrame> made = painted({}, true);
  return made;
}

const std::vector<Layer>& layers_of(const PaintedFrame& frame) {
  return std::get<StrokePainting>(frame.painting.marks).layers;
}

StereoPair eyes_of(const PaintedFrame& frame) { return {frame.shown.views[0], frame.shown.views[1]}; }

double temporal_error(const std::vector<PaintedFrame>& frames) {
  TemporalError error;
  for (std::size_t i = 1; i < frames.size(); ++i)
    error.add(frames[i - 1].shown.views[0], frames[i].shown.views[0], relate_frames(film().left_flow_to(i)));
  return error.mean();
}

double rms_from_source(const std::vector<PaintedFrame>& frames) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Image<Rgb8>&a = frames[i].shown.views[0], &b = film().frames[i].pictures.left;
    for (std::size_t k = 0; k < a.pixels().size(); ++k) {
      const Rgb8 p = a.pixels()[k], q = b.pixels()[k];
      sum += std::pow(p.r - q.r, 2) + std::pow(p.g - q.g, 2) + std::pow(p.b - q.b, 2);
      count += 3;
    }
  }
  return std::sqrt(sum / count);
}

TEST(StrokesInTime, FlickerFarLessThanFrameByFrameAndPaintAsTruly) {
  EXPECT_LT(temporal_error(carried()), 0.3 * temporal_error(frame_by_frame()));
  EXPECT_LT(rms_from_source(carried()), 1.05 * rms_from_source(frame_by_frame()));
}

/// The left eye's pictures of the painted film, with other bristles in every frame.
std::vector<PaintedFrame> with_new_bristles(const std::vector<PaintedFrame>& frames) {
  std::vector<PaintedFrame> drawn;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Painting painting = frames[i].painting;
    for (Layer& layer : std::get<StrokePainting>(painting.marks).layers)
      for (Stroke& stroke : layer.strokes) stroke.number += static_cast<std::uint32_t>(1'000'000 * i);
    PaintedFrame frame;
    frame.shown.views.push_back(draw(painting, left_eye).picture);
    drawn.push_back(std::move(frame));
  }
  return drawn;
}

/// The strokes of the second frame of the film, once a layer has lost its own.
std::size_t strokes_of_second_frame(std::size_t lost_layer, const CarryOptions& options) {
  const Style oil = style_by_name("oil");
  StrokeMemory memory;
  const std::vector<View> first = film().scene(0), second = film().scene(1);
  plan_strokes({first, nullptr}, oil, {}, memory);
  for (std::vector<TrackedLayer>& layers : memory.views) layers.at(lost_layer) = {};
  std::size_t count = 0;
  for (const Layer& layer : plan_strokes({second, film().flow_to(1)}, oil, options, memory).painting.layers)
    count += layer.strokes.size();
  return count;
}

TEST(StrokesInTime, AreAsManyInTheLastFrameWhicheverLayerCarriesNone) {
  for (const std::size_t lost_layer : {0, 1, 2, 3}) {
    const auto usual = static_cast<double>(strokes_of_second_frame(lost_layer, {}));
    EXPECT_NEAR(static_cast<double>(strokes_of_second_frame(lost_layer, {.goes_on = false})), usual, 0.1 * usual)
        << lost_layer;
  }
}

TEST(StrokesInTime, KeepTheirBristles) {
  Style style = style_by_name("oil");
  style.brush.streaks = 60;
  const std::vector<PaintedFrame> frames = painted(style, false);
  EXPECT_LT(temporal_error(frames), 0.7 * temporal_error(with_new_bristles(frames)));
}

TEST(StrokesInTime, SurviveLeaveNothingBareAndDoNotPop) {
  StrokeChanges sum;
  for (std::size_t i = 0; i < carried().size(); ++i) {
    // Single pixels beside depth edges, as many in the last frame as in the first.
    EXPECT_LT(carried()[i].shown.bare_shares[0], 0.001) << i;
    EXPECT_LT(carried()[i].shown.bare_shares[1], 0.001) << i;
    if (i == 0) continue;
    const double largest_step = 1.0 / CarryOptions().fade_in_frames;
    const StrokeChanges changes = compare_strokes(layers_of(carried()[i - 1]), layers_of(carried()[i]), largest_step);
    sum.whole += changes.whole;
    sum.survived += changes.survived;
    EXPECT_EQ(changes.popped, 0) << i;
  }
  // Small pictures have small, hasty strokes; wide ones do better.
  EXPECT_GT(static_cast<double>(sum.survived) / static_cast<double>(sum.whole), 0.945);
}

// Layers of brushes so wide are planned in smaller pictures once strokes are carried.
TEST(StrokesInTime, OfWideBrushesAreCarriedAndShowTheFrame) {
  Style style;
  style.radii_px = {60, 24, 4};  // for a picture 640 pixels wide
  const std::vector<PaintedFrame> kept = painted(style, false), anew = painted(style, true);
  for (std::size_t i = 1; i < kept.size(); ++i) {
    const StrokeChanges changes = compare_strokes(layers_of(kept[i - 1]), layers_of(kept[i]), 0.5);
    EXPECT_EQ(changes.popped, 0) << i;
    EXPECT_GT(static_cast<double>(changes.survived), 0.8 * static_cast<double>(changes.whole)) << i;
    const Image<Rgb8>& film_picture = film().frames[i].pictures.left;
    EXPECT_GT(measure_view(kept[i].shown.views[0], film_picture).psnr_db,
              measure_view(anew[i].shown.views[0], film_picture).psnr_db - 1)
        << i;
  }
}

TEST(StrokesInTime, FuseAsWellAsThoseOfAFrameAlone) {
  const auto left_right = [](const std::vector<PaintedFrame>& frames) {
    return measure_left_right_difference(eyes_of(frames.back()), film().frames.back().geometry.left_disparity)
        .mean_absolute;
  };
  const auto bad_2 = [](const StereoPair& pictures) {
    return measure_depth_survival(pictures, film().frames.back().geometry.left_disparity).bad_2;
  };
  EXPECT_LT(left_right(carried()), 1.3 * left_right(frame_by_frame()));
  EXPECT_LT(bad_2(eyes_of(carried().back())), bad_2(film().frames.back().pictures) + 0.03);
}

TEST(StrokesInTime, ASceneBegunAfreshRemembersNothing) {
  StrokeMemory used;
  const std::vector<View> first = film().scene(0), second = film().scene(1);
  plan_strokes({first, nullptr}, {}, {}, used);
  plan_strokes({second, film().flow_to(1)}, {}, {}, used);
  StrokeMemory fresh;
  const CarriedPainting expected = plan_strokes({first, nullptr}, {}, {}, fresh);
  const CarriedPainting begun = plan_strokes({first, nullptr}, {}, {}, used);
  EXPECT_EQ(begun.painting, expected.painting);
  for (const Layer& layer : begun.painting.layers)
    for (const Stroke& stroke : layer.strokes) ASSERT_EQ(stroke.opacity, Style().opacity);
  EXPECT_EQ(begun.counts.before, 0);
}

TEST(StrokesInTime, AreTheSameOnAnyNumberOfThreads) {
  const auto two_moments = [] {
    StrokeMemory memory;
    const std::vector<View> first = film().scene(0), second = film().scene(1);
    plan_strokes({first, nullptr}, {}, {}, memory);
    return plan_strokes({second, film().flow_to(1)}, {}, {}, memory).painting;
  };
  const StrokePainting many = two_moments();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(two_moments(), many);
}

TEST(StrokesInTime, OfOneEyeStandStillWhereTheFilmDoes) {
  const Image<Rgb8>& picture = film().frames[0].pictures.left;
  const Image<float> flat(picture.width(), picture.height());
  const std::vector<View> scene{{picture, flat, {}, central_view}};
  const FlowPair none{{flat, flat}, {flat, flat}};
  PaintingMemory memory;
  std::vector<PaintedFrame> frames;
  for (int i = 0; i < 8; ++i) frames.push_back(paint_frame({scene, i == 0 ? nullptr : &none}, {}, {}, memory));
  // What the first frame leaves to be done has come, and what it had too much has gone.
  EXPECT_TRUE(frames[6].shown.views[0] == frames[7].shown.views[0]);
  EXPECT_TRUE(layers_of(frames[6]) == layers_of(frames[7]));
}

TEST(StrokesInTime, OfAllViewsAreKeptWhereTheFilmStandsStill) {
  const std::vector<View> scene = film().scene(0);
  const Image<float> still(film().frames[0].pictures.left.width(), film().frames[0].pictures.left.height());
  const FlowPair none{{still, still}, {still, still}};
  StrokeMemory memory;
  plan_strokes({scene, nullptr}, {}, {}, memory);
  const StrokeCounts counts = plan_strokes({scene, &none}, {}, {}, memory).counts;
  EXPECT_GT(static_cast<double>(counts.carried), 0.995 * static_cast<double>(counts.before));
}

TEST(StrokesInTime, WhereTheFlowIsWrongPaintDoesNotLinger) {
  const auto bar_at = [](int left) {
    Image<Rgb8> picture(160, 90, {170, 160, 150});
    for (int y = 0; y < 90; ++y) std::fill_n(&picture(left, y), 20, Rgb8{30, 20, 60});
    return picture;
  };
  const Image<float> flat(160, 90);
  const FlowPair none{{flat, flat}, {flat, flat}};
  PaintingMemory memory;
  double wrong = 0;
  for (int i = 0; i < 2; ++i) {
    const Image<Rgb8> picture = bar_at(30 + 60 * i);
    const std::vector<View> scene{{picture, flat, {}, central_view}};
    const PaintedFrame frame = paint_frame({scene, i == 0 ? nullptr : &none}, {}, {}, memory);
    wrong = measure_wrong_spots(frame.shown.views[0], picture).share;
  }
  EXPECT_LT(wrong, 0.02) << "the bar of the frame before takes .22 of the picture";
}

/// Squares of many colours and sizes, each time in other places.
Image<Rgb8> scattered_squares(std::uint64_t time) {
  Image<Rgb8> picture(320, 180, {120, 130, 120});
  for (std::uint64_t i = 0; i < 40; ++i) {
    const std::uint64_t look = hash_keys({i}), place = hash_keys({i, time});
    const int side = 6 + static_cast<int>(look % 26);
    const int left = static_cast<int>(place % (320 - side)), top = static_cast<int>((place >> 20) % (180 - side));
    const Rgb8 colour{static_cast<std::uint8_t>(look >> 8), static_cast<std::uint8_t>(look >> 16),
                      static_cast<std::uint8_t>(look >> 24)};
    for (int y = top; y < top + side; ++y) std::fill_n(&picture(left, y), side, colour);
  }
  return picture;
}

TEST(StrokesInTime, ShowNothingButTheFrameWhateverTheFlowSays) {
  const Image<float> flat(320, 180);
  const FlowPair none{{flat, flat}, {flat, flat}};
  PaintingMemory memory;
  double carried = 0, anew = 0;
  for (std::uint64_t i = 0; i < 4; ++i) {
    const Image<Rgb8> picture = scattered_squares(i);
    const std::vector<View> scene{{picture, flat, {}, central_view}};
    const PaintedFrame frame = paint_frame({scene, i == 0 ? nullptr : &none}, {}, {}, memory);
    PaintingMemory nothing;
    const PaintedFrame alone = paint_frame({scene, nullptr}, {}, {}, nothing);
    if (i == 0) continue;
    carried += measure_wrong_spots(frame.shown.views[0], picture).share;
    anew += measure_wrong_spots(alone.shown.views[0], picture).share;
  }
  EXPECT_LE(carried, 4 * anew) << "thirty times, if carried strokes hid new ones, and those that fade were left";
}

TEST(DropMisplaced, AsksAllViewsThatShowAStroke) {
  constexpr Rgb8 grey{120, 120, 120}, red{220, 30, 30};
  Image<Rgb8> centre(160, 40, grey), right(160, 40, grey);
  for (int y = 0; y < 40; ++y) std::fill_n(&centre(30, y), 12, red);
  const Image<float> flat(160, 40);
  const auto left_of = [&](const std::vector<View>& views, std::uint32_t ends, float disparity) {
    TrackedLayer tracked;
    tracked.layer.points = {{36, 20, disparity}};
    tracked.layer.strokes = {{.point_count = 1, .radius_px = 2, .colour = red, .reference_view = central_view}};
    tracked.tracks = {{.ends = ends}};
    drop_misplaced(views.front().position, views, 1, tracked);
    return tracked.tracks.size();
  };
  const std::vector<View> alone{{centre, flat, {}, central_view}};
  EXPECT_EQ(left_of(alone, 2, 0), 1u);
  const std::vector<View> both{alone.front(), {right, flat, {}, right_eye}};
  EXPECT_EQ(left_of(both, 2, 0), 0u) << "the right eye sees nothing red there";
  EXPECT_EQ(left_of(both, 0, 0), 1u) << "it does not fade";
  EXPECT_EQ(left_of(both, 2, -8), 1u) << "it is hidden";
}

TEST(FadingFrames, AreFewerWhereAStrokeWouldLeaveATrail) {
  const CarryOptions options{.fade_in_frames = 2, .fade_out_frames = 4};
  EXPECT_EQ(fading_frames(4, 0, options), 4u);
  EXPECT_EQ(fading_frames(4, 0.7f, options), 3u);
  EXPECT_EQ(fading_frames(4, 20, options), 2u);
  EXPECT_EQ(fading_frames(8, 0.7f, options), 3u);
  EXPECT_EQ(fading_frames(4, 20, {.fade_in_frames = 6, .fade_out_frames = 1}), 1u);
}

TEST(ColourFit, IsThatOfTheWorstPartOfAStroke) {
  const Image<Rgb8> picture = [] {
    Image<Rgb8> half(24, 8, {100, 100, 100});
    for (int y = 0; y < 8; ++y) std::fill_n(&half(18, y), 6, Rgb8{220, 100, 100});
    return half;
  }();
  const Style style;
  const Image<float> flat(24, 8);
  const ViewOnCanvas at({picture, flat, {}, left_eye}, style, picture.width());
  const ReferencePicture reference = make_reference(picture, 0.5f, style);
  const Image<float> black(24, 8, 3 * 100 * 100);
  std::vector<ControlPoint> points;
  for (int i = 0; i < 12; ++i) points.push_back({2.f * static_cast<float>(i) + 0.5f, 4, 0});
  const Rgb8 grey{100, 100, 100};
  EXPECT_LT(colour_fit(std::span(points).first(8), grey, at, reference, black).difference, 5);
  EXPECT_GT(colour_fit(points, grey, at, reference, black).difference, 100) << "a quarter of it lies on another thing";
}

/// A layer of one cell in the middle of whose picture the coarser layers left an error.
Image<std::uint8_t> missing_with(float after, std::uint8_t begun_there) {
  Image<float> before(8, 8), left(8, 8);
  before(5, 4) = 120 * 120, left(5, 4) = after * after;
  Image<std::uint8_t> begun(8, 8);
  begun(1, 1) = 255, begun(5, 4) = begun_there;
  return missing_strokes({before, left, begun, {}, 8, 100});
}

TEST(MissingStrokes, BeginWherePaintingAnewWouldAndCarriedPaintIsWrong) {
  EXPECT_EQ(missing_with(120, 0)(5, 4), 255) << "another stroke of the cell does not paint it";
  EXPECT_EQ(missing_with(120, 0)(1, 1), 0);
  EXPECT_EQ(missing_with(60, 0)(5, 4), 0) << "carried paint is right";
  EXPECT_EQ(missing_with(120, 255)(5, 4), 0) << "a carried stroke begins there";
}

TEST(StrokesInTime, ComeAndGoOverTheFramesAsked) {
  CarryOptions options;
  options.fade_in_frames = 3;
  StrokeMemory memory;
  const std::vector<View> first = film().scene(0), second = film().scene(1);
  plan_strokes({first, nullptr}, {}, options, memory);
  const std::uint32_t last = memory.last_number;
  plan_strokes({second, film().flow_to(1)}, {}, options, memory);
  int begun = 0, ending = 0;
  for (const std::vector<TrackedLayer>& view : memory.views) {
    for (const TrackedLayer& tracked : view) {
      for (std::size_t i = 0; i < tracked.tracks.size(); ++i) {
        if (tracked.layer.strokes[i].number > last) {
          ++begun;
          EXPECT_FLOAT_EQ(tracked.tracks[i].shown, 1.f / 3);
        } else if (tracked.tracks[i].ends != 0) {
          ++ending;
          // By a step, of which there are fewer where the film is fast, but never so few as for coming.
          EXPECT_GE(tracked.tracks[i].shown, 1 - 1.f / 3 - 1e-6f);
          EXPECT_LE(tracked.tracks[i].shown, 0.75f);
        }
      }
    }
  }
  EXPECT_GT(begun, 0);
  EXPECT_GT(ending, 0);
}

TEST(StrokesInTime, AFilmOfOneEyeIsPaintedToo) {
  PaintingMemory memory;
  std::vector<Layer> before;
  for (std::size_t i = 0; i < 3; ++i) {
    const Image<Rgb8>& picture = film().frames[i].pictures.left;
    const Image<float> flat(picture.width(), picture.height());
    const std::vector<View> scene{{picture, flat, {}, central_view}};
    const FlowPair flow = i == 0 ? FlowPair{} : film().left_flow_to(i);
    FlowPair known = flow;
    for (Image<float>* image : {&known.forward.x, &known.forward.y, &known.backward.x, &known.backward.y})
      for (float& value : image->pixels())
        if (std::isnan(value)) value = 0;
    const PaintedFrame frame = paint_frame({scene, i == 0 ? nullptr : &known}, {}, {}, memory);
    EXPECT_EQ(frame.shown.views.size(), 1u);
    EXPECT_EQ(frame.shown.worst_bare_share, 0);
    if (i > 0) {
      const StrokeChanges changes = compare_strokes(before, layers_of(frame), 0.5);
      EXPECT_GT(static_cast<double>(changes.survived) / static_cast<double>(changes.whole), 0.85);
      EXPECT_EQ(changes.popped, 0);
    }
    before = layers_of(frame);
  }
}

TEST(StrokesInTime, RefusesAStyleWithoutStrokes) {
  StrokeMemory memory;
  const std::vector<View> scene = film().scene(0);
  expect_error(ErrorKind::wrong_usage, "not strokes", [&] {
    plan_strokes({scene, nullptr}, style_by_name("mosaic"), {}, memory);
  });
}

TEST(CompareStrokes, TellsWhatPopsFromWhatFades) {
  const auto frame = [](std::initializer_list<std::pair<std::uint32_t, float>> strokes) {
    Layer layer;
    for (const auto& [number, opacity] : strokes) layer.strokes.push_back({.opacity = opacity, .number = number});
    return std::vector<Layer>{layer};
  };
  const auto first = frame({{1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 0.5f}});
  const StrokeChanges fades = compare_strokes(first, frame({{1, 1}, {2, 0.75f}, {4, 1}, {5, 1}, {6, 0.5f}}), 0.5);
  EXPECT_EQ(fades.whole, 4);
  EXPECT_EQ(fades.survived, 2);
  EXPECT_EQ(fades.hidden, 1);
  EXPECT_EQ(fades.popped, 0);
  EXPECT_EQ(compare_strokes(first, frame({{1, 0.25f}, {7, 1}}), 0.5).popped, 2);
}

TEST(CompareStrokes, CountsADualStrokeOnceAndEachPartThatPops) {
  Layer layer;
  for (const std::uint32_t number : {1, 2, 3, 4})
    layer.strokes.push_back({.number = number, .is_part = number % 2 == 0});
  const std::vector<Layer> first{layer};
  const StrokeChanges same = compare_strokes(first, first, 0.5);
  EXPECT_EQ(same.whole, 2);
  EXPECT_EQ(same.survived, 2);
  layer.strokes[1].opacity = 0.25f;
  const StrokeChanges changed = compare_strokes(first, std::vector<Layer>{layer}, 0.5);
  EXPECT_EQ(changed.survived, 2);
  EXPECT_EQ(changed.popped, 1);
}

}  // namespace wheatstone::strokes_in_time_test
