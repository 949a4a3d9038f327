// Depth and detail that are changed by hand.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "command_table.h"
#include "inputs.h"
#include "stage.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "viewer.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/retouch_strokes.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/random.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::viewer::retouch_test {

const StereoPair& pair() {
  static const SyntheticStill made = make_synthetic_still({.width = 240, .height = 160, .samples_a_side = 1});
  return made.pictures;
}

/// A viewer in which a photograph is open and painted, seen by the left eye, each pixel as one of the frame.
class OpenPhotograph : public testing::Test {
 protected:
  OpenPhotograph() {
    write_image(folder / "left.png", pair().left);
    write_image(folder / "right.png", pair().right);
    viewer.session().items.push_back({folder / "left.png", folder / "right.png"});
    viewer.set_viewport({240, 160});
    viewer.open(0);
    viewer.wait();
    run("mode left");
    run("zero-parallax 0");
    run("separation 1");
    run("style oil");
  }
  void run(std::string_view line) {
    run_line(viewer, line);
    viewer.wait();
  }
  const PaintedContent& content() const { return std::get<PaintedContent>(viewer.session().opened.content); }
  const Image<float>& disparity() const { return content().photograph->geometry->left_disparity; }

  const TemporaryFolder folder;
  Viewer viewer;
};

std::size_t stroke_count(const Painting& painting) {
  std::size_t count = 0;
  for (const Layer& layer : layers_of(painting)) count += layer.strokes.size();
  return count;
}

TEST_F(OpenPhotograph, HasTheDepthOfAnAreaShiftedOnceHoweverOftenItIsPaintedOnTheWay) {
  const Image<float> before = disparity();
  run("retouch lasso-farther");
  run("brush-strength 3");
  run("touch 60 40");
  run("touch-on 160 40");
  run("touch-on 160 110");
  const float on_the_way = disparity()(150, 60);
  run("touch-on 60 110");
  EXPECT_FLOAT_EQ(on_the_way, before(150, 60) - 3);
  EXPECT_FLOAT_EQ(disparity()(150, 60), before(150, 60) - 3);
  EXPECT_FLOAT_EQ(disparity()(70, 100), before(70, 100) - 3);
  EXPECT_EQ(disparity()(180, 80), before(180, 80));
  run("undo");
  EXPECT_EQ(disparity(), before);
}

TEST_F(OpenPhotograph, IsPaintedAnewWithTheDepthThatAHandGaveIt) {
  const Image<float> before = disparity();
  const std::optional<float> seen = disparity_under(viewer, 120, 80);
  ASSERT_TRUE(seen);
  run("retouch nearer");
  run("brush-radius 20");
  run("brush-strength 4");
  run("touch 120 80");
  EXPECT_NEAR(disparity()(119, 80), before(119, 80) + 4, 0.01f);
  EXPECT_EQ(disparity()(60, 80), before(60, 80));
  EXPECT_NEAR(disparity_under(viewer, 120, 80).value_or(0), *seen + 4, 1);
  run("retouch flatten");
  run("touch 60 40");
  EXPECT_NEAR(disparity()(62, 42), disparity()(59, 39), 0.6f);
}

TEST_F(OpenPhotograph, EqualsPlanningAnewWithTheSameMapHoweverManyTouches) {
  run("brush-radius 12");
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto random = [&](std::uint64_t what) { return unit_float(hash_keys({i, what})); };
    const auto tool = 1 + hash_keys({i, 3}) % (retouch_tool_names.size() - 1);
    run_line(viewer, fmt::format("retouch {}", retouch_tool_names[tool]));
    run_line(viewer, fmt::format("touch {} {} {}", 240 * random(1), 160 * random(2), random(4)));
    if (i % 20 == 19) viewer.wait();
  }
  ASSERT_FALSE(viewer.session().state.touches.empty());
  run("save-disparity " + (folder / "map.pfm").string());
  viewer.finish_saving();
  const Image<float> map = read_disparity(folder / "map.pfm");
  EXPECT_EQ(map, disparity());
  Image<std::uint8_t> detail = *content().photograph->detail;
  if (detail.empty()) detail = Image<std::uint8_t>(240, 160, even_detail);
  retouch_detail(viewer.session().state.touches, detail);
  const StereoPair pictures{read_image(folder / "map_left.png"), read_image(folder / "map_right.png")};
  EXPECT_EQ(pictures.left, pair().left);
  Painting anew =
      plan_painting(pictures, geometry_from_left(map), viewer.session().state.style, {}, widest_views, detail);
  retouch_strokes(viewer.session().state.touches, anew);
  EXPECT_EQ(*content().painting, anew);
}

