#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <span>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/particles/columns_internal.h"

namespace wheatstone {
namespace {

/// A file's columns by name.
struct NamedColumns {
  const std::string& path;
  const std::vector<std::string>& names;

  int find(const std::string& name) const { return index_of_name(names, name); }
  int required(const std::string& name) const {
    const int found = find(name);
    if (found < 0)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: has no column '{}', but {}", path, name, fmt::join(names, ", ")));
    return found;
  }
  /// The column that the user named, or the first of the usual names.
  int chosen(const std::string& wanted, std::initializer_list<const char*> usual) const {
    if (!wanted.empty()) return required(wanted);
    for (const char* name : usual)
      if (const int found = find(name); found >= 0) return found;
    return -1;
  }
};

template <class Number>
void take_component_of(std::size_t width, int component, std::vector<Number>& values) {
  if (width == 1) return;
  const std::size_t rows = values.size() / width;
  for (std::size_t i = 0; i < rows; ++i) {
    const std::span<const Number> row(values.data() + i * width, width);
    Number square = 0;
    for (const Number value : row) square += value * value;
    values[i] = component >= 0 ? row[static_cast<std::size_t>(component)] : std::sqrt(square);
  }
  values.resize(rows);
}

}  // namespace

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

std::optional<double> parse_number(std::string_view field) {
  std::string in_c;  // Fortran writes D or d where C has e
  if (const std::size_t exponent = field.find_first_of("Dd"); exponent != std::string_view::npos) {
    in_c = field;
    in_c[exponent] = 'e';
    field = in_c;
  }
  if (field.starts_with('+')) field.remove_prefix(1);
  double number = 0;
  const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  if (stop != field.data() + field.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    const bool small = field.find("e-") != std::string_view::npos || field.find("E-") != std::string_view::npos;
    const double infinite = field.starts_with('-') ? -HUGE_VAL : HUGE_VAL;
    return small ? 0 : infinite;
  }
  return number;
}

bool has_decimal_commas(std::string_view line) {
  constexpr std::string_view between = " \t;\r";
  int fields = 0;
  bool found = false;
  for (std::size_t at = line.find_first_not_of(between); at != std::string_view::npos;
       at = line.find_first_not_of(between, at)) {
    const std::size_t end = std::min(line.find_first_of(between, at), line.size());
    std::string field(line.substr(at, end - at));
    at = end;
    ++fields;
    const std::size_t comma = field.find(',');
    if (comma == std::string::npos || comma == 0 || comma + 1 == field.size()) continue;
    field[comma] = '.';
    found = found || parse_number(field).has_value();
  }
  return found && fields >= 3;
}

QuantityName quantity_name(const std::string& text) {
  const std::size_t length = text.size();
  if (length < 3 || text[length - 2] != '-' || text[length - 1] < 'x' || text[length - 1] > 'z') return {text, -1};
  return {text.substr(0, length - 2), text[length - 1] - 'x'};
}

void check_component(std::size_t width, const QuantityName& name, const std::string& file) {
  if (name.component < 0 || static_cast<std::size_t>(name.component) < width) return;
  throw Error(ErrorKind::bad_input, fmt::format("{}: {} has {} numbers per row, but component {} was requested", file,
                                                name.base, width, "xyz"[name.component]));
}

std::vector<std::string> names_in_condition(const CloudChoice& choice) {
  return choice.where ? choice.where->names : std::vector<std::string>();
}

int index_of_name(std::span<const std::string> names, const std::string& wanted) {
  const auto index = [&](auto found) { return found == names.end() ? -1 : static_cast<int>(found - names.begin()); };
  if (const int same = index(std::ranges::find(names, wanted)); same >= 0) return same;
  return index(std::ranges::find(names, lower_case(wanted), lower_case));
}

void take_component(std::size_t width, int component, std::vector<float>& values) {
  take_component_of(width, component, values);
}

void take_component(std::size_t width, int component, std::vector<double>& values) {
  take_component_of(width, component, values);
}

std::array<std::string, 3> position_names(const std::string& path, const CloudChoice& choice,
                                          const std::array<std::string, 3>& usual) {
  if (choice.position.empty()) return usual;
  const std::vector<std::string_view> axes = fields_of(choice.position);
  if (axes.size() != 3)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: '{}' is not a list of positions, expected three columns, for example {}", path,
                            choice.position, fmt::join(usual, ",")));
  return {std::string(axes[0]), std::string(axes[1]), std::string(axes[2])};
}

ChosenColumns choose_columns(const std::string& path, const std::vector<std::string>& names,
                             const CloudChoice& choice) {
  const std::array<std::string, 3> axes = position_names(path, choice);
  const NamedColumns columns{path, names};
  ChosenColumns chosen;
  for (std::size_t axis = 0; axis < 3; ++axis) chosen.position[axis] = columns.required(axes[axis]);
  chosen.density = columns.chosen(choice.density, {"density", "rho"});
  chosen.temperature = columns.chosen(choice.temperature, {"temperature", "temp", "t", "scalar", "intensity"});
  chosen.smoothing_length = columns.chosen(choice.smoothing_length, {"smoothing_length", "hsml", "h"});
  chosen.mass = columns.chosen(choice.mass, {"mass", "masses"});
  if (!choice.quantity.empty()) chosen.quantity = columns.required(choice.quantity);
  for (const std::string& name : names_in_condition(choice)) chosen.named.push_back(columns.find(name));
  chosen.colour = {columns.chosen({}, {"red", "r"}), columns.chosen({}, {"green", "g"}),
                   columns.chosen({}, {"blue", "b"})};
  return chosen;
}

}  // namespace wheatstone
