#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "wheatstone/particles/hdf5_internal.h"
#include "wheatstone/particles/snapshot_internal.h"

namespace wheatstone {
namespace {

using Units = std::vector<std::pair<std::string, std::string>>;

/// A unit that people call by a name.
struct NamedUnit {
  double in_cgs;
  const char* name;
};
constexpr std::array lengths{
    NamedUnit{1, "cm"},           NamedUnit{1e5, "km"},          NamedUnit{1.495979e13, "au"},
    NamedUnit{3.085678e18, "pc"}, NamedUnit{3.085678e21, "kpc"}, NamedUnit{3.085678e24, "Mpc"}};
constexpr std::array masses{NamedUnit{1, "g"}, NamedUnit{1.989e33, "Msun"}, NamedUnit{1.989e43, "1e10 Msun"}};
constexpr std::array velocities{NamedUnit{1, "cm/s"}, NamedUnit{1e5, "km/s"}};

/// "3.08568e+21 cm (1 kpc)".
template <std::size_t count>
std::string with_name(double in_cgs, const char* cgs, const std::array<NamedUnit, count>& names) {
  std::string text = fmt::format("{:g} {}", in_cgs, cgs);
  for (const NamedUnit& unit : names)
    if (unit.in_cgs > 1 && std::abs(in_cgs / unit.in_cgs - 1) < 2e-3) text += fmt::format(" ({})", unit.name);
  return text;
}

/// " cm^-3"; nothing for an exponent of 0.
std::string power(const char* what, double exponent) {
  if (exponent == 0) return {};
  return exponent == 1 ? fmt::format(" {}", what) : fmt::format(" {}^{:g}", what, exponent);
}

/// A dataset's unit by its attributes: those of GADGET-4 and AREPO, or SWIFT's. Nothing where it has none.
std::optional<std::string> unit_of(hid_t dataset) {
  const auto number = [&](const char* name) { return hdf5_number(dataset, name); };
  std::optional<double> in_cgs = number("to_cgs");
  double length = number("length_scaling").value_or(0);
  double mass = number("mass_scaling").value_or(0);
  double time = 0;
  double expansion = number("a_scaling").value_or(0);
  double hubble = number("h_scaling").value_or(0);
  const double velocity = number("velocity_scaling").value_or(0);
  length += velocity;
  time -= velocity;
  if (!in_cgs) {
    in_cgs = number("Conversion factor to CGS (not including cosmological corrections)");
    length = number("U_L exponent").value_or(0);
    mass = number("U_M exponent").value_or(0);
    time = number("U_t exponent").value_or(0);
    expansion = number("a-scale exponent").value_or(0);
    hubble = number("h-scale exponent").value_or(0);
  }
  // AREPO writes 0 for numbers without a unit.
  if (!in_cgs || !std::isfinite(*in_cgs) || *in_cgs <= 0) return std::nullopt;
  return fmt::format("{:g}", *in_cgs) + power("g", mass) + power("cm", length) + power("s", time) +
         power("a", expansion) + power("h", hubble);
}

}  // namespace

std::optional<double> snapshot_number(std::int64_t file, std::initializer_list<const char*> names) {
  for (const char* group : {"Header", "Parameters", "Units", "Cosmology"}) {
    if (!hdf5_has(file, group)) continue;
    const Hdf5Handle opened(H5Gopen2(file, group, H5P_DEFAULT), H5Gclose);
    if (!opened) continue;
    for (const char* name : names)
      if (const std::optional<double> number = hdf5_number(opened, name); number && *number > 0) return number;
  }
  return std::nullopt;
}

std::optional<double> snapshot_length_cm(std::int64_t file) {
  return snapshot_number(file, {"UnitLength_in_cm", "Unit length in cgs (U_L)"});
}

std::optional<double> snapshot_velocity_cm_s(std::int64_t file, std::optional<double> length_cm) {
  if (const auto velocity = snapshot_number(file, {"UnitVelocity_in_cm_per_s"})) return velocity;
  const auto time = snapshot_number(file, {"Unit time in cgs (U_t)"});
  if (!length_cm || !time) return std::nullopt;
  return *length_cm / *time;
}

Units snapshot_units(std::int64_t file, std::int64_t group) {
  Units units;
  const auto length = snapshot_length_cm(file);
  const auto mass = snapshot_number(file, {"UnitMass_in_g", "Unit mass in cgs (U_M)"});
  const auto velocity = snapshot_velocity_cm_s(file, length);
  if (length) units.emplace_back("length", with_name(*length, "cm", lengths));
  if (mass) units.emplace_back("mass", with_name(*mass, "g", masses));
  if (velocity) units.emplace_back("velocity", with_name(*velocity, "cm/s", velocities));
  if (const auto hubble = snapshot_number(file, {"HubbleParam"})) units.emplace_back("h", fmt::format("{:g}", *hubble));
  for (const std::string& name : hdf5_datasets(group)) {
    const Hdf5Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset) continue;
    if (std::optional<std::string> unit = unit_of(dataset)) units.emplace_back(name, *std::move(unit));
  }
  return units;
}

}  // namespace wheatstone
