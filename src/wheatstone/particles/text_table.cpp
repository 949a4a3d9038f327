// Numbers in columns: CSV, or anything with blanks between, with a line of names or without.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"
#include "wheatstone/particles/particle_rows_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t longest_line = 1 << 16;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // UTF-8's, which spreadsheets write

struct Table {
  std::string path;
  std::ifstream file;
  std::uint64_t line = 0;
  std::string comment;  // the last line that began with '#', without it
  std::vector<std::string> names;
  std::vector<std::pair<std::string, std::string>> units;
  std::string waiting;  // the first line, where it holds numbers
  ChosenColumns chosen;

  /// The next line that is neither empty nor a comment. False at the end.
  bool read_line(std::string& text) {
    if (!waiting.empty()) {
      text = std::exchange(waiting, {});
      return true;
    }
    while (std::getline(file, text)) {
      ++line;
      if (line == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
      if (text.size() > longest_line)
        throw Error(ErrorKind::bad_input, fmt::format("{}: line {} is longer than {} bytes", path, line, longest_line));
      const std::size_t first = text.find_first_not_of(" \t\r");
      if (first == std::string::npos) continue;
      if (text[first] != '#') return true;
      comment = text.substr(std::min(text.find_first_not_of('#', first), text.size()));
    }
    return false;
  }
};

/// Names of columns, each with its unit where one stands behind it in brackets: "x [kpc], y [kpc], id".
struct Heading {
  std::vector<std::string> names;
  std::vector<std::pair<std::string, std::string>> units;
};

Heading parse_heading(std::string_view text) {
  Heading heading;
  while (!text.empty()) {
    const std::size_t opening = text.find_first_of("[(");
    for (const std::string_view field : fields_of(text.substr(0, opening))) {
      std::string name(field);
      std::erase(name, '"');
      if (!name.empty()) heading.names.push_back(std::move(name));
    }
    if (opening == std::string_view::npos) break;
    const std::size_t closing = text.find(text[opening] == '[' ? ']' : ')', opening);
    const std::string_view unit =
        text.substr(opening + 1, closing == std::string_view::npos ? 0 : closing - opening - 1);
    if (!heading.names.empty() && !unit.empty() && unit.size() < 40)
      heading.units.emplace_back(heading.names.back(), unit);
    text.remove_prefix(closing == std::string_view::npos ? text.size() : closing + 1);
  }
  return heading;
}

bool all_numbers(const std::vector<std::string_view>& fields) {
  return std::ranges::all_of(fields, [](std::string_view field) { return parse_number(field).has_value(); });
}

[[noreturn]] void refuse_line(const Table& table, const std::string& what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: line {} {}", table.path, table.line, what));
}

[[noreturn]] void refuse_decimal_commas(const Table& table) {
  refuse_line(table, "has decimal commas, expected decimal points (12.5, not 12,5)");
}

/// Finds the names of the columns in the first line, or in the comment above it. Without names the first three columns
/// are the position.
void read_heading(Table& table) {
  std::string first;
  if (!table.read_line(first))
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no particles, expected one line per particle", table.path));
  const std::vector<std::string_view> fields = fields_of(first);
  const bool numbers = all_numbers(fields);
  const Heading heading = parse_heading(numbers ? table.comment : first);
  const std::size_t columns = numbers ? fields.size() : heading.names.size();
  if (numbers && has_decimal_commas(first)) refuse_decimal_commas(table);
  if (columns < 3) refuse_line(table, fmt::format("has {} columns, expected at least x, y and z", columns));
  const auto is_named = [&](const char* axis) {
    return std::ranges::any_of(heading.names, [&](const std::string& name) { return lower_case(name) == axis; });
  };
  // A comment is prose unless it names every column, and a position among them.
  if (!numbers || (heading.names.size() == columns && is_named("x") && is_named("y") && is_named("z"))) {
    table.names = heading.names;
    table.units = heading.units;
  } else {
    constexpr std::array<const char*, 3> axes{"x", "y", "z"};
    for (std::size_t i = 0; i < columns; ++i) table.names.push_back(i < 3 ? axes[i] : fmt::format("column{}", i + 1));
  }
  if (numbers) table.waiting = std::move(first);
}

Rgb8 colour_of(const std::vector<double>& row, const std::array<int, 3>& columns) {
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::clamp(std::isnan(value) ? 0. : value, 0., 255.));
  };
  return {byte(row[columns[0]]), byte(row[columns[1]]), byte(row[columns[2]])};
}

void add_row(const Table& table, const std::vector<double>& row, ParticleRows& rows) {
  const ChosenColumns& chosen = table.chosen;
  rows.x.push_back(row[chosen.position[0]]);
  rows.y.push_back(row[chosen.position[1]]);
  rows.z.push_back(row[chosen.position[2]]);
  const auto put = [&](int column, std::vector<float>& to) {
    if (column >= 0) to.push_back(in_single_precision(row[column]));
  };
  put(chosen.density, rows.others.density);
  put(chosen.temperature, rows.others.temperature);
  put(chosen.smoothing_length, rows.others.smoothing_length);
  put(chosen.mass, rows.others.mass);
  put(chosen.quantity, rows.others.quantity);
  for (std::size_t i = 0; i < chosen.named.size(); ++i)
    if (chosen.named[i] >= 0) rows.named[i].values.push_back(row[chosen.named[i]]);
  if (std::ranges::min(chosen.colour) >= 0) rows.others.colour.push_back(colour_of(row, chosen.colour));
}

/// The numbers of a line, one for each name. Throws Error{bad_input}.
void parse_row(const Table& table, std::string_view text, std::vector<double>& row) {
  const std::vector<std::string_view> fields = fields_of(text);
  if (fields.size() < table.names.size())
    refuse_line(table, fmt::format("has {} columns, expected {}", fields.size(), table.names.size()));
  if (fields.size() > table.names.size() && has_decimal_commas(text)) refuse_decimal_commas(table);
  row.resize(table.names.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::optional<double> number = parse_number(fields[i]);
    const auto refuse = [&](const char* what) {
      throw Error(ErrorKind::bad_input, fmt::format("{}: line {}, column {}: '{}' {}", table.path, table.line, i + 1,
                                                    fields[i].substr(0, 40), what));
    };
    if (!number) refuse("is not a number");
    if (std::isinf(*number) && fields[i].find_first_of("0123456789") != std::string_view::npos)
      refuse("is too large, expected at most 1.7e308");
    row[i] = *number;
  }
}

ParticleRows read_rows(Table& table, std::size_t most) {
  ParticleRows rows;
  rows.named.resize(table.chosen.named.size());
  std::vector<double> row;
  std::string text;
  while (rows.size() < most && table.read_line(text)) {
    parse_row(table, text, row);
    add_row(table, row, rows);
  }
  return rows;
}

}  // namespace

CloudSource open_text_table(const std::filesystem::path& path, const CloudChoice& choice) {
  auto table = std::make_shared<Table>();
  table->path = path.string();
  table->file.open(path);
  read_heading(*table);
  table->chosen = choose_columns(table->path, table->names, choice);
  CloudSource source{.format = "text", .fields = table->names, .units = table->units};
  source.bytes = std::filesystem::file_size(path);
  give_rows([table](std::size_t most, ParticleRows& rows) { rows = read_rows(*table, most); }, path, choice, source);
  return source;
}

}  // namespace wheatstone
