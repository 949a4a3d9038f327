#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/particles/cloud_source.h"

namespace wheatstone {

/// Numbers of a table's columns, from 0; −1 for what the table does not have.
struct ChosenColumns {
  std::array<int, 3> position{0, 1, 2};
  int density = -1, temperature = -1, smoothing_length = -1, mass = -1, quantity = -1;
  std::array<int, 3> colour{-1, -1, -1};
  std::vector<int> named;  ///< of CloudChoice::where
};

/// The columns that the user named, and else those of the usual names: x, y, z; density or rho; and so on, in small
/// letters or capitals. Throws Error{bad_input} with the file's name where a named one or the position is missing.
ChosenColumns choose_columns(const std::string& path, const std::vector<std::string>& names, const CloudChoice& choice);

/// The names of three columns of positions: those that the user named, "x,y,z", else the usual ones. Throws
/// Error{bad_input} with the file's name where it is another number of names.
std::array<std::string, 3> position_names(const std::string& path, const CloudChoice& choice,
                                          const std::array<std::string, 3>& usual = {"x", "y", "z"});

/// The name of a vector's dataset and the number of the component that a quantity asks for, "velocity-x": 0, 1 or 2; −1
/// where it asks for none.
struct QuantityName {
  std::string base;
  int component = -1;
};
QuantityName quantity_name(const std::string& text);

/// The names of the quantities that a choice's condition asks for; none where it has none.
std::vector<std::string> names_in_condition(const CloudChoice& choice);

/// The index of a name, or else of one that differs from it by small letters and capitals only; −1 where there is none.
int index_of_name(std::span<const std::string> names, const std::string& wanted);

/// Throws Error{bad_input} where rows of `width` numbers do not have the component that is asked for.
void check_component(std::size_t width, const QuantityName& name, const std::string& file);

/// Rows of `width` numbers become one number each: a component, or with −1 their length; a single number stays itself.
void take_component(std::size_t width, int component, std::vector<float>& values);
void take_component(std::size_t width, int component, std::vector<double>& values);

/// A field as a number, whose exponent may be Fortran's ("1.5D3"). Nothing where it is none, or not only one. What is
/// too small for double precision is 0, what is too large is infinite.
std::optional<double> parse_number(std::string_view field);

/// Whether a line of numbers separated by blanks or semicolons has commas where decimal points are expected: "1,5; 2,5;
/// 3".
bool has_decimal_commas(std::string_view line);

/// Fields of a line; blanks, commas, semicolons and tabs all stand between them.
std::vector<std::string_view> fields_of(std::string_view line);

}  // namespace wheatstone
