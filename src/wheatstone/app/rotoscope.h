#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/app/film_depth.h"
#include "wheatstone/app/film_mask.h"
#include "wheatstone/app/film_presentation.h"
#include "wheatstone/app/scene_rectification.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/motion/flow.h"
#include "wheatstone/number_range.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/plan_painting.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/central_view.h"
#include "wheatstone/strokes/strokes_between_frames.h"

namespace wheatstone {

inline constexpr NumberRange zero_parallax_range{-65535, 65535};

/// Files that were made by hand for a frame, and move with the film until there is another one, or a scene begins.
/// Empty: there is none.
struct FrameMaps {
  std::filesystem::path detail;     ///< a picture as the detail map of a photograph, stretched over the left eye's
  std::filesystem::path disparity;  ///< disparities of the left eye in pixels of the rectified frame (read_disparity);
                                    ///< they hold where they differ from what is found by more than a pixel
  bool empty() const { return detail.empty() && disparity.empty(); }
};

struct RotoscopeOptions {
  Style style;
  std::optional<Style> outside;  ///< of masks; none: the film's own pictures are shown there
  /// If it has no range, one is found for each scene.
  MatchOptions matching{.matcher = Matcher::sgbm};
  /// Only the first frame of a scene is matched by itself; others near the disparity of the frame before, as
  /// match_near.
  bool match_near_last = true;
  /// Asked once a scene, and of no effect where a frame's geometry is known.
  RectifyPolicy rectify = RectifyPolicy::automatic;
  int widest_matched_px = 960;  ///< wider frames are matched in copies of this width
  int widest_half_px = 640;     ///< and frames of half the size in copies of this one
  int widest_flow_px = 960;     ///< the flow of wider frames is found in copies of this width
  /// All is found, and strokes are planned, in frames of half the size, where their brushes are wide enough for that
  /// and nothing is known beforehand. They are drawn at the film's size.
  bool at_half_size = false;
  FlowMethod flow = FlowMethod::dis;
  std::filesystem::path flow_model;  ///< with FlowMethod::onnx, as FlowOptions
  NetworkValues flow_model_values = NetworkValues::to_255;
  CentralMerge central = CentralMerge::visible;
  CarryOptions carrying;
  std::optional<FilmDisplay> display;  ///< what frames are drawn for; none: for two eyes
  /// Frames for two eyes, or of one, that come with 16 bits a channel are also drawn with 16, if the processor draws
  /// them and they are painted all over.
  bool deep = false;
  Device device = Device::processor;  ///< what draws them; where it is automatic and fails, the processor does
  DisparityFromDepthOptions depth;    ///< of the frames of one eye whose depth is known
  std::optional<float> depth_budget;  ///< of two eyes, as comfortable_eyes; none: they are the film's own
  /// The disparity, in pixels of a frame, that lies on the screen plane, for two eyes and on a display; none: where the
  /// film has it, as far as the depth budget allows, or in the middle of the scene's depth on a display.
  std::optional<float> zero_parallax_px;
  /// The frames of the scene are drawn for eyes that move: all of them as for other eyes than the film's own, where
  /// nothing lies behind the paint, so that no frame looks otherwise.
  bool eyes_move = false;
  FrameMaps maps;                    ///< of this frame
  std::optional<bool> scene_begins;  ///< with the frame; none: where a cut is found
  bool anew = false;                 ///< every frame as if a scene began: the naive method, to be measured against
};

/// Values of a frame that are known beforehand and need not be estimated.
struct KnownFrame {
  StereoGeometry geometry;
  /// The flow of the left view: forward from the frame before, backward to it. All unknown at the beginning of a scene.
  std::optional<FlowPair> flow;
  /// The depth of a frame of one eye, instead of the geometry, as disparity_from_depth takes it.
  std::optional<Image<float>> depth = std::nullopt;
};

/// Gives what is known of a film's frames, counted from 0; the right eye's picture is empty where there is one eye.
using KnownFrames = std::function<KnownFrame(std::int64_t frame, const StereoPair& eyes)>;

/// Sums over the frames of a film so far; a cut's first frame has nothing to be compared with.
struct RotoscopeTotals {
  std::int64_t scenes = 0;
  std::int64_t whole_strokes = 0;     ///< as StrokeChanges, frame by frame
  std::int64_t survived_strokes = 0;  ///< of these
  std::int64_t popped_strokes = 0;
  std::int64_t strokes = 0;
  double worst_bare_share = 0;    ///< of an eye's pixels, 0..1
  std::int64_t moved_frames = 0;  ///< that were drawn for other eyes than the film's own
  double least_separation = 1;    ///< of these eyes
  friend bool operator==(const RotoscopeTotals&, const RotoscopeTotals&) = default;
};

/// Everything on which the next frame of a film depends. Empty before the first frame. The first frame of a scene
/// depends only on the sums and on the picture before, which reveals the cut.
struct RotoscopeState {
  std::int64_t frames = 0;
  std::int64_t frames_of_scene = 0;
  Image<Rgb8> left_before;  ///< the left eye's picture as it came
  /// The central view's. It and all that follows are of the rectified frame, or of half its size where it is planned
  /// so.
  Image<Rgb8> central_before;
  Image<float> left_disparity_before, central_disparity_before;
  Image<float> corrected_disparity;  ///< of the left eye, by hand; NaN where it is as found; empty where there is none
  FlowPair flow_before;              ///< the last flow of the scene; empty where there is none yet
  Image<std::uint8_t> detail;        ///< View::detail of the central view; empty where there is none
  std::optional<DisparityRange> range;
  SceneRectification rectification;
  SceneDepth depth;                              ///< where the frames are drawn for a display or a depth budget
  std::optional<InverseDepthRange> depth_range;  ///< of the scene, where the frames' depth is known
  PaintingMemory memory;
  PaintingMemory outside_memory;     ///< of the style outside masks
  std::vector<Layer> layers_before;  ///< the strokes as they were drawn, to tell what became of them
  RotoscopeTotals totals;
};

struct RotoscopeTimes {
  double matching_s = 0;
  double central_s = 0;
  double flow_s = 0;
};

/// The next frame of a film, planned. Whoever draws it needs nothing but its painting and how that is shown.
struct PlannedFilmFrame {
  Painting painting;  ///< complete: with the marks that repair what the drawn frame would show wrongly
  FrameShowing showing;
  std::vector<DrawnView> drawn;  ///< the presentation's views, where planning has drawn them
  StrokeCounts counts;
  StrokeChanges changes;  ///< from the frame before; nothing where a scene begins
  bool scene_begins = false;
  TwoEyes eyes;           ///< that it is drawn for, where it is drawn for two
  std::string rows_note;  ///< as MeasuredScene has it, where the frame was measured
  RotoscopeTimes times;   ///< beside those of painting
  PaintingTimes painting_times;
};

struct RotoscopedFrame : PlannedFilmFrame, DrawnFrame {};

/// Plans the next frame of a film (Bukenberger et al. 2015): rectifies it as its scene's first frame asks for, finds
/// its disparity, merges the eyes into the central view, finds the flow there from the frame before, and plans what
/// that flow carries on. `photographed.right` is empty for a film of one eye; where its depth is known, it is painted
/// as the left eye of a pair. Throws Error{bad_input} where the eyes, or this frame and the last, differ in size, or a
/// film of one eye is to be shown on a display, wrong_usage for options that make no sense. `progress` is called
/// between its steps and while it matches. If it throws, painting ends, and `state` is of no further use. With a
/// `mask`, which is rectified as the frame is, the options must have no display, depth budget or screen plane, because
/// the film's own pictures have its own depth; the frame is planned at its whole size. `left_deep`: the left picture
/// with 16 bits a channel, which refines colours; empty: there are 8.
PlannedFilmFrame plan_film_frame(const StereoPair& photographed, const RotoscopeOptions& options, RotoscopeState& state,
                                 const KnownFrame* known = nullptr, const Progress& progress = {},
                                 const FrameMask* mask = nullptr, ImageView<const Rgb16> left_deep = {});

/// Goes on by a frame that shows the painting of the one before again.
void repeat_film_frame(const PlannedFilmFrame& before, RotoscopeState& state);

/// Plans the frame and draws it (draw_film_frame). The state's totals learn how much of it is bare.
RotoscopedFrame rotoscope_frame(const StereoPair& photographed, const RotoscopeOptions& options, RotoscopeState& state,
                                const KnownFrame* known = nullptr, const Progress& progress = {},
                                const FrameMask* mask = nullptr, ImageView<const Rgb16> left_deep = {});

}  // namespace wheatstone
