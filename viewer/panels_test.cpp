#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>
#include <vector>

#include "cli/run.h"
#include "command_line.h"
#include "command_table.h"
#include "depth_seen.h"
#include "output_mode.h"
#include "script.h"
#include "style_controls.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/depth/disparity_mapping.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::viewer::panels_test {

using testing::HasSubstr;

constexpr int width = 240, height = 160;

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still({.width = width, .height = height, .samples_a_side = 1});
  return made;
}

const Painting& painting() {
  static const Painting planned = plan_painting(still().pictures, still().geometry, {});
  return planned;
}

/// A viewer in which the painting is open.
class PanelsOfAPainting : public testing::Test {
 protected:
  PanelsOfAPainting() {
    write_painting(folder / "still.wst", painting());
    viewer.session().items.push_back({folder / "still.wst"});
    viewer.set_viewport({width, height});
    viewer.open(0);
    viewer.wait();
  }
  void run(std::string_view line) {
    run_line(viewer, line);
    viewer.wait();
  }
  Image<Rgb8> picture_of(const char* mode) {
    run(fmt::format("mode {}", mode));
    return viewer.frame()->picture;
  }

  const TemporaryFolder folder;
  Viewer viewer;
};

/// Three flat things, one above the other, and how near they are: each is `band_rows` high.
constexpr int band_rows = 54;
constexpr std::array band_disparities_px{12, 7, 2};

Painting painting_of_bands() {
  constexpr int reach = 16;
  std::mt19937 random(5);
  std::uniform_int_distribution<int> level(0, 255);
  Image<Rgb8> texture(width + reach, 3 * band_rows);
  constexpr int patch = 4;
  for (int y = 0; y < texture.height(); y += patch)
    for (int x = 0; x < texture.width(); x += patch) {
      const Rgb8 colour{static_cast<std::uint8_t>(level(random)), static_cast<std::uint8_t>(level(random)), 90};
      for (int j = y; j < std::min(y + patch, texture.height()); ++j)
        for (int i = x; i < std::min(x + patch, texture.width()); ++i) texture(i, j) = colour;
    }
  StereoPair pair{{width, texture.height()}, {width, texture.height()}};
  Image<float> disparity(width, texture.height());
  for (int y = 0; y < texture.height(); ++y) {
    const int nearness_px = band_disparities_px[static_cast<std::size_t>(y / band_rows)];
    for (int x = 0; x < width; ++x) {
      pair.left(x, y) = texture(x, y);
      pair.right(x, y) = texture(x + nearness_px, y);
      disparity(x, y) = static_cast<float>(nearness_px);
    }
  }
  return plan_painting(pair, geometry_from_both(disparity, disparity), {});
}

/// The disparity of what two pictures show in a window around a place of the left one: where it differs least from the
/// other's, by a parabola through the neighbours.
double measured_disparity(const Image<Rgb8>& left, const Image<Rgb8>& right, int x, int y) {
  constexpr int half_width = 24, half_height = 12, most_px = 16;
  const auto difference = [&](int disparity) {
    double sum = 0;
    for (int j = -half_height; j <= half_height; ++j)
      for (int i = -half_width; i <= half_width; ++i) {
        const Rgb8 a = left(x + i, y + j), b = right(x + i - disparity, y + j);
        sum += std::pow(a.r - b.r, 2) + std::pow(a.g - b.g, 2);
      }
    return sum;
  };
  std::vector<double> differences;
  for (int disparity = -most_px - 1; disparity <= most_px + 1; ++disparity)
    differences.push_back(difference(disparity));
  const auto best = std::min_element(differences.begin() + 1, differences.end() - 1);
  return static_cast<double>(best - differences.begin()) - most_px - 1 +
         (best[-1] - best[1]) / (2 * (best[-1] + best[1] - 2 * best[0]));
}

TEST_F(PanelsOfAPainting, ShowsEachRegionAsDeepAsItWasSet) {
  write_painting(folder / "bands.wst", painting_of_bands());
  viewer.set_viewport({width, 3 * band_rows});
  run(fmt::format("open \"{}\"", (folder / "bands.wst").string()));
  const ViewingGeometry viewing = viewing_of(find_display("desk-stereo"));
  const float pixel_mm = viewing.screen_width_mm / width;
  // From the nearest to the farthest, and the middle one half way; more depth than is photographed, less, and none.
  for (const std::array<float, 3> behind_mm :
       {std::array{-40.f, -10.f, 30.f}, {-12.f, -9.f, 3.f}, {-20.f, 15.f, 15.f}}) {
    run(fmt::format("depth-mapping 0:{},0.5:{},1:{}", behind_mm[0], behind_mm[1], behind_mm[2]));
    const Image<Rgb8> left = picture_of("left"), right = picture_of("right");
    for (std::size_t band = 0; band < behind_mm.size(); ++band) {
      const double expected_px = -screen_parallax_mm(viewing, behind_mm[band]) / pixel_mm;
      const int y = static_cast<int>(band) * band_rows + band_rows / 2;
      for (int x = 48; x <= width - 48; x += 24)
        EXPECT_NEAR(measured_disparity(left, right, x, y), expected_px, 0.5) << behind_mm[band] << " mm at " << x;
    }
  }
}

