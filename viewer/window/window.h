#pragma once

#include <QApplication>
#include <QMainWindow>
#include <QPalette>
#include <QPointF>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>

#include "brush_pointer.h"
#include "event_loop.h"
#include "film_bar.h"
#include "full_screen.h"
#include "menus.h"
#include "panels.h"
#include "picture_surface.h"
#include "start_page.h"
#include "viewer/command_table.h"
#include "viewer/script.h"
#include "viewer/viewer.h"

class QLabel;
class QProgressBar;
class QStackedWidget;

namespace wheatstone::viewer {

struct WindowOptions {
  OpenglUse opengl = OpenglUse::where_fast;
  bool stereo = false;       ///< a picture for each eye in turn, by the graphics card
  bool with_dialogs = true;  ///< errors and missing OpenGL are told in dialogs; a script has none
};

/// The window: what the user does becomes commands of the table, and what the session shows is shown. Nothing is
/// decided here.
class Window final : public QMainWindow {
 public:
  explicit Window(const WindowOptions& options);
  ~Window() override;

  Viewer& viewer() { return viewer_; }
  /// Runs a script, and ends the program behind it; `exit_code` then says how.
  void run(std::unique_ptr<Script> script);
  int exit_code() const { return exit_code_; }
  /// Does the lines of other programs.
  void listen(std::unique_ptr<Control> control);
  /// Removes their socket.
  void close_control() { control_.reset(); }
  /// Closes the window and all its dialogs; the program is to end with that code.
  void end(int exit_code);
  StartPage& start_page() { return *start_page_; }
  Menus& menus() { return *menus_; }
  /// What the script asks of the window.
  ScriptHost script_host();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void moveEvent(QMoveEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void make_status_bar();
  /// Does a command of the table; what it throws is told.
  void do_command(const Command& command, const Words& arguments);
  void do_line(const std::string& name, const Words& arguments);
  /// As do_line, for what is chosen in a panel: the keys are the picture's again.
  void do_in_panel(const std::string& name, const Words& arguments);
  /// Asks whether what no file holds is to be saved; false where the window is to stay.
  bool may_close();
  /// Asks for the files that a command needs.
  std::optional<Words> ask_for_arguments(const Command& command);

  void refresh();
  void show_session();
  void show_depth_under_pointer();
  void go_on_with_script();
  /// C shows the photograph as long as it is held.
  bool compares_while_held(QEvent* event);
  bool pointer_event(QEvent* event);
  void drag_to(const QPointF& place);
  void turn_wheel(const QWheelEvent& wheel, double ratio);
  void save_screenshot(const std::filesystem::path& path);
  std::vector<std::pair<std::string, double>> measured();

  WindowOptions options_;
  std::unique_ptr<PictureSurface> surface_;
  std::unique_ptr<Script> script_;
  int exit_code_ = 0;

  std::unique_ptr<ControlLink> control_;
  Heartbeat heartbeat_;
  FullScreen full_screen_;
  int filled_screen_ = 0;  ///< number
  QTimer step_timer_, script_timer_, click_timer_;
  QLabel* message_ = nullptr;
  QLabel* depth_ = nullptr;
  QLabel* place_ = nullptr;
  QLabel* tracker_ = nullptr;
  QLabel* comfort_ = nullptr;
  QProgressBar* progress_ = nullptr;
  FilmBar* film_bar_ = nullptr;
  QLabel* information_ = nullptr;
  QWidget* help_ = nullptr;
  std::unique_ptr<Panels> panels_;
  std::unique_ptr<Menus> menus_;
  QStackedWidget* pages_ = nullptr;
  StartPage* start_page_ = nullptr;
  std::unique_ptr<BrushPointer> brush_;
  bool is_asking_ = false;

  QPointF pressed_at_, dragged_to_, pointer_;
  bool is_pressed_ = false, is_dragged_ = false, pans_ = false;
  std::uint64_t shown_frame_ = 0;
  std::optional<std::size_t> held_plane_;  ///< the slicing plane that is dragged
  Theme shown_theme_ = Theme::desktop;
  const QPalette desktop_palette_ = QApplication::palette();

  Viewer viewer_;  ///< last: its threads end before what they wake
};

}  // namespace wheatstone::viewer
