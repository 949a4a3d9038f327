#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>

#include "wheatstone/error.h"
#include "wheatstone/particles/particle_rows_internal.h"
#include "wheatstone/particles/records_internal.h"

namespace wheatstone {
namespace {

template <class Number>
double decode(const char* from, bool swapped) {
  std::array<char, sizeof(Number)> bytes;
  std::memcpy(bytes.data(), from, sizeof(Number));
  if (swapped) std::ranges::reverse(bytes);
  return static_cast<double>(std::bit_cast<Number>(bytes));
}

/// A number of IEEE 754's binary16.
double half_value(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
  const double size = exponent == 0    ? std::ldexp(mantissa, -24)
                      : exponent == 31 ? (mantissa == 0 ? std::numeric_limits<double>::infinity()
                                                        : std::numeric_limits<double>::quiet_NaN())
                                       : std::ldexp(1024 + mantissa, exponent - 25);
  return bits >> 15 != 0 ? -size : size;
}

}  // namespace

double decode_number(const char* from, NumberType type, bool swapped) {
  switch (type) {
    case NumberType::i8:
      return decode<std::int8_t>(from, swapped);
    case NumberType::u8:
      return decode<std::uint8_t>(from, swapped);
    case NumberType::i16:
      return decode<std::int16_t>(from, swapped);
    case NumberType::u16:
      return decode<std::uint16_t>(from, swapped);
    case NumberType::i32:
      return decode<std::int32_t>(from, swapped);
    case NumberType::u32:
      return decode<std::uint32_t>(from, swapped);
    case NumberType::i64:
      return decode<std::int64_t>(from, swapped);
    case NumberType::u64:
      return decode<std::uint64_t>(from, swapped);
    case NumberType::f16:
      return half_value(static_cast<std::uint16_t>(decode<std::uint16_t>(from, swapped)));
    case NumberType::f32:
      return decode<float>(from, swapped);
    default:
      return decode<double>(from, swapped);
  }
}

namespace {

/// Some records in memory, and where each field of the first lies.
struct Chunk {
  const RecordLayout& layout;
  const std::vector<char>& bytes;
  std::size_t count;

  double value(const RecordField& field, std::size_t record) const {
    const std::size_t at = layout.column_bytes > 0 ? (field.at * count + record) * layout.record_bytes
                                                   : record * layout.record_bytes + field.at;
    return decode_number(bytes.data() + at, field.type, layout.swapped) * field.scale + field.offset;
  }
  void put(const std::optional<RecordField>& field, std::vector<float>& column) const {
    if (!field) return;
    column.resize(count);
    for (std::size_t i = 0; i < count; ++i) column[i] = in_single_precision(value(*field, i));
  }
  QuantityColumn named(const std::optional<RecordField>& field) const {
    if (!field) return {};
    QuantityColumn column{std::vector<double>(count), field->is_single_precision()};
    for (std::size_t i = 0; i < count; ++i) column.values[i] = value(*field, i);
    return column;
  }
};

ParticleRows rows_of(const Chunk& chunk) {
  const RecordLayout& layout = chunk.layout;
  ParticleRows rows;
  const std::array<std::vector<double>*, 3> axes{&rows.x, &rows.y, &rows.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    axes[axis]->resize(chunk.count);
    for (std::size_t i = 0; i < chunk.count; ++i) (*axes[axis])[i] = chunk.value(layout.position[axis], i);
  }
  Cloud& cloud = rows.others;
  chunk.put(layout.density, cloud.density);
  chunk.put(layout.temperature, cloud.temperature);
  chunk.put(layout.smoothing_length, cloud.smoothing_length);
  chunk.put(layout.mass, cloud.mass);
  chunk.put(layout.quantity, cloud.quantity);
  for (const std::optional<RecordField>& field : layout.named) rows.named.push_back(chunk.named(field));
  if (layout.colour) {
    const auto byte = [&](const RecordField& field, std::size_t i) {
      const double value = chunk.value(field, i);
      return static_cast<std::uint8_t>(value > 0 ? std::min(value, 255.) : 0.);
    };
    cloud.colour.resize(chunk.count);
    for (std::size_t i = 0; i < chunk.count; ++i)
      cloud.colour[i] = {byte((*layout.colour)[0], i), byte((*layout.colour)[1], i), byte((*layout.colour)[2], i)};
  }
  return rows;
}

struct RecordRows {
  RecordLayout layout;
  std::ifstream file;
  std::uint64_t at = 0;
  std::vector<char> bytes;

