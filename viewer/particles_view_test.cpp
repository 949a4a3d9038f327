#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "command_line.h"
#include "command_table.h"
#include "command_views.h"
#include "inputs.h"
#include "orbit.h"
#include "particle_scene.h"
#include "psnr.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "viewer.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::viewer::particles_view_test {

using testing::HasSubstr;

/// A viewer in which particles are open: a cloud around the middle, and one particle far from it.
class OpenParticles : public testing::Test {
 protected:
  OpenParticles() {
    std::string text = "x,y,z,rho\n9,-8,7,100\n";
    for (int i = 0; i < 3000; ++i) {
      const double turn = 2.4 * i, height = 2 * (i + 0.5) / 3000 - 1, width = std::sqrt(1 - height * height);
      text += fmt::format("{:.4f},{:.4f},{:.4f},{:.3f}\n", 3 * width * std::cos(turn), 3 * width * std::sin(turn),
                          3 * height, 1 + 0.001 * i);
    }
    write_whole_file(folder / "cloud.csv", text);
    viewer.session().items.push_back({folder / "cloud.csv"});
    viewer.set_viewport({240, 160});
    viewer.open(0);
    viewer.wait();
    run("look thesis");
    run("mode left-right");
  }
  /// How like what is shown is to what the command makes that it tells: the worse eye's PSNR.
  double likeness_to_command() {
    SCOPED_TRACE(command_line_of(viewer.session()));
    const auto made = views_of_told(viewer, folder);
    return std::min(psnr_db(shown_to(viewer, 0), made[0]), psnr_db(shown_to(viewer, 1), made[1]));
  }
  void run(std::string_view line) {
    run_line(viewer, line);
    viewer.wait();
  }
  const Image<Rgb8>& picture() const { return viewer.frame()->picture; }
  ViewState& state() { return viewer.session().state; }

  const TemporaryFolder folder;
  Viewer viewer;
};

TEST_F(OpenParticles, AreTheViewsOfTheCommandThatTheyTell) {
  run("orbit 20 -30");
  run("magnify 1.7");
  run("pan 11 -7");
  run("splat 1,5");
  run("colours inferno");
  run("opacity 0.8");
  run("near 40");
  run("far 60");
  run("separation 0.8");
  for (const char* opaque : {"off", "on"}) {
    run(fmt::format("opaque {}", opaque));
    const auto made = views_of_told(viewer, folder);
    for (const int eye : {0, 1})
      EXPECT_EQ(shown_to(viewer, eye), made[static_cast<std::size_t>(eye)]) << command_line_of(viewer.session());
  }
}

TEST_F(OpenParticles, ShowTheNumbersThatRenderShows) {
  run("orbit 20 -30");
  for (const char* line :
       {"look mass", "quantity column-density", "projection orthographic", "annotate on", "title Gas",
        "annotation-depth -30", "quantity mean:rho", "stretch log", "colours viridis", "least 1.5"}) {
    run(line);
    EXPECT_GT(likeness_to_command(), 50) << line;
  }
  EXPECT_EQ(open_particles(viewer)->units.name, "rho");
  run("title \"Gas & dust\"");
  EXPECT_THAT(command_line_of(viewer.session()),
              testing::HasSubstr(" --annotate --title 'Gas & dust' --annotation-depth=-30"));
  expect_error(ErrorKind::wrong_usage, "where the viewer is", [&] { run("annotation-depth -1e4"); });
  EXPECT_EQ(state().look.annotation_behind_mm, -30);
  run("title off");
  EXPECT_THAT(command_line_of(viewer.session()), testing::Not(testing::HasSubstr("--title")));
  // Another quantity has other limits, and another picture.
  const Image<Rgb8> before = picture();
  run("quantity column-density");
  EXPECT_NE(state().look.least, 1.5f);
  EXPECT_LT(psnr_db(before, picture()), 40);
}

