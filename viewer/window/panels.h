#pragma once

#include <functional>
#include <memory>
#include <string>

#include "viewer/command_table.h"

class QMainWindow;

namespace wheatstone::viewer {

class Viewer;

/// Does a command of the table.
using DoCommand = std::function<void(const std::string& name, const Words& arguments)>;

/// The panels beside the picture. What the user does in them becomes commands; they show what the session has.
class Panels {
 public:
  Panels(QMainWindow& window, DoCommand do_command);
  ~Panels();

  /// To be called whenever the session may have changed.
  void show(const Viewer& viewer);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace wheatstone::viewer
