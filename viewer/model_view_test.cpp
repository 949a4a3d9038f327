#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "command_line.h"
#include "command_table.h"
#include "command_views.h"
#include "model_drawer.h"
#include "orbit.h"
#include "psnr.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "viewer.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone::viewer::model_view_test {

using testing::HasSubstr;

/// A viewer in which a tetrahedron is open, whose corners lie far from the origin of its coordinates.
class OpenModel : public testing::Test {
 protected:
  OpenModel() {
    write_whole_file(folder / "tetrahedron.obj",
                     "v 101 201 301\nv 99 199 301\nv 99 201 299\nv 101 199 299\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n");
    viewer.session().items.push_back({folder / "tetrahedron.obj"});
    viewer.set_viewport({240, 160});
    viewer.open(0);
    viewer.wait();
    run("mode left-right");
  }
  void run(std::string_view line) {
    run_line(viewer, line);
    viewer.wait();
  }
  ViewState& state() { return viewer.session().state; }
  const Content& content() const { return viewer.session().opened.content; }
  std::optional<SeenPoint> seen_at(double x, double y) const {
    const std::optional<PlaceInView> place = place_at(viewer.frame()->places, x, y);
    return place ? point_at(viewer, *place) : std::nullopt;
  }

  const TemporaryFolder folder;
  Viewer viewer;
};

TEST_F(OpenModel, IsTheViewsOfTheCommandThatItTells) {
  run("orbit 20 -30");
  run("magnify 1.7");
  run("pan 11 -7");
  run("near 40");
  run("far 60");
  run("projection orthographic");
  const auto made = views_of_told(viewer, folder);
  // The point that is looked at is told in the model's own coordinates, to the last bit of these.
  for (const int eye : {0, 1}) EXPECT_GT(psnr_db(shown_to(viewer, eye), made[static_cast<std::size_t>(eye)]), 50);
  EXPECT_NE(made[0], made[1]);
}

/// With both projections.
class OpenModelSeen : public OpenModel, public testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(In, OpenModelSeen, testing::Values("perspective", "orthographic"),
                         [](const auto& projection) { return projection.param; });

TEST_P(OpenModelSeen, IsLookedAtWhereItIsSeen) {
  run("projection " + GetParam());
  run("mode left");
  EXPECT_FALSE(seen_at(1, 1)) << "beside it";
  const std::optional<SeenPoint> before = seen_at(110, 70);
  ASSERT_TRUE(before);
  run("look-at-place 110 70");
  ASSERT_TRUE(state().orbit.look_at);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR((*state().orbit.look_at)[axis], before->position[axis], 1e-4);
  // Seen from above, it is still in the middle of the central view.
  run("orbit 40 50");
  run("separation 0");
  const std::optional<SeenPoint> after = seen_at(120, 80);
  ASSERT_TRUE(after);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(after->position[axis], before->position[axis], 0.05);
  run("look-at-place 1 1");
  EXPECT_EQ(viewer.session().message, "there is nothing there");
}

TEST_F(OpenModel, IsCentredAtAPointOfItsOwnCoordinates) {
  // Up is y in the file and z in the scene.
  run("look-at 301 101 201");
  EXPECT_EQ(state().orbit.look_at, (std::array<float, 3>{1, 1, 1}));
  EXPECT_THAT(command_line_of(viewer.session()), HasSubstr("--look-at=301,101,201"));
}

TEST_F(OpenModel, IsShownOnADisplayWithManyViews) {
  run("mode quilt");
  run("display looking-glass-go");
  EXPECT_THAT(command_line_of(viewer.session()), HasSubstr("--display looking-glass-go"));
  EXPECT_FALSE(viewer.frame()->picture.empty());
}

TEST_F(OpenModel, IsGoneAroundOnACamerasPath) {
  run("add-key");
  run("seek-to 5");
  run("orbit 90 0");
  run("add-key");
  ASSERT_TRUE(viewer.session().film);
  EXPECT_TRUE(viewer.session().film->of_particles);
  run("seek-to 2.5");
  EXPECT_NEAR(state().orbit.azimuth_deg, ViewState().orbit.azimuth_deg + 45, 1);
}

TEST_F(OpenModel, HasNoLookOfParticles) {
  for (const char* name : {"quantity", "opacity", "focus-gain"})
    EXPECT_FALSE(applies(viewer, find_command(name))) << name;
  for (const char* name : {"orbit", "magnify", "near", "projection", "add-key"})
    EXPECT_TRUE(applies(viewer, find_command(name))) << name;
}

TEST_F(OpenModel, HasFewerPixelsWhereItIsWantedQuickly) {
  const ReadyModel& model = *std::get<ModelContent>(content()).model;
  ModelDrawer drawer;
  const Rig rig{1600, 1200, {left_eye, right_eye}};
  const DrawnModel quick = drawer.draw(model, state(), rig, Effort::quick);
  EXPECT_LT(quick.scale, 1);
  EXPECT_EQ(quick.views.front().width(), 1600 * quick.scale);
  EXPECT_FALSE(quick.depth);
  const DrawnModel whole = drawer.draw(model, state(), rig, Effort::whole);
  EXPECT_EQ(whole.scale, 1);
  EXPECT_EQ(whole.depth->size(), 2u);
}

TEST_F(OpenModel, ThatIsDamagedIsToldInOneLine) {
  write_whole_file(folder / "damaged.obj", "v 1 2 3\nf 1 2 9\n");
  viewer.session().items.push_back({folder / "damaged.obj"});
  viewer.open(1);
  viewer.wait();
  EXPECT_THAT(viewer.session().message, HasSubstr("damaged.obj"));
}

}  // namespace wheatstone::viewer::model_view_test
