#pragma once

#include <string>
#include <string_view>

namespace wheatstone {

/// A unit that a file tells, in the words that Python's unyt and astropy.units parse: "1.989e+43 g (1e10 Msun)" is
/// "1e10*Msun", "erg cm^-3" is "erg*cm**-3", "code length" is "code_length". A unit that counts in the expansion factor
/// or in Hubble's constant (a, h) stays as it is told, because both would read these letters as units of time; so does
/// text that is no unit.
std::string unit_expression(std::string_view told);

/// That of a column density: mass by the square of length, both as above. Empty where one of them is.
std::string column_unit(std::string_view mass, std::string_view length);

}  // namespace wheatstone
