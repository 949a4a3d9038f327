#include "wheatstone/strokes/strokes_in_time.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "wheatstone/drawing/rasterise.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/residual.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/view_scale.h"
#include "wheatstone/strokes/bare_pixels_internal.h"
#include "wheatstone/strokes/carried_points_internal.h"
#include "wheatstone/strokes/carry_strokes_internal.h"
#include "wheatstone/strokes/fit_stroke_internal.h"
#include "wheatstone/strokes/handed_back_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/misplaced_strokes_internal.h"
#include "wheatstone/strokes/missing_strokes_internal.h"
#include "wheatstone/strokes/refit_internal.h"
#include "wheatstone/strokes/repair.h"
#include "wheatstone/strokes/seed_internal.h"
#include "wheatstone/strokes/view_to_plan_internal.h"
#include "wheatstone/strokes/visible_runs_internal.h"

namespace wheatstone {
namespace {

/// New numbers for the strokes of one of a scene's views; those of the other views lie between them, so that all views
/// are planned at once. Fitted strokes that begin a scene are numbered by place: however a still is planned again, a
/// stroke that does not change keeps its bristles. Later frames would use up the numbers.
class StrokeNumbers {
 public:
  StrokeNumbers(std::uint32_t last, std::size_t view, std::size_t views, bool by_place)
      : by_place_(by_place),
        next_(last + 1 + static_cast<std::uint32_t>(view)),
        step_(static_cast<std::uint32_t>(by_place ? std::max(views, views_of_still) : views)) {}

  /// The strokes' numbers are those of their places, from 1 to `places`.
  void give(std::uint32_t places, Layer& layer) {
    for (std::uint32_t i = 0; Stroke & stroke : layer.strokes)
      stroke.number = next_ + step_ * (by_place_ ? stroke.number - 1 : i++);
    next_ += step_ * (by_place_ ? places : static_cast<std::uint32_t>(layer.strokes.size()));
  }

 private:
  static constexpr std::size_t views_of_still = 8;  ///< at least as many as a scene of two photographs has

  bool by_place_;
  std::uint32_t next_, step_;
};

/// Gives dots the number of the pixel that they cover.
void number_by_pixel(int width, Layer& dots) {
  for (Stroke& dot : dots.strokes) {
    const ControlPoint& at = dots.points[dot.first_point];
    dot.number = 1 + static_cast<std::uint32_t>(static_cast<int>(at.y) * width + static_cast<int>(at.x));
  }
}

/// Paints one view of a frame, layer by layer; in smaller pictures where the brush is wide, or only a part is wanted.
class ViewPainter {
 public:
  /// `motion` is the reference view's flow to the frame before; none where a scene begins. `beside`: from which views
  /// its strokes will be seen.
  ViewPainter(const View& view, const View& reference, const Style& style, const Flow* motion,
              const ViewsBeside& beside, StrokeNumbers& numbers)
      : part_(wanted_part(view, reference, style, motion == nullptr)),
        view_(view_to_plan(part_, reference, style)),
        reference_width_(reference.colour.width()),
        radii_px_(ScaledStyle(style, reference_width_).radii_px),
        style_(style),
        motion_(motion),
        beside_(beside),
        uncovered_(view.continued ? view.wanted : SharedImage<std::uint8_t>()),
        numbers_(numbers) {}
  ViewPainter(const ViewPainter&) = delete;
  ViewPainter& operator=(const ViewPainter&) = delete;
  ~ViewPainter() { give_back_canvas(); }  // to fits, which must still be there