TEST_F(PanelsOfAPainting, PutsWhatIsMappedOntoTheScreenThereAndTellsItsDepthInMillimetres) {
  run("depth-mapping 0:-40,1:60");
  const std::optional<DepthSeen> seen = depth_seen(viewer);
  ASSERT_TRUE(seen);
  // The picture is 240 of the display's 1280 pixels wide.
  const ViewingGeometry viewing = viewing_of(find_display("desk-stereo"));
  const float part = static_cast<float>(width) / static_cast<float>(viewing.width_px);
  EXPECT_NEAR(seen->near_mm, -perceived_depth_mm(viewing, part * screen_parallax_mm(viewing, -40)), 0.5);
  EXPECT_NEAR(seen->far_mm, perceived_depth_mm(viewing, part * screen_parallax_mm(viewing, 60)), 0.5);
  EXPECT_THAT(state_json(viewer), HasSubstr(R"("depth_mapping":"0:-40,1:60")"));
  run("depth-mapping reset");
  EXPECT_TRUE(viewer.session().state.depth_regions.empty());
  EXPECT_EQ(picture_of("left"), picture_of("left"));
  expect_error(ErrorKind::wrong_usage, "behind the viewer", [&] { run_line(viewer, "depth-mapping 0:-800,1:9"); });
  expect_error(ErrorKind::wrong_usage, "SHARE:MM", [&] { run_line(viewer, "depth-mapping 0:3,0:4"); });
}

TEST_F(PanelsOfAPainting, TellsWhetherTheWholePictureIsComfortableAtThisZoom) {
  run("separation 1");
  run("zero-parallax 8");
  const DepthSeen small = *depth_seen(viewer);
  EXPECT_TRUE(small.discomforts.empty());
  EXPECT_THAT(state_json(viewer), HasSubstr(R"("is_comfortable":true)"));
  run("zoom 2");
  EXPECT_NEAR(depth_seen(viewer)->total_percent, 2 * small.total_percent, 0.01);
  run("zoom 40");
  run("comfort");
  EXPECT_FALSE(depth_seen(viewer)->discomforts.empty());
  EXPECT_THAT(viewer.session().message, HasSubstr("not comfortable on desk-stereo: "));
}

TEST_F(PanelsOfAPainting, HideExactlyTheLayersInFrontOfTheSlicingPlane) {
  run("separation 1");
  run("zero-parallax 0");
  const std::size_t layers = layers_of(painting()).size();
  ASSERT_EQ(layers, 3u);
  for (std::size_t finest = 0; finest < layers; ++finest) {
    Painting sliced = painting();
    std::get<StrokePainting>(sliced.marks).layers.resize(finest + 1);
    run(fmt::format("finest-layer {}", finest));
    EXPECT_EQ(picture_of("left"), draw(sliced, left_eye).picture) << finest;
  }
}

TEST_F(PanelsOfAPainting, ShowPlanesThatCanBeDraggedBesideTheLayers) {
  run("mode left");
  run("slice-depth 20%,50%");
  EXPECT_TRUE(viewer.frame()->planes.empty());
  run("layers-apart 40");
  ASSERT_EQ(viewer.frame()->planes.size(), 2u);
  const PlaneFrame before = viewer.frame()->planes[1];
  const FramePoint &a = before.corners[0], &b = before.corners[1];
  EXPECT_EQ(plane_at(viewer.frame()->planes, (a.x + b.x) / 2, (a.y + b.y) / 2 + 2), 1u);
  EXPECT_EQ(plane_at(viewer.frame()->planes, -200, -200), std::nullopt);
  run("slice-move 1 0.25");
  EXPECT_EQ(slice_depths_text(viewer.session().state.slicing.depths), "20%,75%");
  // A pointer that moves so far along the way keeps the plane under it.
  const PlaneFrame& now = viewer.frame()->planes[1];
  EXPECT_NEAR((now.corners[0].x + now.corners[2].x - a.x - before.corners[2].x) / 2, before.way.x / 4, 3);
  run("slice-move 1 -0.9");
  EXPECT_EQ(slice_depths_text(viewer.session().state.slicing.depths), "20%,0%");
}

TEST_F(PanelsOfAPainting, ShowLayersApartFromTheSide) {
  const Image<Rgb8> front = picture_of("left");
  run("layers-apart 40");
  const Image<Rgb8> all = picture_of("left"), right = picture_of("right");
  EXPECT_NE(all, front);
  EXPECT_NE(all, right) << "two eyes see the layers from two sides";
  run("finest-layer 0");
  EXPECT_NE(picture_of("left"), all);
  run("finest-layer 2");
  EXPECT_EQ(picture_of("left"), all);
  run("layers-apart off");
  EXPECT_EQ(picture_of("left"), front);
}

