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
#include "wheatstone/particles/records_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t longest_header = 1 << 16;

/// What stands behind 'key': in the header's dictionary.
std::string_view value_of(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(fmt::format("'{}'", key));
  if (at == std::string_view::npos) return {};
  const std::size_t colon = header.find(':', at);
  if (colon == std::string_view::npos) return {};
  const std::size_t first = header.find_first_not_of(' ', colon + 1);
  return first == std::string_view::npos ? std::string_view{} : header.substr(first);
}

std::optional<NumberType> type_of(std::string_view code) {
  constexpr std::pair<std::string_view, NumberType> types[] = {
      {"f2", NumberType::f16}, {"f4", NumberType::f32}, {"f8", NumberType::f64}, {"i1", NumberType::i8},
      {"u1", NumberType::u8},  {"i2", NumberType::i16}, {"u2", NumberType::u16}, {"i4", NumberType::i32},
      {"u4", NumberType::u32}, {"i8", NumberType::i64}, {"u8", NumberType::u64}};
  for (const auto& [name, type] : types)
    if (code == name) return type;
  return std::nullopt;
}

/// The sizes of "(N,)" or "(N, k)"; nothing where it is no such shape.
std::vector<std::uint64_t> parse_shape(std::string_view text) {
  std::vector<std::uint64_t> sizes;
  if (!text.starts_with('(')) return {};
  const char* at = text.data() + 1;
  const char* const end = text.data() + text.size();
  while (at != end && *at != ')') {
    std::uint64_t size = 0;
    const auto [stop, error] = std::from_chars(at, end, size);
    if (error != std::errc{}) return {};
    sizes.push_back(size);
    at = stop;
    while (at != end && (*at == ' ' || *at == ',')) ++at;
  }
  return at == end ? std::vector<std::uint64_t>{} : sizes;
}

/// What stands between quotation marks at the beginning of the text, which is then cut off.
std::optional<std::string> take_quoted(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(", "), text.size()));
  if (text.empty() || (text[0] != '\'' && text[0] != '"')) return std::nullopt;
  const std::size_t end = text.find(text[0], 1);
  if (end == std::string_view::npos) return std::nullopt;
  std::string quoted(text.substr(1, end - 1));
  text.remove_prefix(end + 1);
  return quoted;
}

/// An array's numbers: of one type, or records of named ones.
struct ElementType {
  bool big_endian = false;
  std::size_t bytes = 0;
  std::vector<std::string> names;  ///< of a record's numbers; empty where the array's are of one type
  std::vector<RecordField> fields;
};

/// Adds a number of a code as "<f4". False for what is no plain number, or has another byte order than the others.
bool add_number(const std::string& code, const std::string& name, ElementType& element) {
  if (code.size() < 3) return false;
  if (name.empty() && code[1] == 'V') {  // padding
    std::size_t bytes = 0;
    std::from_chars(code.data() + 2, code.data() + code.size(), bytes);
    element.bytes += bytes;
    return bytes > 0 && bytes < longest_header;
  }
  const std::optional<NumberType> type = type_of(std::string_view(code).substr(1));
  if (!type) return false;
  const bool big = code[0] == '>';
  const bool first = element.fields.empty();
  if (first) element.big_endian = big;
  if (bytes_of(*type) > 1 && big != element.big_endian && !first) return false;
  element.fields.push_back({.at = element.bytes, .type = *type});
  element.names.push_back(name);
  element.bytes += bytes_of(*type);
  return true;
}

/// "'<f4'", or "[('x', '<f4'), ('y', '<f4'), …]". Nothing for anything else.
std::optional<ElementType> parse_type(std::string_view text) {
  ElementType element;
  if (!text.starts_with('[')) {
    const std::optional<std::string> code = take_quoted(text);
    if (!code || !add_number(*code, "a number", element)) return std::nullopt;
    element.names.clear();
    return element;
  }
  text.remove_prefix(1);
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(", "), text.size()));
    if (text.starts_with(']')) break;
    if (!text.starts_with('(')) return std::nullopt;
    text.remove_prefix(1);
    const std::optional<std::string> name = take_quoted(text);
    const std::optional<std::string> code = take_quoted(text);
    if (!name || !code || !text.starts_with(')') || !add_number(*code, *name, element)) return std::nullopt;
    text.remove_prefix(1);
  }
  if (element.fields.empty()) return std::nullopt;
  return element;
}

std::string read_header(const std::filesystem::path& path, std::uint64_t& begin) {
  std::ifstream file(path, std::ios::binary);
  std::array<unsigned char, 12> lead{};
  file.read(reinterpret_cast<char*>(lead.data()), lead.size());
  const bool long_length = lead[6] >= 2;
  const std::size_t length = lead[8] + 256u * lead[9] +
                             (long_length ? 65536u * std::size_t{lead[10]} + 16777216u * std::size_t{lead[11]} : 0u);
  begin = (long_length ? 12 : 10) + length;
  if (!file || length > longest_header)
    throw Error(ErrorKind::bad_input, fmt::format("{}: its NumPy header is damaged or cut short", path.string()));
  std::string header(length, '\0');
  file.seekg(long_length ? 12 : 10);
  file.read(header.data(), static_cast<std::streamsize>(length));
  if (!file) throw Error(ErrorKind::bad_input, fmt::format("{}: its NumPy header is cut short", path.string()));
  return header;
}