  /// Ends the carried strokes of a layer that do not fit the picture any more, and begins those that are missing.
  /// `fits`: what is kept of all layers; none: nothing is.
  void plan(int layer, const CarryOptions& options, TrackedLayer& tracked, std::span<LayerFit> fits) {
    LayerFit* const fit = fits.empty() ? nullptr : &fits[static_cast<std::size_t>(layer)];
    go_to_size(factor_for(layer), fit);
    if (at_->view.colour.empty()) return;
    LayerPlan plan = make_layer_plan(*at_, style_, layer, fit);
    Image<std::uint8_t> seeds;
    const std::size_t carried = tracked.tracks.size();
    const bool compares = options.goes_on || carried != 0;
    const Image<float> before = compares ? errors_left(plan) : Image<float>();
    const bool finest = layer + 1 == static_cast<int>(radii_px_.size());
    std::optional<Canvas> below;
    if (carried != 0 && !finest) below = at_->canvas;
    if (carried != 0) {
      end_wrong_colours(plan, before, options, tracked);
      draw_on_canvas(with_opacities(tracked, [&](std::size_t i) { return standing(tracked.tracks[i]); }), layer);
    }
    Image<std::uint8_t> misplaced = finest ? misplaced_paint(*at_, style_) : Image<std::uint8_t>();
    plan.misplaced = misplaced;
    if (carried != 0) {
      seeds = where_strokes_are_missing(plan, before, tracked);
      plan.seeds = seeds;
    }
    Layer begun = plan_layer(plan);
    if (fit != nullptr) fit->weights = std::move(plan.weights);
    numbers_.give(fitted_places(plan), begun);
    put_in_order(begun, style_);
    add(begun, plan, before, options, tracked);
    if (below && !begun.strokes.empty()) {
      // New strokes lie among the carried ones; finer layers mend the parts that carried strokes hide.
      at_->canvas = std::move(*below);
      draw_on_canvas(
          with_opacities(tracked, [&](std::size_t i) { return i < carried ? standing(tracked.tracks[i]) : 1; }), layer);
      return;
    }
    if (fit != nullptr) {
      if (!finest) draw_again(begun, layer, fits);
      // The first layer begins on a canvas that is made anew.
      if (layer == 0)
        fit->drawing.differs.clear();
      else
        std::ranges::fill(fit->drawing.differs, std::uint8_t{0});
    } else if (!finest) {
      rasterise(begun, at_->view.position, hiding(), at_->canvas, cover_of_brush(layer));
    }
    if (!finest) return;
    cover_bare(plan, begun, carried, before, options, tracked);
    misplaced_ = std::move(misplaced);
  }

  /// To be called once all layers are planned. Returns marks for this frame alone, where the carried strokes show a
  /// colour that the frame has nowhere near. New strokes there may lie under the carried ones, and appear slowly.
  Layer repairs() {
    if (!is_whole() || misplaced_.empty() || view_.colour.width() < least_repaired_width_px) return {};
    remove_occlusion_specks(misplaced_, least_repaired_px);
    return repair({{view_.colour, misplaced_, view_.disparity, view_.position, view_.position}, at_->scaled}, style_);
  }

 private:
  bool is_whole() const { return view_.wanted.empty(); }

  int factor_for(int layer) const {
    // Places that the ground leaves bare would show between finer strokes. At the beginning of a scene all traced
    // strokes are new, so that a few less exact ones would show.
    const bool fitted = style_.marks == Marks::fitted_strokes;
    const float least_radius_px = fitted ? (layer == 0 ? 5 : 2.5f) : motion_ == nullptr ? 12 : 6;
    const auto number = static_cast<std::size_t>(layer);
    const bool is_finest = number + 1 == radii_px_.size();
    return is_finest ? 1 : factor_for_layer(view_, radii_px_[number], least_radius_px);
  }

  void go_to_size(int factor, LayerFit* fit) {
    if (at_ && at_->view.frame.scale == view_.frame.scale * factor) return;
    const View view = smaller_view(view_, factor);
    if (at_) {
      const int enlarged = at_->view.frame.scale / view.frame.scale;
      const int width = view.colour.width(), height = view.colour.height();
      Canvas canvas = fit == nullptr ? larger_canvas(at_->canvas, enlarged, width, height)
                                     : enlarge_again(at_->canvas, enlarged, width, height, fit->drawing);
      give_back_canvas();
      if (fit != nullptr) owner_of_canvas_ = &fit->drawing.begun;
      at_.emplace(view, style_, reference_width_, std::move(canvas));
    } else {
      at_.emplace(view, style_, reference_width_);
    }
    at_->beside = beside_;
  }

  void give_back_canvas() {
    if (owner_of_canvas_ != nullptr) *std::exchange(owner_of_canvas_, nullptr) = std::move(at_->canvas);
  }

