#pragma once

#include <QAction>
#include <functional>
#include <optional>
#include <vector>

#include "viewer/command_table.h"

class QMainWindow;
class QMenu;
class QToolBar;

namespace wheatstone::viewer {

/// The menus, the toolbar and the keys, all made from the table of commands.
class Menus {
 public:
  /// Does a command; where arguments are missing, asks for files first.
  using Do = std::function<void(const Command&, const Words&)>;

  Menus(QMainWindow& window, Do run);

  /// Does a command whose arguments are asked for.
  void ask(const Command& command) { run_(command, {}); }
  /// Ticks what is on, and greys what does not apply.
  void show(const Viewer& viewer);
  QToolBar& toolbar() { return *toolbar_; }
  QMenu* file_menu() { return file_menu_; }

 private:
  struct Shown {
    const Command* command;
    QAction* action;
    QMenu* submenu;  ///< of its choices; none where it has none
  };
  void add(const Command& command, QMenu& menu);
  void fill(QMenu& submenu, const Command& command);
  void add_to_toolbar(const Shown& shown);

  QMainWindow& window_;
  Do run_;
  const Viewer* viewer_ = nullptr;
  QToolBar* toolbar_;
  QMenu* file_menu_ = nullptr;
  std::vector<Shown> shown_;
  bool was_dark_ = false;
};

/// Whether a menu can show a command: what takes anything but choices and files is set in panels, by the pointer and by
/// scripts.
bool has_entry(const Command& command);

/// Whether the argument is one of several, which a submenu or a box shows.
bool has_choices(const Command& command);

}  // namespace wheatstone::viewer