  void read(std::uint64_t from, std::size_t count, std::size_t to) {
    file.seekg(static_cast<std::streamoff>(from));
    file.read(bytes.data() + to, static_cast<std::streamsize>(count));
    if (!file) throw Error(ErrorKind::bad_input, fmt::format("{}: is cut short", layout.path.string()));
  }
};

std::size_t columns_of(const RecordLayout& layout) {
  std::size_t most = 0;
  const auto note = [&](const RecordField& field) { most = std::max(most, field.at + 1); };
  for (const RecordField& field : layout.position) note(field);
  for (const auto* field :
       {&layout.density, &layout.temperature, &layout.smoothing_length, &layout.mass, &layout.quantity})
    if (*field) note(**field);
  for (const std::optional<RecordField>& field : layout.named)
    if (field) note(*field);
  return most;
}

ParticleRows read_some(RecordRows& reading, std::size_t most) {
  const RecordLayout& layout = reading.layout;
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(most, layout.count - reading.at));
  if (count == 0) return {};
  const std::size_t length = count * layout.record_bytes;
  if (layout.column_bytes > 0) {
    const std::size_t columns = columns_of(layout);
    reading.bytes.resize(columns * length);
    for (std::size_t column = 0; column < columns; ++column)
      reading.read(layout.begin + column * layout.column_bytes + reading.at * layout.record_bytes, length,
                   column * length);
  } else {
    reading.bytes.resize(length);
    reading.read(layout.begin + reading.at * layout.record_bytes, length, 0);
  }
  reading.at += count;
  return rows_of({layout, reading.bytes, count});
}

}  // namespace

std::size_t bytes_of(NumberType type) {
  switch (type) {
    case NumberType::i8:
    case NumberType::u8:
      return 1;
    case NumberType::i16:
    case NumberType::u16:
    case NumberType::f16:
      return 2;
    case NumberType::i32:
    case NumberType::u32:
    case NumberType::f32:
      return 4;
    default:
      return 8;
  }
}

CloudSource open_records(const RecordLayout& layout, const std::string& format, std::vector<std::string> fields,
                         const CloudChoice& choice) {
  const std::uint64_t length = std::filesystem::file_size(layout.path);
  const std::string name = layout.path.string();
  if (layout.count == 0) throw Error(ErrorKind::bad_input, fmt::format("{}: has no particles", name));
  const std::uint64_t room = layout.begin < length ? length - layout.begin : 0;
  const std::uint64_t a_particle =
      layout.column_bytes > 0 ? layout.record_bytes * columns_of(layout) : layout.record_bytes;
  if (layout.record_bytes == 0 || layout.count > room / a_particle)
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{}: is cut short or damaged: its header says {} particles of {} bytes, but there are {} bytes",
                    name, layout.count, a_particle, room));
  auto reading = std::make_shared<RecordRows>();
  reading->layout = layout;
  reading->file.open(layout.path, std::ios::binary);
  CloudSource source{.format = format, .count = layout.count, .fields = std::move(fields)};
  source.bytes = length;
  give_rows([reading](std::size_t most, ParticleRows& rows) { rows = read_some(*reading, most); }, layout.path, choice,
            source);
  source.skip = [reading](std::size_t most) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(most, reading->layout.count - reading->at));
    reading->at += count;
    return count;
  };
  return source;
}

}  // namespace wheatstone
