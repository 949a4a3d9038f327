// LAS 1.2 to 1.4 (ASPRS), point formats 0 to 10.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

#include "wheatstone/error.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"
#include "wheatstone/particles/records_internal.h"

namespace wheatstone {
namespace {

/// The header, whose numbers are little-endian at fixed places.
struct LasHeader {
  std::array<char, 375> bytes{};
  template <class Number>
  Number at(std::size_t offset) const {
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes.data() + offset, sizeof(Number));
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(raw);
    return std::bit_cast<Number>(raw);
  }
};

constexpr std::array<std::size_t, 11> shortest_record{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
constexpr std::array<int, 11> colour_at{-1, -1, 20, 28, -1, 28, -1, 30, 30, -1, 30};

LasHeader read_header(const std::filesystem::path& path) {
  LasHeader header;
  std::ifstream file(path, std::ios::binary);
  file.read(header.bytes.data(), header.bytes.size());
  constexpr std::streamsize shortest = 227;
  if (file.gcount() < shortest)
    throw Error(ErrorKind::bad_input, fmt::format("{}: is cut short, expected a LAS header", path.string()));
  return header;
}

/// Colours are said to be 16 bit, but many files hold 8: told by the first of them.
double colour_scale(const RecordLayout& layout, std::size_t at) {
  std::ifstream file(layout.path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(layout.begin));
  std::vector<char> record(layout.record_bytes);
  constexpr std::uint64_t looked_at = 10000;
  for (std::uint64_t i = 0; i < std::min(layout.count, looked_at); ++i) {
    if (!file.read(record.data(), static_cast<std::streamsize>(record.size()))) break;
    for (std::size_t channel = 0; channel < 3; ++channel)
      if (record[at + 2 * channel + 1] != 0) return 1. / 257;
  }
  return 1;
}

}  // namespace

CloudSource open_las(const std::filesystem::path& path, const CloudChoice& choice) {
  const LasHeader header = read_header(path);
  const std::string name = path.string();
  const int minor = header.at<std::uint8_t>(25);
  if (header.at<std::uint8_t>(24) != 1 || minor > 4)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is LAS {}.{}, expected 1.0 to 1.4", name, header.at<std::uint8_t>(24), minor));
  const unsigned format = header.at<std::uint8_t>(104);
  if ((format & 0xC0u) != 0)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is compressed (LAZ), expected LAS; the program laszip converts it", name));
  if (format >= shortest_record.size())
    throw Error(ErrorKind::bad_input, fmt::format("{}: has points of format {}, expected 0 to 10", name, format));

  RecordLayout layout{.path = path};
  layout.swapped = std::endian::native == std::endian::big;
  layout.begin = header.at<std::uint32_t>(96);
  layout.record_bytes = header.at<std::uint16_t>(105);
  layout.count = header.at<std::uint32_t>(107);
  if (minor >= 4 && header.at<std::uint16_t>(94) >= 375) layout.count = header.at<std::uint64_t>(247);
  if (layout.record_bytes < shortest_record[format])
    throw Error(ErrorKind::bad_input, fmt::format("{}: has points of {} bytes, expected at least {} for format {}",
                                                  name, layout.record_bytes, shortest_record[format], format));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto scale = header.at<double>(131 + 8 * axis);
    const auto offset = header.at<double>(155 + 8 * axis);
    if (!std::isfinite(scale) || !std::isfinite(offset) || scale == 0)
      throw Error(ErrorKind::bad_input, fmt::format("{}: its scale or offset is not a number", name));
    layout.position[axis] = {.at = 4 * axis, .type = NumberType::i32, .scale = scale, .offset = offset};
  }
  const RecordField intensity{.at = 12, .type = NumberType::u16};
  std::vector<std::string> fields{"x", "y", "z", "intensity"};
  std::vector<RecordField> as_stored(layout.position.begin(), layout.position.end());
  as_stored.push_back(intensity);
  for (const std::string& wanted :
       {choice.density, choice.temperature, choice.smoothing_length, choice.mass, choice.quantity})
    if (!wanted.empty() && wanted != "intensity")
      throw Error(ErrorKind::bad_input, fmt::format("{}: has no field '{}', but x, y, z, intensity", name, wanted));
  if (position_names(name, choice) != std::array<std::string, 3>{"x", "y", "z"})
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no positions '{}', but x,y,z", name, choice.position));
  if (!choice.density.empty()) layout.density = intensity;
  if (!choice.mass.empty()) layout.mass = intensity;
  if (!choice.quantity.empty()) layout.quantity = intensity;
  layout.temperature = intensity;
  if (colour_at[format] >= 0 && choice.temperature.empty()) {
    const auto at = static_cast<std::size_t>(colour_at[format]);
    const double scale = colour_scale(layout, at);
    layout.colour = {RecordField{at, NumberType::u16, scale}, RecordField{at + 2, NumberType::u16, scale},
                     RecordField{at + 4, NumberType::u16, scale}};
    fields.insert(fields.end(), {"red", "green", "blue"});
    for (const std::size_t channel : {0, 1, 2}) as_stored.push_back({at + 2 * channel, NumberType::u16});
  }
  for (const std::string& wanted : names_in_condition(choice)) {
    const int field = index_of_name(fields, wanted);
    layout.named.push_back(field < 0 ? std::nullopt : std::optional(as_stored[static_cast<std::size_t>(field)]));
  }
  return open_records(layout, fmt::format("LAS 1.{}", minor), std::move(fields), choice);
}

}  // namespace wheatstone
