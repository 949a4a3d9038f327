#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "wheatstone/image/colour.h"
#include "wheatstone/multiview/splat_internal.h"

namespace wheatstone {
namespace {

// A block's splats, twice, and its bins' ends fit in a second-level cache.
constexpr std::size_t block_particles = 32768;
// The widest vector's worth: blocks are at least as long, so that none is read beyond.
constexpr std::size_t most_lanes = 16;

void take_own_colours(const Cloud& cloud, ProjectedBlock& block) {
  for (std::size_t i = 0; i < block.count; ++i) {
    const Rgb8 colour = cloud.colour[block.first + i];
    block.red[i] = linear_from_srgb(colour.r);
    block.green[i] = linear_from_srgb(colour.g);
    block.blue[i] = linear_from_srgb(colour.b);
  }
}

void begin_block(std::size_t first, std::size_t count, bool own_colours, ProjectedBlock& block) {
  block.first = first;
  block.count = count;
  for (std::vector<float>* column : {&block.x, &block.y, &block.parallax}) column->resize(count);
  block.colour.resize(count);
  block.colour_and_size.resize(count);
  block.bin.resize(count);
  block.next_bin.resize(count);
  if (!own_colours) return;
  block.red.resize(count);
  block.green.resize(count);
  block.blue.resize(count);
}

/// A splat in words, as it lies in memory: what is put together of smaller parts waits until these are stored.
using SplatWords = std::array<std::uint32_t, 5>;
static_assert(sizeof(SplatWords) == sizeof(Splat) && std::endian::native == std::endian::little);

SplatWords words_of(const ProjectedBlock& block, std::size_t i) {
  return {std::bit_cast<std::uint32_t>(block.x[i]), std::bit_cast<std::uint32_t>(block.y[i]),
          std::bit_cast<std::uint32_t>(block.parallax[i]), block.colour[i], block.colour_and_size[i]};
}

void put(const SplatWords& words, Splat& to) {
  for (std::size_t i = 0; i < words.size(); ++i)
    std::memcpy(reinterpret_cast<std::byte*>(&to) + i * sizeof(words[i]), &words[i], sizeof(words[i]));
}

/// Counts, then moves each splat to its bin; one that reaches into a second band goes there too.
void sort_into_bins(const ProjectedBlock& projected, std::size_t bins, SplatBlock& block) {
  const std::size_t count = projected.count;
  block.begin.assign(bins + 2, 0);
  std::uint32_t* const ends = block.begin.data() + 1;
  for (std::size_t i = 0; i < count; ++i) {
    ++ends[projected.bin[i]];
    ends[projected.next_bin[i]] += projected.next_bin[i] != projected.bin[i];
  }
  std::uint32_t total = 0;
  for (std::size_t bin = 0; bin <= bins; ++bin) {
    const std::uint32_t here = ends[bin];
    ends[bin] = total;
    total += here;
  }
  if (block.splats.capacity() < total) {
    block.splats.clear();
    block.splats.reserve(total + total / 8);  // so that it fits the next particles
  }
  block.splats.resize(total);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t bin = projected.bin[i];
    const std::uint32_t next = projected.next_bin[i];
    const SplatWords words = words_of(projected, i);
    // Always written twice, over itself if both bins are the same, which avoids an unpredictable branch.
    const std::uint32_t at_next = ends[next];
    const std::uint32_t at = ends[bin];
    put(words, block.splats[at_next]);
    put(words, block.splats[at]);
    ends[next] = at_next + 1;
    ends[bin] = at + 1;
  }
}

/// A small cloud, padded to the length of a vector with invisible particles.
Cloud filled_up(const Cloud& cloud) {
  Cloud full = cloud;
  const std::size_t length = most_lanes;
  for (std::vector<float>* column : {&full.x, &full.y, &full.z}) column->resize(length, std::nanf(""));
  for (std::vector<float>* column :
       {&full.density, &full.temperature, &full.smoothing_length, &full.mass, &full.quantity, &full.presence})
    if (!column->empty()) column->resize(length, 1.f);
  if (!full.colour.empty()) full.colour.resize(length);
  return full;
}

/// The particles from number `first` on.
Cloud last_of(const Cloud& cloud, std::size_t first) {
  Cloud last;
  for_each_column(last, cloud, [first](auto& to, const auto& from) {
    if (!from.empty()) to.assign(from.begin() + static_cast<std::ptrdiff_t>(first), from.end());
  });
  return last;
}

}  // namespace

