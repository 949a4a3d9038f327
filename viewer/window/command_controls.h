#pragma once

#include <QString>
#include <QWidget>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "panels.h"

class QFormLayout;

namespace wheatstone::viewer {

class Viewer;

/// A control for each command of a menu whose argument is a number, a choice, a switch or a text: what a panel shows of
/// the table of commands.
class CommandControls {
 public:
  /// Adds a row for each to a form. Switches and choices are left to the menus where `with_choices` is false.
  CommandControls(std::string_view menu, bool with_choices, QFormLayout& form, DoCommand do_command);

  void show(const Viewer& viewer);

 private:
  struct Row {
    const Command* command;
    QWidget* control;
    std::function<void(const Viewer&)> show;
  };
  Row slider_of(const Command& command, QWidget* parent);
  Row box_of(const Command& command, QWidget* parent);
  Row switch_of(const Command& command, QWidget* parent);
  Row line_of(const Command& command, QWidget* parent);
  Row colour_of(const Command& command, QWidget* parent);

  DoCommand do_command_;
  QFormLayout& form_;
  std::vector<Row> rows_;
};

}  // namespace wheatstone::viewer
