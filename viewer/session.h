#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "content.h"
#include "view_state.h"

namespace wheatstone::viewer {

/// One thing that can be opened: a file, or the two eyes of a photograph.
using Item = std::vector<std::filesystem::path>;

/// What is under way, for a progress bar.
struct Activity {
  std::string step;
  double done = 0;  ///< 0..1
};

/// All that a viewer knows: plain data.
struct Session {
  std::vector<Item> items;
  std::size_t item = 0;  ///< that is open
  Opened opened;
  ContentSize eye;  ///< of the picture that each eye is shown, in screen pixels
  ViewState state;
  std::optional<float> zero_parallax_target_px;  ///< what it moves to
  std::vector<ViewState> done, undone;           ///< states before, for undo and redo
  std::optional<Activity> opening;               ///< reading and painting
  std::string message;                           ///< the last error or remark, one line
  bool message_is_error = false;
  bool full_screen = false, information = false, help = false;
  int screens = 1;      ///< that there are
  int screen = 0;       ///< that is filled, from 1; 0: the display's own, or the window's
  bool stereo = false;  ///< the graphics card shows a picture for each eye in turn
  bool ends = false;
  int exit_code = 0;
};

/// The files of what is open; none where nothing is.
const Item* open_item(const Session& session);

}  // namespace wheatstone::viewer
