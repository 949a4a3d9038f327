#include "script.h"

#include <fmt/format.h>
#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <utility>

#include "command_table.h"
#include "depth_seen.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double longest_wait_s = 3600;

int pixels_of(const std::string& word) {
  const double pixels = number_of(word, 1, 16384);
  if (pixels != static_cast<int>(pixels))
    throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no whole number", word));
  return static_cast<int>(pixels);
}

constexpr std::size_t longest_script = std::size_t{16} << 20;

}  // namespace

void LineRunner::begin(Viewer& viewer, const std::string& line) {
  const Words words = words_of(line);
  if (words.empty()) return;
  if (words.front() == "wait" && words.size() <= 2) {
    waits_ = words.size() == 1;
    if (!waits_)
      waits_until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(number_of(words[1], 0, longest_wait_s)));
  } else if (words.front() == "screenshot" && words.size() == 2) {
    if (host_.screenshot) return host_.screenshot(words[1]);
    run_command(viewer, find_command("save-picture"), {words[1]});
    saves_ = true;
  } else if (words.front() == "resize" && words.size() == 3) {
    const int width = pixels_of(words[1]), height = pixels_of(words[2]);
    if (host_.resize) return host_.resize(width, height);
    viewer.set_viewport({width, height});
  } else if (words.front() == "print" && words.size() == 1) {
    using Measured = std::vector<std::pair<std::string, double>>;
    if (host_.print) host_.print(state_json(viewer, host_.measured ? host_.measured() : Measured()));
  } else {
    run_line(viewer, line);
    saves_ = viewer.is_saving();
  }
}

bool LineRunner::is_done(Viewer& viewer) {
  if (waits_until_ && Clock::now() < *waits_until_) return false;
  waits_until_.reset();
  if (waits_ && host_.show) host_.show();
  if (waits_ && viewer.is_busy()) return false;
  Session& session = viewer.session();
  if (saves_) {
    if (viewer.is_saving()) return false;
    saves_ = false;
    if (const std::optional<Error> failed = viewer.take_failed_save()) {
      session.message_is_error = false;
      throw *failed;
    }
  }
  if (std::exchange(waits_, false) && std::exchange(session.message_is_error, false))
    throw Error(ErrorKind::bad_input, session.message);
  return true;
}

std::string state_json(const Viewer& viewer, const std::vector<std::pair<std::string, double>>& measured) {
  const Session& session = viewer.session();
  using Json = nlohmann::ordered_json;
  const ViewState& state = session.state;
  Json files = Json::array();
  if (const Item* const item = open_item(session))
    for (const auto& file : *item) files.push_back(file.string());
  Json told{{"files", files},
            {"place", place_told(session)},
            {"kind", session.opened.kind},
            {"mode", state.mode},
            {"swap", state.swap},
            {"zero_parallax_px", state.adjustment.zero_parallax_px},
            {"separation", state.adjustment.separation},
            {"zoom", state.framed.zoom},
            {"pan_x", state.framed.pan_x},
            {"pan_y", state.framed.pan_y},
            {"head", state.head},
            {"display", state.display},
            {"finest_layer", state.slicing.finest_layer},
            {"slice_depth", slice_depths_text(state.slicing.depths)},
            {"style", state.style.name},
            {"touches", state.touches.size()},
            {"compare", comparison_names[static_cast<std::size_t>(state.comparison)]},
            {"full_screen", session.full_screen},
            {"information", session.information},
            {"help", session.help},
            {"message", session.message},
            {"is_error", session.message_is_error}};
  if (session.tracked_head)
    told["head_tracker"] = {{"port", session.tracked_head->port}, {"is_silent", session.tracked_head->is_silent}};
  if (!state.depth_regions.empty()) told["depth_mapping"] = text_of(state.depth_regions);
  if (const auto& around = state.depth_around)
    told["depth_around"] = {{"x", around->x},
                            {"y", around->y},
                            {"disparity_px", around->disparity_px},
                            {"there", around->gain_there},
                            {"elsewhere", around->gain_elsewhere}};
  if (const std::optional<DepthSeen> seen = depth_seen(viewer))
    told["depth"] = {{"near_mm", seen->near_mm},
                     {"far_mm", seen->far_mm},
                     {"parallax_percent", seen->total_percent},
                     {"is_comfortable", seen->discomforts.empty()},
                     {"told", comfort_told(viewer)}};
  if (const auto& film = session.film)
    told["film"] = {{"frame", film->frame}, {"seconds", film->seconds}, {"playing", film->plays}};
  for (const auto& [name, value] : measured) told[name] = value;
  return told.dump(-1, ' ', false, Json::error_handler_t::replace);
}

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
