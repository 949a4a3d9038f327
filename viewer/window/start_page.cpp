#include "start_page.h"

#include <QButtonGroup>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>
#include <utility>

#include "icons.h"
#include "picture_surface.h"
#include "viewer/folder_items.h"
#include "viewer/output_mode.h"

namespace wheatstone::viewer {
namespace {

constexpr int thumbnail_width = 144, thumbnail_height = 96;

QLabel* make_heading(const char* text, double scale, QWidget* parent) {
  auto* const label = new QLabel(text, parent);
  QFont font = label->font();
  font.setPointSizeF(font.pointSizeF() * scale);
  font.setBold(true);
  label->setFont(font);
  return label;
}

QIcon blank_thumbnail(const QPalette& palette) {
  QPixmap blank(thumbnail_width, thumbnail_height);
  blank.fill(palette.color(QPalette::Mid));
  return {blank};
}

}  // namespace

StartPage::StartPage(DoCommand do_command, std::function<void()> ask_to_open)
    : do_command_(std::move(do_command)), ask_to_open_(std::move(ask_to_open)) {
  setAutoFillBackground(true);
  setMinimumSize(64, 48);  // a panel beside the picture needs no wider window
  auto* const columns = new QHBoxLayout;
  columns->setSpacing(32);
  columns->addWidget(make_left_column());
  columns->addWidget(make_recent(), 1);
  auto* const rows = new QVBoxLayout(this);
  rows->setContentsMargins(32, 28, 32, 24);
  rows->setSpacing(20);
  rows->addLayout(columns, 1);
  rows->addWidget(make_devices());
}

QWidget* StartPage::make_left_column() {
  auto* const column = new QWidget(this);
  column->setFixedWidth(250);
  auto* const layout = new QVBoxLayout(column);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(10);
  layout->addWidget(make_heading("Wheatstone", 2, column));
  auto* const about = new QLabel("Stereo photographs, films and particles, painted for every eye", column);
  about->setWordWrap(true);
  layout->addWidget(about);
  layout->addSpacing(8);
  open_ = new QPushButton("  Open…", column);
  open_->setIconSize({24, 24});
  open_->setDefault(true);
  QObject::connect(open_, &QPushButton::clicked, this, [this] { ask_to_open_(); });
  layout->addWidget(open_);
  auto* const example = new QPushButton("Show an example", column);
  QObject::connect(example, &QPushButton::clicked, this, [this] { do_command_("open-example", {}); });
  layout->addWidget(example);
  drop_ = new QLabel(
      "Drop files here:\na painting, a stereo photograph,\nits two pictures, a film,\nslices, particles or a model",
      column);
  drop_->setAlignment(Qt::AlignCenter);
  layout->addWidget(drop_, 1);
  take_colours();
  return column;
}

void StartPage::take_colours() {
  open_->setIcon(tool_icon("open", palette()));
  // Set anew, since a style sheet takes the palette's colours once.
  drop_->setStyleSheet({});
  drop_->setStyleSheet(
      "border: 2px dashed palette(placeholder-text); border-radius: 8px; padding: 10px; color: palette(window-text)");
}

void StartPage::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange && drop_ != nullptr) take_colours();
  QWidget::changeEvent(event);
}

QWidget* StartPage::make_recent() {
  auto* const column = new QWidget(this);
  auto* const layout = new QVBoxLayout(column);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(make_heading("Recent files", 1.2, column));
  no_recent_ = new QLabel("What you open will be found here.", column);
  no_recent_->setAlignment(Qt::AlignTop);
  layout->addWidget(no_recent_, 1);
  recent_ = new QListWidget(column);
  recent_->setViewMode(QListView::IconMode);
  recent_->setIconSize({thumbnail_width, thumbnail_height});
  recent_->setGridSize({thumbnail_width + 20, thumbnail_height + 34});
  recent_->setResizeMode(QListView::Adjust);
  recent_->setMovement(QListView::Static);
  recent_->setFrameShape(QFrame::NoFrame);
  recent_->setTextElideMode(Qt::ElideMiddle);
  recent_->setWordWrap(false);
  recent_->setAccessibleName("Recent files");
  recent_->hide();
  const auto open = [this](const QListWidgetItem* item) {
    Words words;
    for (const auto& file : shown_[static_cast<std::size_t>(recent_->row(item))]) words.push_back(file.string());
    do_command_("open", words);
  };
  QObject::connect(recent_, &QListWidget::itemClicked, this, open);
  QObject::connect(recent_, &QListWidget::itemActivated, this, open);
  layout->addWidget(recent_, 1);
  return column;
}

QWidget* StartPage::make_devices() {
  auto* const row = new QWidget(this);
  auto* const layout = new QGridLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setHorizontalSpacing(24);
  constexpr int columns = 3;  // they fit into a small window
  layout->addWidget(make_heading("What do you look with?", 1, row), 0, 0, 1, columns);
  layout->setColumnStretch(columns, 1);
  devices_ = new QButtonGroup(row);
  for (const LookingWith& device : devices()) {
    auto* const button = new QRadioButton(QString::fromUtf8(device.text), row);
    devices_->addButton(button);
    const int number = static_cast<int>(devices_->buttons().size()) - 1;
    layout->addWidget(button, 1 + number / columns, number % columns);
    QObject::connect(button, &QRadioButton::clicked, this,
                     [this, &device] { do_command_("look-with", {std::string(device.name)}); });
  }
  return row;
}

void StartPage::show_recent(const std::vector<Item>& recent) {
  shown_ = recent;
  recent_->clear();
  recent_->setVisible(!recent.empty());
  no_recent_->setVisible(recent.empty());
  for (const Item& item : recent) {
    auto* const entry = new QListWidgetItem(blank_thumbnail(palette()),
                                            QString::fromStdString(item.front().filename().string()), recent_);
    QString names;
    for (const auto& file : item) names += (names.isEmpty() ? "" : "\n") + QString::fromStdString(file.string());
    entry->setToolTip(names);
  }
  thumbnails_.start([this, recent](const std::stop_token& stop) {
    for (std::size_t number = 0; number < recent.size() && !stop.stop_requested(); ++number) {
      const double ratio = 2;  // for fine screens
      const Image<Rgb8> small = thumbnail_of(
          recent[number], {static_cast<int>(thumbnail_width * ratio), static_cast<int>(thumbnail_height * ratio)});
      if (small.empty()) continue;
      QMetaObject::invokeMethod(
          this,
          [this, number, item = recent[number], picture = qimage_of(small)] {
            if (number < shown_.size() && shown_[number] == item)
              recent_->item(static_cast<int>(number))->setIcon(QPixmap::fromImage(picture));
          },
          Qt::QueuedConnection);
    }
  });
}

void StartPage::show_session(const Session& session) {
  const QList<QAbstractButton*> buttons = devices_->buttons();
  for (std::size_t number = 0; number < devices().size(); ++number)
    if (devices()[number].name == session.device) buttons[static_cast<qsizetype>(number)]->setChecked(true);
}

}  // namespace wheatstone::viewer
