#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

#include "wheatstone/error.h"
#include "wheatstone/files/struct_fields.h"

namespace wheatstone {

// Values as bytes for this program on this machine, member by member in the order of their declaration, exactly to the
// bit: numbers, enumerators, strings, paths, images, structs, and optionals, vectors and arrays of these. One visitor
// writes and reads.

/// A class whose bytes are its value, such as one that wraps a number. Specialise it for such a class.
template <class Value>
inline constexpr bool is_number =
    (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>) || std::is_enum_v<Value>;

namespace fields_internal {

template <class Value>
concept IsImage = requires(Value image) {
  image.pixels();
  image.width();
  Value(1, 1);
};

template <class Value>
constexpr bool is_packed();

template <class... Fields>
constexpr bool are_packed(const std::tuple<Fields&...>* /*types*/, std::size_t bytes) {
  return (is_packed<std::remove_const_t<Fields>>() && ...) && (sizeof(Fields) + ... + 0) == bytes;
}

/// Numbers, and structs of nothing but numbers without gaps: they are copied at once.
template <class Value>
constexpr bool is_packed() {
  if constexpr (is_number<Value>) {
    return true;
  } else if constexpr (IsArray<Value>::value) {
    return is_packed<typename Value::value_type>();
  } else if constexpr (std::is_aggregate_v<Value> && std::is_trivially_copyable_v<Value>) {
    return are_packed(static_cast<decltype(fields_of(std::declval<Value&>()))*>(nullptr), sizeof(Value));
  } else {
    return false;
  }
}

}  // namespace fields_internal

class FieldWriter {
 public:
  void operator()(const auto& value) { visit(*this, value); }
  std::string bytes;

 private:
  template <class Archive, class Value>
  friend void visit(Archive& archive, Value& value);

  void copy(const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); }
  template <class Sized>
  void resize(const Sized& values) {
    const std::uint64_t count = values.size();
    copy(&count, sizeof(count));
  }
  template <class Image>
  void resize_image(const Image& image) {
    const std::array<std::int32_t, 2> size{image.width(), image.height()};
    copy(size.data(), sizeof(size));
  }
  bool flag(bool set) {
    bytes += static_cast<char>(set);
    return set;
  }
};

/// Throws Error{bad_input} with `damaged` where the bytes are not those of such a value.
class FieldReader {
 public:
  FieldReader(std::string_view bytes, std::string damaged) : rest_(bytes), damaged_(std::move(damaged)) {}

  void operator()(auto& value) { visit(*this, value); }

  void expect(bool holds) const {
    if (!holds) throw Error(ErrorKind::bad_input, damaged_);
  }
  void expect_end() const { expect(rest_.empty()); }

 private:
  template <class Archive, class Value>
  friend void visit(Archive& archive, Value& value);

  void copy(void* to, std::size_t size) {
    expect(size <= rest_.size());
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  template <class Sized>
  void resize(Sized& values) {
    using Value = typename Sized::value_type;
    std::uint64_t count = 0;
    copy(&count, sizeof(count));
    // Every value has a byte at least: a wrong count takes no memory to speak of.
    expect(count <= rest_.size() / (fields_internal::is_packed<Value>() ? sizeof(Value) : 1));
    values.resize(count);
  }
  template <class Image>
  void resize_image(Image& image) {
    std::array<std::int32_t, 2> size{};
    copy(size.data(), sizeof(size));
    const auto [width, height] = size;
    expect(width >= 0 && height >= 0 && (width > 0) == (height > 0));
    expect(std::uint64_t(width) * std::uint64_t(height) <= rest_.size() / sizeof(image.pixels()[0]));
    image = width > 0 ? Image(width, height) : Image();
  }
  bool flag(bool /*unknown*/) {
    char set = 0;
    copy(&set, 1);
    expect(set == 0 || set == 1);
    return set == 1;
  }

  std::string_view rest_;
  std::string damaged_;
};

/// The one order in which a value's parts are written and read.
template <class Archive, class Value>
void visit(Archive& archive, Value& value) {
  using Plain = std::remove_const_t<Value>;
  if constexpr (fields_internal::is_packed<Plain>()) {
    archive.copy(&value, sizeof(value));
  } else if constexpr (std::is_same_v<Plain, bool>) {
    const bool set = archive.flag(value);
    if constexpr (!std::is_const_v<Value>) value = set;
  } else if constexpr (fields_internal::IsOptional<Plain>::value) {
    const bool set = archive.flag(value.has_value());
    if constexpr (!std::is_const_v<Value>) {
      value.reset();
      if (set) value.emplace();
    }
    if (set) visit(archive, *value);
  } else if constexpr (std::is_same_v<Plain, std::filesystem::path>) {
    std::string name = value.string();
    visit(archive, name);
    if constexpr (!std::is_const_v<Value>) value = name;
  } else if constexpr (fields_internal::IsImage<Plain>) {
    static_assert(fields_internal::is_packed<std::remove_cvref_t<decltype(value.pixels()[0])>>());
    archive.resize_image(value);
    archive.copy(value.pixels().data(), value.pixels().size_bytes());
  } else if constexpr (fields_internal::IsVector<Plain>::value || std::is_same_v<Plain, std::string>) {
    archive.resize(value);
    if constexpr (fields_internal::is_packed<typename Plain::value_type>()) {
      archive.copy(value.data(), value.size() * sizeof(value[0]));
    } else {
      for (auto& one : value) visit(archive, one);
    }
  } else if constexpr (fields_internal::IsArray<Plain>::value) {
    for (auto& one : value) visit(archive, one);
  } else {
    for_each_field(value, [&archive](auto& field) { visit(archive, field); });
  }
}

/// Differs for types whose members differ in number, kind or order: bytes of one cannot be read as the other.
template <class Value>
constexpr std::uint32_t layout_of(std::uint32_t before = 2166136261u) {
  const auto mixed = [](std::uint32_t hash, std::size_t with) {
    return (hash ^ static_cast<std::uint32_t>(with)) * 16777619u;
  };
  if constexpr (is_number<Value> || std::is_same_v<Value, bool>) {
    return mixed(before, sizeof(Value) + (std::is_integral_v<Value> ? 16 : 32) + std::is_signed_v<Value> * 64);
  } else if constexpr (std::is_same_v<Value, std::filesystem::path>) {
    return layout_of<std::string>(mixed(before, 2));
  } else if constexpr (fields_internal::IsImage<Value>) {
    return layout_of<std::remove_cvref_t<decltype(std::declval<Value&>().pixels()[0])>>(mixed(before, 1));
  } else if constexpr (fields_internal::IsOptional<Value>::value || fields_internal::IsVector<Value>::value ||
                       fields_internal::IsArray<Value>::value || std::is_same_v<Value, std::string>) {
    return layout_of<typename Value::value_type>(mixed(before, sizeof(Value)));
  } else {
    const auto all = [&]<class... Fields>(const std::tuple<Fields&...>* /*types*/) {
      std::uint32_t hash = mixed(before, sizeof...(Fields));
      ((hash = layout_of<std::remove_const_t<Fields>>(hash)), ...);
      return hash;
    };
    return all(static_cast<decltype(fields_of(std::declval<Value&>()))*>(nullptr));
  }
}

}  // namespace wheatstone
