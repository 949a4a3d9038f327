#include "wheatstone/strokes/strokes_in_time.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <span>

#include "wheatstone/drawing/rasterise.h"
#include "wheatstone/error.h"
#include "wheatstone/image/reduced_view.h"
#include "wheatstone/marks/resize_strokes.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/strokes/carried_points_internal.h"
#include "wheatstone/strokes/carry_strokes_internal.h"
#include "wheatstone/strokes/cover_bare_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/layer_planner.h"
#include "wheatstone/strokes/missing_strokes_internal.h"
#include "wheatstone/strokes/seed_internal.h"
#include "wheatstone/strokes/visible_runs_internal.h"

namespace wheatstone {
namespace {

/// New numbers for the strokes of one of a scene's views; those of the other views lie between them, so that all views
/// are planned at once.
class StrokeNumbers {
 public:
  StrokeNumbers(std::uint32_t last, std::size_t view, std::size_t views)
      : next_(last + 1 + static_cast<std::uint32_t>(view)), step_(static_cast<std::uint32_t>(views)) {}

  void give(Layer& layer) {
    for (Stroke& stroke : layer.strokes) {
      stroke.number = next_;
      next_ += step_;
    }
  }

 private:
  std::uint32_t next_, step_;
};

/// A view that is being painted: its planner, of a smaller size where only a part of the view is wanted.
class ViewAtWork {
 public:
  /// `motion` is the reference view's flow to the frame before; none where a scene begins.
  ViewAtWork(const SceneView& view, const SceneView& reference, const Style& style, const Flow* motion,
             StrokeNumbers& numbers)
      : part_(part_of(view, reference, style, motion == nullptr)),
        reduction_(part_ ? part_->reduction : 1),
        scaled_(style, view.picture.width(), static_cast<float>(reduction_)),
        style_(style),
        motion_(motion),
        left_px_(static_cast<float>(view.left_px)),
        uncovered_(view.continued ? view.only_here : ImageView<const std::uint8_t>()),
        numbers_(numbers),
        planner_(part_ ? part_->photograph.view() : view.picture, part_ ? part_->disparity.view() : view.disparity,
                 view.position, style) {
    planner_.avoid_mixed_colours = !part_;                // no other eye sees them
    if (view.continued) planner_.least_edge_cell_px = 3;  // of what no photograph shows, edges need no detail
  }

  /// Ends the carried strokes of a layer that do not fit the picture any more, and begins those that are missing.
  void plan(int layer, const CarryOptions& options, TrackedLayer& tracked) {
    if (planner_.photograph.empty()) return;
    const LayerInputs inputs = make_layer_inputs(planner_, style_, scaled_, layer);
    const ImageView<const std::uint8_t> part = part_ ? part_->seeds.view() : ImageView<const std::uint8_t>();
    Image<std::uint8_t> seeds;
    const std::size_t carried = tracked.tracks.size();
    const bool compares = options.goes_on || carried != 0;
    const Image<float> before = compares ? errors_left(inputs) : Image<float>();
    if (!tracked.tracks.empty()) {
      end_wrong_colours(inputs, before, options, tracked);
      draw_on_canvas(shown(tracked, [](const StrokeTrack& track) { return track.ends == 0; }));
    }
    const bool finest = layer + 1 == static_cast<int>(scaled_.radii_px.size());
    const Image<std::uint8_t> misplaced = finest ? misplaced_paint(planner_, style_) : Image<std::uint8_t>();
    if (!tracked.tracks.empty()) seeds = where_strokes_are_missing(inputs, before, misplaced, tracked);
    Layer begun = plan_on(planner_, inputs, style_, scaled_, {seeds.empty() ? part : seeds.view(), misplaced});
    numbers_.give(begun);
    sort_numbered_far_to_near(begun, style_.seed);
    add(begun, inputs, before, options, tracked);
    rasterise(finest ? strokes_near_bare(begun, planner_.canvas) : begun, planner_.view, hiding(), planner_.canvas);
    if (!finest) return;
    Layer dots = cover_bare(planner_, inputs, scaled_, style_, part);
    if (part_) append_strokes(dots_left_out({tracked, carried}), dots);
    numbers_.give(dots);
    add(std::move(dots), inputs, before, options, tracked);
  }

