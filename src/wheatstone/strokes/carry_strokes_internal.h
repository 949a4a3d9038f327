#pragma once

#include <span>

#include "wheatstone/strokes/layer_plan.h"
#include "wheatstone/strokes/scene_motion_internal.h"
#include "wheatstone/strokes/strokes_in_time.h"

namespace wheatstone {

/// Length of the polygon of a stroke's control points.
float length_px(std::span<const ControlPoint> points);

/// Moves all strokes of one view's layer to this frame. Strokes begin to end if their length, or the disparity of their
/// points, changed too much.
void carry_layer(const SceneMotion& motion, const View& now, float depth_threshold_px, const CarryOptions& options,
                 TrackedLayer& tracked);

/// How much of a stroke's opacity is shown at first.
float first_shown(bool scene_begins, const CarryOptions& options);

/// The number of frames in which a stroke that does not fit fades out. It falls as the place of the stroke moves faster
/// relative to its size, so that the stroke leaves no trail; it is never smaller than the number in which new strokes
/// appear.
std::uint32_t fading_frames(float radius_px, float speed_px, const CarryOptions& options);

/// Lets strokes that were ending fade by another step, drops those that are gone, and lets new ones come on.
void fade(const CarryOptions& options, TrackedLayer& tracked);

/// Assigns every stroke to a view that sees it: a stroke that is hidden in the reference view and shown by another
/// belongs to that other view, and a stroke that the reference view shows whole belongs to the reference view. Strokes
/// that no view shows, or whose paint lies outside the picture, are dropped. `layers` has one layer for each of the
/// scene's views.
void settle(std::span<const View> views, float depth_threshold_px, std::span<TrackedLayer* const> layers);

/// A view that looks at a stroke. Surfaces that are nearer than the stroke by more than the tolerance hide it.
struct Onlooker {
  const View& view;
  float tolerance_px;
};

/// Whether a view shows all of a stroke of the view at `from`, including the width of its paint. If the reference view
/// shows all of another view's stroke, that stroke is not needed: the reference view has paint there.
bool is_shown_whole(std::span<const ControlPoint> points, float radius_px, ViewPosition from, const Onlooker& view);

/// How well a stroke's colour fits the picture along it: mean RGB distances over a few consecutive points, each where
/// it is worst.
struct ColourFit {
  float difference = 0;  ///< of its colour from the picture
  float gain = 0;        ///< by how much more the coarser layers' paint differs from the picture; 0 over bare canvas
};

/// `errors` are the squared RGB errors that the coarser layers left, negative where nothing is wanted. All is in the
/// view's pixels. Only points in the picture and not behind its surface count; without such points, the colour fits.
ColourFit colour_fit(std::span<const ControlPoint> points, Rgb8 colour, const ViewOnCanvas& at,
                     const ReferencePicture& reference, const Image<float>& errors);

/// Keeps the strokes for which `keeps` holds, with their tracks; the points of the others are dropped.
template <class Keeps>
void keep_if(TrackedLayer& tracked, Keeps keeps) {
  TrackedLayer kept;
  kept.layer.radius_px = tracked.layer.radius_px;
  kept.layer.points.reserve(tracked.layer.points.size());
  kept.layer.strokes.reserve(tracked.layer.strokes.size());
  kept.tracks.reserve(tracked.tracks.size());
  for (std::size_t i = 0; i < tracked.tracks.size(); ++i) {
    if (!keeps(i)) continue;
    Stroke stroke = tracked.layer.strokes[i];
    const std::span<const ControlPoint> points = tracked.layer.points_of(stroke);
    stroke.first_point = static_cast<std::uint32_t>(kept.layer.points.size());
    kept.layer.points.insert(kept.layer.points.end(), points.begin(), points.end());
    kept.layer.strokes.push_back(stroke);
    kept.tracks.push_back(tracked.tracks[i]);
  }
  tracked = std::move(kept);
}

}  // namespace wheatstone
