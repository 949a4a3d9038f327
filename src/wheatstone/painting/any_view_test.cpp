// Paintings of a pair seen from views between and beside its eyes.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "wheatstone/curves/plan_diffusion.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/plan_painting.h"
#include "wheatstone/painting/still_scene.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/view_scale.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::any_view_test {

const SyntheticStillOptions still_options{.width = 320, .height = 240, .samples_a_side = 1};

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still(still_options);
  return made;
}

const Image<Rgb8>& truth(float position) {
  static std::map<float, Image<Rgb8>> views;
  Image<Rgb8>& view = views[position];
  if (view.empty()) view = make_synthetic_view(still_options, ViewPosition(position)).picture;
  return view;
}

double rms(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Rgb8 p = a.pixels()[i], q = b.pixels()[i];
    sum += std::pow(p.r - q.r, 2) + std::pow(p.g - q.g, 2) + std::pow(p.b - q.b, 2);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(a.pixels().size())));
}

constexpr ViewRange range{ViewPosition(-1.25f), ViewPosition(1.25f)};

/// About the middle of the still's depths; a view is shifted by whole pixels when it has no parallax there.
constexpr float zero_parallax_px = 12;

Painting plan(const char* name, ViewRange wanted = range) {
  return plan_painting(still().pictures, still().geometry, style_by_name(name), {}, wanted);
}

/// As a display shows views.
PreparedPainting on_display(const Painting& painting) {
  return prepare(painting, {.placement = {.zero_parallax_px = zero_parallax_px}});
}

Image<Rgb8> seen(const Painting& painting, float position) {
  return draw(on_display(painting), ViewPosition(position)).picture;
}

/// How far a view on a display is from what a camera at its place would take.
double error_at(float position, const Image<Rgb8>& view) {
  const Image<Rgb8>& there = truth(position);
  const int shift = static_cast<int>(std::lround(position * zero_parallax_px)), width = view.width();
  const int first = std::max(shift, 0), end = std::min(width + shift, width);
  Image<Rgb8> part(end - first, view.height()), true_part(end - first, view.height());
  for (int y = 0; y < view.height(); ++y) {
    for (int x = first; x < end; ++x) {
      part(x - first, y) = view(x, y);
      true_part(x - first, y) = there(x - shift, y);
    }
  }
  return rms(part, true_part);
}

class AnyView : public testing::TestWithParam<const char*> {
 protected:
  const Painting& painting() const {
    static std::map<std::string, Painting> planned;
    const auto [at, is_new] = planned.try_emplace(GetParam());
    if (is_new) at->second = plan(GetParam());
    return at->second;
  }
};

/// Lines that were not compared with the eyes' photographs.
Painting not_mended(const Painting& painting) {
  const std::vector<View> views = scene_from_left(still().pictures, still().geometry);
  return {plan_diffusion(views, style_by_name("diffusion")), painting.surfaces};
}

TEST_P(AnyView, IsAsTrueAsTheEyes) {
  // What has no line is mended where a photograph shows it: other views are to be as true as eyes without that.
  const bool is_mended = std::holds_alternative<DiffusionPainting>(painting().marks);
  const double eye = error_at(-0.5f, seen(is_mended ? not_mended(painting()) : painting(), -0.5f));
  // The naive way: all marks, whatever hides them. Regions hide each other by their own disparities, too.
  Painting naive = painting();
  naive.surfaces = {};
  for (const float position : {-1.25f, -0.8f, -0.25f, 0.f, 0.3f, 1.25f}) {
    const double ours = error_at(position, seen(painting(), position));
    RecordProperty("at_" + std::to_string(position), std::to_string(ours / eye));
    EXPECT_LT(ours, (std::abs(position) <= 0.5f ? 1.1 : 1.15) * eye) << position;
    if (!std::holds_alternative<RegionPainting>(painting().marks)) {
      EXPECT_GT(error_at(position, seen(naive, position)), 1.05 * ours) << position;
    }
    // The left eye's picture as it is, but for the views next to it.
    if (std::abs(position + 0.5f) >= 0.5f) {
      EXPECT_GT(error_at(position, seen(painting(), -0.5f)), ours) << position;
    }
  }
}

TEST(AnyViewOfLines, IsTruerWhereTheEyesAreMended) {
  const Painting mended = plan("diffusion"), planned = not_mended(mended);
  for (const float position : {-0.8f, -0.5f, 0.f, 0.5f})
    EXPECT_LT(error_at(position, seen(mended, position)), 0.95 * error_at(position, seen(planned, position)))
        << position;
}

TEST_P(AnyView, IsNotLeftBare) {
  const double most = std::holds_alternative<RegionPainting>(painting().marks) ? 0.004 : 0.002;
  for (const float position : {-1.25f, -0.9f, -0.5f, -0.2f, 0.f, 0.5f, 0.7f, 1.25f}) {
    const double bare = draw(on_display(painting()), ViewPosition(position)).bare_share;
    RecordProperty("at_" + std::to_string(position), std::to_string(bare));
    EXPECT_LT(bare, std::abs(position) <= 0.5f ? 0.001 : most) << position;
  }
}

