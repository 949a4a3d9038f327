#pragma once

#include <memory>
#include <optional>

#include "wheatstone/image/reduced_view.h"
#include "wheatstone/stereo/scene_view.h"
#include "wheatstone/strokes/layer_planner.h"

namespace wheatstone {

/// What is painted of a view: all of the reference view, of another view what it alone shows, in a smaller picture.
struct WantedPart {
  const SceneView& view;
  int width;                           ///< of the reference view's picture, as styles are scaled to
  std::optional<ReducedView> smaller;  ///< none: all of the view
  int reduction = 1;                   ///< from the reference view's size
  ViewsBeside beside = {};             ///< from which its strokes will be seen

  bool is_whole() const { return !smaller; }
  ImageView<const Rgb8> photograph() const { return smaller ? smaller->photograph.view() : view.picture; }
  ImageView<const float> disparity() const { return smaller ? smaller->disparity.view() : view.disparity; }
  /// Strokes begin where it is not 0; empty: everywhere.
  ImageView<const std::uint8_t> seeds() const {
    return smaller ? smaller->seeds.view() : ImageView<const std::uint8_t>();
  }
};

/// What a view alone shows is grown where a scene begins, so that its strokes reach under those of the reference view;
/// later those are there, and what they may show is theirs. Half the size is enough for what an eye shows; what no eye
/// shows is planned as small as its finest brush allows.
WantedPart wanted_part(const SceneView& view, const SceneView& reference, const Style& style, bool scene_begins);

/// A part as layers of a wide brush are planned: smaller still, since such a brush shows none of what gets lost, and
/// most of what planning takes goes with the pixels that are looked at.
struct SizedView {
  /// `factor` times smaller than the part. What was painted at the size before is on the canvas.
  SizedView(const WantedPart& part, const Style& style, int factor, const SizedView* before);
  SizedView(const SizedView&) = delete;
  SizedView& operator=(const SizedView&) = delete;
  ~SizedView() = default;

  ImageView<const std::uint8_t> seeds() const {
    return part.is_whole() || !smaller ? part.seeds() : smaller->seeds.view();
  }

  const WantedPart& part;
  int factor;
  int reduction;  ///< from the reference view's size
  std::optional<ReducedView> smaller;
  ScaledStyle scaled;
  LayerPlanner planner;
};

/// How many times smaller than the part a layer is planned whose brush has this radius in the reference view's pixels:
/// it keeps at least the other radius.
int factor_for_layer(const WantedPart& part, float radius_px, float least_radius_px);

}  // namespace wheatstone
