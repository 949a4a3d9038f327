#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace wheatstone {

namespace fields_internal {

inline constexpr std::size_t most_fields = 32;

/// Stands for a value of any type where only types count.
struct AnyValue {
  template <class Value>
  operator Value() const;
};

template <class S, std::size_t... I>
constexpr bool takes(std::index_sequence<I...> /*values*/) {
  return requires { S{(static_cast<void>(I), AnyValue{})...}; };
}

template <class S, std::size_t N = most_fields + 1>
constexpr std::size_t count_fields() {
  if constexpr (N == 0 || takes<S>(std::make_index_sequence<N>())) {
    return N;
  } else {
    return count_fields<S, N - 1>();
  }
}

// References to all members of a plain struct: C++20 needs a function for each number of members.
template <class S>
std::tuple<> tie_fields(S& /*empty*/, std::integral_constant<std::size_t, 0> /*count*/) {
  return {};
}
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): names cannot be counted by a template
#define WHEATSTONE_TIE(count, ...)                                              \
  template <class S>                                                            \
  auto tie_fields(S& s, std::integral_constant<std::size_t, count> /*count*/) { \
    auto& [__VA_ARGS__] = s;                                                    \
    return std::tie(__VA_ARGS__);                                               \
  }
// clang-format off
WHEATSTONE_TIE(1, a)
WHEATSTONE_TIE(2, a, b)
WHEATSTONE_TIE(3, a, b, c)
WHEATSTONE_TIE(4, a, b, c, d)
WHEATSTONE_TIE(5, a, b, c, d, e)
WHEATSTONE_TIE(6, a, b, c, d, e, f)
WHEATSTONE_TIE(7, a, b, c, d, e, f, g)
WHEATSTONE_TIE(8, a, b, c, d, e, f, g, h)
WHEATSTONE_TIE(9, a, b, c, d, e, f, g, h, i)
WHEATSTONE_TIE(10, a, b, c, d, e, f, g, h, i, j)
WHEATSTONE_TIE(11, a, b, c, d, e, f, g, h, i, j, k)
WHEATSTONE_TIE(12, a, b, c, d, e, f, g, h, i, j, k, l)
WHEATSTONE_TIE(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
WHEATSTONE_TIE(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
WHEATSTONE_TIE(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
WHEATSTONE_TIE(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
WHEATSTONE_TIE(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
WHEATSTONE_TIE(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
WHEATSTONE_TIE(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t)
WHEATSTONE_TIE(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u)
WHEATSTONE_TIE(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v)
WHEATSTONE_TIE(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w)
WHEATSTONE_TIE(23, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x)
WHEATSTONE_TIE(24, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x, y)
WHEATSTONE_TIE(25, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x, y, z)
WHEATSTONE_TIE(26, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x, y, z, aa)
WHEATSTONE_TIE(27, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x, y, z, aa, ab)
WHEATSTONE_TIE(28, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x, y, z, aa, ab, ac)
WHEATSTONE_TIE(29, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x, y, z, aa, ab, ac, ad)
WHEATSTONE_TIE(30, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x, y, z, aa, ab, ac, ad, ae)
WHEATSTONE_TIE(31, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x, y, z, aa, ab, ac, ad, ae, af)
WHEATSTONE_TIE(32, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x, y, z, aa, ab, ac, ad, ae, af, ag)
// clang-format on
#undef WHEATSTONE_TIE

template <class Value>
struct IsOptional : std::false_type {};
template <class Value>
struct IsOptional<std::optional<Value>> : std::true_type {};
template <class Value>
struct IsVector : std::false_type {};
template <class Value>
struct IsVector<std::vector<Value>> : std::true_type {};
template <class Value>
struct IsArray : std::false_type {};
template <class Value, std::size_t count>
struct IsArray<std::array<Value, count>> : std::true_type {};

}  // namespace fields_internal

/// How many members a plain struct (an aggregate without base classes and without C arrays) has.
template <class S>
constexpr std::size_t field_count() {
  static_assert(std::is_aggregate_v<S>);
  constexpr std::size_t count = fields_internal::count_fields<S>();
  static_assert(count <= fields_internal::most_fields, "more members than tie_fields knows");
  return count;
}

/// References to all members of a plain struct, in the order in which they are declared.
template <class S>
auto fields_of(S& record) {
  return fields_internal::tie_fields(record,
                                     std::integral_constant<std::size_t, field_count<std::remove_const_t<S>>()>());
}

/// Calls `visit` with a reference to every member of a plain struct, in the order in which they are declared.
template <class S, class Visit>
void for_each_field(S& record, Visit&& visit) {
  std::apply([&](auto&... fields) { (visit(fields), ...); }, fields_of(record));
}

/// Appends every value in a record of options to `text`, through all structs in it, so that records differ exactly
/// where their texts do. A member of a kind that has no text does not compile: nothing is left out silently.
template <class Value>
void append_fields(std::string& text, const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    append_fields(text, static_cast<std::underlying_type_t<Value>>(value));
  } else if constexpr (std::is_same_v<Value, bool>) {
    text += value ? "true " : "false ";
  } else if constexpr (std::is_arithmetic_v<Value>) {
    std::array<char, 32> digits;  // the shortest that are read back as the same number
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
    text += ' ';
  } else if constexpr (std::is_same_v<Value, std::filesystem::path>) {
    append_fields(text, value.string());
  } else if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
    const std::string_view characters = value;
    // With its length: "a" and "b c" are not "a b" and "c".
    text.append(std::to_string(characters.size())).append(":").append(characters).append(" ");
  } else if constexpr (fields_internal::IsOptional<Value>::value) {
    text += value ? "is " : "none ";
    if (value) append_fields(text, *value);
  } else if constexpr (fields_internal::IsVector<Value>::value) {
    text.append(std::to_string(value.size())).append(" of ");
    for (const auto& one : value) append_fields(text, one);
  } else {
    for_each_field(value, [&text](const auto& field) { append_fields(text, field); });
  }
}

template <class Record>
std::string text_of_fields(const Record& record) {
  std::string text;
  append_fields(text, record);
  return text;
}

}  // namespace wheatstone
