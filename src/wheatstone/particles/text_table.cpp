// Numbers in columns: CSV, or anything with blanks between, with a line of names or without.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>

#include "wheatstone/error.h"
#include "wheatstone/particles/formats_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t longest_line = 1 << 16;

/// Fields of a line; blanks, commas, semicolons and tabs all stand between them.
std::vector<std::string_view> fields_of(std::string_view line) {
  constexpr std::string_view between = " \t,;\r";
  std::vector<std::string_view> fields;
  for (std::size_t at = line.find_first_not_of(between); at != std::string_view::npos;
       at = line.find_first_not_of(between, at)) {
    const std::size_t end = std::min(line.find_first_of(between, at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = end;
  }
  return fields;
}

bool parse(std::string_view field, float& value) {
  double number = 0;
  const auto [stop, error] =
      std::from_chars(field.data() + (field.starts_with('+') ? 1 : 0), field.data() + field.size(), number);
  value = static_cast<float>(number);
  return error == std::errc{} && stop == field.data() + field.size();
}

struct Table {
  std::string path;
  std::ifstream file;
  std::uint64_t line = 0;
  std::vector<std::string> names;
  std::vector<std::string> waiting;  // the first line, where it holds numbers
  std::array<int, 3> position{0, 1, 2};
  int density = -1, temperature = -1, smoothing_length = -1;
  std::array<int, 3> colour{-1, -1, -1};

  /// The next line that is neither empty nor a comment. False at the end.
  bool read_line(std::string& text) {
    while (std::getline(file, text)) {
      ++line;
      if (text.size() > longest_line)
        throw Error(ErrorKind::bad_input, fmt::format("{}: line {} is longer than {} bytes", path, line, longest_line));
      const std::size_t first = text.find_first_not_of(" \t\r");
      if (first != std::string::npos && text[first] != '#') return true;
    }
    return false;
  }
};

std::string lower(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

/// The column that the user named, or the first of the usual names; −1 where there is none.
int column_of(const Table& table, const std::string& wanted, std::initializer_list<const char*> usual) {
  const auto find = [&](const std::string& name) {
    for (std::size_t i = 0; i < table.names.size(); ++i)
      if (lower(table.names[i]) == lower(name)) return static_cast<int>(i);
    return -1;
  };
  if (!wanted.empty()) {
    const int found = find(wanted);
    if (found < 0)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: has no column '{}', but {}", table.path, wanted, fmt::join(table.names, ", ")));
    return found;
  }
  for (const char* name : usual)
    if (const int found = find(name); found >= 0) return found;
  return -1;
}

void choose_columns(Table& table, const CloudChoice& choice) {
  const std::vector<std::string_view> names =
      choice.position.empty() ? std::vector<std::string_view>{"x", "y", "z"} : fields_of(choice.position);
  if (names.size() != 3)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: '{}' is no position, expected three columns, as x,y,z", table.path, choice.position));
  for (std::size_t axis = 0; axis < 3; ++axis) table.position[axis] = column_of(table, std::string(names[axis]), {});
  table.density = column_of(table, choice.density, {"density", "rho"});
  table.temperature = column_of(table, choice.temperature, {"temperature", "temp", "t", "scalar", "intensity"});
  table.smoothing_length = column_of(table, choice.smoothing_length, {"smoothing_length", "hsml", "h"});
  table.colour = {column_of(table, {}, {"red", "r"}), column_of(table, {}, {"green", "g"}),
                  column_of(table, {}, {"blue", "b"})};
}

Rgb8 colour_of(const std::vector<float>& row, const std::array<int, 3>& columns) {
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(std::clamp(std::isnan(value) ? 0.f : value, 0.f, 255.f));
  };
  return {byte(row[columns[0]]), byte(row[columns[1]]), byte(row[columns[2]])};
}

void add_row(const Table& table, const std::vector<float>& row, Cloud& cloud) {
  cloud.x.push_back(row[table.position[0]]);
  cloud.y.push_back(row[table.position[1]]);
  cloud.z.push_back(row[table.position[2]]);
  if (table.density >= 0) cloud.density.push_back(row[table.density]);
  if (table.temperature >= 0) cloud.temperature.push_back(row[table.temperature]);
  if (table.smoothing_length >= 0) cloud.smoothing_length.push_back(row[table.smoothing_length]);
  if (std::ranges::min(table.colour) >= 0) cloud.colour.push_back(colour_of(row, table.colour));
}

/// The numbers of a line, one for each name. Throws Error{bad_input}.
void parse_row(const Table& table, std::string_view text, std::vector<float>& row) {
  const std::vector<std::string_view> fields = fields_of(text);
  if (fields.size() < table.names.size())
    throw Error(ErrorKind::bad_input, fmt::format("{}: line {} has {} columns, expected {}", table.path, table.line,
                                                  fields.size(), table.names.size()));
  row.resize(table.names.size());
  for (std::size_t i = 0; i < row.size(); ++i)
    if (!parse(fields[i], row[i]))
      throw Error(ErrorKind::bad_input, fmt::format("{}: line {}, column {}: '{}' is no number", table.path, table.line,
                                                    i + 1, fields[i].substr(0, 40)));
}

}  // namespace

CloudSource open_text_table(const std::filesystem::path& path, const CloudChoice& choice) {
  auto table = std::make_shared<Table>();
  table->path = path.string();
  table->file.open(path);
  std::string first;
  if (!table->read_line(first))
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no particles, expected a line each", path.string()));
  const std::vector<std::string_view> fields = fields_of(first);
  float number = 0;
  const bool numbers = std::ranges::all_of(fields, [&](std::string_view field) { return parse(field, number); });
  if (fields.size() < 3)
    throw Error(ErrorKind::bad_input, fmt::format("{}: line {} has {} columns, expected at least x, y and z",
                                                  path.string(), table->line, fields.size()));
  if (numbers) {
    // Without names the first three columns are the position.
    constexpr std::array<const char*, 3> axes{"x", "y", "z"};
    for (std::size_t i = 0; i < fields.size(); ++i)
      table->names.push_back(i < 3 ? axes[i] : fmt::format("column{}", i + 1));
    table->waiting.push_back(first);
  } else {
    for (const std::string_view field : fields) {
      const std::size_t quoted = field.size() > 1 && field.front() == '"' && field.back() == '"' ? 1 : 0;
      table->names.emplace_back(field.substr(quoted, field.size() - 2 * quoted));
    }
  }
  choose_columns(*table, choice);
  CloudSource source{.format = "text", .fields = table->names};
  source.bytes = std::filesystem::file_size(path);
  source.next = [table](std::size_t most) {
    Cloud cloud;
    std::vector<float> row;
    std::string text;
    while (cloud.size() < most) {
      if (!table->waiting.empty()) {
        text = table->waiting.back();
        table->waiting.pop_back();
      } else if (!table->read_line(text)) {
        break;
      }
      parse_row(*table, text, row);
      add_row(*table, row, cloud);
    }
    return cloud;
  };
  return source;
}

}  // namespace wheatstone
