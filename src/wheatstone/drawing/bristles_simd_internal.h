// The paint that bristles leave within a stroke, computed with vectors. Included by files that are compiled for several
// processors.

#if defined(WHEATSTONE_DRAWING_BRISTLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef WHEATSTONE_DRAWING_BRISTLES_INL_H_
#undef WHEATSTONE_DRAWING_BRISTLES_INL_H_
#else
#define WHEATSTONE_DRAWING_BRISTLES_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "wheatstone/drawing/rasterise_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The paint of one stroke from place to place. bristles.glsl and page/bristles.ts hold the same formulas.
class Bristles {
 public:
  using Floats = hn::CappedTag<float, Canvas::widest_vector>;
  using V = hn::Vec<Floats>;

  Bristles(const FlatStroke& stroke, const Brush& brush)
      : profile_(stroke.radius_px),
        has_bristles_(brush.varies()),
        is_long_(stroke.length > 2 * stroke.radius_px),
        seed_(stroke.seed),
        radius_(stroke.radius_px),
        length_(std::max(stroke.length, 1e-3f)),
        width_(streak_width_px(brush.bristle_px, stroke.radius_px)),
        dry_(is_long_ ? brush.dry : 0),
        picture_(is_long_ && !brush.picture.empty() ? brush.picture.levels.data() : nullptr) {
    // Streaks that are too fine for the pixels of a view are filtered, so that they do not sparkle.
    shown_ = std::clamp((width_ - 0.6f) / 0.9f, 0.f, 1.f);
    streaks_ = shown_ * brush.streaks;
    ridge_ = shown_ * brush.ridge;
    ragged_ = shown_ * 0.12f;
    if (picture_ == nullptr) return;
    level_ = BrushPicture::sizes[static_cast<std::size_t>(brush_level(radius_))];
    // On a thin stroke, the brush's picture would leave holes as small as a pixel.
    pictured_ = std::clamp((radius_ - 1) / 2, 0.f, 1.f);
    pictured_tone_ = pictured_ * brush.streaks;
  }

  /// The places of pixels on a stroke: their distance to the curve, and the values that DistanceBand keeps.
  struct Place {
    V distance, along, across, facing;
  };
  struct Paint {
    V cover;  ///< of the brush; it continues below 0 and above 1
    V share;  ///< of the colour's change, 0..1
    V tone;   ///< levels to be added to the colour
  };

  HWY_INLINE Paint at(const Place& place) const {
    const Floats f;
    const auto zero = hn::Zero(f), one = hn::Set(f, 1.f);
    const auto share = hn::Min(hn::Max(hn::Mul(place.along, hn::Set(f, 1 / length_)), zero), one);
    const auto rim = hn::Set(f, 1 / profile_.rim_px), half = hn::Set(f, 0.5f);
    if (!has_bristles_)
      return {hn::MulAdd(hn::Sub(hn::Set(f, profile_.middle_px), place.distance), rim, half), share, zero};

    const auto lane = hn::Mul(place.across, hn::Set(f, 1 / width_));
    // The rim is ragged: each side of the stroke has its own.
    const auto side = hn::IfThenElse(hn::Gt(place.across, zero), hn::Set(f, 40.f), zero);
    const auto rim_noise = noise(1, hn::MulAdd(place.along, hn::Set(f, 1 / (1.2f * radius_)), side));
    const auto inside =
        hn::Sub(hn::NegMulAdd(hn::Set(f, ragged_ * profile_.middle_px), rim_noise, hn::Set(f, profile_.middle_px)),
                place.distance);
    auto cover = hn::MulAdd(inside, rim, half);
    // Distance beyond the ends of the curve.
    const auto beyond =
        hn::Sqrt(hn::Max(hn::NegMulAdd(place.across, place.across, hn::Mul(place.distance, place.distance)), zero));
    if (dry_ > 0) {
      // Each bristle has paint for its own length.
      const auto run = hn::NegMulAdd(hn::Set(f, dry_ * length_), noise(2, lane), hn::Set(f, length_));
      cover = hn::Min(cover, hn::NegMulAdd(hn::Sub(place.along, run), hn::Set(f, 1 / (1.5f * width_)), one));
      // A stroke ends as flat as its brush, and each bristle at its own place.
      const auto end = hn::IfThenElse(hn::Gt(share, half), hn::Set(f, 60.f), zero);
      const auto reach = hn::MulAdd(hn::Set(f, -0.5f * shown_ * radius_), noise(5, hn::Add(lane, end)),
                                    hn::Set(f, (1 - 0.3f * shown_) * radius_));
      cover = hn::Min(cover, hn::NegMulAdd(hn::Sub(beyond, reach), hn::Set(f, 1 / width_), one));
    }
    // Streaks along the stroke: fine ones that go through, and broader ones that come and go.
    const auto fine = hn::Sub(noise(3, lane), half);
    const auto broad = hn::Sub(
        noise(4, hn::MulAdd(lane, hn::Set(f, 1 / 2.3f), hn::Mul(place.along, hn::Set(f, 1 / (3 * radius_))))), half);
    auto tone = hn::Mul(hn::Set(f, streaks_), hn::MulAdd(fine, hn::Set(f, 0.8f), hn::Mul(broad, hn::Set(f, 0.6f))));
    // Paint stands up at the rim of both sides.
    const auto beside = hn::Max(hn::NegMulAdd(beyond, hn::Set(f, 2 / radius_), one), zero);
    const auto to_rim = hn::Max(hn::NegMulAdd(inside, hn::Set(f, 1 / (1.2f * width_)), one), zero);
    const auto facing = hn::Mul(place.facing, hn::CopySign(one, place.across));
    tone = hn::MulAdd(hn::Mul(hn::Mul(hn::Set(f, ridge_), beside), hn::Min(to_rim, one)), facing, tone);
    return pictured({cover, share, tone}, place);
  }

