#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "wheatstone/multiview/slice_band_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/multiview/composite_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "wheatstone/multiview/read_planes_simd_internal.h"
#include "wheatstone/multiview/tone_simd_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One vector's worth of pixels, channel by channel.
struct Channels {
  Vec red, green, blue, alpha;
};

/// Pixels of mass have two channels (LightBand).
HWY_INLINE Channels load_channels(const float* from, int count) {
  const Floats d;
  Channels channels;
  if (count == 2) {
    hn::LoadInterleaved2(d, from, channels.red, channels.green);
    channels.blue = channels.alpha = hn::Zero(d);
    return channels;
  }
  hn::LoadInterleaved4(d, from, channels.red, channels.green, channels.blue, channels.alpha);
  return channels;
}

void finish_light_band(const LightBand& band, const ToneMap& map, int top, const ViewTarget& target) {
  const Floats d;
  HWY_ALIGN Sums sums;
  const int rows = std::min(band.rows(), target.height() - top);
  for (int row = 0; row < rows; ++row) {
    for (int x = 0; x < target.width(); x += block_width) {
      for (int i = 0; i < block_width; i += lanes) {
        const Channels light = load_channels(band.row(row) + (x + i - band.left()) * band.channels(), band.channels());
        hn::Store(light.red, d, sums[0] + i);
        hn::Store(light.green, d, sums[1] + i);
        hn::Store(light.blue, d, sums[2] + i);
      }
      finish_block(sums, map, target, top + row, x);
    }
  }
}

/// Takes the light of one chunk of a row, and leaves it dark. With mass, the third channel stays dark. Alpha is
/// included if there is a channel for it. Returns whether there was light.
HWY_INLINE bool take_chunk(float* from, int channels, std::uint16_t* to, std::ptrdiff_t stride, bool alpha,
                           bool was_lit) {
  const Floats d;
  const hn::Rebind<hwy::float16_t, Floats> halves;
  const hn::Rebind<std::uint16_t, Floats> bits;
  constexpr int width = SliceBand::chunk_width;
  Vec any = hn::Zero(d);
  for (int i = 0; i < width * channels; i += lanes) any = hn::Or(any, hn::Load(d, from + i));
  const bool lit = !hn::AllTrue(d, hn::Eq(any, hn::Zero(d)));
  if (!lit && !was_lit) return false;
  const auto store = [&](Vec light, std::uint16_t* at) {
    hn::StoreU(hn::BitCast(bits, hn::DemoteTo(halves, hn::Min(light, hn::Set(d, 65504.f)))), bits, at);
  };
  for (int x = 0; x < width; x += lanes) {
    const Channels light = load_channels(from + x * channels, channels);
    store(light.red, to + x);
    store(light.green, to + stride + x);
    if (channels > 2) store(light.blue, to + 2 * stride + x);
    if (alpha) store(light.alpha, to + 3 * stride + x);
  }
  if (lit)
    for (int i = 0; i < width * channels; i += lanes) hn::Store(hn::Zero(d), d, from + i);
  return lit;
}

/// `lit` says which chunks of the plane's rows hold light.
void take_plane(LightBand& band, std::uint16_t* to, std::ptrdiff_t stride, bool alpha, std::span<std::uint8_t> lit) {
  const int channels = band.channels();
  // Rows of both are longer than they must be.
  const int width = std::min(band.width_with_margins(), static_cast<int>(stride));
  const auto chunks = static_cast<std::size_t>(stride / SliceBand::chunk_width);
  for (int row = 0; row < band.rows(); ++row, to += (alpha ? 4 : 3) * stride, lit = lit.subspan(chunks)) {
    float* const from = band.row(row) - LightBand::margin * channels;
    for (int x = 0; x < width; x += SliceBand::chunk_width) {
      std::uint8_t& chunk = lit[static_cast<std::size_t>(x / SliceBand::chunk_width)];
      chunk = take_chunk(from + x * channels, channels, to + x, stride, alpha, chunk != 0);
    }
  }
}

/// A plane of a view: by how much it moves, and how much of it is seen.
struct Move {
  float pixels, share;
};

/// Sums all planes of a block for one view, moved.
template <int taps>
void composite_block(const UnpackedBlock& block, int x, std::span<const Shift> shifts, Sums& sums) {
  const Floats d;
  for (int channel = 0; channel < block.channels; ++channel) {
    Vec sum[vectors];
    for (Vec& zero : sum) zero = hn::Zero(d);
    for (const int plane : block.lit) {
      const Shift& shift = shifts[plane];
      const float* from = block.at(plane, channel) + (x + shift.whole - block.first[plane]);
      for (int tap = 0; tap < taps; ++tap) {
        const Vec weight = hn::Set(d, shift.weight[tap]);
        for (int i = 0; i < vectors; ++i) sum[i] = hn::MulAdd(weight, hn::LoadU(d, from + tap + i * lanes), sum[i]);
      }
    }
    for (int i = 0; i < vectors; ++i) hn::Store(sum[i], d, sums[channel] + i * lanes);
  }
}

