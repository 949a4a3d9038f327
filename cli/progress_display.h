#pragma once

#include <chrono>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace wheatstone::cli {

/// Shows how far a run is: a bar that redraws itself on a terminal, one line a step elsewhere.
class ProgressDisplay {
 public:
  enum class Style { bar, lines, none };

  /// `errors` must outlive the display.
  ProgressDisplay(Style style, std::ostream& errors) : style_(style), errors_(errors) {}
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// `done` is the share of this step, 0..1.
  void show(std::string_view step, double done);

  /// Takes the bar away, so that what is printed next starts on an empty line.
  void clear();

 private:
  void draw_bar(std::string_view step, double done);
  void put(std::string_view text);

  Style style_;
  std::ostream& errors_;
  std::optional<std::string> step_;
  std::chrono::steady_clock::time_point drawn_;
  bool bar_visible_ = false;
};

/// A bar on a terminal, lines elsewhere.
ProgressDisplay::Style style_for_standard_error();

}  // namespace wheatstone::cli
