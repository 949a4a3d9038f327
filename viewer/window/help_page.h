#pragma once

#include <functional>

class QWidget;

namespace wheatstone::viewer {

/// A page of all keys and commands, which can be searched. `close` is called where it is to go: with Esc, or by its
/// window.
QWidget* make_help_page(QWidget* parent, std::function<void()> close);

}  // namespace wheatstone::viewer
