#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/error.h"
#include "wheatstone/files/deflate.h"
#include "wheatstone/files/field_bytes.h"

namespace wheatstone {

template <>
inline constexpr bool is_number<ViewPosition> = true;

/// A file of a value's fields, for one version of the program: eight letters that say what it is, the CRC-32 of all
/// that follows, layout_of<Value>(), and the members.
struct FieldFile {
  std::string_view magic;
  std::string_view advice;  ///< what to do with a damaged file, as "delete its folder to start again"
};

inline std::string field_file_head(const FieldFile& file, std::string_view content) {
  FieldWriter head{std::string(file.magic)};
  head(crc32_of(content));
  return std::move(head.bytes);
}

/// Puts the head before the members' bytes.
template <class Value>
std::string field_file_of_members(const FieldFile& file, std::string_view members) {
  FieldWriter content;
  content(layout_of<Value>());
  content.bytes += members;
  return field_file_head(file, content.bytes) + content.bytes;
}

template <class Value>
std::string encode_field_file(const FieldFile& file, const Value& value) {
  FieldWriter members;
  members(value);
  return field_file_of_members<Value>(file, members.bytes);
}

/// Reads it back, and calls `check` with the value and the reader, whose `expect` throws. Throws Error{bad_input} with
/// `name` in front where the file is damaged or another version has written it.
template <class Value, class Check>
Value decode_field_file(const FieldFile& file, std::string_view bytes, std::string_view name, Check check) {
  const std::size_t head_bytes = file.magic.size() + sizeof(std::uint32_t);
  const std::string_view content = bytes.substr(std::min(bytes.size(), head_bytes));
  FieldReader reader(content, fmt::format("{}: is damaged, {}", name, file.advice));
  reader.expect(bytes.substr(0, head_bytes) == field_file_head(file, content));
  std::uint32_t layout = 0;
  reader(layout);
  if (layout != layout_of<Value>())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: was written by another version of Wheatstone; continue with that version, or {}", name,
                            file.advice));
  Value value;
  reader(value);
  reader.expect_end();
  check(value, reader);
  return value;
}

}  // namespace wheatstone
