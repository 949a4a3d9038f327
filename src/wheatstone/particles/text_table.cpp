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
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t longest_line = 1 << 16;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // UTF-8's, which spreadsheets write

struct Table {
  std::string path;
  std::ifstream file;
  std::uint64_t line = 0;
  std::vector<std::string> names;
  std::vector<std::string> waiting;  // the first line, where it holds numbers
  ChosenColumns chosen;

  /// The next line that is neither empty nor a comment. False at the end.
  bool read_line(std::string& text) {
    while (std::getline(file, text)) {
      ++line;
      if (line == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
      if (text.size() > longest_line)
        throw Error(ErrorKind::bad_input, fmt::format("{}: line {} is longer than {} bytes", path, line, longest_line));
      const std::size_t first = text.find_first_not_of(" \t\r");
      if (first != std::string::npos && text[first] != '#') return true;
    }
    return false;
  }
};

Rgb8 colour_of(const std::vector<float>& row, const std::array<int, 3>& columns) {
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(std::clamp(std::isnan(value) ? 0.f : value, 0.f, 255.f));
  };
  return {byte(row[columns[0]]), byte(row[columns[1]]), byte(row[columns[2]])};
}

void add_row(const Table& table, const std::vector<float>& row, Cloud& cloud) {
  const ChosenColumns& chosen = table.chosen;
  cloud.x.push_back(row[chosen.position[0]]);
  cloud.y.push_back(row[chosen.position[1]]);
  cloud.z.push_back(row[chosen.position[2]]);
  if (chosen.density >= 0) cloud.density.push_back(row[chosen.density]);
  if (chosen.temperature >= 0) cloud.temperature.push_back(row[chosen.temperature]);
  if (chosen.smoothing_length >= 0) cloud.smoothing_length.push_back(row[chosen.smoothing_length]);
  if (std::ranges::min(chosen.colour) >= 0) cloud.colour.push_back(colour_of(row, chosen.colour));
}

/// The numbers of a line, one for each name. Throws Error{bad_input}.
void parse_row(const Table& table, std::string_view text, std::vector<float>& row) {
  const std::vector<std::string_view> fields = fields_of(text);
  if (fields.size() < table.names.size())
    throw Error(ErrorKind::bad_input, fmt::format("{}: line {} has {} columns, expected {}", table.path, table.line,
                                                  fields.size(), table.names.size()));
  row.resize(table.names.size());
  for (std::size_t i = 0; i < row.size(); ++i)
    if (!parse_number(fields[i], row[i]))
      throw Error(ErrorKind::bad_input, fmt::format("{}: line {}, column {}: '{}' is not a number", table.path,
                                                    table.line, i + 1, fields[i].substr(0, 40)));
}

}  // namespace

CloudSource open_text_table(const std::filesystem::path& path, const CloudChoice& choice) {
  auto table = std::make_shared<Table>();
  table->path = path.string();
  table->file.open(path);
  std::string first;
  if (!table->read_line(first))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: has no particles, expected one line per particle", path.string()));
  const std::vector<std::string_view> fields = fields_of(first);
  float number = 0;
  const bool numbers = std::ranges::all_of(fields, [&](std::string_view field) { return parse_number(field, number); });
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
  table->chosen = choose_columns(table->path, table->names, choice);
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
