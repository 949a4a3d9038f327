// Pictures of mass: what they add up to, whatever the size of splats and pixels.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include "stage_of_kernels.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/measures/view_measures.h"
#include "wheatstone/multiview/make_slices.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/tone_map_internal.h"
#include "wheatstone/synthetic/synthetic_universe.h"

namespace wheatstone::mass_test {

std::vector<ViewValues> values_of(const Cloud& cloud, const Stage& stage) {
  return view_values(chunks_of(cloud), stage.statistics, stage.scene, stage.rig);
}

double area_of_pixel(const Scene& scene) {
  return std::pow(scene.camera.orthographic_depth / scene.camera.focal_px, 2);
}

/// The cubic spline of radius 1, along a line at this distance from its middle.
double projected_spline(double distance) {
  constexpr int steps = 400;
  if (distance >= 1) return 0;
  const double half = std::sqrt(1 - distance * distance);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double r = std::hypot(distance, (i + 0.5) / steps * half);
    sum += r < 0.5 ? 1 - 6 * r * r * (1 - r) : 2 * std::pow(1 - r, 3);
  }
  return sum * 2 * half / steps * 8 / std::numbers::pi;
}

TEST(Mass, OfAllParticlesIsThatOfThePictureAtAnySize) {
  const Cloud cloud = kernels(4000);
  double mass = 0;
  for (const float one : cloud.mass) mass += one;
  for (const int width : {96, 320, 960}) {
    const Stage stage = stage_of(cloud, width, width * 9 / 16, 2);
    for (const ViewValues& view : values_of(cloud, stage)) {
      double sum = 0;
      for (const float column : view.column.pixels()) sum += column;
      EXPECT_NEAR(sum * area_of_pixel(stage.scene) / mass, 1, 1e-4) << width;
    }
  }
}

TEST(Mass, OfTheSplineIsKeptAndFollowsTheProjectedKernel) {
  const Cloud many = kernels(1500);
  Stage stage = stage_of(many, 320, 180);
  stage.scene.splat_style.kernel = Kernel::cubic_spline;
  double mass = 0;
  for (const float one : many.mass) mass += one;
  double sum = 0;
  const Image<float> columns = values_of(many, stage)[0].column;
  for (const float column : columns.pixels()) sum += column;
  EXPECT_NEAR(sum * area_of_pixel(stage.scene) / mass, 1, 1e-4);

  // One particle, against the spline summed along the line of sight.
  Cloud one;
  one.x = one.y = one.z = {0};
  one.mass = {1};
  one.smoothing_length = {0.06f};
  one.temperature = one.density = {1};
  Stage single = stage_of(one, 640, 360);
  const auto profile = [&](Kernel kernel) {
    single.scene.splat_style.kernel = kernel;
    return values_of(one, single)[0].column;
  };
  const double pixel = std::sqrt(area_of_pixel(single.scene));
  const double peak = 6 / std::numbers::pi / (0.06 * 0.06);
  double of_spline = 0;
  double of_gaussian = 0;
  const Image<float> spline = profile(Kernel::cubic_spline);
  const Image<float> gaussian = profile(Kernel::gaussian);
  for (int y = 160; y < 200; ++y)
    for (int x = 300; x < 340; ++x) {
      const double truth = projected_spline(std::hypot(x + 0.5 - 320, y + 0.5 - 180) * pixel / 0.06) / (0.06 * 0.06);
      of_spline = std::max(of_spline, std::abs(spline(x, y) - truth) / peak);
      of_gaussian = std::max(of_gaussian, std::abs(gaussian(x, y) - truth) / peak);
    }
  EXPECT_LT(of_spline, 0.03);
  EXPECT_GT(of_gaussian, 0.08) << "another kernel must be told apart";
}

