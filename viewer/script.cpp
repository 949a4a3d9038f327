#include "script.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <utility>

#include "command_table.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::viewer {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t longest_script = std::size_t{16} << 20;

int whole_number(const std::string& word) {
  try {
    return std::stoi(word);
  } catch (const std::exception&) {
    throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no whole number", word));
  }
}

}  // namespace

Script::Script(const std::filesystem::path& path, ScriptHost host) : name_(path.string()), host_(std::move(host)) {
  std::istringstream text(read_whole_file(path, longest_script));
  for (std::string line; std::getline(text, line);) lines_.push_back(line);
}

bool Script::go_on(Viewer& viewer) {
  while (true) {
    if (waits_until_ && std::chrono::steady_clock::now() < *waits_until_) return false;
    waits_until_.reset();
    if (waits_ && viewer.is_busy()) return false;
    if (std::exchange(waits_, false) && viewer.session().message_is_error)
      throw Error(ErrorKind::bad_input, fmt::format("{}:{}: {}", name_, next_, viewer.session().message));
    if (next_ == lines_.size() || viewer.session().ends) return true;
    const std::string& line = lines_[next_++];
    try {
      run(viewer, line);
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("{}:{}: {}", name_, next_, error.what()));
    }
    viewer.collect();
  }
}

void Script::run(Viewer& viewer, const std::string& line) {
  const Words words = words_of(line);
  if (words.empty()) return;
  if (words.front() == "wait") {
    waits_ = words.size() == 1;
    if (!waits_) waits_until_ = std::chrono::steady_clock::now() + whole_number(words[1]) * 1s;
  } else if (words.front() == "screenshot" && words.size() == 2) {
    if (host_.screenshot) return host_.screenshot(words[1]);
    run_line(viewer, "save-picture \"" + words[1] + "\"");
  } else if (words.front() == "resize" && words.size() == 3) {
    const int width = whole_number(words[1]), height = whole_number(words[2]);
    if (width < 1 || height < 1 || width > 16384 || height > 16384)
      throw Error(ErrorKind::wrong_usage, "resize: expected 1 to 16384 pixels");
    if (host_.resize) return host_.resize(width, height);
    viewer.set_viewport({width, height});
  } else if (words.front() == "print" && words.size() == 1) {
    if (host_.print) host_.print(state_json(viewer.session()));
  } else {
    run_line(viewer, line);
  }
}

void run_script(Viewer& viewer, const std::filesystem::path& path, ScriptHost host) {
  Script script(path, std::move(host));
  while (!script.go_on(viewer)) {
    viewer.collect();
    std::this_thread::sleep_for(1ms);
  }
}

std::string state_json(const Session& session) {
  using Json = nlohmann::ordered_json;
  const ViewState& state = session.state;
  Json files = Json::array();
  if (const Item* const item = open_item(session))
    for (const auto& file : *item) files.push_back(file.string());
  const Json told{{"files", files},
                  {"kind", session.opened.kind},
                  {"mode", state.mode},
                  {"swap", state.swap},
                  {"zero_parallax_px", state.adjustment.zero_parallax_px},
                  {"separation", state.adjustment.separation},
                  {"zoom", state.framed.zoom},
                  {"head", state.head},
                  {"display", state.display},
                  {"finest_layer", state.finest_layer},
                  {"style", state.style.name},
                  {"message", session.message},
                  {"is_error", session.message_is_error}};
  return told.dump();
}

}  // namespace wheatstone::viewer
