#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/particles/cloud_source.h"

namespace wheatstone {

/// Numbers of a table's columns, from 0; −1 for what the table does not have.
struct ChosenColumns {
  std::array<int, 3> position{0, 1, 2};
  int density = -1, temperature = -1, smoothing_length = -1;
  std::array<int, 3> colour{-1, -1, -1};
};

/// The columns that the user named, and else those of the usual names: x, y, z; density or rho; and so on, in small
/// letters or capitals. Throws Error{bad_input} with the file's name where a named one or the position is missing.
ChosenColumns choose_columns(const std::string& path, const std::vector<std::string>& names, const CloudChoice& choice);

/// A field as a number; false where it is none, or not only one.
bool parse_number(std::string_view field, float& value);

/// Fields of a line; blanks, commas, semicolons and tabs all stand between them.
std::vector<std::string_view> fields_of(std::string_view line);

}  // namespace wheatstone
