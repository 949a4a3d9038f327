#pragma once

// The references to all members of a plain struct, one function for each number of members: C++20 has no shorter way.

#include <cstddef>
#include <tuple>
#include <type_traits>

namespace wheatstone::fields_internal {

inline constexpr std::size_t most_fields = 32;

/// Stands for a value of any type where only types count.
struct AnyValue {
  template <class Value>
  operator Value() const;
};

template <class S>
auto tie_fields(S& /*empty*/, std::integral_constant<std::size_t, 0>) {
  return std::tuple<>();
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 1>) {
  auto& [f1] = s;
  return std::tie(f1);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 2>) {
  auto& [f1, f2] = s;
  return std::tie(f1, f2);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 3>) {
  auto& [f1, f2, f3] = s;
  return std::tie(f1, f2, f3);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 4>) {
  auto& [f1, f2, f3, f4] = s;
  return std::tie(f1, f2, f3, f4);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 5>) {
  auto& [f1, f2, f3, f4, f5] = s;
  return std::tie(f1, f2, f3, f4, f5);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 6>) {
  auto& [f1, f2, f3, f4, f5, f6] = s;
  return std::tie(f1, f2, f3, f4, f5, f6);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 7>) {
  auto& [f1, f2, f3, f4, f5, f6, f7] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 8>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 9>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 10>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 11>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 12>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 13>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 14>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 15>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 16>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 17>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 18>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 19>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 20>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 21>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 22>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 23>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22,
                  f23);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 24>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23,
         f24] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22,
                  f23, f24);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 25>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23, f24,
         f25] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22,
                  f23, f24, f25);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 26>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23, f24,
         f25, f26] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22,
                  f23, f24, f25, f26);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 27>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23, f24,
         f25, f26, f27] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22,
                  f23, f24, f25, f26, f27);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 28>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23, f24,
         f25, f26, f27, f28] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22,
                  f23, f24, f25, f26, f27, f28);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 29>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23, f24,
         f25, f26, f27, f28, f29] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22,
                  f23, f24, f25, f26, f27, f28, f29);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 30>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23, f24,
         f25, f26, f27, f28, f29, f30] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22,
                  f23, f24, f25, f26, f27, f28, f29, f30);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 31>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23, f24,
         f25, f26, f27, f28, f29, f30, f31] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22,
                  f23, f24, f25, f26, f27, f28, f29, f30, f31);
}
template <class S>
auto tie_fields(S& s, std::integral_constant<std::size_t, 32>) {
  auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23, f24,
         f25, f26, f27, f28, f29, f30, f31, f32] = s;
  return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22,
                  f23, f24, f25, f26, f27, f28, f29, f30, f31, f32);
}

}  // namespace wheatstone::fields_internal
