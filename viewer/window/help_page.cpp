#include "help_page.h"

#include <QDialog>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <array>
#include <utility>

#include "viewer/command_table.h"

namespace wheatstone::viewer {
namespace {

/// What the pointer does, which the table of commands does not know.
constexpr std::array<std::array<const char*, 2>, 10> pointer_keys{
    {{"C, held", "The photograph"},
     {"Click", "Put the screen plane at the depth of this place"},
     {"Double click", "Full screen"},
     {"Drag", "Move the picture, or turn particles or a model"},
     {"Shift + drag", "Move particles or a model"},
     {"Wheel", "Zoom at the pointer"},
     {"Ctrl + wheel", "More or less detail"},
     {"Alt + wheel", "Move the slicing plane"},
     {"Ctrl + click", "Look at what lies there"},
     {"Ctrl + Shift + click", "More depth of particles there"}}};

QTreeWidgetItem* add_heading(QTreeWidget& tree, const QString& text) {
  auto* const heading = new QTreeWidgetItem(&tree, {text});
  QFont bold = tree.font();
  bold.setBold(true);
  heading->setFont(0, bold);
  heading->setFirstColumnSpanned(true);
  heading->setExpanded(true);
  return heading;
}

void fill(QTreeWidget& tree) {
  QTreeWidgetItem* heading = add_heading(tree, "Pointer");
  for (const auto& [keys, text] : pointer_keys) new QTreeWidgetItem(heading, {keys, text, ""});
  std::string_view menu;
  for (const Command& command : command_table()) {
    if (std::exchange(menu, command.menu) != command.menu) heading = add_heading(tree, QString::fromUtf8(command.menu));
    auto* const line =
        new QTreeWidgetItem(heading, {QString::fromUtf8(command.keys), QString::fromUtf8(command.text),
                                      QString::fromUtf8(command.name) + ' ' + QString::fromUtf8(command.arguments)});
    line->setToolTip(1, line->text(1));
  }
}

/// Hides what does not have the words.
void search(QTreeWidget& tree, const QString& words) {
  for (int heading = 0; heading < tree.topLevelItemCount(); ++heading) {
    QTreeWidgetItem& group = *tree.topLevelItem(heading);
    bool has_any = false;
    for (int line = 0; line < group.childCount(); ++line) {
      QTreeWidgetItem& item = *group.child(line);
      const QString text = item.text(0) + ' ' + item.text(1) + ' ' + item.text(2);
      bool has_all = true;
      for (const QString& word : words.split(' ', Qt::SkipEmptyParts))
        has_all = has_all && text.contains(word, Qt::CaseInsensitive);
      item.setHidden(!has_all);
      has_any = has_any || has_all;
    }
    group.setHidden(!has_any);
  }
}

}  // namespace

QWidget* make_help_page(QWidget* parent, std::function<void()> close) {
  auto* const page = new QDialog(parent, Qt::Tool);
  page->setWindowTitle("Keys and commands");
  auto* const layout = new QVBoxLayout(page);
  auto* const wanted = new QLineEdit(page);
  wanted->setPlaceholderText("Search: zoom, style, full screen…");
  wanted->setClearButtonEnabled(true);
  auto* const tree = new QTreeWidget(page);
  tree->setHeaderLabels({"Keys", "What they do", "Command of a script"});
  tree->setRootIsDecorated(false);
  tree->setIndentation(8);
  tree->setFocusPolicy(Qt::NoFocus);
  fill(*tree);
  tree->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  tree->setColumnWidth(1, 380);
  auto* const manual = new QLabel("The manual's page on the window: <code>docs/viewing.md</code>.", page);
  manual->setTextInteractionFlags(Qt::TextSelectableByMouse);
  layout->addWidget(wanted);
  layout->addWidget(tree, 1);
  layout->addWidget(manual);
  QObject::connect(wanted, &QLineEdit::textChanged, tree, [tree](const QString& words) { search(*tree, words); });
  QObject::connect(page, &QDialog::finished, page, [close = std::move(close)] { close(); });
  page->resize(820, 600);
  page->hide();
  return page;
}

}  // namespace wheatstone::viewer
