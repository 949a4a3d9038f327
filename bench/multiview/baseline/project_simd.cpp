#include <algorithm>
#include <cstring>

#include "multiview/baseline/splat.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "multiview/baseline/project_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "multiview/baseline/fast_exp.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::baseline::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using Halves = hn::Rebind<hwy::float16_t, Floats>;
using HalfBits = hn::Rebind<std::uint16_t, Floats>;
using Vec = hn::Vec<Floats>;
constexpr std::size_t most_lanes = 16;

/// Where a vector of particles lies in the picture.
struct Placed {
  Vec x, y, parallax, inverse_depth;
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
  placed.inverse_depth = hn::Div(hn::Set(d, 1.f), hn::IfThenElse(placed.seen, depth, hn::Set(d, 1.f)));
  const Vec scale = hn::Mul(placed.inverse_depth, hn::Set(d, camera.focal_px));
  placed.x = hn::MulAdd(dot(x, y, z, camera.right), scale, hn::Set(d, camera.centre_x_px));
  placed.y = hn::MulAdd(dot(x, y, z, camera.down), scale, hn::Set(d, camera.centre_y_px));

  // The depth mapping, tabulated over 1/depth.
  const ParallaxTable& table = projection.table;
  const Vec at =
      hn::Clamp(hn::Mul(hn::Sub(placed.inverse_depth, hn::Set(d, table.first_w)), hn::Set(d, table.entries_per_w)),
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
};

/// Diameter in pixels: by the sigmoid or the particle's own length, smaller the farther away, within its limits.
HWY_INLINE Vec size_of(const Cloud& cloud, std::size_t i, Vec rank, Vec inverse_depth, const Projection& projection) {
  const Floats d;
  const SplatStyle& splat_style = projection.splat_style;
  const Vec smallest = hn::Set(d, splat_style.smallest_px);
  const Vec largest = hn::Set(d, splat_style.largest_px);
  Vec size;
  if (splat_style.size_rule == SizeRule::smoothing_length && !cloud.smoothing_length.empty()) {
    const Vec diameter =
        hn::Mul(hn::LoadU(d, cloud.smoothing_length.data() + i), hn::Set(d, 2 * projection.camera.focal_px));
    size = hn::Mul(diameter, inverse_depth);
  } else {
    const Vec share = splat_style.size_rule == SizeRule::denser_larger ? rank : hn::Sub(hn::Set(d, 1.f), rank);
    const Vec wanted = hn::MulAdd(share, hn::Sub(largest, smallest), smallest);
    size = hn::Mul(wanted, hn::Mul(inverse_depth, hn::Set(d, splat_style.size_depth)));
  }
  return hn::Min(hn::Max(size, smallest), largest);
}

/// Size and colour of the particles from number `in_block` of the block on.
HWY_INLINE Lit light(const Cloud& cloud, const Placed& placed, const Projection& projection,
                     const ProjectedBlock& block, std::size_t in_block) {
  const Floats d;
  const std::size_t i = block.first + in_block;
  const SplatStyle& splat_style = projection.splat_style;
  const bool has_density = !cloud.density.empty();
  const Vec log2_density = has_density ? fast_log2(d, hn::LoadU(d, cloud.density.data() + i)) : hn::Zero(d);
  const Vec rank = sigmoid(log2_density, splat_style);
  Lit lit;
  lit.size = size_of(cloud, i, rank, placed.inverse_depth, projection);

  // Energy is kept where the pixel's own width flattens a small splat.
  const Vec variance =
      hn::Mul(hn::Mul(lit.size, lit.size), hn::Set(d, 1 / (diameters_a_deviation * diameters_a_deviation)));
  const Vec flattened = hn::Div(variance, hn::Add(variance, hn::Set(d, pixel_variance)));
  const Vec opacity = hn::Mul(hn::MulAdd(rank, hn::Set(d, splat_style.opacity - splat_style.least_opacity),
                                         hn::Set(d, splat_style.least_opacity)),
                              flattened);
  if (splat_style.colour_source == ColourSource::own) {
    lit.red = hn::Mul(opacity, hn::LoadU(d, block.red.data() + in_block));
    lit.green = hn::Mul(opacity, hn::LoadU(d, block.green.data() + in_block));
    lit.blue = hn::Mul(opacity, hn::LoadU(d, block.blue.data() + in_block));
    return lit;
  }
  Vec value = log2_density;
  if (splat_style.colour_source == ColourSource::temperature) {
    const Vec temperature = hn::LoadU(d, cloud.temperature.data() + i);
    value = splat_style.logarithmic ? fast_log2(d, temperature) : temperature;
  }
  const Vec at =
      hn::Clamp(hn::Mul(hn::Sub(value, hn::Set(d, splat_style.palette_first)), hn::Set(d, splat_style.palette_scale)),
                hn::Zero(d), hn::Set(d, SplatStyle::palette_size - 1.f));
  const auto entry = hn::NearestInt(at);
  lit.red = hn::Mul(opacity, hn::GatherIndex(d, splat_style.red.data(), entry));
  lit.green = hn::Mul(opacity, hn::GatherIndex(d, splat_style.green.data(), entry));
  lit.blue = hn::Mul(opacity, hn::GatherIndex(d, splat_style.blue.data(), entry));
  return lit;
}

HWY_INLINE void store_halves(Vec values, std::uint16_t* to) {
  const HalfBits bits;
  hn::StoreU(hn::BitCast(bits, hn::DemoteTo(Halves(), values)), bits, to);
}

/// The bins of a vector of splats: in the first and in the last band that each reaches into.
struct Bins {
  hn::Vec<hn::RebindToUnsigned<Floats>> first, last;
};

/// What is not seen goes to the bin behind the last.
HWY_INLINE Bins bins_of(const Placed& placed, Vec size, const Window& window, const SplatOrder& order) {
  const Floats d;
  const Ints di;
  const Vec reach = hn::MulAdd(size, hn::Set(d, 0.5f), hn::Set(d, 0.5f));
  const Vec half = hn::Set(d, 0.5f);
  const Vec top = hn::Ceil(hn::Sub(hn::Sub(placed.y, reach), half));
  const Vec bottom = hn::Floor(hn::Sub(hn::Add(placed.y, reach), half));
  auto seen = hn::And(placed.seen, hn::And(hn::Gt(hn::Add(placed.x, reach), hn::Set(d, window.left)),
                                           hn::Lt(hn::Sub(placed.x, reach), hn::Set(d, window.right))));
  const Vec last_row = hn::Set(d, static_cast<float>(window.height - 1));
  seen = hn::And(seen, hn::And(hn::Ge(bottom, hn::Zero(d)), hn::Le(top, last_row)));

  const Vec a_row = hn::Set(d, 1.f / static_cast<float>(order.band_rows));
  const Vec band = hn::Floor(hn::Mul(hn::Max(top, hn::Zero(d)), a_row));
  const Vec next_band = hn::Floor(hn::Mul(hn::Min(bottom, last_row), a_row));
  const Vec along = order.within == SplatOrder::Within::columns ? placed.x : placed.parallax;
  const Vec part_at = hn::Clamp(hn::Mul(hn::Sub(along, hn::Set(d, order.first)), hn::Set(d, 1 / order.spacing)),
                                hn::Zero(d), hn::Set(d, static_cast<float>(order.parts - 1)));
  const Vec part = order.within == SplatOrder::Within::nearer_plane ? hn::Floor(part_at) : hn::Round(part_at);
  const Vec parts = hn::Set(d, static_cast<float>(order.parts));
  const Vec unseen = hn::Set(d, static_cast<float>(order.bins()));
  const hn::RebindToUnsigned<Floats> du;
  const auto as_bin = [&](Vec of_band) {
    const Vec index = hn::IfThenElse(seen, hn::MulAdd(of_band, parts, part), unseen);
    return hn::BitCast(du, hn::ConvertTo(di, index));
  };
  return {as_bin(band), as_bin(next_band)};
}

void project(const Cloud& cloud, const Projection& projection, const Window& window, const SplatOrder& order,
             ProjectedBlock& block) {
  const Floats d;
  const hn::RebindToUnsigned<Floats> du;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN float x[most_lanes], y[most_lanes], parallax[most_lanes];
  HWY_ALIGN std::uint16_t size[most_lanes], red[most_lanes], green[most_lanes], blue[most_lanes];
  for (std::size_t i = 0; i < block.count; i += lanes) {
    // The last vector starts earlier where the block does not fill it: the same particles again, the same splats.
    const std::size_t at = std::min(i, block.count - lanes);
    const Placed placed = place(cloud, block.first + at, projection);
    const Lit lit = light(cloud, placed, projection, block, at);
    const Bins bins = bins_of(placed, lit.size, window, order);
    hn::StoreU(bins.first, du, block.bin.data() + at);
    hn::StoreU(bins.last, du, block.next_bin.data() + at);
    hn::StoreU(placed.x, d, x);
    hn::StoreU(placed.y, d, y);
    hn::StoreU(placed.parallax, d, parallax);
    store_halves(lit.size, size);
    store_halves(lit.red, red);
    store_halves(lit.green, green);
    store_halves(lit.blue, blue);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      block.splats[at + lane] = {x[lane], y[lane], parallax[lane], {red[lane], green[lane], blue[lane]}, size[lane]};
  }
}

}  // namespace wheatstone::baseline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone::baseline {

HWY_EXPORT(project);

void project_particles(const Cloud& cloud, const Projection& projection, const Window& window, const SplatOrder& order,
                       ProjectedBlock& block) {
  HWY_DYNAMIC_DISPATCH(project)(cloud, projection, window, order, block);
}

}  // namespace wheatstone::baseline
#endif  // HWY_ONCE
