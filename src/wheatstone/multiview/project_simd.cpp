#include <algorithm>
#include <array>
#include <tuple>

#include "wheatstone/multiview/splat_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/multiview/project_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "wheatstone/multiview/fast_exp_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using Halves = hn::Rebind<hwy::float16_t, Floats>;
using HalfBits = hn::Rebind<std::uint16_t, Floats>;
using Vec = hn::Vec<Floats>;

/// Where a vector of particles lies in the picture.
struct Placed {
  Vec x, y, parallax;
  Vec nearness;  // times focal_px, pixels a unit of length
  hn::Mask<Floats> seen;
};

HWY_INLINE Vec dot(Vec x, Vec y, Vec z, const std::array<float, 3>& axis) {
  const Floats d;
  return hn::MulAdd(x, hn::Set(d, axis[0]), hn::MulAdd(y, hn::Set(d, axis[1]), hn::Mul(z, hn::Set(d, axis[2]))));
}

HWY_INLINE Placed place(const Cloud& cloud, std::size_t i, const Projection& projection) {
  const Floats d;
  const Camera& camera = projection.camera;
  const Vec x = hn::Sub(hn::LoadU(d, cloud.x.data() + i), hn::Set(d, camera.position[0]));
  const Vec y = hn::Sub(hn::LoadU(d, cloud.y.data() + i), hn::Set(d, camera.position[1]));
  const Vec z = hn::Sub(hn::LoadU(d, cloud.z.data() + i), hn::Set(d, camera.position[2]));
  const Vec depth = dot(x, y, z, camera.forward);

  Placed placed;
  placed.seen = hn::Gt(depth, hn::Set(d, camera.nearest_depth));
  const Vec inverse_depth = hn::Div(hn::Set(d, 1.f), hn::IfThenElse(placed.seen, depth, hn::Set(d, 1.f)));
  placed.nearness = camera.orthographic_depth > 0 ? hn::Set(d, 1 / camera.orthographic_depth) : inverse_depth;
  const Vec scale = hn::Mul(placed.nearness, hn::Set(d, camera.focal_px));
  placed.x = hn::MulAdd(dot(x, y, z, camera.right), scale, hn::Set(d, camera.centre_x_px));
  placed.y = hn::MulAdd(dot(x, y, z, camera.down), scale, hn::Set(d, camera.centre_y_px));

  // The depth mapping, tabulated over 1/depth.
  const ParallaxTable& table = projection.table;
  const Vec at = hn::Clamp(hn::Mul(hn::Sub(inverse_depth, hn::Set(d, table.first_w)), hn::Set(d, table.entries_per_w)),
                           hn::Zero(d), hn::Set(d, ParallaxTable::size - 1.f));
  const auto entry = hn::ConvertTo(Ints(), at);
  const Vec rest = hn::Sub(at, hn::ConvertTo(d, entry));
  placed.parallax =
      hn::MulAdd(rest, hn::GatherIndex(d, table.step.data(), entry), hn::GatherIndex(d, table.value.data(), entry));
  placed.x = hn::MulAdd(placed.parallax, hn::Set(d, projection.view - central_view), placed.x);
  return placed;
}

/// The sigmoid of a density, 0..1 (Hassaine 2010, sec. 4.2).
HWY_INLINE Vec sigmoid(Vec log2_density, const SplatStyle& splat_style) {
  const Floats d;
  const Vec below = hn::Sub(hn::Set(d, splat_style.log2_density_middle), log2_density);
  return hn::Div(hn::Set(d, 1.f),
                 hn::Add(hn::Set(d, 1.f), fast_exp2(d, hn::Mul(below, hn::Set(d, splat_style.slope)))));
}

struct Lit {
  Vec size, red, green, blue;
  Vec opacity;  // of the thesis's look
};

