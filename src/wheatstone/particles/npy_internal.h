#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/particles/records_internal.h"

namespace wheatstone {

/// Arrays with more numbers a row are refused.
inline constexpr std::uint64_t most_columns = 1024;

/// An array's numbers: of one type, or records of named ones.
struct NpyElement {
  bool swapped = false;  ///< the other byte order than this machine's
  std::size_t bytes = 0;
  std::vector<std::string> names;  ///< of a record's numbers; empty where the array's are of one type
  std::vector<RecordField> fields;
};

/// What a .npy file says of its array.
struct NpyHeader {
  std::uint64_t bytes = 0;            ///< of the header: the numbers begin behind it
  std::optional<NpyElement> element;  ///< nothing where it is none that can be read
  std::vector<std::uint64_t> shape;   ///< empty where it is none
  bool by_column = false;
  std::string type_words, shape_words;  ///< as the header has them, for messages
};

/// As many of a file's first bytes as its header takes at most.
constexpr std::size_t most_npy_header_bytes = 12 + (1 << 16);

/// The header in an array's first bytes, versions 1 to 3. Throws Error{bad_input}, beginning with `name`, where it is
/// damaged or cut short.
NpyHeader parse_npy_header(std::string_view first_bytes, const std::string& name);

/// Throws Error{bad_input}: the array is none of particles.
[[noreturn]] void refuse_npy(const NpyHeader& header, const std::string& name);

}  // namespace wheatstone
