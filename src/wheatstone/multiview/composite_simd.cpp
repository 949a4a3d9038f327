#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "wheatstone/multiview/slice_band_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/multiview/composite_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "wheatstone/multiview/tone_simd_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Adds what the picture of half the size has in a block of a row: it is interpolated between its pixels, which keeps
/// the sum. Pixel i of a picture lies between pixels (i − pad) / 2 + 1 and + 3 of the smaller one, whose pad is 2.
HWY_INLINE void add_smaller(const ViewTarget& target, int row, int x, int channels, Sums& sums) {
  const Floats d;
  const int y = row - target.pad;
  const int half_row = (y - (y & 1)) / 2;
  const int near_row = half_row + 2;
  const int far_row = (y & 1) != 0 ? half_row + 3 : half_row + 1;
  const int first = (x - target.pad) / 2 + 1;
  const Vec near_share = hn::Set(d, 0.75f);
  const Vec far_share = hn::Set(d, 0.25f);
  HWY_ALIGN float blend[block_width / 2 + 2 * 16];
  for (int channel = 0; channel < channels; ++channel) {
    const float* const near = target.smaller->row(near_row, channel) + first;
    const float* const far = target.smaller->row(far_row, channel) + first;
    for (int i = 0; i < block_width / 2 + 2; i += lanes)
      hn::Store(hn::MulAdd(near_share, hn::LoadU(d, near + i), hn::Mul(far_share, hn::LoadU(d, far + i))), d,
                blend + i);
    HWY_ALIGN float wide[2 * 16];
    for (int i = 0; i < block_width / 2; i += lanes) {
      const Vec middle = hn::Mul(near_share, hn::LoadU(d, blend + i + 1));
      const Vec even = hn::MulAdd(far_share, hn::LoadU(d, blend + i), middle);
      const Vec odd = hn::MulAdd(far_share, hn::LoadU(d, blend + i + 2), middle);
      hn::StoreInterleaved2(even, odd, d, wide);
      for (int k = 0; k < 2; ++k) {
        float* const to = sums[channel] + 2 * i + k * lanes;
        hn::Store(hn::Add(hn::Load(d, to), hn::Load(d, wide + k * lanes)), d, to);
      }
    }
  }
}

/// Three rows of bytes into pixels.
HWY_INLINE void interleave(const std::uint8_t* red, const std::uint8_t* green, const std::uint8_t* blue, int count,
                           Rgb8* to) {
  const hn::CappedTag<std::uint8_t, 16> d;
  const int step = hn::MaxLanes(d);
  int x = 0;
  for (; x + step <= count; x += step)
    hn::StoreInterleaved3(hn::LoadU(d, red + x), hn::LoadU(d, green + x), hn::LoadU(d, blue + x), d,
                          reinterpret_cast<std::uint8_t*>(to + x));
  for (; x < count; ++x) to[x] = {red[x], green[x], blue[x]};
}

/// A block of one view's sums goes where it belongs.
HWY_INLINE void finish_block(Sums& sums, const ToneMap& map, const ViewTarget& target, int row, int x) {
  const Floats d;
  const int channels = map.three_channels() ? 3 : 2;
  if (target.smaller != nullptr) add_smaller(target, row, x, channels, sums);
  if (target.light != nullptr) {
    for (int channel = 0; channel < target.light->channels(); ++channel)
      for (int i = 0; i < block_width; i += lanes)
        hn::StoreU(hn::Load(d, sums[channel] + i), d, target.light->row(row, channel) + x + i);
    return;
  }
  HWY_ALIGN Bytes bytes;
  tone(sums, map, bytes);
  interleave(bytes[0], bytes[1], bytes[2], std::min(block_width, target.picture.width() - x),
             target.picture.row(row).data() + x);
}

/// One vector's worth of pixels, channel by channel.
struct Channels {
  Vec red, green, blue;
};

