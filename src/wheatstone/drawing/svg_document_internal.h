#pragma once

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "wheatstone/drawing/fit_curve_internal.h"

namespace wheatstone {

inline constexpr int svg_units_a_pixel = 10;

/// Writes an SVG document, whose coordinates are whole tenths of a pixel.
class SvgDocument {
 public:
  SvgDocument(int width, int height, std::string_view attributes) {
    add(R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" )"
        R"(width="{}" height="{}" viewBox="0 0 {} {}" {}>)"
        "\n",
        width, height, svg_units_a_pixel * width, svg_units_a_pixel * height, attributes);
  }

  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  // A path's data: moves and curves from the place that was reached, in the shortest numbers.
  void move_to(PlanePoint place) {
    reached_ = rounded(place);
    add("M{} {}", reached_.x, reached_.y);
    command_ = 'M';
  }
  void line_to(PlanePoint place) {
    const Place to = rounded(place);
    if (to == reached_) return;
    begin_command('l');
    add_step(to);
    reached_ = to;
  }
  void curve_to(const BezierCurve& curve) {
    const Place first = rounded(curve.first), second = rounded(curve.second), to = rounded(curve.end);
    if (is_straight(first, second, to)) return line_to(curve.end);
    begin_command('c');
    add_step(first);
    add_step(second);
    add_step(to);
    reached_ = to;
  }
  /// A dot is a line of length 0.
  void end_line() {
    if (command_ == 'M') add("h0");
  }
  void close_ring() {
    add("z");
    command_ = 'z';
  }

  std::string finished() {
    add("</svg>\n");
    return fmt::to_string(text_);
  }

 private:
  struct Place {
    int x, y;
    friend bool operator==(const Place&, const Place&) = default;
  };

  static Place rounded(PlanePoint place) {
    return {static_cast<int>(std::lround(svg_units_a_pixel * place.x)),
            static_cast<int>(std::lround(svg_units_a_pixel * place.y))};
  }

  /// Whether the inner points lie on the way from the reached place to the end, to within rounding.
  bool is_straight(Place first, Place second, Place to) const {
    const double dx = to.x - reached_.x, dy = to.y - reached_.y, length = std::hypot(dx, dy);
    const auto beside = [&](Place p) { return std::abs(dx * (p.y - reached_.y) - dy * (p.x - reached_.x)); };
    const auto along = [&](Place p) { return dx * (p.x - reached_.x) + dy * (p.y - reached_.y); };
    const auto between = [&](Place p) { return along(p) >= 0 && along(p) <= length * length; };
    constexpr double units = 0.6;
    return beside(first) <= units * length && beside(second) <= units * length && between(first) && between(second);
  }

  /// A command equal to the previous one is not repeated.
  void begin_command(char command) {
    if (command != command_) {
      text_.push_back(command);
      needs_space_ = false;
    }
    command_ = command;
  }
  void add_number(int number) {
    if (needs_space_ && number >= 0) text_.push_back(' ');
    add("{}", number);
    needs_space_ = true;
  }
  void add_step(Place to) {
    add_number(to.x - reached_.x);
    add_number(to.y - reached_.y);
  }

  fmt::memory_buffer text_;
  Place reached_{0, 0};
  char command_ = ' ';
  bool needs_space_ = false;
};

}  // namespace wheatstone