/// Adds the light of a plane that is seen through those before it. Returns what comes through all of them: nothing
/// where that is less than the tone map can show.
HWY_INLINE Vec see_through(const Vec (&plane)[4], Vec through, Vec* sum) {
  const Floats d;
  constexpr float full = 1.f / 1024;
  for (int channel = 0; channel < 3; ++channel) sum[channel] = hn::MulAdd(through, plane[channel], sum[channel]);
  const Vec rest = hn::Mul(through, hn::Sub(hn::Set(d, 1.f), plane[3]));
  return hn::IfThenElseZero(hn::Ge(rest, hn::Set(d, full)), rest);
}

/// The same as composite_block where each pixel moves by its own gain, or where planes hide each other.
template <int taps>
void composite_pixels(const UnpackedBlock& block, int x, std::span<const Move> moves, const float* gains, Sums& sums) {
  const Floats d;
  const bool hides = block.channels == 4;
  for (int i = 0; i < block_width; i += lanes) {
    Vec sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    Vec through = hn::Set(d, 1.f);
    for (const int plane : block.lit) {
      const Move move = moves[plane];
      const Vec from_first = hn::Iota(d, static_cast<float>(x + i - block.first[plane]));
      const Vec place = hn::MulAdd(hn::Load(d, gains + i), hn::Set(d, move.pixels), from_first);
      if (!hides) {
        read_around<taps>(block, plane, place, hn::Set(d, move.share), sum);
        continue;
      }
      Vec light[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
      read_around<taps>(block, plane, place, hn::Set(d, move.share), light);
      through = see_through(light, through, sum);
      if (hn::AllTrue(d, hn::Eq(through, hn::Zero(d)))) break;
    }
    for (int channel = 0; channel < 3; ++channel) hn::Store(sum[channel], d, sums[channel] + i);
  }
}

/// Views that are composited from the same unpacked block, and how far each plane moves in them.
struct ViewGroup {
  std::size_t first = 0, end = 0;
  std::vector<Move> moves;                // [view][plane]
  std::vector<Shift> shifts;              // [view][plane]: x in the view is x − v·p in the reference
  std::vector<std::array<int, 2>> reach;  // of a plane: its least and its largest whole shift
};

/// As many views from `first` on as a block so wide can serve.
ViewGroup group_from(std::size_t first, const Compositing& compositing, int widest) {
  const int taps = taps_of(compositing.filter);
  const float gain = compositing.focus ? compositing.focus->gain : 1;
  ViewGroup group{.first = first, .end = first, .moves = {}, .shifts = {}, .reach = {}};
  for (; group.end < compositing.views.size(); ++group.end) {
    std::vector<std::array<int, 2>> reach = group.reach;
    std::vector<Shift> shifts;
    std::vector<Move> moves;
    bool fits = true;
    for (std::size_t plane = 0; plane < compositing.parallaxes.size(); ++plane) {
      const float pixels = (central_view - compositing.views[group.end]) * compositing.parallaxes[plane];
      const float share = compositing.shares.empty() ? 1 : compositing.shares[group.end][plane];
      Shift shift = shift_of(pixels, compositing.filter);
      for (float& weight : shift.weight) weight *= share;
      const int in_focus = shift_of(pixels * gain, compositing.filter).whole;
      if (group.end == first) reach.push_back({shift.whole, shift.whole + taps - 1});
      reach[plane] = {std::min({reach[plane][0], shift.whole, in_focus}),
                      std::max({reach[plane][1], shift.whole + taps - 1, in_focus + taps - 1})};
      fits = fits && reach[plane][1] - reach[plane][0] <= widest - block_width - lanes;
      shifts.push_back(shift);
      moves.push_back({pixels, share});
    }
    if (!fits) break;
    group.reach = std::move(reach);
    group.moves.insert(group.moves.end(), moves.begin(), moves.end());
    group.shifts.insert(group.shifts.end(), shifts.begin(), shifts.end());
  }
  return group;
}

/// A band of slices, and how it is composited into rows of pictures from `top` on.
struct BandOfPictures {
  const SliceBand& slices;
  const Compositing& compositing;
  const ToneMap& map;
  int top;
  int rows_of(int height) const { return std::min(slices.rows(), height - top); }
  int channels() const { return slices.hides() ? 4 : map.three_channels() ? 3 : 2; }
};

template <int taps>
void composite_group(const BandOfPictures& band, const ViewGroup& group, std::span<const ViewTarget> targets,
                     UnpackedBlock& block) {
  const int planes = band.slices.planes();
  const int width = targets.front().width();
  HWY_ALIGN Sums sums;
  Gains gains;
  for (int row = 0; row < band.rows_of(targets.front().height()); ++row) {
    for (int x = 0; x < width; x += block_width) {
      find_gains(band.compositing.focus, x, band.top + row, gains);
      unpack(band.slices, row, x, group.reach, block);
      for (std::size_t view = group.first; view < group.end; ++view) {
        const std::size_t of_view = (view - group.first) * planes;
        if (gains.all_one && !band.slices.hides()) {
          composite_block<taps>(block, x, std::span(group.shifts).subspan(of_view, planes), sums);
        } else {
          composite_pixels<taps>(block, x, std::span(group.moves).subspan(of_view, planes), gains.values, sums);
        }
        finish_block(sums, band.map, targets[view], band.top + row, x);
      }
    }
  }
}

template <int taps>
void composite_band(const BandOfPictures& band, std::span<const ViewTarget> targets) {
  constexpr int widest = block_width + 2 * 64;
  UnpackedBlock block(band.slices.planes(), band.channels(), widest);
  for (std::size_t view = 0; view < targets.size();) {
    const ViewGroup group = group_from(view, band.compositing, widest);
    composite_group<taps>(band, group, targets, block);
    view = group.end;
  }
}

/// Calls `call` with how many pixels are read for one as a constant.
template <class Call>
void for_taps(SliceFilter filter, Call call) {
  switch (taps_of(filter)) {
    case 1:
      return call(std::integral_constant<int, 1>());
    case 2:
      return call(std::integral_constant<int, 2>());
    default:
      return call(std::integral_constant<int, 4>());
  }
}

void composite_views(const SliceBand& slices, const Compositing& compositing, const ToneMap& map, int top,
                     std::span<const ViewTarget> targets) {
  for_taps(compositing.filter, [&](auto taps) { composite_band<taps()>({slices, compositing, map, top}, targets); });
}

/// One colour of a block of a row: pixels move as their views do, and their gains.
template <int taps>
void composite_colour(const BandOfPictures& band, std::span<const std::uint16_t> shown, int row, int x, int colour,
                      const UnpackedBlock& block, std::span<const Move> moves, const Interleaved& to) {
  const int count = std::min(block_width, to.picture.width() - x);
  Gains gains;
  find_gains(band.compositing.focus, x, band.top + row, gains);
  for (int i = 0; i < count; ++i)
    gains.values[i] *= central_view - band.compositing.views[shown[3 * static_cast<std::size_t>(x + i) + colour]];
  HWY_ALIGN Sums sums;
  HWY_ALIGN Bytes bytes;
  composite_pixels<taps>(block, x, moves, gains.values, sums);
  tone(sums, band.map, bytes);
  std::uint8_t Rgb8::*const channel = colour == 0 ? &Rgb8::r : colour == 1 ? &Rgb8::g : &Rgb8::b;
  for (int i = 0; i < count; ++i) to.picture(x + i, band.top + row).*channel = bytes[colour][i];
}

template <int taps>
void composite_sub_pixels(const BandOfPictures& band, const Interleaved& to) {
  const ViewGroup all = group_from(0, band.compositing, std::numeric_limits<int>::max());
  int reach = 0;
  std::vector<Move> moves;
  for (std::size_t plane = 0; plane < all.reach.size(); ++plane) {
    reach = std::max(reach, all.reach[plane][1] - all.reach[plane][0]);
    moves.push_back({band.compositing.parallaxes[plane], 1});
  }
  UnpackedBlock block(band.slices.planes(), band.channels(), block_width + reach + static_cast<int>(lanes));
  std::vector<std::uint16_t> shown(3 * static_cast<std::size_t>(to.picture.width()));
  for (int row = 0; row < band.rows_of(to.picture.height()); ++row) {
    to.views_of_row(band.top + row, shown);
    for (int x = 0; x < to.picture.width(); x += block_width) {
      unpack(band.slices, row, x, all.reach, block);
      for (int colour = 0; colour < 3; ++colour) composite_colour<taps>(band, shown, row, x, colour, block, moves, to);
    }
  }
}

void composite_interleaved(const SliceBand& slices, const Compositing& compositing, const ToneMap& map, int top,
                           const Interleaved& to) {
  for_taps(compositing.filter, [&](auto taps) { composite_sub_pixels<taps()>({slices, compositing, map, top}, to); });
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(take_plane);
HWY_EXPORT(finish_light_band);
HWY_EXPORT(composite_views);
HWY_EXPORT(composite_interleaved);

void SliceBand::take(int plane, LightBand& band) {
  const std::span<std::uint8_t> lit = lit_of(plane);
  const auto is_lit = [](std::uint8_t chunk) { return chunk != 0; };
  if (!band.lit() && std::ranges::none_of(lit, is_lit)) return;
  HWY_DYNAMIC_DISPATCH(take_plane)(band, row(plane, 0, 0) - margin(), stride_, hides(), lit);
  band.note_dark();
}

void finish_band(const LightBand& band, const ToneMap& tone, int top, const ViewTarget& target) {
  HWY_DYNAMIC_DISPATCH(finish_light_band)(band, tone, top, target);
}

void composite(const SliceBand& slices, const Compositing& compositing, const ToneMap& tone, int top,
               std::span<const ViewTarget> targets) {
  HWY_DYNAMIC_DISPATCH(composite_views)(slices, compositing, tone, top, targets);
}

void composite(const SliceBand& slices, const Compositing& compositing, const ToneMap& tone, int top,
               const Interleaved& to) {
  HWY_DYNAMIC_DISPATCH(composite_interleaved)(slices, compositing, tone, top, to);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