TEST_P(AnyView, DoesNotJumpFromItsNeighbours) {
  std::vector<ViewPosition> positions;
  for (int i = 0; i <= 20; ++i) positions.emplace_back(-0.5f + 0.05f * static_cast<float>(i));
  const std::vector<DrawnView> views = draw(prepare(painting()), positions);
  std::vector<double> steps;
  for (std::size_t i = 1; i < views.size(); ++i) steps.push_back(rms(views[i - 1].picture, views[i].picture));
  std::vector<double> sorted = steps;
  std::ranges::sort(sorted);
  RecordProperty("largest_step", std::to_string(sorted.back() / sorted[sorted.size() / 2]));
  EXPECT_LT(sorted.back(), 1.6 * sorted[sorted.size() / 2]);
}

TEST_P(AnyView, OfManyIsWhatIsDrawnOfItAlone) {
  const std::vector<ViewPosition> positions{ViewPosition(-1.25f), ViewPosition(-0.2f), right_eye, ViewPosition(1.25f)};
  const std::vector<DrawnView> many = draw(prepare(painting()), positions);
  ASSERT_EQ(many.size(), positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const DrawnView alone = draw(painting(), positions[i]);
    EXPECT_EQ(many[i].picture, alone.picture);
    EXPECT_EQ(many[i].bare, alone.bare);
    EXPECT_EQ(many[i].bare_share, alone.bare_share);
  }
}

TEST_P(AnyView, IsTheSameOnAnyNumberOfThreads) {
  const std::vector<ViewPosition> positions{ViewPosition(-0.7f), ViewPosition(0.1f), ViewPosition(1.f)};
  const std::vector<DrawnView> many = draw(prepare(painting()), positions);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Painting alone = plan(GetParam());
  EXPECT_EQ(alone, painting());
  const std::vector<DrawnView> drawn = draw(prepare(alone), positions);
  for (std::size_t i = 0; i < positions.size(); ++i) EXPECT_EQ(many[i].picture, drawn[i].picture);
}

TEST_P(AnyView, BesideTheEyesCostsTheEyesNothing) {
  const Painting of_eyes = plan(GetParam(), {});
  EXPECT_LT(disparities_of_marks(of_eyes).size(), disparities_of_marks(painting()).size());
  for (const ViewPosition eye : {left_eye, right_eye}) {
    const Image<Rgb8>& photograph = eye == left_eye ? still().pictures.left : still().pictures.right;
    const double with = rms(draw(painting(), eye).picture, photograph);
    const double without = rms(draw(of_eyes, eye).picture, photograph);
    RecordProperty(eye == left_eye ? "left" : "right", std::to_string(with / without));
    EXPECT_LT(with, 1.02 * without) << eye.eye_separations();
  }
}

