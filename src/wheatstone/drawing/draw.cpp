#include "wheatstone/drawing/draw.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "wheatstone/drawing/painting_gpu_internal.h"
#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/relief_internal.h"
#include "wheatstone/drawing/seen_surface_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"

namespace wheatstone {
namespace {

bool is_as_planned(const Placement& placement) { return placement == Placement{}; }

/// Hands a painting to the graphics processor, or not.
void hand_over(PreparedPainting::Contents& contents, Device device) {
  constexpr int worthwhile = 1 << 16;  // pixels
  contents.device = device;
  if (!chooses_gpu(device, contents.width * contents.height >= worthwhile)) return;
  done_on_gpu(device, [&] { contents.on_gpu = std::make_shared<PaintingOnGpu>(contents); });
}

PreparedPainting prepared(const Painting& painting, Device device, bool deep) {
  using Marks = decltype(PreparedPainting::Contents::marks);
  Marks marks = std::visit([](const auto& kind) -> Marks { return prepare_marks(kind); }, painting.marks);
  if (auto* const lines = std::get_if<PreparedLines>(&marks))
    lines->overhangs_px = overhangs_of(lines->painting, painting.surfaces);
  auto contents = std::make_unique<PreparedPainting::Contents>(PreparedPainting::Contents{
      width_of(painting), height_of(painting), std::move(marks), painting.surfaces, painting.relief});
  contents->deep = deep;
  hand_over(*contents, device);
  return PreparedPainting(std::move(contents));
}

/// Draws the marks of some views, and lights their paint.
void draw_on_processor(const PreparedPainting::Contents& contents, std::span<const ViewToDraw> views) {
  const auto* const strokes = std::get_if<PreparedStrokes>(&contents.marks);
  if (strokes != nullptr && contents.deep)
    for (const ViewToDraw& view : views) view.drawn.deep = Image<Rgb16>(contents.width, contents.height);
  std::visit([&](const auto& marks) { draw_marks(marks, contents.surfaces, views); }, contents.marks);
  if (strokes == nullptr || contents.relief.depth_px <= 0) return;
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    const SeenSurfaces seen = seen_surfaces(contents.surfaces, views[i].position, {contents.width, 0, contents.height});
    light_paint(*strokes, views[i].position, seen.hiding, contents.relief, views[i].drawn);
  });
}

void draw_some(const PreparedPainting::Contents& contents, std::span<const ViewToDraw> views) {
  const bool drawn = contents.on_gpu != nullptr && done_on_gpu(contents.device, [&] { contents.on_gpu->draw(views); });
  if (!drawn) draw_on_processor(contents, views);
}

}  // namespace

PreparedPainting::PreparedPainting(std::unique_ptr<Contents> contents) : contents_(std::move(contents)) {}
PreparedPainting::PreparedPainting(PreparedPainting&&) noexcept = default;
PreparedPainting& PreparedPainting::operator=(PreparedPainting&&) noexcept = default;
PreparedPainting::~PreparedPainting() = default;
int PreparedPainting::width() const { return contents_->width; }
int PreparedPainting::height() const { return contents_->height; }

PreparedPainting prepare(const Painting& painting, const DrawOptions& options, Device device) {
  const bool is_whole = options.slicing == Slicing();
  if (is_as_planned(options.placement) && is_whole && options.relief) return prepared(painting, device, options.deep);
  Painting part = is_whole ? painting : sliced(painting, options.slicing);
  if (!is_as_planned(options.placement)) part = placed(std::move(part), options.placement);
  if (!options.relief) part.relief = {};
  return prepared(part, device, options.deep);
}

void draw(const PreparedPainting& painting, std::span<const ViewPosition> views, const ViewSink& take,
          std::span<const ImageView<const Rgb8>> backgrounds) {
  const PreparedPainting::Contents& contents = painting.contents();
  // The pictures of so many views are held at once.
  constexpr std::size_t most_pixels = 48u << 20;
  const std::size_t pixels = static_cast<std::size_t>(contents.width) * static_cast<std::size_t>(contents.height);
  const std::size_t at_once = std::max<std::size_t>(most_pixels / std::max<std::size_t>(pixels, 1), 1);
  for (std::size_t first = 0; first < views.size(); first += at_once) {
    const std::size_t count = std::min(at_once, views.size() - first);
    std::vector<DrawnView> drawn(count);
    std::vector<ViewToDraw> to_draw;
    for (std::size_t i = 0; i < count; ++i)
      to_draw.push_back(
          {views[first + i], backgrounds.empty() ? ImageView<const Rgb8>() : backgrounds[first + i], drawn[i]});
    draw_some(contents, to_draw);
    for (std::size_t i = 0; i < count; ++i) take(first + i, std::move(drawn[i]));
  }
}

std::vector<DrawnView> draw(const PreparedPainting& painting, std::span<const ViewPosition> views,
                            std::span<const ImageView<const Rgb8>> backgrounds) {
  std::vector<DrawnView> drawn(views.size());
  const ViewSink keep = [&](std::size_t place, DrawnView view) { drawn[place] = std::move(view); };
  draw(painting, views, keep, backgrounds);
  return drawn;
}

DrawnView draw(const PreparedPainting& painting, ViewPosition view, ImageView<const Rgb8> background) {
  return std::move(draw(painting, {&view, 1}, {&background, 1}).front());
}

void draw_over(PreparedPainting& painting, const Layer& strokes, ViewPosition view, ImageView<const Rgb8> background,
               DrawnView& drawn) {
  PreparedPainting::Contents& contents = painting.contents();
  draw_marks_over(std::get<PreparedStrokes>(contents.marks), contents.surfaces, strokes, {view, background, drawn});
}

bool is_drawn_by_processor(const PreparedPainting& painting) { return painting.contents().on_gpu == nullptr; }

std::optional<double> draw_on_gpu(const PreparedPainting& painting, std::span<const ViewPosition> views,
                                  const std::function<GpuViewSink(const GpuFacts&)>& make_sink) {
  const PreparedPainting::Contents& contents = painting.contents();
  std::optional<double> bare_share;
  if (contents.on_gpu == nullptr) return bare_share;
  const bool done = done_on_gpu(contents.device, [&] { bare_share = contents.on_gpu->draw(views, make_sink); });
  return done ? bare_share : std::nullopt;
}

DrawnView draw(const Painting& painting, ViewPosition view) { return draw(prepare(painting), view); }

}  // namespace wheatstone
