#pragma once

#include <QWidget>
#include <string>

class QLabel;

namespace wheatstone::viewer {

struct Session;

/// A label in the upper left corner that tells what is open and how it is shown.
QLabel* make_information(QWidget* parent);
void show_information(QLabel& label, const Session& session);

/// What the status bar says of a head tracker; empty where there is none.
std::string head_tracker_text(const Session& session);

void copy_to_clipboard(const std::string& text);

}  // namespace wheatstone::viewer