  /// Once all layers are planned: fading strokes whose paint the frame has nowhere near are gone at once.
  void drop_misplaced(std::span<TrackedLayer> layers) {
    if (part_) return;
    for (const TrackedLayer& tracked : layers)
      draw_on_canvas(shown(tracked, [](const StrokeTrack& track) { return track.ends != 0; }));
    const Image<std::uint8_t> misplaced = misplaced_paint(planner_, style_);
    if (misplaced.empty()) return;
    for (TrackedLayer& tracked : layers) {
      keep_if(tracked, [&](std::size_t i) {
        return tracked.tracks[i].ends == 0 ||
               std::ranges::none_of(tracked.layer.points_of(tracked.layer.strokes[i]), [&](const ControlPoint& point) {
                 const int x = static_cast<int>(std::floor(point.x)), y = static_cast<int>(std::floor(point.y));
                 return misplaced.contains(x, y) && misplaced(x, y) != 0;
               });
      });
    }
  }

 private:
  /// Half the size is enough for what an eye shows; what no eye shows is planned as small as its finest brush allows.
  static int reduction_for(const SceneView& view, float finest_radius_px) {
    constexpr int least = 2, most = 8;
    constexpr float least_radius_px = 1.5f;
    int reduction = least;
    while (view.continued && reduction < most &&
           finest_radius_px >= least_radius_px * static_cast<float>(2 * reduction))
      reduction *= 2;
    return reduction;
  }

  /// What a view alone shows. Grown at first, so that its strokes reach under those of the reference view; later those
  /// are there, and what they may show is theirs.
  static std::optional<ReducedView> part_of(const SceneView& view, const SceneView& reference, const Style& style,
                                            bool scene_begins) {
    if (view.only_here.empty()) return {};
    const ScaledStyle scaled(style, view.picture.width());
    const int reduction = reduction_for(view, scaled.radii_px.back());
    if (scene_begins) {
      const auto growth_px = static_cast<int>(std::lround(style.occlusion_dilation * scaled.radii_px.front()));
      return reduced(view.picture, view.disparity, dilate_occlusion(view.only_here, growth_px), reduction);
    }
    Image<std::uint8_t> alone(view.picture.width(), view.picture.height());
    tbb::parallel_for(0, alone.height(), [&](int y) {
      for (int x = 0; x < alone.width(); ++x) {
        if (view.only_here(x, y) == 0) continue;
        const ControlPoint point{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, view.disparity(x, y)};
        const float column = column_in(point, view, reference);
        const bool is_in_picture = column >= 0 && column < static_cast<float>(alone.width());
        alone(x, y) = is_in_picture && is_visible(point, view, reference, scaled.depth_threshold_px) ? 0 : 255;
      }
    });
    return reduced(view.picture, view.disparity, alone, reduction);
  }

  float depth_threshold_px() const { return scaled_.depth_threshold_px * static_cast<float>(reduction_); }

  ColourFit fit(const LayerInputs& inputs, const Image<float>& before, const Layer& layer, const Stroke& stroke) const {
    return colour_fit(
        layer.points_of(stroke), stroke.colour,
        {inputs.reference, before, planner_.disparity, static_cast<float>(reduction_), depth_threshold_px()});
  }

  /// True where a depth edge came under more than a quarter of a stroke's points, into the inner half of the brush.
  bool spills(const LayerInputs& inputs, const Layer& layer, const Stroke& stroke) const {
    if (inputs.edge_distance.empty()) return false;
    const std::span<const ControlPoint> points = layer.points_of(stroke);
    const auto reduction = static_cast<float>(reduction_);
    const float least_px = stroke.radius_px / reduction / 2 - 0.5f;
    const auto over_edge = std::ranges::count_if(points, [&](const ControlPoint& point) {
      const int column = static_cast<int>(point.x / reduction), row = static_cast<int>(point.y / reduction);
      return inputs.edge_distance.contains(column, row) && inputs.edge_distance(column, row) < least_px;
    });
    return 4 * static_cast<std::size_t>(over_edge) > points.size();
  }

