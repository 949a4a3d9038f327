#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wheatstone/drawing/rasterise.h"
#include "wheatstone/strokes/carried_points_internal.h"
#include "wheatstone/strokes/layer_plan.h"
#include "wheatstone/strokes/refit_internal.h"
#include "wheatstone/strokes/stroke_numbers_internal.h"
#include "wheatstone/strokes/strokes_in_time.h"
#include "wheatstone/strokes/view_to_plan_internal.h"

namespace wheatstone {

/// Paints one view of a frame, layer by layer; in smaller pictures where the brush is wide, or only a part is wanted.
class ViewPainter {
 public:
  /// `motion` is the reference view's flow to the frame before; none where a scene begins. `beside`: from which views
  /// its strokes will be seen.
  ViewPainter(const View& view, const View& reference, const Style& style, const Flow* motion,
              const ViewsBeside& beside, StrokeNumbers& numbers);
  ViewPainter(const ViewPainter&) = delete;
  ViewPainter& operator=(const ViewPainter&) = delete;
  ~ViewPainter();

  /// Ends the carried strokes of a layer that do not fit the picture any more, and begins those that are missing.
  /// `fits`: what is kept of all layers; none: nothing is.
  void plan(int layer, const CarryOptions& options, TrackedLayer& tracked, std::span<LayerFit> fits);

  /// To be called once all layers are planned. Returns marks for this frame alone, where the carried strokes show a
  /// colour that the frame has nowhere near. New strokes there may lie under the carried ones, and appear slowly.
  Layer repairs();

 private:
  bool is_whole() const;
  bool is_finest(int layer) const;
  int factor_for(int layer) const;
  bool needs_no_whole_canvas(int layer) const;
  void go_to_size(int factor, LayerFit* fit, bool stays_small);
  void give_back_canvas();
  void draw_again(const Layer& strokes, int layer, std::span<LayerFit> fits);
  Layer plan_last(const LayerPlan& plan);
  void cover_bare(Image<std::uint8_t> bare, const LayerPlan& plan, const Layer& begun, std::size_t carried,
                  const Image<float>& before, const CarryOptions& options, TrackedLayer& tracked);
  void end_wrong_colours(const LayerPlan& plan, const Image<float>& before, const CarryOptions& options,
                         TrackedLayer& tracked) const;
  void draw_on_canvas(Layer strokes, int layer);
  Brush cover_of_brush(int layer) const;
  Hiding hiding() const;
  float speed_at(const Layer& layer, std::size_t stroke) const;
  Image<float> errors_left(const LayerPlan& plan) const;
  Image<std::uint8_t> where_strokes_begin(const TrackedLayer& tracked, float cell_px) const;
  Image<std::uint8_t> where_strokes_are_missing(const LayerPlan& plan, const Image<float>& before,
                                                const TrackedLayer& tracked) const;
  Layer new_dots_left_out(const CarriedPoints& carried) const;
  void add(Layer begun, const LayerPlan& plan, const Image<float>& before, const CarryOptions& options,
           TrackedLayer& tracked) const;

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

}  // namespace wheatstone
