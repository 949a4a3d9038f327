#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/files/text_encoding.h"
#include "wheatstone/study/figures_internal.h"

namespace wheatstone {
namespace {

constexpr double column_width = 46, plot_left = 64, plot_top = 16, plot_height = 260, label_height = 150;

/// A vertical axis from `least` to `most`, with marks at round numbers.
struct Axis {
  double least, most, step;
  double y(double value) const { return plot_top + plot_height * (most - value) / (most - least); }
};

/// 1, 2 or 5 times a power of ten.
double round_step(double range) {
  const double power = std::pow(10, std::floor(std::log10(range)));
  for (const double step : {0.1, 0.2, 0.5, 1.0})
    if (range / (step * power) <= 6) return step * power;
  return power;
}

Axis axis_around(double least, double most) {
  // What differs by rounding alone is equal: a step would be lost in the numbers that it is added to.
  constexpr double rounding = 1e-9;
  if (!(most - least > rounding * std::max(std::abs(most), std::abs(least)))) most = least + 1;
  const double step = round_step(most - least);
  return {std::floor(least / step) * step, std::ceil(most / step) * step, step};
}

std::string line(double x1, double y1, double x2, double y2, std::string_view colour = "#333") {
  return fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}"/>)", x1, y1, x2, y2, colour);
}

std::string axis_svg(const Axis& axis, double width, const std::string& title) {
  std::string svg;
  for (double value = axis.least; value <= axis.most + axis.step / 2; value += axis.step) {
    const double y = axis.y(value);
    svg += line(plot_left, y, width, y, "#ddd");
    svg += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="end">{:g}</text>)", plot_left - 6, y + 4,
                       std::round(value / axis.step) * axis.step);
  }
  return svg + fmt::format(R"svg(<text transform="translate(14 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
                           plot_top + plot_height / 2, html_text(title));
}

/// A condition's name below its column, one line a factor.
std::string column_label(double x, const std::string& name) {
  std::string svg;
  double line_x = x - 2;
  for (std::size_t begin = 0; begin <= name.size(); line_x += 15) {
    const std::size_t end = std::min(name.find(',', begin), name.size());
    svg += fmt::format(R"svg(<text transform="translate({:.1f} {:.1f}) rotate(-50)" text-anchor="end">{}</text>)svg",
                       line_x, plot_top + plot_height + 16, html_text(name.substr(begin, end - begin)));
    begin = end + 1;
  }
  return svg;
}

std::string figure(std::size_t columns, const std::string& content) {
  // Labels lean to the left of their columns.
  return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="-60 0 {0:.0f} {1:.0f}" width="{0:.0f}" )"
                     R"(height="{1:.0f}" font-family="sans-serif" font-size="12" role="img">{2}</svg>)"
                     "\n",
                     plot_left + column_width * static_cast<double>(columns) + 80,
                     plot_top + plot_height + label_height, content);
}

double middle_of(std::size_t column) { return plot_left + column_width * (static_cast<double>(column) + 0.5); }

}  // namespace

std::string means_figure(const MeasureAnalysis& measure) {
  double least = INFINITY, most = -INFINITY;
  for (const ConditionMean& mean : measure.means) {
    if (std::isnan(mean.mean)) continue;
    const double error = std::isnan(mean.standard_error) ? 0 : mean.standard_error;
    least = std::min(least, mean.mean - error);
    most = std::max(most, mean.mean + error);
  }
  if (least > most) return {};
  const Axis axis = axis_around(least, most);
  const double width = plot_left + column_width * static_cast<double>(measure.means.size());
  std::string svg = axis_svg(axis, width, measure.text + (measure.unit.empty() ? "" : ", " + measure.unit));
  for (std::size_t i = 0; i < measure.means.size(); ++i) {
    const ConditionMean& mean = measure.means[i];
    const double x = middle_of(i);
    svg += column_label(x, mean.condition);
    if (std::isnan(mean.mean)) continue;
    if (!std::isnan(mean.standard_error)) {
      const double high = axis.y(mean.mean + mean.standard_error), low = axis.y(mean.mean - mean.standard_error);
      svg += line(x, high, x, low) + line(x - 5, high, x + 5, high) + line(x - 5, low, x + 5, low);
    }
    svg += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="4.5" fill="#1f5fa8"/>)", x, axis.y(mean.mean));
  }
  return figure(measure.means.size(), svg);
}

std::string head_movement_figure(const std::vector<HeadMovement>& movement) {
  double most = 0;
  for (const HeadMovement& box : movement) {
    most = std::max(most, box.most);
    for (const double outside : box.outside) most = std::max(most, outside);
  }
  const Axis axis = axis_around(0, 100 * most);
  std::string svg =
      axis_svg(axis, plot_left + column_width * static_cast<double>(movement.size()), "Head movement in a trial, cm");
  for (std::size_t i = 0; i < movement.size(); ++i) {
    const HeadMovement& box = movement[i];
    const auto y = [&axis](double metres) { return axis.y(100 * metres); };
    const double x = middle_of(i);
    svg += column_label(x, box.condition) + line(x, y(box.most), x, y(box.upper_quartile)) +
           line(x, y(box.lower_quartile), x, y(box.least));
    svg += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="24" height="{:.1f}" fill="#cfe0f3" stroke="#333"/>)",
                       x - 12, y(box.upper_quartile), y(box.lower_quartile) - y(box.upper_quartile));
    svg += line(x - 12, y(box.median), x + 12, y(box.median), "#1f5fa8");
    for (const double outside : box.outside)
      svg += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="2" fill="none" stroke="#333"/>)", x, y(outside));
  }
  return figure(movement.size(), svg);
}

}  // namespace wheatstone
