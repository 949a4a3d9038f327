#include "wheatstone/multiview/make_slices.h"
#include "wheatstone/multiview/cropped_slice.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/opaque_internal.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/multiview/shine_internal.h"

namespace wheatstone {

struct SliceMaker::State {
  Scene scene;
  CloudStatistics statistics;
  Rig rig;
  RenderOptions options;
  DepthPlanes planes;
  Window window;
  SplatOrders orders;
  std::optional<GatheredLight> light;       // glowing particles
  std::optional<GatheredLight> highlights;  // of those that shine
  std::vector<OpaqueBand> opaque;           // [band][plane], opaque ones

  OrderingMemory memory;

  const SplatOrder& order() const { return orders.front(); }
  int left() const { return static_cast<int>(window.left); }
  int right() const { return static_cast<int>(window.right); }
  void add(const Cloud& cloud);
  void draw_opaque(const std::vector<SplatBlock>& blocks);
  void move_to_first();
  LinearRgba at(int plane, int x, int y);
  Slice crop(int plane);
};

void SliceMaker::State::add(const Cloud& cloud) {
  const ToneMap none(ToneSettings{.exposure = 1});
  const Chunks chunks = chunks_of(cloud);
  const RenderJob job{chunks, scene, rig, statistics, none, {}, options.ranks};
  const auto take = [&](const Cloud& particles, const std::function<void(const std::vector<SplatBlock>&)>& draw) {
    const Chunks some = chunks_of(particles);
    for_each_ordered(of_chunks(job, some), projection_for(job, orders), window, orders, memory, draw);
  };
  if (!light) return take(cloud, [&](const std::vector<SplatBlock>& blocks) { draw_opaque(blocks); });
  const auto deposit_in = [&](std::optional<GatheredLight>& to) {
    return [&](const std::vector<SplatBlock>& blocks) {
      deposit_in_planes(blocks, orders, deposit_of(scene.splat_style), *to);
    };
  };
  // Slices serve any rig: their highlights are those of the central view.
  for_each_chunk_and_highlights(
      job, {&central_view, 1}, [&](const Cloud& chunk) { take(chunk, deposit_in(light)); },
      [&](const Cloud& shining, std::size_t /*view*/) { take(shining, deposit_in(highlights)); });
}

void SliceMaker::State::draw_opaque(const std::vector<SplatBlock>& blocks) {
  for_each_band_of(order(), [&](int b) {
    for (int plane = 0; plane < order().parts; ++plane)
      for (const SplatBlock& block : blocks)
        draw_spheres(block.bin(order().bin(b, plane)), b * order().band_rows, central_view,
                     opaque[order().bin(b, plane)]);
  });
}

/// Moves all ranks' bands to the first of them.
void SliceMaker::State::move_to_first() {
  if (light) light->move_to_first(options.ranks);
  if (opaque.empty() || options.ranks.alone()) return;
  Ranks::Bytes mine;
  for (const OpaqueBand& band : opaque) {
    const auto bytes = std::as_bytes(band.light.pixels());
    mine.insert(mine.end(), bytes.begin(), bytes.end());
  }
  const std::vector<Ranks::Bytes> all = options.ranks.to_first(mine);
  if (!options.ranks.first()) return;
  std::vector<std::size_t> at(all.size(), 0);
  for (int b = 0; b < order().bands; ++b)
    for (int plane = 0; plane < order().parts; ++plane) {
      const auto owner = static_cast<std::size_t>(order().owner(b));
      OpaqueBand& band = opaque[order().bin(b, plane)];
      if (!order().is_mine(b)) band = OpaqueBand(left(), right(), order().band_rows);
      const auto to = std::as_writable_bytes(band.light.pixels());
      std::memcpy(to.data(), all[owner].data() + at[owner], to.size());
      at[owner] += to.size();
    }
}

LinearRgba SliceMaker::State::at(int plane, int x, int y) {
  const int band = y / order().band_rows;
  const int row = y % order().band_rows;
  if (options.opaque) return opaque[order().bin(band, plane)].light(x, row);
  const LightBand& of_plane = light->band(0, band, plane);
  const float* const pixel = of_plane.row(row) + x * of_plane.channels();
  if (of_plane.channels() == 2) return {pixel[0], pixel[1], 0, 0};
  const float depth = pixel[3];
  if (!(depth > 0)) return {pixel[0], pixel[1], pixel[2], 0};
  // Within a plane all particles shine through each other alike.
  const float absorbed = -std::expm1(-depth);
  const float share = absorbed / depth;
  return {pixel[0] * share, pixel[1] * share, pixel[2] * share, absorbed};
}

Slice SliceMaker::State::crop(int plane) {
  Slice slice = cropped_slice(right() - left(), rig.height, [&](int x, int y) { return at(plane, x, y); });
  slice.parallax_px = planes.parallaxes[plane];
  slice.left += left();
  return slice;
}

namespace {

/// Light of one plane of a picture, and how much of it goes to a plane of the picture of twice the size.
struct PlaneShare {
  int small, large;
  float share;
};

/// Adds a plane's light to one of the picture of twice the size, interpolated between its pixels (composite_simd.cpp).
void enlarge(GatheredLight& light, const SplatOrders& orders, std::size_t small, const PlaneShare& planes) {
  const SplatOrder& from = orders[small];
  const SplatOrder& to = orders[small - 1];
  const auto pixel = [&](int x, int y) -> const float* {
    const LightBand& band = light.band(small, y / from.band_rows, planes.small);
    return band.row(y % from.band_rows) + (x - band.left()) * band.channels();
  };
  tbb::parallel_for(0, to.rows, [&](int row) {
    LightBand& band = light.band(small - 1, row / to.band_rows, planes.large);
    const int y = row - to.pad;
    const int half_row = (y - (y & 1)) / 2;
    const std::array<int, 2> rows{half_row + 2, (y & 1) != 0 ? half_row + 3 : half_row + 1};
    for (int column = band.left(); column < band.right(); ++column) {
      const int x = column - to.pad;
      const int half_column = (x - (x & 1)) / 2;
      const std::array<int, 2> columns{half_column + 2, (x & 1) != 0 ? half_column + 3 : half_column + 1};
      float* const sum = band.row(row % to.band_rows) + (column - band.left()) * band.channels();
      for (const int i : {0, 1})
        for (const int k : {0, 1}) {
          const float weight = planes.share * (i == 0 ? 0.75f : 0.25f) * (k == 0 ? 0.75f : 0.25f);
          const float* const part = pixel(columns[k], rows[i]);
          for (int channel = 0; channel < band.channels(); ++channel) sum[channel] += weight * part[channel];
        }
    }
  });
}

/// Brings the light of all smaller pictures into the view's own.
void join_pictures(GatheredLight& light, const SplatOrders& orders) {
  for (std::size_t small = orders.size(); small-- > 1;) {
    const SplatOrder& from = orders[small];
    const SplatOrder& to = orders[small - 1];
    for (int plane = 0; plane < from.parts; ++plane) {
      const bool lit = [&] {
        for (int b = 0; b < from.bands; ++b)
          if (light.band(small, b, plane).lit()) return true;
        return false;
      }();
      if (!lit) continue;
      // Planes of the smaller picture are twice as far apart.
      const int nearer = std::min(2 * plane, to.parts - 1);
      enlarge(light, orders, small, {plane, nearer, 1});
      for (int b = 0; b < to.bands; ++b) light.band(small - 1, b, nearer).note_light();
    }
  }
}

}  // namespace

SliceMaker::SliceMaker(const Scene& scene, const CloudStatistics& statistics, const Rig& rig,
                       const RenderOptions& options, std::size_t memory_limit_bytes)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.scene = scene;
  state.statistics = statistics;
  state.rig = rig;
  state.options = options;
  state.planes = planes_of(scene.mapping, options.planes, span_of(rig));
  state.window = window_around(scene, rig, options.focus ? options.focus->largest_gain() : 1.f);
  const ToneMap none(ToneSettings{.exposure = 1});
  const Chunks nothing;
  state.orders = orders_by_plane({nothing, scene, rig, statistics, none, {}, options.ranks}, state.planes,
                                 options.opaque ? SliceFilter::nearest : options.filter);

