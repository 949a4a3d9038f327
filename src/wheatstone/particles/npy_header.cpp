#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/particles/npy_internal.h"

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

/// Adds a number of a code as "<f4". False for what is no plain number, or has another byte order than the others.
bool add_number(const std::string& code, const std::string& name, NpyElement& element) {
  if (code.size() < 3) return false;
  if (name.empty() && code[1] == 'V') {  // padding
    std::size_t bytes = 0;
    std::from_chars(code.data() + 2, code.data() + code.size(), bytes);
    element.bytes += bytes;
    return bytes > 0 && bytes < longest_header;
  }
  const std::optional<NumberType> type = type_of(std::string_view(code).substr(1));
  if (!type) return false;
  const bool swapped = (code[0] == '>') != (std::endian::native == std::endian::big);
  const bool first = element.fields.empty();
  if (first) element.swapped = swapped;
  if (bytes_of(*type) > 1 && swapped != element.swapped && !first) return false;
  element.fields.push_back({.at = element.bytes, .type = *type});
  element.names.push_back(name);
  element.bytes += bytes_of(*type);
  return true;
}

/// "'<f4'", or "[('x', '<f4'), ('y', '<f4'), …]". Nothing for anything else.
std::optional<NpyElement> parse_type(std::string_view text) {
  NpyElement element;
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

/// A value ends before the comma in front of the next key.
std::string shown(std::string_view header, std::string_view key) {
  const std::string_view value = value_of(header, key);
  return std::string(value.substr(0, std::min({value.find(", 'fortran_order'"), value.find(", 'shape'"),
                                               value.find(", }"), value.find('}'), std::size_t{100}})));
}

}  // namespace

NpyHeader parse_npy_header(std::string_view first_bytes, const std::string& name) {
  const auto byte = [&](std::size_t at) {
    return at < first_bytes.size() ? std::size_t{static_cast<unsigned char>(first_bytes[at])} : 0;
  };
  const bool long_length = byte(6) >= 2;
  const std::size_t length = byte(8) + 256 * byte(9) + (long_length ? 65536 * byte(10) + 16777216 * byte(11) : 0);
  const std::size_t begin = long_length ? 12 : 10;
  if (length > longest_header || first_bytes.size() < begin + length)
    throw Error(ErrorKind::bad_input, fmt::format("{}: its NumPy header is damaged or cut short", name));
  const std::string_view text = first_bytes.substr(begin, length);
  return {.bytes = begin + length,
          .element = parse_type(value_of(text, "descr")),
          .shape = parse_shape(value_of(text, "shape")),
          .by_column = value_of(text, "fortran_order").starts_with("True"),
          .type_words = shown(text, "descr"),
          .shape_words = shown(text, "shape")};
}

void refuse_npy(const NpyHeader& header, const std::string& name) {
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: is an array of type {} and shape {}, expected rows of three numbers or more, or records "
                          "with numbers x, y and z; numbers may be f2, f4, f8, i1 to i8 and u1 to u8",
                          name, header.type_words, header.shape_words));
}

}  // namespace wheatstone
