#pragma once

#include <QTimer>
#include <QWidget>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "panels.h"
#include "style_strip.h"
#include "viewer/style_controls.h"

class QFormLayout;
class QLabel;
class QSlider;

namespace wheatstone::viewer {

/// Moves the plane that slices the layers of detail, chooses a style, and moves every parameter that the style's marks
/// read. While a control moves, its command waits a little for the next move.
class StylePanel {
 public:
  explicit StylePanel(DoCommand do_command);
  QWidget* widget() { return widget_; }
  void show(const Viewer& viewer);

 private:
  /// A parameter's row, and how it is brought to show a value.
  struct Row {
    const StyleParameter* parameter;
    QWidget* control;
    std::function<void(const std::string&)> show;
    std::string shown;
  };
  void add_row(const StyleControl& control);
  Row make_row(const StyleControl& control);
  Row make_number(const StyleParameter& parameter, const NumberControl& range);
  Row make_switch(const StyleParameter& parameter);
  Row make_choice(const StyleParameter& parameter, const ChoiceControl& choice);
  Row make_text(const StyleParameter& parameter);
  void set_soon(const StyleParameter& parameter, std::string value);

  DoCommand do_command_;
  QWidget* widget_;
  QLabel* remark_;
  StyleStrip* styles_;
  QSlider* layers_;
  QFormLayout* form_;
  std::vector<Row> rows_;
  std::array<QLabel*, style_section_names.size()> headings_{};
  std::map<std::string, std::string> waiting_;
  QTimer timer_;
};

}  // namespace wheatstone::viewer