TEST_P(AnyView, BesideTheEyesIsWorthItsMarks) {
  const Painting of_eyes = plan(GetParam(), {});
  for (const float position : {-1.25f, 1.25f}) {
    const double with = error_at(position, seen(painting(), position));
    const double without = error_at(position, seen(of_eyes, position));
    RecordProperty("at_" + std::to_string(position), std::to_string(with / without));
    EXPECT_LT(with, without) << position;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, AnyView, testing::Values("impressionist", "posterise", "mosaic", "diffusion"),
                         [](const auto& tested) { return std::string(tested.param); });

// Beside the eyes a large picture is made smaller: what is uncovered there, and how far it is, stay the same. Views
// between the outermost and the eyes leave to it what both uncover.
TEST(OuterViews, OfALargePictureUncoverWhatTheyDoAtFullSize) {
  const SyntheticStill large = make_synthetic_still({.width = 1920, .height = 240, .samples_a_side = 1});
  const float middle_px = 72;
  const std::vector<View> views = make_outer_views(large.pictures, large.geometry, range, middle_px);
  ASSERT_FALSE(views.empty());
  for (const View& view : views) {
    const View whole = make_outer_view(scene_from_left(large.pictures, large.geometry), view.position, middle_px);
    ASSERT_EQ(view.colour.width(), whole.colour.width());
    const int shift = view.frame.origin_px - whole.frame.origin_px;  // both are rounded, one of them to four pixels
    ASSERT_LE(std::abs(shift), 2);
    const bool is_outermost = view.position == range.first || view.position == range.last;
    int uncovered = 0, differ = 0, known = 0, off = 0;
    for (int y = 0; y < whole.colour.height(); ++y) {
      for (int x = 2; x < whole.colour.width() - 2; ++x) {
        const bool at_full_size = whole.wanted(x + shift, y) != 0, made_smaller = view.wanted(x, y) != 0;
        uncovered += at_full_size ? 1 : 0;
        differ += made_smaller ? !at_full_size : at_full_size && is_outermost;
        if (!at_full_size || !made_smaller) continue;
        ++known;
        off += std::abs(whole.disparity(x + shift, y) - view.disparity(x, y)) > 4 ? 1 : 0;
      }
    }
    RecordProperty("differ_at_" + std::to_string(view.position.eye_separations()),
                   std::to_string(static_cast<double>(differ) / uncovered));
    EXPECT_LT(differ, 0.3 * uncovered) << view.position.eye_separations();
    EXPECT_LT(off, 0.1 * known) << view.position.eye_separations();
    if (is_outermost) continue;
    EXPECT_LT(known, 0.3 * uncovered) << view.position.eye_separations();
  }
}

// What no photograph shows is planned in smaller pictures, and from those of full size when frames of a film follow: to
// the same surfaces, and to paint that covers as much.
TEST(StillScene, IsPlannedAlikeFromSmallerPicturesOfWhatNoEyeSees) {
  const SyntheticStill large = make_synthetic_still({.width = 1921, .height = 243, .samples_a_side = 1});
  const std::vector<View> scene = make_still_scene(large.pictures, large.geometry, range);
  EXPECT_GT(std::ranges::count_if(scene, [](const View& view) { return view.frame.scale == 4; }), 2);
  const std::vector<View> whole = at_reference_scale(scene);
  for (const View& view : whole) EXPECT_EQ(view.frame.scale, 1);
  const auto planned_from = [](std::span<const View> views) {
    PaintingMemory nothing_before;
    return plan_frame({views, nullptr}, Style(), CarryOptions{.goes_on = false}, nothing_before).painting;
  };
  const Painting smaller = planned_from(scene), full = planned_from(whole);
  EXPECT_EQ(smaller.surfaces, full.surfaces);
  for (const ViewPosition view : {range.first, central_view, range.last}) {
    const auto bare_share = [view](const Painting& painting) {
      const float middle_px = 72;
      return draw(prepare(painting, {.placement = {.zero_parallax_px = middle_px}}), view).bare_share;
    };
    const double bare = bare_share(smaller), bare_of_full = bare_share(full);
    RecordProperty("bare_at_" + std::to_string(view.eye_separations()), std::to_string(bare));
    EXPECT_LT(bare, 0.003) << view.eye_separations();
    EXPECT_LT(bare, bare_of_full + 0.001) << view.eye_separations();
  }
  PaintingMemory nothing_before;
  std::vector<View> views = scene;
  views.back().continued = false;
  EXPECT_THROW(plan_frame({views, nullptr}, Style(), {}, nothing_before), Error) << "an eye sees it";
  views = scene;
  views.back().frame.scale = 2;
  EXPECT_THROW(plan_frame({views, nullptr}, Style(), {}, nothing_before), Error) << "its pictures are smaller yet";
}

// Through a slit between two posts the eyes see different parts of the wall, and views between them see others.
TEST(StillScene, WantsWhatIsSeenThroughASlit) {
  constexpr int width = 100, height = 20, slit_begin = 40, slit_end = 46;  // in the right eye's view
  constexpr float wall = 4, post = 16;
  Image<float> left(width, height, wall);
  for (int y = 0; y < height; ++y) {
    std::fill_n(&left(40, y), 16, post);
    std::fill_n(&left(62, y), 16, post);
  }
  const StereoGeometry geometry = geometry_from_left(std::move(left));
  const StereoPair photographs{Image<Rgb8>(width, height), Image<Rgb8>(width, height)};
  const std::vector<View> scene = make_still_scene(photographs, geometry, {});
  int told_to_be_hidden = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = slit_begin; x < slit_end; ++x) {
      EXPECT_EQ(scene[1].wanted(x, y), 255) << x;
      told_to_be_hidden += geometry.right_occlusion(x, y) != 0 ? 1 : 0;
    }
    EXPECT_EQ(scene[1].wanted(slit_begin - 1, y), 0) << "a post";
  }
  EXPECT_EQ(told_to_be_hidden, 0) << "as if it were as near as the posts";
  EXPECT_EQ(scene.back().position, central_view);
  EXPECT_TRUE(scene.back().continued);
}

TEST(EyesApart, HaveTwoViewsAndNoSurfaces) {
  for (const char* name : {"impressionist", "posterise", "diffusion"}) {
    Style style = style_by_name(name);
    style.propagation = Propagation::independent;
    const Painting apart = plan_painting(still().pictures, still().geometry, style);
    EXPECT_TRUE(apart.surfaces.seen.empty());
    EXPECT_LT(draw(apart, right_eye).bare_share, 0.01) << name;
    if (style.marks != Marks::curves) {
      EXPECT_EQ(draw(apart, central_view).bare_share, 1) << name;
    }
  }
}

}  // namespace wheatstone::any_view_test
