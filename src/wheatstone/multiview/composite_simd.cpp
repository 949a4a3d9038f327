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

/// Bytes of exposed, tone-mapped light. `to` takes block_width bytes.
HWY_INLINE void tone(Vec light, const ToneMap& map, std::uint8_t* to) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  const Vec exposed = hn::Max(hn::Mul(light, hn::Set(d, map.exposure)), hn::Zero(d));
  const Vec mapped = hn::Div(exposed, hn::Add(exposed, hn::Set(d, 1.f)));
  const auto entry = hn::NearestInt(hn::Mul(mapped, hn::Set(d, ToneMap::table_size - 1.f)));
  hn::StoreU(hn::DemoteTo(bytes, hn::GatherIndex(di, map.table.data(), entry)), bytes, to);
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

void tone_map_band(const LightBand& band, const ToneMap& map, int top, ImageView<Rgb8> picture) {
  HWY_ALIGN std::uint8_t bytes[3][block_width];
  const int rows = std::min(band.rows(), picture.height() - top);
  for (int row = 0; row < rows; ++row) {
    for (int x = 0; x < picture.width(); x += block_width) {
      for (int i = 0; i < block_width; i += lanes) {
        const Channels light = load_channels(band.row(row) + (x + i - band.left()) * LightBand::channels);
        tone(light.red, map, bytes[0] + i);
        tone(light.green, map, bytes[1] + i);
        tone(light.blue, map, bytes[2] + i);
      }
      interleave(bytes[0], bytes[1], bytes[2], std::min(block_width, picture.width() - x),
                 picture.row(top + row).data() + x);
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

constexpr int taps_of(Resampling resampling) {
  return resampling == Resampling::nearest ? 1 : resampling == Resampling::linear ? 2 : 4;
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
void unpack(const SliceBand& slices, int row, int x, const std::vector<std::array<int, 2>>& reach,
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
    for (int channel = 0; channel < 3; ++channel) {
      const std::uint16_t* from = slices.row(plane, row, channel) + (first - slices.left());
      float* to = block.values.data() + (static_cast<std::size_t>(plane) * 3 + channel) * UnpackedBlock::widest +
                  (first - block.first[plane]);
      for (int i = 0; i < end - first; i += lanes)
        hn::StoreU(hn::PromoteTo(d, hn::BitCast(halves, hn::LoadU(bits, from + i))), d, to + i);
    }
  }
}

/// Sums all planes of a block for one view, moved, and tone-maps them.
template <int taps>
void composite_block(const UnpackedBlock& block, int x, std::span<const Shift> shifts, const ToneMap& map,
                     std::uint8_t (*bytes)[block_width]) {
  const Floats d;
  for (int channel = 0; channel < 3; ++channel) {
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
    for (int i = 0; i < vectors; ++i) tone(sum[i], map, bytes[channel] + i * lanes);
  }
}

/// Views that are composited from the same unpacked block, and how far each plane moves in them.
struct ViewGroup {
  std::size_t first = 0, end = 0;
  std::vector<Shift> shifts;              // [view][plane]: x in the view is x − v·p in the reference
  std::vector<std::array<int, 2>> reach;  // of a plane: its least and its largest whole shift
};

/// As many views from `first` on as one block can serve.
ViewGroup group_from(std::size_t first, const Compositing& compositing) {
  const int taps = taps_of(compositing.resampling);
  ViewGroup group{.first = first, .end = first, .shifts = {}, .reach = {}};
  for (; group.end < compositing.views.size(); ++group.end) {
    std::vector<std::array<int, 2>> reach = group.reach;
    std::vector<Shift> shifts;
    bool fits = true;
    for (std::size_t plane = 0; plane < compositing.parallaxes.size(); ++plane) {
      const Shift shift = shift_of((central_view - compositing.views[group.end]) * compositing.parallaxes[plane],
                                   compositing.resampling);
      if (group.end == first) reach.push_back({shift.whole, shift.whole + taps - 1});
      reach[plane] = {std::min(reach[plane][0], shift.whole), std::max(reach[plane][1], shift.whole + taps - 1)};
      fits = fits && reach[plane][1] - reach[plane][0] <= UnpackedBlock::widest - block_width - lanes;
      shifts.push_back(shift);
    }
    if (!fits) break;
    group.reach = std::move(reach);
    group.shifts.insert(group.shifts.end(), shifts.begin(), shifts.end());
  }
  return group;
}

/// Where a band of every view goes: into the rows of its picture from `top` on.
struct BandOfPictures {
  const ToneMap& map;
  int top;
  std::span<const ImageView<Rgb8>> pictures;
};

template <int taps>
void composite_group(const SliceBand& slices, const ViewGroup& group, const BandOfPictures& to, UnpackedBlock& block) {
  const int planes = slices.planes();
  const int width = to.pictures.front().width();
  const int rows = std::min(slices.rows(), to.pictures.front().height() - to.top);
  HWY_ALIGN std::uint8_t bytes[3][block_width];
  for (int row = 0; row < rows; ++row) {
    for (int x = 0; x < width; x += block_width) {
      unpack(slices, row, x, group.reach, block);
      for (std::size_t view = group.first; view < group.end; ++view) {
        const std::span shifts = std::span(group.shifts).subspan((view - group.first) * planes, planes);
        composite_block<taps>(block, x, shifts, to.map, bytes);
        interleave(bytes[0], bytes[1], bytes[2], std::min(block_width, width - x),
                   to.pictures[view].row(to.top + row).data() + x);
      }
    }
  }
}

template <int taps>
void composite_band(const SliceBand& slices, const Compositing& compositing, const BandOfPictures& to) {
  UnpackedBlock block;
  block.values.resize(static_cast<std::size_t>(slices.planes()) * 3 * UnpackedBlock::widest);
  block.first.resize(slices.planes());
  for (std::size_t view = 0; view < to.pictures.size();) {
    const ViewGroup group = group_from(view, compositing);
    composite_group<taps>(slices, group, to, block);
    view = group.end;
  }
}

void composite_views(const SliceBand& slices, const Compositing& compositing, const ToneMap& map, int top,
                     std::span<const ImageView<Rgb8>> pictures) {
  const BandOfPictures to{map, top, pictures};
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
HWY_EXPORT(tone_map_band);
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

void tone_map(const LightBand& band, const ToneMap& tone, int top, ImageView<Rgb8> picture) {
  HWY_DYNAMIC_DISPATCH(tone_map_band)(band, tone, top, picture);
}

void composite(const SliceBand& slices, const Compositing& compositing, const ToneMap& tone, int top,
               std::span<const ImageView<Rgb8>> pictures) {
  HWY_DYNAMIC_DISPATCH(composite_views)(slices, compositing, tone, top, pictures);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
