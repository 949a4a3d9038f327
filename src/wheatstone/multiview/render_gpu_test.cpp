// Pictures by the graphics processor against those by the processor.

#include <gtest/gtest.h>

#include "needs_gpu.h"
#include "psnr.h"
#include "stage_of_kernels.h"
#include "throws_error.h"
#include "wheatstone/multiview/render.h"

namespace wheatstone::render_gpu_test {

/// With particles from a pixel wide to wider than the view's picture holds.
struct Case {
  Cloud cloud;
  Stage stage;
  RenderOptions options{.method = Method::incremental};

  explicit Case(Cloud particles, const Appearance& appearance = {})
      : cloud(std::move(particles)), stage(stage_of(cloud, 96, 72, 3, appearance)) {}
  std::vector<Image<Rgb8>> views(Device device) {
    options.device = device;
    return render(chunks_of(cloud), stage.statistics, stage.scene, stage.rig, options).views;
  }
};

class RenderGpu : public NeedsGpu {};

TEST_F(RenderGpu, ShowsMassAsTheProcessorDoes) {
  Case mass(kernels(1000));
  EXPECT_GT(worst_psnr(mass.views(Device::graphics), mass.views(Device::processor)), 55);
}

TEST_F(RenderGpu, ShowsTheThesissLookAsTheProcessorDoes) {
  Case look(kernels(1000), {.look = Look::thesis});
  look.options.exposure = 0.5f;
  EXPECT_GT(worst_psnr(look.views(Device::graphics), look.views(Device::processor)), 55);
}

TEST_F(RenderGpu, ShowsParticlesInTheirOwnColours) {
  Cloud cloud = kernels(1000);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.colour.push_back({static_cast<std::uint8_t>(i % 256), 120, static_cast<std::uint8_t>(i / 16 % 256)});
  Case coloured(cloud);
  EXPECT_GT(worst_psnr(coloured.views(Device::graphics), coloured.views(Device::processor)), 55);
}

TEST_F(RenderGpu, ShowsAQuantityWithBothSigns) {
  Cloud cloud = kernels(1000);
  for (const float x : cloud.x) cloud.quantity.push_back(x * 300);
  Case velocity(cloud);
  velocity.stage.scene.splat_style.colour_source = ColourSource::quantity;
  velocity.stage.scene.splat_style.quantity_scale = 1.f / 300;
  velocity.options.tone = {.shown = Shown::mean, .stretch = Stretch::linear, .least = -1, .most = 1};
  EXPECT_GT(worst_psnr(velocity.views(Device::graphics), velocity.views(Device::processor)), 55);
}

TEST_F(RenderGpu, GivesTheSameBytesEveryTime) {
  Case mass(kernels(1000));
  const std::vector<Image<Rgb8>> once = mass.views(Device::graphics);
  const std::vector<Image<Rgb8>> again = mass.views(Device::graphics);
  for (std::size_t v = 0; v < once.size(); ++v) EXPECT_TRUE(std::ranges::equal(once[v].pixels(), again[v].pixels()));
}

TEST_F(RenderGpu, DoesNotDependOnTheOrderOfTheParticles) {
  const Cloud cloud = kernels(1000);
  Cloud reversed;
  for_each_column(reversed, cloud, [](auto& to, const auto& from) { to.assign(from.rbegin(), from.rend()); });
  Case forwards(cloud);
  Case backwards(reversed);
  forwards.options.tone = backwards.options.tone = {.least = 0, .most = 5};
  const std::vector<Image<Rgb8>> one = forwards.views(Device::graphics);
  const std::vector<Image<Rgb8>> other = backwards.views(Device::graphics);
  for (std::size_t v = 0; v < one.size(); ++v) EXPECT_TRUE(std::ranges::equal(one[v].pixels(), other[v].pixels()));
}

TEST_F(RenderGpu, DoesNotDependOnTheChunksThatParticlesComeIn) {
  const Cloud cloud = kernels(1000);
  std::vector<Cloud> parts(3);
  for (std::size_t part = 0; part < parts.size(); ++part)
    for_each_column(parts[part], cloud, [&](auto& to, const auto& from) {
      for (std::size_t i = part; i < from.size(); i += parts.size()) to.push_back(from[i]);
    });
  for (const Method method : {Method::incremental, Method::layered}) {
    Case whole(cloud);
    whole.options.method = method;
    whole.options.tone = {.least = 0, .most = 5};
    const std::vector<Image<Rgb8>> at_once = whole.views(Device::graphics);
    const Chunks chunks = [&](const std::function<void(const Cloud&)>& visit) { std::ranges::for_each(parts, visit); };
    const std::vector<Image<Rgb8>> in_parts =
        render(chunks, whole.stage.statistics, whole.stage.scene, whole.stage.rig, whole.options).views;
    for (std::size_t v = 0; v < at_once.size(); ++v)
      EXPECT_TRUE(std::ranges::equal(at_once[v].pixels(), in_parts[v].pixels()));
  }
}

TEST_F(RenderGpu, CountsTheFaintBesideTheBright) {
  // 2^-12 of a mean particle's light on the left, and up to 2^24 of it on the right: every size of steps.
  Cloud cloud = kernels(1000);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool bright = i % 2 == 1;
    cloud.x[i] = (bright ? 1.f : -1.f) * (0.25f + std::abs(cloud.x[i]));
    cloud.mass[i] = bright ? std::exp2(static_cast<float>(i % 9) * 3) : std::exp2(-12.f);
    cloud.smoothing_length[i] = 0.05f;
  }
  Case mass(cloud);
  mass.stage.scene.splat_style.mean_mass = 1;
  for (const float most : {1e-3f, 1e6f}) {
    mass.options.tone = {.least = 0, .most = most};
    EXPECT_GT(worst_psnr(mass.views(Device::graphics), mass.views(Device::processor)), 55);
  }
}

