#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/multiview/scene.h"

namespace wheatstone {

/// A particle as the reference view has it. Twenty bytes, since reading and writing them is half the work. What it adds
/// to a pixel is either three channels of light, or mass: the splat's light in full precision, so that no mass is lost,
/// and how much of a second channel goes with each unit of it. Or it absorbs as
/// it shines: its colour is packed (packed_light), and the third number is its optical depth.
struct Splat {
  float x, y;               ///< centre, in pixels
  float parallax;           ///< in pixels, at full eye separation
  std::uint16_t colour[3];  ///< half floats; of mass, a float's lower and upper half, and a half float
  std::uint16_t size;       ///< diameter in pixels, a half float
};
static_assert(sizeof(Splat) == 20);

/// What splats add to the channels of a pixel.
enum class Deposit : std::uint8_t {
  light,    ///< of the thesis's look: a Gaussian with the colour at its middle
  mass,     ///< light, and light times the second number, whose sums over all pixels are those of the splats
  colours,  ///< three channels of light, whose sums are those of the splats
  mass_by_spline,
  colours_by_spline,  ///< by the cubic spline kernel, not the Gaussian
  absorbing,          ///< as light, and in the fourth channel the optical depth, by which the three are multiplied
};
/// Whether splats of the Gaussian kernel are spread over areas of pixels, so that their sums are kept; others have a
/// Gaussian's value at the middle of a pixel. Of a deposit with another kernel, ask it of its `channels_of`.
constexpr bool keeps_sums(Deposit deposit) { return deposit == Deposit::mass || deposit == Deposit::colours; }
/// What particles of an appearance add.
inline Deposit deposit_of(const SplatStyle& splat_style) {
  if (splat_style.look == Look::thesis) return splat_style.blend == Blend::over ? Deposit::absorbing : Deposit::light;
  const bool gaussian = splat_style.kernel == Kernel::gaussian;
  if (splat_style.colour_source == ColourSource::own) return gaussian ? Deposit::colours : Deposit::colours_by_spline;
  return gaussian ? Deposit::mass : Deposit::mass_by_spline;
}
/// The same deposit with the Gaussian kernel.
constexpr Deposit channels_of(Deposit deposit) {
  if (deposit == Deposit::mass_by_spline) return Deposit::mass;
  return deposit == Deposit::colours_by_spline ? Deposit::colours : deposit;
}

/// Channels of a pixel that splats add to. Mass has two: light, and light times the second number. All others have
/// four, the last of which may stay 0.
constexpr int channels_in(Deposit deposit) { return channels_of(deposit) == Deposit::mass ? 2 : 4; }

/// What a splat adds to a pixel, as splat_weights.glsl tells kernels apart.
struct GpuKernel {
  enum Spread : std::int32_t { light = 0, mass = 1, spline = 2, disc = 3 };
  Spread spread = light;
  bool counts_rest() const { return spread == mass || spread == spline; }  ///< also counts fractions of a step
  std::size_t entries_at_once() const { return spread == disc ? 1 : 4; }   ///< entries per iteration of gathering
};

constexpr GpuKernel::Spread spread_of(Deposit deposit, bool opaque) {
  if (opaque) return GpuKernel::disc;
  if (channels_of(deposit) != deposit) return GpuKernel::spline;
  return keeps_sums(deposit) ? GpuKernel::mass : GpuKernel::light;
}

/// Linear light 0..1 that is packed in 32 bits: the square roots of red and green in eleven bits each, and of blue in
/// ten.
inline std::array<float, 3> unpacked_light(std::uint32_t bits) {
  const auto square = [](std::uint32_t root, float most) {
    return static_cast<float>(root * root) * (1 / (most * most));
  };
  return {square(bits & 2047, 2047), square(bits >> 11 & 2047, 2047), square(bits >> 22, 1023)};
}

/// A Gaussian's standard deviation is its splat's diameter over this: at the rim 4 % of the peak are left.
constexpr float diameters_a_deviation = 5;
/// The same of a splat of mass: of a Gaussian 2 % of the peak are left at the rim, and what would lie beyond is within.
constexpr float diameters_a_mass_deviation = 5.5f;
/// The standard deviation of the cubic spline kernel along an axis, of the radius where it ends: √0.3 / 2.
constexpr float deviations_a_radius = 0.27386f;
/// Diameters of a splat of mass over its standard deviation along an axis.
constexpr float mass_diameters(Kernel kernel) {
  return kernel == Kernel::gaussian ? diameters_a_mass_deviation : 2 / deviations_a_radius;
}
/// Variance that the area of a pixel adds to a splat's (a box one pixel wide).
constexpr float pixel_variance = 1.f / 12;
/// Half the width of what a splat touches: its radius, and half of a pixel's width around it.
constexpr float reach_of(float size) { return size / 2 + 0.5f; }

/// The part of the picture that is drawn: rows from 0 to `height`, columns from `left` to `right`.
struct Window {
  float left = 0, right = 0;
  int height = 0;
};

/// How splats are put in order: by band of scan lines, and within a band by depth plane, or by column of the picture,
/// so that what is drawn one after the other lies close together.
struct SplatOrder {
  enum class Within { columns, nearest_plane, nearer_plane };
  int band_rows = 16;
  int bands = 0;
  Within within = Within::columns;
  int parts = 1;       ///< of a band: columns or planes
  float first = 0;     ///< x of column 0's left side; parallax of plane 0
  float spacing = 64;  ///< from one to the next, in pixels
  // Splats that are too wide are drawn in smaller pictures, each half as large as the one before. Columns and rows of a
  // smaller picture begin `pad` before the view's.
  float scale = 1;  ///< pixels of this picture a pixel of the view
  int pad = 0;
  int rows = 0;               ///< of this picture
  std::size_t first_bin = 0;  ///< of all pictures' bins
  // Each band belongs to one of the ranks: the bands of all pictures are dealt out in turn.
  int first_band = 0;  ///< of all pictures' bands
  int rank = 0, ranks = 1;
  int owner(int band) const { return (first_band + band) % ranks; }
  bool is_mine(int band) const { return owner(band) == rank; }
  std::size_t bins() const { return static_cast<std::size_t>(bands) * parts; }
  std::size_t bin(int band, int part) const { return first_bin + static_cast<std::size_t>(band) * parts + part; }
};
/// The view's picture, and smaller ones for wider splats.
using SplatOrders = std::vector<SplatOrder>;

/// Some thousand splats in order of bins: bin b holds splats[begin[b]] … splats[begin[b + 1] − 1]. A splat that reaches
/// into two bands is stored in both.
struct SplatBlock {
  std::vector<Splat> splats;
  std::vector<std::uint32_t> begin;
  std::span<const Splat> bin(std::size_t b) const {
    return std::span(splats).subspan(begin[b], begin[b + 1] - begin[b]);
  }
};

/// Parallaxes by w = 1/depth, evenly spaced: one look-up a particle, whatever the mapping.
struct ParallaxTable {
  static constexpr int size = 1024;
  float first_w = 0, entries_per_w = 0;
  std::vector<float> value, step;  ///< parallax at the entry, and from it to the next
};

/// The data that the projection needs, made once a picture.
struct Projection {
  Camera camera;
  SplatStyle splat_style;
  ParallaxTable table;
  ViewPosition view = central_view;  ///< that is projected
  float largest_mass_px = 30;        ///< diameter of a splat of mass, which the smallest picture can hold
};

Projection make_projection(const Scene& scene, const CloudStatistics& statistics, ViewPosition view = central_view);

/// Some of a cloud's particles, one after the other.
struct ParticleRange {
  std::size_t first, count;
};

/// The pictures' numbers as the projection looks them up.
struct PictureTable {
  static constexpr int most = 9;
  explicit PictureTable(const SplatOrders& orders);
  int pictures = 0;
  std::size_t bins = 0;
  SplatOrder first;
  /// A number for each picture, as long as the widest vector, so that it can be one.
  using Numbers = std::array<float, 16>;
  Numbers widest{};  ///< diameter, in the view's pixels, of a splat in each picture
  Numbers scale{}, pad{}, last_row{}, parts{}, first_bin{}, parts_a_pixel{};
};
/// The diameter of a splat of mass in any picture but the smallest.
constexpr float widest_mass_px = 16;

/// Arrays that the projection fills for one block of particles, from number `first` of the cloud on; all `count` long.
struct ProjectedBlock {
  std::size_t first = 0, count = 0;
  std::vector<float> x, y, parallax;
  /// The splats' last eight bytes: the first two numbers of their colours, and the third one and their sizes.
  std::vector<std::uint32_t> colour, colour_and_size;
  std::vector<std::uint32_t> bin, next_bin;  ///< the bins of the first and the last band; the last of all: not seen
  std::vector<float> red, green, blue;       ///< of particles that have colours of their own
};

/// Memory for ordering splats that is used again: fresh memory costs about as much as what is done in it.
struct OrderingMemory {
  tbb::enumerable_thread_specific<ProjectedBlock> projected;
  std::vector<SplatBlock> spare;  ///< blocks that were drawn
};

/// Projects, lights and orders particles of a cloud, in blocks that depend on nothing but the cloud. Fewer than a
/// vector holds must be the cloud's last.
std::vector<SplatBlock> order_splats(const Cloud& cloud, ParticleRange range, const Projection& projection,
                                     const Window& window, const SplatOrders& orders, OrderingMemory& memory);

/// Projects and lights the block's particles, of which there are at least as many as a vector holds.
void project_particles(const Cloud& cloud, const Projection& projection, const Window& window,
                       const PictureTable& table, ProjectedBlock& block);

/// The value of a half float that is not negative, one at a time: its bits as a float's, whose exponent counts from 112
/// lower.
inline float float_from_half(std::uint16_t bits) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 13) * 0x1p112f;
}

}  // namespace wheatstone
