#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "wheatstone/struct_ties_internal.h"

namespace wheatstone {

namespace fields_internal {

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

template <class Value>
struct IsOptional : std::false_type {};
template <class Value>
struct IsOptional<std::optional<Value>> : std::true_type {};
template <class Value>
struct IsVector : std::false_type {};
template <class Value>
struct IsVector<std::vector<Value>> : std::true_type {};

}  // namespace fields_internal

/// How many members a plain struct (an aggregate without base classes and without C arrays) has.
template <class S>
constexpr std::size_t field_count() {
  static_assert(std::is_aggregate_v<S>);
  constexpr std::size_t count = fields_internal::count_fields<S>();
  static_assert(count <= fields_internal::most_fields, "more members than tie_fields knows");
  return count;
}

/// Calls `visit` with a reference to every member of a plain struct, in the order in which they are declared.
template <class S, class Visit>
void for_each_field(S& record, Visit&& visit) {
  std::apply([&](auto&... fields) { (visit(fields), ...); },
             fields_internal::tie_fields(record,
                                         std::integral_constant<std::size_t, field_count<std::remove_const_t<S>>()>()));
}

/// Appends every value in a record of options to `text`, through all structs in it, so that records differ exactly
/// where their texts do. A member of a kind that has no text does not compile: nothing is left out silently.
template <class Value>
void append_fields(std::string& text, const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    append_fields(text, static_cast<std::underlying_type_t<Value>>(value));
  } else if constexpr (std::is_arithmetic_v<Value>) {
    text += fmt::format("{} ", value);
  } else if constexpr (std::is_same_v<Value, std::filesystem::path>) {
    append_fields(text, value.string());
  } else if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
    const std::string_view characters = value;
    // With its length: "a" and "b c" are not "a b" and "c".
    text += fmt::format("{}:{} ", characters.size(), characters);
  } else if constexpr (fields_internal::IsOptional<Value>::value) {
    text += value ? "is " : "none ";
    if (value) append_fields(text, *value);
  } else if constexpr (fields_internal::IsVector<Value>::value) {
    text += fmt::format("{} of ", value.size());
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
