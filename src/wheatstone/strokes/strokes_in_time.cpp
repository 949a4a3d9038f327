#include "wheatstone/strokes/strokes_in_time.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <span>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/strokes/carry_strokes_internal.h"
#include "wheatstone/strokes/fine_colours_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/misplaced_strokes_internal.h"
#include "wheatstone/strokes/refit_internal.h"
#include "wheatstone/strokes/view_painter_internal.h"
#include "wheatstone/strokes/visible_runs_internal.h"

namespace wheatstone {
namespace {

/// Plans the views at once and tells of each layer. An exception that `progress` throws in one view is thrown again
/// when all views have ended: otherwise the loops of the other views would be cancelled, and these would go on with
/// unfinished results.
class ViewsPlan {
 public:
  ViewsPlan(const Progress& progress, ImageView<const Rgb8> reference, std::size_t views, std::size_t layers)
      : progress_(progress),
        thrown_(views),
        one_by_one_(is_large({reference.width(), reference.height()})),
        steps_(views * (layers + 1)) {}

  /// Calls `plan(view)` for all views. Those of large pictures would take too much memory at once.
  template <class Plan>
  void run(Plan plan) {
    const auto plan_one = [&](std::size_t view) {
      try {
        plan(view);
      } catch (...) {
        thrown_[view] = std::current_exception();
      }
      return !thrown_[view];
    };
    if (one_by_one_) {
      for (std::size_t view = 0; view < thrown_.size() && plan_one(view);) ++view;
    } else {
      tbb::parallel_for(std::size_t{0}, thrown_.size(), plan_one);
    }
    for (const std::exception_ptr& thrown : thrown_)
      if (thrown) std::rethrow_exception(thrown);
  }

  /// Before a view's first layer and after each.
  void report_step() {
    const std::scoped_lock lock(reporting_);
    report(progress_, "painting", static_cast<double>(done_++) / static_cast<double>(steps_));
  }

 private:
  const Progress& progress_;
  std::vector<std::exception_ptr> thrown_;
  bool one_by_one_;
  std::size_t steps_;
  std::size_t done_ = 0;
  std::mutex reporting_;
};

/// How far the views of a still reach to either side of the reference view. In films, whose paint follows noisy
/// disparities, points keep to their surface, as they do in what few views show.
ViewsBeside views_beside(std::span<const View> views) {
  ViewsBeside beside;
  for (const View& other : views) {
    beside.left = std::max(beside.left, views.front().position - other.position);
    beside.right = std::max(beside.right, other.position - views.front().position);
  }
  return beside;
}

std::int64_t living_strokes(const StrokeMemory& memory) {
  std::int64_t count = 0;
  for (const std::vector<TrackedLayer>& layers : memory.views)
    for (const TrackedLayer& tracked : layers)
      count += std::ranges::count_if(tracked.tracks, [](const StrokeTrack& track) { return track.ends == 0; });
  return count;
}

/// Brings all strokes to this frame, whose style may have another opacity.
void carry(const FilmFrame& frame, const Style& style, const CarryOptions& options, StrokeMemory& memory) {
  const ScaledStyle scaled(style, frame.views.front().colour.width());
  const float threshold_px = scaled.depth_threshold_px;
  const SceneMotion motion(frame, memory.reference_disparity, threshold_px);
  for (std::size_t i = 0; i < scaled.radii_px.size(); ++i) {
    std::vector<TrackedLayer*> layers;
    for (std::size_t view = 0; view < frame.views.size(); ++view) {
      layers.push_back(&memory.views[view][i]);
      for (Stroke& stroke : memory.views[view][i].layer.strokes) stroke.opacity = style.opacity;
      carry_layer(motion, frame.views[view], threshold_px, options, memory.views[view][i]);
      fade(options, memory.views[view][i]);
    }
    settle(frame.views, threshold_px, layers);
  }
}

/// Drops new strokes of the view `home` (numbers after `last_number`) that no view shows, because later they would
/// appear all at once. In films, also drops new strokes of other views that the reference view shows whole: it has
/// strokes of its own there, so that these would be dropped in the next frame, or begun again in every frame.
void drop_needless(std::span<const View> views, std::size_t home, std::uint32_t last_number, float depth_threshold_px,
                   bool is_film, TrackedLayer& tracked) {
  std::vector<std::uint8_t> shown(tracked.tracks.size());
  tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
    const Stroke& stroke = tracked.layer.strokes[i];
    if (home != 0 && is_film && stroke.number > last_number &&
        is_shown_whole(tracked.layer.points_of(stroke), stroke.radius_px, views[home].position,
                       {views.front(), depth_threshold_px}))
      return;
    shown[i] = stroke.number <= last_number ||
               std::ranges::any_of(tracked.layer.points_of(stroke), [&](const ControlPoint& point) {
                 return std::ranges::any_of(views, [&](const View& view) {
                   return is_visible(point, views[home].position, view, depth_threshold_px);
                 });
               });
  });
  keep_if(tracked, [&](std::size_t i) { return shown[i] != 0; });
}

