#include <algorithm>
#include <iterator>
#include <variant>

#include "wheatstone/drawing/painting_gpu_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"

namespace wheatstone {

struct PaintingOnGpu::Kept {
  GpuSurfaces surfaces;
  std::variant<GpuStrokes, GpuRegions, GpuDiffusion> marks;
};

namespace {

GpuStrokes on_gpu_of(const PreparedStrokes& marks, const PreparedSurfaces& surfaces) { return {marks, surfaces}; }
GpuRegions on_gpu_of(const RegionPainting& marks, const PreparedSurfaces& surfaces) { return {marks, surfaces}; }
GpuDiffusion on_gpu_of(const DiffusionPainting& marks, const PreparedSurfaces& surfaces) { return {marks, surfaces}; }

/// The pictures that lie behind some views, packed.
std::vector<std::uint32_t> backgrounds_of(std::span<const ViewToDraw> views) {
  std::vector<std::uint32_t> pixels;
  for (const ViewToDraw& view : views)
    for (int y = 0; y < view.background.height(); ++y)
      std::ranges::transform(view.background.row(y), std::back_inserter(pixels), packed);
  return pixels;
}

/// How many views from the first on all have a background, or all have none.
std::size_t alike(std::span<const ViewToDraw> views) {
  const bool over_canvas = views.front().background.empty();
  const auto differs = [&](const ViewToDraw& view) { return view.background.empty() != over_canvas; };
  return static_cast<std::size_t>(std::ranges::find_if(views, differs) - views.begin());
}

/// Fills a view with what the programs wrote of it.
void take(std::span<const std::uint32_t> pixels, int width, int height, DrawnView& drawn) {
  drawn.picture = Image<Rgb8>(width, height);
  drawn.bare = Image<std::uint8_t>(width, height);
  unpack(pixels, drawn.picture);
  std::size_t bare = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const bool is_bare = (pixels[i] & gpu_bare_pixel) != 0;
    drawn.bare.pixels()[i] = is_bare ? 255 : 0;
    bare += is_bare ? 1 : 0;
  }
  drawn.bare_share = static_cast<double>(bare) / static_cast<double>(pixels.size());
}

}  // namespace

PaintingOnGpu::PaintingOnGpu(const PreparedPainting::Contents& contents) : contents_(contents) {
  on_gpu([&](const GpuFacts&) {
    kept_ = std::make_unique<Kept>(
        Kept{GpuSurfaces(contents.surfaces),
             std::visit([&](const auto& marks) -> decltype(Kept::marks) { return on_gpu_of(marks, contents.surfaces); },
                        contents.marks)});
  });
}

PaintingOnGpu::~PaintingOnGpu() {
  try {
    on_gpu([&](const GpuFacts&) { kept_.reset(); });
  } catch (const Error&) {
    kept_.release();  // without its context nothing is left of it
  }
}

void PaintingOnGpu::draw(std::span<const ViewToDraw> views) {
  const auto size = static_cast<std::size_t>(contents_.width) * static_cast<std::size_t>(contents_.height);
  on_gpu([&](const GpuFacts& facts) {
    constexpr std::size_t most_bytes = std::size_t{1} << 29;
    constexpr std::size_t words_a_pixel = 4;  // of the largest buffer: of lines of colour
    const std::size_t bytes_a_view = words_a_pixel * sizeof(float) * size;
    const std::size_t at_once =
        std::clamp<std::size_t>(std::min(facts.largest_buffer, most_bytes) / bytes_a_view, 1, most_gpu_views);
    while (!views.empty()) {
      const auto some = views.first(std::min(at_once, alike(views)));
      views = views.subspan(some.size());
      std::vector<ViewPosition> positions;
      for (const ViewToDraw& view : some) positions.push_back(view.position);
      const GpuBuffer planes = kept_->surfaces.seen(positions, contents_.width, contents_.height);
      const ViewsOnGpu on_gpu_views{positions, backgrounds_of(some)};
      const GpuBuffer drawn =
          std::visit([&](auto& marks) { return marks.draw(kept_->surfaces, planes, on_gpu_views); }, kept_->marks);
      std::vector<std::uint32_t> pixels(size * some.size());
      drawn.read(std::span(pixels));
      for (std::size_t v = 0; v < some.size(); ++v)
        take(std::span(pixels).subspan(v * size, size), contents_.width, contents_.height, some[v].drawn);
    }
  });
}

}  // namespace wheatstone
