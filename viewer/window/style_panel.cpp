#include "style_panel.h"

#include <fmt/format.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "viewer/viewer.h"

namespace wheatstone::viewer {
namespace {

constexpr int settles_after_ms = 120;

}  // namespace

StylePanel::StylePanel(DoCommand do_command)
    : do_command_(std::move(do_command)),
      widget_(new QWidget),
      remark_(new QLabel(widget_)),
      styles_(new StyleStrip(widget_, do_command_)),
      layers_(new QSlider(Qt::Horizontal, widget_)),
      form_(new QFormLayout(widget_)) {
  remark_->setWordWrap(true);
  form_->addRow(remark_);
  form_->addRow(styles_);
  layers_->setAccessibleName("Layers of detail");
  layers_->setTickPosition(QSlider::TicksBelow);
  layers_->setPageStep(1);
  QObject::connect(layers_, &QSlider::valueChanged, widget_,
                   [this](int layer) { do_command_("finest-layer", {fmt::format("{}", layer)}); });
  form_->addRow("Detail", layers_);
  auto* const read = new QPushButton("From a file…", widget_);
  QObject::connect(read, &QPushButton::clicked, widget_, [this] {
    const QString name = QFileDialog::getOpenFileName(widget_, "Style", {}, "Styles (*.toml)");
    if (!name.isEmpty()) do_command_("style", {name.toStdString()});
  });
  auto* const save = new QPushButton("Save style…", widget_);
  QObject::connect(save, &QPushButton::clicked, widget_, [this] {
    const QString name = QFileDialog::getSaveFileName(widget_, "Save style", {}, "Styles (*.toml)");
    if (!name.isEmpty()) do_command_("save-style", {name.toStdString()});
  });
  form_->addRow(read, save);
  for (std::size_t section = 0; section < style_section_names.size(); ++section) {
    headings_[section] = new QLabel(QString("<b>%1</b>").arg(QString::fromUtf8(style_section_names[section])), widget_);
    headings_[section]->setContentsMargins(0, 8, 0, 0);
    form_->addRow(headings_[section]);
    for (const StyleControl& control : style_controls())
      if (control.parameter->section == static_cast<StyleSection>(section)) add_row(control);
  }
  timer_.setSingleShot(true);
  QObject::connect(&timer_, &QTimer::timeout, widget_, [this] {
    for (const auto& [name, value] : std::exchange(waiting_, {})) do_command_("set", {name, value});
  });
}

void StylePanel::add_row(const StyleControl& control) {
  const StyleParameter& parameter = *control.parameter;
  rows_.push_back(make_row(control));
  QWidget& widget = *rows_.back().control;
  const QString title = QString::fromUtf8(parameter.title);
  const QString help = QString("%1 (%2)").arg(QString::fromUtf8(parameter.help), QString::fromUtf8(parameter.name));
  widget.setToolTip(help);
  widget.setAccessibleName(title);
  auto* const label = new QLabel(title, widget_);
  label->setToolTip(help);
  form_->addRow(label, &widget);
}

StylePanel::Row StylePanel::make_row(const StyleControl& control) {
  const StyleParameter& parameter = *control.parameter;
  if (const auto* const range = std::get_if<NumberControl>(&control.kind)) return make_number(parameter, *range);
  if (std::holds_alternative<SwitchControl>(control.kind)) return make_switch(parameter);
  if (const auto* const choice = std::get_if<ChoiceControl>(&control.kind)) return make_choice(parameter, *choice);
  return make_text(parameter);
}

StylePanel::Row StylePanel::make_number(const StyleParameter& parameter, const NumberControl& range) {
  auto* const both = new QWidget(widget_);
  auto* const line = new QHBoxLayout(both);
  line->setContentsMargins(0, 0, 0, 0);
  auto* const slider = new QSlider(Qt::Horizontal, both);
  slider->setRange(0, static_cast<int>(std::lround((range.most - range.least) / range.step)));
  slider->setMinimumWidth(90);
  auto* const box = new QDoubleSpinBox(both);
  const bool is_whole = range.step == std::floor(range.step) && range.step == 1;
  box->setDecimals(is_whole ? 0 : 3);
  box->setRange(range.least, range.most);
  box->setSingleStep(range.step);
  line->addWidget(slider, 1);
  line->addWidget(box);
  QObject::connect(slider, &QSlider::valueChanged, both,
                   [box, range](int at) { box->setValue(range.least + range.step * at); });
  QObject::connect(box, &QDoubleSpinBox::valueChanged, both, [this, &parameter, slider, range](double value) {
    const QSignalBlocker quiet(slider);
    slider->setValue(static_cast<int>(std::lround((value - range.least) / range.step)));
    set_soon(parameter, fmt::format("{}", static_cast<float>(value)));
  });
  return {&parameter,
          both,
          [box, slider, range](const std::string& value) {
            const QSignalBlocker quiet_box(box), quiet_slider(slider);
            const double number = std::strtod(value.c_str(), nullptr);
            // A file may go beyond what a hand needs.
            box->setRange(std::min(range.least, number), std::max(range.most, number));
            box->setValue(number);
            slider->setValue(static_cast<int>(std::lround((number - range.least) / range.step)));
          },
          {}};
}

StylePanel::Row StylePanel::make_switch(const StyleParameter& parameter) {
  auto* const box = new QCheckBox(widget_);
  QObject::connect(box, &QCheckBox::toggled, widget_,
                   [this, &parameter](bool on) { set_soon(parameter, on ? "true" : "false"); });
  return {&parameter,
          box,
          [box](const std::string& value) {
            const QSignalBlocker quiet(box);
            box->setChecked(value == "true");
          },
          {}};
}

StylePanel::Row StylePanel::make_choice(const StyleParameter& parameter, const ChoiceControl& choice) {
  auto* const box = new QComboBox(widget_);
  for (const std::string_view name : choice.names) box->addItem(QString::fromUtf8(name));
  QObject::connect(box, &QComboBox::activated, widget_,
                   [this, &parameter, box] { set_soon(parameter, box->currentText().toStdString()); });
  return {&parameter,
          box,
          [box](const std::string& value) {
            const QSignalBlocker quiet(box);
            box->setCurrentText(QString::fromStdString(value));
          },
          {}};
}

StylePanel::Row StylePanel::make_text(const StyleParameter& parameter) {
  auto* const line = new QLineEdit(widget_);
  QObject::connect(line, &QLineEdit::editingFinished, widget_, [this, &parameter, line] {
    if (line->isModified()) set_soon(parameter, line->text().remove(' ').toStdString());
    line->setModified(false);
  });
  return {&parameter,
          line,
          [line](const std::string& value) {
            if (line->hasFocus() && line->isModified()) return;
            line->setText(QString::fromStdString(value));
          },
          {}};
}

void StylePanel::set_soon(const StyleParameter& parameter, std::string value) {
  waiting_[std::string(parameter.name)] = std::move(value);
  timer_.start(settles_after_ms);
}

void StylePanel::show(const Viewer& viewer) {
  const Session& session = viewer.session();
  const auto* const content = std::get_if<PaintedContent>(&session.opened.content);
  const bool can_paint = content != nullptr && content->photograph;
  remark_->setVisible(!can_paint);
  remark_->setText("A style is for photographs. What is open has none.");
  const Style& style = session.state.style;
  const int layers =
      content != nullptr && content->painting ? static_cast<int>(layers_of(*content->painting).size()) : 0;
  layers_->setEnabled(layers > 1);
  if (layers > 0) {
    const QSignalBlocker quiet(layers_);
    layers_->setRange(0, layers - 1);
    layers_->setValue(std::min(session.state.slicing.finest_layer, layers - 1));
  }
  styles_->show_style(can_paint ? content->photograph : nullptr, style.name);
  std::array<bool, style_section_names.size()> has_any{};
  for (Row& row : rows_) {
    const bool is_read = is_read_by(*row.parameter, style.marks);
    row.control->setVisible(is_read);
    bool& has_row = has_any[static_cast<std::size_t>(row.parameter->section)];
    has_row = has_row || is_read;
    form_->labelForField(row.control)->setVisible(is_read);
    row.control->setEnabled(can_paint);
    const std::string value = plain_value(*row.parameter, style);
    if (waiting_.contains(std::string(row.parameter->name)) || value == row.shown) continue;
    row.show(value);
    row.shown = value;
  }
  for (std::size_t section = 0; section < has_any.size(); ++section) headings_[section]->setVisible(has_any[section]);
}

}  // namespace wheatstone::viewer
