#include "wheatstone/particles/condition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

using Kind = Condition::Kind;
using Operand = Condition::Operand;

constexpr std::size_t longest_condition = 10'000;
constexpr int deepest = 100;  // parentheses and `not` within each other

struct Comparison {
  std::string_view sign;
  Kind kind;
};
/// Longer signs stand before those that they begin with.
constexpr std::array<Comparison, 6> comparisons{{{"<=", Kind::at_most},
                                                 {">=", Kind::at_least},
                                                 {"==", Kind::equal},
                                                 {"!=", Kind::unequal},
                                                 {"<", Kind::less},
                                                 {">", Kind::more}}};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// What a name without quotes may hold: "velocity-x", "/gas/density", "B-V", "T[K]".
bool is_of_name(char c) { return !is_blank(c) && std::string_view("()<>=!&|\"'`,").find(c) == std::string_view::npos; }

/// Reads a condition from left to right.
class ConditionParser {
 public:
  ConditionParser(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  Condition parse() {
    if (text_.size() > longest_condition)
      throw Error(ErrorKind::wrong_usage, fmt::format("{}: is {} characters long, expected at most {}", name_,
                                                      text_.size(), longest_condition));
    parse_either(0);
    if (at_ < text_.size()) refuse("'and' or 'or'");
    return std::move(condition_);
  }

 private:
  /// Says what stands at this place, and what was expected.
  [[noreturn]] void refuse(std::string_view expected) const {
    constexpr std::size_t most_shown = 24;
    const std::string_view rest = text_.substr(at_);
    // No character of several bytes is cut in two.
    const auto starts_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
    std::size_t shown = std::min(most_shown, rest.size());
    while (shown < rest.size() && !starts_character(rest[shown])) ++shown;
    std::size_t from = text_.size() - std::min(most_shown, text_.size());
    while (from > 0 && !starts_character(text_[from])) --from;
    const std::string place =
        rest.empty()
            ? fmt::format("at the end of '{}{}'", from > 0 ? "…" : "", text_.substr(from))
            : fmt::format("at character {}, '{}{}'", at_ + 1, rest.substr(0, shown), shown < rest.size() ? "…" : "");
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: expected {} {}", name_, expected, place));
  }

  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  /// The name that begins here, without quotes; empty where none does.
  std::string_view plain_name() const {
    std::size_t end = at_;
    while (end < text_.size() && is_of_name(text_[end])) ++end;
    return text_.substr(at_, end - at_);
  }

  /// Steps over a word, in small letters or capitals, if it is the next one.
  bool take_word(std::string_view word) {
    skip_blanks();
    const std::string_view next = plain_name();
    const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    if (!std::ranges::equal(next, word, same)) return false;
    at_ += next.size();
    return true;
  }

  bool take_sign(std::string_view sign) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(sign)) return false;
    at_ += sign.size();
    return true;
  }

  void parse_either(int depth) {
    parse_both(depth);
    while (take_word("or")) {
      parse_both(depth);
      condition_.steps.push_back({Kind::either, {}});
    }
  }

  void parse_both(int depth) {
    parse_one(depth);
    while (take_word("and")) {
      parse_one(depth);
      condition_.steps.push_back({Kind::both, {}});
    }
  }

  void parse_one(int depth) {
    if (depth > deepest) refuse(fmt::format("at most {} parentheses and 'not' within each other", deepest));
    if (take_word("not")) {
      parse_one(depth + 1);
      condition_.steps.push_back({Kind::negation, {}});
    } else if (take_sign("(")) {
      parse_either(depth + 1);
      if (!take_sign(")")) refuse("')'");
    } else {
      parse_comparison();
    }
  }

  void parse_comparison() {
    const Operand left = parse_operand();
    skip_blanks();
    const auto* const found = std::ranges::find_if(
        comparisons, [&](const Comparison& known) { return text_.substr(at_).starts_with(known.sign); });
    if (found == comparisons.end()) refuse("one of < <= > >= == !=");
    const std::size_t sign_at = std::exchange(at_, at_ + found->sign.size());
    const Operand right = parse_operand();
    if (left.name < 0 && right.name < 0) {
      at_ = sign_at;
      refuse("a quantity on one side");
    }
    condition_.steps.push_back({found->kind, {left, right}});
    skip_blanks();
    if (at_ < text_.size() && std::string_view("<>=!").find(text_[at_]) != std::string_view::npos)
      refuse("'and' between two comparisons");
  }

  Operand parse_operand() {
    skip_blanks();
    const std::string_view rest = text_.substr(at_);
    const std::size_t sign = rest.starts_with('-') || rest.starts_with('+') ? 1 : 0;
    const bool is_number = rest.size() > sign && (is_digit(rest[sign]) || rest[sign] == '.');
    return is_number ? parse_number_here(rest) : Operand{.name = index_of(parse_name(rest))};
  }

  Operand parse_number_here(std::string_view rest) {
    const std::size_t plus = rest.starts_with('+') ? 1 : 0;
    Operand operand;
    const auto [stop, error] = std::from_chars(rest.data() + plus, rest.data() + rest.size(), operand.number);
    const bool ends = stop == rest.data() + rest.size() || !is_of_name(*stop);
    if (error == std::errc::result_out_of_range) refuse("a number of magnitude 1e-307 to 1e308");
    if (error != std::errc{} || !ends) refuse("a number, or a name in double quotes,");
    at_ += static_cast<std::size_t>(stop - rest.data());
    return operand;
  }

  std::string parse_name(std::string_view rest) {
    if (rest.starts_with('"')) {
      const std::size_t end = rest.find('"', 1);
      if (end == std::string_view::npos) refuse("a second double quote after that");
      if (end == 1) refuse("a name between the double quotes");
      at_ += end + 1;
      return std::string(rest.substr(1, end - 1));
    }
    const std::string_view name = plain_name();
    for (const std::string_view word : {"and", "or", "not"})
      if (name == word) refuse("a number or a quantity");
    if (name.empty()) refuse("a number or a quantity");
    at_ += name.size();
    return std::string(name);
  }

  int index_of(std::string name) {
    const auto found = std::ranges::find(condition_.names, name);
    const auto index = static_cast<int>(found - condition_.names.begin());
    if (found == condition_.names.end()) condition_.names.push_back(std::move(name));
    return index;
  }

  std::string_view text_, name_;
  std::size_t at_ = 0;
  Condition condition_;
};

