#include "wheatstone/regions/posterise.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "wheatstone/image/grain.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/regions/colour_palette_internal.h"
#include "wheatstone/regions/cut_to_surfaces_internal.h"
#include "wheatstone/regions/outline_internal.h"
#include "wheatstone/regions/plan_regions_internal.h"
#include "wheatstone/regions/region_map_internal.h"

namespace wheatstone {
namespace {

/// Regions smaller than this, for a picture 640 pixels wide, are joined to their neighbours.
constexpr float least_area_px = 40;
/// How firmly a pixel keeps the colour that was carried to it: another one must be nearer by this share of the
/// unlikeness between the kept colour and its nearest neighbour in the palette, so that a pixel leaves for that
/// neighbour after four fifths of the way.
constexpr float firmness = 0.6f;

/// For each colour, by how much in unlikeness others must be nearer.
std::vector<float> holds_of(const std::vector<Rgb8>& palette) {
  std::vector<float> holds;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    float nearest = std::numeric_limits<float>::max();
    for (std::size_t k = 0; k < palette.size(); ++k)
      if (k != i) nearest = std::min(nearest, unlikeness(palette[i], palette[k]));
    holds.push_back(firmness * nearest);
  }
  return holds;
}

/// How much of each colour the frame before had where a pixel's point was then.
class CarriedColours {
 public:
  CarriedColours() = default;
  CarriedColours(ImageView<const std::uint8_t> before, const Flow& backward, ImageView<const std::uint8_t> kept,
                 std::vector<float> holds)
      : before_(before), backward_(&backward), kept_(kept), holds_(std::move(holds)) {}

  bool any() const { return backward_ != nullptr; }
  float hold(std::size_t colour) const { return holds_[colour]; }

  /// The colour of a pixel that looks like `own`: the nearest, where those that were there, each by its share, are
  /// favoured by what holds them.
  std::size_t choose(int x, int y, Rgb8 own, const std::vector<Rgb8>& palette) const {
    if (backward_ == nullptr || kept_(x, y) == 0) return nearest_colour(palette, own);
    const float column = static_cast<float>(x) + backward_->x(x, y), row = static_cast<float>(y) + backward_->y(x, y);
    const float left = std::floor(column), top = std::floor(row);
    const float across = column - left, down = row - top;
    const auto colour_at = [&](int dx, int dy) -> std::size_t {
      return before_(std::clamp(static_cast<int>(left) + dx, 0, before_.width() - 1),
                     std::clamp(static_cast<int>(top) + dy, 0, before_.height() - 1));
    };
    const std::array<std::size_t, 4> colours{colour_at(0, 0), colour_at(1, 0), colour_at(0, 1), colour_at(1, 1)};
    // The usual case, without a search: by the triangle inequality no other colour can be nearer by enough.
    constexpr float surely = 0.99f * (1 + firmness) * (1 + firmness) / 4 / firmness;
    if (std::ranges::all_of(colours, [&](std::size_t colour) { return colour == colours[0]; }) &&
        unlikeness(palette[colours[0]], own) < surely * holds_[colours[0]])
      return colours[0];
    const std::array<float, 4> shares{(1 - across) * (1 - down), across * (1 - down), (1 - across) * down,
                                      across * down};
    std::size_t best = nearest_colour(palette, own);
    float least = unlikeness(palette[best], own);
    for (const std::size_t colour : colours) {
      float share = 0;
      for (std::size_t i = 0; i < colours.size(); ++i)
        if (colours[i] == colour) share += shares[i];
      const float distance = unlikeness(palette[colour], own) - holds_[colour] * share;
      if (distance >= least) continue;
      least = distance;
      best = colour;
    }
    return best;
  }

 private:
  ImageView<const std::uint8_t> before_;
  const Flow* backward_ = nullptr;
  ImageView<const std::uint8_t> kept_;
  std::vector<float> holds_;
};

Image<std::int32_t> label_colours(ImageView<const Rgb8> picture, ImageView<const std::uint8_t> mask,
                                  const std::vector<Rgb8>& palette, const CarriedColours& carried) {
  Image<std::int32_t> labels(picture.width(), picture.height(), -1);
  tbb::parallel_for(0, picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (!mask.empty() && mask(x, y) == 0) continue;
      labels(x, y) = static_cast<std::int32_t>(carried.choose(x, y, picture(x, y), palette));
    }
  });
  return labels;
}

/// How many pixels of each region have each label, region after region.
std::vector<std::uint32_t> count_labels(const RegionMap& regions, const Image<std::int32_t>& labels,
                                        std::size_t colours) {
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(regions.count) * colours);
  for (std::size_t i = 0; i < labels.pixels().size(); ++i)
    if (regions.of.pixels()[i] >= 0)
      ++counts[static_cast<std::size_t>(regions.of.pixels()[i]) * colours +
               static_cast<std::size_t>(labels.pixels()[i])];
  return counts;
}

/// The colour of a region: the nearest to its mean, and one that its pixels have is favoured as theirs were.
std::size_t colour_of_area(const RegionMeans& means, std::span<const std::uint32_t> counts,
                           const std::vector<Rgb8>& palette, const CarriedColours& carried) {
  const Rgb8 mean = mean_colour(means);
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const double kept = static_cast<double>(carried.hold(i)) * counts[i] / static_cast<double>(means.area);
    const double distance = static_cast<double>(unlikeness(palette[i], mean)) - kept;
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return best;
}

