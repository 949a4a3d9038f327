#include "progress_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace wheatstone::cli {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds(100);
constexpr int bar_width = 30;

// Progress is a courtesy: where standard error is closed the run goes on.
void put(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

void ProgressDisplay::show(std::string_view step, double done) {
  if (style_ == Style::none) return;
  const bool new_step = step_ != step;
  step_ = std::string(step);
  if (style_ == Style::lines) {
    if (new_step) put(fmt::format("{}\n", step));
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (!new_step && done < 1 && now - drawn_ < redraw_interval) return;
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