  /// A stroke whose colour fits worse than at first, or that now makes the picture worse, has stayed behind.
  void end_wrong_colours(const LayerInputs& inputs, const Image<float>& before, const CarryOptions& options,
                         TrackedLayer& tracked) const {
    tbb::parallel_for(std::size_t{0}, tracked.tracks.size(), [&](std::size_t i) {
      StrokeTrack& track = tracked.tracks[i];
      if (track.ends != 0) return;
      const ColourFit now = fit(inputs, before, tracked.layer, tracked.layer.strokes[i]);
      if (now.difference <= track.first_colour_difference + options.colour_tolerance &&
          now.gain >= std::min(track.first_gain, 0.f) - options.gain_tolerance &&
          !spills(inputs, tracked.layer, tracked.layer.strokes[i]))
        return;
      // It fades from this frame on, which it does not belong to.
      track.ends = fading_frames(tracked.layer.strokes[i].radius_px, speed_at(tracked.layer, i), options);
      track.shown = std::max(track.shown - 1 / static_cast<float>(track.ends), 0.f);
    });
  }

  /// The strokes that `is_shown` holds for, as the planner's canvas is to have them.
  template <class IsShown>
  Layer shown(const TrackedLayer& tracked, IsShown is_shown) const {
    Layer layer{tracked.layer.radius_px, tracked.layer.points, {}};
    for (std::size_t i = 0; i < tracked.tracks.size(); ++i) {
      if (!is_shown(tracked.tracks[i])) continue;
      layer.strokes.push_back(tracked.layer.strokes[i]);
      layer.strokes.back().opacity *= tracked.tracks[i].shown;
    }
    sort_numbered_far_to_near(layer, style_.seed);
    return layer;
  }

  void draw_on_canvas(Layer layer) {
    if (part_) resize_strokes(layer, 1.f / static_cast<float>(reduction_));
    rasterise(layer, planner_.view, hiding(), planner_.canvas);
  }

  Hiding hiding() const { return {.surface = planner_.disparity, .tolerance_px = scaled_.depth_threshold_px}; }

  /// By how many pixels a frame the place of a stroke's first point moves.
  float speed_at(const Layer& layer, std::size_t stroke) const {
    const ControlPoint& first = layer.points[layer.strokes[stroke].first_point];
    const float x = first.x + left_px_;
    const float speed = std::hypot(sample(motion_->x.view(), x, first.y), sample(motion_->y.view(), x, first.y));
    return std::isfinite(speed) ? speed : 0;
  }

  /// Squared errors of what is painted so far; −1 where nothing is wanted.
  Image<float> errors_left(const LayerInputs& inputs) const {
    const int width = planner_.photograph.width(), height = planner_.photograph.height();
    Image<float> errors(width, height);
    tbb::parallel_for(0, height, [&](int y) {
      squared_errors(inputs.reference, planner_.canvas, {y, 0, width}, errors.row(y).data());
      if (!part_) return;
      for (int x = 0; x < width; ++x)
        if (part_->seeds(x, y) == 0) errors(x, y) = -1;
    });
    return errors;
  }

  /// 255 within half a cell of where a stroke begins that stays.
  Image<std::uint8_t> where_strokes_begin(const TrackedLayer& tracked, float cell_px) const {
    Image<std::uint8_t> begun(planner_.photograph.width(), planner_.photograph.height());
    const auto reduction = static_cast<float>(reduction_);
    for (std::size_t i = 0; i < tracked.tracks.size(); ++i) {
      if (tracked.tracks[i].ends != 0) continue;
      const Stroke& stroke = tracked.layer.strokes[i];
      const ControlPoint& first = tracked.layer.points[stroke.first_point];
      const bool edgeways = stroke.radius_px < tracked.layer.radius_px;
      const float reach = (edgeways ? 0.25f : 0.5f) * cell_px;
      // Where cells are narrower than a pixel, it is the pixel in which the stroke begins.
      const auto begin = [&](float place) {
        return std::max(static_cast<int>(std::min(std::round(place - reach), std::floor(place))), 0);
      };
      const auto end = [&](float place, int size) {
        return std::min(static_cast<int>(std::max(std::round(place + reach), std::floor(place) + 1)), size);
      };
      const float first_x = first.x / reduction, first_y = first.y / reduction;
      const int left = begin(first_x), right = end(first_x, begun.width());
      const int top = begin(first_y), bottom = end(first_y, begun.height());
      for (int y = top; y < bottom && left < right; ++y) std::fill_n(&begun(left, y), right - left, std::uint8_t{255});
    }
    return begun;
  }

