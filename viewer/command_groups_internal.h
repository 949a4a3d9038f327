#pragma once

#include <span>

#include "command_table.h"

namespace wheatstone::viewer {

// The parts of the table, in its order, one a file.
std::span<const Command> file_commands();
std::span<const Command> looking_commands();
std::span<const Command> depth_commands();
std::span<const Command> input_commands();
std::span<const Command> painting_commands();
std::span<const Command> film_commands();
std::span<const Command> particle_commands();
std::span<const Command> quantity_commands();
std::span<const Command> camera_commands();
std::span<const Command> panel_commands();

inline ViewState& state_of(Viewer& viewer) { return viewer.session().state; }

/// Throws Error{wrong_usage} before the first frame.
const Frame& frame_of(const Viewer& viewer);

}  // namespace wheatstone::viewer
