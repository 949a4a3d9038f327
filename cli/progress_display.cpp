#include "progress_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ostream>

namespace wheatstone::cli {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds(100);
constexpr auto line_interval = std::chrono::seconds(10);
constexpr auto time_is_shown_after = std::chrono::seconds(2);
constexpr auto lines_begin_after = std::chrono::seconds(2);
constexpr int bar_width = 30;

/// "1:05" or "2:00:00".
std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  return whole >= 3600 ? fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60)
                       : fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string_view first_word(std::string_view text) { return text.substr(0, text.find(' ')); }

}  // namespace

// Progress is a courtesy: where standard error is closed the run goes on.
void ProgressDisplay::put(std::string_view text) { errors_ << text << std::flush; }

void ProgressDisplay::begin(double done, Clock::time_point now) {
  begun_ = now;
  done_at_begin_ = done;
}

/// ", 0:12 gone, 0:24 left"; empty at first.
std::string ProgressDisplay::times(double done, Clock::time_point now) const {
  if (now - begun_ < time_is_shown_after) return {};
  const double seconds = std::chrono::duration<double>(now - begun_).count(), advance = done - done_at_begin_;
  std::string text = fmt::format(", {} gone", clock_text(seconds));
  if (advance > 0 && done < 1) text += fmt::format(", {} left", clock_text(seconds / advance * (1 - done)));
  return text;
}

void ProgressDisplay::show(std::string_view step, double done, Clock::time_point now) {
  if (style_ == Style::none) return;
  // "painting frame 3 of 9" and "painting frame 4 of 9" are news of one kind.
  const bool new_kind = !step_ || first_word(*step_) != first_word(step);
  const double share = std::isfinite(done) ? std::clamp(done, 0.0, 1.0) : 0.0;
  if (new_kind) begin(share, now);
  step_ = std::string(step);
  if (style_ == Style::lines || style_ == Style::every_step) {
    if (!first_) first_ = now;
    if (style_ == Style::lines && now - *first_ < lines_begin_after) return;
    const bool first_told = !told_step_ || first_word(*told_step_) != first_word(step);
    if (!first_told && now - drawn_ < line_interval) return;
    told_step_ = std::string(step);
    drawn_ = now;
    put(first_told ? fmt::format("{}\n", step) : fmt::format("{}: {:.0f} %{}\n", step, 100 * share, times(share, now)));
    return;
  }
  if (!new_kind && done < 1 && now - drawn_ < redraw_interval) return;
  drawn_ = now;
  const int filled = static_cast<int>(share * bar_width);
  put(fmt::format("\r[{:#<{}}{:.<{}}] {:3.0f} % {}{}\033[K", "", filled, "", bar_width - filled, 100 * share, step,
                  times(share, now)));
  bar_visible_ = true;
}

void ProgressDisplay::clear() {
  if (bar_visible_) put("\r\033[K");
  bar_visible_ = false;
}

ProgressDisplay::Style style_for_standard_error() {
  const char* terminal = std::getenv("TERM");
  const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
  return ::isatty(STDERR_FILENO) != 0 && can_redraw ? ProgressDisplay::Style::bar : ProgressDisplay::Style::lines;
}

}  // namespace wheatstone::cli
