#include "style_strip.h"

#include <QIcon>
#include <QScrollBar>
#include <algorithm>
#include <utility>

#include "picture_surface.h"
#include "wheatstone/marks/style.h"

namespace wheatstone::viewer {
namespace {

constexpr int preview_width = 96, preview_height = 72;
constexpr int rows = 3;  ///< that are seen at once

}  // namespace

StyleStrip::StyleStrip(QWidget* parent, DoCommand do_command)
    : QListWidget(parent),
      previews_([this](const std::shared_ptr<const Photograph>& photograph, const std::string& style,
                       const Image<Rgb8>& picture) {
        QMetaObject::invokeMethod(
            this,
            [this, photograph, style, shown = qimage_of(picture)] {
              if (previews_.are_of(photograph.get())) show_preview(style, shown);
            },
            Qt::QueuedConnection);
      }) {
  setViewMode(QListView::IconMode);
  setIconSize({preview_width, preview_height});
  setGridSize({preview_width + 10, preview_height + 24});
  setFixedHeight(rows * (preview_height + 24) + 4);
  setResizeMode(QListView::Adjust);
  setMovement(QListView::Static);
  setUniformItemSizes(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setMinimumWidth(3 * (preview_width + 10) + verticalScrollBar()->sizeHint().width() + 6);
  setFocusPolicy(Qt::NoFocus);
  setAccessibleName("Styles");
  for (const std::string_view name : style_names()) {
    auto* const item = new QListWidgetItem(QString::fromStdString(readable(name)), this);
    item->setData(Qt::UserRole, QString::fromUtf8(name));
    item->setTextAlignment(Qt::AlignHCenter | Qt::AlignTop);
  }
  clear_previews();
  connect(this, &QListWidget::itemClicked, this, [do_command = std::move(do_command)](const QListWidgetItem* item) {
    do_command("style", {item->data(Qt::UserRole).toString().toStdString()});
  });
}

void StyleStrip::clear_previews() {
  QPixmap blank(preview_width, preview_height);
  blank.fill(palette().color(QPalette::Mid));
  for (int row = 0; row < count(); ++row) item(row)->setIcon(QIcon(blank));
}

void StyleStrip::show_preview(const std::string& style, const QImage& picture) {
  // Cut to the shape that all have.
  const QImage filled = picture.scaled(QSize(preview_width, preview_height) * 2, Qt::KeepAspectRatioByExpanding,
                                       Qt::SmoothTransformation);
  const QRect middle((filled.width() - 2 * preview_width) / 2, (filled.height() - 2 * preview_height) / 2,
                     2 * preview_width, 2 * preview_height);
  for (int row = 0; row < count(); ++row)
    if (item(row)->data(Qt::UserRole).toString().toStdString() == style)
      item(row)->setIcon(QIcon(QPixmap::fromImage(filled.copy(middle))));
}

void StyleStrip::show_style(const std::shared_ptr<const Photograph>& photograph, const std::string& style) {
  if (!previews_.are_of(photograph.get())) {
    clear_previews();
    previews_.show(photograph);
  }
  setEnabled(photograph != nullptr);
  for (int row = 0; row < count(); ++row)
    if (item(row)->data(Qt::UserRole).toString().toStdString() == style && currentRow() != row) setCurrentRow(row);
}

}  // namespace wheatstone::viewer