/// The number of a column, from 0, that the user gave; none where he gave none.
std::optional<std::uint64_t> column_given(const std::string& text, std::uint64_t columns, const std::string& path) {
  if (text.empty()) return std::nullopt;
  std::uint64_t column = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), column);
  if (error != std::errc{} || stop != text.data() + text.size() || column >= columns)
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no column '{}', but 0 to {}", path, text, columns - 1));
  return column;
}

[[noreturn]] void refuse_array(const std::string& path, std::string_view header) {
  // A value ends before the comma in front of the next key.
  const auto shown = [&](std::string_view key) {
    const std::string_view value = value_of(header, key);
    return value.substr(0, std::min({value.find(", 'fortran_order'"), value.find(", 'shape'"), value.find(", }"),
                                     value.find('}'), std::size_t{100}}));
  };
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: is an array of type {} and shape {}, expected rows of three numbers or more, or records "
                          "with numbers x, y and z; numbers may be f2, f4, f8, i1 to i8 and u1 to u8",
                          path, shown("descr"), shown("shape")));
}

/// Rows of numbers of one type: the columns are known by their numbers, and the first three are the position.
CloudSource open_rows(RecordLayout layout, const ElementType& element, std::uint64_t columns,
                      const CloudChoice& choice) {
  const std::string name = layout.path.string();
  const bool by_column = layout.column_bytes > 0;
  layout.record_bytes = by_column ? element.bytes : element.bytes * columns;
  const auto field = [&](std::uint64_t column) {
    return RecordField{.at = static_cast<std::size_t>(by_column ? column : column * element.bytes),
                       .type = element.fields[0].type};
  };
  for (std::size_t axis = 0; axis < 3; ++axis) layout.position[axis] = field(axis);
  if (const auto column = column_given(choice.density, columns, name)) layout.density = field(*column);
  if (const auto column = column_given(choice.temperature, columns, name)) layout.temperature = field(*column);
  if (const auto column = column_given(choice.smoothing_length, columns, name))
    layout.smoothing_length = field(*column);
  std::vector<std::string> fields;
  for (std::uint64_t column = 0; column < columns; ++column) fields.push_back(std::to_string(column));
  return open_records(layout, "NumPy", std::move(fields), choice);
}

/// Records of named numbers.
CloudSource open_structures(RecordLayout layout, const ElementType& element, const CloudChoice& choice) {
  layout.record_bytes = element.bytes;
  const ChosenColumns chosen = choose_columns(layout.path.string(), element.names, choice);
  for (std::size_t axis = 0; axis < 3; ++axis) layout.position[axis] = element.fields[chosen.position[axis]];
  if (chosen.density >= 0) layout.density = element.fields[chosen.density];
  if (chosen.temperature >= 0) layout.temperature = element.fields[chosen.temperature];
  if (chosen.smoothing_length >= 0) layout.smoothing_length = element.fields[chosen.smoothing_length];
  if (std::ranges::min(chosen.colour) >= 0)
    layout.colour = {element.fields[chosen.colour[0]], element.fields[chosen.colour[1]],
                     element.fields[chosen.colour[2]]};
  return open_records(layout, "NumPy", element.names, choice);
}

}  // namespace

CloudSource open_npy(const std::filesystem::path& path, const CloudChoice& choice) {
  RecordLayout layout{.path = path};
  const std::string header = read_header(path, layout.begin);
  const std::string name = path.string();
  const std::optional<ElementType> element = parse_type(value_of(header, "descr"));
  const std::vector<std::uint64_t> shape = parse_shape(value_of(header, "shape"));
  if (!element || shape.empty()) refuse_array(name, header);
  layout.count = shape[0];
  layout.swapped = element->big_endian != (std::endian::native == std::endian::big);
  const bool structured = !element->names.empty();
  if (structured && shape.size() == 1) return open_structures(std::move(layout), *element, choice);
  if (structured || shape.size() != 2 || shape[1] < 3 || shape[1] > 1024) refuse_array(name, header);
  if (value_of(header, "fortran_order").starts_with("True")) {
    if (layout.count > (std::uint64_t{1} << 60) / 1024 / element->bytes)
      throw Error(ErrorKind::bad_input, fmt::format("{}: says it has {} rows", name, layout.count));
    layout.column_bytes = layout.count * element->bytes;
  }
  return open_rows(std::move(layout), *element, shape[1], choice);
}

}  // namespace wheatstone
