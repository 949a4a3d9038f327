#include "theme.h"

#include <QColor>

namespace wheatstone::viewer {

QPalette palette_of(Theme theme, const QPalette& of_desktop) {
  if (theme == Theme::desktop) return of_desktop;
  // Qt derives all other colours from those of a button and of the window.
  if (theme == Theme::light) return {QColor(239, 239, 239), QColor(239, 239, 239)};
  QPalette dark(QColor(56, 56, 56), QColor(40, 40, 40));
  dark.setColor(QPalette::Base, QColor(28, 28, 28));
  dark.setColor(QPalette::AlternateBase, QColor(36, 36, 36));
  dark.setColor(QPalette::ToolTipBase, QColor(56, 56, 56));
  dark.setColor(QPalette::ToolTipText, Qt::white);
  dark.setColor(QPalette::Link, QColor(110, 170, 255));
  dark.setColor(QPalette::Highlight, QColor(48, 110, 190));
  dark.setColor(QPalette::HighlightedText, Qt::white);
  return dark;
}

}  // namespace wheatstone::viewer
