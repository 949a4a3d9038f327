#include "script.h"

#include <fmt/format.h>

#include <chrono>
#include <sstream>
#include <thread>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone::viewer {
namespace {

constexpr std::size_t longest_script = std::size_t{16} << 20;

}  // namespace

Script::Script(const std::filesystem::path& path, ScriptHost host) : name_(path.string()), runner_(std::move(host)) {
  std::istringstream text(read_whole_file(path, longest_script));
  for (std::string line; std::getline(text, line);) lines_.push_back(line);
}

bool Script::go_on(Viewer& viewer) {
  try {
    while (runner_.is_done(viewer)) {
      if (next_ == lines_.size() || viewer.session().ends) return true;
      runner_.begin(viewer, lines_[next_++]);
      viewer.collect();
    }
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}:{}: {}", name_, next_, error.what()));
  }
  return false;
}

void run_script(Viewer& viewer, const std::filesystem::path& path, ScriptHost host) {
  Script script(path, std::move(host));
  while (!script.go_on(viewer)) {
    viewer.collect();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace wheatstone::viewer