TEST_F(OpenParticles, AreOnlyThoseThatAConditionChooses) {
  const auto shown = [&] { return open_particles(viewer)->cloud.size(); };
  const std::size_t all = shown();
  run("where \"rho > 2 and x < 9\"");
  EXPECT_GT(likeness_to_command(), 50);
  EXPECT_NEAR(static_cast<double>(shown()), 2000, 2);
  EXPECT_THAT(command_line_of(viewer.session()), HasSubstr("--where 'rho > 2 and x < 9'"));
  expect_error(ErrorKind::wrong_usage, "where:", [&] { run("where \"rho >\""); });
  run("where \"wealth > 2\"");
  EXPECT_TRUE(viewer.session().message_is_error);
  EXPECT_THAT(viewer.session().message, HasSubstr("wealth"));
  EXPECT_EQ(state().look.choice.where, "rho > 2 and x < 9");
  run("where all");
  EXPECT_EQ(shown(), all);
  run("undo");
  EXPECT_LT(shown(), all);
}

TEST_F(OpenParticles, HaveNoTypesInATable) {
  expect_error(ErrorKind::wrong_usage, "expected TYPE=COLOUR", [&] { run("type-colours gas"); });
  run("type-colours gas=FFB347:6");
  EXPECT_TRUE(viewer.session().message_is_error);
  EXPECT_EQ(state().look.choice.type_colours, "");
}

TEST_F(OpenParticles, StayAsTheyAreWhereAQuantityIsNotThere) {
  run("quantity mean:rho");
  run("quantity mean:colour-of-money");
  EXPECT_TRUE(viewer.session().message_is_error);
  EXPECT_THAT(viewer.session().message, HasSubstr("colour-of-money"));
  EXPECT_EQ(state().look.choice.quantity, "mean:rho");
  EXPECT_GT(likeness_to_command(), 50);
}

TEST_F(OpenParticles, HaveMoreDepthWhereTheFocusIs) {
  run("look mass");
  const Image<Rgb8> before = picture();
  run("focus-gain 1.4");
  EXPECT_EQ(picture(), before) << "there is no focus yet";
  run("focus-at 60 80");
  ASSERT_TRUE(state().look.focus.at);
  EXPECT_NEAR((*state().look.focus.at)[0], 0.5, 0.01);
  EXPECT_NEAR((*state().look.focus.at)[1], 0.5, 0.01);
  run("focus-radius 0.4");
  EXPECT_LT(psnr_db(picture(), before), 50);
  EXPECT_GT(likeness_to_command(), 50);
  expect_error(ErrorKind::wrong_usage, "--focus-radius", [this] { run_line(viewer, "focus-radius 0.001"); });
  EXPECT_FLOAT_EQ(state().look.focus.radius, 0.4f);
  run("focus off");
  EXPECT_GT(likeness_to_command(), 50);
}

TEST_F(OpenParticles, GetMoreDepthWhereSomebodyLooksWithoutAJump) {
  const ScreenFocus& focus = state().look.focus;
  run("gaze-depth 1.3 1");
  run_line(viewer, "gaze 40 60");
  viewer.collect();
  ASSERT_TRUE(focus.at);
  EXPECT_LT(focus.gain, 1.3f) << "it becomes deeper, and does not jump";
  viewer.wait();
  EXPECT_EQ(focus.gain, 1.3f);
  const std::array<float, 2> first = *focus.at;
  EXPECT_GT(likeness_to_command(), 50);
  run("gaze 80 100");
  EXPECT_NE(*focus.at, first);
  EXPECT_GT((*focus.at)[1], first[1]);
  run("gaze-depth 1 1");
  EXPECT_FALSE(focus.at);
  EXPECT_THAT(command_line_of(viewer.session()), testing::Not(HasSubstr("--focus")));
}

TEST_F(OpenParticles, KeepTheirExposureUntilAnotherIsAskedFor) {
  const std::optional<float> first = state().look.exposure;
  ASSERT_TRUE(first);
  run("orbit 100 30");
  run("magnify 4");
  EXPECT_EQ(state().look.exposure, first);
  run("exposure auto");
  ASSERT_TRUE(state().look.exposure);
  EXPECT_NE(state().look.exposure, first);
  run("exposure 0.25");
  EXPECT_EQ(state().look.exposure, 0.25f);
}

