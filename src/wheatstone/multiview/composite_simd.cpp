#include <algorithm>
#include <array>
#include <cmath>

#include "wheatstone/multiview/slice_band_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/multiview/composite_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Vec = hn::Vec<Floats>;
constexpr std::ptrdiff_t lanes = hn::MaxLanes(Floats());

// Columns composited at a time: their light of all planes fits in a first-level cache, and their sums in registers.
constexpr int block_width = 4 * 16;
constexpr int vectors = block_width / lanes;

/// The sums of a block of pixels, channel by channel.
using Sums = float[3][block_width];
using Bytes = std::uint8_t[3][block_width];

HWY_INLINE void store_bytes(hn::Vec<hn::RebindToSigned<Floats>> values, std::uint8_t* to) {
  const hn::Rebind<std::uint8_t, Floats> bytes;
  hn::StoreU(hn::DemoteTo(bytes, values), bytes, to);
}

/// sRGB bytes of linear light 0..1.
HWY_INLINE void store_srgb(Vec linear, const ToneMap& map, std::uint8_t* to) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const auto entry = hn::NearestInt(hn::Mul(linear, hn::Set(d, ToneMap::table_size - 1.f)));
  store_bytes(hn::GatherIndex(di, map.table.data(), entry), to);
}

HWY_INLINE void tone_light(const Sums& sums, const ToneMap& map, Bytes& bytes) {
  const Floats d;
  for (int channel = 0; channel < 3; ++channel)
    for (int i = 0; i < block_width; i += lanes) {
      const Vec light = hn::Load(d, sums[channel] + i);
      const Vec exposed = hn::Max(hn::Mul(light, hn::Set(d, map.exposure)), hn::Zero(d));
      const Vec one = hn::Set(d, 1.f);
      const Vec shown = map.bounded ? hn::Min(exposed, one) : hn::Div(exposed, hn::Add(exposed, one));
      store_srgb(shown, map, bytes[channel] + i);
    }
}

/// Where the stretch of a number stands in its table.
HWY_INLINE hn::Vec<hn::RebindToSigned<Floats>> stretch_index(Vec value, const ToneMap& map) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const Vec share = hn::Max(hn::MulAdd(value, hn::Set(d, map.scale), hn::Set(d, map.offset)), hn::Zero(d));
  const auto index =
      hn::Sub(hn::ShiftRight<ToneMap::index_shift>(hn::BitCast(di, share)), hn::Set(di, ToneMap::first_index));
  return hn::Min(hn::Max(index, hn::Zero(di)), hn::Set(di, ToneMap::stretch_size - 1));
}

HWY_INLINE void tone_mass(const Sums& sums, const ToneMap& map, Bytes& bytes) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const Vec nothing = hn::Set(d, 1e-30f);
  const Vec most_hue = hn::Set(d, static_cast<float>(map.hues - 1));
  for (int i = 0; i < block_width; i += lanes) {
    const Vec column = hn::Load(d, sums[0] + i);
    const Vec mean = hn::Div(hn::Load(d, sums[1] + i), hn::Max(column, nothing));
    const auto brightness =
        hn::GatherIndex(di, map.stretch.data(), stretch_index(map.shown == Shown::mean ? mean : column, map));
    const auto hue = hn::NearestInt(hn::Clamp(hn::Mul(mean, most_hue), hn::Zero(d), most_hue));
    const auto found = hn::GatherIndex(di, map.colours.data(), hn::Add(brightness, hue));
    const auto colour = hn::IfThenElseZero(hn::RebindMask(di, hn::Gt(column, nothing)), found);
    const auto low = hn::Set(di, 255);
    store_bytes(hn::And(colour, low), bytes[0] + i);
    store_bytes(hn::And(hn::ShiftRight<8>(colour), low), bytes[1] + i);
    store_bytes(hn::ShiftRight<16>(colour), bytes[2] + i);
  }
}

HWY_INLINE void tone_colours(const Sums& sums, const ToneMap& map, Bytes& bytes) {
  const Floats d;
  for (int i = 0; i < block_width; i += lanes) {
    const Vec most = hn::Max(hn::Max(hn::Load(d, sums[0] + i), hn::Load(d, sums[1] + i)), hn::Load(d, sums[2] + i));
    const Vec bright = hn::GatherIndex(d, map.linear_stretch.data(), stretch_index(most, map));
    const Vec factor = hn::Div(bright, hn::Max(most, hn::Set(d, 1e-30f)));
    for (int channel = 0; channel < 3; ++channel) {
      const Vec light = hn::Mul(hn::Load(d, sums[channel] + i), factor);
      store_srgb(hn::Clamp(light, hn::Zero(d), hn::Set(d, 1.f)), map, bytes[channel] + i);
    }
  }
}

