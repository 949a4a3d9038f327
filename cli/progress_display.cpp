#include "progress_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ostream>

namespace wheatstone::cli {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds(100);
constexpr auto line_interval = std::chrono::seconds(10);
constexpr int bar_width = 30;

std::string_view first_word(std::string_view text) { return text.substr(0, text.find(' ')); }

}  // namespace

// Progress is a courtesy: where standard error is closed the run goes on.
void ProgressDisplay::put(std::string_view text) { errors_ << text << std::flush; }

void ProgressDisplay::show(std::string_view step, double done) {
  if (style_ == Style::none) return;
  const auto now = std::chrono::steady_clock::now();
  const bool new_step = step_ != step;
  // "painting frame 3 of 9" and "painting frame 4 of 9" are news of one kind.
  const bool new_kind = !step_ || first_word(*step_) != first_word(step);
  step_ = std::string(step);
  if (style_ == Style::lines) {
    if (!new_kind && (!new_step || now - drawn_ < line_interval)) return;
    drawn_ = now;
    put(fmt::format("{}\n", step));
    return;
  }
  if (!new_kind && done < 1 && now - drawn_ < redraw_interval) return;
  drawn_ = now;
  draw_bar(step, done);
}

void ProgressDisplay::draw_bar(std::string_view step, double done) {
  const double share = std::isfinite(done) ? std::clamp(done, 0.0, 1.0) : 0.0;
  const int filled = static_cast<int>(share * bar_width);
  put(fmt::format("\r[{:#<{}}{:.<{}}] {:3.0f} % {}\033[K", "", filled, "", bar_width - filled, 100 * share, step));
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
