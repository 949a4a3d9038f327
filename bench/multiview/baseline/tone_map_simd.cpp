#include <algorithm>

#include "multiview/baseline/tone_map.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "multiview/baseline/tone_map_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::baseline::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Vec = hn::Vec<Floats>;
constexpr std::ptrdiff_t lanes = hn::MaxLanes(Floats());

// Columns composited at a time: their light of all planes fits in a first-level cache, and their sums in registers.
constexpr int block_width = 4 * 16;

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

}  // namespace wheatstone::baseline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone::baseline {

HWY_EXPORT(tone_map_band);

void tone_map(const LightBand& band, const ToneMap& tone, int top, ImageView<Rgb8> picture) {
  HWY_DYNAMIC_DISPATCH(tone_map_band)(band, tone, top, picture);
}

}  // namespace wheatstone::baseline
#endif  // HWY_ONCE
