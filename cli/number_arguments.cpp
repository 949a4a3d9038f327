#include "number_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/video/film_time.h"

namespace wheatstone::cli {
namespace {

[[noreturn]] void refuse(const std::string& option, std::string_view text, std::string_view expected) {
  throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected {}", option, text, expected));
}

/// A number and what follows it; nothing where the text does not begin with a finite number.
template <class Number>
std::optional<std::pair<Number, std::string_view>> leading_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value)) return std::nullopt;
  return std::pair{value, text.substr(static_cast<std::size_t>(stop - text.data()))};
}

/// The whole text as a number; nothing where it is anything else.
template <class Number>
std::optional<Number> whole_number(std::string_view text) {
  const auto found = leading_number<Number>(text);
  return found && found->second.empty() ? std::optional(found->first) : std::nullopt;
}

template <class Number>
std::vector<Number> parse_list(const std::string& option, std::string_view text, const NumberList& list) {
  std::vector<Number> numbers;
  std::string_view rest = text;
  while (true) {
    const std::size_t stop = rest.find(list.between);
    const std::optional<Number> number = whole_number<Number>(rest.substr(0, stop));
    if (!number || !list.range.has(static_cast<double>(*number))) break;
    numbers.push_back(*number);
    if (stop == std::string_view::npos) {
      if (numbers.size() == list.count) return numbers;
      break;
    }
    rest.remove_prefix(stop + 1);
  }
  refuse(option, text, fmt::format("{}, each number{}", list.expected, words_of(list.range)));
}

}  // namespace

double parse_number(const std::string& option, std::string_view text, NumberRange range) {
  const std::optional<double> value = whole_number<double>(text);
  if (!value || !range.has(*value)) refuse(option, text, "a number" + words_of(range));
  return *value;
}

long long parse_integer(const std::string& option, std::string_view text, NumberRange range) {
  const std::optional<long long> value = whole_number<long long>(text);
  if (!value || !range.has(static_cast<double>(*value))) refuse(option, text, "a whole number" + words_of(range));
  return *value;
}

std::vector<double> parse_numbers(const std::string& option, std::string_view text, const NumberList& list) {
  return parse_list<double>(option, text, list);
}

std::vector<int> parse_integers(const std::string& option, std::string_view text, const NumberList& list) {
  return parse_list<int>(option, text, list);
}

double parse_length_mm(const std::string& option, std::string_view text, NumberRange range_mm) {
  constexpr std::array<std::pair<std::string_view, double>, 5> units{
      {{"", 1}, {"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}}};
  if (const auto number = leading_number<double>(text))
    for (const auto& [unit, millimetres] : units)
      if (number->second == unit && range_mm.has(number->first * millimetres)) return number->first * millimetres;
  refuse(option, text, fmt::format("a length{} mm, as 30mm, 3cm, 0.03m or 1.2in", words_of(range_mm)));
}

float parse_share(const std::string& option, std::string_view text, NumberRange percent) {
  const bool is_percent = text.ends_with('%');
  const std::string_view number = is_percent ? text.substr(0, text.size() - 1) : text;
  const double factor = is_percent ? 0.01 : 1;
  const std::string name = option + (is_percent ? ", in %" : ", a share of the width; with '%' in percent");
  return static_cast<float>(factor *
                            parse_number(name, number, {percent.least * 0.01 / factor, percent.most * 0.01 / factor}));
}

PictureSize parse_size(const std::string& option, std::string_view text, NumberRange side, std::string_view expected) {
  const std::vector<int> sides = parse_integers(option, text, {'x', 2, side, expected});
  return {sides[0], sides[1]};
}

Part parse_part(const std::string& option, const std::string& words) {
  const std::size_t slash = words.find('/');
  const std::string number = words.substr(0, slash);
  if (slash == std::string::npos)
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected NUMBER/PARTS, as 3/16", option, words));
  constexpr double most_parts = 1e6;
  Part part;
  part.of = static_cast<int>(parse_integer(option, words.substr(slash + 1), {1, most_parts}));
  part.number = static_cast<int>(parse_integer(option, number, {1, static_cast<double>(part.of)}));
  return part;
}

std::optional<double> parse_time_s(const std::string& option, std::string_view text) {
  if (text.empty()) return {};
  const std::optional<double> seconds = film_time_from(text);
  if (!seconds) refuse(option, text, "seconds or [HH:]MM:SS, as 12.5 or 1:02:03");
  return seconds;
}

Rational parse_frame_rate(const std::string& option, std::string_view text) {
  const std::size_t slash = text.find('/');
  const bool is_ratio = slash != std::string_view::npos;
  // More than a million frames per second are a slip, fewer than one in a thousand seconds as well.
  const auto part = [](std::string_view number, bool whole) -> std::optional<double> {
    const std::optional<double> value = whole_number<double>(number);
    if (!value || !NumberRange{0.001, 1e6}.has(*value) || (whole && *value != std::floor(*value))) return std::nullopt;
    return value;
  };
  const std::optional<double> above = part(text.substr(0, slash), is_ratio);
  const std::optional<double> below = is_ratio ? part(text.substr(slash + 1), true) : 1.0;
  if (!above || !below) refuse(option, text, "frames per second from 0.001 to 1000000, as 24 or 24000/1001");
  // Thousandths keep 23.976.
  const double scale = is_ratio ? 1 : 1000;
  const auto numerator = static_cast<int>(std::lround(*above * scale)), denominator = static_cast<int>(*below * scale);
  const int common = std::gcd(numerator, denominator);
  return {numerator / common, denominator / common};
}

std::size_t parse_bytes(const std::string& option, std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 4> units{{{"", 1}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}}};
  const auto number = leading_number<double>(text);
  const auto* const unit =
      number ? std::ranges::find(units, number->second, &std::pair<std::string_view, double>::first) : units.end();
  if (unit == units.end() || !NumberRange{1e3, 1e12}.has(number->first * unit->second))
    refuse(option, text, "a size of at least 1kB, as 8MB, 500kB or 1500000");
  return static_cast<std::size_t>(number->first * unit->second);
}

Condition parse_where(const std::string& option, const std::string& words) { return parse_condition(words, option); }

Rgb8 parse_colour(const std::string& option, std::string_view text) {
  const std::optional<Rgb8> colour = colour_of_code(text);
  if (!colour) refuse(option, text, "a colour as 3366FF");
  return *colour;
}

}  // namespace wheatstone::cli