TEST_F(RenderGpu, CountsTheFaintBesideSumsThatOneWordDoesNotHold) {
  // Twenty overlap in the middle, which sums to 2^32 of a mean particle's light, of the 2^35 that two words hold; the
  // faint ones lie there, over its rim, and beside it.
  Cloud cloud = kernels(1000);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool bright = i % 50 == 1;
    cloud.x[i] = bright ? 0.02f * cloud.x[i] : cloud.x[i];
    cloud.y[i] = bright ? 0.02f * cloud.y[i] : cloud.y[i];
    cloud.mass[i] = bright ? std::exp2(30.f) : 1.f;
    cloud.smoothing_length[i] = 0.1f;
  }
  Case mass(cloud);
  mass.stage.scene.splat_style.mean_mass = 1;
  for (const float most : {10.f, std::exp2(32.f)}) {
    mass.options.tone = {.least = 0, .most = most};
    EXPECT_GT(worst_psnr(mass.views(Device::graphics), mass.views(Device::processor)), 55);
  }
}

TEST_F(RenderGpu, GathersAllOfWhatLiesInOnePlace) {
  // More than the iterations of a driver's loops.
  const Cloud one = kernels(1);
  Cloud cloud;
  for_each_column(cloud, one, [](auto& to, const auto& from) {
    if (!from.empty()) to.assign(280'000, from[0]);
  });
  Case mass(cloud);
  mass.options.tone = {.least = 0, .most = 280'000};
  EXPECT_GT(worst_psnr(mass.views(Device::graphics), mass.views(Device::processor)), 55);
}

TEST_F(RenderGpu, SpreadsMassByTheCubicSplineAsTheProcessorDoes) {
  Cloud coloured = kernels(1000);
  for (std::size_t i = 0; i < coloured.size(); ++i)
    coloured.colour.push_back({static_cast<std::uint8_t>(i % 256), 120, static_cast<std::uint8_t>(i / 16 % 256)});
  for (const Cloud& cloud : {kernels(1000), coloured}) {
    Case spline(cloud, {.kernel = Kernel::cubic_spline});
    const std::vector<Image<Rgb8>> found = spline.views(Device::graphics);
    EXPECT_GT(worst_psnr(found, spline.views(Device::processor)), 55);
    EXPECT_LT(worst_psnr(found, Case(cloud).views(Device::processor)), 52);
  }
}

TEST_F(RenderGpu, CompositesDepthPlanesAsTheProcessorDoes) {
  for (const SliceFilter filter : {SliceFilter::nearest, SliceFilter::linear, SliceFilter::centroid}) {
    Case mass(kernels(1000));
    mass.options.method = Method::layered;
    mass.options.filter = filter;
    EXPECT_GT(worst_psnr(mass.views(Device::graphics), mass.views(Device::processor)), 55);
  }
}

TEST_F(RenderGpu, MovesPlanesFartherInTheFocus) {
  Cloud coloured = kernels(1000);
  for (std::size_t i = 0; i < coloured.size(); ++i)
    coloured.colour.push_back({static_cast<std::uint8_t>(i % 256), 120, static_cast<std::uint8_t>(i / 16 % 256)});
  for (const Cloud& cloud : {kernels(1000), coloured})
    for (const SliceFilter filter : {SliceFilter::linear, SliceFilter::centroid}) {
      Case mass(cloud);
      mass.options.method = Method::automatic;
      mass.options.filter = filter;
      mass.options.focus = Focus{.x_px = 40, .y_px = 30, .radius_px = 40, .gain = 1.8f};
      const std::vector<Image<Rgb8>> found = mass.views(Device::graphics);
      EXPECT_GT(worst_psnr(found, mass.views(Device::processor)), 55);
      mass.options.focus.reset();
      mass.options.method = Method::layered;
      EXPECT_LT(worst_psnr(found, mass.views(Device::processor)), 45);
    }
}

TEST_F(RenderGpu, ShowsTheNearestOfOpaqueParticles) {
  Case look(kernels(1000), {.look = Look::thesis});
  look.options.exposure = 20;
  look.options.opaque = true;
  const std::vector<Image<Rgb8>> expected = look.views(Device::processor);
  const std::vector<Image<Rgb8>> found = look.views(Device::graphics);
  EXPECT_GT(worst_psnr(found, expected), 55);
  Case see_through = look;
  see_through.options.opaque = false;
  EXPECT_LT(worst_psnr(found, see_through.views(Device::graphics)), 35);
  std::vector<Cloud> parts(2);
  for_each_column(parts[0], look.cloud, [&](auto& to, const auto& from) {
    if (!from.empty()) to.assign(from.begin(), from.begin() + 400);
  });
  for_each_column(parts[1], look.cloud, [&](auto& to, const auto& from) {
    if (!from.empty()) to.assign(from.begin() + 400, from.end());
  });
  const Chunks chunks = [&](const std::function<void(const Cloud&)>& visit) { std::ranges::for_each(parts, visit); };
  const std::vector<Image<Rgb8>> in_parts =
      render(chunks, look.stage.statistics, look.stage.scene, look.stage.rig, look.options).views;
  for (std::size_t v = 0; v < found.size(); ++v)
    EXPECT_TRUE(std::ranges::equal(found[v].pixels(), in_parts[v].pixels()));
}

TEST_F(RenderGpu, RefusesWhatItDoesNotDo) {
  Case mass(kernels(100));
  mass.options.method = Method::exact;
  expect_error(ErrorKind::wrong_usage, "--device cpu", [&] { mass.views(Device::graphics); });
  mass.options = {.method = Method::layered, .opaque = true};
  expect_error(ErrorKind::wrong_usage, "--opaque", [&] { mass.views(Device::graphics); });
}

}  // namespace wheatstone::render_gpu_test