  /// Goes on to the canvas that the layer's strokes are painted on.
  void draw_again(const Layer& strokes, int layer, std::span<LayerFit> fits) {
    LayerDrawing& drawing = fits[static_cast<std::size_t>(layer)].drawing;
    wheatstone::draw_again(strokes, at_->canvas, at_->view.position, hiding(), cover_of_brush(layer), drawing);
    const int factor = factor_for(layer), next_factor = factor_for(layer + 1);
    pass_on(drawing.differs, factor / next_factor, view_.colour.height() / next_factor,
            fits[static_cast<std::size_t>(layer) + 1].drawing.differs);
    Canvas painted = std::move(*std::exchange(drawing.painted, {}));
    give_back_canvas();
    at_->canvas = std::move(painted);
    owner_of_canvas_ = &drawing.painted;
  }

  /// Covers the pixels that the finest strokes leave bare; nothing is planned over the pixels that they paint.
  void cover_bare(const LayerPlan& plan, const Layer& begun, std::size_t carried, const Image<float>& before,
                  const CarryOptions& options, TrackedLayer& tracked) {
    const View& view = at_->view;
    Image<std::uint8_t> bare = bare_pixels(at_->canvas, view.wanted);
    const Layer near = strokes_near_bare(begun, bare);
    bare = left_bare(near, view.position, hiding(), std::move(bare), cover_of_brush(plan.layer));
    Layer dots = repair({.target = {.picture = view.colour,
                                    .places = bare,
                                    .disparity = view.disparity,
                                    .view = view.position,
                                    .reference_view = view.position},
                         .scaled = at_->scaled,
                         .mixed_colours = plan.mixed_colours},
                        style_);
    if (!is_whole()) append_strokes(new_dots_left_out({tracked, carried}), dots);
    number_by_pixel(view.colour.width(), dots);
    numbers_.give(static_cast<std::uint32_t>(view.colour.width() * view.colour.height()), dots);
    add(std::move(dots), plan, before, options, tracked);
  }

  /// True where a depth edge came under more than a quarter of a stroke's points, into the inner half of the brush.
  static bool spills(const LayerPlan& plan, const Layer& layer, const Stroke& stroke) {
    if (plan.edge_distance.empty()) return false;
    const std::span<const ControlPoint> points = layer.points_of(stroke);
    const float least_px = stroke.radius_px / 2 - 0.5f;
    const auto over_edge = std::ranges::count_if(points, [&](const ControlPoint& point) {
      const int column = static_cast<int>(point.x), row = static_cast<int>(point.y);
      return plan.edge_distance.contains(column, row) && plan.edge_distance(column, row) < least_px;
    });
    return 4 * static_cast<std::size_t>(over_edge) > points.size();
  }

  /// Lets strokes end that have not followed the motion: their colour fits worse than at first, or they make the
  /// picture worse.
  void end_wrong_colours(const LayerPlan& plan, const Image<float>& before, const CarryOptions& options,
                         TrackedLayer& tracked) const {
    Layer in_view = tracked.layer;
    take_in(at_->view.frame, in_view);
    tbb::parallel_for(std::size_t{0}, tracked.tracks.size(), [&](std::size_t i) {
      StrokeTrack& track = tracked.tracks[i];
      if (track.ends != 0) return;
      const Stroke& stroke = in_view.strokes[i];
      const ColourFit now = colour_fit(in_view.points_of(stroke), stroke.colour, *at_, *plan.reference, before);
      if (now.difference <= track.first_colour_difference + options.colour_tolerance &&
          now.gain >= std::min(track.first_gain, 0.f) - options.gain_tolerance && !spills(plan, in_view, stroke))
        return;
      // The stroke does not belong to this frame, so it begins to fade in it already.
      track.ends = fading_frames(tracked.layer.strokes[i].radius_px, speed_at(tracked.layer, i), options);
      track.shown = std::max(track.shown - 1 / static_cast<float>(track.ends), 0.f);
    });
  }

  /// The share of a stroke's opacity that counts on the canvas: 0 for strokes that fade out.
  static float standing(const StrokeTrack& track) { return track.ends == 0 ? track.shown : 0; }

