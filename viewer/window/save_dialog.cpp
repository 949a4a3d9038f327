#include "save_dialog.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QString>
#include <QStringList>
#include <algorithm>

#include "viewer/save_as.h"

namespace wheatstone::viewer {

std::optional<Words> ask_how_to_save(QWidget& parent, Session& session) {
  QStringList formats;
  for (const SaveFormat& format : save_formats())
    formats << QString::fromStdString(format.text +
                                      (format.ending.empty() ? " (*)" : " (*" + std::string(format.ending) + ")"));
  QFileDialog dialog(&parent, "Save as", QString::fromStdString(session.folder.string()));
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  // The window system's own dialogs do not tell when another format is chosen.
  dialog.setOption(QFileDialog::DontUseNativeDialog);
  dialog.setNameFilters(formats);
  const auto chosen = [&]() -> const SaveFormat& {
    return save_formats()[static_cast<std::size_t>(
        std::max(formats.indexOf(dialog.selectedNameFilter()), qsizetype{0}))];
  };
  const auto propose = [&] {
    dialog.setDefaultSuffix(QString::fromStdString(std::string(chosen().ending)));
    dialog.selectFile(QString::fromStdString(proposed_name_as(session, chosen().name)));
  };
  const auto as_seen = std::ranges::find(save_formats(), session.state.mode, &SaveFormat::name);
  if (as_seen != save_formats().end())
    dialog.selectNameFilter(formats[static_cast<qsizetype>(as_seen - save_formats().begin())]);
  dialog.setLabelText(QFileDialog::FileType, "Format:");
  QObject::connect(&dialog, &QFileDialog::filterSelected, &dialog, propose);
  propose();
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) return {};
  const QString file = dialog.selectedFiles().front();
  session.folder = QFileInfo(file).absolutePath().toStdString();
  return Words{std::string(chosen().name), file.toStdString()};
}

}  // namespace wheatstone::viewer