/// The radius of a particle's kernel, in the scene's units.
HWY_INLINE Vec radius_of(const Cloud& cloud, std::size_t i, Vec log2_density, const SplatStyle& splat_style) {
  const Floats d;
  if (splat_style.size_rule == SizeRule::smoothing_length && !cloud.smoothing_length.empty())
    return hn::LoadU(d, cloud.smoothing_length.data() + i);
  if (cloud.density.empty() || splat_style.look == Look::thesis) return hn::Set(d, splat_style.fixed_radius);
  return hn::Mul(hn::Set(d, splat_style.radius_factor), fast_exp2(d, hn::Mul(log2_density, hn::Set(d, -1.f / 3))));
}

/// Diameter in pixels: by the sigmoid or the particle's own length, smaller the farther away, within its limits.
HWY_INLINE Vec size_of(const Cloud& cloud, std::size_t i, Vec log2_density, Vec nearness,
                       const Projection& projection) {
  const Floats d;
  const SplatStyle& splat_style = projection.splat_style;
  const Vec smallest = hn::Set(d, splat_style.smallest_px);
  const Vec largest = hn::Set(d, splat_style.largest_px);
  const bool by_rank = splat_style.size_rule == SizeRule::denser_smaller ||
                       splat_style.size_rule == SizeRule::denser_larger ||
                       (splat_style.look == Look::thesis && cloud.smoothing_length.empty());
  if (by_rank) {
    const Vec rank = sigmoid(log2_density, splat_style);
    const Vec share = splat_style.size_rule == SizeRule::denser_larger ? rank : hn::Sub(hn::Set(d, 1.f), rank);
    const Vec wanted = hn::MulAdd(share, hn::Sub(largest, smallest), smallest);
    const Vec size = hn::Mul(wanted, hn::Mul(nearness, hn::Set(d, splat_style.size_depth)));
    return hn::Min(hn::Max(size, smallest), largest);
  }
  const bool mass = splat_style.look == Look::mass;
  const float diameters_a_radius = mass ? mass_diameters(splat_style.kernel) * deviations_a_radius : 2.f;
  const Vec diameter = hn::Mul(radius_of(cloud, i, log2_density, splat_style),
                               hn::Set(d, diameters_a_radius * projection.camera.focal_px));
  const Vec size = hn::Mul(diameter, nearness);
  return hn::Min(hn::Max(size, smallest), hn::Set(d, mass ? projection.largest_mass_px : splat_style.largest_px));
}

/// Where a particle's temperature or density lies in the palette, in entries.
HWY_INLINE Vec palette_entry(const Cloud& cloud, std::size_t i, Vec log2_density, const SplatStyle& splat_style) {
  const Floats d;
  Vec value = log2_density;
  if (splat_style.colour_source == ColourSource::temperature) {
    const Vec temperature = hn::LoadU(d, cloud.temperature.data() + i);
    value = splat_style.logarithmic ? fast_log2(d, temperature) : temperature;
  }
  return hn::Clamp(
      hn::Mul(hn::Sub(value, hn::Set(d, splat_style.palette_first)), hn::Set(d, splat_style.palette_scale)),
      hn::Zero(d), hn::Set(d, SplatStyle::palette_size - 1.f));
}

/// A splat of mass: red is its light, in mean particles a pixel of the area that the view's centre has, and green what
/// goes with each unit of it. With colours of their own, particles have three channels of light.
HWY_INLINE Lit light_of_mass(const Cloud& cloud, Vec log2_density, const Placed& placed, const Projection& projection,
                             const ProjectedBlock& block, std::size_t in_block) {
  const Floats d;
  const std::size_t i = block.first + in_block;
  const SplatStyle& splat_style = projection.splat_style;
  Lit lit;
  lit.size = size_of(cloud, i, log2_density, placed.nearness, projection);
  const Vec along = hn::Mul(placed.nearness, hn::Set(d, splat_style.size_depth));
  Vec light = hn::Mul(along, along);
  if (!cloud.mass.empty())
    light = hn::Mul(light, hn::Mul(hn::LoadU(d, cloud.mass.data() + i), hn::Set(d, 1 / splat_style.mean_mass)));
  if (!cloud.presence.empty()) light = hn::Mul(light, hn::LoadU(d, cloud.presence.data() + i));
  lit.red = light;
  lit.blue = hn::Zero(d);
  if (splat_style.colour_source == ColourSource::own) {
    lit.red = hn::Mul(light, hn::LoadU(d, block.red.data() + in_block));
    lit.green = hn::Mul(light, hn::LoadU(d, block.green.data() + in_block));
    lit.blue = hn::Mul(light, hn::LoadU(d, block.blue.data() + in_block));
  } else if (splat_style.colour_source == ColourSource::quantity) {
    lit.green = hn::Mul(hn::LoadU(d, cloud.quantity.data() + i), hn::Set(d, splat_style.quantity_scale));
  } else {
    lit.green =
        hn::Mul(palette_entry(cloud, i, log2_density, splat_style), hn::Set(d, 1 / (SplatStyle::palette_size - 1.f)));
  }
  return lit;
}

