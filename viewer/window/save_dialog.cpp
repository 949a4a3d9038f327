#include "save_dialog.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QString>
#include <QStringList>
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "viewer/save_as.h"

namespace wheatstone::viewer {
namespace {

/// An option of `wheatstone pack` that crops or frames what is saved.
struct FramingField {
  std::string_view option;
  QLineEdit* edit;
};

std::vector<FramingField> add_framing_fields(QFileDialog& dialog) {
  auto* const grid = qobject_cast<QGridLayout*>(dialog.layout());
  if (grid == nullptr) return {};
  struct Text {
    std::string_view option;
    const char *label, *example;
  };
  constexpr std::array<Text, 4> texts{{{"crop", "Crop:", "4:3, or 800x600+20+10"},
                                       {"border", "Border:", "3%, or 40,black"},
                                       {"caption", "Caption:", "{title}, {date}"},
                                       {"floating-window", "Floating window:", "auto, or LEFT,RIGHT in pixels"}}};
  std::vector<FramingField> fields;
  for (const Text& text : texts) {
    auto* const edit = new QLineEdit(&dialog);
    edit->setPlaceholderText(QString::fromUtf8(text.example));
    auto* const label = new QLabel(text.label, &dialog);
    label->setBuddy(edit);
    const int row = grid->rowCount();
    grid->addWidget(label, row, 0);
    grid->addWidget(edit, row, 1);
    fields.push_back({text.option, edit});
  }
  return fields;
}

}  // namespace

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
  const std::vector<FramingField> framing = add_framing_fields(dialog);
  const auto chosen = [&]() -> const SaveFormat& {
    return save_formats()[static_cast<std::size_t>(
        std::max(formats.indexOf(dialog.selectedNameFilter()), qsizetype{0}))];
  };
  const auto propose = [&] {
    dialog.setDefaultSuffix(QString::fromStdString(std::string(chosen().ending)));
    dialog.selectFile(QString::fromStdString(proposed_name_as(session, chosen().name)));
    // The picture of the window is saved as it is.
    for (const FramingField& field : framing) field.edit->setEnabled(chosen().name != "picture");
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
  Words words{std::string(chosen().name), file.toStdString()};
  for (const FramingField& field : framing)
    if (const QString value = field.edit->text().trimmed(); field.edit->isEnabled() && !value.isEmpty())
      words.push_back(std::string(field.option) + "=" + value.toStdString());
  return words;
}

}  // namespace wheatstone::viewer
