#pragma once

#include "session.h"

namespace wheatstone::viewer {

class Viewer;

/// Somebody looks at that pixel of the frame: the plane of zero parallax moves to what lies there (Stavrakis & Gelautz
/// 2005, section 4), and so does more depth where the session has it (Hassaine 2010, section 6.3), unless the gaze only
/// trembles around where it was.
void look_at(Viewer& viewer, double x, double y);

/// Chooses how much depth there is where somebody looks, and elsewhere.
void set_gaze_gains(Session& session, const GazeGains& gains);

/// Moves more depth on towards where somebody looks.
void move_depth_around(Session& session, double passed_s);

}  // namespace wheatstone::viewer
