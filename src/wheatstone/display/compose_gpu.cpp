#include "wheatstone/display/compose_gpu.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <vector>

#include "compose_views_source.h"
#include "wheatstone/display/anaglyph_internal.h"
#include "wheatstone/display/lenticular_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/program.h"
#include "wheatstone/gpu/views.h"

namespace wheatstone {
namespace {

/// What compose_views.comp reads of its work: numbers of four bytes, without gaps.
struct ComposeWork {
  std::int32_t kind = 0;
  std::int32_t width = 0, height = 0;
  std::int32_t view_width = 0, view_height = 0;
  std::int32_t views = 0;
  std::int32_t first_view = 0, view_count = 0;
  std::int32_t columns = 1, rows = 1;
  std::int32_t blue_first = 0;
  std::int32_t rows_differ = 0, columns_differ = 0, right_first = 0;
  std::int32_t clips_eyes = 0;
  std::int32_t marks = 0;
};

/// The picture of a composition, and what the program needs for it beside the views.
struct Composed {
  ComposeWork work;
  std::vector<std::uint32_t> table = {};
};

Composed composed_of(const LenticularScreen& screen, const ViewsToCompose& views) {
  if (views.count > 0xFFFF) throw Error(ErrorKind::wrong_usage, "more than 65535 views to interleave");
  Composed composed{
      {.kind = 0, .width = screen.width, .height = screen.height, .blue_first = screen.blue_first ? 1 : 0}};
  const auto append = [&](std::uint64_t number) {
    composed.table.push_back(static_cast<std::uint32_t>(number));
    composed.table.push_back(static_cast<std::uint32_t>(number >> 32));
  };
  append(phases_of_row(screen, 0).a_subpixel);
  for (int y = 0; y < screen.height; ++y) {
    composed.table.push_back(static_cast<std::uint32_t>(nearest_sample(y, screen.height, views.height)));
    append(phases_of_row(screen, y).first);
  }
  for (int x = 0; x < screen.width; ++x)
    composed.table.push_back(static_cast<std::uint32_t>(nearest_sample(x, screen.width, views.width)));
  return composed;
}

Composed composed_of(const QuiltLayout& layout, const ViewsToCompose& views) {
  if (layout.columns < 1 || layout.rows < 1 ||
      views.count != static_cast<std::size_t>(layout.columns) * static_cast<std::size_t>(layout.rows))
    throw Error(ErrorKind::wrong_usage, fmt::format("a quilt of {}x{} holds {} views, but there are {}", layout.columns,
                                                    layout.rows, layout.columns * layout.rows, views.count));
  return {{.kind = 1,
           .width = views.width * layout.columns,
           .height = views.height * layout.rows,
           .columns = layout.columns,
           .rows = layout.rows}};
}

Composed composed_of(const AnaglyphKind& kind, const ViewsToCompose& views) {
  const AnaglyphTables tables = anaglyph_tables(kind);
  Composed composed{{.kind = 2, .width = views.width, .height = views.height, .clips_eyes = tables.clips_eyes ? 1 : 0}};
  const auto append = [&](std::span<const float> numbers) {
    std::ranges::transform(numbers, std::back_inserter(composed.table),
                           [](float number) { return std::bit_cast<std::uint32_t>(number); });
  };
  append(tables.light);
  for (const auto& thresholds : tables.thresholds) append(thresholds);
  for (const AnaglyphMatrix* matrix : {&tables.left, &tables.right})
    for (const auto& row : *matrix) append(row);
  return composed;
}

Composed composed_of(StereoLayout layout, const ViewsToCompose& views) {
  const LayoutTraits& of = traits_of(layout);
  const bool columns_alike = of.arrangement == Arrangement::rows, rows_alike = of.arrangement == Arrangement::columns;
  return {{.kind = 3,
           .width = views.width,
           .height = views.height,
           .rows_differ = rows_alike ? 0 : 1,
           .columns_differ = columns_alike ? 0 : 1,
           .right_first = of.right_first ? 1 : 0}};
}

/// As many bytes of views as are sent at once.
constexpr std::size_t most_bytes_at_once = std::size_t{1} << 28;

std::size_t pixels_of(const ViewsToCompose& views) {
  return static_cast<std::size_t>(views.width) * static_cast<std::size_t>(views.height);
}

std::size_t words_of_picture(const ComposeWork& work) {
  return (static_cast<std::size_t>(work.width) * static_cast<std::size_t>(work.height) + 3) / 4 * 3;
}

bool takes_two_eyes(const DisplayComposition& composition) {
  return std::holds_alternative<AnaglyphKind>(composition) || std::holds_alternative<StereoLayout>(composition);
}

}  // namespace

struct GpuComposer::Parts {
  ViewsToCompose views;
  ComposeWork work;
  std::size_t views_at_once, least_at_once;
  double shown_share;
  GpuProgram compose_views;
  GpuBuffer table, picture;
};

GpuComposer::GpuComposer(const DisplayComposition& composition, const ViewsToCompose& views, const GpuFacts& facts) {
  if (!composes_on_gpu(composition)) throw Error(ErrorKind::wrong_usage, "graphics processor: composes no such layout");
  if (takes_two_eyes(composition) && views.count != 2)
    throw Error(ErrorKind::wrong_usage, fmt::format("there are {} views, expected those of two eyes", views.count));
  Composed composed = std::visit([&](const auto& kind) { return composed_of(kind, views); }, composition);
  ComposeWork& work = composed.work;
  work.view_width = views.width;
  work.view_height = views.height;
  work.views = static_cast<std::int32_t>(views.count);
  const std::size_t bytes = words_of_picture(work) * sizeof(std::uint32_t),
                    bytes_a_view = pixels_of(views) * sizeof(std::uint32_t);
  const std::size_t least = takes_two_eyes(composition) ? 2 : 1,
                    at_once = std::max(std::min(most_bytes_at_once, facts.largest_buffer) / bytes_a_view, least);
  if (std::max(bytes, bytes_a_view * least) > facts.largest_buffer)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("graphics processor: has no room for a picture of {}x{} pixels; --device cpu composes it",
                            work.width, work.height));
  double share = 1;
  if (std::holds_alternative<LenticularScreen>(composition))
    share = 3.0 * work.width * work.height / (static_cast<double>(pixels_of(views)) * static_cast<double>(views.count));
  parts_ =
      std::make_unique<Parts>(Parts{views, work, at_once, least, std::min(share, 1.0), GpuProgram(compose_views_source),
                                    GpuBuffer(std::span<const std::uint32_t>(composed.table)), GpuBuffer(bytes)});
}

