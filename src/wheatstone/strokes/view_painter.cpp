#include "wheatstone/strokes/view_painter_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/marks/residual.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/view_scale.h"
#include "wheatstone/strokes/bare_pixels_internal.h"
#include "wheatstone/strokes/begun_canvas_internal.h"
#include "wheatstone/strokes/carry_strokes_internal.h"
#include "wheatstone/strokes/fit_stroke_internal.h"
#include "wheatstone/strokes/handed_back_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/misplaced_strokes_internal.h"
#include "wheatstone/strokes/missing_strokes_internal.h"
#include "wheatstone/strokes/repair.h"
#include "wheatstone/strokes/seed_internal.h"

namespace wheatstone {
namespace {

/// Gives dots the number of the pixel that they cover.
void number_by_pixel(int width, Layer& dots) {
  for (Stroke& dot : dots.strokes) {
    const ControlPoint& at = dots.points[dot.first_point];
    dot.number = 1 + static_cast<std::uint32_t>(static_cast<int>(at.y) * width + static_cast<int>(at.x));
  }
}

/// True where a depth edge came under more than a quarter of a stroke's points, into the inner half of the brush.
bool spills(const LayerPlan& plan, const Layer& layer, const Stroke& stroke) {
  if (plan.edge_distance.empty()) return false;
  const std::span<const ControlPoint> points = layer.points_of(stroke);
  const float least_px = stroke.radius_px / 2 - 0.5f;
  const auto over_edge = std::ranges::count_if(points, [&](const ControlPoint& point) {
    const int column = static_cast<int>(point.x), row = static_cast<int>(point.y);
    return plan.edge_distance.contains(column, row) && plan.edge_distance(column, row) < least_px;
  });
  return 4 * static_cast<std::size_t>(over_edge) > points.size();
}

/// The share of a stroke's opacity that counts on the canvas: 0 for strokes that fade out.
float standing(const StrokeTrack& track) { return track.ends == 0 ? track.shown : 0; }

/// The strokes in their order, each with a share of its opacity; those with none are left out.
template <class ShareOf>
Layer with_opacities(const TrackedLayer& tracked, const Style& style, ShareOf share_of) {
  Layer layer{tracked.layer.radius_px, tracked.layer.points, {}};
  for (std::size_t i = 0; i < tracked.tracks.size(); ++i) {
    const float share = share_of(i);
    if (share <= 0) continue;
    layer.strokes.push_back(tracked.layer.strokes[i]);
    layer.strokes.back().opacity *= share;
  }
  put_in_order(layer, style);
  return layer;
}

}  // namespace

ViewPainter::ViewPainter(const View& view, const View& reference, const Style& style, const Flow* motion,
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

ViewPainter::~ViewPainter() { give_back_canvas(); }  // to fits, which must still be there

void ViewPainter::plan(int layer, const CarryOptions& options, TrackedLayer& tracked, std::span<LayerFit> fits) {
  LayerFit* const fit = fits.empty() ? nullptr : &fits[static_cast<std::size_t>(layer)];
  const std::size_t carried = tracked.tracks.size();
  const bool compares = options.goes_on || carried != 0;
  const bool finest = is_finest(layer);
  // The same for all layers of a view: a canvas that stays small in one is small in the next.
  const bool is_new = motion_ == nullptr && !options.goes_on && fit == nullptr;
  const bool stays_small = is_new && needs_no_whole_canvas(layer);
  go_to_size(factor_for(layer), fit, stays_small);
  if (at_->view.colour.empty()) return;
  LayerPlan plan = make_layer_plan(*at_, style_, layer, fit);
  Image<std::uint8_t> seeds;
  const Image<float> before = compares ? errors_left(plan) : Image<float>();
  std::optional<Canvas> below;
  if (carried != 0 && !finest) below = at_->canvas;
  if (carried != 0) {
    end_wrong_colours(plan, before, options, tracked);
    draw_on_canvas(with_opacities(tracked, style_, [&](std::size_t i) { return standing(tracked.tracks[i]); }), layer);
  }
  Image<std::uint8_t> misplaced = finest ? misplaced_paint(*at_, style_) : Image<std::uint8_t>();
  plan.misplaced = misplaced;
  if (carried != 0) {
    seeds = where_strokes_are_missing(plan, before, tracked);
    plan.seeds = seeds;
  }
  Image<std::uint8_t> bare = finest ? bare_pixels(at_->begun(), at_->view.wanted) : Image<std::uint8_t>();
  Layer begun = finest && stays_small ? plan_last(plan) : plan_layer(plan);
  numbers_.give(fitted_places(plan), begun);
  put_in_order(begun, style_);
  add(begun, plan, before, options, tracked);
  if (below && !begun.strokes.empty()) {
    // New strokes lie among the carried ones; finer layers mend the parts that carried strokes hide.
    at_->canvas = std::move(*below);
    draw_on_canvas(
        with_opacities(tracked, style_, [&](std::size_t i) { return i < carried ? standing(tracked.tracks[i]) : 1; }),
        layer);
    return;
  }
  if (fit != nullptr) {
    if (!finest) draw_again(begun, layer, fits);
    // The first layer begins on a canvas that is made anew.
    if (layer == 0)
      fit->drawing.differs.clear();
    else
      std::ranges::fill(fit->drawing.differs, std::uint8_t{0});
  } else if (!finest && at_->canvas_factor > 1) {
    at_->to_draw = {std::move(begun), at_->view.position, hiding(), cover_of_brush(layer)};
    return;
  } else if (!finest) {
    rasterise(begun, at_->view.position, hiding(), at_->canvas, cover_of_brush(layer));
  }
  if (!finest) return;
  cover_bare(std::move(bare), plan, begun, carried, before, options, tracked);
  misplaced_ = std::move(misplaced);
}

/// Plans a layer after which nothing needs the canvas: that of a large picture takes much memory.
Layer ViewPainter::plan_last(const LayerPlan& plan) {
  if (style_.marks != Marks::fitted_strokes) return plan_layer(plan);
  PaintedPicture canvas = painted_picture(plan.canvas);
  at_->canvas = Canvas(0, 0, {});
  at_->to_draw.reset();
  return fit_layer(plan, std::move(canvas));
}

Layer ViewPainter::repairs() {
  if (!is_whole() || misplaced_.empty() || view_.colour.width() < least_repaired_width_px) return {};
  remove_occlusion_specks(misplaced_, least_repaired_px);
  return repair({{view_.colour, misplaced_, view_.disparity, view_.position, view_.position}, at_->scaled}, style_);
}

bool ViewPainter::is_whole() const { return view_.wanted.empty(); }

bool ViewPainter::is_finest(int layer) const { return layer + 1 == static_cast<int>(radii_px_.size()); }

int ViewPainter::factor_for(int layer) const {
  // Places that the ground leaves bare would show between finer strokes. At the beginning of a scene all traced
  // strokes are new, so that a few less exact ones would show.
  const bool fitted = style_.marks == Marks::fitted_strokes;
  const float least_radius_px = fitted ? (layer == 0 ? 5 : 2.5f) : motion_ == nullptr ? 12 : 6;
  const auto number = static_cast<std::size_t>(layer);
  return is_finest(layer) ? 1 : factor_for_layer(view_, radii_px_[number], least_radius_px);
}

/// Whether a layer of new strokes needs no canvas of its own size: that is the finest layer, on which nothing is drawn,
/// and the fitted one before it, whose strokes only the finest layer looks at.
bool ViewPainter::needs_no_whole_canvas(int layer) const {
  return is_finest(layer) || (is_finest(layer + 1) && style_.marks == Marks::fitted_strokes && factor_for(layer) == 1);
}

/// `stays_small`: the canvas keeps the size that it has.
void ViewPainter::go_to_size(int factor, LayerFit* fit, bool stays_small) {
  if (at_ && at_->view.frame.scale == view_.frame.scale * factor) return;
  const View view = smaller_view(view_, factor);
  if (at_) {
    const int enlarged = at_->view.frame.scale / view.frame.scale;
    const BegunCanvas begun(at_->canvas, enlarged, view.colour.width(), view.colour.height());
    Canvas canvas = stays_small      ? std::move(at_->canvas)
                    : fit == nullptr ? enlarged_canvas(begun)
                                     : enlarge_again(begun, fit->drawing);
    give_back_canvas();
    if (fit != nullptr) owner_of_canvas_ = &fit->drawing.begun;
    at_.emplace(view, style_, reference_width_, std::move(canvas));
    if (stays_small) at_->canvas_factor = enlarged;
  } else {
    at_.emplace(view, style_, reference_width_);
  }
  at_->beside = beside_;
}

void ViewPainter::give_back_canvas() {
  if (owner_of_canvas_ != nullptr) *std::exchange(owner_of_canvas_, nullptr) = std::move(at_->canvas);
}

/// Goes on to the canvas that the layer's strokes are painted on.
void ViewPainter::draw_again(const Layer& strokes, int layer, std::span<LayerFit> fits) {
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

/// Covers the pixels that the coarser layers and the finest strokes leave bare; nothing is planned over those that they
/// paint. `bare` are those that the coarser layers leave.
void ViewPainter::cover_bare(Image<std::uint8_t> bare, const LayerPlan& plan, const Layer& begun, std::size_t carried,
                             const Image<float>& before, const CarryOptions& options, TrackedLayer& tracked) {
  const View& view = at_->view;
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

/// Lets strokes end that have not followed the motion: their colour fits worse than at first, or they make the
/// picture worse.
void ViewPainter::end_wrong_colours(const LayerPlan& plan, const Image<float>& before, const CarryOptions& options,
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

void ViewPainter::draw_on_canvas(Layer strokes, int layer) {
  take_in(at_->view.frame, strokes);
  rasterise(strokes, at_->view.position, hiding(), at_->canvas, cover_of_brush(layer));
}

/// Places that the brush leaves bare matter to the strokes over them; the brush's streaks are not an error.
Brush ViewPainter::cover_of_brush(int layer) const {
  const Brush& brush = at_->scaled.brush;
  Brush of_layer = layer > 0 ? brush : ground_brush(brush);
  of_layer.streaks = of_layer.ridge = 0;
  return of_layer;
}

Hiding ViewPainter::hiding() const {
  return {.surface = at_->view.disparity, .tolerance_px = at_->scaled.depth_threshold_px};
}

/// By how many pixels a frame the place of a stroke's first point moves.
float ViewPainter::speed_at(const Layer& layer, std::size_t stroke) const {
  const ControlPoint& first = layer.points[layer.strokes[stroke].first_point];
  const float speed =
      std::hypot(sample(motion_->x.view(), first.x, first.y), sample(motion_->y.view(), first.x, first.y));
  return std::isfinite(speed) ? speed : 0;
}

/// Squared errors of what is painted so far; −1 where nothing is wanted.
Image<float> ViewPainter::errors_left(const LayerPlan& plan) const {
  const View& view = plan.view;
  const int width = view.colour.width(), height = view.colour.height();
  Image<float> errors(width, height);
  tbb::parallel_for(0, height, [&](int y) {
    squared_errors(*plan.reference, {plan.canvas.canvas}, {y, 0, width}, errors.row(y).data());
    if (view.wanted.empty()) return;
    for (int x = 0; x < width; ++x)
      if (view.wanted(x, y) == 0) errors(x, y) = -1;
  });
  return errors;
}

/// 255 within half a cell of the beginning of each stroke that stays.
Image<std::uint8_t> ViewPainter::where_strokes_begin(const TrackedLayer& tracked, float cell_px) const {
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
Image<std::uint8_t> ViewPainter::where_strokes_are_missing(const LayerPlan& plan, const Image<float>& before,
                                                           const TrackedLayer& tracked) const {
  const float cell_px = style_.grid * plan.radius_px;
  const Image<float> after = errors_left(plan);
  const Image<std::uint8_t> begun = where_strokes_begin(tracked, cell_px);
  Image<std::uint8_t> seeds = missing_strokes({before, after, begun, plan.depth_edges, cell_px, style_.threshold});
  const float squared_threshold = style_.threshold * style_.threshold;
  tbb::parallel_for(0, seeds.height(), [&](int y) {
    for (int x = 0; x < seeds.width(); ++x) {
      if (plan.canvas.canvas.coverage(x, y) < 0.5f) seeds(x, y) = before(x, y) > squared_threshold ? 255 : 0;
      const bool may_begin = before(x, y) >= 0 && begun(x, y) == 0;
      if (may_begin && !plan.misplaced.empty() && plan.misplaced(x, y) != 0) seeds(x, y) = 255;
    }
  });
  return seeds;
}

/// Dots for the thin edges of near surfaces that the smaller picture does not show, except where carried strokes have
/// a point already. Around parts that no photograph shows, these surfaces have their own strokes.
Layer ViewPainter::new_dots_left_out(const CarriedPoints& carried) const {
  Layer dots = dots_left_out(part_, view_), whole = dots;
  hand_back(view_.frame, whole);
  const float depth_threshold_px = at_->scaled.depth_threshold_px * static_cast<float>(view_.frame.scale);
  const auto factor = static_cast<float>(view_.frame.scale) / static_cast<float>(part_.frame.scale);
  std::erase_if(dots.strokes, [&](const Stroke& dot) {
    const ControlPoint& point = dots.points[dot.first_point];
    const bool is_photographed =
        !uncovered_.empty() && uncovered_(static_cast<int>(point.x * factor), static_cast<int>(point.y * factor)) == 0;
    return is_photographed || carried.any_at(whole.points[dot.first_point], depth_threshold_px);
  });
  for (Stroke& dot : dots.strokes) dot.opacity = style_.opacity;
  return dots;
}

void ViewPainter::add(Layer begun, const LayerPlan& plan, const Image<float>& before, const CarryOptions& options,
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

}  // namespace wheatstone
