#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone {

/// A text whose lines end by '\n' alone and that has no byte-order mark, from one that may have both.
std::string plain_text(std::string_view text);

/// Fields of a line between tabs, and lines of a text, without their ends.
std::vector<std::string> fields_of(std::string_view line);
std::vector<std::string> lines_of(std::string_view text);

/// A table with a header, tab-separated, as BIDS has it.
struct TsvTable {
  std::string name;  ///< of the file in messages
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each has as many fields as there are columns

  std::optional<std::size_t> find(std::string_view column) const;
  /// Throws Error{bad_input} where there is no such column.
  std::size_t at(std::string_view column) const;
  /// "participants.tsv:3", the line of a row.
  std::string where(std::size_t row) const;
  /// Throws Error{bad_input}: "participants.tsv:3: observer is 'x', expected 'person'".
  [[noreturn]] void refuse(std::size_t row, std::size_t column, std::string_view expected) const;
};

/// Reads a table, with line ends of any system. Throws Error{bad_input} that names the line that has too few or too
/// many fields.
TsvTable parse_tsv(std::string_view text, std::string name);
std::string tsv_text(const TsvTable& table);

/// A field that is a whole number within these limits; none where it is anything else.
std::optional<int> whole_number_in(const std::string& field, int least, int most);
/// A field that is a number within these limits; none where it is anything else.
std::optional<double> number_in(const std::string& field, double least, double most);

}  // namespace wheatstone
