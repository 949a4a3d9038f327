#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "compose.h"
#include "content.h"
#include "head_tracker.h"
#include "session.h"

namespace wheatstone::viewer {

class Viewer;

/// What moves a session's view besides commands and time.
class Inputs {
 public:
  /// Follows a head from now on, or no longer. Throws as HeadTracker does; the head is then followed as before.
  void track_head(std::optional<std::uint16_t> port, Session& session);
  /// Takes over what has arrived.
  void go_on(Session& session, double now_s);
  /// Seconds after which go_on is to be called; none where nothing is followed.
  std::optional<double> next_step_s() const;

 private:
  std::unique_ptr<HeadTracker> tracker_;
};

/// Somebody looks at that pixel of the frame: the plane of zero parallax moves to what lies there (Stavrakis & Gelautz
/// 2005, section 4), and so does more depth where the session has it (Hassaine 2010, section 6.3), unless the gaze only
/// trembles around where it was.
void look_at(Viewer& viewer, double x, double y);

/// Chooses how much depth there is where somebody looks, and elsewhere.
void set_gaze_gains(Session& session, const GazeGains& gains);

/// Moves more depth on towards where somebody looks: around a surface of a painting, and in an area of the views of
/// particles and slices.
void move_gaze_depth(Session& session, double passed_s);

/// Whether it has not arrived there.
bool gaze_depth_moves(const Session& session);

/// The disparity of what is seen at a place, in pixels of the content; none where it is not known.
std::optional<float> disparity_at(const Content& content, const PlaceInView& place);

/// A place of what is shown.
struct SeenPlace {
  float x = 0, y = 0;      ///< pixels of the view in which a painting's depth moves nothing, its reference view
  float disparity_px = 0;  ///< without more depth where somebody looks
};

/// What is seen at a pixel of a viewer's frame; none where its depth is not known.
std::optional<SeenPlace> seen_at(const Viewer& viewer, double x, double y);

/// What is seen there, in pixels of the left view, and the disparity that the photograph is painted with there.
std::optional<SeenPlace> seen_in_left(const Viewer& viewer, double x, double y);

/// The disparity of what is seen at a pixel of a viewer's frame, in pixels of the content; none where it is not known.
std::optional<float> disparity_under(const Viewer& viewer, double x, double y);

}  // namespace wheatstone::viewer
