#include <algorithm>
#include <array>

#include "wheatstone/drawing/rasterise_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/drawing/finish_row_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, Canvas::widest_vector>;
using Bytes = hn::CappedTag<std::uint8_t, Canvas::widest_vector>;
constexpr int block_px = FrontToBackAccumulator::block_px;

/// A channel of a block.
using Channel = std::array<std::uint8_t, block_px>;

void interleave(const std::array<Channel, 3>& colours, Rgb8* to) {
  const Bytes bytes;
  for (std::size_t i = 0; i < block_px; i += hn::Lanes(bytes))
    hn::StoreInterleaved3(hn::LoadU(bytes, colours[0].data() + i), hn::LoadU(bytes, colours[1].data() + i),
                          hn::LoadU(bytes, colours[2].data() + i), bytes, &to[i].r);
}

std::array<Channel, 3> separated(const Rgb8* from) {
  const Bytes bytes;
  std::array<Channel, 3> colours;
  for (std::size_t i = 0; i < block_px; i += hn::Lanes(bytes)) {
    auto red = hn::Zero(bytes), green = red, blue = red;
    hn::LoadInterleaved3(bytes, &from[i].r, red, green, blue);
    hn::StoreU(red, bytes, colours[0].data() + i);
    hn::StoreU(green, bytes, colours[1].data() + i);
    hn::StoreU(blue, bytes, colours[2].data() + i);
  }
  return colours;
}

/// What lies behind the paint of a block.
std::array<Channel, 3> behind(const RowToFinish& to, int first, int count) {
  std::array<Channel, 3> colours;
  if (to.background.empty()) {
    colours[0].fill(to.canvas_colour.r);
    colours[1].fill(to.canvas_colour.g);
    colours[2].fill(to.canvas_colour.b);
    return colours;
  }
  const Rgb8* from = to.background.data() + first;
  if (count == block_px) return separated(from);
  std::array<Rgb8, block_px> last{};
  std::copy_n(from, count, last.begin());
  return separated(last.data());
}

/// A channel of a block with 16 bits.
using DeepChannel = std::array<std::uint16_t, block_px>;

bool finish(const FrontToBackAccumulator& accumulator, int row, const RowToFinish& to) {
  const Floats f;
  const hn::RebindToSigned<Floats> integers;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  const hn::Rebind<std::uint16_t, Floats> words;
  std::array<DeepChannel, 3> deep;
  const int lanes = static_cast<int>(hn::Lanes(f)), width = accumulator.width();
  const auto bare_light = hn::Set(f, to.bare_light), gap_light = hn::Set(f, FrontToBackAccumulator::least_gap_light);
  const auto one = hn::Set(f, 1.f), half = hn::Set(f, 0.5f), white = hn::Set(f, 255.f);
  bool has_gap = false;
  for (int number = 0; number < accumulator.block_count(); ++number) {
    const FrontToBackAccumulator::Block& block = accumulator.block(row, number);
    const int first = number * block_px, count = std::min(width - first, block_px);
    auto colours = to.is_opaque ? std::array<Channel, 3>{} : behind(to, first, count);
    Channel bare;
    for (int i = 0; i < block_px; i += lanes) {
      const auto light = hn::Load(f, block.light + i);
      const auto whole = hn::Div(one, hn::Max(hn::Sub(one, light), hn::Set(f, 1e-6f)));
      const auto finish_channel = [&](const float* drawn, Channel& channel, DeepChannel& deep_channel) {
        std::uint8_t* const place = channel.data() + i;
        const auto paint = hn::Load(f, drawn + i);
        const auto under = [&] {
          return hn::MulAdd(light, hn::ConvertTo(f, hn::PromoteTo(integers, hn::LoadU(bytes, place))), paint);
        };
        const auto colour = to.is_opaque ? hn::Mul(paint, whole) : under();
        const auto level = hn::Min(hn::Max(colour, hn::Zero(f)), white);
        hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(integers, hn::Add(level, half))), bytes, place);
        if (to.deep.empty()) return;
        const auto rounded = hn::MulAdd(level, hn::Set(f, static_cast<float>(deep_level)), half);
        hn::StoreU(hn::DemoteTo(words, hn::ConvertTo(integers, rounded)), words, deep_channel.data() + i);
      };
      finish_channel(block.red, colours[0], deep[0]);
      finish_channel(block.green, colours[1], deep[1]);
      finish_channel(block.blue, colours[2], deep[2]);
      const auto is_bare = hn::Gt(light, bare_light);
      has_gap = has_gap || !hn::AllFalse(f, hn::Ge(light, gap_light));
      hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(integers, hn::IfThenElseZero(is_bare, white))), bytes,
                 bare.data() + i);
    }
    std::copy_n(bare.begin(), count, to.bare.begin() + first);
    for (int i = 0; i < count && !to.deep.empty(); ++i) {
      const auto place = static_cast<std::size_t>(i);
      to.deep[static_cast<std::size_t>(first) + place] = {deep[0][place], deep[1][place], deep[2][place]};
    }
    if (count == block_px) {
      interleave(colours, to.picture.data() + first);
    } else {
      std::array<Rgb8, block_px> last;
      interleave(colours, last.data());
      std::copy_n(last.begin(), count, to.picture.begin() + first);
    }
  }
  return has_gap;
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(finish);

bool finish_row(const FrontToBackAccumulator& accumulator, int row, const RowToFinish& to) {
  return HWY_DYNAMIC_DISPATCH(finish)(accumulator, row, to);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
