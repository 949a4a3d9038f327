#pragma once

namespace wheatstone::viewer {

/// Called once the QApplication is there, which takes the user's locale, and before any window: numbers have points in
/// the panels, as in the English of the menus, and where the C library reads and writes them.
void use_plain_numbers();

}  // namespace wheatstone::viewer
