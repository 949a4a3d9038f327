#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "wheatstone/particles/cloud_source.h"

namespace wheatstone {

enum class NumberType { i8, u8, i16, u16, i32, u32, i64, u64, f16, f32, f64 };

std::size_t bytes_of(NumberType type);

/// The number that stands at `from`, in this machine's byte order or the other.
double decode_number(const char* from, NumberType type, bool swapped);

/// A number within a record; in the cloud it becomes value · scale + offset.
struct RecordField {
  std::size_t at = 0;  ///< bytes from the record's begin
  NumberType type = NumberType::f32;
  double scale = 1;
  double offset = 0;

  bool is_single_precision() const {
    return (type == NumberType::f16 || type == NumberType::f32) && scale == 1 && offset == 0;
  }
};

/// Particles as records of one size, one after the other, or column after column.
struct RecordLayout {
  std::filesystem::path path;
  std::uint64_t begin = 0;  ///< of the first record in the file, in bytes
  std::size_t record_bytes = 0;
  std::uint64_t count = 0;
  bool swapped = false;            ///< the other byte order than this machine's
  std::uint64_t column_bytes = 0;  ///< not 0: columns of so many bytes each; a field's `at` is its column's number
  std::array<RecordField, 3> position;
  std::optional<RecordField> density, temperature, smoothing_length, mass, quantity;
  std::vector<std::optional<RecordField>> named;  ///< of CloudChoice::where; nothing where the file has no such field
  std::optional<std::array<RecordField, 3>> colour;  ///< 0..255 after scaling
};

/// Checks that the file is as long as its header says, and gives its particles. `format` and `fields` are for people;
/// of the choice, the origin and the condition count.
/// Throws Error{bad_input}.
CloudSource open_records(const RecordLayout& layout, const std::string& format, std::vector<std::string> fields,
                         const CloudChoice& choice);

}  // namespace wheatstone
