#pragma once

namespace wheatstone {

/// Temperature in kelvin of a gas whose internal energy a unit of mass is given in (km/s)², GADGET's unit:
/// T = (γ − 1)·u·μ·m_p / k, γ = 5/3. The mean molecular weight μ is that of a fully ionised gas of three quarters
/// hydrogen, 0.588; or, of the electrons for each hydrogen nucleus, 4 / (1 + 3X + 4X·electrons) with X = 0.76.
constexpr float mean_molecular_weight_ionised = 0.588f;
constexpr float kelvin_a_unit = 80.765f;  // (γ − 1)·m_p·(1 km/s)² / k

constexpr float gas_temperature(float internal_energy) {
  return internal_energy * kelvin_a_unit * mean_molecular_weight_ionised;
}
constexpr float gas_temperature(float internal_energy, float electrons) {
  constexpr float hydrogen = 0.76f;
  return internal_energy * kelvin_a_unit * 4 / (1 + 3 * hydrogen + 4 * hydrogen * electrons);
}
constexpr float gas_internal_energy(float temperature) {
  return temperature / (kelvin_a_unit * mean_molecular_weight_ionised);
}

}  // namespace wheatstone
