// What a viewer does with the folder of the file that is open.

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "folder_items.h"
#include "viewer.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

namespace fs = std::filesystem;

std::vector<fs::file_time_type> times_of(const Item& item) {
  std::vector<fs::file_time_type> times;
  std::error_code error;
  for (const fs::path& file : item) times.push_back(fs::last_write_time(file, error));
  return times;
}

/// The place in the walk that comes so many later, or earlier where negative; from its end it goes on at its beginning.
std::optional<std::size_t> place_later(const Session& session, int by) {
  const Item* const item = open_item(session);
  const std::optional<std::size_t> at = item == nullptr ? std::nullopt : place_among(session.walk, *item);
  const auto count = static_cast<std::ptrdiff_t>(session.walk.size());
  if (!at || count < 2) return {};
  return static_cast<std::size_t>(((static_cast<std::ptrdiff_t>(*at) + by) % count + count) % count);
}

}  // namespace

std::string place_told(const Session& session) {
  const Item* const item = open_item(session);
  if (item == nullptr || session.walk.size() < 2) return {};
  const std::optional<std::size_t> at = place_among(session.walk, *item);
  return at ? fmt::format("{} of {}", *at + 1, session.walk.size()) : std::string();
}

void Viewer::open_folder(const fs::path& folder) {
  session_.opening = Activity{"reading", 0};
  const std::uint64_t job = ++job_;
  making_.start([this, job, folder](const std::stop_token&) {
    try {
      std::vector<Item> items = holds_film(folder) ? std::vector<Item>{{folder}} : items_in(folder);
      if (items.empty())
        throw Error(ErrorKind::bad_input,
                    fmt::format("{}: holds no photographs, no paintings and no numbered frames", folder.string()));
      mailbox_.post([this, job, items = std::move(items)]() mutable {
        if (job == job_) open_files(items.front());
      });
    } catch (const std::exception& error) {
      post_failure(error, job);
    }
  });
}

void Viewer::step_file(int by) {
  if (const std::optional<std::size_t> place = place_later(session_, by)) {
    session_.items[session_.item] = session_.walk[*place];
    open(session_.item);
  }
}

void Viewer::find_walk(std::uint64_t job, const Item& item) {
  mailbox_.post([this, job, walk = items_beside(item)]() mutable {
    if (job == job_ && !session_.walk_is_given) session_.walk = std::move(walk);
  });
}

void Viewer::move_slideshow(double now_s) {
  const bool plays = session_.film && session_.film->plays;
  if (session_.opening || plays || session_.slideshow_s <= 0) {
    shown_at_s_ = now_s;
  } else if (now_s - shown_at_s_ >= session_.slideshow_s) {
    shown_at_s_ = now_s;
    step_file(1);
  }
}

void Viewer::read_ahead() {
  const std::optional<std::size_t> place = place_later(session_, 1);
  if (!place || session_.walk_is_given || session_.opening || is_working()) return;
  const Item& next = session_.walk[*place];
  if (ahead_asked_ == next) return;
  ahead_asked_ = next;
  ahead_.reset();
  reading_ahead_.start([this, next](const std::stop_token& stop) {
    try {
      const std::vector<fs::file_time_type> times = times_of(next);
      const Progress stops = [stop](std::string_view, double) {
        if (stop.stop_requested()) throw Error(ErrorKind::interrupted, "stopped");
      };
      Opened opened = open_content(next, stops);
      mailbox_.post([this, next, times, opened = std::move(opened)]() mutable {
        if (ahead_asked_ == next) ahead_ = Ahead{times, std::move(opened)};
      });
    } catch (const std::exception&) {
      return;  // it is told when the file is opened
    }
  });
}

std::optional<Opened> Viewer::take_ahead(const Item& item) {
  std::optional<Ahead> ahead = std::exchange(ahead_, std::nullopt);
  const bool fits = ahead && ahead_asked_ == item && ahead->times == times_of(item);
  ahead_asked_.clear();
  return fits ? std::optional(std::move(ahead->opened)) : std::nullopt;
}

}  // namespace wheatstone::viewer