  /// The strokes in their order, each with a share of its opacity; those with none are left out.
  template <class ShareOf>
  Layer with_opacities(const TrackedLayer& tracked, ShareOf share_of) const {
    Layer layer{tracked.layer.radius_px, tracked.layer.points, {}};
    for (std::size_t i = 0; i < tracked.tracks.size(); ++i) {
      const float share = share_of(i);
      if (share <= 0) continue;
      layer.strokes.push_back(tracked.layer.strokes[i]);
      layer.strokes.back().opacity *= share;
    }
    put_in_order(layer, style_);
    return layer;
  }

  void draw_on_canvas(Layer strokes, int layer) {
    take_in(at_->view.frame, strokes);
    rasterise(strokes, at_->view.position, hiding(), at_->canvas, cover_of_brush(layer));
  }

  /// Places that the brush leaves bare matter to the strokes over them; the brush's streaks are not an error.
  Brush cover_of_brush(int layer) const {
    const Brush& brush = at_->scaled.brush;
    Brush of_layer = layer > 0 ? brush : ground_brush(brush);
    of_layer.streaks = of_layer.ridge = 0;
    return of_layer;
  }

  Hiding hiding() const { return {.surface = at_->view.disparity, .tolerance_px = at_->scaled.depth_threshold_px}; }

  /// By how many pixels a frame the place of a stroke's first point moves.
  float speed_at(const Layer& layer, std::size_t stroke) const {
    const ControlPoint& first = layer.points[layer.strokes[stroke].first_point];
    const float speed =
        std::hypot(sample(motion_->x.view(), first.x, first.y), sample(motion_->y.view(), first.x, first.y));
    return std::isfinite(speed) ? speed : 0;
  }

  /// Squared errors of what is painted so far; −1 where nothing is wanted.
  Image<float> errors_left(const LayerPlan& plan) const {
    const View& view = plan.view;
    const int width = view.colour.width(), height = view.colour.height();
    Image<float> errors(width, height);
    tbb::parallel_for(0, height, [&](int y) {
      squared_errors(*plan.reference, plan.canvas, {y, 0, width}, errors.row(y).data());
      if (view.wanted.empty()) return;
      for (int x = 0; x < width; ++x)
        if (view.wanted(x, y) == 0) errors(x, y) = -1;
    });
    return errors;
  }

  /// 255 within half a cell of the beginning of each stroke that stays.
  Image<std::uint8_t> where_strokes_begin(const TrackedLayer& tracked, float cell_px) const {
    const ViewFrame& frame = at_->view.frame;
    Image<std::uint8_t> begun(at_->view.colour.width(), at_->view.colour.height());
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
      const float first_x = frame.column(first.x), first_y = frame.row(first.y);
      const int left = begin(first_x), right = end(first_x, begun.width());
      const int top = begin(first_y), bottom = end(first_y, begun.height());
      for (int y = top; y < bottom && left < right; ++y) std::fill_n(&begun(left, y), right - left, std::uint8_t{255});
    }
    return begun;
  }

  /// 255 where new strokes may begin: where painting anew would begin one and carried strokes do not replace it, where
  /// carried strokes leave pixels bare, and on misplaced paint except where a stroke begins already.
  Image<std::uint8_t> where_strokes_are_missing(const LayerPlan& plan, const Image<float>& before,
                                                const TrackedLayer& tracked) const {
    const float cell_px = style_.grid * plan.radius_px;
    const Image<float> after = errors_left(plan);
    const Image<std::uint8_t> begun = where_strokes_begin(tracked, cell_px);
    Image<std::uint8_t> seeds = missing_strokes({before, after, begun, plan.depth_edges, cell_px, style_.threshold});
    const float squared_threshold = style_.threshold * style_.threshold;
    tbb::parallel_for(0, seeds.height(), [&](int y) {
      for (int x = 0; x < seeds.width(); ++x) {
        if (plan.canvas.coverage(x, y) < 0.5f) seeds(x, y) = before(x, y) > squared_threshold ? 255 : 0;
        const bool may_begin = before(x, y) >= 0 && begun(x, y) == 0;
        if (may_begin && !plan.misplaced.empty() && plan.misplaced(x, y) != 0) seeds(x, y) = 255;
      }
    });
    return seeds;
  }

