#pragma once

#include <QListWidget>
#include <memory>
#include <string>

#include "panels.h"
#include "viewer/style_previews.h"

namespace wheatstone::viewer {

/// Every preset as a small picture of what is open, painted in it: a click chooses.
class StyleStrip final : public QListWidget {
 public:
  StyleStrip(QWidget* parent, DoCommand do_command);

  /// Of that photograph, or where there is none, by names alone.
  void show_style(const std::shared_ptr<const Photograph>& photograph, const std::string& style);

 private:
  void show_preview(const std::string& style, const QImage& picture);
  void clear_previews();

  StylePreviews previews_;  ///< last: its thread ends first
};

}  // namespace wheatstone::viewer