  // 16 bytes per pixel while slices are filled, and 16 more when they are cropped. Opaque slices also store a depth;
  // highlights are stored apart until the end.
  const double pixels = static_cast<double>(state.right() - state.left() + 2 * LightBand::margin) *
                        state.order().band_rows * static_cast<double>(state.order().bins());
  const bool shines = scene.shine.lit() && !options.opaque;
  const double bytes = pixels * (options.opaque ? 36 : shines ? 48 : 32);
  if (bytes > static_cast<double>(memory_limit_bytes))
    throw Error(ErrorKind::bad_input, fmt::format("{} slices of {}x{} pixels need {:.1f} GB, expected at most "
                                                  "{:.1f} GB; give fewer planes or smaller views",
                                                  state.order().parts, state.right() - state.left(), rig.height,
                                                  bytes / 1e9, static_cast<double>(memory_limit_bytes) / 1e9));
  if (options.opaque) {
    state.opaque.resize(state.order().bins());
    for (int b = 0; b < state.order().bands; ++b)
      for (int plane = 0; state.order().is_mine(b) && plane < state.order().parts; ++plane)
        state.opaque[state.order().bin(b, plane)] = OpaqueBand(state.left(), state.right(), state.order().band_rows);
  } else {
    const Deposit kind = deposit_of(scene.splat_style);
    state.light.emplace(state.orders, state.window, kind, 0);
    if (shines) state.highlights.emplace(state.orders, state.window, kind, 0);
  }
}

SliceMaker::~SliceMaker() = default;
SliceMaker::SliceMaker(SliceMaker&&) noexcept = default;
SliceMaker& SliceMaker::operator=(SliceMaker&&) noexcept = default;

void SliceMaker::add(const Cloud& cloud) { state_->add(cloud); }

SliceStack SliceMaker::finish(const ViewingGeometry& viewing) {
  State& state = *state_;
  if (state.highlights) state.light->add(*state.highlights);
  state.highlights.reset();
  state.move_to_first();
  const bool whole = state.options.ranks.first();
  if (state.light && whole) join_pictures(*state.light, state.orders);
  ToneSettings tone = settled(tone_for(state.scene, state.options), state.scene, state.statistics, state.rig);
  SliceStack stack{.width = state.rig.width,
                   .height = state.rig.height,
                   .span = span_of(state.rig),
                   .tone = std::move(tone),
                   .viewing = viewing,
                   .slices = std::vector<Slice>(whole ? state.order().parts : 0)};
  tbb::parallel_for(0, static_cast<int>(stack.slices.size()),
                    [&](int plane) { stack.slices[plane] = state.crop(plane); });
  std::erase_if(stack.slices, [](const Slice& slice) { return slice.pixels.empty(); });
  stack.hiding = hiding_of(stack);
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
