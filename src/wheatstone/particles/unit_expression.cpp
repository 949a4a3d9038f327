#include "wheatstone/particles/unit_expression.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <regex>
#include <vector>

namespace wheatstone {
namespace {

/// A number times what follows it: "1e10 Msun".
struct Scaled {
  double factor = 1;
  std::string unit;
};

Scaled scaled(const std::string& text) {
  static const std::regex number(R"(\s*(\d+\.?\d*(?:[eE][-+]?\d+)?)(?:\s*\*\s*|\s+|$)(.*))");
  std::smatch found;
  if (!std::regex_match(text, found, number)) return {1, text};
  return {std::stod(found[1]), found[2]};
}

std::string joined(const Scaled& unit) {
  if (unit.factor == 1) return unit.unit;
  const std::string factor = fmt::format("{:g}", unit.factor);
  return unit.unit.empty() ? factor : fmt::format("{}*{}", factor, unit.unit);
}

/// Powers with two asterisks, products with one; as it was where it is no product of powers.
std::string multiplied(const std::string& text) {
  static const std::regex factor(R"(\s*([/*]?)\s*([A-Za-z_%]+)(?:(?:\^|\*\*)?\(?([-+]?\d+(?:\.\d+)?)\)?)?)");
  std::string product;
  for (auto at = text.begin(); at != text.end();) {
    std::smatch found;
    if (!std::regex_search(at, text.end(), found, factor, std::regex_constants::match_continuous)) return text;
    if (found[2] == "a" || found[2] == "h") return text;
    const std::string before = found[1] == "/" ? (product.empty() ? "1/" : "/") : (product.empty() ? "" : "*");
    product += before + (found[2] == "Msol" ? "Msun" : found[2].str());  // as pynbody has it
    if (found[3].matched && found[3] != "1") product += "**" + found[3].str();
    at = found[0].second;
  }
  return product;
}

}  // namespace

std::string unit_expression(std::string_view told) {
  std::string text(told);
  if (const std::size_t opening = text.find(" ("); opening != std::string::npos && text.ends_with(')'))
    text = text.substr(opening + 2, text.size() - opening - 3);  // the name that people call it by
  if (const std::size_t code = text.find("code "); code != std::string::npos) text[code + 4] = '_';
  Scaled unit = scaled(text);
  const std::string product = multiplied(unit.unit);
  if (product == unit.unit && product.find_first_of(" ^") != std::string::npos) return std::string(told);
  unit.unit = product;
  return joined(unit);
}

std::string column_unit(std::string_view mass, std::string_view length) {
  if (mass.empty() || length.empty()) return {};
  const Scaled of_mass = scaled(unit_expression(mass)), of_length = scaled(unit_expression(length));
  const bool is_name = of_length.unit.find_first_of(" */^(") == std::string::npos;
  return joined({of_mass.factor / (of_length.factor * of_length.factor),
                 fmt::format(fmt::runtime(is_name ? "{}/{}**2" : "{}/({})**2"),
                             of_mass.unit.empty() ? "1" : of_mass.unit, of_length.unit)});
}

}  // namespace wheatstone
