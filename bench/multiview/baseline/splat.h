#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/multiview/scene.h"

namespace wheatstone::baseline {

/// A particle as the reference view has it. Twenty bytes, since reading and writing them is half the work: the colour,
/// linear light times opacity, and the size are half floats.
struct Splat {
  float x, y;      ///< centre, in pixels
  float parallax;  ///< in pixels, at full eye separation
  std::uint16_t colour[3];
  std::uint16_t size;  ///< diameter in pixels
};
static_assert(sizeof(Splat) == 20);

/// A Gaussian's standard deviation is its splat's diameter over this: at the rim 4 % of the peak are left.
constexpr float diameters_a_deviation = 5;
/// Variance that the area of a pixel adds to a splat's (a box one pixel wide).
constexpr float pixel_variance = 1.f / 12;
/// Half the width of what a splat touches: its radius, and half of a pixel's width around it.
constexpr float reach_of(float size) { return size / 2 + 0.5f; }

/// What of the picture is drawn: rows from 0 to `height`, columns from `left` to `right`.
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
  std::size_t bins() const { return static_cast<std::size_t>(bands) * parts; }
  std::size_t bin(int band, int part) const { return static_cast<std::size_t>(band) * parts + part; }
};

/// Some thousand splats, ordered: those of bin b are splats[begin[b]] … splats[begin[b + 1] − 1]. A splat that reaches
/// into two bands stands in both.
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

/// What the projection needs, made once a picture.
struct Projection {
  Camera camera;
  SplatStyle splat_style;
  ParallaxTable table;
  ViewPosition view = central_view;  ///< that is projected
};

Projection make_projection(const Scene& scene, const CloudStatistics& statistics, ViewPosition view = central_view);

/// Projects, lights and orders the particles of a cloud, in blocks that depend on nothing but the cloud.
std::vector<SplatBlock> order_splats(const Cloud& cloud, const Projection& projection, const Window& window,
                                     const SplatOrder& order);

/// Arrays that the projection fills for one block of particles, from number `first` of the cloud on; all `count` long.
struct ProjectedBlock {
  std::size_t first = 0, count = 0;
  std::vector<Splat> splats;
  std::vector<std::uint32_t> bin, next_bin;  ///< the bins of the first and the last band; the last of all: not seen
  std::vector<float> red, green, blue;       ///< of particles that have colours of their own
};

/// Projects and lights the block's particles, of which there are at least as many as a vector holds.
void project_particles(const Cloud& cloud, const Projection& projection, const Window& window, const SplatOrder& order,
                       ProjectedBlock& block);

}  // namespace wheatstone::baseline
