#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "number_arguments.h"
#include "wheatstone/error.h"

namespace CLI {
class App;
}

namespace wheatstone::cli {

// An option is a row of a table. Parser, help, refusals, file of options, manual pages and completions come from the
// rows of a command. A row is bound to a member of the command's arguments, which must outlive it.

/// What an option takes, and where it goes.
struct Value {
  enum class Takes { one, two, any_number, nothing };
  std::function<void(const std::string& option, const std::vector<std::string>& words)> set;
  std::string type = {};      ///< as the help has it: "NUMBER", "png|jpg"; empty: any text
  std::string fallback = {};  ///< the default as the help shows it; empty: none is shown
  Takes takes = Takes::one;
  bool required = false;
};

/// Why an option has no effect in this run: the words behind "has no effect", as "on photographs; it works on a
/// painting (.wst)". Empty where it has. Asked when all options are known.
using Reason = std::function<std::string()>;
using Reasons = std::vector<Reason>;

/// The words, where `holds` says so.
Reason when(std::function<bool()> holds, std::string words);

struct Row {
  std::string names;  ///< "-o,--output", "--swap,!--no-swap"; "FILE" of one that is known by its place
  Value value;
  std::string help;
  Reasons unless = {};                     ///< the option is refused where one of them holds
  std::string needs = {};                  ///< another option
  std::vector<std::string> excludes = {};  ///< other options
  std::string heading = {};                ///< in the help; empty: the first one
};
using Rows = std::vector<Row>;

Row row(std::string names, Value value, std::string help, Reasons unless = {}, std::string needs = {},
        std::vector<std::string> excludes = {});

Rows join(std::initializer_list<Rows> parts);

/// The rows under a heading of the help, refused where one of `unless` holds.
Rows under(std::string heading, Rows rows, const Reasons& unless = {});

/// The options that the line or a file of options gave, by their first long names, in the order of their rows.
struct Given {
  struct Option {
    std::string name;
    std::vector<std::string> words;
    Value::Takes takes;
  };
  std::vector<Option> options;
  bool operator()(std::string_view option) const {
    return std::ranges::find(options, option, &Option::name) != options.end();
  }
  /// The word behind an option that was given and takes one.
  const std::string& word_of(std::string_view option) const {
    return std::ranges::find(options, option, &Option::name)->words.front();
  }
};

/// The same options as the words of another line.
std::vector<std::string> words_of(const Given& given);

/// Holds where the input is of another kind than these. `situation` says what it is, as "on a film", and `where` what
/// the option works on.
template <class Kind>
Reason only_on(std::function<Kind()> kind, std::vector<Kind> kinds, std::string_view (*situation)(Kind),
               std::string where) {
  return [=] {
    const Kind found = kind();
    return std::ranges::find(kinds, found) != kinds.end() ? "" : fmt::format("{}; {}", situation(found), where);
  };
}

// ---- What options take. Each is bound to `value`, whose content is the default.

/// Any text; the default is shown where there is one.
Value text(std::string& value);
Value text(std::filesystem::path& value);
/// The name of what is written, which must not be empty.
Value output_name(std::string& value);
/// Each word of any number.
Value texts(std::vector<std::string>& values);
/// Present or not; where the name begins with '!', present sets it to false.
Value flag(bool& value);

/// Makes the option one that must be given.
Value required(Value value);
/// The same with another word for the type, or without a default in the help.
Value of_type(std::string type, Value value);
Value without_default(Value value);

/// Anything that `parse` understands; it throws Error{wrong_usage} that names the option.
template <class Member, std::invocable<const std::string&, const std::string&> Parse>
Value parsed(Member& value, Parse parse, std::string type = {}, std::string fallback = {}) {
  return {[&value, parse](const std::string& option, const std::vector<std::string>& words) {
            value = static_cast<Member>(parse(option, words.front()));
          },
          std::move(type), std::move(fallback)};
}

/// A whole or a real number, or an optional of either.
template <class Member>
Value number(Member& value, NumberRange range) {
  const auto parse = [&value, range](auto known) {
    using Number = decltype(known);
    return parsed(
        value,
        [range](const std::string& option, const std::string& words) {
          if constexpr (std::is_integral_v<Number>)
            return static_cast<Number>(parse_integer(option, words, range));
          else
            return static_cast<Number>(parse_number(option, words, range));
        },
        "NUMBER");
  };
  if constexpr (requires { value.has_value(); }) {
    return parse(typename Member::value_type());
  } else {
    Value made = parse(Member());
    if (value == value) made.fallback = fmt::format("{}", value);  // NaN stands for "not given"
    return made;
  }
}

/// A share, as "3%" or "0.03". The range is in percent; `fallback` is the default as the help shows it.
Value share(float& value, NumberRange percent, std::string fallback);

/// A length in millimetres, or with a unit: mm, cm, m, in.
template <class Member>
Value length(Member& value_mm, NumberRange range_mm) {
  return parsed(
      value_mm,
      [range_mm](const std::string& option, const std::string& words) {
        return parse_length_mm(option, words, range_mm);
      },
      "LENGTH", fmt::format("{}", value_mm));
}

/// WIDTHxHEIGHT or, with other words, COLUMNSxROWS: a PictureSize or an optional of one.
template <class Member>
Value size(Member& value, NumberRange side, std::string_view expected = "WIDTHxHEIGHT") {
  const auto parse = [side, expected](const std::string& option, const std::string& words) {
    return parse_size(option, words, side, expected);
  };
  if constexpr (std::is_same_v<Member, PictureSize>) {
    return parsed(value, parse, {}, fmt::format("{}x{}", value.width, value.height));
  } else {
    return parsed(value, parse);
  }
}

/// One of these names, which stays one. They must live as long as the program.
Value name(std::string& value, std::span<const std::string_view> names);

/// A value by its name.
template <class Member>
struct Choice {
  std::string_view name;
  Member value;
};
template <class Member>
Value choice(Member& value, std::type_identity_t<std::span<const Choice<Member>>> choices) {
  std::string all, present;
  for (const auto& [name, known] : choices) {
    all += fmt::format("{}{}", all.empty() ? "" : "|", name);
    if (known == value) present = name;
  }
  const auto parse = [choices, all](const std::string& option, const std::string& words) {
    for (const auto& [name, known] : choices)
      if (name == words) return known;
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected {}", option, words, all));
  };
  return parsed(value, parse, all, present);
}

// ---- What is done with rows.

/// The option's first long name, or that of its place.
std::string name_of(const Row& row);

/// Adds the options to the parser; a parsed line sets what they are bound to.
void add_rows(CLI::App& app, const Rows& rows);

/// An option as another program gives it: a row's name without dashes, as "look_at", and its words; of a switch "true"
/// or "false".
using NamedWords = std::pair<std::string, std::vector<std::string>>;

/// Sets what the rows are bound to, without a line to parse. Throws Error{wrong_usage}, with the option's name as it is
/// given, for one that no row has, and for options that need or exclude others.
Given set_rows(const Rows& rows, std::span<const NamedWords> options);

/// The name of a row's option as other programs give it: "look_at".
std::string plain_name_of(const Row& row);

/// Which of them were given.
Given given_on(const CLI::App& app, const Rows& rows);

/// Throws Error{wrong_usage} for the first that was given and has no effect: "--scale: has no effect on photographs; it
/// works on a painting (.wst)".
void refuse_without_effect(const Rows& rows, const Given& given);

/// The same for options that turn out to have no effect once an input is read.
void refuse_options(const Given& given, std::initializer_list<std::string_view> options, std::string_view words);

}  // namespace wheatstone::cli
