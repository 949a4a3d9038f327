// NumPy's .npy, versions 1 to 3: an array of N×3 numbers, or more columns; or of N records of named numbers.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <fstream>
#include <optional>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"
#include "wheatstone/particles/npy_internal.h"

namespace wheatstone {
namespace {

/// The number of a column, from 0, that the user gave; none where he gave none.
std::optional<std::uint64_t> column_given(const std::string& text, std::uint64_t columns, const std::string& path) {
  if (text.empty()) return std::nullopt;
  std::uint64_t column = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), column);
  if (error != std::errc{} || stop != text.data() + text.size() || column >= columns)
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no column '{}', but 0 to {}", path, text, columns - 1));
  return column;
}

/// Rows of numbers of one type: the columns are known by their numbers, and the first three are the position unless
/// others are named.
CloudSource open_rows(RecordLayout layout, const NpyElement& element, std::uint64_t columns,
                      const CloudChoice& choice) {
  const std::string name = layout.path.string();
  const bool by_column = layout.column_bytes > 0;
  layout.record_bytes = by_column ? element.bytes : element.bytes * columns;
  const auto field = [&](std::uint64_t column) {
    return RecordField{.at = static_cast<std::size_t>(by_column ? column : column * element.bytes),
                       .type = element.fields[0].type};
  };
  const std::array<std::string, 3> axes = position_names(name, choice, {"0", "1", "2"});
  for (std::size_t axis = 0; axis < 3; ++axis) layout.position[axis] = field(*column_given(axes[axis], columns, name));
  if (const auto column = column_given(choice.density, columns, name)) layout.density = field(*column);
  if (const auto column = column_given(choice.temperature, columns, name)) layout.temperature = field(*column);
  if (const auto column = column_given(choice.smoothing_length, columns, name))
    layout.smoothing_length = field(*column);
  if (const auto column = column_given(choice.mass, columns, name)) layout.mass = field(*column);
  if (const auto column = column_given(choice.quantity, columns, name)) layout.quantity = field(*column);
  std::vector<std::string> fields;
  for (std::uint64_t column = 0; column < columns; ++column) fields.push_back(std::to_string(column));
  for (const std::string& wanted : names_in_condition(choice)) {
    const int column = index_of_name(fields, wanted);
    layout.named.push_back(column < 0 ? std::nullopt : std::optional(field(static_cast<std::uint64_t>(column))));
  }
  return open_records(layout, "NumPy", std::move(fields), choice);
}

/// Records of named numbers.
CloudSource open_structures(RecordLayout layout, const NpyElement& element, const CloudChoice& choice) {
  layout.record_bytes = element.bytes;
  const ChosenColumns chosen = choose_columns(layout.path.string(), element.names, choice);
  for (std::size_t axis = 0; axis < 3; ++axis) layout.position[axis] = element.fields[chosen.position[axis]];
  if (chosen.density >= 0) layout.density = element.fields[chosen.density];
  if (chosen.temperature >= 0) layout.temperature = element.fields[chosen.temperature];
  if (chosen.smoothing_length >= 0) layout.smoothing_length = element.fields[chosen.smoothing_length];
  if (chosen.mass >= 0) layout.mass = element.fields[chosen.mass];
  if (chosen.quantity >= 0) layout.quantity = element.fields[chosen.quantity];
  for (const int column : chosen.named)
    layout.named.push_back(column < 0 ? std::nullopt : std::optional(element.fields[column]));
  if (std::ranges::min(chosen.colour) >= 0)
    layout.colour = {element.fields[chosen.colour[0]], element.fields[chosen.colour[1]],
                     element.fields[chosen.colour[2]]};
  return open_records(layout, "NumPy", element.names, choice);
}

}  // namespace

CloudSource open_npy(const std::filesystem::path& path, const CloudChoice& choice) {
  RecordLayout layout{.path = path};
  const std::string name = path.string();
  std::string first_bytes(most_npy_header_bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(first_bytes.data(), static_cast<std::streamsize>(first_bytes.size()));
  first_bytes.resize(static_cast<std::size_t>(file.gcount()));
  const NpyHeader header = parse_npy_header(first_bytes, name);
  const auto& [bytes, element, shape, by_column, type_words, shape_words] = header;
  if (!element || shape.empty()) refuse_npy(header, name);
  layout.begin = bytes;
  layout.swapped = element->swapped;
  layout.count = shape[0];
  const bool structured = !element->names.empty();
  if (structured && shape.size() == 1) return open_structures(std::move(layout), *element, choice);
  if (structured || shape.size() != 2) refuse_npy(header, name);
  // Three rows and more columns than a particle has are all x, all y and all z.
  const bool transposed = shape[0] == 3 && shape[1] > most_columns;
  if (shape[0] == 3 && shape[1] > 3 && !transposed)
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{}: has the shape (3, {}), expected one row per particle; an array of all x, all y and all "
                    "z must be transposed before it is saved (array.T)",
                    name, shape[1]));
  if (!transposed && (shape[1] < 3 || shape[1] > most_columns)) refuse_npy(header, name);
  if (transposed) layout.count = shape[1];
  if (by_column != transposed) {
    if (layout.count > (std::uint64_t{1} << 60) / most_columns / element->bytes)
      throw Error(ErrorKind::bad_input, fmt::format("{}: says it has {} rows", name, layout.count));
    layout.column_bytes = layout.count * element->bytes;
  }
  return open_rows(std::move(layout), *element, transposed ? 3 : shape[1], choice);
}

}  // namespace wheatstone