  /// 255 where new strokes may begin: where carried ones do not do what painting anew would, on what they left bare,
  /// and on misplaced paint, but where one begins already.
  Image<std::uint8_t> where_strokes_are_missing(const LayerInputs& inputs, const Image<float>& before,
                                                ImageView<const std::uint8_t> misplaced,
                                                const TrackedLayer& tracked) const {
    const float cell_px = style_.grid * scaled_.radii_px[inputs.layer];
    const Image<float> after = errors_left(inputs);
    const Image<std::uint8_t> begun = where_strokes_begin(tracked, cell_px);
    Image<std::uint8_t> seeds = missing_strokes({before, after, begun, inputs.depth_edges, cell_px, style_.threshold});
    const float squared_threshold = style_.threshold * style_.threshold;
    tbb::parallel_for(0, seeds.height(), [&](int y) {
      for (int x = 0; x < seeds.width(); ++x) {
        if (planner_.canvas.coverage(x, y) < 0.5f) seeds(x, y) = before(x, y) > squared_threshold ? 255 : 0;
        const bool may_begin = before(x, y) >= 0 && begun(x, y) == 0;
        if (may_begin && !misplaced.empty() && misplaced(x, y) != 0) seeds(x, y) = 255;
      }
    });
    return seeds;
  }

  /// Dots for the thin edges of near surfaces that the smaller picture does not show, but where carried strokes have a
  /// point already. Around what no photograph shows, those surfaces have strokes of their own.
  Layer dots_left_out(const CarriedPoints& carried) const {
    const auto reduction = static_cast<float>(reduction_);
    Layer dots{scaled_.radii_px.back(), {}, {}};
    for (const ReducedView::LeftOut& pixels : part_->left_out) {
      if (!uncovered_.empty() && uncovered_(static_cast<int>(pixels.x), static_cast<int>(pixels.y)) == 0) continue;
      if (carried.any_at({pixels.x, pixels.y, pixels.disparity}, depth_threshold_px())) continue;
      const ControlPoint point{pixels.x / reduction, pixels.y / reduction, pixels.disparity / reduction};
      dots.strokes.push_back({.first_point = static_cast<std::uint32_t>(dots.points.size()),
                              .point_count = 1,
                              .radius_px = 1 / reduction,
                              .opacity = style_.opacity,
                              .colour = pixels.colour,
                              .disparity = point.disparity,
                              .reference_view = planner_.view,
                              .views = all_views});
      dots.points.push_back(point);
    }
    return dots;
  }

  void add(Layer begun, const LayerInputs& inputs, const Image<float>& before, const CarryOptions& options,
           TrackedLayer& tracked) const {
    if (part_) resize_strokes(begun, static_cast<float>(reduction_));
    tracked.layer.radius_px = begun.radius_px;
    for (const Stroke& stroke : begun.strokes) {
      StrokeTrack& track = tracked.tracks.emplace_back();
      track.shown = first_shown(motion_ == nullptr, options);
      if (!options.goes_on) continue;
      track.first_length_px = length_px(begun.points_of(stroke));
      const ColourFit first = fit(inputs, before, begun, stroke);
      track.first_colour_difference = first.difference;
      track.first_gain = first.gain;
    }
    append_strokes(begun, tracked.layer);
  }

  std::optional<ReducedView> part_;
  int reduction_;
  ScaledStyle scaled_;
  const Style& style_;
  const Flow* motion_;
  float left_px_;
  ImageView<const std::uint8_t> uncovered_;  ///< what no photograph shows, of a view that goes on there
  StrokeNumbers& numbers_;
  LayerPlanner planner_;
};

/// Plans the views at once and tells of each layer. What `progress` throws in one view is thrown when both have ended:
/// the loops of the other would be cancelled, and it would go on with what they have not done.
class ViewsPlan {
 public:
  ViewsPlan(const Progress& progress, std::size_t views, std::size_t layers)
      : progress_(progress), thrown_(views), steps_(views * (layers + 1)) {}