PictureTable::PictureTable(const SplatOrders& orders) : pictures(static_cast<int>(orders.size())), first(orders[0]) {
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const SplatOrder& order = orders[i];
    bins += order.bins();
    widest[i] = widest_mass_px / order.scale;
    scale[i] = order.scale;
    pad[i] = static_cast<float>(order.pad);
    last_row[i] = static_cast<float>(order.rows - 1);
    parts[i] = static_cast<float>(order.parts);
    first_bin[i] = static_cast<float>(order.first_bin);
    parts_a_pixel[i] = 1 / order.spacing;
  }
}

Projection make_projection(const Scene& scene, const CloudStatistics& statistics, ViewPosition view) {
  Projection projection{.camera = scene.camera, .splat_style = scene.splat_style, .table = {}, .view = view};
  // Depths of the sphere around all particles.
  const std::array<float, 3> centre = statistics.centre();
  float depth = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    depth += (centre[axis] - scene.camera.position[axis]) * scene.camera.forward[axis];
  const float radius = statistics.radius();
  // Beyond the mapping's ends parallax stays what it is there: the table needs no more, however far a particle lies.
  const float last = std::min(depth + radius, scene.mapping.points.back().depth);
  const float first = std::min(std::max(depth - radius, scene.mapping.points.front().depth), last);
  const float nearest = std::max({first, scene.camera.nearest_depth, last * 1e-4f});
  const float farthest = std::max(last, nearest * 1.001f);

  ParallaxTable& table = projection.table;
  table.first_w = 1 / farthest;
  table.entries_per_w = (ParallaxTable::size - 1) / (1 / nearest - 1 / farthest);
  for (int i = 0; i < ParallaxTable::size; ++i) {
    const float w = table.first_w + static_cast<float>(i) / table.entries_per_w;
    table.value.push_back(parallax_px(scene.mapping, 1 / w));
  }
  for (int i = 0; i + 1 < ParallaxTable::size; ++i) table.step.push_back(table.value[i + 1] - table.value[i]);
  table.step.push_back(0);
  return projection;
}

std::vector<SplatBlock> order_splats(const Cloud& cloud, ParticleRange range, const Projection& projection,
                                     const Window& window, const SplatOrders& orders, OrderingMemory& memory) {
  if (range.count == 0) return {};
  if (cloud.size() < most_lanes)
    return order_splats(filled_up(cloud), {0, most_lanes}, projection, window, orders, memory);
  if (range.count < most_lanes) {
    return order_splats(filled_up(last_of(cloud, range.first)), {0, most_lanes}, projection, window, orders, memory);
  }
  const PictureTable table(orders);
  const std::size_t blocks = std::max<std::size_t>(range.count / block_particles, 1);
  const bool own_colours = projection.splat_style.colour_source == ColourSource::own;
  std::vector<SplatBlock> ordered(blocks);
  for (SplatBlock& block : ordered) {
    if (memory.spare.empty()) break;
    block = std::move(memory.spare.back());
    memory.spare.pop_back();
  }
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    const std::size_t begin = range.count * b / blocks;
    const std::size_t count = range.count * (b + 1) / blocks - begin;
    const std::size_t first = range.first + begin;
    ProjectedBlock& projected = memory.projected.local();
    begin_block(first, count, own_colours, projected);
    if (own_colours) take_own_colours(cloud, projected);
    project_particles(cloud, projection, window, table, projected);
    sort_into_bins(projected, table.bins, ordered[b]);
  });
  return ordered;
}

}  // namespace wheatstone
