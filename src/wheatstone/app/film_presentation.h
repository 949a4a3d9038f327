#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wheatstone/app/display_views.h"
#include "wheatstone/app/film_mask.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/video/frame.h"

namespace wheatstone {

/// A display with many views for which a film is painted: each frame becomes one quilt, or one picture with the views
/// interleaved under lenses.
struct FilmDisplay {
  DisplayViewsOptions views;
  std::optional<QuiltLayout> quilt;
  std::optional<LenticularScreen> screen;  ///< where there is no quilt
};

/// The depth of a scene of a film. Whatever is derived from it must neither jump nor fluctuate within a scene.
struct SceneDepth {
  DepthEnds first;  ///< of the scene's first frame
  DepthEnds ends;   ///< these widened, slowly, by what later frames show
};

/// Takes a frame's depth into that of its scene. A frame that is deeper widens the scene's depth by a small part of the
/// difference, so that the whole is reached in about a second; no frame narrows it.
void follow_depth(const DepthEnds& frame, bool scene_begins, SceneDepth& scene);

/// Which views beside the eyes the frames of a scene are planned for: the same for all of them.
ViewRange planned_views(PictureSize frame, const SceneDepth& scene, const DisplayViewsOptions& options);

/// Shows frames of a scene on the display, drawn by `device`. Throws Error{wrong_usage} as plan_display, and where the
/// display has neither a quilt nor a screen.
Presentation for_display(PictureSize frame, const SceneDepth& scene, const FilmDisplay& display, Device device);

/// The pictures of a frame: one for either eye, or a single one, of the one view of a film of one eye, or composed for
/// a display.
using FramePictures = std::variant<StereoPair, Image<Rgb8>>;

/// What is shown of a frame where it is not painted in its style.
struct ShownOutside {
  std::vector<Image<std::uint8_t>> masks;  ///< of each view, as FrameMask
  std::vector<Image<Rgb8>> pictures;       ///< of each view; behind the paint of `painting`, which may have none
  std::optional<Painting> painting;        ///< in another style; none: the pictures are shown
};

/// How a frame is shown, with the backgrounds that its presentation borrows.
struct FrameShowing {
  Presentation presentation;                 ///< without backgrounds
  std::vector<Image<Rgb8>> backgrounds;      ///< of each view, or none
  std::optional<ShownOutside> outside = {};  ///< not with a composition
};

/// A frame that was drawn.
struct DrawnFrame {
  FramePictures pictures;
  double worst_bare_share = 0;          ///< of the pixels of an eye or a view, 0..1
  std::vector<Image<Rgb16>> deep = {};  ///< either eye's picture, or the one view's, with 16 bits a channel; or none
};

/// Draws a frame, whose painting has all its marks. Frames are drawn in any order, with the same bytes. `drawn` has the
/// presentation's views where they are drawn already. Throws as `present`.
DrawnFrame draw_film_frame(const Painting& painting, const FrameShowing& showing, std::vector<DrawnView> drawn = {});

/// The frame as a film has it, without its time: two eyes put together, as put_into_frame. Anaglyphs have 8 bits.
Frame frame_in_film(DrawnFrame drawn, StereoLayout layout, std::string_view anaglyph);

/// Puts `share`, 0..1, of a frame over the rest of another one of its size.
void dissolve_from(const Frame& outgoing, float share, Frame& frame);

/// The sentence that a film's comment has if the eyes were moved together in this many frames, to no less than this
/// separation; empty where there was none.
std::string moved_eyes_note(std::int64_t frames, double least_separation);

/// Whether a film's comment has that sentence.
bool tells_moved_eyes(std::string_view comment);

}  // namespace wheatstone