// So many answers of a step stay in a core's nearest memory.
constexpr std::size_t answers_a_block = 2048;
using Answers = std::array<std::uint8_t, answers_a_block>;

/// Some of the numbers of an operand: `values`, or one for all particles.
struct OperandBlock {
  const double* values;
  double number;
};

/// One loop without branches, several numbers at a time.
template <class Compare>
void compare(const OperandBlock& left, const OperandBlock& right, std::size_t count, Answers& answers,
             Compare compare_two) {
  if (left.values != nullptr && right.values != nullptr) {
    for (std::size_t i = 0; i < count; ++i) answers[i] = compare_two(left.values[i], right.values[i]) ? 1 : 0;
  } else if (left.values != nullptr) {
    for (std::size_t i = 0; i < count; ++i) answers[i] = compare_two(left.values[i], right.number) ? 1 : 0;
  } else {
    for (std::size_t i = 0; i < count; ++i) answers[i] = compare_two(left.number, right.values[i]) ? 1 : 0;
  }
}

/// The number as a quantity of single precision has it, unless it would become 0 or infinite there.
double as_single_precision(double number) {
  using Limits = std::numeric_limits<float>;
  const double size = std::abs(number);
  return size >= Limits::min() && size <= Limits::max() ? static_cast<double>(static_cast<float>(number)) : number;
}

void compare_step(const Condition::Step& step, std::span<const QuantityColumn> columns, std::size_t first,
                  std::size_t count, Answers& answers) {
  const auto column_of = [&](const Operand& operand) {
    return operand.name < 0 ? nullptr : &columns[static_cast<std::size_t>(operand.name)];
  };
  const auto block_of = [&](const Operand& operand, const Operand& other) {
    if (const QuantityColumn* column = column_of(operand)) return OperandBlock{column->values.data() + first, 0};
    const QuantityColumn* compared = column_of(other);
    return OperandBlock{nullptr, compared != nullptr && compared->single_precision ? as_single_precision(operand.number)
                                                                                   : operand.number};
  };
  const OperandBlock left = block_of(step.operands[0], step.operands[1]);
  const OperandBlock right = block_of(step.operands[1], step.operands[0]);
  switch (step.kind) {
    case Kind::less:
      return compare(left, right, count, answers, std::less<>());
    case Kind::at_most:
      return compare(left, right, count, answers, std::less_equal<>());
    case Kind::more:
      return compare(left, right, count, answers, std::greater<>());
    case Kind::at_least:
      return compare(left, right, count, answers, std::greater_equal<>());
    case Kind::equal:
      return compare(left, right, count, answers, std::equal_to<>());
    default:
      return compare(left, right, count, answers, std::not_equal_to<>());
  }
}

/// How many answers wait at most until a later step takes them.
std::size_t most_waiting(const Condition& condition) {
  std::size_t height = 0, most = 0;
  for (const Condition::Step& step : condition.steps) {
    if (step.kind == Kind::both || step.kind == Kind::either) --height;
    if (step.kind < Kind::both) most = std::max(most, ++height);
  }
  return most;
}

}  // namespace

Condition parse_condition(std::string_view text, std::string_view name) { return ConditionParser(text, name).parse(); }

std::vector<std::uint8_t> where_holds(const Condition& condition, std::span<const QuantityColumn> columns,
                                      std::size_t count) {
  std::vector<std::uint8_t> holds(count);
  std::vector<Answers> stack(most_waiting(condition));
  for (std::size_t first = 0; first < count; first += answers_a_block) {
    const std::size_t some = std::min(answers_a_block, count - first);
    std::size_t height = 0;
    for (const Condition::Step& step : condition.steps) {
      if (step.kind == Kind::negation) {
        for (std::uint8_t& answer : stack[height - 1]) answer ^= 1;
      } else if (step.kind == Kind::both || step.kind == Kind::either) {
        --height;
        Answers &left = stack[height - 1], &right = stack[height];
        if (step.kind == Kind::both) {
          for (std::size_t i = 0; i < answers_a_block; ++i) left[i] &= right[i];
        } else {
          for (std::size_t i = 0; i < answers_a_block; ++i) left[i] |= right[i];
        }
      } else {
        compare_step(step, columns, first, some, stack[height++]);
      }
    }
    std::copy_n(stack.front().begin(), some, holds.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return holds;
}

}  // namespace wheatstone