TEST_F(OpenPhotograph, TellsWhenAHandPushesItBeyondComfort) {
  run("separation 0.2");
  run("retouch nearer");
  run("brush-strength 3");
  run("touch 120 80");
  EXPECT_THAT(viewer.session().message, testing::Not(testing::HasSubstr("comfortable")));
  run("brush-radius 60");
  run("brush-strength 100");
  run("touch 120 80");
  EXPECT_THAT(viewer.session().message, testing::HasSubstr("more than the 3 % that are comfortable"));
}

TEST_F(OpenPhotograph, IsPaintedOnWithAColourThatIsPickedFromIt) {
  const std::size_t count = stroke_count(*content().painting);
  run("retouch pick");
  run("touch 120 80");
  const Rgb8 picked = viewer.session().retouch.colour;
  EXPECT_EQ(picked, viewer.frame()->picture(120, 80));
  EXPECT_TRUE(viewer.session().state.touches.empty());
  run("retouch paint");
  run("touch 40 40");
  run("touch-on 60 44");
  run("touch-on 80 40");
  EXPECT_EQ(stroke_count(*content().painting), count + 1);
  EXPECT_EQ(layers_of(*content().painting).back().strokes.back().colour, picked);
  run("undo");
  EXPECT_EQ(stroke_count(*content().painting), count);
}

TEST_F(OpenPhotograph, ItsStrokesAreKeptWithThePaintingThatIsSavedAndReopened) {
  run("brush-colour #10E020");
  run("retouch paint");
  run("touch 40 40");
  run("touch-on 80 40");
  run("retouch nearer");
  run("touch 150 90");
  run("save-painting " + (folder / "by_hand.wst").string());
  viewer.finish_saving();
  const Painting saved = read_painting(folder / "by_hand.wst");
  EXPECT_EQ(saved, *content().painting);
  run("open " + (folder / "by_hand.wst").string());
  EXPECT_EQ(*content().painting, saved);
  run("retouch erase");
  run("touch 60 40");
  EXPECT_LT(stroke_count(*content().painting), stroke_count(saved));
  EXPECT_THROW(run("retouch nearer\ntouch 60 40"), Error);
  run("undo");
  EXPECT_EQ(*content().painting, saved);
}

TEST_F(OpenPhotograph, ShowsWhatAHandDoesWhileItGoesOn) {
  run("retouch nearer");
  run("touch 40 80");
  std::shared_ptr<const Painting> seen = content().painting;
  int shown = 0;
  for (int touch = 0; shown < 3; ++touch) {
    run_line(viewer, fmt::format("touch-on {} 80", 40 + touch % 160));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    viewer.collect();
    if (content().painting == seen) continue;
    seen = content().painting;
    ++shown;
    EXPECT_EQ(content().touches.size(), content().photograph->touches.size());
    EXPECT_LE(content().touches.size(), viewer.session().state.touches.size());
  }
  viewer.wait();
  EXPECT_EQ(viewer.frame()->picture,
            Stage().draw(viewer.session().opened.content, viewer.session().state, {240, 160}).picture);
  EXPECT_EQ(content().touches, viewer.session().state.touches);
  EXPECT_EQ(*content().painting,
            plan_painting(pictures_to_paint(*content().photograph), *content().photograph->geometry,
                          viewer.session().state.style, {}, widest_views, *content().photograph->detail));
}

TEST_F(OpenPhotograph, ShowsStrokesOfAHandAtOnce) {
  run("retouch paint");
  const std::size_t count = stroke_count(*content().painting);
  run_line(viewer, "touch 120 80");
  const std::shared_ptr<const Painting> before = content().painting;
  while (content().painting == before) viewer.collect();
  EXPECT_EQ(stroke_count(*content().painting), count + 1);
  EXPECT_EQ(content().painting->surfaces, before->surfaces);
  const std::shared_ptr<const Painting> at_once = content().painting;
  viewer.wait();
  EXPECT_EQ(*content().painting, *at_once);
}

TEST_F(OpenPhotograph, ComesBackByUndoAStrokeOfTheHandAtATime) {
  const std::shared_ptr<const Painting> first = content().painting;
  const Image<float> found = disparity();
  run("retouch farther");
  run("touch 100 80");
  run("touch-on 110 80");
  run("touch-on 120 80");
  run("touch 60 60");
  EXPECT_EQ(viewer.session().state.touches.size(), 4u);
  run("undo");
  EXPECT_EQ(viewer.session().state.touches.size(), 3u);
  run("undo");
  EXPECT_TRUE(viewer.session().state.touches.empty());
  EXPECT_EQ(disparity(), found);
  EXPECT_EQ(*content().painting, *first);
  run("redo");
  EXPECT_EQ(viewer.session().state.touches.size(), 3u);
  run("untouched");
  EXPECT_EQ(*content().painting, *first);
}

