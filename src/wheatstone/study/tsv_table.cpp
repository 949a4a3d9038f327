#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "wheatstone/error.h"
#include "wheatstone/study/tsv_table_internal.h"

namespace wheatstone {
namespace {

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(at, begin);
    parts.emplace_back(text.substr(begin, end == std::string_view::npos ? end : end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

std::string line_text(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : "\t") + field;
  return line + "\n";
}

template <class Number>
std::optional<Number> number_between(const std::string& field, Number least, Number most) {
  Number value{};
  const char* const end = field.data() + field.size();
  const auto [read, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc() || read != end || !(value >= least && value <= most)) return {};
  return value;
}

/// Characters that no text has, on any line of a table.
void check_characters(const std::vector<std::string>& lines, const std::string& name) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].find('\0') != std::string::npos || lines[i].find('\r') != std::string::npos)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}:{}: holds a character that no text has, expected a table in UTF-8", name, i + 1));
}

}  // namespace

std::string plain_text(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\r' || i + 1 == text.size() || text[i + 1] != '\n') plain += text[i];
  return plain;
}

std::vector<std::string> fields_of(std::string_view line) { return split(line, '\t'); }

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines = split(text, '\n');
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

std::optional<std::size_t> TsvTable::find(std::string_view column) const {
  const auto found = std::ranges::find(columns, column);
  if (found == columns.end()) return {};
  return static_cast<std::size_t>(found - columns.begin());
}

std::size_t TsvTable::at(std::string_view column) const {
  if (const auto found = find(column)) return *found;
  throw Error(ErrorKind::bad_input, fmt::format("{}:1: has no column {}, expected it", name, column));
}

std::string TsvTable::where(std::size_t row) const { return fmt::format("{}:{}", name, row + 2); }

void TsvTable::refuse(std::size_t row, std::size_t column, std::string_view expected) const {
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: {} is '{}', expected {}", where(row), columns[column], rows[row][column], expected));
}

TsvTable parse_tsv(std::string_view text, std::string name) {
  std::vector<std::string> lines = lines_of(plain_text(text));
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  if (lines.empty()) throw Error(ErrorKind::bad_input, fmt::format("{}: is empty, expected a table", name));
  check_characters(lines, name);
  TsvTable table{.name = std::move(name), .columns = fields_of(lines.front())};
  std::set<std::string> names;
  for (const std::string& column : table.columns)
    if (!names.insert(column).second)
      throw Error(ErrorKind::bad_input, fmt::format("{}:1: has two columns {}", table.name, column));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    table.rows.push_back(fields_of(lines[i]));
    if (table.rows.back().size() != table.columns.size())
      throw Error(ErrorKind::bad_input, fmt::format("{}:{}: has {} fields, expected {}", table.name, i + 1,
                                                    table.rows.back().size(), table.columns.size()));
  }
  return table;
}

std::string tsv_text(const TsvTable& table) {
  std::string text = line_text(table.columns);
  for (const std::vector<std::string>& row : table.rows) text += line_text(row);
  return text;
}

std::optional<int> whole_number_in(const std::string& field, int least, int most) {
  return number_between(field, least, most);
}

std::optional<double> number_in(const std::string& field, double least, double most) {
  return number_between(field, least, most);
}

}  // namespace wheatstone
