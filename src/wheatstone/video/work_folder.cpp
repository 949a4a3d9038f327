#include "wheatstone/video/work_folder.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& output, int error) {
  throw Error(ErrorKind::cannot_read_write,
              fmt::format("{}: cannot write: {}", output.string(), std::generic_category().message(error)));
}

}  // namespace

fs::path work_folder_of(const fs::path& output) { return output.string() + ".part"; }

WorkFolder::WorkFolder(fs::path output) : folder_(work_folder_of(output)) {
  const auto hold = hold_outputs();
  unfinished_.begin(folder_, [&] { take(output); });
  unfinished_.keep(true);
}

/// Makes the folder where there is none, and locks it.
void WorkFolder::take(const fs::path& output) {
  for (;;) {
    std::error_code error;
    fs::create_directory(folder_, error);
    if (error) fail(output, error.value());
    error = lock_.hold(folder_ / "lock");
    if (!error) break;
    if (error == std::errc::resource_unavailable_try_again)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: another run is painting it; expected another name, or wait until that run has ended",
                              output.string()));
    // The run that held it may have removed the folder.
    if (error != std::errc::no_such_file_or_directory) fail(output, error.value());
  }
}

WorkFolder::~WorkFolder() { unfinished_.keep(true); }

void WorkFolder::remove() {
  const auto hold = hold_outputs();
  // While it is held: another run must not begin in a folder that is going away.
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  unfinished_.finish([] {});
  lock_.release();
}

}  // namespace wheatstone