TEST_F(PanelsOfAPainting, ShowSlicingPlanesAsFramesThatMoveThroughTheirLayers) {
  struct Frames {
    int pixels = 0;
    double middle = 0;  ///< mean column
  };
  const auto frames_of = [](const Image<Rgb8>& picture) {
    Frames found;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x)
        if (const Rgb8 c = picture(x, y); c.r == 255 && c.g == 160 && c.b == 0) found.middle += x, ++found.pixels;
    found.middle /= std::max(found.pixels, 1);
    return found;
  };
  run("layers-apart 40");
  EXPECT_EQ(frames_of(picture_of("left")).pixels, 0);
  double before = 1e9;
  for (const char* depth : {"0%", "30%", "70%", "100%"}) {
    run(fmt::format("slice-depth {}", depth));
    const Frames frames = frames_of(picture_of("left"));
    EXPECT_GT(frames.pixels, 100) << depth;
    EXPECT_LT(frames.middle, before) << "from the right the nearer stands more to the right: " << depth;
    before = frames.middle;
  }
  const int one = frames_of(picture_of("left")).pixels;
  run("slice-depth 100%,50%");
  EXPECT_GT(frames_of(picture_of("left")).pixels, one) << "a frame for each plane";
  run("slice-depth off");
  EXPECT_EQ(frames_of(picture_of("left")).pixels, 0);
}

TEST_F(PanelsOfAPainting, AreTheCommandThatCopyCommandTells) {
  run("depth-mapping 0:-20,0.5:0,1:30");
  for (const char* mode : {"left-right", "quilt"}) {
    run(fmt::format("display {}", mode == std::string_view("quilt") ? "looking-glass-go" : "desk-stereo"));
    run(fmt::format("mode {}", mode));
    const std::string line = command_line_of(viewer.session());
    EXPECT_THAT(line, HasSubstr("--depth-mapping 0:-20,0.5:0,1:30"));
  }
  run("mode left");
  run("display desk-stereo");
  Words words = words_of(command_line_of(viewer.session()));
  words.erase(words.begin());
  words.back() = folder / "painted";
  std::ostringstream output, errors;
  ASSERT_EQ(cli::run_command_line(words, output, errors), 0) << errors.str();
}

TEST_F(PanelsOfAPainting, LetLightOfNeighboursThrough) {
  run("separation 1");
  const Image<Rgb8> left = picture_of("left"), right = picture_of("right");
  run("crosstalk 25");
  const Image<Rgb8> mixed = picture_of("left");
  for (int x = 20; x < width - 20; ++x)
    ASSERT_NEAR(mixed(x, 80).g, 0.75 * left(x, 80).g + 0.25 * right(x, 80).g, 1.01) << x;
  run("display nine-view");
  run("lens-simulator on");
  EXPECT_THAT(seen_views_told(viewer.session().state), HasSubstr("of 9"));
  const Leaks leaks = leaks_of(viewer.session().state);
  ASSERT_EQ(leaks.left.size(), 2u);
  EXPECT_FLOAT_EQ(leaks.left.front().share, 0.125f);
  EXPECT_LT(leaks.left.front().view, eye_positions(viewer.session().state).left);
}

TEST(StyleControls, ThereIsOneForEveryParameterThatTakesWhatStylesHave) {
  ASSERT_EQ(style_controls().size(), style_parameters().size());
  for (const StyleControl& control : style_controls())
    for (const std::string_view name : style_names()) {
      Style style = style_by_name(name);
      const std::string value = plain_value(*control.parameter, style);
      control.parameter->set(style, value);
      EXPECT_EQ(plain_value(*control.parameter, style), value) << control.parameter->name;
      if (const auto* const range = std::get_if<NumberControl>(&control.kind)) {
        EXPECT_GE(std::stod(value), range->least) << control.parameter->name << ' ' << name;
        EXPECT_LE(std::stod(value), range->most) << control.parameter->name << ' ' << name;
      }
      if (const auto* const choice = std::get_if<ChoiceControl>(&control.kind)) {
        EXPECT_THAT(choice->names, testing::Contains(value)) << control.parameter->name;
        for (const std::string_view each : choice->names) control.parameter->set(style, each);
      }
    }
}

TEST(ComfortableDepth, IsWhereDiscomfortBegins) {
  const ComfortableDepth desk = comfortable_depth(viewing_of(find_display("desk-stereo")));
  EXPECT_NEAR(desk.near_mm, 100, 1);
  EXPECT_NEAR(desk.far_mm, 100, 1);
}

}  // namespace wheatstone::viewer::panels_test
