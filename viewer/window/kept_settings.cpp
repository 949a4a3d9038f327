#include "kept_settings.h"

#include <QFileInfo>
#include <QMenu>
#include <QSettings>
#include <utility>
#include <variant>
#include <vector>

#include "viewer/command_table.h"
#include "viewer/output_mode.h"
#include "viewer/session.h"
#include "wheatstone/error.h"
#include "window.h"

namespace wheatstone::viewer {
namespace {

constexpr auto recent_key = "recent", mode_key = "mode", device_key = "look-with", panel_key = "panel",
               style_key = "style", folder_key = "folder", display_key = "display", theme_key = "theme",
               size_key = "size";
constexpr QChar between_eyes = '\n';

constexpr auto organisation = "Wheatstone", program_name = "wheatstone-view";

/// A mode that a screen shows whatever it is.
bool is_for_any_screen(const OutputMode& mode) {
  return !shows_display_views(mode) && !std::holds_alternative<PageFlip>(mode.kind);
}

}  // namespace

KeptSettings::KeptSettings(Window& window) : window_(window) {
  auto* const recent = new QMenu("Recent", &window);
  QObject::connect(recent, &QMenu::aboutToShow, recent, [this, recent] { fill_menu(*recent); });
  QMenu& file = *window.menus().file_menu();
  file.insertMenu(file.actions().size() > 1 ? file.actions().at(1) : nullptr, recent);
}

std::vector<Item> KeptSettings::recent() const {
  std::vector<Item> before;
  for (const QString& line : QSettings(organisation, program_name).value(recent_key).toStringList()) {
    Item item;
    for (const QString& name : line.split(between_eyes)) item.emplace_back(name.toStdString());
    before.push_back(std::move(item));
  }
  return recent_items(window_.viewer().session().items, before);
}

QStringList KeptSettings::recent_files() const {
  QStringList files;
  for (const Item& item : recent()) {
    QStringList names;
    for (const auto& file : item) names << QString::fromStdString(file.string());
    files << names.join(between_eyes);
  }
  return files;
}

void KeptSettings::fill_menu(QMenu& menu) {
  menu.clear();
  for (const QString& files : recent_files()) {
    const QStringList names = files.split(between_eyes);
    QAction* const action = menu.addAction(QFileInfo(names.front()).fileName());
    action->setToolTip(names.join(", "));
    QObject::connect(action, &QAction::triggered, &window_, [this, names] {
      Words words;
      for (const QString& name : names) words.push_back(name.toStdString());
      try {
        run_command(window_.viewer(), find_command("open"), words);
      } catch (const Error& error) {
        window_.viewer().tell(error.what(), true);
      }
    });
  }
  menu.setToolTipsVisible(true);
}

void KeptSettings::restore(bool with_size) {
  const QSettings kept(organisation, program_name);
  for (const char* key : {device_key, display_key, panel_key, style_key, theme_key}) {
    const std::string name = kept.value(key).toString().toStdString();
    if (name.empty()) continue;
    try {
      run_command(window_.viewer(), find_command(key), {name});
    } catch (const Error&) {
      continue;  // this version does not know it
    }
  }
  Session& session = window_.viewer().session();
  try {
    session.usual_modes.pictures = find_output_mode(kept.value(mode_key).toString().toStdString()).name;
  } catch (const Error&) {  // none was kept, or this version does not know it
  }
  if (const QString folder = kept.value(folder_key).toString(); !folder.isEmpty())
    session.folder = folder.toStdString();
  window_.start_page().show_recent(recent());
  if (const QSize size = kept.value(size_key).toSize(); with_size && size.isValid()) window_.resize(size);
}

void KeptSettings::keep() {
  QSettings kept(organisation, program_name);
  const Session& session = window_.viewer().session();
  if (is_for_any_screen(find_output_mode(session.usual_modes.pictures)))
    kept.setValue(mode_key, QString::fromStdString(session.usual_modes.pictures));
  kept.setValue(device_key, QString::fromStdString(session.device));
  kept.setValue(style_key, QString::fromStdString(session.state.style.name));
  kept.setValue(theme_key, QString::fromUtf8(theme_names[static_cast<std::size_t>(session.theme)]));
  kept.setValue(folder_key, QString::fromStdString(session.folder.string()));
  kept.setValue(panel_key, QString::fromUtf8(panel_names[static_cast<std::size_t>(session.panel)]));
  kept.setValue(display_key, QString::fromStdString(session.state.display));
  if (!session.full_screen) kept.setValue(size_key, window_.size());
  kept.setValue(recent_key, recent_files());
}

}  // namespace wheatstone::viewer