/// Pixels of mass have two channels (LightBand).
HWY_INLINE Channels load_channels(const float* from, int count) {
  const Floats d;
  Channels channels;
  if (count == 2) {
    hn::LoadInterleaved2(d, from, channels.red, channels.green);
    channels.blue = hn::Zero(d);
    return channels;
  }
  Vec nothing;
  hn::LoadInterleaved4(d, from, channels.red, channels.green, channels.blue, nothing);
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

/// Of mass, the third channel stays as it is: dark.
void take_plane(const LightBand& band, std::uint16_t* to, std::ptrdiff_t stride, SliceBand::Extent* lit) {
  const Floats d;
  const hn::Rebind<hwy::float16_t, Floats> halves;
  const hn::Rebind<std::uint16_t, Floats> bits;
  const auto store = [&](Vec light, std::uint16_t* at) {
    hn::StoreU(hn::BitCast(bits, hn::DemoteTo(halves, hn::Min(light, hn::Set(d, 65504.f)))), bits, at);
  };
  const int channels = band.channels();
  // Rows of both are longer than they must be.
  const int width = std::min(band.width_with_margins(), static_cast<int>(stride));
  for (int row = 0; row < band.rows(); ++row, to += 3 * stride) {
    const float* from = band.row(row) - LightBand::margin * channels;
    lit[row] = {.first = width, .end = -LightBand::margin};
    for (int x = 0; x < width; x += lanes) {
      const Channels light = load_channels(from + x * channels, channels);
      const Vec sum = hn::Add(light.red, hn::Add(light.green, light.blue));
      if (!hn::AllFalse(d, hn::Gt(sum, hn::Zero(d)))) {
        lit[row].first = std::min(lit[row].first, x - LightBand::margin);
        lit[row].end = x + lanes - LightBand::margin;
      }
      store(light.red, to + x);
      store(light.green, to + stride + x);
      if (channels > 2) store(light.blue, to + 2 * stride + x);
    }
  }
}

/// How far a plane moves in a view: whole pixels, and the weights of the pixels around the rest.
struct Shift {
  int whole;
  std::array<float, 4> weight;
};

Shift shift_of(float pixels, Resampling resampling) {
  Shift shift{};
  if (resampling == Resampling::nearest) {
    shift.whole = static_cast<int>(std::floor(pixels + 0.5f));
    shift.weight[0] = 1;
    return shift;
  }
  const float whole = std::floor(pixels);
  const float f = pixels - whole;
  shift.whole = static_cast<int>(whole);
  if (resampling == Resampling::linear) {
    shift.weight = {1 - f, f, 0, 0};
    return shift;
  }
  // Keys 1981, a = −1/2.
  shift.whole -= 1;
  shift.weight = {((-0.5f * f + 1) * f - 0.5f) * f, (1.5f * f - 2.5f) * f * f + 1, ((-1.5f * f + 2) * f + 0.5f) * f,
                  (0.5f * f - 0.5f) * f * f};
  return shift;
}

/// One block of one row of all planes, as floats.
struct UnpackedBlock {
  static constexpr int widest = block_width + 2 * 64;
  static constexpr int beside = 2 * 16;  // what a vector may reach beyond the first and the last
  explicit UnpackedBlock(int planes)
      : values(static_cast<std::size_t>(planes) * 3 * widest + 2 * beside), first(static_cast<std::size_t>(planes)) {}
  std::vector<float> values;  // [plane][channel][widest]
  std::vector<int> first;     // column of each plane's value 0
  std::vector<int> lit;       // the planes that hold light here
  const float* at(int plane, int channel) const {
    return values.data() + beside + (static_cast<std::size_t>(plane) * 3 + channel) * widest;
  }
  float* at(int plane, int channel) { return const_cast<float*>(std::as_const(*this).at(plane, channel)); }
};

/// Unpacks the planes that are lit where any view of the group looks, and lists them.
void unpack(const SliceBand& slices, int row, int x, const std::vector<std::array<int, 2>>& reach, int channels,
            UnpackedBlock& block) {
  const Floats d;
  const hn::Rebind<hwy::float16_t, Floats> halves;
  const hn::Rebind<std::uint16_t, Floats> bits;
  block.lit.clear();
  for (int plane = 0; plane < slices.planes(); ++plane) {
    const int first = std::max(x + reach[plane][0], slices.left() - slices.margin());
    const int end = std::min(x + block_width + reach[plane][1], slices.right() + slices.margin());
    // What is dark costs nothing.
    if (!slices.lit(plane, row).meets(first - slices.left(), end - slices.left())) continue;
    block.lit.push_back(plane);
    block.first[plane] = x + reach[plane][0];
    for (int channel = 0; channel < channels; ++channel) {
      const std::uint16_t* from = slices.row(plane, row, channel) + (first - slices.left());
      float* to = block.at(plane, channel) + (first - block.first[plane]);
      for (int i = 0; i < end - first; i += lanes)
        hn::StoreU(hn::PromoteTo(d, hn::BitCast(halves, hn::LoadU(bits, from + i))), d, to + i);
    }
  }
}

/// Sums all planes of a block for one view, moved.
template <int taps>
void composite_block(const UnpackedBlock& block, int x, std::span<const Shift> shifts, int channels, Sums& sums) {
  const Floats d;
  for (int channel = 0; channel < channels; ++channel) {
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

/// How much farther than elsewhere the pixels of a block move.
struct Gains {
  bool all_one = true;
  HWY_ALIGN float values[block_width];
};

void find_gains(const std::optional<Focus>& focus, int x, int y, Gains& gains) {
  gains.all_one = true;
  if (!focus || std::abs(static_cast<float>(y) + 0.5f - focus->y_px) >= focus->radius_px) return;
  const float from_middle = static_cast<float>(x) + block_width / 2.f - focus->x_px;
  if (std::abs(from_middle) >= focus->radius_px + block_width / 2.f) return;
  for (int i = 0; i < block_width; ++i) {
    gains.values[i] = focus->gain_at(static_cast<float>(x + i) + 0.5f, static_cast<float>(y) + 0.5f);
    gains.all_one = gains.all_one && gains.values[i] == 1;
  }
}

/// A plane of a view: by how much it moves, and how much of it is seen.
struct Move {
  float pixels, share;
};

/// The weights of the pixels around a place between them, and the first of these.
template <int taps>
HWY_INLINE hn::Vec<hn::RebindToSigned<Floats>> weigh_around(Vec place, Vec share, Vec (&weights)[taps]) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const Vec one = hn::Set(d, 1.f);
  if constexpr (taps == 1) {
    weights[0] = share;
    return hn::ConvertTo(di, hn::Floor(hn::Add(place, hn::Set(d, 0.5f))));
  }
  const Vec whole = hn::Floor(place);
  const Vec f = hn::Sub(place, whole);
  if constexpr (taps == 2) {
    weights[1] = hn::Mul(f, share);
    weights[0] = hn::Sub(share, weights[1]);
  } else if constexpr (taps == 4) {
    const auto polynomial = [&](float cubic, float square, float linear, Vec constant) {
      const Vec inner = hn::MulAdd(hn::Set(d, cubic), f, hn::Set(d, square));
      return hn::Mul(hn::MulAdd(hn::MulAdd(inner, f, hn::Set(d, linear)), f, constant), share);
    };
    weights[0] = polynomial(-0.5f, 1, -0.5f, hn::Zero(d));
    weights[1] = polynomial(1.5f, -2.5f, 0, one);
    weights[2] = polynomial(-1.5f, 2, 0.5f, hn::Zero(d));
    weights[3] = polynomial(0.5f, -0.5f, 0, hn::Zero(d));
  }
  return hn::ConvertTo(di, taps == 4 ? hn::Sub(whole, one) : whole);
}

/// The same where each pixel moves by its own gain. Those of a vector move by nearly as many whole pixels: what some of
/// them want of a pixel that the others do not is read for all, with a weight of 0 for the others.
template <int taps>
void composite_in_focus(const UnpackedBlock& block, int x, std::span<const Move> moves, const Gains& gains,
                        int channels, Sums& sums) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  for (int i = 0; i < block_width; i += lanes) {
    Vec sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (const int plane : block.lit) {
      const Move move = moves[plane];
      const Vec from_first = hn::Iota(d, static_cast<float>(x + i - block.first[plane]));
      const Vec place = hn::MulAdd(hn::Load(d, gains.values + i), hn::Set(d, move.pixels), from_first);
      Vec weights[taps];
      const auto wanted = weigh_around<taps>(place, hn::Set(d, move.share), weights);
      const auto first = hn::Min(hn::Max(wanted, hn::Zero(di)), hn::Set(di, UnpackedBlock::widest - taps));
      const auto shift = hn::Sub(first, hn::Iota(di, 0));
      const int least = hn::GetLane(hn::MinOfLanes(di, shift));
      const int most = hn::GetLane(hn::MaxOfLanes(di, shift));
      for (int at = least; at < most + taps; ++at) {
        Vec weight = weights[at - least < taps ? at - least : 0];
        if (least != most) {
          weight = hn::Zero(d);
          for (int tap = 0; tap < taps; ++tap) {
            const auto here = hn::RebindMask(d, hn::Eq(shift, hn::Set(di, at - tap)));
            weight = hn::IfThenElse(here, weights[tap], weight);
          }
        }
        for (int channel = 0; channel < channels; ++channel)
          sum[channel] = hn::MulAdd(weight, hn::LoadU(d, block.at(plane, channel) + at), sum[channel]);
      }
    }
    for (int channel = 0; channel < channels; ++channel) hn::Store(sum[channel], d, sums[channel] + i);
  }
}

/// Views that are composited from the same unpacked block, and how far each plane moves in them.
struct ViewGroup {
  std::size_t first = 0, end = 0;
  std::vector<Move> moves;                // [view][plane]
  std::vector<Shift> shifts;              // [view][plane]: x in the view is x − v·p in the reference
  std::vector<std::array<int, 2>> reach;  // of a plane: its least and its largest whole shift
};

/// As many views from `first` on as one block can serve.
ViewGroup group_from(std::size_t first, const Compositing& compositing) {
  const int taps = taps_of(compositing.resampling);
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
      Shift shift = shift_of(pixels, compositing.resampling);
      for (float& weight : shift.weight) weight *= share;
      const int in_focus = shift_of(pixels * gain, compositing.resampling).whole;
      if (group.end == first) reach.push_back({shift.whole, shift.whole + taps - 1});
      reach[plane] = {std::min({reach[plane][0], shift.whole, in_focus}),
                      std::max({reach[plane][1], shift.whole + taps - 1, in_focus + taps - 1})};
      fits = fits && reach[plane][1] - reach[plane][0] <= UnpackedBlock::widest - block_width - lanes;
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

/// Where a band of every view goes: into the rows of its target from `top` on.
struct BandOfViews {
  const ToneMap& map;
  const std::optional<Focus>& focus;
  int top;
  std::span<const ViewTarget> targets;
};

template <int taps>
void composite_group(const SliceBand& slices, const ViewGroup& group, const BandOfViews& to, UnpackedBlock& block) {
  const int planes = slices.planes();
  const int width = to.targets.front().width();
  const int rows = std::min(slices.rows(), to.targets.front().height() - to.top);
  const int channels = to.map.three_channels() ? 3 : 2;
  HWY_ALIGN Sums sums;
  Gains gains;
  for (int row = 0; row < rows; ++row) {
    for (int x = 0; x < width; x += block_width) {
      find_gains(to.focus, x, to.top + row, gains);
      unpack(slices, row, x, group.reach, channels, block);
      for (std::size_t view = group.first; view < group.end; ++view) {
        const std::size_t of_view = (view - group.first) * planes;
        if (gains.all_one) {
          composite_block<taps>(block, x, std::span(group.shifts).subspan(of_view, planes), channels, sums);
        } else {
          composite_in_focus<taps>(block, x, std::span(group.moves).subspan(of_view, planes), gains, channels, sums);
        }
        finish_block(sums, to.map, to.targets[view], to.top + row, x);
      }
    }
  }
}

template <int taps>
void composite_band(const SliceBand& slices, const Compositing& compositing, const BandOfViews& to) {
  UnpackedBlock block(slices.planes());
  for (std::size_t view = 0; view < to.targets.size();) {
    const ViewGroup group = group_from(view, compositing);
    composite_group<taps>(slices, group, to, block);
    view = group.end;
  }
}

void composite_views(const SliceBand& slices, const Compositing& compositing, const ToneMap& map, int top,
                     std::span<const ViewTarget> targets) {
  const BandOfViews to{map, compositing.focus, top, targets};
  switch (taps_of(compositing.resampling)) {
    case 1:
      return composite_band<1>(slices, compositing, to);
    case 2:
      return composite_band<2>(slices, compositing, to);
    default:
      return composite_band<4>(slices, compositing, to);
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(take_plane);
HWY_EXPORT(finish_light_band);
HWY_EXPORT(composite_views);

void SliceBand::take(int plane, LightBand& band) {
  Extent* const lit = lit_.data() + static_cast<std::size_t>(plane) * rows_;
  if (band.lit()) {
    HWY_DYNAMIC_DISPATCH(take_plane)(band, row(plane, 0, 0) - margin(), stride_, lit);
  } else {
    std::fill(lit, lit + rows_, Extent{});
  }
  band.darken();
}

void finish_band(const LightBand& band, const ToneMap& tone, int top, const ViewTarget& target) {
  HWY_DYNAMIC_DISPATCH(finish_light_band)(band, tone, top, target);
}

void composite(const SliceBand& slices, const Compositing& compositing, const ToneMap& tone, int top,
               std::span<const ViewTarget> targets) {
  HWY_DYNAMIC_DISPATCH(composite_views)(slices, compositing, tone, top, targets);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
