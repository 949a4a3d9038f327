#include "options.h"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

namespace wheatstone::cli {
namespace {

CLI::Option* add_value(CLI::App& app, const Row& row) {
  const auto set = [set = row.value.set, name = name_of(row)](const std::vector<std::string>& words) {
    set(name, words);
  };
  switch (row.value.takes) {
    case Value::Takes::nothing:
      return app.add_flag_function(
          row.names, [set](std::int64_t count) { set({count > 0 ? "true" : "false"}); }, row.help);
    case Value::Takes::any_number:
      return app.add_option_function<std::vector<std::string>>(row.names, set, row.help);
    case Value::Takes::two:
      return app.add_option_function<std::vector<std::string>>(row.names, set, row.help)->expected(2);
    case Value::Takes::one:
      break;
  }
  return app.add_option_function<std::string>(
      row.names, [set](const std::string& word) { set({word}); }, row.help);
}

[[noreturn]] void refuse(std::string_view option, std::string_view words) {
  throw Error(ErrorKind::wrong_usage, fmt::format("{}: has no effect {}", option, words));
}

}  // namespace

Reason when(std::function<bool()> holds, std::string words) {
  return [holds = std::move(holds), words = std::move(words)] { return holds() ? words : std::string(); };
}

Row row(std::string names, Value value, std::string help, Reasons unless, std::string needs,
        std::vector<std::string> excludes) {
  return {std::move(names),  std::move(value), std::move(help),
          std::move(unless), std::move(needs), std::move(excludes)};
}

Rows join(std::initializer_list<Rows> parts) {
  Rows all;
  for (const Rows& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Rows under(std::string heading, Rows rows, const Reasons& unless) {
  for (Row& row : rows) {
    if (row.heading.empty()) row.heading = heading;
    row.unless.insert(row.unless.begin(), unless.begin(), unless.end());
  }
  return rows;
}

Value text(std::string& value) {
  return parsed(
      value, [](const std::string&, const std::string& words) { return words; }, {}, value);
}

Value text(std::filesystem::path& value) {
  return parsed(
      value, [](const std::string&, const std::string& words) { return words; }, {}, value.string());
}

Value output_name(std::string& value) {
  const auto parse = [](const std::string& option, const std::string& words) {
    if (words.empty()) throw Error(ErrorKind::wrong_usage, option + ": is empty, expected a name");
    return words;
  };
  return parsed(value, parse, {}, value);
}

Value share(float& value, NumberRange percent, std::string fallback) {
  const auto parse = [percent](const std::string& option, const std::string& words) {
    return parse_share(option, words, percent);
  };
  return parsed(value, parse, "SHARE", std::move(fallback));
}

Value texts(std::vector<std::string>& values) {
  return {[&values](const std::string&, const std::vector<std::string>& words) { values = words; },
          {},
          {},
          Value::Takes::any_number};
}

Value flag(bool& value) {
  return {[&value](const std::string&, const std::vector<std::string>& words) { value = words.front() == "true"; },
          {},
          {},
          Value::Takes::nothing};
}

Value required(Value value) {
  value.required = true;
  return value;
}

Value of_type(std::string type, Value value) {
  value.type = std::move(type);
  return value;
}

Value without_default(Value value) {
  value.fallback.clear();
  return value;
}

Value name(std::string& value, std::span<const std::string_view> names) {
  const std::string all = fmt::format("{}", fmt::join(names, "|"));
  const auto parse = [names, all](const std::string& option, const std::string& words) {
    if (std::ranges::find(names, words) == names.end())
      throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected {}", option, words, all));
    return words;
  };
  return parsed(value, parse, all, value);
}

std::string name_of(const Row& row) {
  const std::size_t dashes = std::min(row.names.find("--"), row.names.size());
  const std::size_t begin = dashes == row.names.size() ? 0 : dashes;
  return row.names.substr(begin, row.names.find(',', begin) - begin);
}

void add_rows(CLI::App& app, const Rows& rows) {
  std::vector<CLI::Option*> options;
  for (const Row& row : rows) {
    CLI::Option* const option = options.emplace_back(add_value(app, row));
    if (!row.value.type.empty()) option->type_name(row.value.type);
    if (!row.value.fallback.empty()) option->default_str(row.value.fallback);
    if (!row.heading.empty()) option->group(row.heading);
    option->required(row.value.required);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].needs.empty()) options[i]->needs(app.get_option(rows[i].needs));
    for (const std::string& other : rows[i].excludes) options[i]->excludes(app.get_option(other));
  }
}

std::string plain_name_of(const Row& row) {
  std::string name = name_of(row);
  name.erase(0, name.find_first_not_of("-!"));
  std::ranges::replace(name, '-', '_');
  return name;
}

Given set_rows(const Rows& rows, std::span<const NamedWords> options) {
  Given given;
  for (const Row& row : rows) {
    const std::string name = plain_name_of(row);
    for (const auto& [option, words] : options) {
      if (option != name) continue;
      const bool is_switch = row.value.takes == Value::Takes::nothing;
      if (is_switch && words != std::vector<std::string>{"true"} && words != std::vector<std::string>{"false"})
        throw Error(ErrorKind::wrong_usage, fmt::format("{}: expected True or False", name));
      if (is_switch && words.front() == "false") continue;
      if (!is_switch && words.size() != (row.value.takes == Value::Takes::two ? 2u : 1u))
        throw Error(ErrorKind::wrong_usage, fmt::format("{}: has {} words, expected one", name, words.size()));
      row.value.set(name, is_switch && row.names.starts_with('!') ? std::vector<std::string>{"false"} : words);
      given.options.push_back({name_of(row), words, row.value.takes});
    }
  }
  for (const auto& [option, words] : options)
    if (std::ranges::find(rows, option, plain_name_of) == rows.end())
      throw Error(ErrorKind::wrong_usage, fmt::format("{}: there is no such option", option));
  for (const Row& row : rows) {
    if (!given(name_of(row))) continue;
    if (!row.needs.empty() && !given(row.needs))
      throw Error(ErrorKind::wrong_usage, fmt::format("{}: has no effect without {}", plain_name_of(row), row.needs));
    for (const std::string& other : row.excludes)
      if (given(other)) throw Error(ErrorKind::wrong_usage, fmt::format("{}: excludes {}", plain_name_of(row), other));
  }
  return given;
}

Given given_on(const CLI::App& app, const Rows& rows) {
  Given given;
  for (const Row& row : rows)
    if (app.count(name_of(row)) > 0)
      given.options.push_back({name_of(row), app.get_option(name_of(row))->results(), row.value.takes});
  return given;
}

std::vector<std::string> words_of(const Given& given) {
  std::vector<std::string> words, places;
  for (const auto& [name, behind, takes] : given.options) {
    const bool is_flag = takes == Value::Takes::nothing;
    if (is_flag && behind.front() == "false") continue;  // a file of options may say so
    std::vector<std::string>& line = name.starts_with('-') ? words : places;
    if (name.starts_with('-')) line.push_back(name);
    if (!is_flag) line.insert(line.end(), behind.begin(), behind.end());
  }
  if (!places.empty()) words.emplace_back("--");
  words.insert(words.end(), places.begin(), places.end());
  return words;
}

void refuse_without_effect(const Rows& rows, const Given& given) {
  for (const Row& row : rows) {
    if (!given(name_of(row))) continue;
    for (const Reason& reason : row.unless)
      if (const std::string words = reason(); !words.empty()) refuse(name_of(row), words);
  }
}

void refuse_options(const Given& given, std::initializer_list<std::string_view> options, std::string_view words) {
  for (const std::string_view option : options)
    if (given(option)) refuse(option, words);
}

}  // namespace wheatstone::cli