/// Size and colour of the particles from number `in_block` of the block on.
HWY_INLINE Lit light(const Cloud& cloud, const Placed& placed, const Projection& projection,
                     const ProjectedBlock& block, std::size_t in_block) {
  const Floats d;
  const std::size_t i = block.first + in_block;
  const SplatStyle& splat_style = projection.splat_style;
  const bool has_density = !cloud.density.empty();
  const Vec log2_density = has_density ? fast_log2(d, hn::LoadU(d, cloud.density.data() + i)) : hn::Zero(d);
  if (splat_style.look == Look::mass) return light_of_mass(cloud, log2_density, placed, projection, block, in_block);
  Lit lit;
  lit.size = size_of(cloud, i, log2_density, placed.nearness, projection);
  const Vec rank = sigmoid(log2_density, splat_style);

  // Energy is kept where the pixel's own width flattens a small splat.
  const Vec variance =
      hn::Mul(hn::Mul(lit.size, lit.size), hn::Set(d, 1 / (diameters_a_deviation * diameters_a_deviation)));
  const Vec flattened = hn::Div(variance, hn::Add(variance, hn::Set(d, pixel_variance)));
  Vec opacity = hn::Mul(hn::MulAdd(rank, hn::Set(d, splat_style.opacity - splat_style.least_opacity),
                                   hn::Set(d, splat_style.least_opacity)),
                        flattened);
  if (!cloud.presence.empty()) opacity = hn::Mul(opacity, hn::LoadU(d, cloud.presence.data() + i));
  lit.opacity = opacity;
  // The colour of what absorbs is kept apart from how much of it there is.
  const Vec share = splat_style.blend == Blend::over ? hn::Set(d, 1.f) : opacity;
  if (splat_style.colour_source == ColourSource::own) {
    lit.red = hn::Mul(share, hn::LoadU(d, block.red.data() + in_block));
    lit.green = hn::Mul(share, hn::LoadU(d, block.green.data() + in_block));
    lit.blue = hn::Mul(share, hn::LoadU(d, block.blue.data() + in_block));
    return lit;
  }
  const auto entry = hn::NearestInt(palette_entry(cloud, i, log2_density, splat_style));
  lit.red = hn::Mul(share, hn::GatherIndex(d, splat_style.red.data(), entry));
  lit.green = hn::Mul(share, hn::GatherIndex(d, splat_style.green.data(), entry));
  lit.blue = hn::Mul(share, hn::GatherIndex(d, splat_style.blue.data(), entry));
  return lit;
}

/// The inverse of unpacked_light.
HWY_INLINE hn::Vec<hn::RebindToUnsigned<Floats>> packed_light(const Lit& lit) {
  const Floats d;
  const hn::RebindToUnsigned<Floats> du;
  const auto root = [&](Vec light, float most) {
    const Vec within = hn::Min(hn::Max(light, hn::Zero(d)), hn::Set(d, 1.f));
    return hn::BitCast(du, hn::NearestInt(hn::Mul(hn::Sqrt(within), hn::Set(d, most))));
  };
  const auto green = hn::ShiftLeft<11>(root(lit.green, 2047));
  return hn::Or(root(lit.red, 2047), hn::Or(green, hn::ShiftLeft<22>(root(lit.blue, 1023))));
}

