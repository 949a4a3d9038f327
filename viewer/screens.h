#pragma once

#include <span>
#include <string>

#include "session.h"

namespace wheatstone::viewer {

/// A screen of the window system.
struct Screen {
  std::string name;           ///< what its maker calls it
  int width = 0, height = 0;  ///< its own pixels
};

/// The number, from 1, of the screen that a session's picture is to fill: the one that was asked for; else the one that
/// is called as the session's display, or in a mode that shows all the display's views, the one that has its lenses'
/// size. 0: the one that the window is on.
int screen_to_fill(const Session& session, std::span<const Screen> screens);

/// A rectangle of the desktop, in the window system's units.
struct DesktopArea {
  int left = 0, top = 0, width = 0, height = 0;
  friend bool operator==(const DesktopArea&, const DesktopArea&) = default;
};

/// Nothing of a window is on a screen.
bool is_lost(const DesktopArea& window, std::span<const DesktopArea> screens);

/// Where a lost window comes to stand: in the middle of what windows may fill, and no larger than that.
DesktopArea brought_to(const DesktopArea& available, const DesktopArea& window);

/// Where what can be made again is kept.
std::filesystem::path cache_folder();

class Viewer;

/// Has the Looking Glass that is attached taken as the screen: another program of ours asks Looking Glass Bridge for
/// its calibration, beside all else. What fails is told.
void use_screen_of_bridge(Viewer& viewer);

}  // namespace wheatstone::viewer
