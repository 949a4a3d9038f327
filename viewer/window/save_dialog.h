#pragma once

#include <optional>

#include "viewer/command_table.h"

class QWidget;

namespace wheatstone::viewer {

/// Asks for a format and a file, for the command `save-as`, with a name proposed for each format. None where nobody
/// wants to save.
std::optional<Words> ask_how_to_save(QWidget& parent, Session& session);

}  // namespace wheatstone::viewer
