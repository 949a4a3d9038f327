#include "bridge.h"

#include <cstdlib>
#include <filesystem>
#include <string>

#include "viewer.h"
#include "wheatstone/error.h"
#include "wheatstone/files/child_process.h"

namespace wheatstone::viewer {
namespace {

namespace fs = std::filesystem;

/// Where what can be found again is kept.
fs::path cache_folder() {
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') return fs::path(cache) / "wheatstone";
  const char* const home = std::getenv("HOME");
  return fs::path(home != nullptr ? home : "/tmp") / ".cache/wheatstone";
}

/// Bridge's library may end the program that loads it, or hang: not ours.
void write_calibration(const fs::path& file) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  fs::remove(file, error);
  ChildProcess({"/proc/self/exe", "--bridge-calibration", file.string()}).wait();
  if (!fs::exists(file, error))
    throw Error(ErrorKind::cannot_read_write,
                "Looking Glass Bridge is not installed, or finds no Looking Glass display");
}

}  // namespace

void use_screen_of_bridge(Viewer& viewer) {
  const fs::path file = cache_folder() / "looking-glass.json";
  viewer.save(
      file, [file] { write_calibration(file); }, [&viewer, file] { viewer.session().state.screen = file.string(); });
}

}  // namespace wheatstone::viewer
