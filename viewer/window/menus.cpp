#include "menus.h"

#include <QActionGroup>
#include <QEvent>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QToolBar>
#include <QToolButton>
#include <map>
#include <string>
#include <utility>

#include "icons.h"
#include "viewer/session.h"

namespace wheatstone::viewer {
namespace {

QString text_of(const std::string& text) { return QString::fromStdString(text).replace('&', "&&"); }

QList<QKeySequence> keys_of(const Command& command) {
  QList<QKeySequence> keys;
  for (const QString& key : QString::fromUtf8(command.keys).split(", ", Qt::SkipEmptyParts))
    keys.append(QKeySequence(key, QKeySequence::PortableText));
  return keys;
}

bool is_file(const Command& command) {
  return command.arguments == "FILE" || command.arguments == "FILE [RIGHT]" || command.arguments == "FOLDER" ||
         command.arguments.starts_with("FORMAT FILE");
}

}  // namespace

bool has_choices(const Command& command) {
  if (is_toggle(command) || command.arguments.empty() || is_file(command)) return false;
  if (command.entry.choices != nullptr) return true;
  return command.arguments.find('|') != std::string_view::npos &&
         command.arguments.find_first_not_of("abcdefghijklmnopqrstuvwxyz-|") == std::string_view::npos;
}

bool has_entry(const Command& command) {
  return !command.entry.is_for_scripts &&
         (command.arguments.empty() || is_file(command) || is_toggle(command) || has_choices(command));
}

Menus::Menus(QMainWindow& window, Do run)
    : window_(window), run_(std::move(run)), toolbar_(window.addToolBar("Tools")) {
  toolbar_->setObjectName("tools");
  toolbar_->setMovable(false);
  toolbar_->setContextMenuPolicy(Qt::PreventContextMenu);
  window.setContextMenuPolicy(Qt::NoContextMenu);
  std::map<std::string_view, QMenu*> menus;
  for (const Command& command : command_table()) {
    if (!has_entry(command)) continue;
    QMenu*& menu = menus[command.menu];
    if (menu == nullptr) menu = window.menuBar()->addMenu(QString::fromUtf8(command.menu));
    if (command.menu == "File") file_menu_ = menu;
    add(command, *menu);
  }
  for (const std::string_view icon : tool_icons())
    for (const Shown& shown : shown_)
      if (shown.command->entry.icon == icon) add_to_toolbar(shown);
}

void Menus::add(const Command& command, QMenu& menu) {
  if (command.entry.begins_group) menu.addSeparator();
  if (has_choices(command)) {
    QMenu* const submenu = menu.addMenu(text_of(title_of(command)));
    submenu->menuAction()->setObjectName(QString::fromUtf8(command.name));
    QObject::connect(submenu, &QMenu::aboutToShow, submenu, [this, submenu, &command] { fill(*submenu, command); });
    shown_.push_back({&command, submenu->menuAction(), submenu});
    return;
  }
  auto* const action = new QAction(text_of(title_of(command)), &window_);
  action->setObjectName(QString::fromUtf8(command.name));
  action->setShortcuts(keys_of(command));
  action->setCheckable(is_toggle(command));
  QObject::connect(action, &QAction::triggered, &window_, [this, &command](bool is_on) {
    run_(command, command.arguments == "on|off" ? Words{on_or_off(is_on)} : Words());
  });
  menu.addAction(action);
  window_.addAction(action);  // its keys work in full screen, too, where there is no menu
  shown_.push_back({&command, action, nullptr});
}

void Menus::fill(QMenu& submenu, const Command& command) {
  submenu.clear();
  if (viewer_ == nullptr) return;
  auto* const group = new QActionGroup(&submenu);
  const std::string now = command.entry.now != nullptr ? command.entry.now(*viewer_) : std::string();
  for (const Choice& choice : choices_of(*viewer_, command)) {
    QAction* const action = submenu.addAction(text_of(choice.text));
    action->setCheckable(command.entry.now != nullptr);
    action->setChecked(command.entry.now != nullptr && choice.words == now);
    group->addAction(action);
    QObject::connect(action, &QAction::triggered, &submenu,
                     [this, &command, words = words_of(choice.words)] { run_(command, words); });
  }
  if (command.name == "style") {
    submenu.addSeparator();
    QObject::connect(submenu.addAction("From a file…"), &QAction::triggered, &submenu,
                     [this, &command] { run_(command, {}); });
  }
}

void Menus::add_to_toolbar(const Shown& shown) {
  shown.action->setIconText(text_of(title_of(*shown.command)).remove("…"));
  if (shown.action->toolTip().isEmpty() || shown.submenu == nullptr) {
    const QString keys = shown.action->shortcut().toString();
    shown.action->setToolTip(shown.action->iconText() + (keys.isEmpty() ? QString() : " (" + keys + ")"));
  }
  shown.action->setIcon(tool_icon(shown.command->entry.icon, toolbar_->palette()));
  shown.action->setIconVisibleInMenu(false);
  toolbar_->addAction(shown.action);
  if (auto* const button = qobject_cast<QToolButton*>(toolbar_->widgetForAction(shown.action))) {
    button->setFocusPolicy(Qt::NoFocus);
    button->setAccessibleName(shown.action->iconText());
    if (shown.submenu != nullptr) button->setPopupMode(QToolButton::InstantPopup);
  }
}

void Menus::show(const Viewer& viewer) {
  viewer_ = &viewer;
  for (const Shown& shown : shown_) {
    shown.action->setEnabled(applies(viewer, *shown.command));
    if (shown.action->isCheckable()) shown.action->setChecked(shown.command->entry.now(viewer) == "on");
  }
  const bool is_dark = toolbar_->palette().color(QPalette::Window).lightness() < 128;
  if (std::exchange(was_dark_, is_dark) == is_dark) return;
  for (const Shown& shown : shown_)
    if (!shown.command->entry.icon.empty())
      shown.action->setIcon(tool_icon(shown.command->entry.icon, toolbar_->palette()));
}

}  // namespace wheatstone::viewer