/// A view's regions, and the index of each one's colour.
struct ColouredRegions {
  RegionMap regions;
  std::vector<std::size_t> colours;
};

/// Adds the regions as marks that follow their surfaces.
void add_parts(const ViewToCut& view, ImageView<const Rgb8> picture, const ColouredRegions& regions,
               const std::vector<Rgb8>& palette, RegionPainting& painting) {
  constexpr float off_surface_px = 1;
  constexpr float least_off_surface_px = 16;  ///< of area, for a picture 640 pixels wide
  const SurfaceParts cut =
      cut_to_surfaces(regions.regions, view.disparity, view.depth_threshold_px, off_surface_px,
                      static_cast<std::int64_t>(std::ceil(least_off_surface_px * view.scale * view.scale)));
  const std::size_t first = painting.marks.size();
  add_outlines(cut.parts, view.disparity, view.position, {.depth_threshold_px = view.depth_threshold_px}, painting);
  const std::vector<RegionMeans> means = means_of(cut.parts, picture, view.disparity);
  for (std::size_t i = 0; i < means.size(); ++i) {
    RegionMark& mark = painting.marks[first + i];
    mark.colour = palette[regions.colours[static_cast<std::size_t>(cut.region[i])]];
    mark.disparity = static_cast<float>(means[i].disparity);
    mark.views = view.views;
  }
}

/// Cuts a picture without grain into the palette's colours, and adds its regions.
ColouredRegions add_areas(const ViewToCut& view, ImageView<const Rgb8> picture, const std::vector<Rgb8>& palette,
                          const CarriedColours& carried, RegionPainting& painting) {
  const Image<std::int32_t> labels = label_colours(picture, view.wanted, palette, carried);
  ColouredRegions regions{connected_regions(labels, view.disparity, view.depth_threshold_px), {}};
  const auto least_area = static_cast<std::int64_t>(least_area_px * view.scale * view.scale);
  regions.regions =
      without_small_regions(std::move(regions.regions), picture, view.disparity, view.depth_threshold_px, least_area);
  const std::vector<RegionMeans> means = means_of(regions.regions, picture, view.disparity);
  std::vector<std::uint32_t> counts;
  if (carried.any()) counts = count_labels(regions.regions, labels, palette.size());
  for (std::size_t i = 0; i < means.size(); ++i)
    regions.colours.push_back(
        counts.empty() ? nearest_colour(palette, mean_colour(means[i]))
                       : colour_of_area(means[i], std::span(counts).subspan(i * palette.size(), palette.size()),
                                        palette, carried));
  add_parts(view, picture, regions, palette, painting);
  return regions;
}

Image<std::uint8_t> colours_of(const ColouredRegions& regions) {
  Image<std::uint8_t> colours(regions.regions.of.width(), regions.regions.of.height());
  for (std::size_t i = 0; i < colours.pixels().size(); ++i)
    colours.pixels()[i] =
        static_cast<std::uint8_t>(regions.colours[static_cast<std::size_t>(regions.regions.of.pixels()[i])]);
  return colours;
}

/// The reference view of a scene that begins.
void cut_first(const ViewToCut& view, const Style& style, PosterisedMemory& memory, RegionPainting& painting) {
  memory.picture = begin_steady(view.colour);
  const Image<Rgb8> picture = without_grain(view.colour, view.scale);
  memory.palette = find_palette(picture, palette_size(style.colours), view.seed);
  memory.colour_of = colours_of(add_areas(view, picture, rounded(memory.palette), {}, painting));
}

/// The reference view of a scene that goes on.
void cut_next(const ViewToCut& view, const FlowPair& flow, PosterisedMemory& memory, RegionPainting& painting) {
  const Image<std::uint8_t> kept = confirmed(flow.backward, flow.forward);
  steady(view.colour, flow.backward, kept, memory.picture);
  const Image<Rgb8> picture = without_grain(rounded(memory.picture.colours), view.scale);
  follow_palette(picture, memory.palette);
  const std::vector<Rgb8> palette = rounded(memory.palette);
  const CarriedColours carried(memory.colour_of, flow.backward, kept, holds_of(palette));
  memory.colour_of = colours_of(add_areas(view, picture, palette, carried, painting));
}

}  // namespace

RegionPainting plan_posterised(const FilmFrame& frame, const Style& style, PosterisedMemory& memory) {
  if (frame.flow != nullptr) check_fits(*frame.flow, frame.views);
  return plan_regions(frame.views, style, [&](const ViewToCut& view, const Style&, RegionPainting& painting) {
    if (view.number > 0) {
      const Image<Rgb8> picture = without_grain_quickly(view.colour);
      const bool alone = style.propagation == Propagation::independent;
      add_areas(view, picture,
                rounded(alone ? find_palette(picture, palette_size(style.colours), view.seed) : memory.palette), {},
                painting);
    } else if (frame.flow == nullptr || !same_size(memory.picture.frames, view.colour)) {
      cut_first(view, style, memory, painting);
    } else {
      cut_next(view, *frame.flow, memory, painting);
    }
  });
}

}  // namespace wheatstone
