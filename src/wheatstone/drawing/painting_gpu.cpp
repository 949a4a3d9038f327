#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <variant>

#include "count_flags_source.h"
#include "wheatstone/drawing/painting_gpu_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"

namespace wheatstone {

struct PaintingOnGpu::Kept {
  GpuSurfaces surfaces;
  std::variant<GpuStrokes, GpuRegions, GpuDiffusion> marks;
  GpuProgram count_flags;
};

namespace {

GpuStrokes on_gpu_of(const PreparedStrokes& marks, const PreparedPainting::Contents& of) {
  return {marks, of.surfaces, of.relief};
}
GpuRegions on_gpu_of(const RegionPainting& marks, const PreparedPainting::Contents& of) { return {marks, of.surfaces}; }
GpuDiffusion on_gpu_of(const PreparedLines& marks, const PreparedPainting::Contents& of) {
  return {marks, of.surfaces};
}

std::size_t pixels_of(const PreparedPainting::Contents& contents) {
  return static_cast<std::size_t>(contents.width) * static_cast<std::size_t>(contents.height);
}

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
    kept_ = std::make_unique<Kept>(Kept{GpuSurfaces(contents.surfaces),
                                        std::visit(
                                            [&](const auto& marks) -> decltype(Kept::marks) {
                                              if constexpr (requires { on_gpu_of(marks, contents); })
                                                return on_gpu_of(marks, contents);
                                              else
                                                throw Error(ErrorKind::wrong_usage,
                                                            "graphics processor: draws no marks of this kind");
                                            },
                                            contents.marks),
                                        GpuProgram(count_flags_source)});
  });
}

PaintingOnGpu::~PaintingOnGpu() {
  try {
    on_gpu([&](const GpuFacts&) { kept_.reset(); });
  } catch (const Error&) {
    static_cast<void>(kept_.release());  // without its context nothing is left of it
  }
}

std::size_t PaintingOnGpu::views_at_once(const GpuFacts& facts) const {
  constexpr std::size_t most_bytes = std::size_t{1} << 29;
  constexpr std::size_t words_a_pixel = 5;  // of the largest buffer: four of lines of colour, and those of their margin
  const std::size_t bytes_a_view = words_a_pixel * sizeof(float) * pixels_of(contents_);
  return std::clamp<std::size_t>(std::min(facts.largest_buffer, most_bytes) / bytes_a_view, 1, most_gpu_views);
}

GpuBuffer PaintingOnGpu::drawn(const ViewsOnGpu& views) {
  const GpuBuffer planes = kept_->surfaces.seen(views.positions, contents_.width, contents_.height);
  return std::visit([&](auto& marks) { return marks.draw(kept_->surfaces, planes, views); }, kept_->marks);
}

void PaintingOnGpu::draw(std::span<const ViewToDraw> views) {
  const std::size_t size = pixels_of(contents_);
  on_gpu([&](const GpuFacts& facts) {
    const std::size_t at_once = views_at_once(facts);
    while (!views.empty()) {
      const auto some = views.first(std::min(at_once, alike(views)));
      views = views.subspan(some.size());
      std::vector<ViewPosition> positions;
      for (const ViewToDraw& view : some) positions.push_back(view.position);
      std::vector<std::uint32_t> pixels(size * some.size());
      drawn({std::move(positions), backgrounds_of(some)}).read(std::span(pixels));
      for_each_view(some.size(), [&](std::size_t v) {
        take(std::span(pixels).subspan(v * size, size), contents_.width, contents_.height, some[v].drawn);
      });
    }
  });
}

std::vector<FlagCounts> PaintingOnGpu::flags_of(const GpuBuffer& pixels, std::size_t views) const {
  const std::array<std::int32_t, 2> work{contents_.width, contents_.height};
  const GpuBuffer of_work(std::span<const std::int32_t>{work}), counted(views * sizeof(FlagCounts));
  kept_->count_flags.run({static_cast<std::uint32_t>(contents_.height), static_cast<std::uint32_t>(views)},
                         {&of_work, &pixels, &counted});
  std::vector<FlagCounts> counts(views);
  counted.read(std::span(counts));
  return counts;
}

std::optional<double> PaintingOnGpu::draw(std::span<const ViewPosition> views,
                                          const std::function<GpuViewSink(const GpuFacts&)>& make_sink) {
  std::optional<double> worst_bare_share;
  on_gpu([&](const GpuFacts& facts) {
    const GpuViewSink sink = make_sink(facts);
    const std::size_t at_once = views_at_once(facts);
    if (at_once < sink.at_least) return;
    double worst = 0;
    for (std::size_t first = 0; first < views.size(); first += at_once) {
      const std::size_t count = std::min(at_once, views.size() - first);
      const auto some = views.subspan(first, count);
      ViewsOnGpu to_draw{{some.begin(), some.end()}, {}};
      if (sink.wanted) to_draw.wanted.emplace(sink.wanted(first, count));
      const GpuBuffer pixels = drawn(to_draw);
      const std::vector<FlagCounts> flags = flags_of(pixels, count);
      for (const FlagCounts& of : flags)
        worst = std::max(worst, static_cast<double>(of.bare) /
                                    static_cast<double>(of.wanted > 0 ? of.wanted : pixels_of(contents_)));
      sink.take(pixels, first, count);
    }
    if (sink.finish) sink.finish();
    worst_bare_share = worst;
  });
  return worst_bare_share;
}

}  // namespace wheatstone