  /// Dots for the thin edges of near surfaces that the smaller picture does not show, except where carried strokes have
  /// a point already. Around parts that no photograph shows, these surfaces have their own strokes.
  Layer new_dots_left_out(const CarriedPoints& carried) const {
    Layer dots = dots_left_out(part_, view_), whole = dots;
    hand_back(view_.frame, whole);
    const float depth_threshold_px = at_->scaled.depth_threshold_px * static_cast<float>(view_.frame.scale);
    const auto factor = static_cast<float>(view_.frame.scale) / static_cast<float>(part_.frame.scale);
    std::erase_if(dots.strokes, [&](const Stroke& dot) {
      const ControlPoint& point = dots.points[dot.first_point];
      const bool is_photographed = !uncovered_.empty() && uncovered_(static_cast<int>(point.x * factor),
                                                                     static_cast<int>(point.y * factor)) == 0;
      return is_photographed || carried.any_at(whole.points[dot.first_point], depth_threshold_px);
    });
    for (Stroke& dot : dots.strokes) dot.opacity = style_.opacity;
    return dots;
  }

  void add(Layer begun, const LayerPlan& plan, const Image<float>& before, const CarryOptions& options,
           TrackedLayer& tracked) const {
    for (const Stroke& stroke : begun.strokes) {
      StrokeTrack& track = tracked.tracks.emplace_back();
      track.shown = first_shown(motion_ == nullptr, options);
      if (!options.goes_on) continue;
      const ColourFit first = colour_fit(begun.points_of(stroke), stroke.colour, *at_, *plan.reference, before);
      track.first_length_px = length_px(begun.points_of(stroke)) * static_cast<float>(plan.view.frame.scale);
      track.first_colour_difference = first.difference;
      track.first_gain = first.gain;
    }
    hand_back(plan.view.frame, begun);
    tracked.layer.radius_px = begun.radius_px;
    append_strokes(begun, tracked.layer);
  }

  View part_;  ///< what is wanted of the view
  View view_;  ///< the same, in the pixels in which the finest layer is planned
  int reference_width_;
  std::vector<float> radii_px_;  ///< in the reference view's pixels
  const Style& style_;
  const Flow* motion_;
  ViewsBeside beside_;
  SharedImage<std::uint8_t> uncovered_;  ///< what no photograph shows, of a view that goes on there
  StrokeNumbers& numbers_;
  std::optional<ViewOnCanvas> at_;
  std::optional<Canvas>* owner_of_canvas_ = nullptr;  ///< where the canvas is kept between times; none: it is not kept
  Image<std::uint8_t> misplaced_;                     ///< as misplaced_paint, of the carried strokes
};

/// Plans the views at once and tells of each layer. An exception that `progress` throws in one view is thrown again
/// when all views have ended: otherwise the loops of the other views would be cancelled, and these would go on with
/// unfinished results.
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
/// appear all at once. Also drops new strokes of other views that the reference view shows whole, once it has strokes
/// of its own: they would pass to the reference view, and be begun again in every frame.
void drop_needless(const FilmFrame& frame, std::size_t home, std::uint32_t last_number, float depth_threshold_px,
                   TrackedLayer& tracked) {
  std::vector<std::uint8_t> shown(tracked.tracks.size());
  tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
    const Stroke& stroke = tracked.layer.strokes[i];
    if (home != 0 && frame.flow != nullptr && stroke.number > last_number &&
        is_shown_whole(tracked.layer.points_of(stroke), stroke.radius_px / 2, frame.views[home].position,
                       {frame.views.front(), depth_threshold_px}))
      return;
    shown[i] = stroke.number <= last_number ||
               std::ranges::any_of(tracked.layer.points_of(stroke), [&](const ControlPoint& point) {
                 return std::ranges::any_of(frame.views, [&](const View& view) {
                   return is_visible(point, frame.views[home].position, view, depth_threshold_px);
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
  ViewsPlan plan(progress, frame.views.size(), layers);
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
      drop_needless(frame, view, memory.last_number, depth_threshold_px, tracked);
    }
  });
  result.counts.begun = count_new(memory);
  result.counts.carried = living_strokes(memory) - result.counts.begun;
  if (options.goes_on) memory.reference_disparity = copy_of(frame.views.front().disparity);
  result.painting = shown_painting(frame, style, memory);
  for (const Layer& marks : repairs) append_strokes(marks, result.painting.layers.back());
  return result;
}

}  // namespace wheatstone
