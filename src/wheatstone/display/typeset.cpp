#include "wheatstone/display/typeset.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <regex>
#include <vector>

namespace wheatstone {
namespace {

/// Digits, sign and point, raised. Unicode has no raised point.
std::string raised(std::string_view number) {
  constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char sign : number)
    if (sign != '+') text += sign == '-' ? "⁻" : sign == '.' ? "·" : digits.at(static_cast<std::size_t>(sign - '0'));
  return text;
}

std::string name_of(std::string name) {
  for (const std::string_view star : {"Msun", "Lsun", "Rsun"})
    if (name == star) return fmt::format("{}☉", name.front());
  for (char& letter : name)
    if (letter == '_') letter = ' ';
  return name;
}

std::string with_power(const std::string& name, const std::string& exponent, bool below) {
  const double power = (below ? -1 : 1) * (exponent.empty() ? 1 : std::stod(exponent));
  if (power == 1) return name;
  const bool is_word = name.find(' ') == std::string::npos;
  return fmt::format(fmt::runtime(is_word ? "{}{}" : "({}){}"), name, raised(fmt::format("{:g}", power)));
}

}  // namespace

std::string power_of_ten(int exponent) { return fmt::format("10{}", raised(std::to_string(exponent))); }

std::string typeset_unit(std::string_view unit, int exponent) {
  static const std::regex number(R"(\s*(\d+\.?\d*)(?:[eE]([-+]?\d+))?(?=[\s*/]|$)\s*\*?(?!\*))");
  static const std::regex factor(R"(\s*([/*.]?)\s*\(?([A-Za-z_%]+)\)?(?:(?:\^|\*\*)?\(?([-+]?\d+(?:\.\d+)?)\)?)?)");
  std::string text(unit), printed;
  double mantissa = 1;
  std::smatch found;
  if (std::regex_search(text, found, number, std::regex_constants::match_continuous)) {
    mantissa = std::stod(found[1]);
    if (found[2].matched) exponent += std::stoi(found[2]);
    text = found.suffix();
  }
  if (mantissa != 1) printed = fmt::format("{:g}", mantissa);
  if (exponent != 0) printed += fmt::format(fmt::runtime(mantissa == 1 ? "{}" : "×{}"), power_of_ten(exponent));
  std::string product;
  for (auto at = text.cbegin(); at != text.cend(); at = found[0].second) {
    if (!std::regex_search(at, text.cend(), found, factor, std::regex_constants::match_continuous)) {
      product = text;
      break;
    }
    if (!product.empty()) product += ' ';
    product += with_power(name_of(found[2]), found[3], found[1] == "/");
  }
  if (!printed.empty() && !product.empty()) printed += ' ';
  return printed + product;
}

}  // namespace wheatstone
