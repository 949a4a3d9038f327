#include <array>
#include <cmath>
#include <optional>

#include "wheatstone/particles/hdf5_internal.h"
#include "wheatstone/particles/snapshot_internal.h"

namespace wheatstone {
namespace {

constexpr double cm_a_mpc = 3.085678e24, cm_a_kpc = 3.085678e21, cm_a_km = 1e5;

/// Shares of the critical density today.
struct Cosmology {
  double matter, dark_energy;

  /// How fast the universe expands at a scale factor, today being 1.
  double expansion(double scale) const {
    return std::sqrt(matter / std::pow(scale, 3) + (1 - matter - dark_energy) / (scale * scale) + dark_energy);
  }
};

/// An attribute of a dataset, by GADGET-4's or SWIFT's name; `usual` where it has neither.
double exponent_of(hid_t group, const char* dataset, std::array<const char*, 2> names, double usual) {
  if (!hdf5_has(group, dataset)) return usual;
  const Hdf5Handle opened(H5Dopen2(group, dataset, H5P_DEFAULT), H5Dclose);
  for (const char* name : names)
    if (const std::optional<double> number = hdf5_number(opened, name)) return *number;
  return usual;
}

/// d(position)/d(scale factor) for a velocity of 1, both as the file has them. Comoving positions move by
/// dx/dt = v/a, where v is the peculiar velocity, and da/dt = a·H(a).
double comoving_rate(hid_t file, hid_t group, double scale, const Cosmology& cosmology) {
  const double length = snapshot_length_cm(file).value_or(cm_a_kpc);
  const double velocity = snapshot_velocity_cm_s(file, length).value_or(cm_a_km);
  // GADGET divides peculiar velocities by √a, and positions by 1/h; others say so.
  const double with_scale = exponent_of(group, "Velocities", {"a_scaling", "a-scale exponent"}, 0.5);
  const double with_hubble = exponent_of(group, "Coordinates", {"h_scaling", "h-scale exponent"}, -1);
  const double hubble = snapshot_number(file, {"HubbleParam", "h"}).value_or(1);
  const double hubble_today = 100 * cm_a_km / cm_a_mpc * hubble;  // a second
  const double peculiar = velocity * std::pow(scale, with_scale);
  const double a_length = length * std::pow(hubble, with_hubble);
  return peculiar / (scale * scale * hubble_today * cosmology.expansion(scale) * a_length);
}

}  // namespace

SnapshotTime snapshot_time(std::int64_t file, std::int64_t group) {
  SnapshotTime result;
  if (!hdf5_has(file, "Header")) return result;
  const Hdf5Handle header(H5Gopen2(file, "Header", H5P_DEFAULT), H5Gclose);
  result.time = hdf5_number(header, "Time");
  const std::optional<double> redshift = hdf5_number(header, "Redshift");
  const std::optional<double> matter = snapshot_number(file, {"Omega0", "Omega_m"});
  if (!redshift || !matter || !(*redshift > -1)) return result;
  const double scale = 1 / (1 + *redshift);
  // GADGET gives a scale factor as the time of a universe that expands; SWIFT says that it does.
  const bool expands = snapshot_number(file, {"Cosmological run"}).has_value() ||
                       (result.time && is_scale_factor(*result.time, *redshift));
  if (!expands) return result;
  const Cosmology cosmology{*matter, snapshot_number(file, {"OmegaLambda", "Omega_lambda"}).value_or(0)};
  return {scale, comoving_rate(file, group, scale, cosmology)};
}

}  // namespace wheatstone
