#include "screens.h"

#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "stage.h"
#include "viewer.h"
#include "wheatstone/error.h"
#include "wheatstone/files/child_process.h"

namespace wheatstone::viewer {
namespace {

/// Letters and digits alone, as "Looking Glass Go" and "looking-glass-go" have them in common.
std::string plain(std::string_view name) {
  std::string letters;
  for (const char letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)))
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return letters;
}

namespace fs = std::filesystem;

/// Bridge's library may end the program that loads it, or hang: not ours.
void write_calibration(const fs::path& file) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  fs::remove(file, error);
  const int status = ChildProcess({"/proc/self/exe", "--bridge-calibration", file.string()}).wait();
  // Of a signal to the whole group, this program may not have heard yet.
  constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP};
  if (WIFSIGNALED(status) && std::ranges::find(ending_signals, WTERMSIG(status)) != ending_signals.end())
    throw Error(ErrorKind::interrupted, "interrupted");
  if (!fs::exists(file, error))
    throw Error(ErrorKind::cannot_read_write,
                "Looking Glass Bridge is not installed, or finds no Looking Glass display");
}

}  // namespace

fs::path cache_folder() {
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') return fs::path(cache) / "wheatstone";
  const char* const home = std::getenv("HOME");
  return fs::path(home != nullptr ? home : "/tmp") / ".cache/wheatstone";
}

int screen_to_fill(const Session& session, std::span<const Screen> screens) {
  if (session.screen > 0 && session.screen <= static_cast<int>(screens.size())) return session.screen;
  const auto first = [&](auto&& fits) {
    const auto found = std::ranges::find_if(screens, fits);
    return found == screens.end() ? 0 : static_cast<int>(found - screens.begin()) + 1;
  };
  const std::string display = plain(session.state.display);
  if (const int called =
          first([&](const Screen& screen) { return plain(screen.name).find(display) != std::string::npos; }))
    return called;
  const std::optional<PictureSize> size = screen_size_of(session.state);
  return size
             ? first([&](const Screen& screen) { return screen.width == size->width && screen.height == size->height; })
             : 0;
}

bool is_lost(const DesktopArea& window, std::span<const DesktopArea> screens) {
  return std::ranges::none_of(screens, [&](const DesktopArea& screen) {
    return window.left < screen.left + screen.width && screen.left < window.left + window.width &&
           window.top < screen.top + screen.height && screen.top < window.top + window.height;
  });
}

DesktopArea brought_to(const DesktopArea& available, const DesktopArea& window) {
  const int width = std::min(window.width, available.width), height = std::min(window.height, available.height);
  return {available.left + (available.width - width) / 2, available.top + (available.height - height) / 2, width,
          height};
}

void use_screen_of_bridge(Viewer& viewer) {
  const fs::path file = cache_folder() / "looking-glass.json";
  viewer.save(
      file, [file] { write_calibration(file); }, [&viewer, file] { viewer.session().state.screen = file.string(); });
}

}  // namespace wheatstone::viewer