/// Two half floats in 32 bits, the first in the lower ones.
HWY_INLINE hn::Vec<hn::RebindToUnsigned<Floats>> packed_halves(Vec first, Vec second) {
  const hn::RebindToUnsigned<Floats> du;
  const auto bits_of = [&](Vec values) {
    return hn::PromoteTo(du, hn::BitCast(HalfBits(), hn::DemoteTo(Halves(), values)));
  };
  return hn::Or(bits_of(first), hn::ShiftLeft<16>(bits_of(second)));
}

/// The bins of a vector of splats: in the first and in the last band that each reaches into.
struct Bins {
  hn::Vec<hn::RebindToUnsigned<Floats>> first, last;
};

/// What a table has for each of the pictures.
HWY_INLINE Vec of_pictures(const PictureTable::Numbers& numbers, hn::Vec<Ints> pictures) {
  const Floats d;
  if constexpr (hn::MaxLanes(Floats()) == std::tuple_size_v<PictureTable::Numbers>)
    return hn::TableLookupLanes(hn::LoadU(d, numbers.data()), hn::IndicesFromVec(d, pictures));
  return hn::GatherIndex(d, numbers.data(), pictures);
}

/// Moves splats that are too wide for the view's picture to the smaller one that fits, and dims them as their pixels
/// are larger: light is what lies above an area. Returns the pictures' numbers.
HWY_INLINE hn::Vec<Ints> choose_picture(const PictureTable& table, Placed& placed, Lit& lit,
                                        const SplatStyle& splat_style) {
  const Floats d;
  const bool all_channels = splat_style.colour_source == ColourSource::own;
  Vec picture = hn::Zero(d);
  for (int i = 0; i + 1 < table.pictures; ++i)
    picture = hn::Add(picture, hn::IfThenElseZero(hn::Gt(lit.size, hn::Set(d, table.widest[i])), hn::Set(d, 1.f)));
  const auto number = hn::ConvertTo(Ints(), picture);
  if (hn::AllTrue(d, hn::Eq(picture, hn::Zero(d)))) return number;
  const Vec scale = of_pictures(table.scale, number);
  const Vec pad = of_pictures(table.pad, number);
  placed.x = hn::MulAdd(placed.x, scale, pad);
  placed.y = hn::MulAdd(placed.y, scale, pad);
  placed.parallax = hn::Mul(placed.parallax, scale);
  const Vec area = hn::Mul(scale, scale);
  lit.red = hn::Mul(lit.red, area);
  if (all_channels) {
    lit.green = hn::Mul(lit.green, area);
    lit.blue = hn::Mul(lit.blue, area);
  }
  // Enlarging the picture spreads what is in it: by the variance of a line from pixel to pixel.
  const float spread = 0.2f * mass_diameters(splat_style.kernel) * mass_diameters(splat_style.kernel);
  const Vec smaller = hn::Sqrt(hn::Sub(hn::Mul(hn::Mul(lit.size, lit.size), area), hn::Set(d, spread)));
  lit.size = hn::IfThenElse(hn::Gt(picture, hn::Zero(d)), smaller, lit.size);
  return number;
}

