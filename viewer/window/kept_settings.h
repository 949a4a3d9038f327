#pragma once

#include <QStringList>
#include <vector>

#include "viewer/session.h"

class QMenu;

namespace wheatstone::viewer {

class Window;

/// What stays from one session to the next: what somebody looks with, the output mode, the display, the style, the
/// panel, the folder of dialogs, the window's size, and the files that were opened last. Not for scripts, which begin
/// the same every time.
class KeptSettings {
 public:
  /// Puts the recent files into the window's first menu.
  explicit KeptSettings(Window& window);

  /// Brings mode and display back, and the size where it is wanted. What does not fit any more is left out.
  void restore(bool with_size);
  void keep();

 private:
  std::vector<Item> recent() const;
  /// A line each; those that are open first.
  QStringList recent_files() const;
  void fill_menu(QMenu& menu);

  Window& window_;
};

}  // namespace wheatstone::viewer