 private:
  /// Applies the brush's picture: where the picture is dark, the paint covers less and is darker.
  HWY_INLINE Paint pictured(const Paint& paint, const Place& place) const {
    if (picture_ == nullptr) return paint;
    const Floats f;
    const hn::RebindToSigned<Floats> integers;
    const auto one = hn::Set(f, 1.f);
    // Finds the two pixels of a line around a place from 0 to 1: the first of them, and the distance of the place from
    // it.
    const auto between = [&](V share, int count, V& part) {
      const auto most = hn::Set(f, static_cast<float>(count - 1));
      const auto at = hn::Min(
          hn::Max(hn::MulSub(share, hn::Set(f, static_cast<float>(count)), hn::Set(f, 0.5f)), hn::Zero(f)), most);
      const auto first = hn::Min(hn::Floor(at), hn::Sub(most, one));
      part = hn::Sub(at, first);
      return hn::ConvertTo(integers, first);
    };
    const float whole = length_ + 2 * radius_, side = (seed_ & 1) != 0 ? -0.5f : 0.5f;
    V part_x, part_y;
    const auto column =
        between(hn::Mul(hn::Add(place.along, hn::Set(f, radius_)), hn::Set(f, 1 / whole)), level_.columns, part_x);
    const auto row =
        between(hn::MulAdd(place.across, hn::Set(f, side / radius_), hn::Set(f, 0.5f)), level_.rows, part_y);
    const auto* pixels = reinterpret_cast<const std::int32_t*>(picture_ + level_.first);
    const auto at = hn::Add(hn::Mul(row, hn::Set(integers, level_.columns)), column);
    const auto of_row = [&](auto from) {
      const auto bytes = hn::GatherOffset(integers, pixels, from);
      const auto level = [&](auto byte) { return hn::ConvertTo(f, hn::And(byte, hn::Set(integers, 255))); };
      const auto left = level(bytes), right = level(hn::ShiftRight<8>(bytes));
      return hn::MulAdd(part_x, hn::Sub(right, left), left);
    };
    const auto above = of_row(at), below = of_row(hn::Add(at, hn::Set(integers, level_.columns)));
    const auto left_bare = hn::NegMulAdd(hn::MulAdd(part_y, hn::Sub(below, above), above), hn::Set(f, 1.f / 255), one);
    const auto tone = hn::MulAdd(hn::Set(f, pictured_tone_), hn::Sub(hn::Set(f, 0.25f), left_bare), paint.tone);
    if (dry_ == 0) return {paint.cover, paint.share, tone};
    const auto shown = hn::NegMulAdd(hn::Set(f, pictured_), left_bare, one);
    return {hn::Min(paint.cover, hn::Mul(hn::Min(hn::Max(paint.cover, hn::Zero(f)), one), shown)), paint.share, tone};
  }

  /// Smooth noise 0..1 between lattice points a unit apart; `which` tells several apart.
  HWY_INLINE V noise(std::uint32_t which, V place) const {
    const Floats f;
    const hn::RebindToSigned<Floats> integers;
    const auto cell = hn::Floor(place), part = hn::Sub(place, cell);
    const auto weight = hn::Mul(hn::Mul(part, part), hn::NegMulAdd(hn::Set(f, 2.f), part, hn::Set(f, 3.f)));
    const auto at = hn::ConvertTo(integers, cell);
    const auto first = lattice(which, at), second = lattice(which, hn::Add(at, hn::Set(integers, 1)));
    return hn::MulAdd(weight, hn::Sub(second, first), first);
  }

  /// A hash of a lattice point, 0..1.
  HWY_INLINE V lattice(std::uint32_t which, hn::Vec<hn::RebindToSigned<Floats>> point) const {
    const hn::RebindToUnsigned<Floats> words;
    const hn::RebindToSigned<Floats> integers;
    auto h = hn::Add(hn::Mul(hn::BitCast(words, point), hn::Set(words, 0x9e3779b9u)),
                     hn::Set(words, seed_ + which * 0x85ebca6bu));
    h = hn::Mul(hn::Xor(h, hn::ShiftRight<16>(h)), hn::Set(words, 0x7feb352du));
    h = hn::Mul(hn::Xor(h, hn::ShiftRight<15>(h)), hn::Set(words, 0x846ca68bu));
    h = hn::ShiftRight<8>(hn::Xor(h, hn::ShiftRight<16>(h)));
    return hn::Mul(hn::ConvertTo(Floats(), hn::BitCast(integers, h)), hn::Set(Floats(), 0x1p-24f));
  }

  BrushProfile profile_;
  bool has_bristles_, is_long_;
  std::uint32_t seed_;
  float radius_, length_, width_, dry_;
  const std::uint8_t* picture_;  ///< null: none
  BrushPicture::Level level_{};
  float pictured_ = 0, pictured_tone_ = 0, shown_ = 0, streaks_ = 0, ridge_ = 0, ragged_ = 0;
};

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard of each processor