/// The bins of splats in their pictures. Splats that are not seen go to the bin behind the last.
HWY_INLINE Bins bins_of(const Placed& placed, Vec size, hn::Vec<Ints> picture, const Window& window,
                        const PictureTable& table) {
  const Floats d;
  const Ints di;
  const auto of_picture = [&](const PictureTable::Numbers& numbers) {
    return table.pictures == 1 ? hn::Set(d, numbers[0]) : of_pictures(numbers, picture);
  };
  const Vec scale = of_picture(table.scale);
  // Smaller pictures are looked at two pixels beyond the view.
  const Vec beyond = hn::Mul(of_picture(table.pad), hn::Set(d, 2.f));
  const Vec reach = hn::MulAdd(size, hn::Set(d, 0.5f), hn::Set(d, 0.5f));
  const Vec half = hn::Set(d, 0.5f);
  const Vec top = hn::Ceil(hn::Sub(hn::Sub(placed.y, reach), half));
  const Vec bottom = hn::Floor(hn::Sub(hn::Add(placed.y, reach), half));
  auto seen = hn::And(placed.seen,
                      hn::And(hn::Gt(hn::Add(placed.x, reach), hn::Mul(hn::Set(d, window.left), scale)),
                              hn::Lt(hn::Sub(placed.x, reach), hn::MulAdd(hn::Set(d, window.right), scale, beyond))));
  const Vec last_row = of_picture(table.last_row);
  seen = hn::And(seen, hn::And(hn::Ge(bottom, hn::Zero(d)), hn::Le(top, last_row)));

  const SplatOrder& order = table.first;
  const Vec a_row = hn::Set(d, 1.f / static_cast<float>(order.band_rows));
  const Vec band = hn::Floor(hn::Mul(hn::Max(top, hn::Zero(d)), a_row));
  const Vec next_band = hn::Floor(hn::Mul(hn::Min(bottom, last_row), a_row));
  const Vec along = order.within == SplatOrder::Within::columns ? placed.x : placed.parallax;
  const Vec parts = of_picture(table.parts);
  const Vec from_first = hn::Sub(along, hn::Mul(hn::Set(d, order.first), scale));
  const Vec part_at =
      hn::Clamp(hn::Mul(from_first, of_picture(table.parts_a_pixel)), hn::Zero(d), hn::Sub(parts, hn::Set(d, 1.f)));
  const Vec part = order.within == SplatOrder::Within::nearer_plane ? hn::Floor(part_at) : hn::Round(part_at);
  const auto first_bin = hn::Add(of_picture(table.first_bin), part);
  const Vec unseen = hn::Set(d, static_cast<float>(table.bins));
  const hn::RebindToUnsigned<Floats> du;
  const auto as_bin = [&](Vec of_band) {
    const Vec index = hn::IfThenElse(seen, hn::MulAdd(of_band, parts, first_bin), unseen);
    return hn::BitCast(du, hn::ConvertTo(di, index));
  };
  return {as_bin(band), as_bin(next_band)};
}

void project(const Cloud& cloud, const Projection& projection, const Window& window, const PictureTable& table,
             ProjectedBlock& block) {
  const Floats d;
  const hn::RebindToUnsigned<Floats> du;
  const std::size_t lanes = hn::Lanes(d);
  const Deposit deposit = channels_of(deposit_of(projection.splat_style));
  for (std::size_t i = 0; i < block.count; i += lanes) {
    // The last vector starts earlier where the block does not fill it: the same particles again, the same splats.
    const std::size_t at = std::min(i, block.count - lanes);
    Placed placed = place(cloud, block.first + at, projection);
    Lit lit = light(cloud, placed, projection, block, at);
    const auto picture = choose_picture(table, placed, lit, projection.splat_style);
    const Bins bins = bins_of(placed, lit.size, picture, window, table);
    hn::StoreU(bins.first, du, block.bin.data() + at);
    hn::StoreU(bins.last, du, block.next_bin.data() + at);
    hn::StoreU(placed.x, d, block.x.data() + at);
    hn::StoreU(placed.y, d, block.y.data() + at);
    hn::StoreU(placed.parallax, d, block.parallax.data() + at);
    auto colour = packed_halves(lit.red, lit.green);
    Vec third = lit.blue;
    if (deposit == Deposit::mass || deposit == Deposit::absorbing) {
      colour = deposit == Deposit::mass ? hn::BitCast(du, lit.red) : packed_light(lit);
      third = deposit == Deposit::mass ? lit.green : lit.opacity;
    }
    hn::StoreU(colour, du, block.colour.data() + at);
    hn::StoreU(packed_halves(third, lit.size), du, block.colour_and_size.data() + at);
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(project);

void project_particles(const Cloud& cloud, const Projection& projection, const Window& window,
                       const PictureTable& table, ProjectedBlock& block) {
  HWY_DYNAMIC_DISPATCH(project)(cloud, projection, window, table, block);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