TEST(Mass, IsTheSameOnEveryInstructionSet) {
  const Cloud cloud = kernels(500);
  Stage stage = stage_of(cloud, 131, 67);
  for (const Kernel kernel : {Kernel::gaussian, Kernel::cubic_spline}) {
    stage.scene.splat_style.kernel = kernel;
    const Image<float> usual = values_of(cloud, stage)[0].column;
    const float most = std::ranges::max(usual.pixels());
    for (const auto target : hwy::SupportedAndGeneratedTargets()) {
      SCOPED_TRACE(hwy::TargetName(target));
      hwy::SetSupportedTargetsForTest(target);
      const Image<float> column = values_of(cloud, stage)[0].column;
      float difference = 0;
      for (std::size_t i = 0; i < usual.pixels().size(); ++i)
        difference = std::max(difference, std::abs(column.pixels()[i] - usual.pixels()[i]));
      EXPECT_LT(difference, 1e-4f * most);
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

/// The mean of so many pixels a side.
Image<double> binned(const Image<float>& image, int side) {
  Image<double> bins(image.width() / side, image.height() / side);
  for (int y = 0; y < bins.height() * side; ++y)
    for (int x = 0; x < bins.width() * side; ++x)
      bins(x / side, y / side) += static_cast<double>(image(x, y)) / (side * side);
  return bins;
}

double mean_difference(const Image<double>& image, const Image<double>& reference) {
  double difference = 0;
  double sum = 0;
  for (int y = 0; y < reference.height(); ++y)
    for (int x = 0; x < reference.width(); ++x) {
      difference += std::abs(image(x, y) - reference(x, y));
      sum += reference(x, y);
    }
  return difference / sum;
}

TEST(Mass, IsTheSamePictureAtAnySizeOnlyFiner) {
  const Cloud cloud = kernels(4000);
  const auto bins_at = [&](int width) {
    return binned(values_of(cloud, stage_of(cloud, width, width / 2))[0].column, width / 40);
  };
  const Image<double> finest = bins_at(1280);
  EXPECT_LT(mean_difference(bins_at(320), finest), 0.01);
  EXPECT_LT(mean_difference(bins_at(160), finest), 0.03);
}

/// The cubic spline kernel of a radius (Monaghan 1992), integrated along a line at a distance from its middle.
double projected_kernel(double distance, double radius) {
  if (distance >= radius) return 0;
  constexpr int steps = 20;
  const double half = std::sqrt(radius * radius - distance * distance);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double along = half * (i + 0.5) / steps;
    const double q = std::hypot(distance, along) / radius;
    sum += q < 0.5 ? 1 - 6 * q * q * (1 - q) : 2 * std::pow(1 - q, 3);
  }
  return 8 / std::numbers::pi / std::pow(radius, 3) * 2 * half / steps * sum;
}

TEST(Mass, ColumnDensityIsTheIntegralAlongTheLine) {
  const Cloud cloud = kernels(2000);
  const Stage stage = stage_of(cloud, 96, 64);
  const Camera& camera = stage.scene.camera;
  const double px = camera.focal_px / camera.orthographic_depth;
  Image<double> reference(stage.rig.width, stage.rig.height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto along = [&](const std::array<float, 3>& axis) {
      return (cloud.x[i] - camera.position[0]) * axis[0] + (cloud.y[i] - camera.position[1]) * axis[1] +
             (cloud.z[i] - camera.position[2]) * axis[2];
    };
    const double x = camera.centre_x_px + px * along(camera.right);
    const double y = camera.centre_y_px + px * along(camera.down);
    // Two samples a pixel's side; kernels are at least as wide as the smallest splats.
    const double radius = std::max<double>(cloud.smoothing_length[i], 2 / px);
    for (int row = 0; row < reference.height(); ++row)
      for (int column = 0; column < reference.width(); ++column) {
        if (std::hypot(column + 0.5 - x, row + 0.5 - y) > radius * px + 1) continue;
        for (int sample = 0; sample < 4; ++sample) {
          const int right = sample % 2, below = sample / 2;
          const double dx = column + (right + 0.5) / 2 - x;
          const double dy = row + (below + 0.5) / 2 - y;
          reference(column, row) += cloud.mass[i] * projected_kernel(std::hypot(dx, dy) / px, radius) / 4;
        }
      }
  }
  Image<float> as_floats(reference.width(), reference.height());
  for (int y = 0; y < reference.height(); ++y)
    for (int x = 0; x < reference.width(); ++x) as_floats(x, y) = static_cast<float>(reference(x, y));
  const Image<float> column = values_of(cloud, stage)[0].column;
  EXPECT_LT(mean_difference(binned(column, 4), binned(as_floats, 4)), 0.01);
  // Particles of equal mass are another picture.
  Cloud equal = cloud;
  equal.mass.assign(cloud.size(), 1);
  EXPECT_GT(mean_difference(binned(values_of(equal, stage_of(equal, 96, 64))[0].column, 4), binned(as_floats, 4)),
            0.02);
}

/// An orthographic view along z of a box, whose lower corner is in the picture's lower left.
Stage stage_of_box(const Cloud& cloud, int side) {
  Stage stage;
  stage.statistics.add(cloud);
  const auto box = static_cast<float>(cloud.box_size);
  const auto px = static_cast<float>(side);
  stage.rig = evenly_spaced(side, side, 1);
  stage.scene.camera = {.position = {box / 2, box / 2, 2 * box},
                        .right = {1, 0, 0},
                        .down = {0, -1, 0},
                        .forward = {0, 0, -1},
                        .focal_px = 2 * px,
                        .centre_x_px = px / 2,
                        .centre_y_px = px / 2,
                        .nearest_depth = box / 10,
                        .orthographic_depth = 2 * box};
  stage.scene.mapping.points = {{box, 0}, {2 * box, 0}};
  stage.scene.splat_style = make_splat_style({}, stage.statistics);
  stage.scene.splat_style.size_depth = 2 * box;
  return stage;
}

// scripts/yt_column_density.py made the values, of the same snapshot.
TEST(Mass, ColumnDensityOfASnapshotIsThatOfYt) {
  constexpr int bins = 32;
  constexpr int side = 512;
  SyntheticUniverse universe({.particles = 20000, .seed = 5});
  Cloud cloud = universe.next(20000);
  cloud.mass.assign(cloud.size(), static_cast<float>(universe.mass_of_a_particle()));
  const Image<double> ours = binned(values_of(cloud, stage_of_box(cloud, side))[0].column, side / bins);
  std::ifstream file(WHEATSTONE_COLUMN_DENSITY_BY_YT);
  // At the sides of the box yt lets kernels end, or go on at the other side.
  Image<double> inner(bins - 8, bins - 8);
  Image<double> reference(bins - 8, bins - 8);
  for (int row = 0; row < bins; ++row)
    for (int x = 0; x < bins; ++x) {
      double value = 0;
      ASSERT_TRUE(file >> value) << row;
      const int y = bins - 1 - row;
      if (x < 4 || x >= bins - 4 || y < 4 || y >= bins - 4) continue;
      reference(x - 4, y - 4) = value;
      inner(x - 4, y - 4) = ours(x, y);
    }
  EXPECT_LT(mean_difference(inner, reference), 0.01);
  std::ranges::reverse(inner.pixels());
  EXPECT_GT(mean_difference(inner, reference), 0.1) << "another picture must be told apart";
}

TEST(Mass, MeanOfAQuantityIsWeightedByMass) {
  Cloud cloud;
  cloud.x = cloud.y = cloud.z = {0, 0};
  cloud.mass = {3, 1};
  cloud.quantity = {100, -20};
  cloud.smoothing_length = {0.2f, 0.2f};
  Stage stage = stage_of(cloud, 64, 36);
  stage.scene.splat_style.colour_source = ColourSource::quantity;
  stage.scene.splat_style.quantity_scale = 1 / stage.statistics.largest_quantity;
  const ViewValues values = values_of(cloud, stage)[0];
  EXPECT_NEAR(values.mean(32, 18), 70, 0.1);
  EXPECT_TRUE(std::isnan(values.mean(0, 0)));
}

TEST(Mass, OfParticlesWithColoursIsThatOfTheSameWithout) {
  Cloud cloud = kernels(500);
  const Image<float> plain = values_of(cloud, stage_of(cloud, 96, 64))[0].column;
  cloud.colour.assign(cloud.size(), Rgb8{20, 60, 255});
  Stage stage = stage_of(cloud, 96, 64);
  ASSERT_EQ(stage.scene.splat_style.colour_source, ColourSource::own);
  EXPECT_LT(mean_difference(binned(values_of(cloud, stage)[0].column, 4), binned(plain, 4)), 1e-4);
}

TEST(Mass, WaysOfRenderingAgree) {
  const Cloud cloud = kernels(20000);
  Stage stage = stage_of(cloud, 320, 180, 5);
  const auto views_by = [&](Method method, SliceFilter filter = SliceFilter::linear) {
    return render(cloud, stage.scene, stage.rig, {.method = method, .filter = filter}).views;
  };
  const std::vector<Image<Rgb8>> exact = views_by(Method::exact);
  EXPECT_NE(exact[0], exact[4]);
  EXPECT_EQ(views_by(Method::incremental), exact);
  for (const SliceFilter filter : {SliceFilter::linear, SliceFilter::centroid}) {
    const std::vector<Image<Rgb8>> layered = views_by(Method::layered, filter);
    for (std::size_t v = 0; v < exact.size(); ++v) EXPECT_GT(measure_view(layered[v], exact[v]).psnr_db, 40) << v;
  }
  const SliceStack stack = make_slices(cloud, stage.scene, stage.rig, {.filter = SliceFilter::centroid}, {});
  EXPECT_GT(measure_view(render_slices(stack, stage.rig)[0], exact[0]).psnr_db, 40);
  // In perspective too.
  stage.scene.camera.orthographic_depth = 0;
  const std::vector<Image<Rgb8>> nearer = views_by(Method::exact);
  EXPECT_NE(nearer, exact);
  EXPECT_EQ(views_by(Method::incremental), nearer);
}

TEST(ToneMap, KeepsTheHueOfColoursAsTheyAddUp) {
  const ToneMap tone({.look = Look::mass, .shown = Shown::colours, .least = 0, .most = 10});
  Rgb8 before;
  for (const float light : {0.1f, 1.f, 9.f, 200.f}) {
    const Rgb8 shown = tone(light, light / 2, light / 8);
    EXPECT_GT(shown.r, before.r);
    EXPECT_NEAR(linear_from_srgb(shown.g) / linear_from_srgb(shown.r), 0.5, 0.03);
    EXPECT_NEAR(linear_from_srgb(shown.b) / linear_from_srgb(shown.r), 0.125, 0.03);
    before = {shown.r == 255 ? std::uint8_t{254} : shown.r, 0, 0};
  }
}

TEST(ToneMap, GoesFromBlueToGoldWithoutLilac) {
  const ToneMap tone({.look = Look::mass, .least = 0, .most = 1});
  for (const float light : {0.01f, 0.1f, 0.5f})
    for (int i = 0; i <= 20; ++i) {
      const Rgb8 shown = tone(light, light * static_cast<float>(i) / 20, 0);
      EXPECT_GE(shown.g + 8, std::min(shown.r, shown.b)) << "lilac has less green than red and blue";
    }
  EXPECT_GT(tone(0.1f, 0, 0).b, tone(0.1f, 0, 0).r + 40);
  EXPECT_GT(tone(0.1f, 0.1f, 0).r, tone(0.1f, 0.1f, 0).b + 40);
}

TEST(ToneMap, StretchesBetweenItsLimits) {
  for (const Stretch stretch : {Stretch::asinh, Stretch::log, Stretch::linear}) {
    const ToneMap tone({.look = Look::mass,
                        .shown = Shown::column,
                        .stretch = stretch,
                        .least = 1,
                        .most = 100,
                        .colour_map = "bone"});
    const auto shown = [&](float value) { return +tone(value, 0, 0).r; };
    EXPECT_EQ(shown(0.5f), 0);
    EXPECT_EQ(shown(100), 255);
    EXPECT_EQ(shown(1e9f), 255);
    const int at_ten = shown(10);
    if (stretch == Stretch::linear) {
      EXPECT_LT(at_ten, 30);
    } else {
      EXPECT_GT(at_ten, 60);
    }
  }
}

TEST(Mass, NothingIsClippedAndFaintGasIsSeen) {
  const Cloud cloud = kernels(20000);
  const Stage stage = stage_of(cloud, 320, 180);
  const Image<Rgb8> view = render(cloud, stage.scene, stage.rig, {.method = Method::exact}).views[0];
  int clipped = 0;
  for (const Rgb8 pixel : view.pixels()) clipped += pixel.r == 255 && pixel.g == 255 && pixel.b == 255;
  EXPECT_EQ(clipped, 0);
  // Outside of the knot in the middle.
  EXPECT_GT(view(160, 78).r + view(160, 78).g + view(160, 78).b, 20);
  EXPECT_EQ(view(2, 2), Rgb8());
}

}  // namespace wheatstone::mass_test