/// With both projections.
class OpenParticlesSeen : public OpenParticles, public testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(In, OpenParticlesSeen, testing::Values("perspective", "orthographic"),
                         [](const auto& projection) { return projection.param; });

TEST_P(OpenParticlesSeen, AreLookedAtWhereTheyAreSeen) {
  run("projection " + GetParam());
  run("mode left");
  const Particles& particles = *open_particles(viewer);
  // Where the particle far from the others is seen.
  const Camera camera = particle_scene(particles, state(), eyes_of(viewer)).camera;
  const std::array<float, 3> single{9, -8, 7};
  std::array<float, 3> seen{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float from_camera = single[axis] - camera.position[axis];
    seen[0] += from_camera * camera.right[axis];
    seen[1] += from_camera * camera.down[axis];
    seen[2] += from_camera * camera.forward[axis];
  }
  const Scene scene = particle_scene(particles, state(), eyes_of(viewer));
  const float px_a_unit = camera.focal_px * camera.nearness(seen[2]);
  const double x = camera.centre_x_px + px_a_unit * seen[0] - 0.5 * parallax_px(scene.mapping, seen[2]);
  const double y = camera.centre_y_px + px_a_unit * seen[1];
  run(fmt::format("look-at-place {} {}", x, y));
  ASSERT_TRUE(state().orbit.look_at);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR((*state().orbit.look_at)[axis], single[axis], 0.05);
  // Turned around, it stays in the middle of what both eyes see, and a click brings it onto the screen plane.
  run("orbit 130 -40");
  run("separation 1");
  run("mode left-right");
  run("zero-parallax-at 60 80");
  const auto is_lit = [&](int at_x) {
    return picture()(at_x, 80).r + picture()(at_x, 80).g + picture()(at_x, 80).b > 60;
  };
  EXPECT_TRUE(is_lit(60));
  EXPECT_TRUE(is_lit(180));
}

TEST_F(OpenParticles, StayAtThePointerWhenMagnified) {
  run("mode left");
  run("separation 0");
  const auto brightest_near = [&](int x, int y) {
    int best = 0;
    for (int v = y - 2; v <= y + 2; ++v)
      for (int u = x - 2; u <= x + 2; ++u) best = std::max<int>(best, picture()(u, v).g);
    return best;
  };
  run("look-at 9 -8 7");
  ASSERT_GT(brightest_near(120, 80), 40);
  run("pan 30 -20");
  EXPECT_GT(brightest_near(150, 60), 40) << "moves with the pointer";
  run("zoom-at 3 150 60");
  EXPECT_GT(brightest_near(150, 60), 40) << "stays at the pointer";
  run("fit");
  EXPECT_FALSE(state().orbit.look_at);
}