HWY_INLINE void tone(const Sums& sums, const ToneMap& map, Bytes& bytes) {
  if (map.look == Look::thesis) return tone_light(sums, map, bytes);
  if (map.shown == Shown::colours) return tone_colours(sums, map, bytes);
  tone_mass(sums, map, bytes);
}

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

HWY_INLINE Channels load_channels(const float* from) {
  const Floats d;
  Channels channels;
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
        const Channels light = load_channels(band.row(row) + (x + i - band.left()) * LightBand::channels);
        hn::Store(light.red, d, sums[0] + i);
        hn::Store(light.green, d, sums[1] + i);
        hn::Store(light.blue, d, sums[2] + i);
      }
      finish_block(sums, map, target, top + row, x);
    }
  }
}

void take_plane(const LightBand& band, std::uint16_t* to, std::ptrdiff_t stride, SliceBand::Extent* lit) {
  const Floats d;
  const hn::Rebind<hwy::float16_t, Floats> halves;
  const hn::Rebind<std::uint16_t, Floats> bits;
  const auto store = [&](Vec light, std::uint16_t* at) {
    hn::StoreU(hn::BitCast(bits, hn::DemoteTo(halves, hn::Min(light, hn::Set(d, 65504.f)))), bits, at);
  };
  for (int row = 0; row < band.rows(); ++row, to += 3 * stride) {
    const float* from = band.row(row) - LightBand::margin * LightBand::channels;
    lit[row] = {.first = band.width_with_margins(), .end = -LightBand::margin};
    for (int x = 0; x < band.width_with_margins(); x += lanes) {
      const Channels light = load_channels(from + x * LightBand::channels);
      const Vec sum = hn::Add(light.red, hn::Add(light.green, light.blue));
      if (!hn::AllFalse(d, hn::Gt(sum, hn::Zero(d)))) {
        lit[row].first = std::min(lit[row].first, x - LightBand::margin);
        lit[row].end = x + lanes - LightBand::margin;
      }
      store(light.red, to + x);
      store(light.green, to + stride + x);
      store(light.blue, to + 2 * stride + x);
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
  std::vector<float> values;  // [plane][channel][widest]
  std::vector<int> first;     // column of each plane's value 0
  std::vector<int> lit;       // the planes that hold light here
  const float* at(int plane, int channel) const {
    return values.data() + (static_cast<std::size_t>(plane) * 3 + channel) * widest;
  }
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
      float* to = block.values.data() + (static_cast<std::size_t>(plane) * 3 + channel) * UnpackedBlock::widest +
                  (first - block.first[plane]);
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

/// The same where each pixel moves by its own gain.
template <int taps>
void composite_in_focus(const UnpackedBlock& block, int x, std::span<const Move> moves, const Gains& gains,
                        int channels, Sums& sums) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  for (int channel = 0; channel < channels; ++channel) std::fill_n(sums[channel], block_width, 0.f);
  for (const int plane : block.lit) {
    const Move move = moves[plane];
    const Vec share = hn::Set(d, move.share);
    for (int i = 0; i < block_width; i += lanes) {
      const Vec from_first = hn::Iota(d, static_cast<float>(x + i - block.first[plane]));
      const Vec place = hn::MulAdd(hn::Load(d, gains.values + i), hn::Set(d, move.pixels), from_first);
      Vec weights[taps];
      const auto first = hn::Min(hn::Max(weigh_around<taps>(place, share, weights), hn::Zero(di)),
                                 hn::Set(di, UnpackedBlock::widest - taps));
      for (int channel = 0; channel < channels; ++channel) {
        Vec sum = hn::Load(d, sums[channel] + i);
        for (int tap = 0; tap < taps; ++tap)
          sum = hn::MulAdd(weights[tap], hn::GatherIndex(d, block.at(plane, channel) + tap, first), sum);
        hn::Store(sum, d, sums[channel] + i);
      }
    }
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
  UnpackedBlock block;
  block.values.resize(static_cast<std::size_t>(slices.planes()) * 3 * UnpackedBlock::widest);
  block.first.resize(slices.planes());
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
