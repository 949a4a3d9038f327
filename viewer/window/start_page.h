#pragma once

#include <QWidget>
#include <vector>

#include "panels.h"
#include "viewer/jobs.h"
#include "viewer/session.h"

class QButtonGroup;
class QLabel;
class QPushButton;
class QListWidget;

namespace wheatstone::viewer {

/// What stands where nothing is open: open, recent files, an example, and what somebody looks with.
class StartPage final : public QWidget {
 public:
  /// `ask_to_open` shows a dialog for files.
  StartPage(DoCommand do_command, std::function<void()> ask_to_open);

  void show_recent(const std::vector<Item>& recent);
  void show_session(const Session& session);

 private:
  QWidget* make_left_column();
  QWidget* make_recent();
  QWidget* make_devices();
  /// Of the theme.
  void take_colours();
  void changeEvent(QEvent* event) override;

  DoCommand do_command_;
  std::function<void()> ask_to_open_;
  QListWidget* recent_ = nullptr;
  QLabel *no_recent_ = nullptr, *drop_ = nullptr;
  QPushButton* open_ = nullptr;
  QButtonGroup* devices_ = nullptr;
  std::vector<Item> shown_;
  NewestJob thumbnails_;  ///< last: it ends first
};

}  // namespace wheatstone::viewer
