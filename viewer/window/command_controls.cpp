#include "command_controls.h"

#include <fmt/format.h>

#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPixmap>
#include <QPushButton>
#include <QSlider>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>

#include "menus.h"
#include "viewer/viewer.h"

namespace wheatstone::viewer {
namespace {

int decimals_of(double step) { return step >= 1 ? 0 : step >= 0.1 ? 1 : 2; }

}  // namespace

CommandControls::CommandControls(std::string_view menu, bool with_choices, QFormLayout& form, DoCommand do_command)
    : do_command_(std::move(do_command)), form_(form) {
  QWidget* const parent = form.parentWidget();
  for (const Command& command : command_table()) {
    if (command.menu != menu || command.entry.now == nullptr || command.entry.is_for_scripts) continue;
    if (command.entry.range.step > 0)
      rows_.push_back(slider_of(command, parent));
    else if (with_choices && command.arguments == "on|off")
      rows_.push_back(switch_of(command, parent));
    else if (command.entry.is_text)
      rows_.push_back(line_of(command, parent));
    else if (with_choices && has_choices(command))
      rows_.push_back(box_of(command, parent));
    else if (command.arguments == "COLOUR")
      rows_.push_back(colour_of(command, parent));
    else
      continue;
    QWidget* const control = rows_.back().control;
    const QString title = QString::fromStdString(title_of(command));
    control->setToolTip(QString::fromUtf8(command.text));
    control->setAccessibleName(title);
    auto* const label = new QLabel(title, parent);
    label->setToolTip(control->toolTip());
    form.addRow(label, control);
  }
}

CommandControls::Row CommandControls::slider_of(const Command& command, QWidget* parent) {
  const SteppedRange range = command.entry.range;
  auto* const both = new QWidget(parent);
  auto* const line = new QHBoxLayout(both);
  line->setContentsMargins(0, 0, 0, 0);
  auto* const slider = new QSlider(Qt::Horizontal, both);
  slider->setRange(0, static_cast<int>(std::lround((range.most - range.least) / range.step)));
  slider->setMinimumWidth(80);
  auto* const box = new QDoubleSpinBox(both);
  box->setDecimals(decimals_of(range.step));
  box->setSingleStep(range.step);
  box->setRange(range.least, range.most);
  line->addWidget(slider, 1);
  line->addWidget(box);
  QObject::connect(slider, &QSlider::valueChanged, box,
                   [box, range](int at) { box->setValue(range.least + range.step * at); });
  QObject::connect(box, &QDoubleSpinBox::valueChanged, both, [this, &command](double value) {
    do_command_(std::string(command.name), {fmt::format("{:.6g}", value)});
  });
  return {&command, both, [&command, slider, box, range](const Viewer& viewer) {
            const std::string now = command.entry.now(viewer);
            const QSignalBlocker quiet_slider(slider), quiet_box(box);
            char* end = nullptr;
            const double number = std::strtod(now.c_str(), &end);
            box->setSpecialValueText(end == now.c_str() ? QString::fromStdString(now) : QString());
            if (end == now.c_str()) return box->setValue(range.least);  // "auto"
            // A script may go beyond what a hand needs.
            box->setRange(std::min(range.least, number), std::max(range.most, number));
            if (!box->hasFocus()) box->setValue(number);
            slider->setValue(static_cast<int>(std::lround((number - range.least) / range.step)));
          }};
}

CommandControls::Row CommandControls::box_of(const Command& command, QWidget* parent) {
  auto* const box = new QComboBox(parent);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(12);
  QObject::connect(box, &QComboBox::activated, parent, [this, &command, box] {
    do_command_(std::string(command.name), words_of(box->currentData().toString().toStdString()));
  });
  return {&command, box, [&command, box](const Viewer& viewer) {
            const QSignalBlocker quiet(box);
            if (box->count() == 0)
              for (const Choice& choice : choices_of(viewer, command))
                box->addItem(QString::fromStdString(choice.text), QString::fromStdString(choice.words));
            box->setCurrentIndex(box->findData(QString::fromStdString(command.entry.now(viewer))));
          }};
}

CommandControls::Row CommandControls::switch_of(const Command& command, QWidget* parent) {
  auto* const box = new QCheckBox(parent);
  QObject::connect(box, &QCheckBox::toggled, parent,
                   [this, &command](bool is_on) { do_command_(std::string(command.name), {on_or_off(is_on)}); });
  return {&command, box, [&command, box](const Viewer& viewer) {
            const QSignalBlocker quiet(box);
            box->setChecked(command.entry.now(viewer) == "on");
          }};
}

/// "CONDITION|all" is typed, or nothing for "all".
CommandControls::Row CommandControls::line_of(const Command& command, QWidget* parent) {
  auto* const line = new QLineEdit(parent);
  const std::string none(command.arguments.substr(command.arguments.find('|') + 1));
  line->setPlaceholderText(QString::fromStdString(none));
  QObject::connect(line, &QLineEdit::editingFinished, parent, [this, &command, line, none] {
    if (!line->isModified()) return;
    line->setModified(false);
    const std::string typed = line->text().trimmed().toStdString();
    do_command_(std::string(command.name), {typed.empty() ? none : typed});
  });
  return {&command, line, [&command, line, none](const Viewer& viewer) {
            if (line->hasFocus() && line->isModified()) return;
            const std::string now = command.entry.now(viewer);
            const QString text = now == none ? QString() : QString::fromStdString(now);
            if (text != line->text()) line->setText(text);
          }};
}

CommandControls::Row CommandControls::colour_of(const Command& command, QWidget* parent) {
  auto* const button = new QPushButton(parent);
  QObject::connect(button, &QPushButton::clicked, parent, [this, &command, button] {
    const QColor chosen =
        QColorDialog::getColor(QColor("#" + button->text()), button, QString::fromStdString(title_of(command)));
    if (chosen.isValid()) do_command_(std::string(command.name), {chosen.name().mid(1).toStdString()});
  });
  return {&command, button, [&command, button](const Viewer& viewer) {
            const QString now = QString::fromStdString(command.entry.now(viewer));
            if (now == button->text()) return;
            button->setText(now);
            QPixmap patch(16, 16);
            patch.fill(QColor("#" + now));
            button->setIcon(patch);
          }};
}

void CommandControls::show(const Viewer& viewer) {
  for (const Row& row : rows_) {
    row.show(viewer);
    const bool has_effect = applies(viewer, *row.command);
    row.control->setEnabled(has_effect);
    form_.labelForField(row.control)->setEnabled(has_effect);
  }
}

}  // namespace wheatstone::viewer
