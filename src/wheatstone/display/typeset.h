#pragma once

#include <string>
#include <string_view>

namespace wheatstone {

/// A power of ten as it is printed: "10⁻³".
std::string power_of_ten(int exponent);

/// A unit as it is printed, times a power of ten: of "1e10*Msun/kpc**2", "10¹⁰ M☉ kpc⁻²". The unit is written as
/// unit_expression (particles/unit_expression.h) writes it, also with ^ for powers or without a sign, as "cm-3"; what
/// is not a product of powers stays as it is.
std::string typeset_unit(std::string_view unit, int exponent = 0);

}  // namespace wheatstone
