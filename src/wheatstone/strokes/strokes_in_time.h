#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/progress.h"

namespace wheatstone {

struct ViewFit;

/// What fitting the strokes of a still leaves behind, by which they are fitted again where something has changed: by
/// view. Empty before the first time.
using StrokeFits = std::vector<std::shared_ptr<ViewFit>>;

/// When a stroke is carried from a frame of a film to the next, and how it comes and goes (Bukenberger et al. 2015,
/// sec. 3.1, 3.2 and 5.2).
struct CarryOptions {
  int fade_in_frames = 2;
  int fade_out_frames = 4;
  float colour_tolerance = 48;     ///< RGB distance, 0..441, by which its colour may fit worse than when it was made
  float gain_tolerance = 20;       ///< RGB distance by which it may be worse than the coarser layers' paint under it
  float length_tolerance = 0.25f;  ///< by which its length may change, as a share of what it was made with
  bool goes_on = true;             ///< a frame follows, for which the memory is kept
};

/// What a stroke's number stands for beside the stroke itself.
struct StrokeTrack {
  float shown = 1;         ///< of the stroke's opacity, 0..1
  std::uint32_t ends = 0;  ///< not 0: it fades out, in so many frames
  float first_length_px = 0;
  float first_colour_difference = 0;  ///< mean RGB distance of its colour from the picture under it
  float first_gain = 0;               ///< by how much smaller that was than the distance of the coarser layers' paint
  friend bool operator==(const StrokeTrack&, const StrokeTrack&) = default;
};

/// The strokes of one brush radius in one view, whole, whatever hides them, in pixels of the reference view; `tracks`
/// belongs to `layer.strokes`.
struct TrackedLayer {
  Layer layer;
  std::vector<StrokeTrack> tracks;
  friend bool operator==(const TrackedLayer&, const TrackedLayer&) = default;
};

/// What is carried from frame to frame. Empty before the first.
struct StrokeMemory {
  std::vector<std::vector<TrackedLayer>> views;  ///< of the scene, in their order: layers, coarse to fine
  Image<float> reference_disparity;              ///< of the reference view, as it was
  std::uint32_t last_number = 0;                 ///< given to a stroke
};

/// What became of the strokes of the frame before that were not fading out, and how many are new.
struct StrokeCounts {
  std::int64_t before = 0;
  std::int64_t carried = 0;  ///< of these, go on; the others fade out, left the picture or are hidden in all views
  std::int64_t begun = 0;
};

/// The strokes of a frame: those of the frame before, moved with the flow, as long as they fit; new ones where paint is
/// missing or wrong. Strokes that do not fit fade out, and new ones fade in; at the beginning of a scene, all strokes
/// are new and whole. Strokes keep their numbers, and their order as far as their depths let them. Throws
/// Error{wrong_usage} for a style that is not of strokes. `progress` is called at least once for each layer of a view.
/// If it throws, planning ends, and `memory` is of no further use. `fits`: of a still that is planned again and again.
struct CarriedPainting {
  StrokePainting painting;
  StrokeCounts counts;
};
CarriedPainting plan_strokes(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                             StrokeMemory& memory, const Progress& progress = {}, StrokeFits* fits = nullptr);

}  // namespace wheatstone
