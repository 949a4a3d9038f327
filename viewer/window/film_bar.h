#pragma once

#include <QToolBar>
#include <functional>
#include <string>

#include "viewer/command_table.h"
#include "viewer/session.h"

class QLabel;
class QProgressBar;
class QSlider;
class QToolButton;

namespace wheatstone::viewer {

/// The bar under a film: play, where one is in it, the time; and how far the whole film is painted.
class FilmBar final : public QToolBar {
 public:
  /// `run` does a command of the table.
  FilmBar(QWidget* parent, std::function<void(const std::string& name, const Words& arguments)> run);

  /// Hidden where no film is open or painted.
  void show_session(const Session& session);

 private:
  QToolButton* play_ = nullptr;
  QSlider* slider_ = nullptr;
  QLabel* time_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QToolButton* cancel_ = nullptr;
  QAction* progress_action_ = nullptr;
  QAction* cancel_action_ = nullptr;
};

}  // namespace wheatstone::viewer