GpuComposer::~GpuComposer() = default;

std::size_t GpuComposer::views_at_once() const { return parts_->views_at_once; }

std::size_t GpuComposer::least_at_once() const { return parts_->least_at_once; }

double GpuComposer::shown_share() const { return parts_->shown_share; }

void GpuComposer::run(const GpuBuffer& pixels, std::size_t first, std::size_t count, const GpuBuffer& to,
                      bool marks) const {
  ComposeWork work = parts_->work;
  work.first_view = static_cast<std::int32_t>(first);
  work.view_count = static_cast<std::int32_t>(count);
  work.marks = marks ? 1 : 0;
  const GpuBuffer of_work(std::span<const ComposeWork>(&work, 1));
  constexpr std::size_t pixels_a_group = 256, groups_a_row = 1024;
  const std::size_t picture_pixels = static_cast<std::size_t>(work.width) * static_cast<std::size_t>(work.height);
  parts_->compose_views.run({groups_a_row, groups_of(picture_pixels, pixels_a_group * groups_a_row)},
                            {&of_work, &pixels, &parts_->table, &to});
}

GpuBuffer GpuComposer::shown(std::size_t first, std::size_t count) const {
  const auto words_a_row = static_cast<std::size_t>((parts_->views.width + 31) / 32);
  GpuBuffer bits(count * static_cast<std::size_t>(parts_->views.height) * words_a_row * sizeof(std::uint32_t));
  run(bits, first, count, bits, true);
  return bits;
}

void GpuComposer::take(const GpuBuffer& pixels, std::size_t first, std::size_t count) {
  run(pixels, first, count, parts_->picture, false);
}

void GpuComposer::take(std::span<const Image<Rgb8>> views, std::size_t first) {
  std::vector<std::uint32_t> pixels;
  pixels.reserve(views.size() * pixels_of(parts_->views));
  for (const Image<Rgb8>& view : views) std::ranges::transform(view.pixels(), std::back_inserter(pixels), packed);
  take(GpuBuffer(std::span<const std::uint32_t>(pixels)), first, views.size());
}

Image<Rgb8> GpuComposer::picture() const {
  Image<Rgb8> picture(parts_->work.width, parts_->work.height);
  parts_->picture.read(picture.pixels());
  return picture;
}

bool composes_on_gpu(const DisplayComposition& composition) {
  const auto* const layout = std::get_if<StereoLayout>(&composition);
  if (layout == nullptr) return true;
  const Arrangement arrangement = traits_of(*layout).arrangement;
  return arrangement == Arrangement::rows || arrangement == Arrangement::columns ||
         arrangement == Arrangement::checkerboard;
}

}  // namespace wheatstone