  /// Calls `plan(view)` for all views.
  template <class Plan>
  void run(Plan plan) {
    tbb::parallel_for(std::size_t{0}, thrown_.size(), [&](std::size_t view) {
      try {
        plan(view);
      } catch (...) {
        thrown_[view] = std::current_exception();
      }
    });
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
  std::size_t steps_;
  std::size_t done_ = 0;
  std::mutex reporting_;
};

std::int64_t living_strokes(const StrokeMemory& memory) {
  std::int64_t count = 0;
  for (const std::vector<TrackedLayer>& layers : memory.views)
    for (const TrackedLayer& tracked : layers)
      count += std::ranges::count_if(tracked.tracks, [](const StrokeTrack& track) { return track.ends == 0; });
  return count;
}

/// Brings all strokes to this frame.
void carry(const FilmFrame& frame, const Style& style, const CarryOptions& options, StrokeMemory& memory) {
  const ScaledStyle scaled(style, frame.views.front().picture.width());
  const float threshold_px = scaled.depth_threshold_px;
  const SceneMotion motion(frame, memory.reference_disparity, threshold_px);
  for (std::size_t i = 0; i < scaled.radii_px.size(); ++i) {
    std::vector<TrackedLayer*> layers;
    for (std::size_t view = 0; view < frame.views.size(); ++view) {
      layers.push_back(&memory.views[view][i]);
      carry_layer(motion, frame.views[view], threshold_px, options, memory.views[view][i]);
      fade(options, memory.views[view][i]);
    }
    settle(frame.views, threshold_px, layers);
  }
}

/// New strokes of the view `home`, those with numbers after `last_number`, that no view shows are dropped: they would
/// come up later at once. So are those of other views that the reference view shows whole, once it has strokes of its
/// own: they would go over to it, and be begun again in every frame.
void drop_needless(const FilmFrame& frame, std::size_t home, std::uint32_t last_number, float depth_threshold_px,
                   TrackedLayer& tracked) {
  std::vector<std::uint8_t> shown(tracked.tracks.size());
  tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
    const Stroke& stroke = tracked.layer.strokes[i];
    if (home != 0 && frame.flow != nullptr && stroke.number > last_number &&
        is_shown_whole(tracked.layer.points_of(stroke), stroke.radius_px / 2, frame.views[home],
                       {frame.views.front(), depth_threshold_px}))
      return;
    shown[i] = stroke.number <= last_number ||
               std::ranges::any_of(tracked.layer.points_of(stroke), [&](const ControlPoint& point) {
                 return std::ranges::any_of(frame.views, [&](const SceneView& view) {
                   return is_visible(point, frame.views[home], view, depth_threshold_px);
                 });
               });
  });
  keep_if(tracked, [&](std::size_t i) { return shown[i] != 0; });
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
  const ImageView<const Rgb8> picture = frame.views.front().picture;
  const ScaledStyle scaled(style, picture.width());
  StrokePainting painting{picture.width(), picture.height(), style.canvas_colour,
                          std::vector<Layer>(scaled.radii_px.size()), style.background == Background::colour};
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
    sort_numbered_far_to_near(shown, style.seed);
  });
  return painting;
}

}  // namespace

CarriedPainting plan_strokes(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                             StrokeMemory& memory, const Progress& progress) {
  check_style(style);
  if (style.marks != Marks::strokes)
    throw Error(ErrorKind::wrong_usage, "style: its marks are not strokes, expected a style of strokes");
  const std::size_t layers = style.radii_px.size();
  const float depth_threshold_px = ScaledStyle(style, frame.views.front().picture.width()).depth_threshold_px;
  const bool scene_begins = frame.flow == nullptr || memory.views.size() != frame.views.size();
  CarriedPainting result;
  if (scene_begins) {
    memory.views.assign(frame.views.size(), std::vector<TrackedLayer>(layers));
  } else {
    result.counts.before = living_strokes(memory);
    carry(frame, style, options, memory);
  }
  ViewsPlan plan(progress, frame.views.size(), layers);
  plan.run([&](std::size_t view) {
    plan.report_step();
    StrokeNumbers numbers(memory.last_number, view, frame.views.size());
    ViewAtWork work(frame.views[view], frame.views.front(), style, scene_begins ? nullptr : &frame.flow->backward,
                    numbers);
    for (std::size_t i = 0; i < layers; ++i) {
      work.plan(static_cast<int>(i), options, memory.views[view][i]);
      plan.report_step();
    }
    if (!scene_begins) work.drop_misplaced(memory.views[view]);
    for (TrackedLayer& tracked : memory.views[view])
      drop_needless(frame, view, memory.last_number, depth_threshold_px, tracked);
  });
  result.counts.begun = count_new(memory);
  result.counts.carried = living_strokes(memory) - result.counts.begun;
  if (options.goes_on) {
    const ImageView<const float> disparity = frame.views.front().disparity;
    memory.reference_disparity = Image<float>(disparity.width(), disparity.height());
    for (int y = 0; y < disparity.height(); ++y)
      std::ranges::copy(disparity.row(y), memory.reference_disparity.row(y).begin());
  }
  result.painting = shown_painting(frame, style, memory);
  return result;
}

}  // namespace wheatstone
