#include "wheatstone/app/colour_bar_ticks_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/display/typeset.h"
#include "wheatstone/multiview/colour_bar.h"

namespace wheatstone {
namespace {

int magnitude_of(double value) { return static_cast<int>(std::floor(std::log10(value) + 1e-9)); }

/// Numbers that come or go together, or one by one, the first ones first.
struct Class {
  std::vector<double> numbers;
  bool together;
};

/// 0, the powers of ten, and 5 and 2 times these. Above 0, the lower limit may be far below the upper one.
std::vector<Class> decades(const ToneSettings& tone) {
  const int highest = magnitude_of(tone.most);
  const bool logarithmic = tone.stretch == Stretch::log;
  const int lowest = logarithmic ? magnitude_of(tone.least) : highest - 4;
  std::vector<Class> classes;
  if (!logarithmic) classes.push_back({{0}, false});
  for (const std::vector<int>& multiples : {std::vector{1}, std::vector{5, 2}}) {
    Class numbers{{}, logarithmic && multiples.size() > 1};
    for (int power = highest; power >= lowest; --power)
      for (const int multiple : multiples) numbers.numbers.push_back(multiple * std::pow(10, power));
    classes.push_back(std::move(numbers));
  }
  return classes;
}

/// Multiples of 1, 2 and 5 times powers of ten, the finest first. Only the first of them that fits is taken.
std::vector<Class> steps(const ToneSettings& tone) {
  const double range = static_cast<double>(tone.most) - tone.least;
  std::vector<Class> classes;
  for (int power = magnitude_of(range) - 1; power <= magnitude_of(range); ++power)
    for (const int multiple : {1, 2, 5}) {
      const double step = multiple * std::pow(10, power);
      Class numbers{{}, true};
      for (double n = std::ceil(tone.least / step - 1e-6); n * step <= tone.most + 1e-6 * step; ++n)
        numbers.numbers.push_back(n * step);
      classes.push_back(std::move(numbers));
    }
  return classes;
}

/// Small powers of ten are not written.
bool is_plain(int magnitude) { return magnitude >= -2 && magnitude <= 3; }

/// Of numbers that reach over many powers of ten.
std::string label_in_powers(double number) {
  const int power = magnitude_of(number);
  const double multiple = number / std::pow(10, power);
  return std::abs(multiple - 1) < 1e-6 ? power_of_ten(power) : fmt::format("{:.3g}×{}", multiple, power_of_ten(power));
}

struct PlacedTick {
  Tick tick;
  int width;
};

}  // namespace

ColourBarTicks colour_bar_ticks(const ToneSettings& tone, int length_px, int gap_px,
                                const std::function<std::vector<int>(const std::vector<std::string>&)>& widths_of) {
  ColourBarTicks bar;
  const bool by_decades =
      tone.stretch != Stretch::linear && tone.most > 0 && tone.least >= 0 && tone.most > 10 * tone.least;
  const int magnitude = magnitude_of(std::max(std::abs(tone.least), std::abs(tone.most)));
  const bool in_powers =
      by_decades && tone.stretch == Stretch::log && !(is_plain(magnitude) && is_plain(magnitude_of(tone.least)));
  if (!in_powers && !is_plain(magnitude)) bar.exponent = magnitude;
  const auto label_of = [&](double number, int digits) {
    return in_powers ? label_in_powers(number) : fmt::format("{:.{}g}", number / std::pow(10, bar.exponent), digits);
  };
  std::vector<PlacedTick> placed;
  const auto fits = [&](const PlacedTick& one, const std::vector<PlacedTick>& others) {
    return std::ranges::all_of(others, [&](const PlacedTick& other) {
      return std::abs(one.tick.place - other.tick.place) * static_cast<float>(length_px) >=
             static_cast<float>(one.width + other.width + 2 * gap_px) / 2;
    });
  };
  const auto put = [&](const Class& numbers, int digits) {
    std::vector<std::string> labels;
    std::vector<float> places;
    for (const double number : numbers.numbers) {
      if (number < tone.least - 1e-6 * std::abs(tone.least) || number > tone.most * (1 + 1e-6)) continue;
      labels.push_back(label_of(number == 0 ? 0. : number, digits));
      places.push_back(std::clamp(brightness_at(tone, static_cast<float>(number)), 0.f, 1.f));
    }
    const std::vector<int> widths = widths_of(labels);
    std::vector<PlacedTick> with = placed;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      PlacedTick one{{places[i], labels[i]}, widths[i]};
      if (fits(one, with))
        with.push_back(std::move(one));
      else if (numbers.together)
        return;
    }
    placed = std::move(with);
  };
  constexpr int enough_digits = 7;
  for (const Class& numbers : by_decades ? decades(tone) : steps(tone)) {
    if (!by_decades && placed.size() > 1) break;
    if (!by_decades) placed.clear();
    put(numbers, enough_digits);
  }
  if (placed.size() < 2) {
    placed.clear();
    put({{tone.least, tone.most}, false}, 3);
  }
  std::ranges::sort(placed, {}, [](const PlacedTick& one) { return one.tick.place; });
  for (PlacedTick& one : placed) bar.ticks.push_back(std::move(one.tick));
  return bar;
}

}  // namespace wheatstone