TEST_F(OpenParticles, AreDrawnQuicklyFromAShareOfAsMuchLight) {
  auto many = std::make_shared<Particles>();
  const Particles& few = *open_particles(viewer);
  for (int copy = 0; copy < 100; ++copy)
    for (std::size_t i = 1; i < few.cloud.size(); ++i) {
      const auto jitter = static_cast<float>(copy) * 0.003f;
      many->cloud.x.push_back(few.cloud.x[i] + jitter);
      many->cloud.y.push_back(few.cloud.y[i] - jitter);
      many->cloud.z.push_back(few.cloud.z[i] + jitter);
      many->cloud.density.push_back(few.cloud.density[i]);
    }
  static_cast<ReadyParticles&>(*many) = ready_particles(std::move(many->cloud), "many");
  ParticleDrawer drawer;
  const Rig rig{160, 120, {left_eye, right_eye}};
  ViewState view;
  view.look.look = Look::thesis;
  view.look.exposure = 0.001f;
  const auto mean = [](const Image<Rgb8>& image) {
    double sum = 0;
    for (int y = 0; y < image.height(); ++y)
      for (const Rgb8& pixel : image.row(y)) sum += pixel.r + pixel.g + pixel.b;
    return sum / image.width() / image.height();
  };
  // Time is what the share is chosen by: a slow machine takes a smaller one.
  const DrawnParticles whole = drawer.draw(many, view, rig, Effort::whole);
  EXPECT_TRUE(whole.of_all);
  drawer.expect_seconds_a_particle(3e-6);
  const DrawnParticles quick = drawer.draw(many, view, rig, Effort::quick);
  EXPECT_FALSE(quick.of_all);
  EXPECT_EQ(quick.brightness.exposure, whole.brightness.exposure);
  // Fewer particles lie less evenly, and what the tone map takes from their bright middles their rims do not give back.
  EXPECT_GT(mean(quick.views[0]) / mean(whole.views[0]), 0.7);
  EXPECT_LT(mean(quick.views[0]) / mean(whole.views[0]), 1.1);
  // Of mass the same limits stand for less light.
  view.look.look = Look::mass;
  const DrawnParticles mass = drawer.draw(many, view, rig, Effort::whole);
  drawer.expect_seconds_a_particle(3e-6);
  const DrawnParticles less = drawer.draw(many, view, rig, Effort::quick);
  EXPECT_FALSE(less.of_all);
  EXPECT_NEAR(less.brightness.most / mass.brightness.most, 1, 1e-4);
  EXPECT_GT(mean(less.views[0]) / mean(mass.views[0]), 0.7);
  EXPECT_LT(mean(less.views[0]) / mean(mass.views[0]), 1.1);
}

TEST_F(OpenParticles, RefuseWhatMakesNoSense) {
  const auto running = [this](const char* line) { return [this, line] { run_line(viewer, line); }; };
  expect_error(ErrorKind::wrong_usage, "MIN,MAX", running("splat 5"));
  expect_error(ErrorKind::wrong_usage, "MIN <= MAX", running("splat 5,2"));
  expect_error(ErrorKind::wrong_usage, "no number", running("exposure bright"));
  expect_error(ErrorKind::wrong_usage, "colour", running("colours mud"));
  expect_error(ErrorKind::wrong_usage, "near", running("near 5000"));
  expect_error(ErrorKind::wrong_usage, "asinh, log, linear", running("stretch sqrt"));
  expect_error(ErrorKind::wrong_usage, "expected X,Y", running("focus 5"));
  run_line(viewer, "look mass");
  expect_error(ErrorKind::wrong_usage, "look thesis", running("exposure 2"));
}

TEST(OpenSlices, StandAsDeepAsAsked) {
  const TemporaryFolder folder;
  write_whole_file(folder / "cloud.csv", "x,y,z\n0,0,0\n4,4,0\n-4,-4,0\n1,0,3\n");
  run_told(folder, {"wheatstone", "render", folder / "cloud.csv", "--size", "120x80", "--save-slices",
                    folder / "slices.exr", "-o", folder / "unused"});
  Viewer viewer;
  viewer.session().items.push_back({folder / "slices.exr"});
  viewer.set_viewport({240, 80});
  viewer.open(0);
  viewer.wait();
  run_line(viewer, "mode left-right");
  run_line(viewer, "zero-parallax 0");
  run_line(viewer, "near 20");
  run_line(viewer, "far 20");
  Image<Rgb8> before;
  for (const char* asked : {"separation 1", "depth-mapping 0:-30,0.5:-5,1:10"}) {
    run_line(viewer, asked);
    viewer.wait();
    const std::string line = command_line_of(viewer.session());
    run_told(folder, words_of(line));
    const Image<Rgb8> left = read_image(folder / "views/view_000.png");
    EXPECT_NE(left, before) << line;
    for (int y = 0; y < 80; ++y)
      for (int x = 20; x < 100; ++x) ASSERT_EQ(viewer.frame()->picture(x, y), left(x, y)) << line;
    before = left;
  }
}

}  // namespace wheatstone::viewer::particles_view_test
