// NumPy's .npy, versions 1 and 2: an array of N×3 numbers, or more columns.

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <fstream>
#include <optional>

#include "wheatstone/error.h"
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
      {"f4", NumberType::f32}, {"f8", NumberType::f64}, {"i1", NumberType::i8},  {"u1", NumberType::u8},
      {"i2", NumberType::i16}, {"u2", NumberType::u16}, {"i4", NumberType::i32}, {"u4", NumberType::u32},
      {"i8", NumberType::i64}, {"u8", NumberType::u64}};
  for (const auto& [name, type] : types)
    if (code == name) return type;
  return std::nullopt;
}

/// The two sizes of "(N, k)".
bool parse_shape(std::string_view text, std::uint64_t& rows, std::uint64_t& columns) {
  if (!text.starts_with('(')) return false;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data() + 1, end, rows);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != ',') return false;
  const char* at = first.ptr + 1;
  while (at != end && *at == ' ') ++at;
  const auto second = std::from_chars(at, end, columns);
  return second.ec == std::errc{} && second.ptr != end && *second.ptr == ')';
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

}  // namespace

CloudSource open_npy(const std::filesystem::path& path, const CloudChoice& choice) {
  RecordLayout layout{.path = path};
  const std::string header = read_header(path, layout.begin);
  const std::string name = path.string();
  const std::string_view type_text = value_of(header, "descr");
  const bool simple = type_text.size() > 4 && type_text[0] == '\'';
  const std::optional<NumberType> type = simple ? type_of(type_text.substr(2, 2)) : std::nullopt;
  if (!type)
    throw Error(ErrorKind::bad_input, fmt::format("{}: its numbers are of type {}, expected floats or integers", name,
                                                  type_text.substr(0, std::min<std::size_t>(type_text.find(','), 60))));
  std::uint64_t columns = 0;
  if (!parse_shape(value_of(header, "shape"), layout.count, columns) || columns < 3 || columns > 1024)
    throw Error(ErrorKind::bad_input, fmt::format("{}: is not N rows of three numbers or more", name));
  const bool little = type_text[1] != '>';
  layout.swapped = little != (std::endian::native == std::endian::little);
  const bool by_column = value_of(header, "fortran_order").starts_with("True");
  const std::size_t width = bytes_of(*type);
  layout.record_bytes = by_column ? width : width * columns;
  if (by_column) {
    if (layout.count > (std::uint64_t{1} << 60) / 1024 / width)
      throw Error(ErrorKind::bad_input, fmt::format("{}: says it has {} rows", name, layout.count));
    layout.column_bytes = layout.count * width;
  }
  const auto field = [&](std::uint64_t column) {
    return RecordField{.at = static_cast<std::size_t>(by_column ? column : column * width), .type = *type};
  };
  for (std::size_t axis = 0; axis < 3; ++axis) layout.position[axis] = field(axis);
  if (const auto column = column_given(choice.density, columns, name)) layout.density = field(*column);
  if (const auto column = column_given(choice.temperature, columns, name)) layout.temperature = field(*column);
  if (const auto column = column_given(choice.smoothing_length, columns, name))
    layout.smoothing_length = field(*column);
  std::vector<std::string> fields;
  for (std::uint64_t column = 0; column < columns; ++column) fields.push_back(std::to_string(column));
  return open_records(layout, "NumPy", std::move(fields));
}

}  // namespace wheatstone
