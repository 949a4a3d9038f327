#pragma once

#include "viewer.h"

namespace wheatstone::viewer {

/// What a command changes of a session, so that it can be undone: to be made before the command, and `keep` called
/// behind it. From where one looks (zoom, pan, head, orbit, the side of layers, the photograph) is not undone.
class Change {
 public:
  explicit Change(const Session& session) : before_(session.state), target_before_(session.zero_parallax_target_px) {}
  /// Keeps the state before for `undo` where something that can be undone has changed.
  void keep(Session& session) const;

 private:
  ViewState before_;
  std::optional<float> target_before_;
};

void undo(Viewer& viewer);
void redo(Viewer& viewer);

}  // namespace wheatstone::viewer
