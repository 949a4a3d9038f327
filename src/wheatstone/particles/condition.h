#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone {

/// Which particles are meant, as "Temperature > 1e6 and Density < 1e-3": comparisons (<, <=, >, >=, ==, !=) of
/// quantities and numbers, joined by `and`, `or` and `not`, with parentheses. A quantity has the name that the file has
/// for it; one with blanks or signs in its name, or a number as its name, stands in double quotes.
struct Condition {
  /// A number, or the quantity of a name.
  struct Operand {
    int name = -1;      ///< index in `names`; −1: the number
    double number = 0;  ///< finite
    friend bool operator==(const Operand&, const Operand&) = default;
  };
  enum class Kind { less, at_most, more, at_least, equal, unequal, both, either, negation };
  struct Step {
    Kind kind;
    std::array<Operand, 2> operands;  ///< of a comparison; the other kinds take the answers of the steps before
    friend bool operator==(const Step&, const Step&) = default;
  };
  std::vector<std::string> names;  ///< of the quantities, each once
  std::vector<Step> steps;         ///< in reverse Polish order; the last one's answer is the condition's
  friend bool operator==(const Condition&, const Condition&) = default;
};

/// Throws Error{wrong_usage}, beginning with `name`, which says where the text is wrong: "where: expected a number or a
/// quantity at the end of 'Density <'".
Condition parse_condition(std::string_view text, std::string_view name = "where");

/// The numbers of a quantity, one for each particle.
struct QuantityColumn {
  std::vector<double> values;
  bool single_precision = false;  ///< the file has floats: a number that they are compared with is rounded to one, too
};

/// For each of `count` particles 1 where the condition holds, else 0. `columns` are those of the condition's names, in
/// their order. Of what is not a number (NaN) only != holds.
std::vector<std::uint8_t> where_holds(const Condition& condition, std::span<const QuantityColumn> columns,
                                      std::size_t count);

}  // namespace wheatstone