TEST_F(OpenPhotograph, IsPaintedFinerWhereAHandWantsIt) {
  const std::size_t before = stroke_count(*content().painting);
  run("retouch finer");
  run("brush-radius 60");
  run("brush-strength 3");
  run("touch 120 80");
  EXPECT_GT(stroke_count(*content().painting), 1.1 * static_cast<double>(before));
}

TEST_F(OpenPhotograph, ShowsItsDepthOverThePhotograph) {
  run("compare photograph");
  const Image<Rgb8> photograph = viewer.frame()->picture;
  run("compare depth");
  const Image<Rgb8> depth = viewer.frame()->picture;
  EXPECT_NE(depth, photograph);
  run("retouch fill-near");
  run("touch 120 20");
  EXPECT_NE(viewer.frame()->picture, depth);
}

TEST_F(OpenPhotograph, TakesItsTouchesAlong) {
  run("retouch nearer");
  run("touch 120 80");
  write_painting(folder / "painting.wst", *content().painting);
  viewer.session().items.push_back({folder / "painting.wst"});
  viewer.open(1);
  viewer.wait();
  EXPECT_TRUE(viewer.session().state.touches.empty());
  expect_error(ErrorKind::wrong_usage, "there is no photograph to retouch", [&] { run("touch 120 80"); });
}

TEST_F(OpenPhotograph, SavesThePicturesThatTheMapBelongsToWhereTheyWereRectified) {
  run("save-disparity " + (folder / "map.png").string());
  viewer.finish_saving();
  EXPECT_FALSE(std::filesystem::exists(folder / "map_left.png"));
  // The right eye's camera stood a little lower.
  Image<Rgb8> lower(240, 160);
  for (int y = 0; y < 160; ++y) std::ranges::copy(pair().right.row(std::min(y + 4, 159)), lower.row(y).begin());
  write_image(folder / "lower.png", lower);
  viewer.session().items.push_back({folder / "left.png", folder / "lower.png"});
  viewer.open(1);
  viewer.wait();
  ASSERT_TRUE(content().photograph->is_rectified);
  run("save-disparity " + (folder / "map.png").string());
  viewer.finish_saving();
  viewer.wait();
  const Image<Rgb8> left = read_image(folder / "map_left.png");
  EXPECT_EQ(left, content().photograph->pictures.left);
  EXPECT_EQ(read_disparity(folder / "map.png").width(), left.width());
  EXPECT_NE(viewer.session().message.find("the pictures that it belongs to"), std::string::npos);
}

TEST_F(OpenPhotograph, HasNoTouchesOfTheOneBefore) {
  run("retouch nearer");
  run("touch 120 80");
  run("open " + (folder / "right.png").string() + " " + (folder / "left.png").string());
  EXPECT_TRUE(viewer.session().state.touches.empty());
  run("undo");
  EXPECT_TRUE(viewer.session().state.touches.empty());
  EXPECT_FALSE(content().photograph->found);
}

TEST_F(OpenPhotograph, IsTouchedWhereAStrokeFirstMeetsIt) {
  run("zoom 0.5");
  run("retouch nearer");
  run("touch 1 1");  // beside it
  EXPECT_TRUE(viewer.session().state.touches.empty());
  run("touch-on 120 80");
  run("touch-on 125 80");
  EXPECT_EQ(viewer.session().state.touches.size(), 2u);
  run("undo");
  EXPECT_TRUE(viewer.session().state.touches.empty());
}

TEST_F(OpenPhotograph, IsTouchedInTheRightEyesPictureToo) {
  const Image<float> before = disparity();
  run("mode right");
  run("retouch nearer");
  run("brush-radius 6");
  run("touch 120 80");
  double sum = 0, column = 0;
  for (int x = 0; x < 240; ++x) {
    const double change = static_cast<double>(disparity()(x, 80)) - before(x, 80);
    sum += change;
    column += change * (x + 0.5);
  }
  ASSERT_GT(sum, 0);
  const double middle = column / sum;
  EXPECT_NEAR(middle - static_cast<double>(before(static_cast<int>(middle), 80)), 120, 2);
}

TEST_F(OpenPhotograph, KeepsItsFilesWhateverIsSaved) {
  for (const char* name : {"left.png", "right.png"})
    expect_error(ErrorKind::wrong_usage, "input", [&] { run("save-disparity " + (folder / name).string()); });
}

TEST_F(OpenPhotograph, SaysWhyItCannotBeTouched) {
  expect_error(ErrorKind::wrong_usage, "no tool is chosen", [&] { run("touch 120 80"); });
  expect_error(ErrorKind::wrong_usage, "'hammer' is no tool", [&] { run("retouch hammer"); });
  run("style impressionist");
  run("retouch finer");
  expect_error(ErrorKind::wrong_usage, "oil reads the detail map", [&] { run("touch 120 80"); });
  EXPECT_TRUE(viewer.session().state.touches.empty());
}

}  // namespace wheatstone::viewer::retouch_test
