#include "wheatstone/multiview/make_slices.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/error.h"
#include "wheatstone/multiview/opaque_internal.h"
#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {

struct SliceMaker::State {
  Scene scene;
  CloudStatistics statistics;
  Rig rig;
  RenderOptions options;
  DepthPlanes planes;
  Window window;
  SplatOrder order;
  std::vector<LightBand> light;    // [band][plane], glowing particles
  std::vector<OpaqueBand> opaque;  // [band][plane], opaque ones

  int left() const { return static_cast<int>(window.left); }
  int right() const { return static_cast<int>(window.right); }
  void add_glowing(const std::vector<SplatBlock>& blocks, int b);
  void add_opaque(const std::vector<SplatBlock>& blocks, int b);
  LinearRgba at(int plane, int x, int y) const;
  Slice crop(int plane) const;
  float find_exposure() const;
};

void SliceMaker::State::add_glowing(const std::vector<SplatBlock>& blocks, int b) {
  const int top = b * order.band_rows;
  for (int plane = 0; plane < order.parts; ++plane) {
    LightBand& here = light[order.bin(b, plane)];
    const bool between = order.within == SplatOrder::Within::nearer_plane && plane + 1 < order.parts;
    for (const SplatBlock& block : blocks) {
      const std::span<const Splat> splats = block.bin(order.bin(b, plane));
      if (between) {
        deposit_between(splats, top, {planes.parallaxes[plane], planes.spacing_px}, here,
                        light[order.bin(b, plane + 1)]);
      } else {
        deposit(splats, top, here);
      }
    }
  }
}

void SliceMaker::State::add_opaque(const std::vector<SplatBlock>& blocks, int b) {
  for (int plane = 0; plane < order.parts; ++plane)
    for (const SplatBlock& block : blocks)
      draw_discs(block.bin(order.bin(b, plane)), b * order.band_rows, central_view, opaque[order.bin(b, plane)]);
}

LinearRgba SliceMaker::State::at(int plane, int x, int y) const {
  const std::size_t bin = order.bin(y / order.band_rows, plane);
  const int row = y % order.band_rows;
  if (options.opaque) return opaque[bin].light(x, row);
  const float* const pixel = light[bin].row(row) + x * LightBand::channels;
  return {pixel[0], pixel[1], pixel[2], 0};
}

Slice SliceMaker::State::crop(int plane) const {
  const int width = right() - left();
  int first_x = width;
  int end_x = 0;
  int first_y = rig.height;
  int end_y = 0;
  for (int y = 0; y < rig.height; ++y)
    for (int x = 0; x < width; ++x) {
      if (at(plane, x, y) == LinearRgba{}) continue;
      first_x = std::min(first_x, x);
      end_x = std::max(end_x, x + 1);
      first_y = std::min(first_y, y);
      end_y = y + 1;
    }
  Slice slice{.parallax_px = planes.parallaxes[plane], .left = left() + first_x, .top = first_y, .pixels = {}};
  if (end_x <= first_x) return slice;
  slice.pixels = Image<LinearRgba>(end_x - first_x, end_y - first_y);
  for (int y = first_y; y < end_y; ++y)
    for (int x = first_x; x < end_x; ++x) slice.pixels(x - first_x, y - first_y) = at(plane, x, y);
  return slice;
}

float SliceMaker::State::find_exposure() const {
  if (!std::isnan(options.exposure)) return options.exposure;
  std::vector<float> brightest;
  for (int y = 0; y < rig.height; ++y)
    for (int x = 0; x < rig.width; ++x) {
      LinearRgba sum;
      for (int plane = 0; plane < order.parts && sum.a < 1; ++plane) {
        const LinearRgba light_here = at(plane, x - left(), y);
        sum = {sum.r + light_here.r, sum.g + light_here.g, sum.b + light_here.b, light_here.a};
      }
      brightest.push_back(std::max({sum.r, sum.g, sum.b}));
    }
  return exposure_for(std::move(brightest));
}

SliceMaker::SliceMaker(const Scene& scene, const CloudStatistics& statistics, const Rig& rig,
                       const RenderOptions& options, std::size_t memory_limit_bytes)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.scene = scene;
  state.statistics = statistics;
  state.rig = rig;
  state.options = options;
  state.planes = planes_of(scene.mapping, options.planes, span_of(rig));
  state.window = window_around(scene, rig);
  state.order =
      order_by_plane(rig, scene.splat_style, state.planes, options.opaque ? SliceFilter::nearest : options.filter);

  // Sixteen bytes a pixel while they are filled, and again when they are cropped; opaque ones have a depth too.
  const double pixels = static_cast<double>(state.right() - state.left() + 2 * LightBand::margin) *
                        state.order.band_rows * static_cast<double>(state.order.bins());
  const double bytes = pixels * (options.opaque ? 36 : 32);
  if (bytes > static_cast<double>(memory_limit_bytes))
    throw Error(ErrorKind::bad_input, fmt::format("{} slices of {}x{} pixels need {:.1f} GB, expected at most "
                                                  "{:.1f} GB; give fewer planes or smaller views",
                                                  state.order.parts, state.right() - state.left(), rig.height,
                                                  bytes / 1e9, static_cast<double>(memory_limit_bytes) / 1e9));
  if (options.opaque) {
    state.opaque.assign(state.order.bins(), OpaqueBand(state.left(), state.right(), state.order.band_rows));
  } else {
    state.light.assign(state.order.bins(), LightBand(state.left(), state.right(), state.order.band_rows));
  }
}

SliceMaker::~SliceMaker() = default;
SliceMaker::SliceMaker(SliceMaker&&) noexcept = default;
SliceMaker& SliceMaker::operator=(SliceMaker&&) noexcept = default;

void SliceMaker::add(const Cloud& cloud) {
  State& state = *state_;
  const std::vector<SplatBlock> blocks =
      order_splats(cloud, make_projection(state.scene, state.statistics), state.window, state.order);
  tbb::parallel_for(0, state.order.bands, [&](int b) {
    if (state.options.opaque) {
      state.add_opaque(blocks, b);
    } else {
      state.add_glowing(blocks, b);
    }
  });
}

SliceStack SliceMaker::finish(const ViewingGeometry& viewing) {
  State& state = *state_;
  SliceStack stack{.width = state.rig.width,
                   .height = state.rig.height,
                   .span = span_of(state.rig),
                   .exposure = state.find_exposure(),
                   .viewing = viewing,
                   .slices = std::vector<Slice>(state.order.parts)};
  tbb::parallel_for(0, state.order.parts, [&](int plane) { stack.slices[plane] = state.crop(plane); });
  std::erase_if(stack.slices, [](const Slice& slice) { return slice.pixels.empty(); });
  state_.reset();
  return stack;
}

SliceStack make_slices(const Cloud& cloud, const Scene& scene, const Rig& rig, const RenderOptions& options,
                       const ViewingGeometry& viewing) {
  CloudStatistics statistics;
  statistics.add(cloud);
  SliceMaker maker(scene, statistics, rig, options);
  maker.add(cloud);
  return maker.finish(viewing);
}

}  // namespace wheatstone