/// Refines the colours of new strokes where the frame has more than 8 bits, and the style does not vary colours.
void refine_new(const FilmFrame& frame, const Style& style, StrokeMemory& memory) {
  if (frame.left_deep.empty() || style.jitter != ColourJitter{}) return;
  const DeepPicture picture{frame.left_deep, static_cast<float>(frame.left_deep.width()) /
                                                 static_cast<float>(frame.views.front().colour.width())};
  for (std::vector<TrackedLayer>& layers : memory.views)
    for (TrackedLayer& tracked : layers) refine_colours(picture, memory.last_number, tracked.layer);
}

/// Counts the new strokes and remembers their numbers.
std::int64_t count_new(StrokeMemory& memory) {
  std::int64_t count = 0;
  std::uint32_t last = memory.last_number;
  for (const std::vector<TrackedLayer>& layers : memory.views)
    for (const TrackedLayer& tracked : layers)
      for (const Stroke& stroke : tracked.layer.strokes)
        if (stroke.number > memory.last_number) {
          last = std::max(last, stroke.number);
          ++count;
        }
  memory.last_number = last;
  return count;
}

StrokePainting shown_painting(const FilmFrame& frame, const Style& style, const StrokeMemory& memory) {
  const ImageView<const Rgb8> picture = frame.views.front().colour;
  const ScaledStyle scaled(style, picture.width());
  StrokePainting painting{picture.width(),
                          picture.height(),
                          style.canvas_colour,
                          std::vector<Layer>(scaled.radii_px.size()),
                          style.background == Background::colour,
                          scaled.brush};
  tbb::parallel_for(std::size_t{0}, painting.layers.size(), [&](std::size_t i) {
    Layer& shown = painting.layers[i];
    shown.radius_px = scaled.radii_px[i];
    for (const std::vector<TrackedLayer>& view : memory.views) {
      const Layer& layer = view[i].layer;
      for (std::size_t k = 0; k < layer.strokes.size(); ++k) {
        Stroke stroke = layer.strokes[k];
        stroke.opacity *= view[i].tracks[k].shown;
        append_everywhere(stroke, layer.points_of(stroke), shown);
      }
    }
    put_in_order(shown, style);
  });
  return painting;
}

/// What is kept of each of a scene's views.
std::vector<ViewFit*> fits_of(std::span<const View> views, std::size_t layers, StrokeFits& fits) {
  std::vector<ViewFit*> of_views;
  for (const View& view : views) {
    const auto found = std::ranges::find_if(fits, [&](const std::shared_ptr<ViewFit>& fit) {
      return fit->view.position == view.position && std::ranges::find(of_views, fit.get()) == of_views.end();
    });
    ViewFit& fit = found != fits.end() ? **found : *fits.emplace_back(std::make_shared<ViewFit>());
    fit.view.position = view.position;
    fit.layers.resize(layers);
    of_views.push_back(&fit);
  }
  return of_views;
}

