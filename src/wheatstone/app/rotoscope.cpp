#include "wheatstone/app/rotoscope.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "wheatstone/app/corrected_depth.h"
#include "wheatstone/app/detail_map.h"
#include "wheatstone/app/half_size_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/matching/match_near.h"
#include "wheatstone/measures/film_measures.h"
#include "wheatstone/motion/central_flow.h"
#include "wheatstone/motion/expected_disparity.h"
#include "wheatstone/painting/plan_for_eyes.h"
#include "wheatstone/painting/still_scene.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/retouched_right.h"
#include "wheatstone/stereo/view.h"
#include "wheatstone/stopwatch.h"

namespace wheatstone {
namespace {

/// A frame as it comes, and how it is to be painted.
struct FrameTask {
  const StereoPair& whole;  ///< as the frame is drawn
  const StereoPair& eyes;   ///< as it is planned: the same, or half the size
  const RotoscopeOptions& options;
  const KnownFrame* known;
  const Progress& progress;
  Flow to_before = {};  ///< of the left eye, in pixels of a small copy; empty where none is known
  int reduction = 1;    ///< of `eyes`, and of all that is found in them
  bool is_lit_as_before = true;
  bool deep = false;  ///< drawn with 16 bits a channel, too
};

/// A frame as it is painted from.
struct FrameAtWork {
  Image<Rgb8> retouched_right = {};   ///< the right eye's picture if a depth corrected by hand moves things there
  Image<float> found_disparity = {};  ///< the left eye's, without what is corrected; empty where nothing is
  StereoGeometry geometry;
  CentralView centre;
  std::vector<View> views;
};

void check_eyes(const StereoPair& eyes, const RotoscopeOptions& options, const RotoscopeState& state, bool has_depth) {
  if (eyes.right.empty() && options.display && !has_depth)
    throw Error(ErrorKind::bad_input, "the film has one eye, expected two for a display of more views");
  if (!eyes.right.empty() && !same_size(eyes.left, eyes.right))
    throw Error(ErrorKind::bad_input,
                fmt::format("the right eye's picture is {}x{} pixels, expected the left one's {}x{}",
                            eyes.right.width(), eyes.right.height(), eyes.left.width(), eyes.left.height()));
  if (!state.left_before.empty() && !same_size(eyes.left, state.left_before))
    throw Error(ErrorKind::bad_input,
                fmt::format("the frame is {}x{} pixels, expected {}x{} as before", eyes.left.width(),
                            eyes.left.height(), state.left_before.width(), state.left_before.height()));
}

void check_mask(const FrameMask& mask, const StereoPair& eyes, const RotoscopeOptions& options) {
  if (options.display || options.depth_budget || options.zero_parallax_px)
    throw Error(ErrorKind::wrong_usage, "a frame with a mask has the depth of the film, expected no other");
  for (const Image<std::uint8_t>* of_eye : {&mask.left, &mask.right})
    if (!same_size(*of_eye, eyes.left) && (of_eye == &mask.left || !of_eye->empty()))
      throw Error(ErrorKind::bad_input,
                  fmt::format("the mask is {}x{} pixels, expected {}x{} as the frame", of_eye->width(),
                              of_eye->height(), eyes.left.width(), eyes.left.height()));
}

/// A scene's range is measured again, at first often and then every 24 frames, because a fade may hide parts of it.
bool looks_again(std::int64_t frame_of_scene) {
  constexpr std::int64_t frames_between_looks = 24;
  return frame_of_scene % frames_between_looks == 0 ||
         (frame_of_scene < frames_between_looks && std::has_single_bit(static_cast<std::uint64_t>(frame_of_scene)));
}

/// The range of a frame that is measured again, in a smaller copy: it only adds what the first frame hid.
std::optional<DisparityRange> range_of_later_frame(const StereoPair& eyes) {
  constexpr int widest_px = 640;
  const int width = eyes.left.width();
  if (width <= widest_px) return find_disparity_range(eyes);
  const PictureSize size{widest_px, std::max(eyes.left.height() * widest_px / width, 1)};
  const std::optional<DisparityRange> found =
      find_disparity_range({reduced(eyes.left, size), reduced(eyes.right, size)});
  if (!found) return {};
  const double scale = static_cast<double>(width) / widest_px;
  return DisparityRange{static_cast<int>(std::floor(found->least * scale)),
                        static_cast<int>(std::ceil(found->largest * scale))};
}

/// The disparities to look for: those of the scene's first frame, widened by what later frames show, with some room,
/// so that nothing moves out of them between two looks.
DisparityRange scene_range(const StereoPair& eyes, RotoscopeState& state) {
  if (state.range && !looks_again(state.frames_of_scene)) return *state.range;
  std::optional<DisparityRange> found =
      state.frames_of_scene > 0 ? range_of_later_frame(eyes) : find_disparity_range(eyes);
  const int width = eyes.left.width();
  // A black frame says nothing.
  if (!found) return state.range.value_or(usual_disparity_range(width));
  const int room = std::max((found->largest - found->least) / 8, 2);
  found = {found->least - room, found->largest + room};
  if (state.range && state.frames_of_scene > 0)
    found = {std::min(found->least, state.range->least), std::max(found->largest, state.range->largest)};
  state.range = DisparityRange{std::max(found->least, 1 - width), std::min(found->largest, width - 1)};
  return *state.range;
}

/// The factor that reduces a picture to this width, if it is wider.
double share_of_width(const Image<Rgb8>& picture, int widest_px) {
  return std::min(static_cast<double>(widest_px) / picture.width(), 1.0);
}

/// Matches near the frame before, moved along the flow; where a scene begins, or too little is found so, over the whole
/// range first. None where nothing matches.
std::optional<MatchedPair> match_frame(const FrameTask& task, const MatchOptions& matching,
                                       const RotoscopeState& state) {
  constexpr double least_found_share = 0.4;
  const StereoPair& eyes = task.eyes;
  const bool follows = task.options.match_near_last && !task.options.anew;
  if (follows && state.frames_of_scene > 0 && !task.to_before.x.empty()) {
    const int width = static_cast<int>(eyes.left.width() * matching.size),
              height = static_cast<int>(eyes.left.height() * matching.size);
    Image<std::uint8_t> still;
    if (task.is_lit_as_before) still = still_places(task.to_before, eyes.left.width(), width, height);
    std::optional<MatchedPair> matched = match_near(
        eyes, expected_disparity(state.left_disparity_before, task.to_before, width, height), matching, still);
    if (matched && matched->left_found_share >= least_found_share) return matched;
  }
  std::optional<MatchedPair> matched = match_if_any(eyes, matching, task.progress);
  if (!matched || !follows) return matched;
  // Found as in the frames to come, so that nothing jumps between the two methods.
  std::optional<MatchedPair> near = match_near(eyes, matched->geometry.left_disparity, matching);
  return near && near->left_found_share >= least_found_share ? near : matched;
}

StereoGeometry find_geometry(const FrameTask& task, RotoscopeState& state) {
  MatchOptions matching = task.options.matching;
  if (!matching.range) {
    matching.range = scene_range(task.eyes, state);
  } else if (task.reduction > 1) {
    matching.range = at_half_size(*matching.range);
  }
  const int widest_px = task.reduction > 1 ? task.options.widest_half_px : task.options.widest_matched_px;
  matching.size = std::min(matching.size * task.reduction, share_of_width(task.eyes.left, widest_px));
  if (std::optional<MatchedPair> matched = match_frame(task, matching, state)) return std::move(matched->geometry);
  // A frame that shows nothing, such as a black one, takes the depth of the frame before, or is flat at the beginning
  // of a scene.
  if (state.frames_of_scene > 0 && !state.left_disparity_before.empty())
    return geometry_from_left(state.left_disparity_before);
  return geometry_from_left(Image<float>(task.eyes.left.width(), task.eyes.left.height(), 0));
}

/// A frame that is looked at first.
struct FirstLook {
  StereoPair eyes;
  Flow to_before;                ///< as in FrameTask
  bool is_lit_as_before = true;  ///< as in FrameTask
};

/// The mean of a picture's channels in every eighth row.
double mean_level(const Image<Rgb8>& picture) {
  constexpr int step = 8;
  std::int64_t sum = 0, count = 0;
  for (int y = 0; y < picture.height(); y += step)
    for (const Rgb8& colour : picture.row(y)) sum += colour.r + colour.g + colour.b, count += 3;
  return static_cast<double>(sum) / static_cast<double>(std::max<std::int64_t>(count, 1));
}

/// Whether a frame is as bright as the one before. While a scene fades in, its depth is seen better from frame to
/// frame.
bool is_lit_alike(const Image<Rgb8>& before, const Image<Rgb8>& now) {
  constexpr double alike = 0.5;  // of 0..255
  return std::abs(mean_level(before) - mean_level(now)) <= alike;
}

/// Tells whether a scene begins, by a cut in the frames as they come if nobody says it. Also returns the flow to the
/// previous frame if the detection needed it.
bool tells_cut_of(const FrameTask& photographed, const RotoscopeState& state, Flow& to_before) {
  const std::optional<bool> begins = photographed.options.scene_begins;
  if (state.left_before.empty() || begins.value_or(false)) return true;
  const KnownFrame* known = photographed.known;
  if (known != nullptr && known->flow) return begins.value_or(tells_cut(*known->flow));
  FrameChange change = find_cut(state.left_before, photographed.eyes.left);
  to_before = std::move(change.flow.backward);
  return begins.value_or(change.cut);
}

/// Only the film's sums pass to a new scene, so that scenes can be painted separately.
void begin_scene(RotoscopeState& state) {
  RotoscopeState begun;
  begun.frames = state.frames;
  begun.left_before = std::move(state.left_before);
  begun.totals = state.totals;
  state = std::move(begun);
}

/// The frame as its scene is rectified. Until a scene has shown whether its rows fit, later frames are measured too.
FirstLook rectify_frame(const FrameTask& photographed, RotoscopeState& state, PlannedFilmFrame& result) {
  const StereoPair& eyes = photographed.eyes;
  FirstLook frame;
  result.scene_begins = tells_cut_of(photographed, state, frame.to_before);
  if (result.scene_begins) begin_scene(state);
  frame.eyes = eyes;
  if (eyes.right.empty() || photographed.known != nullptr) return frame;
  frame.is_lit_as_before = is_lit_alike(state.left_before, eyes.left);
  if (!state.rectification.measured && looks_again(state.frames_of_scene)) {
    MeasuredScene scene = measure_scene(eyes, photographed.options.rectify, photographed.progress);
    if (!scene.rectification.measured) return frame;
    result.rows_note = std::move(scene.note);
    if (scene.rectification.how && !result.scene_begins) {
      begin_scene(state);
      result.scene_begins = true;
    }
    state.rectification = scene.rectification;
  }
  if (!state.rectification.how) return frame;
  frame.eyes = rectified(eyes, state.rectification);
  if (!result.scene_begins) {
    const Image<Rgb8> before = rectified({state.left_before, state.left_before}, state.rectification).left;
    frame.to_before = find_cut(before, frame.eyes.left).flow.backward;
  }
  return frame;
}

/// A film of one eye: all on the screen.
FrameAtWork single_view(const StereoPair& eyes) {
  FrameAtWork frame;
  frame.centre.disparity = Image<float>(eyes.left.width(), eyes.left.height());
  frame.centre.picture = eyes.left;
  frame.geometry.left_disparity = frame.centre.disparity;
  return frame;
}

FlowPair find_flow(const FrameAtWork& frame, const FrameTask& task, const RotoscopeState& state) {
  const KnownFrame* known = task.known;
  if (known != nullptr && known->flow)
    return central_flow(*known->flow, {state.left_disparity_before, state.central_disparity_before},
                        {frame.geometry.left_disparity, frame.centre.disparity});
  const FlowPair* start = state.flow_before.forward.x.empty() ? nullptr : &state.flow_before;
  const double size = share_of_width(state.central_before, task.options.widest_flow_px);
  const RotoscopeOptions& options = task.options;
  return estimate_flow(state.central_before, frame.centre.picture,
                       {options.flow, start, size, options.flow_model, options.flow_model_values});
}

/// The pictures that the frame is painted from.
StereoPairView eyes_of(const FrameTask& task, const FrameAtWork& frame) {
  return {task.eyes.left, frame.retouched_right.empty() ? task.eyes.right : frame.retouched_right};
}

/// The right eye's picture as the frame is drawn. Where it is planned at half the size, nothing is moved in it.
const Image<Rgb8>& right_as_drawn(const FrameTask& task, const FrameAtWork& frame) {
  return task.reduction > 1 || frame.retouched_right.empty() ? task.whole.right : frame.retouched_right;
}

/// Takes what was corrected by hand into the geometry that was found.
void correct_depth(const FrameTask& task, RotoscopeState& state, FrameAtWork& frame) {
  std::optional<StereoGeometry> by_hand =
      corrected(frame.geometry.left_disparity, task.options.maps.disparity,
                {task.whole.left.width(), task.whole.left.height()}, task.to_before, state.corrected_disparity);
  if (!by_hand) return;
  frame.retouched_right = retouched_right(task.eyes, frame.geometry, *by_hand);
  frame.found_disparity = std::exchange(frame.geometry, std::move(*by_hand)).left_disparity;
}

FrameAtWork look_at(const FrameTask& task, RotoscopeState& state, RotoscopeTimes& times) {
  const StereoPair& eyes = task.eyes;
  if (eyes.right.empty()) return single_view(eyes);
  FrameAtWork frame;
  {
    const Stopwatch watch(times.matching_s);
    frame.geometry = task.known != nullptr ? task.known->geometry : find_geometry(task, state);
    if (task.known == nullptr) correct_depth(task, state, frame);
  }
  report(task.progress, "central view", 0);
  const Stopwatch watch(times.central_s);
  frame.centre = make_central_view(eyes_of(task, frame), frame.geometry, task.options.central);
  return frame;
}

/// The display with its screen plane.
FilmDisplay display_of(const RotoscopeOptions& options) {
  FilmDisplay display = *options.display;
  if (options.zero_parallax_px) display.views.zero_parallax_px = options.zero_parallax_px;
  return display;
}

/// Whether the frame is drawn over the pictures of these eyes.
bool are_own_eyes(const RotoscopeOptions& options, const TwoEyes& eyes) {
  return !options.display && !options.eyes_move && !are_moved(eyes);
}

/// Whether the frame is drawn for eyes that its scene's depth decides.
bool has_own_eyes(const RotoscopeOptions& options) {
  return !options.display && (options.depth_budget || options.zero_parallax_px);
}

/// The scene's views: the central one, the eyes', and those beside them that a display shows.
void find_views(const FrameTask& task, bool scene_begins, RotoscopeState& state, FrameAtWork& frame) {
  if (task.eyes.right.empty()) {
    frame.views = {{frame.centre.picture, frame.centre.disparity, {}, central_view}};
    return;
  }
  frame.views = scene_from_centre(frame.centre, eyes_of(task, frame), frame.geometry);
  const auto reduction = static_cast<float>(task.reduction);
  if (task.options.display || has_own_eyes(task.options)) {
    const DepthEnds ends = depth_ends(frame.centre.disparity);
    follow_depth({ends.farthest_px * reduction, ends.nearest_px * reduction}, scene_begins, state.depth);
  }
  if (!task.options.display) return;
  const ViewRange wanted =
      planned_views({task.whole.left.width(), task.whole.left.height()}, state.depth, display_of(task.options).views);
  const std::vector<View> outer =
      make_outer_views(eyes_of(task, frame), frame.geometry, wanted, state.depth.first.middle_px() / reduction);
  frame.views.insert(frame.views.end(), outer.begin(), outer.end());
}

/// How finely the central view is painted: as the frame's own detail map says, or the one before, moved along the flow.
Image<std::uint8_t> detail_of(const FrameTask& task, const FrameAtWork& frame, bool carries,
                              const RotoscopeState& state) {
  const Image<float>& disparity = frame.centre.disparity;
  const int width = disparity.width(), height = disparity.height();
  if (task.options.maps.detail.empty()) {
    if (!carries || state.detail.empty()) return {};
    return brought_along(state.detail, state.flow_before.backward, width, height, even_detail);
  }
  const Image<std::uint8_t> left = stretched_detail(read_detail_map(task.options.maps.detail), width, height);
  Image<std::uint8_t> detail(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float there = static_cast<float>(x) + 0.5f + (central_view - left_eye) * disparity(x, y);
      detail(x, y) = left(std::clamp(static_cast<int>(there), 0, width - 1), y);
    }
  return detail;
}

/// Shows the frame on the display, to other eyes than the film's own, or to these, over their pictures.
FrameShowing showing_of(const FrameTask& task, const FrameAtWork& frame, const TwoEyes& eyes, const SceneDepth& depth) {
  const RotoscopeOptions& options = task.options;
  const StereoPair& whole = task.whole;
  if (options.display)
    return {for_display({whole.left.width(), whole.left.height()}, depth, display_of(options), options.device), {}};
  const bool one_eye = whole.right.empty();
  FrameShowing showing{one_eye ? Presentation{.views = {central_view}} : for_two_eyes(eyes), {}};
  if (are_own_eyes(options, eyes) && options.style.background == Background::photograph) {
    showing.backgrounds.push_back(whole.left);
    if (!one_eye) showing.backgrounds.push_back(right_as_drawn(task, frame));
  }
  showing.presentation.device = options.device;
  showing.presentation.deep = task.deep && options.device == Device::processor;
  return showing;
}

/// Plans the frame, perhaps smaller than it is drawn. Strokes that are drawn for the film's own eyes are repaired by
/// what these see.
PlannedFrame plan_marks(const FilmFrame& frame, const FrameTask& task, const TwoEyes& eyes, const Style& style,
                        PaintingMemory& memory) {
  const RotoscopeOptions& options = task.options;
  if (task.reduction > 1) {
    PlannedFrame planned = plan_frame(frame, at_half_size(style), options.carrying, memory, task.progress);
    planned.painting =
        at_whole_size(std::move(planned.painting), {task.whole.left.width(), task.whole.left.height()}, style);
    return planned;
  }
  if (!are_own_eyes(options, eyes)) return plan_frame(frame, style, options.carrying, memory, task.progress);
  return plan_for_eyes(frame, style, options.carrying, memory, task.progress, options.device, task.deep);
}

/// The mask as the scene's frames are rectified, whose colours do not matter.
FrameMask rectified_mask(const FrameMask& mask, SceneRectification scene) {
  if (!scene.how) return mask;
  scene.colour.reset();
  const StereoPair eyes =
      rectified({picture_of_mask(mask.left), picture_of_mask(mask.right.empty() ? mask.left : mask.right)}, scene);
  return {mask_of_picture(eyes.left), mask.right.empty() ? Image<std::uint8_t>() : mask_of_picture(eyes.right)};
}

/// What each eye sees where the frame is not painted in its style.
ShownOutside outside_of(const FrameTask& task, FrameMask mask, const FrameAtWork& frame) {
  const StereoPair& whole = task.whole;
  ShownOutside outside;
  if (mask.right.empty() && !whole.right.empty())
    mask.right = mask_in_right_eye(mask.left, frame.geometry.left_disparity);
  const auto add = [&](Image<std::uint8_t>&& of_eye, const Image<Rgb8>& picture) {
    outside.masks.push_back(std::move(of_eye));
    if (!task.options.outside || task.options.outside->background == Background::photograph)
      outside.pictures.push_back(picture);
  };
  add(std::move(mask.left), whole.left);
  if (!whole.right.empty()) add(std::move(mask.right), right_as_drawn(task, frame));
  return outside;
}

/// Plans what is shown outside the mask.
void plan_outside(const FilmFrame& to_paint, const FrameTask& task, const FrameMask& mask, const FrameAtWork& frame,
                  RotoscopeState& state, PlannedFilmFrame& result) {
  const Stopwatch watch(result.painting_times.planning_s);
  ShownOutside& outside =
      result.showing.outside.emplace(outside_of(task, rectified_mask(mask, state.rectification), frame));
  if (const std::optional<Style>& style = task.options.outside)
    outside.painting = plan_marks(to_paint, task, result.eyes, *style, state.outside_memory).painting;
}

/// Compares the frame with the one before and adds it to the film's sums.
void accumulate_statistics(const RotoscopeOptions& options, RotoscopeState& state, PlannedFilmFrame& result) {
  const std::span<const Layer> layers = layers_of(result.painting);
  const double largest_step =
      1.0 / std::max(std::min(options.carrying.fade_in_frames, options.carrying.fade_out_frames), 1);
  if (!result.scene_begins) result.changes = compare_strokes(state.layers_before, layers, largest_step);
  RotoscopeTotals& totals = state.totals;
  totals.scenes += result.scene_begins ? 1 : 0;
  totals.whole_strokes += result.changes.whole;
  totals.survived_strokes += result.changes.survived;
  totals.popped_strokes += result.changes.popped;
  for (const Layer& layer : layers) totals.strokes += static_cast<std::int64_t>(count_strokes(layer));
  totals.moved_frames += are_moved(result.eyes) ? 1 : 0;
  totals.least_separation = std::min(totals.least_separation, static_cast<double>(result.eyes.separation));
  state.layers_before.assign(layers.begin(), layers.end());
}

/// Keeps what the next frame is compared with.
void remember(const Image<Rgb8>& left, FrameAtWork frame, RotoscopeState& state) {
  ++state.frames;
  ++state.frames_of_scene;
  state.left_before = left;
  state.left_disparity_before =
      std::move(frame.found_disparity.empty() ? frame.geometry.left_disparity : frame.found_disparity);
  state.central_before = std::move(frame.centre.picture);
  state.central_disparity_before = std::move(frame.centre.disparity);
}

}  // namespace

PlannedFilmFrame plan_film_frame(const StereoPair& photographed, const RotoscopeOptions& options, RotoscopeState& state,
                                 const KnownFrame* known, const Progress& progress, const FrameMask* mask,
                                 ImageView<const Rgb16> left_deep) {
  const bool has_depth = known != nullptr && known->depth;
  check_eyes(photographed, options, state, has_depth);
  if (mask != nullptr) check_mask(*mask, photographed, options);
  PlannedFilmFrame result;
  FirstLook first = rectify_frame({photographed, photographed, options, known, progress}, state, result);
  StereoPair eyes = std::move(first.eyes);
  KnownFrame made;
  if (has_depth) {
    MadePair pair = make_film_pair(eyes.left, *known->depth, options.depth, result.scene_begins, state.depth_range);
    eyes = std::move(pair.pictures);
    made = {std::move(pair.geometry), known->flow};
    known = &made;
  }
  const bool is_smaller = options.at_half_size && mask == nullptr && known == nullptr &&
                          may_be_planned_at_half_size(options.style, eyes.left.width());
  const StereoPair smaller = is_smaller ? at_half_size(eyes) : StereoPair();
  const FrameTask task{eyes,
                       is_smaller ? smaller : eyes,
                       options,
                       known,
                       progress,
                       std::move(first.to_before),
                       is_smaller ? 2 : 1,
                       first.is_lit_as_before,
                       options.deep && !left_deep.empty()};
  FrameAtWork frame = look_at(task, state, result.times);
  find_views(task, result.scene_begins, state, frame);
  const bool carries = !result.scene_begins && !options.anew;
  if (carries) {
    report(progress, "flow", 0);
    const Stopwatch watch(result.times.flow_s);
    state.flow_before = find_flow(frame, task, state);
  }
  state.detail = detail_of(task, frame, carries, state);
  if (!state.detail.empty()) frame.views.front().detail = state.detail;
  report(progress, "painting", 0);
  Image<Rgb16> rectified_deep;
  if (!left_deep.empty() && state.rectification.how)
    left_deep = rectified_deep = rectified_left(left_deep, *state.rectification.how);
  const FilmFrame to_paint{frame.views, carries ? &state.flow_before : nullptr, left_deep};
  if (has_own_eyes(options) && !eyes.right.empty())
    result.eyes = comfortable_eyes({eyes.left.width(), eyes.left.height()}, state.depth.ends,
                                   options.depth_budget.value_or(1.f), options.zero_parallax_px);
  {
    const Stopwatch watch(result.painting_times.planning_s);
    PlannedFrame planned = plan_marks(to_paint, task, result.eyes, options.style, state.memory);
    result.painting = std::move(planned.painting);
    result.counts = planned.counts;
    result.drawn = std::move(planned.drawn);
  }
  result.showing = showing_of(task, frame, result.eyes, state.depth);
  if (mask != nullptr) plan_outside(to_paint, task, *mask, frame, state, result);
  accumulate_statistics(options, state, result);

  remember(photographed.left, std::move(frame), state);
  return result;
}

void repeat_film_frame(const PlannedFilmFrame& before, RotoscopeState& state) {
  ++state.frames;
  for (const Layer& layer : layers_of(before.painting))
    state.totals.strokes += static_cast<std::int64_t>(count_strokes(layer));
  state.totals.moved_frames += are_moved(before.eyes) ? 1 : 0;
}

RotoscopedFrame rotoscope_frame(const StereoPair& photographed, const RotoscopeOptions& options, RotoscopeState& state,
                                const KnownFrame* known, const Progress& progress, const FrameMask* mask,
                                ImageView<const Rgb16> left_deep) {
  RotoscopedFrame result{plan_film_frame(photographed, options, state, known, progress, mask, left_deep), {}};
  report(progress, "drawing", 0);
  const Stopwatch watch(result.painting_times.rasterising_s);
  static_cast<DrawnFrame&>(result) = draw_film_frame(result.painting, result.showing, std::move(result.drawn));
  state.totals.worst_bare_share = std::max(state.totals.worst_bare_share, result.worst_bare_share);
  return result;
}

}  // namespace wheatstone
