#include "information.h"

#include <fmt/format.h>

#include <QApplication>
#include <QClipboard>
#include <QLabel>

#include "viewer/output_mode.h"
#include "viewer/session.h"

namespace wheatstone::viewer {
namespace {

std::string information_of(const Session& session) {
  const Item* const item = open_item(session);
  if (item == nullptr) return "nothing is open";
  std::string text;
  for (const auto& file : *item) text += file.filename().string() + "\n";
  const PictureSize size = size_of(session.opened.content);
  text += session.opened.kind;
  if (size.width > 0) text += fmt::format(", {}×{} pixels", size.width, size.height);
  if (const auto* const content = std::get_if<PaintedContent>(&session.opened.content); content && content->painting) {
    const MarkCount marks = count_marks(*content->painting);
    text += fmt::format("\n{}: {} {}", session.state.style.name, marks.count, marks.kind);
  }
  text +=
      fmt::format("\n{}, zero parallax {:.1f} px, eyes {:.2f} apart, head {:.2f}", session.state.mode,
                  session.state.adjustment.zero_parallax_px, session.state.adjustment.separation, session.state.head);
  if (const std::string seen = seen_views_told(session.state); !seen.empty()) text += "\n" + seen;
  if (session.state.crosstalk > 0) text += fmt::format("\ncrosstalk {:.0f} %", 100 * session.state.crosstalk);
  for (const std::string& note : session.opened.notes) text += "\n" + note;
  return text;
}

}  // namespace

std::string head_tracker_text(const Session& session) {
  if (!session.tracked_head) return {};
  return session.tracked_head->is_silent ? fmt::format("head tracker on port {} is silent", session.tracked_head->port)
                                         : "head is tracked";
}

QLabel* make_information(QWidget* parent) {
  auto* const label = new QLabel(parent);
  label->setAttribute(Qt::WA_TransparentForMouseEvents);
  label->setStyleSheet("background: rgba(0, 0, 0, 190); color: white; padding: 6px");
  label->hide();
  return label;
}

void show_information(QLabel& label, const Session& session) {
  label.setVisible(session.information);
  if (!session.information) return;
  label.setText(QString::fromStdString(information_of(session)));
  label.adjustSize();
  label.move(8, 8);
  label.raise();
}

void copy_to_clipboard(const std::string& text) { QApplication::clipboard()->setText(QString::fromStdString(text)); }

}  // namespace wheatstone::viewer
