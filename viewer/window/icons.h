#pragma once

#include <QIcon>
#include <span>
#include <string_view>

class QPalette;

namespace wheatstone::viewer {

/// The icons of the toolbar, in its order.
std::span<const std::string_view> tool_icons();

/// One of them in the colours of text, grey where it is disabled. An unknown name gives an empty one.
QIcon tool_icon(std::string_view name, const QPalette& palette);

}  // namespace wheatstone::viewer