/// A view that owns its images.
View copy_of_view(const View& view) {
  View copy = view;
  copy.colour = copy_of<Rgb8>(view.colour);
  copy.disparity = copy_of<float>(view.disparity);
  copy.wanted = copy_of<std::uint8_t>(view.wanted);
  copy.detail = copy_of<std::uint8_t>(view.detail);
  return copy;
}

}  // namespace

CarriedPainting plan_strokes(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                             StrokeMemory& memory, const Progress& progress, StrokeFits* fits) {
  check_style(style);
  if (!is_of_strokes(style))
    throw Error(ErrorKind::wrong_usage, "style: its marks are not strokes, expected a style of strokes");
  const ScaledStyle scaled(style, frame.views.front().colour.width());
  const std::size_t layers = scaled.radii_px.size();
  const float depth_threshold_px = scaled.depth_threshold_px;
  const bool scene_begins = frame.flow == nullptr || memory.views.size() != frame.views.size();
  CarriedPainting result;
  if (scene_begins) {
    memory.views.assign(frame.views.size(), std::vector<TrackedLayer>(layers));
    memory.last_number = 0;
  } else {
    result.counts.before = living_strokes(memory);
    carry(frame, style, options, memory);
  }
  // The numbers of traced strokes depend on the strokes before them.
  std::vector<ViewFit*> kept;
  if (fits != nullptr && style.marks == Marks::fitted_strokes) kept = fits_of(frame.views, layers, *fits);
  std::vector<Layer> repairs(frame.views.size());
  ViewsPlan plan(progress, frame.views.front().colour, frame.views.size(), layers);
  plan.run([&](std::size_t view) {
    plan.report_step();
    const View& own = frame.views[view];
    ViewFit* const fit = kept.empty() ? nullptr : kept[view];
    const ViewsBeside beside = options.goes_on || view != 0 ? ViewsBeside() : views_beside(frame.views);
    const int reference_width = frame.views.front().colour.width();
    if (fit != nullptr && fit->holds(own, style, beside, reference_width)) {
      memory.views[view] = fit->planned;
    } else {
      const bool by_place = scene_begins && style.marks == Marks::fitted_strokes;
      StrokeNumbers numbers(memory.last_number, view, frame.views.size(), by_place);
      ViewPainter painter(own, frame.views.front(), style, scene_begins ? nullptr : &frame.flow->backward, beside,
                          numbers);
      // Little is fitted in views that no photograph shows, and much would be kept.
      const bool keeps_layers = fit != nullptr && !own.continued;
      for (std::size_t i = 0; i < layers; ++i) {
        painter.plan(static_cast<int>(i), options, memory.views[view][i],
                     keeps_layers ? std::span(fit->layers) : std::span<LayerFit>());
        plan.report_step();
      }
      if (fit != nullptr)
        *fit = {copy_of_view(own), style, beside, reference_width, std::move(fit->layers), memory.views[view]};
      if (!scene_begins) repairs[view] = painter.repairs();
    }
    for (TrackedLayer& tracked : memory.views[view]) {
      if (style.jitter == ColourJitter{}) drop_misplaced(own.position, frame.views, depth_threshold_px, tracked);
      drop_needless(frame.views, view, memory.last_number, depth_threshold_px, options.goes_on || !scene_begins,
                    tracked);
    }
  });
  refine_new(frame, style, memory);
  result.counts.begun = count_new(memory);
  result.counts.carried = living_strokes(memory) - result.counts.begun;
  if (options.goes_on) memory.reference_disparity = copy_of(frame.views.front().disparity);
  result.painting = shown_painting(frame, style, memory);
  for (const Layer& marks : repairs) append_strokes(marks, result.painting.layers.back());
  return result;
}

}  // namespace wheatstone
