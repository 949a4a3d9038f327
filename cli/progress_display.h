#pragma once

#include <chrono>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace wheatstone::cli {

/// Shows how far a run is: a bar that redraws itself on a terminal; elsewhere a line a step, and one every ten seconds,
/// but nothing in a run's first two seconds.
/// A step that takes longer than two seconds shows how long it has taken and how long it will still take.
class ProgressDisplay {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Style {
    bar,
    lines,
    every_step,  ///< lines, also of the first two seconds
    none
  };

  /// `errors` must outlive the display.
  ProgressDisplay(Style style, std::ostream& errors) : style_(style), errors_(errors) {}
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// `done` is the share of this step, 0..1.
  void show(std::string_view step, double done, Clock::time_point now = Clock::now());

  /// Takes the bar away, so that what is printed next starts on an empty line.
  void clear();

 private:
  void begin(double done, Clock::time_point now);
  std::string times(double done, Clock::time_point now) const;
  void put(std::string_view text);

  Style style_;
  std::ostream& errors_;
  std::optional<std::string> step_;
  std::optional<Clock::time_point> first_;
  std::optional<std::string> told_step_;
  Clock::time_point drawn_;
  Clock::time_point begun_;  ///< this kind of step
  double done_at_begin_ = 0;
  bool bar_visible_ = false;
};

/// A bar on a terminal, lines elsewhere.
ProgressDisplay::Style style_for_standard_error();

}  // namespace wheatstone::cli
